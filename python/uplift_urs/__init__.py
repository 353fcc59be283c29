"""Uniform risk spectra for rocking structures: the science in memory.

Records and hazard curves, the oscillator that uplifts, incremental dynamic analysis, fragility, risk and the spectra
themselves, as arrays of numpy. Names, defaults and units are those of the study file; the numbers are those of the
program ``uplift``, to the bit.

>>> import uplift_urs as uplift
>>> record = uplift.read_record("SYN001_H1.AT2")
>>> uplift.respond(record, strength=0.2, scale=1.5).peak_displacement_m
"""

from ._native import (
    Bands,
    ExportedCurve,
    Fit,
    HazardCurve,
    History,
    Record,
    Response,
    Responses,
    Spectra,
    __version__,
    bootstrap,
    fit,
    fragility,
    ida,
    read_hazard_export,
    read_record,
    read_records,
    respond,
    risk_curve,
    urs,
)

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
