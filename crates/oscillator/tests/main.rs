//! Both solvers against exact cases, invariants and each other.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod exact_cases;
mod invariants;
mod sweep_against_reference;
