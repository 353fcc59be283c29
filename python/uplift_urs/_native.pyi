"""Types of the extension; units and shapes are in the docstrings, which ``help()`` shows."""

from collections.abc import Iterable, Sequence
from os import PathLike
from typing import ClassVar, Literal, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Bands",
    "ExportedCurve",
    "Fit",
    "HazardCurve",
    "History",
    "Record",
    "Response",
    "Responses",
    "Spectra",
    "__version__",
    "bootstrap",
    "fit",
    "fragility",
    "ida",
    "read_hazard_export",
    "read_record",
    "read_records",
    "respond",
    "risk_curve",
    "urs",
]

__version__: str

_Path = str | PathLike[str]
_Floats = NDArray[np.float64]
# what has an axis at least
_Many = NDArray[np.floating | np.integer] | Sequence[float] | Sequence[Sequence[float]]
_RecordFormat = Literal["at2", "esm", "knet", "cosmos", "csmip", "columns"]
_Extrapolate = Literal["refuse", "loglog"]
_Intensity = Literal["geometric-mean", "rotd50", "rotd100"]
_Contour = Literal["exact", "grid"]

_Shaking = Record | tuple[Record, Record]

@final
class Record:
    @classmethod
    def from_array(
        cls, acceleration: ArrayLike, *, dt_s: float, unit: str, name: str = "record", gravity_m_s2: float = 9.80665
    ) -> Record: ...
    @property
    def acceleration_m_s2(self) -> _Floats: ...
    @property
    def time_s(self) -> _Floats: ...
    @property
    def dt_s(self) -> float: ...
    @property
    def duration_s(self) -> float: ...
    @property
    def gravity_m_s2(self) -> float: ...
    @property
    def name(self) -> str: ...
    @property
    def pga_g(self) -> float: ...
    @property
    def pgv_cm_s(self) -> float: ...
    @property
    def pgd_cm(self) -> float: ...
    @property
    def cav_cm_s(self) -> float: ...
    @property
    def arias_cm_s(self) -> float: ...
    @property
    def description(self) -> dict[str, str | float | bool]: ...
    def measure(self, measure: str) -> float: ...
    def __len__(self) -> int: ...

def read_record(
    path: _Path,
    *,
    channel: int | None = None,
    dt_s: float | None = None,
    unit: str | None = None,
    format: _RecordFormat | None = None,
    gravity_m_s2: float = 9.80665,
) -> Record: ...
def read_records(
    path: _Path,
    *,
    dt_s: float | None = None,
    unit: str | None = None,
    format: _RecordFormat | None = None,
    gravity_m_s2: float = 9.80665,
) -> list[Record]: ...
@final
class History:
    @property
    def time_s(self) -> _Floats: ...
    @property
    def displacement_m(self) -> _Floats: ...
    @property
    def velocity_m_s(self) -> _Floats: ...
    @property
    def event_time_s(self) -> _Floats: ...
    @property
    def event_displacement_m(self) -> _Floats: ...
    @property
    def event_velocity_before_m_s(self) -> _Floats: ...
    @property
    def event_velocity_after_m_s(self) -> _Floats: ...
    @property
    def event_is_impact(self) -> NDArray[np.bool_]: ...

@final
class Response:
    @property
    def peak_displacement_m(self) -> float: ...
    @property
    def time_of_peak_s(self) -> float: ...
    @property
    def impacts(self) -> int: ...
    @property
    def uplifts(self) -> int: ...
    @property
    def overturned(self) -> bool: ...
    @property
    def end_displacement_m(self) -> float: ...
    @property
    def end_velocity_m_s(self) -> float: ...
    @property
    def history(self) -> History | None: ...
    @property
    def status(self) -> Literal["no uplift", "uplifted", "overturned"]: ...

@final
class Responses:
    @property
    def peak_displacement_m(self) -> _Floats: ...
    @property
    def time_of_peak_s(self) -> _Floats: ...
    @property
    def impacts(self) -> NDArray[np.uint32]: ...
    @property
    def uplifts(self) -> NDArray[np.uint32]: ...
    @property
    def overturned(self) -> NDArray[np.bool_]: ...
    @property
    def end_displacement_m(self) -> _Floats: ...
    @property
    def end_velocity_m_s(self) -> _Floats: ...

