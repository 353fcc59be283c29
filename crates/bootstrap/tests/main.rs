//! Bands against the plain way, and how often they hold what they are of.
#![allow(clippy::unwrap_used)]

mod inferred;
mod naive;
