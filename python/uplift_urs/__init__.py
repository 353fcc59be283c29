"""Uniform risk spectra for rocking structures.

The science in memory: records and hazard curves, the oscillator that uplifts, incremental dynamic analysis, fragility,
risk and the spectra themselves, structures and frames, as arrays of numpy. Studies: `run` and `open_result`, whose
results are datasets of xarray. Names, defaults and units are those of the study file; the numbers are those of the
program ``uplift``, to the bit.

>>> import uplift_urs as uplift
>>> record = uplift.read_record("SYN001_H1.AT2")
>>> uplift.respond(record, strength=0.2, scale=1.5).peak_displacement_m
>>> result = uplift.run("study.toml")
>>> result.urs.u_m.sel(site="Athens", poe=0.02)
"""

from ._figure import Figure
from ._groups import Arrays
from ._library import Library, library
from ._native import (
    Bands,
    Block,
    BlockResponses,
    Consistency,
    Design,
    ExportedCurve,
    Fit,
    FrameHistory,
    FrameResponse,
    HazardCurve,
    History,
    Overturning,
    Pushover,
    Record,
    Response,
    Responses,
    Spectra,
    Structure,
    Validation,
    __version__,
    bootstrap,
    consistency,
    design,
    fit,
    fragility,
    ida,
    overturning,
    read_hazard_export,
    read_record,
    read_records,
    respond,
    respond_frame,
    risk_curve,
    urs,
    validate,
)
from ._program import Cancelled, Event, Mistake, StudyError, UpliftWarning, find_program
from ._result import Result, open_result
from ._structures import structure
from ._studies import check, run
from ._sweep import Sweep, sweep

__all__ = [
    "Arrays",
    "Bands",
    "Block",
    "BlockResponses",
    "Cancelled",
    "Consistency",
    "Design",
    "Event",
    "ExportedCurve",
    "Figure",
    "Fit",
    "FrameHistory",
    "FrameResponse",
    "HazardCurve",
    "History",
    "Library",
    "Mistake",
    "Overturning",
    "Pushover",
    "Record",
    "Response",
    "Responses",
    "Result",
    "Spectra",
    "Structure",
    "StudyError",
    "Sweep",
    "UpliftWarning",
    "Validation",
    "__version__",
    "bootstrap",
    "check",
    "consistency",
    "design",
    "find_program",
    "fit",
    "fragility",
    "ida",
    "library",
    "open_result",
    "overturning",
    "read_hazard_export",
    "read_record",
    "read_records",
    "respond",
    "respond_frame",
    "risk_curve",
    "run",
    "structure",
    "sweep",
    "urs",
    "validate",
]
