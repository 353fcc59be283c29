//! How sure the numbers of a structure are, as so many records tell them (docs/method.md, section 9).

use serde::Serialize;
use uplift_bootstrap::{inferred_limits, inferred_rate};
use uplift_risk::{PooledDemand, StripeWeights};

use super::risk::OVERTURNING_M;
use crate::consistency::Question;
use crate::error::UpliftError;
use crate::result::ResultFile;

/// How often a band is to hold the number of all records there could be.
pub(super) const CONFIDENCE: f64 = 0.9;

/// What scatters: the positions of the records of each unit.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scatter {
    /// Those of each pair: its analysed components, or what is seen of it from each azimuth.
    pub(super) pairs: Vec<Vec<usize>>,
    /// Those of each earthquake. None where no two pairs are known to share one.
    pub(super) earthquakes: Option<Vec<Vec<usize>>>,
}

impl Scatter {
    /// Of the records of a result.
    ///
    /// # Errors
    /// A file that is damaged.
    pub(super) fn of(file: &ResultFile) -> Result<Self, UpliftError> {
        let motions = Question::of_motions(file)?;
        let event_of = motions.event_of();
        // two components of a pair are not independent
        let pairs = uplift_bootstrap::units(&motions.pair_of());
        let earthquakes = file.shares_earthquakes()?.then(|| uplift_bootstrap::units(&event_of));
        Ok(Self { pairs, earthquakes })
    }
}

/// 90 % bands of a frequency, 1/yr: from where to where it is by all records like those at hand; none where no run
/// shows it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RateBands {
    /// As the records tell it, one by one.
    pub by_record: [f64; 2],
    /// As their earthquakes tell it; none where no two pairs are known to share one.
    pub by_earthquake: Option<[f64; 2]>,
}

/// 90 % bands of the demand on a structure and of its risks, by all records like those at hand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DemandBands {
    /// Records; pairs where both components are analysed.
    pub records: usize,
    /// Their earthquakes; none where no two pairs are known to share one.
    pub earthquakes: Option<usize>,
    /// Demand on the structure as the records tell it, m; infinite where overturning leaves none.
    pub demand_by_record_m: [f64; 2],
    /// The same as their earthquakes tell it.
    pub demand_by_earthquake_m: Option<[f64; 2]>,
    /// Frequency of exceeding the capacity; none without one, and where no run shows it.
    pub beyond_capacity_per_year: Option<RateBands>,
    /// Frequency of overturning; none where no run shows it.
    pub overturning_per_year: Option<RateBands>,
}

/// The bands of the rate of exceeding `threshold_m`; none where there is nothing to tell it from.
///
/// # Errors
/// Parts that do not belong together.
pub(super) fn rate_bands(
    demand: &PooledDemand,
    weights: &StripeWeights,
    scatter: &Scatter,
    threshold_m: f64,
) -> Result<Option<RateBands>, UpliftError> {
    let of = |units: &Vec<Vec<usize>>| inferred_rate(demand, weights, units, (threshold_m, CONFIDENCE));
    let by_record = of(&scatter.pairs)?;
    let by_earthquake = scatter.earthquakes.as_ref().map(of).transpose()?.filter(|band| !band[1].is_nan());
    // NaN of a single record
    Ok((by_record[1] > 0.0).then_some(RateBands { by_record, by_earthquake }))
}

/// The bands of the demand of `target_per_year` on a structure, `factor` times that on its oscillator, and of its
/// risks; none of a single record.
///
/// # Errors
/// Parts that do not belong together.
pub(super) fn demand_bands(
    demand: &PooledDemand,
    weights: &StripeWeights,
    scatter: &Scatter,
    (target_per_year, factor, capacity_m): (f64, f64, Option<f64>),
) -> Result<Option<DemandBands>, UpliftError> {
    let of = |units: &Vec<Vec<usize>>| -> Result<Option<[f64; 2]>, UpliftError> {
        let found = inferred_limits(demand, weights, units, &[target_per_year], (&[units.len()], CONFIDENCE))?;
        Ok(found.first().map(|own| own.truth_m.map(|limit_m| factor * limit_m)).filter(|band| !band[1].is_nan()))
    };
    let Some(demand_by_record_m) = of(&scatter.pairs)? else { return Ok(None) };
    let rate = |threshold_m: f64| rate_bands(demand, weights, scatter, threshold_m);
    Ok(Some(DemandBands {
        records: scatter.pairs.len(),
        earthquakes: scatter.earthquakes.as_ref().map(Vec::len),
        demand_by_record_m,
        demand_by_earthquake_m: scatter.earthquakes.as_ref().map(of).transpose()?.flatten(),
        beyond_capacity_per_year: capacity_m.map(rate).transpose()?.flatten(),
        overturning_per_year: rate(OVERTURNING_M)?,
    }))
}
