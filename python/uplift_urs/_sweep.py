"""Variants of a study and their comparison."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _toml
from ._commands import command_options
from ._figure import Figure
from ._optional import optional
from ._program import Progress, call
from ._result import Result

if TYPE_CHECKING:
    import pandas


class Sweep(Mapping[str, Result]):
    """The results of a study's variants by their names.

    Attributes
    ----------
    comparison : dict
        What ``uplift sweep --json`` prints: the keys that vary, and each variant with its values and spectra.
    folder : pathlib.Path
        Where results, comparison.csv and comparison.svg are.
    """

    def __init__(self, comparison: dict[str, Any]) -> None:
        self.comparison = comparison
        self.folder = Path(comparison["folder"]).resolve()
        self._files = {variant["name"]: Path(variant["result"]).resolve() for variant in comparison["variants"]}

    def __getitem__(self, name: str) -> Result:
        return Result(self._files[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)

    def to_pandas(self) -> pandas.DataFrame:
        """The comparison as a table: a row for each variant, site, measure, probability and strength."""
        frame: pandas.DataFrame = optional("pandas", "pandas").read_csv(self.folder / "comparison.csv")
        return frame

    def plot(self) -> Figure:
        """The program's figure of the comparison."""
        return Figure((self.folder / "comparison.svg").read_text(encoding="utf-8"))

    def __repr__(self) -> str:
        return f"<Sweep: {', '.join(self.comparison['keys'])}; {len(self)} variants in {self.folder}>"


def sweep(
    study: str | os.PathLike[str],
    over: Mapping[str, Sequence[Any]] | str | os.PathLike[str],
    *,
    output: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
    threads: int | None = None,
    force: bool = False,
    **overrides: Any,
) -> Sweep:
    """Runs variants of a study and compares them, as ``uplift sweep`` does; shared responses are computed once.

    Parameters
    ----------
    study : str or os.PathLike
        A study file of uniform risk spectra.
    over : mapping, str or os.PathLike
        Values of keys; every combination is a variant: ``{"oscillator.restitution": [0.85, 0.95]}``; or a
        table of variants (CSV), a column a key, a row a variant.
    output : str or os.PathLike, optional
        The folder; results/<study>.sweep by default.
    progress, threads
        As for `run`.
    force : bool
        Whether to overwrite existing files.
    **overrides
        Keys that change for all variants, as for `run`.

    Returns
    -------
    Sweep

    Raises
    ------
    StudyError, OSError, Cancelled
        As for `run`.

    Examples
    --------
    >>> variants = sweep("study.toml", {"oscillator.restitution": [0.85, 0.95]})
    >>> variants["restitution-0.85"].urs.u_m
    """
    optional("h5py", "results")  # before anything is computed
    if isinstance(over, Mapping):
        for key, values in over.items():
            if isinstance(values, str) or not hasattr(values, "__iter__"):
                raise TypeError(f"{key}: give a list of values, [{values!r}] for one alone")
        variants = [f"--over={key}={','.join(_toml.inline(value) for value in values)}" for key, values in over.items()]
    else:
        variants = [f"--cases={os.fspath(over)}"]
    changes = [f"--set={change}" for change in _toml.overrides(overrides)]
    options = command_options({"output": output, "threads": threads, "force": force})
    arguments = ["sweep", "--json", *options, *variants, *changes, "--", os.fspath(study)]
    return Sweep(json.loads(call(arguments, progress=progress)))
