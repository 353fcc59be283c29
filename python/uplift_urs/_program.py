"""The program ``uplift``: find it, call it, and read its events."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import sysconfig
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO, Any, Literal, cast

# how long a program that Ctrl-C of a terminal reaches too may take to stop by itself, s
_GRACE_S = 1.0


@dataclass(frozen=True)
class Event:
    """An event of a computation.

    Attributes
    ----------
    kind : str
        "begin", "advance" and "end" of a phase; "remark", "note" or "line", a text; "checkpoint", the file of
        what is finished.
    label, unit : str
        What the phase works on, and what its steps are called; empty before the first.
    done, total : int
        Steps of the phase.
    text : str
        The text, or the path of the checkpoint.
    topic : str
        Topic of a remark, one word.
    """

    kind: Literal["begin", "advance", "end", "remark", "note", "line", "checkpoint"]
    label: str = ""
    unit: str = ""
    done: int = 0
    total: int = 0
    text: str = ""
    topic: str = ""


@dataclass(frozen=True)
class Mistake:
    """One mistake of a study or of its input data.

    Attributes
    ----------
    message : str
    key : str
        The key of the study, dotted; may be empty.
    line, column : int or None
        Its line in the study file, from 1.
    override : str or None
        The override that contains it.
    help : str or None
        What to do about it.
    """

    message: str
    key: str = ""
    line: int | None = None
    column: int | None = None
    override: str | None = None
    help: str | None = None

    def __str__(self) -> str:
        places = [f"line {self.line}" if self.line else "", self.override or "", self.key]
        help = f"; {self.help}" if self.help else ""
        return ": ".join([*filter(None, places), self.message]) + help


class StudyError(ValueError):
    """The request cannot be computed: a mistake in the study, unusable input data, or a wrong choice.

    Attributes
    ----------
    mistakes : list of Mistake
        All mistakes found.
    """

    def __init__(self, message: str, mistakes: Sequence[Mistake] = ()) -> None:
        lines = [message.splitlines()[0] if mistakes and message else message, *(f"  - {one}" for one in mistakes)]
        super().__init__("\n".join(lines))
        self.mistakes = list(mistakes)


class Cancelled(RuntimeError):
    """The work was stopped by its callback, or from outside; the message says what is kept."""


class UpliftWarning(UserWarning):
    """A warning about the numbers."""


Progress = Callable[[Event], object]

_FILE_ERRORS: dict[str, type[OSError]] = {
    "not found": FileNotFoundError,
    "permission denied": PermissionError,
    "not a file": IsADirectoryError,
}


def find_program() -> Path:
    """The path of the program: ``UPLIFT_PROGRAM``, the scripts of this installation, or the search path.

    Returns
    -------
    pathlib.Path

    Raises
    ------
    FileNotFoundError
        If there is none; the message says what to do.
    """
    named = os.environ.get("UPLIFT_PROGRAM")
    if named:
        if not os.path.isfile(named):
            raise FileNotFoundError(f"UPLIFT_PROGRAM is {named}: there is no such file")
        return Path(named)
    name = "uplift" + (sysconfig.get_config_var("EXE") or "")
    folders = [
        sysconfig.get_path("scripts"),
        sysconfig.get_path("scripts", sysconfig.get_preferred_scheme("user")),
        # pip install --target
        os.path.join(os.path.dirname(__file__), os.pardir, "bin"),
    ]
    for folder in folders:
        if os.access(os.path.join(folder, name), os.X_OK):
            return Path(folder, name).resolve()
    on_path = shutil.which(name)
    if on_path:
        return Path(on_path)
    raise FileNotFoundError(
        "the program uplift is not installed: the wheel of uplift-urs has it, not the source distribution; build it"
        " (make build), and put it on the path or name it in UPLIFT_PROGRAM"
    )


def call(arguments: Sequence[str | os.PathLike[str]], *, progress: Progress | None = None, text: str = "") -> str:
    """Calls the program, and returns what it prints.

    Parameters
    ----------
    arguments : sequence of str or os.PathLike
    progress : callable, optional
        Called with every `Event`; returning False or raising stops the program.
    text : str
        Its standard input.

    Raises
    ------
    StudyError, OSError
        Requests that the program refuses.
    Cancelled
        If `progress` returned False, or something else stopped it.
    KeyboardInterrupt
        For Ctrl-C, once the program has stopped.
    RuntimeError
        If the program ended without a message.
    """
    command = [find_program(), "--progress", "json", *arguments]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, encoding="utf-8", errors="replace") as child:
        # Popen has them where a pipe was asked for
        stdin, stdout, stderr = cast(IO[str], child.stdin), cast(IO[str], child.stdout), cast(IO[str], child.stderr)
        answer: list[str] = []
        others = [
            threading.Thread(target=lambda: answer.append(stdout.read()), daemon=True),
            threading.Thread(target=_hand_over, args=(stdin, text), daemon=True),
        ]
        for other in others:
            other.start()
        told = _Told(stderr)
        try:
            for event in told:
                if progress is not None and progress(event) is False:
                    _stop(child)
                    progress = None
                if event.kind == "note":
                    warnings.warn(event.text, UpliftWarning, stacklevel=3)
            code = child.wait()
        except BaseException as raised:
            # Ctrl-C of a terminal reaches the program as well, and asked twice it has no time for last words
            if isinstance(raised, KeyboardInterrupt):
                with contextlib.suppress(subprocess.TimeoutExpired):
                    child.wait(_GRACE_S)
            _stop(child)
            for _ in told:
                pass
            if isinstance(raised, KeyboardInterrupt) and told.failure:
                raise KeyboardInterrupt(told.failure["message"]) from None
            raise
        for other in others:
            other.join()
    if code == 0:
        return answer[0]
    raise _error(code, told)


def _hand_over(stream: IO[str], text: str) -> None:
    # a program that refuses what it is asked for reads nothing
    with contextlib.suppress(BrokenPipeError), stream:
        stream.write(text)


def _stop(child: subprocess.Popen[str]) -> None:
    """As Ctrl-C does: what is finished is kept."""
    if child.poll() is None:
        child.terminate() if sys.platform == "win32" else child.send_signal(signal.SIGINT)


class _Told:
    """What the program tells line by line: the events, one after the other, then what it failed of, and other lines."""

    def __init__(self, lines: Iterable[str]) -> None:
        self._lines = iter(lines)
        self._now = Event("line")
        self.failure: dict[str, Any] | None = None
        self.others: list[str] = []

    def __iter__(self) -> Iterator[Event]:
        for line in self._lines:
            try:
                told = json.loads(line)
                kind = told.pop("event")
            except (ValueError, AttributeError, KeyError, TypeError):
                self.others.append(line)
                continue
            if kind == "error":
                self.failure = told
            elif kind in ("begin", "advance", "end"):
                self._now = replace(self._now, kind=kind, **{"done": 0, **told})
                yield self._now
            elif kind == "checkpoint":
                yield replace(self._now, kind=kind, text=told["path"])
            elif kind in ("remark", "note", "line"):
                yield replace(self._now, kind=kind, **told)


def _error(code: int, told: _Told) -> Exception:
    failure = told.failure
    if failure is None:
        # words about arguments, or what a bug left
        words = "".join(told.others).strip()
        if code == 2:
            return StudyError(words.removeprefix("error: ").partition("\n\n")[0])
        ended = f"signal {-code}" if code < 0 else f"exit code {code}"
        return RuntimeError(f"the program uplift ended with {ended}: {words or 'without a word'}")
    message = failure["message"]
    for option, name in [("(-o)", "(output=)"), ("with -o", "with output="), ("--force", "force=True")]:
        message = message.replace(option, name)
    if failure["kind"] == "interrupted":
        return Cancelled(message)
    if failure["kind"] == "file":
        return _FILE_ERRORS.get(failure["reason"], OSError)(message)
    return StudyError(message, [Mistake(**mistake) for mistake in failure["mistakes"]])
