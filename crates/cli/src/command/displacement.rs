//! `uplift check`, `run` and `table` for displacement spectra of record sets.

mod check;
mod run;
mod table;

pub(super) use check::check;
pub(super) use run::run;
pub(super) use table::table;
