"""Commands that assess structures with the records and the hazard of a result."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

from . import _toml
from ._program import Progress, call

_PathLike = str | os.PathLike[str]
#: A structure file, or its keys; files that the keys name are then to be named with their whole path.
StructureLike = _PathLike | Mapping[str, Any]


class StructureCommands:
    """The commands that assess a structure; each returns what ``--json`` prints.

    They compute the structure's own stripes under the result's records, and keep the answer in the file:
    ``result["structures/pier/design/..."]``, `Result.groups` has the places.
    """

    path: Path

    def compute_design(
        self,
        structure: StructureLike,
        *,
        site: str | None = None,
        measure: str | None = None,
        poe: float | None = None,
        return_period: float | None = None,
        years: float | None = None,
        repaired: bool = False,
        safety_factor: float | None = None,
        spectrum_only: bool = False,
        proxy: bool = False,
        manifest: _PathLike | None = None,
        report: _PathLike | None = None,
        force: bool = False,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> dict[str, Any]:
        """Checks a structure against the spectrum and by its own risk, as ``uplift design`` does.

        Parameters
        ----------
        structure : str, os.PathLike or mapping
            A structure file, or its keys.
        site, measure : str, optional
            Default: the only site; PGV if the result has it.
        poe, return_period : float, optional
            A probability of exceedance in `years`, or a return period in years; default: the smallest probability
            of the study.
        repaired : bool
            Whether the repaired spectrum is read, after ``compute_consistency(repair=True)``.
        safety_factor : float, optional
            FS of Eq. 3.15; 2.5 by default.
        spectrum_only : bool
            Whether to apply the rules without analysing the structure.
        proxy : bool
            Whether to leave out the structure itself, a frame or a block.
        manifest : str or os.PathLike, optional
            The records' manifest, if it was moved.
        report : str or os.PathLike, optional
            A design sheet to write (HTML); overwritten only with `force`.

        Returns
        -------
        dict
            Demands in m, rates in 1/yr, of the oscillator in "exact" and of the structure itself in "own", with "notes"
            and "alarms".

        Raises
        ------
        StudyError, OSError, Cancelled
            As for `run`.
        """
        options = {
            "site": site,
            "measure": measure,
            "poe": poe,
            "return_period": return_period,
            "years": years,
            "repaired": repaired,
            "safety_factor": safety_factor,
            "spectrum_only": spectrum_only,
            "proxy": proxy,
            "manifest": manifest,
            "report": report,
            "force": force,
            "threads": threads,
        }
        return self._of_structure("design", structure, options, progress)

    def compute_overturning(
        self,
        structure: StructureLike,
        *,
        site: str | None = None,
        measure: str | None = None,
        restitution: float | None = None,
        proxy: bool = False,
        manifest: _PathLike | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> dict[str, Any]:
        """Computes how often a structure overturns, as ``uplift overturning`` does: oscillator, rigid block, frame.

        Parameters
        ----------
        structure : str, os.PathLike or mapping
        site, measure : str, optional
            Default: all of the result.
        restitution : float, optional
            Coefficient of restitution of oscillator, block and planar frame, in place of their own.
        proxy : bool
            Whether to leave out the structure itself, a frame or a block.
        manifest
            As for `compute_design`.

        Returns
        -------
        dict
            Frequencies in 1/yr with their bands.
        """
        options = {
            "site": site,
            "measure": measure,
            "restitution": restitution,
            "proxy": proxy,
            "manifest": manifest,
            "threads": threads,
        }
        return self._of_structure("overturning", structure, options, progress)

    def compute_target(
        self,
        structure: StructureLike,
        vary: Literal["strength", "size", "width", "capacity", "tendon-stiffness"],
        *,
        overturning: float | None = None,
        exceed: float | Literal["capacity", "limit"] | None = None,
        safety_factor: float | None = None,
        per_year: float | None = None,
        poe: float | None = None,
        return_period: float | None = None,
        years: float | None = None,
        between: tuple[float | None, float | None] = (None, None),
        tolerance: float | None = None,
        at: Sequence[float] | None = None,
        generic_dispersion: float | None = None,
        generic_probability: float | None = None,
        site: str | None = None,
        measure: str | None = None,
        repaired: bool = False,
        proxy: bool = False,
        manifest: _PathLike | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> dict[str, Any]:
        """Finds the least value of a quantity that meets a target risk, as ``uplift target`` does.

        Parameters
        ----------
        structure : str, os.PathLike or mapping
        vary : {"strength", "size", "width", "capacity", "tendon-stiffness"}
            Everything else is kept.
        overturning : float, optional
            Target annual rate of overturning.
        exceed : float, "capacity" or "limit", optional
            Target displacement, m, or the structure's own capacity, instead of overturning; with one of `per_year`
            (1/yr), `poe` in `years`, `return_period` (years).
        safety_factor : float, optional
            What the capacity is divided by, with ``exceed="capacity"``.
        between : tuple of float
            Least and largest value tried, in SI units; default: a quarter and four times the structure's own.
        tolerance : float, optional
            Relative tolerance of the value; 0.005 by default.
        at : sequence of float, optional
            Return periods, years, at whose levels the fragility is reported.
        generic_dispersion, generic_probability : float, optional
            A generic lognormal fragility to compare with: the risk-targeted motion.
        repaired : bool
            Whether the records have the weights of a repair, after ``compute_consistency(repair=True)``.
        proxy : bool
            Whether to leave out the structure itself, a frame or a block.
        site, measure, manifest
            As for `compute_design`.

        Returns
        -------
        dict
            "safe_value", the best estimate "value" and its "bands", every crossing, what was tried.
        """
        options = {
            "vary": vary,
            "overturning": overturning,
            "exceed": exceed,
            "safety_factor": safety_factor,
            "per_year": per_year,
            "poe": poe,
            "return_period": return_period,
            "years": years,
            "from": between[0],
            "to": between[1],
            "tolerance": tolerance,
            "at": at,
            "generic_dispersion": generic_dispersion,
            "generic_probability": generic_probability,
            "site": site,
            "measure": measure,
            "repaired": repaired,
            "proxy": proxy,
            "manifest": manifest,
            "threads": threads,
        }
        return self._of_structure("target", structure, options, progress)

    def compute_risk(
        self,
        structure: StructureLike,
        *,
        site: str | None = None,
        measure: str | None = None,
        model: Literal["wobbling", "planar"] | None = None,
        poe: float | None = None,
        return_period: float | None = None,
        years: float | None = None,
        manifest: _PathLike | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> dict[str, Any]:
        """Computes the risk of a rocking frame, compared with its proxies, as ``uplift risk`` does (Chapter 6).

        Parameters
        ----------
        structure : str, os.PathLike or mapping
            With columns and a deck.
        model : {"wobbling", "planar"}, optional
            Default: by the shape of the columns.
        site, measure, poe, return_period, years, manifest
            As for `compute_design`.

        Returns
        -------
        dict
            Demands of every model with their bands, in m; frequencies of events, in 1/yr.
        """
        options = {
            "site": site,
            "measure": measure,
            "model": model,
            "poe": poe,
            "return_period": return_period,
            "years": years,
            "manifest": manifest,
            "threads": threads,
        }
        return self._of_structure("risk", structure, options, progress)

    def _of_structure(
        self, command: str, structure: StructureLike, options: Mapping[str, Any], progress: Progress | None
    ) -> dict[str, Any]:
        with _structure_file(structure) as file:
            arguments = [command, "--json", f"--urs={self.path}", *command_options(options), "--", file]
            told: dict[str, Any] = json.loads(call(arguments, progress=progress))
        self.__dict__.pop("groups", None)
        return told


@contextmanager
def _structure_file(structure: StructureLike) -> Iterator[str]:
    if not isinstance(structure, Mapping):
        yield os.fspath(structure)
        return
    with tempfile.TemporaryDirectory() as folder:
        text = _toml.document(structure)
        # answers are kept by the name of the file: another structure is another name
        file = Path(folder, f"structure-{hashlib.sha256(text.encode()).hexdigest()[:8]}.toml")
        file.write_text(text, encoding="utf-8")
        yield os.fspath(file)


def command_options(options: Mapping[str, Any]) -> list[str]:
    """Options of the command line; what is None or False is left out."""
    found = []
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        if value is True:
            found.append(option)
        elif value is not None and value is not False:
            many = hasattr(value, "__iter__") and not isinstance(value, (str, os.PathLike))
            found.append(f"{option}={','.join(map(str, value)) if many else value}")
    return found
