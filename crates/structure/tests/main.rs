//! Structures, their equivalent oscillators and the rules of design.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod description;
mod equivalent;
mod rigid_body;
mod rotating_block;
mod rules;
mod table_3_1;
mod variation;
