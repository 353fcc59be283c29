//! The rigid block against exact cases, invariants and an independent integration.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod free_rocking;
mod independent;
mod invariants;
mod oracle;
mod pulses;
