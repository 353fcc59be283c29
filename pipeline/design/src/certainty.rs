//! How sure the numbers of a structure are, as so many records tell them (docs/method.md, section 9).

use serde::Serialize;
use uplift_bootstrap::{
    inferred_limits_over_curves, inferred_rate, inferred_rate_over_curves, is_too_narrow, truth_limits,
};
use uplift_result::ResultFile;
use uplift_risk::{PooledDemand, RunWeights, SiteWeights};
use uplift_uniform_risk::EventRisk;
use uplift_uniform_risk::consistency::Question;

use super::hazard::Hazard;
use super::risk::OVERTURNING_M;
use crate::error::DesignError;

pub(super) use uplift_bootstrap::QUOTED_CONFIDENCE as CONFIDENCE;

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
    pub(super) fn from_file(file: &ResultFile) -> Result<Self, DesignError> {
        let motions = Question::from_motions(file)?;
        let event_of = motions.event_of();
        // two components of a pair are not independent
        let pairs = uplift_bootstrap::units(&motions.pair_of());
        let earthquakes = motions.shares_earthquakes().then(|| uplift_bootstrap::units(&event_of));
        Ok(Self { pairs, earthquakes })
    }

    /// Those of each earthquake where there are several that are known, else of each pair.
    pub(super) fn coarsest(&self) -> &[Vec<usize>] {
        self.earthquakes.as_ref().filter(|earthquakes| earthquakes.len() > 1).unwrap_or(&self.pairs)
    }
}

/// 90 % bands of one number: from where to where it is by all records like those at hand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bands {
    /// As the records tell it, one by one.
    pub by_record: [f64; 2],
    /// As their earthquakes tell it; none where no two pairs are known to share one.
    pub by_earthquake: Option<[f64; 2]>,
    /// As their earthquakes (the records, where none are known to share one) and the weighted hazard curves of the site
    /// tell it: of the number by the curve that holds, not by their mean. None where the site has but one.
    pub with_hazard: Option<[f64; 2]>,
}

impl Bands {
    /// What they are called in names of columns.
    pub(super) const WHOSE: [&str; 3] = ["records", "earthquakes", "hazard"];

    /// By record, by earthquake and with the hazard.
    pub fn each(&self) -> [Option<[f64; 2]>; 3] {
        [Some(self.by_record), self.by_earthquake, self.with_hazard]
    }

    /// The band to quote: by earthquake where by record it is more than a quarter narrower ([`is_too_narrow`]).
    pub fn quoted(&self) -> [f64; 2] {
        self.quoted_by_earthquake().unwrap_or(self.by_record)
    }

    /// What the quoted band is of, as a result keeps it.
    pub fn source(&self) -> &'static str {
        self.words()[usize::from(self.quoted_by_earthquake().is_some())]
    }

    /// What to say behind the quoted band of whom it is; nothing of one by record.
    pub fn by_whom(&self) -> &'static str {
        if self.quoted_by_earthquake().is_some() { " by earthquake" } else { "" }
    }

    fn quoted_by_earthquake(&self) -> Option<[f64; 2]> {
        let width = |[lower, upper]: [f64; 2]| upper - lower;
        self.by_earthquake.filter(|own| is_too_narrow(width(self.by_record), width(*own)))
    }

    /// The band that takes account of most: with the hazard curves where there are several, else the quoted one.
    pub fn fullest(&self) -> [f64; 2] {
        self.with_hazard.unwrap_or_else(|| self.quoted())
    }

    /// What each is of, in words.
    pub(super) fn words(&self) -> [&'static str; 3] {
        let with_hazard = if self.by_earthquake.is_some() { "earthquakes and hazard" } else { "records and hazard" };
        ["records", "earthquakes", with_hazard]
    }

    /// The same of what follows from the number.
    fn map(self, of: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let Self { by_record, by_earthquake, with_hazard } = self;
        Self { by_record: of(by_record), by_earthquake: by_earthquake.map(&of), with_hazard: with_hazard.map(&of) }
    }
}

/// 90 % bands of the demand on a structure and of its risks, by all records like those at hand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DemandBands {
    /// Records; pairs where both components are analysed.
    pub records: usize,
    /// Their earthquakes; none where no two pairs are known to share one.
    pub earthquakes: Option<usize>,
    /// Weighted hazard curves of the site; none where it has but one.
    pub hazard_curves: Option<usize>,
    /// Demand on the structure, m; infinite where overturning leaves none.
    pub demand_m: Bands,
    /// Displacement capacity less the demand, m; minus infinity where overturning leaves no demand. None of a structure
    /// without a capacity.
    pub capacity_less_demand_m: Option<Bands>,
    /// Frequency of exceeding the capacity; none without one, and where no run shows it.
    pub beyond_capacity_per_year: Option<Bands>,
    /// Frequency of overturning; none where no run shows it.
    pub overturning_per_year: Option<Bands>,
}

