//! One set scaled to one measure at one site, with the hazard of both measures.

use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_risk::{PooledDemand, RiskCurve, RunWeights, StripeWeights};

use crate::{ConsistencyError, RateRange, RecordSet};

/// The set scaled to the stripes of x at a site, and what hazard of y it implies.
///
/// Record j at stripe i brings `y_ij = x_i q_j`; a run is one record at one stripe. Where the stripes have records of
/// their own ([`RecordSet::at_level`]), q is that of the record with its factor there.
#[derive(Debug, Clone)]
pub struct ScaledAnalysis<'a> {
    set: &'a RecordSet,
    other: &'a HazardCurve,
    levels: Vec<f64>,
    stripes: StripeWeights,
    range: RateRange,
    targets: Vec<Target>,
    /// All `y_ij`, in place of displacements.
    brought: PooledDemand,
}

/// A target rate, and where it lies among the stripes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// The rate, 1/yr.
    pub rate_per_year: f64,
    /// The site's level of x at this rate; the first or the last of its curve where this does not reach the rate.
    pub level: f64,
    /// The stripe nearest to that level, in logarithms.
    pub stripe: usize,
    /// The site's level of y at this rate; none where the curve of y does not reach it.
    pub site_level: Option<f64>,
}

impl<'a> ScaledAnalysis<'a> {
    /// Puts records and hazard together.
    ///
    /// - `set`: the records, with x and y in the units of the curves.
    /// - `levels`: stripe levels of x, strictly increasing, `[level]`.
    /// - `scaled_to`, `other`: the site's hazard of x and of y.
    /// - `targets_per_year`: target rates, 1/yr, `[target]`.
    /// - `extrapolation`: what to do with a stripe outside the curve of x, as for the analysis itself.
    ///
    /// # Errors
    /// Levels that do not rise; a stripe outside the curve of x under [`Extrapolation::Refuse`]; a record whose y at a
    /// stripe is no number any more; no target, or one that is not positive and finite; more than 65 535 records or
    /// levels; records of other levels.
    pub fn new(
        set: &'a RecordSet,
        levels: &[f64],
        scaled_to: &HazardCurve,
        other: &'a HazardCurve,
        targets_per_year: &[f64],
        extrapolation: Extrapolation,
    ) -> Result<Self, ConsistencyError> {
        let stripes = StripeWeights::from_hazard(scaled_to, levels, extrapolation)?;
        if let Some(sets) = set.level_sets().filter(|sets| sets.level_count() != levels.len()) {
            let (found, expected) = (sets.level_count(), levels.len());
            return Err(ConsistencyError::Count { what: "levels with records of their own", found, expected });
        }
        let mut brought = Vec::with_capacity(set.len() * levels.len());
        for record in 0..set.len() {
            for (stripe, &level) in levels.iter().enumerate() {
                let value = set.brought(level, set.ratios_at(stripe)[record]);
                if set.belongs(stripe, record) && !value.is_normal() {
                    return Err(ConsistencyError::Intensity { record, what: "other intensity at a stripe", value });
                }
                brought.push(value);
            }
        }
        let runs = Stripes::with_shares(levels, &brought, (set.len(), levels.len()), set.shares())?;
        let brought = PooledDemand::new(&runs)?;
        let range = RateRange::new(targets_per_year, &stripes, other)?;
        let target = |&rate_per_year: &f64| {
            let beyond = if rate_per_year > scaled_to.first().maf { scaled_to.first() } else { scaled_to.last() };
            let level = scaled_to.im_at_rate(rate_per_year).unwrap_or(beyond.im);
            let distance = |stripe: &usize| (levels[*stripe] / level).ln().abs();
            let stripe = (0..levels.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
            Target { rate_per_year, level, stripe, site_level: other.im_at_rate(rate_per_year).ok() }
        };
        let targets = targets_per_year.iter().map(target).collect();
        Ok(Self { set, other, levels: levels.to_vec(), stripes, range, targets, brought })
    }

    /// The records.
    pub fn set(&self) -> &'a RecordSet {
        self.set
    }

    /// Stripe levels x, `[level]`.
    pub fn levels(&self) -> &[f64] {
        &self.levels
    }

    /// What the hazard of x makes of each stripe.
    pub fn stripes(&self) -> &StripeWeights {
        &self.stripes
    }

    /// The site's hazard of y.
    pub fn other(&self) -> &'a HazardCurve {
        self.other
    }

    /// The range of rates in which the hazard of y can be compared.
    pub fn range(&self) -> &RateRange {
        &self.range
    }

    /// The target rates, in the order given.
    pub fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// The site's level of x at a rate within the range, on straight lines of logarithms between the stripes.
    pub(crate) fn scaled_level(&self, rate_per_year: f64) -> f64 {
        let rates = self.stripes.rates_per_year();
        let at = rates.partition_point(|rate| *rate > rate_per_year).clamp(1, rates.len().max(2) - 1);
        let [low, high] = [at - 1, at.min(rates.len() - 1)];
        if rates[low] <= rates[high] {
            return self.levels[low];
        }
        let share = (rates[low] / rate_per_year).ln() / (rates[low] / rates[high]).ln();
        self.levels[low] * (self.levels[high] / self.levels[low]).powf(share)
    }

    /// Whether stripe `level` lies in the range: `ρ_low ≤ λ_x(x_i) ≤ ρ_high`.
    pub fn is_in_range(&self, level: usize) -> bool {
        self.range.contains(self.stripes.rates_per_year()[level])
    }

    /// The shares of the records as they are, `[level, record]`: those of their level, else 1/N.
    pub fn own_shares(&self) -> Vec<f64> {
        let even = || vec![1.0 / self.set.len() as f64; self.levels.len() * self.set.len()];
        self.set.shares().map_or_else(even, <[f64]>::to_vec)
    }

    /// The implied hazard `λ̂_y(c) = Σ w_i Σ_j p_ij 1[y_ij > c]`, with y in place of a displacement: of records that
    /// count as they are, or with `weights`.
    ///
    /// # Errors
    /// Weights of another number of levels or records.
    pub fn implied<'b>(&'b self, weights: Option<&'b RunWeights>) -> Result<RiskCurve<'b>, ConsistencyError> {
        Ok(match weights {
            None => RiskCurve::new(&self.brought, &self.stripes)?,
            Some(weights) => RiskCurve::weighted(&self.brought, weights)?,
        })
    }
}
