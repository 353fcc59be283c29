//! What the crate promises.

mod cyclic;
mod discs;
mod energy;
mod hand_solutions;
mod misuse;
mod printed;
mod selection;
