//! What every table of risks has of a risk.

use uplift_uniform_risk::EventRisk;

/// A column: its name, and its cell.
type RiskColumn = (&'static str, fn(&EventRisk) -> Option<f64>);

/// How often something happens.
pub(super) const FREQUENCIES: [RiskColumn; 2] = [
    ("maf_per_year", |risk| Some(risk.per_year)),
    // where no run shows it, the frequency that it has at most: a count of none is no proof of never
    ("at_most_per_year", |risk| risk.at_most_per_year),
];

/// How much of it comes from outside the levels.
pub(super) const TAIL_SHARES: [RiskColumn; 2] = [
    ("lower_tail_share", |risk| Some(risk.lower_tail_share)),
    ("upper_tail_share", |risk| Some(risk.upper_tail_share)),
];
