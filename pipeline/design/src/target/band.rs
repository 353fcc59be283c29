//! How sure a found value is: where the band of the frequency, by all records like those at hand, meets the target.

use serde::Serialize;
use uplift_bootstrap::{
    crossing, falling, inferred_mean, inferred_mean_over_alternatives, inferred_weighted_rate, is_too_narrow,
};
use uplift_fragility::quantile;
use uplift_risk::{RiskError, RunWeights};

use super::candidate::{Attempt, StructureRisk};
use super::search::rounded_up;
use crate::certainty::{CONFIDENCE, Scatter};
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::uncertain::{Around, QuantityReport, Spread};

/// From where to where a value may lie, with 90 % confidence.
///
/// The frequency at every value has a band (docs/method.md, section 9). A value belongs to the band of the target where
/// its frequency may be the target's: the upper limit is where the upper limit of the frequency meets the target.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetBand {
    /// What it takes account of: `records`, `earthquakes`, `records and hazard`, `structure, records and hazard`, ….
    /// The quoted one is the last of its list.
    pub of: String,
    /// Lower and upper limit of the value, in its unit; the smallest value searched where it may lie below, infinite
    /// where it may lie beyond the largest.
    pub value: [f64; 2],
    /// The same of the frequency at the best estimate, 1/yr.
    pub per_year: [f64; 2],
}

/// The frequencies of everything that was tried, made to fall with the value ([`falling`]), with their bands.
pub(super) struct Frequencies {
    values: Vec<f64>,
    /// By the mean hazard curve, 1/yr, `[value]`.
    means: Vec<f64>,
    /// What each band takes account of, and the limits, 1/yr, `[value]`; the one to quote last: by earthquake where by
    /// record it is more than a quarter narrower, and with hazard and structures where these are several. None of a
    /// single record.
    bands: Vec<(String, Vec<[f64; 2]>)>,
}

