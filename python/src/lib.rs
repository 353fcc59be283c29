//! The science of uplift in memory, for Python: the extension behind the package `uplift_urs`.
//!
//! Every function takes Python's values apart, checks them, calls one of the science crates without the interpreter's
//! lock, and hands arrays back. What Python sees, with units, shapes and errors, is described in
//! `uplift_urs/_native.pyi` and in the documentation of each function, which `help()` shows.
//!
//! | module | what is in it |
//! |---|---|
//! | `floats` | what Python gives as numbers: scalars, lists, arrays of any kind |
//! | `errors` | what the crates refuse, as `ValueError` or `OSError` |
//! | `cores` | work on all cores that Ctrl-C ends |
//! | `record` | records, read or from arrays |
//! | `oscillator` | the numbers of oscillators, checked together |
//! | `response`, `respond` | one record through any number of oscillators |
//! | `ida` | records, strengths and levels |
//! | `hazard`, `export` | hazard curves, and files of many |
//! | `demand` | displacements that are handed over, as stripes |
//! | `sites` | the hazard of sites, met by demands |
//! | `risk` | fragility, risk curves, uniform risk spectra |
//! | `bootstrap` | confidence bands |
//! | `regression` | Eq. 4.11 |
//! | `consistency` | the hazard that scaled records bring, and weights |
//! | `structure`, `design` | structures as their files have them, their statics, the rules of design |
//! | `overturning` | how often what was analysed overturns |
//! | `block`, `frame` | the rigid block of Chapter 2, the rocking frame of Chapter 6 |
//! | `validation` | measured and computed peaks |

// pyo3 hands Python's objects over by value
#![allow(clippy::needless_pass_by_value)]

mod block;
mod bootstrap;
mod consistency;
mod cores;
mod demand;
mod design;
mod errors;
mod export;
mod floats;
mod frame;
mod hazard;
mod ida;
mod oscillator;
mod overturning;
mod record;
mod regression;
mod respond;
mod response;
mod risk;
mod sites;
mod structure;
mod validation;

use pyo3::prelude::*;

/// Uniform risk spectra for rocking structures: the science in memory.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<record::Record>()?;
    module.add_class::<response::Response>()?;
    module.add_class::<response::Responses>()?;
    module.add_class::<response::History>()?;
    module.add_class::<hazard::HazardCurve>()?;
    module.add_class::<export::ExportedCurve>()?;
    module.add_class::<risk::Spectra>()?;
    module.add_class::<bootstrap::Bands>()?;
    module.add_class::<regression::Fit>()?;
    module.add_class::<consistency::Consistency>()?;
    module.add_class::<structure::Structure>()?;
    module.add_class::<structure::Pushover>()?;
    module.add_class::<design::Design>()?;
    module.add_class::<overturning::Overturning>()?;
    module.add_class::<block::Block>()?;
    module.add_class::<block::BlockResponses>()?;
    module.add_class::<frame::FrameResponse>()?;
    module.add_class::<frame::FrameHistory>()?;
    module.add_class::<validation::Validation>()?;
    module.add_function(wrap_pyfunction!(consistency::consistency, module)?)?;
    module.add_function(wrap_pyfunction!(design::design, module)?)?;
    module.add_function(wrap_pyfunction!(overturning::overturning, module)?)?;
    module.add_function(wrap_pyfunction!(frame::respond_frame, module)?)?;
    module.add_function(wrap_pyfunction!(validation::validate, module)?)?;
    module.add_function(wrap_pyfunction!(record::read_record, module)?)?;
    module.add_function(wrap_pyfunction!(record::read_records, module)?)?;
    module.add_function(wrap_pyfunction!(respond::respond, module)?)?;
    module.add_function(wrap_pyfunction!(ida::ida, module)?)?;
    module.add_function(wrap_pyfunction!(export::read_hazard_export, module)?)?;
    module.add_function(wrap_pyfunction!(risk::fragility, module)?)?;
    module.add_function(wrap_pyfunction!(risk::risk_curve, module)?)?;
    module.add_function(wrap_pyfunction!(risk::urs, module)?)?;
    module.add_function(wrap_pyfunction!(bootstrap::bootstrap, module)?)?;
    module.add_function(wrap_pyfunction!(regression::fit, module)?)
}
