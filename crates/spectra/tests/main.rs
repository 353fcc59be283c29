//! Displacement spectra against single runs, hand solutions, limits where systems must meet, and real records.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod displacements;
mod limits;
mod real_records;
