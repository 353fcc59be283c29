//! How sure the numbers of a structure are, as so many records tell them (docs/method.md, section 9).

use serde::Serialize;
use uplift_bootstrap::{inferred_limits, inferred_limits_over_curves, inferred_rate, inferred_rate_over_curves};
use uplift_risk::PooledDemand;

use super::hazard::Hazard;
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

    /// Those of each earthquake where they are known, else of each pair.
    pub(super) fn widest(&self) -> &[Vec<usize>] {
        self.earthquakes.as_ref().unwrap_or(&self.pairs)
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
    /// As their earthquakes (the records, where none are known to share one) and the weighted hazard curves of the site
    /// tell it; none where it has but one.
    pub with_hazard: Option<[f64; 2]>,
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
    /// Weighted hazard curves of the site; none where it has but one.
    pub hazard_curves: Option<usize>,
    /// Demand on the structure as their earthquakes (the records, where none are known to share one) and the hazard
    /// curves tell it, m.
    pub demand_with_hazard_m: Option<[f64; 2]>,
    /// Displacement capacity less the demand, m, by the bands above; none of a structure without one.
    pub margin: Option<MarginBands>,
    /// Frequency of exceeding the capacity; none without one, and where no run shows it.
    pub beyond_capacity_per_year: Option<RateBands>,
    /// Frequency of overturning; none where no run shows it.
    pub overturning_per_year: Option<RateBands>,
}

/// 90 % bands of the displacement capacity of a structure less the demand on it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MarginBands {
    /// As the records tell it, m; minus infinity where overturning leaves no demand.
    pub by_record_m: [f64; 2],
    /// As their earthquakes tell it; none where no two pairs are known to share one.
    pub by_earthquake_m: Option<[f64; 2]>,
    /// As these and the hazard curves of the site tell it; none where it has but one.
    pub with_hazard_m: Option<[f64; 2]>,
}

/// The bands of the rate of exceeding `threshold_m`; none where there is nothing to tell it from.
///
/// # Errors
/// Parts that do not belong together.
pub(super) fn rate_bands(
    demand: &PooledDemand,
    hazard: &Hazard<'_>,
    scatter: &Scatter,
    threshold_m: f64,
) -> Result<Option<RateBands>, UpliftError> {
    let of = |units: &Vec<Vec<usize>>| inferred_rate(demand, hazard.mean, units, (threshold_m, CONFIDENCE));
    let by_record = of(&scatter.pairs)?;
    // NaN of a single record
    let is_told = |band: &[f64; 2]| !band[1].is_nan();
    let by_earthquake = scatter.earthquakes.as_ref().map(of).transpose()?.filter(is_told);
    let with_hazard = if hazard.branches.is_empty() {
        None
    } else {
        let asked = (threshold_m, CONFIDENCE);
        Some(inferred_rate_over_curves(demand, &hazard.branches, scatter.widest(), asked)?).filter(is_told)
    };
    Ok((by_record[1] > 0.0).then_some(RateBands { by_record, by_earthquake, with_hazard }))
}

/// The bands of the demand of `target_per_year` on a structure, `factor` times that on its oscillator, and of its
/// risks; none of a single record.
///
/// # Errors
/// Parts that do not belong together.
pub(super) fn demand_bands(
    demand: &PooledDemand,
    hazard: &Hazard<'_>,
    scatter: &Scatter,
    (target_per_year, factor, capacity_m): (f64, f64, Option<f64>),
) -> Result<Option<DemandBands>, UpliftError> {
    let told = |limits_m: [f64; 2]| (!limits_m[1].is_nan()).then_some(limits_m.map(|limit_m| factor * limit_m));
    let of = |units: &Vec<Vec<usize>>| -> Result<Option<[f64; 2]>, UpliftError> {
        let found = inferred_limits(demand, hazard.mean, units, &[target_per_year], (&[units.len()], CONFIDENCE))?;
        Ok(found.first().and_then(|own| told(own.truth_m)))
    };
    let Some(demand_by_record_m) = of(&scatter.pairs)? else { return Ok(None) };
    let rate = |threshold_m: f64| rate_bands(demand, hazard, scatter, threshold_m);
    let with_hazard = || {
        let asked = (target_per_year, CONFIDENCE);
        inferred_limits_over_curves(demand, &hazard.branches, scatter.widest(), asked)
    };
    let curves = (!hazard.branches.is_empty()).then_some(hazard.branches.len());
    let demand_by_earthquake_m = scatter.earthquakes.as_ref().map(of).transpose()?.flatten();
    let demand_with_hazard_m = curves.map(|_| with_hazard()).transpose()?.and_then(told);
    // what is left of the capacity is least where the demand is largest
    let left = |capacity_m: f64, [lower_m, upper_m]: [f64; 2]| [upper_m, lower_m].map(|m| factor * capacity_m - m);
    let margin = |capacity_m: f64| MarginBands {
        by_record_m: left(capacity_m, demand_by_record_m),
        by_earthquake_m: demand_by_earthquake_m.map(|limits_m| left(capacity_m, limits_m)),
        with_hazard_m: demand_with_hazard_m.map(|limits_m| left(capacity_m, limits_m)),
    };
    Ok(Some(DemandBands {
        records: scatter.pairs.len(),
        earthquakes: scatter.earthquakes.as_ref().map(Vec::len),
        demand_by_record_m,
        demand_by_earthquake_m,
        hazard_curves: curves,
        demand_with_hazard_m,
        margin: capacity_m.map(margin),
        beyond_capacity_per_year: capacity_m.map(rate).transpose()?.flatten(),
        overturning_per_year: rate(OVERTURNING_M)?,
    }))
}
