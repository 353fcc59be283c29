//! Bands against the plain way, and how often they hold what they are of.

mod inferred;
mod naive;
