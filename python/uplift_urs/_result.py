"""Results of ``uplift run``, and the commands on them."""

from __future__ import annotations

import html
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from ._commands import StructureCommands, command_options
from ._figure import Figure
from ._groups import Arrays, attributes, columns, dataset, read_group
from ._optional import optional
from ._program import Progress, StudyError, call
from ._sealed import SealedFile

if TYPE_CHECKING:
    import pandas
    import polars
    from xarray import Dataset

_PathLike = str | os.PathLike[str]
# what adds a group that is not there
_ADDED_BY = {
    "bootstrap": "compute_bootstrap()",
    "influence": "compute_influence()",
    "disaggregation": "compute_influence()",
    "efficiency": "compute_measures()",
    "sufficiency": "compute_measures()",
    "structures": "compute_design(), compute_overturning(), compute_target() or compute_risk()",
    "risk": "risk.maf_surface = true in the study",
    "consistency": "hazard curves of both PGV and PGA",
}


def open_result(path: _PathLike, measure: str | None = None, *, verify: bool = True) -> Result:
    """Opens a result file.

    Every byte is checked before HDF5 sees the file, and again after the file has changed. Arrays are read when they are
    looked at; the file is not kept open.

    Parameters
    ----------
    path : str or os.PathLike
        A file that ``uplift run`` wrote.
    measure : str, optional
        The intensity measure of `Result.urs` and the like, "pga"; by default "pgv", or the first of the result.
    verify : bool
        Whether the bytes are checked. HDF5 may hang or crash on a damaged file.

    Returns
    -------
    Result

    Raises
    ------
    OSError
        For a file that is missing, damaged, or not HDF5.
    ValueError
        For a file of another program, or a measure that it does not have.
    ImportError
        If h5py is not installed.
    """
    return Result(path, measure, verify=verify)


def _has_arrays(group: Mapping[str, Any]) -> bool:
    """Whether it holds more than groups."""
    return any(not hasattr(item, "keys") for item in group.values())


