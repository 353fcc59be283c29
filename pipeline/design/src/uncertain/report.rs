//! The report on an uncertain structure.

use serde::Serialize;
use uplift_fragility::quantile;
use uplift_result::FRACTILES;
use uplift_study::Uncertainty;

/// The risk of a structure of which not all is known exactly.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UncertaintyReport {
    /// `epistemic`, branches with a band; or `aleatory`, structures of each record with one risk.
    pub kind: &'static str,
    /// `sobol` or `latin-hypercube`.
    pub sampling: &'static str,
    /// Where the random numbers began.
    pub seed: u64,
    /// Structures that were shaken.
    pub structures: usize,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// What is not known exactly.
    pub quantities: Vec<QuantityReport>,
    /// What follows, one a measure, site and question.
    pub results: Vec<UncertainResult>,
}

/// A quantity that is not known exactly.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct QuantityReport {
    /// Its key.
    pub quantity: &'static str,
    /// Its name in words.
    #[serde(skip)]
    pub name: &'static str,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// `lognormal`, `normal`, `uniform`, `triangular`, or `known` where it does not scatter.
    pub distribution: &'static str,
    /// Its 5, 16, 50, 84 and 95 % percentiles.
    pub percentiles: [f64; 5],
    /// Share of the distribution that was cut off where the quantity cannot be.
    pub cut_off_share: f64,
    /// The quantities that it is correlated with, directly or through others.
    pub correlated_with: Vec<&'static str>,
}

impl QuantityReport {
    /// Those of `of`.
    pub(crate) fn all(of: &Uncertainty) -> Vec<Self> {
        let report = |(place, quantity): (usize, &uplift_structure::UncertainQuantity)| {
            let distribution = &of.vector.distributions()[place];
            let group = of.vector.copula().groups().iter().find(|group| group.contains(&place));
            let others = group.into_iter().flatten().filter(|other| **other != place);
            Self {
                quantity: quantity.key(),
                name: quantity.name(),
                unit: quantity.range().unit,
                distribution: distribution.family().map_or("known", uplift_uncertainty::Family::key),
                percentiles: FRACTILES.map(|share| distribution.quantile(share)),
                cut_off_share: distribution.cut_off_share(),
                correlated_with: others.map(|&other| of.quantities[other].key()).collect(),
            }
        };
        of.quantities.iter().enumerate().map(report).collect()
    }
}

/// One answer for an uncertain structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UncertainResult {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// `overturning`, `exceeding the capacity` or `demand`.
    pub of: &'static str,
    /// `1/yr` of a frequency, `m` of a demand.
    pub unit: &'static str,
    /// The same for the structure as its file describes it.
    pub as_described: f64,
    /// Where no run of the structure as described shows it: what that frequency is at most, 1/yr.
    pub as_described_at_most_per_year: Option<f64>,
    /// What the structures that it may be say.
    #[serde(flatten)]
    pub found: UncertainFinding,
}

/// What the structures that one may be say.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum UncertainFinding {
    /// Branches: a band.
    Epistemic(EpistemicResult),
    /// Structures of each record: one number.
    Aleatory(AleatoryResult),
}

impl UncertainFinding {
    /// The answer: the mean of the branches, with all records and the mean hazard; or the one of structures of each
    /// record.
    pub(crate) fn mean(&self) -> f64 {
        match self {
            Self::Epistemic(found) => found.by_structure.mean,
            Self::Aleatory(found) => found.value,
        }
    }

    /// What that is at most where no run shows it, 1/yr.
    pub(crate) fn at_most_per_year(&self) -> Option<f64> {
        match self {
            Self::Epistemic(found) => found.by_structure.at_most_per_year,
            Self::Aleatory(found) => found.at_most_per_year,
        }
    }

    /// That of branches.
    pub(crate) fn epistemic(&self) -> Option<&EpistemicResult> {
        if let Self::Epistemic(found) = self { Some(found) } else { None }
    }

    /// That of structures of each record.
    pub(crate) fn aleatory(&self) -> Option<&AleatoryResult> {
        if let Self::Aleatory(found) = self { Some(found) } else { None }
    }

    /// The same of what may happen so often, 1/yr, where no run shows it: a count of none is no proof of never.
    pub(super) fn bounded(self, at_most_per_year: Option<f64>) -> Self {
        let bound = |value: f64| at_most_per_year.filter(|_| value == 0.0);
        match self {
            Self::Epistemic(found) => {
                let of = |spread: Spread| Spread { at_most_per_year: bound(spread.mean), ..spread };
                let (by_structure, by_all) = (of(found.by_structure), of(found.by_all));
                Self::Epistemic(EpistemicResult { by_structure, by_all, ..found })
            }
            Self::Aleatory(found) => Self::Aleatory(AleatoryResult { at_most_per_year: bound(found.value), ..found }),
        }
    }
}

/// The answers of branches, and what their scatter owes to what.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EpistemicResult {
    /// By what is not known of the structure alone: all records, the mean hazard.
    pub by_structure: Spread,
    /// By that, by records drawn again, and by the branches of the hazard where there are some.
    pub by_all: Spread,
    /// What that scatter owes to what, the most first.
    pub shares: Vec<VarianceShare>,
    /// Why there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_shares: Option<String>,
}

/// Names of the percentiles of what is not known exactly, in their order.
pub(crate) const PERCENTILES: [&str; 5] = ["p05", "p16", "p50", "p84", "p95"];

/// Mean and percentiles of answers; infinite where structures overturn more often than a demand allows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// Where no run shows what is counted: what the mean is at most, 1/yr (docs/method.md, section 17). None where some
    /// run does, of a demand, and where it cannot happen.
    pub at_most_per_year: Option<f64>,
    /// The 5, 16, 50, 84 and 95 % percentiles.
    pub percentiles: [f64; 5],
}

impl Spread {
    /// Of `values`, at least one.
    pub(crate) fn from_values(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let percentiles = FRACTILES.map(|share| quantile(&values, share));
        // values that are all alike have themselves as their mean, to the bit
        let mean = match (values.first(), values.last()) {
            (Some(first), Some(last)) if first == last => *first,
            _ => values.iter().sum::<f64>() / values.len() as f64,
        };
        Self { mean, at_most_per_year: None, percentiles }
    }
}

/// The share of a variance that one factor makes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VarianceShare {
    /// The factor: quantities that are correlated are one, `records`, `hazard`.
    pub factor: String,
    /// What would go, on average, if it were known: Sobol' index of first order.
    pub first_order: f64,
    /// Its standard error.
    pub first_order_error: f64,
    /// What would stay, on average, if all else were known: the total index.
    pub total: f64,
    /// Its standard error.
    pub total_error: f64,
}

/// The answer for structures of each record.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AleatoryResult {
    /// The answer.
    pub value: f64,
    /// Where no run shows what is counted: what the answer is at most, 1/yr (docs/method.md, section 17). None where
    /// some run does, of a demand, and where it cannot happen.
    pub at_most_per_year: Option<f64>,
    /// Its 90 % band by the records; none where no run shows it, and of a single record.
    pub by_record: Option<[f64; 2]>,
    /// The same as their earthquakes tell it; none where no two pairs are known to share one.
    pub by_earthquake: Option<[f64; 2]>,
    /// The same as their earthquakes (the records, where none are known to share one) and the weighted hazard curves of
    /// the site tell it; none where it has but one.
    pub with_hazard: Option<[f64; 2]>,
}
