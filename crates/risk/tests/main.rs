//! Risk curves against plain sums, weighted runs, and risk-targeted ground motions.
#![allow(clippy::unwrap_used)]

mod risk_curve;
mod rtgm;
mod run_weights;
