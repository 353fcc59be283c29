"""A library of rocking response."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from ._commands import command_options
from ._figure import Figure
from ._optional import optional
from ._program import Progress, call
from ._studies import study_arguments

if TYPE_CHECKING:
    import pandas


class Library:
    """How blocks and oscillators respond over normalised intensities.

    Attributes
    ----------
    report : dict
        What ``uplift library --json`` prints.
    folder : pathlib.Path
        Where tables, figures and the fragilities for OpenQuake are.
    """

    def __init__(self, report: dict[str, Any]) -> None:
        self.report = report
        self.folder = Path(report["files"][0]).resolve().parent

    def to_pandas(self, table: Literal["levels", "fits", "surfaces"] = "levels") -> pandas.DataFrame:
        """A table: a row each system, intensity and level; lognormal fits; surfaces over both intensities."""
        frame: pandas.DataFrame = optional("pandas", "pandas").read_csv(self.folder / f"{table}.csv")
        return frame

    def plot(self, name: Literal["block-pga", "block-pgv", "oscillator-pga", "oscillator-pgv"]) -> Figure:
        """The program's figure of these systems over this intensity."""
        return Figure((self.folder / f"{name}.svg").read_text(encoding="utf-8"))

    def __repr__(self) -> str:
        return f"<Library: {len(self.report['systems'])} systems in {self.folder}>"


def library(
    study: str | os.PathLike[str] | Mapping[str, Any],
    *,
    output: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
    threads: int | None = None,
    force: bool = False,
    **overrides: Any,
) -> Library:
    """Computes a library of rocking response, as ``uplift library`` does.

    Parameters
    ----------
    study : str, os.PathLike or mapping
        A library file, or its content: ``{"block": {"size_m": [1, 2]}}``.
    output : str or os.PathLike, optional
        The folder; results/library by default.
    progress, threads, **overrides
        As for `run`.
    force : bool
        Whether to overwrite existing files.

    Returns
    -------
    Library

    Raises
    ------
    StudyError, OSError, Cancelled
        As for `run`.

    Examples
    --------
    >>> found = library({"block": {"slenderness_rad": 0.2}, "records": {"manifest": "manifest.csv"}})
    >>> found.to_pandas("fits")
    """
    arguments, text = study_arguments(study, overrides)
    options = command_options({"output": output, "threads": threads, "force": force})
    return Library(json.loads(call(["library", "--json", *options, *arguments], progress=progress, text=text)))
