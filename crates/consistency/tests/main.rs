//! Diagnosis and repair of whole record sets: against numbers of an independent prototype, and against what must hold
//! of any set.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod common;
mod expected;
mod golden;
mod level_sets;
mod properties;
mod real_records;
mod synthetic_records;
mod twin_world;
