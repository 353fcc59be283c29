//! Risk curves against plain sums, weighted runs, and risk-targeted ground motions.

mod risk_curve;
mod rtgm;
mod run_weights;