@overload
def respond(
    record: Record,
    strength: float,
    *,
    uplift_displacement_m: float = 0.0005,
    restitution: float = 0.95,
    capacity_m: float | None = None,
    post_uplift_stiffness_per_s2: float | None = None,
    scale: float = 1.0,
    free_vibration: bool = True,
    free_vibration_s: float | None = None,
    gravity_m_s2: float = 9.80665,
    history: bool = False,
) -> Response: ...
@overload
def respond(
    record: Record,
    strength: _Many,
    *,
    uplift_displacement_m: ArrayLike = 0.0005,
    restitution: ArrayLike = 0.95,
    capacity_m: ArrayLike | None = None,
    post_uplift_stiffness_per_s2: ArrayLike | None = None,
    scale: ArrayLike = 1.0,
    free_vibration: bool = True,
    free_vibration_s: float | None = None,
    gravity_m_s2: float = 9.80665,
    history: Literal[False] = False,
) -> Responses: ...
@overload
def respond(
    record: Record,
    strength: ArrayLike,
    *,
    uplift_displacement_m: ArrayLike = 0.0005,
    restitution: ArrayLike = 0.95,
    capacity_m: ArrayLike | None = None,
    post_uplift_stiffness_per_s2: ArrayLike | None = None,
    scale: _Many,
    free_vibration: bool = True,
    free_vibration_s: float | None = None,
    gravity_m_s2: float = 9.80665,
    history: Literal[False] = False,
) -> Responses: ...
@overload
def respond(
    record: Record,
    strength: ArrayLike,
    *,
    uplift_displacement_m: ArrayLike = 0.0005,
    restitution: ArrayLike = 0.95,
    capacity_m: ArrayLike | None = None,
    post_uplift_stiffness_per_s2: ArrayLike | None = None,
    scale: ArrayLike = 1.0,
    free_vibration: bool = True,
    free_vibration_s: float | None = None,
    gravity_m_s2: float = 9.80665,
    history: Literal[False] = False,
) -> Response | Responses: ...
def ida(
    records: Iterable[_Shaking],
    strengths: ArrayLike,
    levels: ArrayLike,
    measure: str = "pgv",
    *,
    uplift_displacement_m: float = 0.0005,
    restitution: float = 0.95,
    capacity_m: float | None = None,
    post_uplift_stiffness_per_s2: float | None = None,
    free_vibration: bool = True,
    intensity: _Intensity = "geometric-mean",
    gravity_m_s2: float = 9.80665,
) -> _Floats: ...
@final
class HazardCurve:
    def __new__(
        cls,
        im: ArrayLike,
        maf_per_year: ArrayLike,
        *,
        measure: str = "pgv",
        unit: str | None = None,
        source: str = "",
        component: str | None = None,
    ) -> HazardCurve: ...
    @classmethod
    def read(
        cls,
        path: _Path,
        *,
        measure: str | None = None,
        unit: str | None = None,
        kind: Literal["maf", "poe"] | None = None,
        years: float | None = None,
    ) -> HazardCurve: ...
    @property
    def im(self) -> _Floats: ...
    @property
    def maf_per_year(self) -> _Floats: ...
    @property
    def measure(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def component(self) -> str | None: ...
    def rate_at(self, im: ArrayLike, *, extrapolate: _Extrapolate = "refuse") -> _Floats: ...
    def im_at_rate(self, rate_per_year: ArrayLike, *, extrapolate: _Extrapolate = "refuse") -> _Floats: ...
    def in_unit(self, unit: str, *, gravity_m_s2: float = 9.80665) -> HazardCurve: ...
    def to_csv(self) -> str: ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class ExportedCurve:
    @property
    def curve(self) -> HazardCurve: ...
    @property
    def site(self) -> str | None: ...
    @property
    def longitude_deg(self) -> float: ...
    @property
    def latitude_deg(self) -> float: ...
    @property
    def distance_km(self) -> float | None: ...
    @property
    def statistic(self) -> str: ...
    @property
    def investigation_years(self) -> float | None: ...
    @property
    def vs30_m_s(self) -> float | None: ...

def read_hazard_export(
    path: _Path, *, site: str | None = None, near: tuple[float, float] | None = None
) -> list[ExportedCurve]: ...
def fragility(edp_m: ArrayLike, levels: ArrayLike, thresholds_m: ArrayLike) -> _Floats: ...
def risk_curve(
    edp_m: ArrayLike,
    levels: ArrayLike,
    hazard: HazardCurve | Iterable[HazardCurve],
    thresholds_m: ArrayLike | None = None,
    *,
    extrapolate: _Extrapolate = "refuse",
    gravity_m_s2: float = 9.80665,
) -> _Floats: ...
@final
class Spectra:
    @property
    def u_m(self) -> _Floats: ...
    @property
    def flag(self) -> NDArray[np.uint8]: ...
    @property
    def lower_tail_share(self) -> _Floats: ...
    @property
    def upper_tail_share(self) -> _Floats: ...

def urs(
    edp_m: ArrayLike,
    levels: ArrayLike,
    hazard: HazardCurve | Iterable[HazardCurve],
    poe: ArrayLike = (0.02, 0.1, 0.5),
    years: float = 50.0,
    *,
    contour: _Contour = "exact",
    extrapolate: _Extrapolate = "refuse",
    gravity_m_s2: float = 9.80665,
) -> Spectra: ...
@final
class Bands:
    @property
    def lower_m(self) -> _Floats: ...
    @property
    def median_m(self) -> _Floats: ...
    @property
    def upper_m(self) -> _Floats: ...
    @property
    def sample_size(self) -> list[int]: ...

def bootstrap(
    edp_m: ArrayLike,
    levels: ArrayLike,
    hazard: HazardCurve | Iterable[HazardCurve],
    poe: ArrayLike = (0.02, 0.1, 0.5),
    years: float = 50.0,
    *,
    sizes: Sequence[int] | None = None,
    replicates: int = 1000,
    confidence: float = 0.9,
    interval: Literal["percentile", "bca"] = "percentile",
    seed: int = 1,
    extrapolate: _Extrapolate = "refuse",
    gravity_m_s2: float = 9.80665,
) -> Bands: ...
@final
class Fit:
    @property
    def c0_m(self) -> float: ...
    @property
    def c1(self) -> float: ...
    @property
    def c2_m(self) -> float: ...
    @property
    def rmse_m(self) -> float: ...
    @property
    def rmse_plain_m(self) -> float: ...
    @property
    def max_abs_residual_m(self) -> float: ...
    @property
    def max_abs_residual_strength(self) -> float: ...
    @property
    def bound_active(self) -> bool: ...
    @property
    def at_search_limit(self) -> bool: ...
    @property
    def points(self) -> int: ...
    def at(self, strength: ArrayLike) -> _Floats: ...

def fit(strengths: ArrayLike, u_m: ArrayLike, *, strength_above: float = 0.05) -> Fit: ...
