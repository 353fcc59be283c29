//! The rigid block against exact cases, invariants and an independent integration.

mod free_rocking;
mod independent;
mod invariants;
mod oracle;
mod pulses;
