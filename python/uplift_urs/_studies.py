"""Studies, run by the program."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

from . import _toml
from ._optional import optional
from ._program import Progress, call
from ._result import Result


def run(
    study: str | os.PathLike[str] | Mapping[str, Any],
    *,
    output: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
    threads: int | None = None,
    force: bool = False,
    **overrides: Any,
) -> Result:
    """Runs a study, as ``uplift run`` does: same bits, same file, same checkpoint.

    Parameters
    ----------
    study : str, os.PathLike or mapping
        A study file, whose paths start from its folder; or its content, ``{"pgv": {}, "records": {...}}``,
        whose paths start from the current folder.
    output : str or os.PathLike, optional
        The result file; by default the study's, else results/<study>.h5.
    progress : callable, optional
        Called with every `Event`; returning False stops the run, as Ctrl-C does. The same call resumes it.
    threads : int, optional
        All cores by default; the numbers do not depend on it.
    force : bool
        Whether to overwrite the result of another study.
    **overrides
        Keys of the study that change: ``records={"first": 20}``, or dotted, ``**{"records.first": 20}``.

    Returns
    -------
    Result
        With its `summary`.

    Raises
    ------
    StudyError
        A `ValueError` for a study with mistakes or unusable data; `mistakes` has all of them.
    OSError
        For a file that cannot be read or written, or a missing program.
    Cancelled
        A `RuntimeError`, if `progress` returned False.
    KeyboardInterrupt
        For Ctrl-C; what is finished is kept.
    ImportError
        If h5py is not installed.
    """
    optional("h5py", "results")  # before anything is computed
    arguments, text = study_arguments(study, overrides)
    options = [*(["-o", os.fspath(output)] if output is not None else []), *(["--force"] if force else [])]
    options += [f"--threads={threads}"] if threads is not None else []
    summary = json.loads(call(["run", "--json", *options, *arguments], progress=progress, text=text))
    return Result(summary["files"][0], summary=summary)


def check(study: str | os.PathLike[str] | Mapping[str, Any], **overrides: Any) -> dict[str, Any]:
    """Checks a study and its input data, and estimates its cost, as ``uplift check`` does.

    Parameters
    ----------
    study, **overrides
        As for `run`.

    Returns
    -------
    dict
        The plan of a run, with "alarms" and "notes".

    Raises
    ------
    StudyError, OSError
        As for `run`.
    """
    arguments, text = study_arguments(study, overrides)
    plan: dict[str, Any] = json.loads(call(["check", "--json", *arguments], text=text))
    return plan


def study_arguments(
    study: str | os.PathLike[str] | Mapping[str, Any], overrides: Mapping[str, Any]
) -> tuple[list[str], str]:
    """The arguments that name a study, and its standard input."""
    changes = [f"--set={change}" for change in _toml.overrides(overrides)]
    if isinstance(study, Mapping):
        return [*changes, "-"], _toml.document(study)
    name = os.fspath(study)
    # a file of this name, where the program would read its standard input
    return [*changes, "--", os.path.join(os.curdir, name) if name == "-" else name], ""