/// The bands of the rate of exceeding `threshold_m`; none where there is nothing to tell it from. With `repaired`
/// weights they are of the mean hazard curve alone.
pub(super) fn rate_bands(
    demand: &PooledDemand,
    (hazard, repaired): (&Hazard<'_>, Option<&RunWeights>),
    scatter: &Scatter,
    threshold_m: f64,
) -> Result<Option<Bands>, DesignError> {
    let weights = SiteWeights::new(hazard.mean, repaired);
    let of = |units: &Vec<Vec<usize>>| inferred_rate(demand, weights, units, (threshold_m, CONFIDENCE));
    let by_record = of(&scatter.pairs)?;
    // NaN of a single record
    let is_told = |band: &[f64; 2]| !band[1].is_nan();
    let by_earthquake = scatter.earthquakes.as_ref().map(of).transpose()?.filter(is_told);
    // NaN of no curves too
    let asked = (threshold_m, CONFIDENCE);
    let branches = if repaired.is_some() { &[] } else { &hazard.branches[..] };
    let with_hazard = inferred_rate_over_curves(demand, branches, scatter.coarsest(), asked)?;
    let with_hazard = Some(with_hazard).filter(is_told);
    Ok((by_record[1] > 0.0).then_some(Bands { by_record, by_earthquake, with_hazard }))
}

/// The upper limit of a rate with such bands, 1/yr; of what no run shows its bound, and of a single record the rate.
pub(super) fn upper_per_year(risk: &EventRisk, bands: Option<Bands>) -> f64 {
    let limit = risk.at_most_per_year.or_else(|| Some(bands?.fullest()[1]));
    limit.unwrap_or(risk.per_year)
}

/// The bands of the demand of `target_per_year` on an oscillator or a frame, m, by record and by earthquake; none of a
/// single record.
pub(super) fn record_bands(
    demand: &PooledDemand,
    weights: SiteWeights<'_>,
    scatter: &Scatter,
    (target_per_year, confidence): (f64, f64),
) -> Result<Option<Bands>, DesignError> {
    let of = |units: &Vec<Vec<usize>>| -> Result<Option<[f64; 2]>, DesignError> {
        let found = truth_limits(demand, weights, units, &[target_per_year], confidence)?;
        Ok(found.first().copied().filter(|limits_m| !limits_m[1].is_nan()))
    };
    let Some(by_record) = of(&scatter.pairs)? else { return Ok(None) };
    let by_earthquake = scatter.earthquakes.as_ref().map(of).transpose()?.flatten();
    Ok(Some(Bands { by_record, by_earthquake, with_hazard: None }))
}

/// The bands of the demand of `target_per_year` on a structure, `factor` times that on its oscillator, and of its
/// risks; none of a single record. With `repaired` weights they are of the mean hazard curve alone.
pub(super) fn demand_bands(
    demand: &PooledDemand,
    (hazard, repaired): (&Hazard<'_>, Option<&RunWeights>),
    scatter: &Scatter,
    (target_per_year, factor, capacity_m): (f64, f64, Option<f64>),
) -> Result<Option<DemandBands>, DesignError> {
    let asked = (target_per_year, CONFIDENCE);
    let weights = SiteWeights::new(hazard.mean, repaired);
    let Some(of_records) = record_bands(demand, weights, scatter, asked)? else { return Ok(None) };
    let branches = if repaired.is_some() { &[] } else { &hazard.branches[..] };
    let with_hazard = inferred_limits_over_curves(demand, branches, scatter.coarsest(), asked)?;
    let with_hazard = (!with_hazard[1].is_nan()).then_some(with_hazard);
    let demand_m = Bands { with_hazard, ..of_records }.map(|limits_m| limits_m.map(|limit_m| factor * limit_m));
    // what is left of the capacity is least where the demand is largest
    let left = |capacity_m: f64| demand_m.map(|[lower_m, upper_m]| [upper_m, lower_m].map(|m| factor * capacity_m - m));
    let rate = |threshold_m: f64| rate_bands(demand, (hazard, repaired), scatter, threshold_m);
    Ok(Some(DemandBands {
        records: scatter.pairs.len(),
        earthquakes: scatter.earthquakes.as_ref().map(Vec::len),
        hazard_curves: (!branches.is_empty()).then_some(branches.len()),
        demand_m,
        capacity_less_demand_m: capacity_m.map(left),
        beyond_capacity_per_year: capacity_m.map(rate).transpose()?.flatten(),
        overturning_per_year: rate(OVERTURNING_M)?,
    }))
}

#[cfg(test)]
mod tests {
    use super::Bands;

    #[test]
    fn a_band_says_whose_it_is_where_it_is_quoted_by_earthquake() {
        let bands = |by_earthquake| Bands { by_record: [1.0, 2.0], by_earthquake, with_hazard: None };
        for (by_earthquake, quoted, words) in [
            (None, [1.0, 2.0], ""),
            (Some([0.9, 2.1]), [1.0, 2.0], ""),
            (Some([0.5, 2.5]), [0.5, 2.5], " by earthquake"),
        ] {
            assert_eq!((bands(by_earthquake).quoted(), bands(by_earthquake).by_whom()), (quoted, words));
        }
    }
}
