//! What the crate promises.
#![allow(clippy::unwrap_used)]

mod cyclic;
mod discs;
mod energy;
mod hand_solutions;
mod misuse;
mod printed;
mod selection;
