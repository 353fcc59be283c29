//! Risk curves against plain sums, and risk-targeted ground motions.

mod risk_curve;
mod rtgm;
