//! The fit against tables, brute force and invariants.

mod fit;
mod properties;
