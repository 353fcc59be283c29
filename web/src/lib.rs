//! The science of uplift in a browser: the module behind the page of `make web`.
//!
//! The page asks questions in JSON, some with a file, and gets JSON: `{"answer": …}`, or `{"error": "…"}` with the
//! message of the crate that refused. A number that is not finite is `null`. Nothing is computed in JavaScript.
//!
//! | module | what is in it |
//! |---|---|
//! | `abi` | the functions that the page calls |
//! | `calculator` | the questions |
//! | `stripes` | what `uplift export --web` wrote |
//! | `reading` | the spectra read off it |
//! | `curves` | hazard curves that are dropped or pasted |
//! | `motions` | the embedded records, and record files that are dropped |
//! | `structure` | a structure held against a spectrum, and its motion |
//! | `analysis` | many runs, a record at a time, so that the page can show progress and stop |
//! | `studies` | the study file that gives the same spectrum |

mod abi;
mod analysis;
mod calculator;
mod curves;
mod motions;
mod reading;
mod stripes;
mod structure;
mod studies;

pub use calculator::Calculator;
