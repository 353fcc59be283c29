//! Displacement spectra against single runs, hand solutions, limits where systems must meet, and real records.

mod displacements;
mod limits;
mod real_records;
