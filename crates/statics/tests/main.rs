//! What the crate promises.

mod discs;
mod energy;
mod hand_solutions;
mod misuse;
mod printed;
mod reference_cases;
