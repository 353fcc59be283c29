"""Structures in memory, by the keys of their files."""

from __future__ import annotations

from typing import Any

from . import _toml
from ._native import Structure


def structure(**keys: Any) -> Structure:
    """A rocking structure by the keys of a structure file.

    Parameters
    ----------
    **keys
        As in a structure file (docs/structure-file.md): ``kind="frame", columns=4, width_m=1.6, ...``; a restrainer is
        a mapping.

    Returns
    -------
    Structure

    Raises
    ------
    StudyError
        A `ValueError` with all mistakes of the keys.

    Examples
    --------
    >>> structure(kind="block", width_m=0.8, height_m=4.0, mass_kg=5e3, uplift_displacement_m=5e-4).strength
    """
    return Structure.parse(_toml.document(keys))
