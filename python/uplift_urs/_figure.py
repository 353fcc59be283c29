"""Figures of the program, as notebooks show them."""

from __future__ import annotations

import os
from pathlib import Path


class Figure:
    """A figure: a notebook shows it, and `save` writes it.

    Attributes
    ----------
    svg : str
        The figure as SVG.
    """

    def __init__(self, svg: str) -> None:
        self.svg = svg

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the SVG to a file, overwriting it."""
        Path(path).write_text(self.svg, encoding="utf-8")

    def __repr__(self) -> str:
        return f"<Figure: SVG of {len(self.svg)} characters>"