class Result(StructureCommands):
    """A result file, with one of its intensity measures selected.

    The groups of the file are `xarray.Dataset`, or `Arrays` where xarray is not installed; names, units and attributes
    are those of the file (docs/hdf5-layout.md). A missing group is a `ValueError` that names the command to
    add it.

    Attributes
    ----------
    path : pathlib.Path
    attributes : dict
        Of the file: "title", "version", "record_set", "synthetic", "study_toml", "warnings", ...
    measures : list of str
        Intensity measures that the records were scaled to.
    measure : str
        The one selected for `urs`, `ida` and so on.
    sites : list of str
    summary : dict or None
        The report of `run`, with its "alarms"; None for a file that was opened.
    """

    def __init__(
        self,
        path: _PathLike,
        measure: str | None = None,
        *,
        summary: dict[str, Any] | None = None,
        verify: bool = True,
    ) -> None:
        self.path = Path(path).absolute()
        self.summary = summary
        self._file = SealedFile(self.path, verify)
        with self._file.open() as file:
            self.attributes = attributes(file)
            if self.attributes.get("program") != "uplift":
                raise ValueError(f"{self.path}: is not a result of uplift")
            self.measures = list(file.get("ida", ()))
            sites = file.get("axes/site")
            self.sites = [] if sites is None else list(sites.asstr()[()])
        if measure is not None and measure not in self.measures:
            raise ValueError(f"measure is {measure!r}: the result has {', '.join(self.measures) or 'none'}")
        self.measure = measure or ("pgv" if "pgv" in self.measures else next(iter(self.measures), ""))

    def of(self, measure: str) -> Result:
        """The same result with another intensity measure: ``result.of("pga").urs``."""
        return Result(self.path, measure, summary=self.summary, verify=self._file.verify)

    def __getitem__(self, group: str) -> Dataset:
        """Any group by its place in the file, ``result["epistemic/pgv/Athens"]``."""
        return dataset(self._arrays(group))  # type: ignore[return-value]

    @cached_property
    def groups(self) -> list[str]:
        """Places of all groups that have arrays."""
        found: list[str] = []
        with self._file.open() as file:
            file.visititems(lambda name, item: found.append(name) if hasattr(item, "keys") else None)
            return [group for group in found if _has_arrays(file[group])]

    @property
    def records(self) -> Dataset:
        """The ground motions."""
        return self["records"]

    @property
    def ida(self) -> Dataset:
        """Peak displacements ``edp_m`` of all runs, with their impacts."""
        return self._of_measure("ida")

    @property
    def risk(self) -> Dataset:
        """Annual rates of exceedance, ``maf_per_year``."""
        return self._of_measure("risk")

    @property
    def urs(self) -> Dataset:
        """Uniform risk spectra ``u_m``, with flags and tails."""
        return self._of_measure("urs")

    @property
    def regression(self) -> Dataset:
        """Coefficients of Eq. 4.11."""
        return self._of_measure("regression")

    @property
    def bootstrap(self) -> Dataset:
        """Confidence bands, after `compute_bootstrap`."""
        return self._of_measure("bootstrap")

    @property
    def influence(self) -> Dataset:
        """Spectra without each record, after `compute_influence`."""
        return self._of_measure("influence")

    @property
    def disaggregation(self) -> Dataset:
        """Shares of the risk by intensity, after `compute_influence`."""
        return self._of_measure("disaggregation")

    @property
    def efficiency(self) -> Dataset:
        """Efficiency of the measure, after `compute_measures`."""
        return self._of_measure("efficiency")

    @property
    def consistency(self) -> Dataset:
        """Consistency with the hazard of the other measure; repaired spectra after `compute_consistency`."""
        return self._of_measure("consistency")

    @property
    def hazard(self) -> dict[str, Dataset]:
        """Hazard curves as used, by site."""
        return {site: self[f"hazard/{site}/{self.measure}"] for site in self.sites}

    @property
    def sufficiency(self) -> dict[str, Dataset]:
        """Trends of the residuals, by covariate, after `compute_measures`."""
        with self._file.open() as file:
            covariates = list(file.get(f"sufficiency/{self.measure}", ()))
        if not covariates:
            raise self._missing(f"sufficiency/{self.measure}")
        return {name: self[f"sufficiency/{self.measure}/{name}"] for name in covariates}

    @property
    def spectra(self) -> Dataset:
        """Percentiles of a study of displacement spectra."""
        return self["spectra"]

    @property
    def design(self) -> Dataset:
        """The design example of a study of displacement spectra."""
        return self["design"]

    @property
    def shake_table(self) -> Dataset:
        """The tests of a study of a shaking table."""
        return self["shake_table"]

    def to_pandas(self, group: str = "urs") -> pandas.DataFrame:
        """A group as a table: a row for each combination of its axes.

        Parameters
        ----------
        group : str
            "urs", "regression", "bootstrap", ..., of this measure; or its place in the file, "records".
        """
        frame: pandas.DataFrame = optional("pandas", "pandas").DataFrame(self._columns(group))
        return frame

    def to_polars(self, group: str = "urs") -> polars.DataFrame:
        """The same as a frame of polars."""
        frame: polars.DataFrame = optional("polars", "polars").DataFrame(self._columns(group))
        return frame

    def plot(self, name: str = "urs", *, width: Literal["single", "double"] = "double") -> Figure:
        """A figure of the program, for a notebook or a file.

        Parameters
        ----------
        name : str
            "urs", "ida", "fragility", "consistency", ...: as the files of ``uplift plot`` are named.
        width : {"single", "double"}
            Width of a journal's column or page.
        """
        found = self.figures(name, width=width)
        for wanted in (name, f"{name}-{self.measure}"):
            if wanted in found:
                return found[wanted]
        if len(found) == 1:
            return next(iter(found.values()))
        raise StudyError(f"{name!r} is the name of {len(found)} figures: give one of {', '.join(found)}")

    def figures(self, name: str = "", *, width: Literal["single", "double"] = "double") -> dict[str, Figure]:
        """All figures of the program whose names contain this, by name."""
        with tempfile.TemporaryDirectory() as folder:
            only = ["--only", name] if name else []
            call(["plot", self.path, "-o", folder, "--width", width, *only])
            return {file.stem: Figure(file.read_text(encoding="utf-8")) for file in sorted(Path(folder).glob("*.svg"))}

    def export(
        self,
        *formats: Literal["csv", "json", "mat", "xlsx"],
        output: _PathLike | None = None,
        poe: Sequence[float] | None = None,
        return_period: Sequence[float] | None = None,
        years: float | None = None,
        force: bool = False,
    ) -> None:
        """Writes spectra, bands and coefficients: ``result.export("xlsx", return_period=[475, 2475])``.

        Parameters
        ----------
        *formats : {"csv", "json", "mat", "xlsx"}
        output : str or os.PathLike, optional
            The file, for one format; by default beside the result.
        poe, return_period, years
            Any probabilities, or return periods in years; by default those of the study.
        force : bool
            Whether to overwrite existing files.
        """
        options = {"output": output, "poe": poe, "return_period": return_period, "years": years, "force": force}
        call(["export", self.path, *(f"--{name}" for name in formats), *command_options(options)])

    def report(self, output: _PathLike | None = None, *, force: bool = False) -> None:
        """Writes a page with figures and tables; by default beside the result, with the ending .html."""
        call(["report", self.path, *command_options({"output": output, "force": force})])

    def verify(self) -> None:
        """Checks every byte and every value, as ``uplift verify`` does; a `ValueError` where one has changed."""
        call(["verify", self.path])

    def displacement(
        self,
        *,
        strength: float | Sequence[float] | None = None,
        return_period: float | Sequence[float] | None = None,
        poe: float | Sequence[float] | None = None,
        site: str | Sequence[str] | None = None,
        capacity_m: float | None = None,
        repaired: bool = False,
    ) -> list[dict[str, Any]]:
        """Reads displacements with their 90 % confidence band, as ``uplift spectrum`` does.

        Parameters
        ----------
        strength : float or sequence of float, optional
            Uplift strengths; about 0.1, 0.2 and 0.4 by default.
        return_period, poe : float or sequence of float, optional
            Return periods in years or probabilities of exceedance; the smallest probability of the study by default.
        site : str or sequence of str, optional
            Sites; all by default.
        capacity_m : float, optional
            Displacement capacity, m: stiffness is negative after uplift (equal energy).
        repaired : bool
            Whether to read the spectra repaired for hazard consistency.

        Returns
        -------
        list of dict
            "site", "im", "strength", "poe", "years", "return_period_years", "u_m" in m (None where it overturns), and
            "band_m", lower and upper limit in m.
        """
        options = {
            "strength": strength,
            "return_period": return_period,
            "poe": poe,
            "site": site,
            "capacity_m": capacity_m,
            "repaired": repaired,
            "measure": self.measure,
        }
        told = json.loads(call(["spectrum", self.path, "--json", *command_options(options)]))
        rows: list[dict[str, Any]] = told["displacements"]
        return rows

    def compute_bootstrap(
        self,
        *,
        sizes: Sequence[int] | None = None,
        replicates: int | None = None,
        seed: int | None = None,
        interval: Literal["percentile", "bca"] | None = None,
        unit: Literal["record", "pair", "event"] | None = None,
        simultaneous: bool = False,
        force: bool = False,
        progress: Progress | None = None,
    ) -> list[dict[str, Any]]:
        """Adds confidence bands to the file, as ``uplift bootstrap`` does; defaults are the study's.

        Returns
        -------
        list of dict
            The rows of Table 4.1; the bands are in `bootstrap`.
        """
        options = {
            "sizes": sizes,
            "replicates": replicates,
            "seed": seed,
            "interval": interval,
            "unit": unit,
            "simultaneous": simultaneous,
            "force": force,
        }
        return self._compute("bootstrap", options, progress)

    def compute_consistency(
        self,
        *,
        repair: bool = False,
        keep_weights: bool = False,
        force: bool = False,
        progress: Progress | None = None,
    ) -> list[dict[str, Any]]:
        """Checks the records against the hazard of the other measure, as ``uplift consistency`` does.

        Parameters
        ----------
        repair : bool
            Whether to weight the records until they agree; `consistency` then has the repaired spectra.
        keep_weights : bool
            Whether to keep the weight of every run.

        Returns
        -------
        list of dict
            The rows that the command prints.
        """
        options = {"repair": repair, "keep_weights": keep_weights, "force": force}
        return self._compute("consistency", options, progress)

    def compute_influence(self, *, force: bool = False, progress: Progress | None = None) -> list[dict[str, Any]]:
        """Adds the influence of records and intensities on the spectra, as ``uplift influence`` does."""
        return self._compute("influence", {"force": force}, progress)

    def compute_measures(self, *, force: bool = False, progress: Progress | None = None) -> list[dict[str, Any]]:
        """Adds the efficiency and sufficiency of the intensity measures, as ``uplift measures`` does."""
        return self._compute("measures", {"force": force}, progress)

    def __repr__(self) -> str:
        title = self.attributes.get("title") or self.path.name
        return f"<Result: {title}; {self.attributes.get('record_set', '')}; by {', '.join(self.measures) or 'none'}>"

    def _repr_html_(self) -> str:
        rows = {
            "file": self.path,
            "title": self.attributes.get("title"),
            "records": self.attributes.get("record_set"),
            "measures": ", ".join(self.measures),
            "sites": ", ".join(self.sites),
            "groups": ", ".join(self.groups),
            "warnings": self.attributes.get("warnings"),
            "program": f"{self.attributes.get('version')} ({self.attributes.get('commit')})",
            "created": self.attributes.get("created"),
        }
        left = "style='text-align:left'"
        cells = (
            f"<tr><th {left}>{name}</th><td {left}>{html.escape(str(value))}</td></tr>"
            for name, value in rows.items()
            if value
        )
        return f"<table>{''.join(cells)}</table>"

    def _arrays(self, place: str) -> Arrays:
        with self._file.open() as file:
            group = file.get(place)
            if not hasattr(group, "items"):
                raise self._missing(place)
            return read_group(self._file, group)

    def _missing(self, place: str) -> ValueError:
        added_by = _ADDED_BY.get(place.strip("/").split("/")[0])
        remedy = f"{added_by} adds it" if added_by else "groups tells what it has"
        return ValueError(f"{self.path}: has no {place}: {remedy}")

    def _place(self, group: str) -> str:
        with self._file.open() as file:
            return group if "/" in group or _has_arrays(file.get(group, {})) else self._own(group)

    def _own(self, group: str) -> str:
        return f"{group}/{self.measure}"

    def _of_measure(self, group: str) -> Dataset:
        return self[self._own(group)]

    def _columns(self, group: str) -> dict[str, Any]:
        return columns(self._arrays(self._place(group)))

    def _compute(self, command: str, options: Mapping[str, Any], progress: Progress | None) -> list[dict[str, Any]]:
        told = call([command, self.path, "--json", *command_options(options)], progress=progress)
        self.__dict__.pop("groups", None)
        rows: list[dict[str, Any]] = json.loads(told)
        return rows
