//! Structures of each record: what differs from one to the next is part of the fragility, and there is one risk.

use std::path::Path;

use uplift_fragility::Stripes as Stripe;
use uplift_ida::System;
use uplift_job::JobError;
use uplift_risk::{PooledDemand, RiskCurve};
use uplift_study::Uncertainty;
use uplift_uncertainty::unit_cube;
use uplift_uniform_risk::Stripes;

use super::question::{Event, SiteQuestions};
use super::report::{AleatoryResult, UncertainFinding};
use crate::certainty::{Bands, Scatter, demand_bands, rate_bands};
use crate::error::DesignError;
use crate::risk::{HAPPENS, OVERTURNING_M, happenings};

/// Runs of a level, at most: those that a pool of demands holds.
const MOST_RUNS: usize = u16::MAX as usize;

/// The points of the structures of each record, one record after the other: a number for each quantity.
pub(super) fn points(of: &Uncertainty, records: usize, file: &Path) -> Result<Vec<Vec<f64>>, DesignError> {
    let dimensions = of.quantities.len();
    // structures that are all alike are one, with the very bits of the structure as described
    let draws = if of.is_known() { 1 } else { of.draws };
    if records * draws > MOST_RUNS {
        let error = JobError::input(format!(
            "[uncertainty]: {draws} structures of each of {records} records are {} runs at a level, and {MOST_RUNS} \
             is the most: use fewer draws",
            records * draws
        ));
        return Err(uplift_job::in_file(error, file).into());
    }
    let points = unit_cube(of.sampling, (records * draws, dimensions), of.seed)?;
    Ok(points.chunks_exact(dimensions).map(<[f64]>::to_vec).collect())
}

/// The answers, `[site, asked]`, of oscillators with the factor from them to the structure: every draw of a record
/// counts as a record does.
pub(super) fn findings(
    (systems, participation): (&[System], f64),
    stripes: &Stripes,
    sites: &[SiteQuestions<'_>],
    scatter: &Scatter,
) -> Result<Vec<UncertainFinding>, DesignError> {
    let draws = stripes.peaks.axes().systems;
    let scatter = drawn(scatter, draws);
    // the draws of a record lie one after the other, each a row of levels
    let demands_m = stripes.peaks.displacement_m();
    let demand = PooledDemand::new(&Stripe::new(&stripes.levels, demands_m)?)?;
    let capacity_m = |system| Event::BeyondCapacity.threshold_m(system).unwrap_or(f64::INFINITY);
    let runs = demands_m.chunks_exact(stripes.levels.len()).zip(systems.iter().map(capacity_m));
    let beyond = happenings(&stripes.levels, runs)?;
    let result = |value: f64, bands: Option<Bands>| AleatoryResult {
        value,
        at_most_per_year: None,
        by_record: bands.map(|bands| bands.by_record),
        by_earthquake: bands.and_then(|bands| bands.by_earthquake),
        with_hazard: bands.and_then(|bands| bands.with_hazard),
    };
    let rate = |site: &SiteQuestions<'_>, of: &PooledDemand, threshold_m: f64| -> Result<AleatoryResult, DesignError> {
        let per_year = RiskCurve::new(of, site.hazard.mean)?.mean_annual_frequency(threshold_m)?;
        Ok(result(per_year, rate_bands(of, (site.hazard, None), &scatter, threshold_m)?))
    };
    let finding = |site: &SiteQuestions<'_>, event: Event| match event {
        Event::Overturning => rate(site, &demand, OVERTURNING_M),
        Event::BeyondCapacity => rate(site, &beyond, HAPPENS),
        Event::Demand(target_per_year) => {
            let ordinate = RiskCurve::new(&demand, site.hazard.mean)?.exact_ordinate(target_per_year)?;
            let bands = demand_bands(&demand, (site.hazard, None), &scatter, (target_per_year, participation, None))?;
            Ok(result(participation * ordinate.displacement_m, bands.map(|bands| bands.demand_m)))
        }
    };
    let asked = sites.iter().flat_map(|site| site.asked.iter().map(move |(event, _)| (site, *event)));
    asked.map(|(site, event)| Ok(UncertainFinding::Aleatory(finding(site, event)?))).collect()
}

/// What scatters where each record has so many draws: they go with their record.
fn drawn(scatter: &Scatter, draws: usize) -> Scatter {
    let of_units = |units: &Vec<Vec<usize>>| -> Vec<Vec<usize>> {
        let of_record = |record: &usize| record * draws..(record + 1) * draws;
        units.iter().map(|unit| unit.iter().flat_map(of_record).collect()).collect()
    };
    Scatter { pairs: of_units(&scatter.pairs), earthquakes: scatter.earthquakes.as_ref().map(of_units) }
}
