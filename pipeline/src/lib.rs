//! The program `uplift`: study file → stages → result file.

pub mod labelled;
pub mod study;
