//! How sure a found value is: where the band of the frequency, by all records like those at hand, meets the target.

use serde::Serialize;
use uplift_bootstrap::{inferred_mean, inferred_mean_over_alternatives};

use super::candidate::{Attempt, StructureRisk};
use super::search::least;
use crate::certainty::{CONFIDENCE, Scatter};
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::uncertain::{Around, QuantityReport, Spread};

/// From where to where a value may lie, with 90 % confidence.
///
/// The frequency at every value has a band (docs/method.md, section 9). A value belongs to the band of the target where
/// its frequency may be the target's: the upper limit is the least from which on no frequency that may be exceeds the
/// target.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetBand {
    /// What it takes account of: `records`, `earthquakes`, `records and hazard`, `structure, records and hazard`, ….
    pub of: String,
    /// Lower and upper limit of the value, in its unit; the smallest value searched where it may lie below, infinite
    /// where it may lie beyond the largest.
    pub value: [f64; 2],
    /// The same of the frequency at the best estimate, 1/yr.
    pub per_year: [f64; 2],
}

impl TargetBand {
    /// The bands of the values that were `tried`, ascending, the best estimate at `found`; the fullest band last.
    pub(super) fn all((tried, found): (&[(f64, Attempt)], usize), target_per_year: f64) -> Vec<Self> {
        let band = |(place, (of, per_year)): (usize, &(String, [f64; 2]))| Self {
            of: of.clone(),
            value: [0, 1].map(|end| {
                let at = least(tried, |attempt| attempt.frequencies[place].1[end] <= target_per_year);
                at.map_or(f64::INFINITY, |at| tried[at].0)
            }),
            per_year: *per_year,
        };
        tried[found].1.frequencies.iter().enumerate().map(band).collect()
    }
}

/// Bands of the frequency of one value, 1/yr, each with what it takes account of; the fullest last. None of a single
/// record.
///
/// - `contributions`: of each record by the mean curve of the `hazard`, and by the weights of any curve.
/// - `structures`: the branches that the structure may be; one where there are none.
pub(super) fn frequency_bands(
    (contributions, by_curve): (&[f64], &dyn Fn(&[f64]) -> Vec<f64>),
    structures: &[StructureRisk],
    (hazard, scatter): (&Hazard<'_>, &Scatter),
) -> Result<Vec<(String, [f64; 2])>, DesignError> {
    let mut bands = vec![("records".to_owned(), inferred_mean(contributions, &scatter.pairs, CONFIDENCE)?)];
    let mut records = "records";
    if let Some(earthquakes) = scatter.earthquakes.as_ref().filter(|earthquakes| earthquakes.len() > 1) {
        records = "earthquakes";
        bands.push((records.to_owned(), inferred_mean(contributions, earthquakes, CONFIDENCE)?));
    }
    let mut over = |of: String, alternatives: &[(f64, Vec<f64>)]| -> Result<(), DesignError> {
        bands.push((of, inferred_mean_over_alternatives(alternatives, scatter.coarsest(), CONFIDENCE)?));
        Ok(())
    };
    if !hazard.branches.is_empty() {
        let of_curve = |(weight, stripes): &(f64, uplift_risk::StripeWeights)| (*weight, by_curve(&stripes.per_year()));
        over(format!("{records} and hazard"), &hazard.branches.iter().map(of_curve).collect::<Vec<_>>())?;
    }
    if structures.len() > 1 {
        // every structure with the hazard curve that goes with it
        let of_structure =
            |one: &StructureRisk| (1.0, one.with_hazard.as_ref().unwrap_or(&one.record_per_year).clone());
        let of = match hazard.branches.is_empty() {
            true => format!("structure and {records}"),
            false => format!("structure, {records} and hazard"),
        };
        over(of, &structures.iter().map(of_structure).collect::<Vec<_>>())?;
    }
    // NaN of a single record
    bands.retain(|(_, limits)| !limits[1].is_nan());
    Ok(bands)
}

/// The structures that every value of a search may be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetUncertainty {
    /// `epistemic`, branches, of which the mean risk meets the target; or `aleatory`, structures of each record with
    /// one risk.
    pub kind: &'static str,
    /// `sobol` or `latin-hypercube`.
    pub sampling: &'static str,
    /// Where the random numbers began.
    pub seed: u64,
    /// Structures that shake under a record at every value.
    pub structures: usize,
    /// What is not known exactly, of the structure as described; at every other value it differs by the same factors.
    pub quantities: Vec<QuantityReport>,
    /// 5, 50 and 95 % percentiles of the value that each branch by itself would need; infinite beyond the values
    /// searched. None where there are no branches.
    pub by_structure: Option<[f64; 3]>,
}

impl TargetUncertainty {
    /// Of the structures `around` every value that was `tried`.
    pub(super) fn from_tried(around: &Around<'_>, tried: &[(f64, Attempt)], target_per_year: f64) -> Self {
        let (kind, sampling, seed) = around.sampled();
        let branches = tried.first().map_or(1, |(_, attempt)| attempt.structures.len());
        let needed = |branch: usize| {
            let at = least(tried, |attempt| attempt.structures[branch].risk.per_year <= target_per_year);
            at.map_or(f64::INFINITY, |at| tried[at].0)
        };
        let by_structure = (branches > 1).then(|| {
            let [lower, _, median, _, upper] = Spread::from_values((0..branches).map(needed).collect()).percentiles;
            [lower, median, upper]
        });
        let (structures, quantities) = (around.per_record(), around.quantities());
        Self { kind, sampling, seed, structures, quantities, by_structure }
    }
}
