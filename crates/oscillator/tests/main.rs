//! Both solvers against exact cases, invariants and each other.

mod exact_cases;
mod invariants;
mod sweep_against_reference;