impl Frequencies {
    /// Of what was `tried`, ascending. With `repaired` weights they are of the mean hazard curve alone.
    pub(super) fn from_trials(
        tried: &[(f64, Attempt)],
        (hazard, repaired): (&Hazard<'_>, Option<&RunWeights>),
        scatter: &Scatter,
    ) -> Result<Self, DesignError> {
        let values: Vec<f64> = tried.iter().map(|(value, _)| *value).collect();
        // [value][record], of one hazard curve or structure
        let fallen = |of: &dyn Fn(&Attempt) -> &[f64]| {
            falling(&values, &tried.iter().map(|(_, attempt)| of(attempt)).collect::<Vec<_>>())
        };
        // of each record, or of each of its runs
        let contributions =
            fallen(&|attempt| if repaired.is_some() { &attempt.happens } else { &attempt.record_per_year });
        let told = |of: &Vec<f64>, units: &[Vec<usize>]| match repaired {
            Some(weights) => inferred_weighted_rate(of, weights, units, CONFIDENCE),
            None => Ok((of.iter().sum::<f64>() / of.len() as f64, inferred_mean(of, units, CONFIDENCE)?)),
        };
        let by_units = |units: &Vec<Vec<usize>>| {
            contributions.iter().map(|of| told(of, units)).collect::<Result<Vec<_>, RiskError>>()
        };
        let (means, by_record): (Vec<f64>, Vec<_>) = by_units(&scatter.pairs)?.into_iter().unzip();
        let earthquakes = scatter.earthquakes.as_ref().filter(|earthquakes| earthquakes.len() > 1);
        let by_earthquake = earthquakes.map(by_units).transpose()?;
        let by_earthquake = by_earthquake.map(|of| of.into_iter().map(|(_, limits)| limits).collect::<Vec<_>>());
        let is_wider = by_earthquake.as_ref().is_some_and(|wider| is_too_narrow(middle(&by_record), middle(wider)));
        let (records, units) = match earthquakes {
            Some(earthquakes) if is_wider => ("earthquakes", earthquakes),
            _ => ("records", &scatter.pairs),
        };
        let mut bands = vec![("records".to_owned(), by_record)];
        bands.extend(by_earthquake.map(|wider| ("earthquakes".to_owned(), wider)));
        // the one to quote comes last
        if !is_wider {
            bands.rotate_left(1);
        }
        let mut over = |of: String, alternatives: Vec<(f64, Vec<Vec<f64>>)>| -> Result<(), DesignError> {
            let at = |place: usize| {
                let there: Vec<_> = alternatives.iter().map(|(weight, of)| (*weight, of[place].clone())).collect();
                Ok(inferred_mean_over_alternatives(&there, units, CONFIDENCE)?)
            };
            bands.push((of, (0..values.len()).map(at).collect::<Result<_, DesignError>>()?));
            Ok(())
        };
        let branches = if repaired.is_some() { &[] } else { &hazard.branches[..] };
        if !branches.is_empty() {
            let by_curve = |(place, (weight, _)): (usize, &(f64, _))| (*weight, fallen(&|of| &of.by_branch[place]));
            over(format!("{records} and hazard"), branches.iter().enumerate().map(by_curve).collect())?;
        }
        let structures = tried.first().map_or(1, |(_, attempt)| attempt.structures.len());
        if structures > 1 {
            // every structure with the hazard curve that goes with it
            let by_structure = |place: usize| (1.0, fallen(&|of| of.structures[place].with_its_hazard()));
            let of = if branches.is_empty() {
                format!("structure and {records}")
            } else {
                format!("structure, {records} and hazard")
            };
            over(of, (0..structures).map(by_structure).collect())?;
        }
        // NaN of a single record
        bands.retain(|(_, limits)| limits.iter().all(|of| !of[1].is_nan()));
        Ok(Self { values, means, bands })
    }

    /// Where the frequency, and the lower and the upper limit of its fullest band, meet a target: [`crossing`].
    pub(super) fn crossings(&self, target_per_year: f64) -> [f64; 3] {
        let best = crossing(&self.values, self.means.iter().copied(), target_per_year);
        let limits = self.bands.last().map(|(_, limits)| self.limits(limits, target_per_year));
        let [lower, upper] = limits.unwrap_or([best; 2]);
        [best, lower.min(best), upper.max(best)]
    }

    /// The upper limit of the fullest band of the first value, 1/yr; its frequency of a single record.
    pub(super) fn first_upper_per_year(&self) -> f64 {
        let upper = self.bands.last().and_then(|(_, limits)| limits.first()).map(|[_, upper]| *upper);
        upper.or(self.means.first().copied()).unwrap_or(0.0)
    }

    fn limits(&self, limits: &[[f64; 2]], target_per_year: f64) -> [f64; 2] {
        [0, 1].map(|end| crossing(&self.values, limits.iter().map(|of| of[end]), target_per_year))
    }

    /// The bands of the value, about the `best` estimate, which is one of the values. Upper limits have these `digits`.
    pub(super) fn bands(&self, best: f64, (target_per_year, digits): (f64, usize)) -> Vec<TargetBand> {
        let place = self.values.partition_point(|value| *value < best).min(self.values.len().saturating_sub(1));
        let largest = self.values.last().copied().unwrap_or(f64::INFINITY);
        let band = |(of, limits): &(String, Vec<[f64; 2]>)| {
            let [lower, upper] = self.limits(limits, target_per_year);
            let value = [lower.min(best), rounded_up(upper, digits, largest).max(best)];
            TargetBand { of: of.clone(), value, per_year: limits[place] }
        };
        self.bands.iter().map(band).collect()
    }
}

/// The middle one of the widths of bands; 0 where no run shows it.
fn middle(limits: &[[f64; 2]]) -> f64 {
    let mut widths: Vec<f64> = limits.iter().map(|[lower, upper]| upper - lower).filter(|width| *width > 0.0).collect();
    widths.sort_by(f64::total_cmp);
    if widths.is_empty() { 0.0 } else { quantile(&widths, 0.5) }
}

impl StructureRisk {
    /// What each record contributes by the hazard curve that goes with the structure, 1/yr.
    fn with_its_hazard(&self) -> &[f64] {
        self.with_hazard.as_ref().unwrap_or(&self.record_per_year)
    }
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
        let Around { of, per_record: structures, .. } = *around;
        let branches = tried.first().map_or(1, |(_, attempt)| attempt.structures.len());
        let values: Vec<f64> = tried.iter().map(|(value, _)| *value).collect();
        let needed = |branch: usize| {
            let rates = tried.iter().map(|(_, attempt)| attempt.structures[branch].risk.per_year);
            crossing(&values, rates, target_per_year)
        };
        let by_structure = (branches > 1).then(|| {
            let [lower, _, median, _, upper] = Spread::from_values((0..branches).map(needed).collect()).percentiles;
            [lower, median, upper]
        });
        let (kind, sampling, seed, quantities) = (of.kind.key(), of.sampling.key(), of.seed, QuantityReport::all(of));
        Self { kind, sampling, seed, structures, quantities, by_structure }
    }
}
