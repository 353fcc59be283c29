//! Which records carry a spectrum, and which intensities: the jackknife and the disaggregation of its risk.

use rayon::prelude::*;
use uplift_bootstrap::{left_out_together, without_each};
use uplift_job::Array;
use uplift_job::events::{Events, Progress};
use uplift_motion::IntensityMeasure;
use uplift_risk::{PooledDemand, RiskCurve};
use uplift_uniform_risk::consistency::Reweighing;
use uplift_uniform_risk::{StoredMeasure, StoredStripes};

use crate::error::QuestionsError;

/// Influence on the spectra of one measure, plain or repaired.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Influence {
    pub(super) measure: IntensityMeasure,
    /// Whether they are the repaired ones.
    pub(super) repaired: bool,
    /// Exact ordinates of all records `[site, poe, strength]`, m; NaN where there is no repaired one.
    pub(super) exact_m: Array<3>,
    /// Exact ordinates without each record `[site, poe, record, strength]`, m; none for a single record.
    pub(super) without_m: Option<Array<4>>,
    /// Shares of the risk at each exact ordinate `[site, poe, strength, bin]`. Bin 0 lies below the first level, bin i
    /// between the levels i and i + 1 counted from 1, the last above all levels. NaN where there is no ordinate.
    pub(super) shares: Array<4>,
}

/// How a record changes a spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordInfluence {
    /// Position of the record; of the first of a pair whose records are left out together.
    pub record: usize,
    /// Mean of the relative change of the ordinates without it, over the strengths above uplift.
    pub mean_change: f64,
    /// The largest of these changes, by magnitude, with its sign.
    pub largest_change: f64,
    /// The strength at which it is.
    pub strength: f64,
}

/// A number on a record: its name, its heading of the workbook, and where it is.
pub type Change = (&'static str, &'static str, fn(&RecordInfluence) -> f64);

/// How a record changes a spectrum, as tables have it.
pub const CHANGES: [Change; 3] = [
    ("mean_change_pct", "mean change, %", |of| 100.0 * of.mean_change),
    ("largest_change_pct", "largest change, %", |of| 100.0 * of.largest_change),
    ("at_strength", "at strength, -", |of| of.strength),
];

/// One strength: ordinates without each record `[site][poe][record]`, shares `[site, poe, bin]`.
type OfStrength = (Vec<Vec<Vec<f64>>>, Vec<f64>);

/// Influence of records and intensities on all spectra of `measure`.
pub(super) fn influence_by(stored: &StoredStripes, measure: &StoredMeasure) -> Result<Influence, QuestionsError> {
    let samples = left_out_together(stored.records.len(), &stored.units.records)?;
    let (sites, poes, strengths) = (stored.sites.len(), stored.poes.len(), stored.strengths.len());
    let bins = measure.levels.len() + 1;
    let of_strength = |strength: usize| -> Result<OfStrength, QuestionsError> {
        let demand = measure.demand(strength)?;
        let (mut without, mut shares) = (Vec::new(), Vec::new());
        for (site, weights) in measure.weights.iter().enumerate() {
            without.push(without_each(&demand, weights, &stored.targets_per_year, &samples)?);
            let curve = RiskCurve::new(&demand, weights)?;
            for poe in 0..poes {
                shares.extend(shares_of(&curve, measure.exact_m[[site, poe, strength]], bins)?);
            }
        }
        Ok((without, shares))
    };
    let by_strength = (0..strengths)
        .into_par_iter()
        .map(of_strength)
        .collect::<Result<Vec<OfStrength>, _>>()
        .map_err(|error| uplift_job::in_file(error, &stored.path))?;
    let without_m = (!samples.is_empty()).then(|| {
        Array::from_fn([sites, poes, stored.records.len(), strengths], |[site, poe, record, strength]| {
            by_strength[strength].0[site][poe][stored.units.of[record]]
        })
    });
    let shares = Array::from_fn([sites, poes, strengths, bins], |[site, poe, strength, bin]| {
        by_strength[strength].1[(site * poes + poe) * bins + bin]
    });
    let exact_m = measure.exact_m.clone();
    Ok(Influence { measure: measure.measure, repaired: false, exact_m, without_m, shares })
}

/// The shares of the risk at an ordinate: from below the first level, between the levels, and above the last; NaN where
/// there is no ordinate.
fn shares_of(curve: &RiskCurve<'_>, ordinate_m: f64, bins: usize) -> Result<Vec<f64>, QuestionsError> {
    if !(ordinate_m > 0.0 && ordinate_m.is_finite()) {
        return Ok(vec![f64::NAN; bins]);
    }
    // the risk that fixes the ordinate is that of the runs that reach it
    let parts = curve.disaggregation(ordinate_m.next_down())?;
    let total = parts.total_per_year();
    let between = parts.intervals_per_year.iter().map(|part| part / total);
    let below = std::iter::once(parts.lower_tail_per_year / total);
    Ok(below.chain(between).chain([parts.upper_tail_per_year / total]).collect())
}

/// The same of the repaired spectra, whose weights are solved again without each record.
pub(super) fn influence_on_repaired(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    reweighing: &Reweighing,
    events: &dyn Events,
) -> Result<Influence, QuestionsError> {
    let (sites, poes, strengths) = (stored.sites.len(), stored.poes.len(), stored.strengths.len());
    let (records, bins) = (stored.records.len(), measure.levels.len() + 1);
    let demand = |strength| measure.demand(strength);
    let demands: Vec<PooledDemand> = (0..strengths).into_par_iter().map(demand).collect::<Result<_, _>>()?;
    let (samples, targets) = (left_out_together(records, &stored.units.records)?, &stored.targets_per_year);
    let repaired_sites = (0..sites).filter(|&site| reweighing.site((measure.measure, site)).is_some()).count();
    let label = format!("{} repaired", measure.measure.label());
    let progress = Progress::begin(events, &label, "samples", (repaired_sites * samples.len()) as u64);
    let mut of_sites = Vec::with_capacity(sites);
    for site in 0..sites {
        let Some(repaired) = reweighing.site((measure.measure, site)) else {
            of_sites.push(None);
            continue;
        };
        let anew = repaired.ordinates(&demands, targets, &samples, &progress)?;
        let of_set_m = repaired.ordinates_of_set(&demands, targets)?;
        // [strength][poe][bin]
        let shares_at = |(demand, of_set_m): (&PooledDemand, &Vec<f64>)| -> Result<Vec<Vec<f64>>, QuestionsError> {
            let curve = RiskCurve::weighted(demand, repaired.weights())?;
            of_set_m.iter().map(|&ordinate_m| shares_of(&curve, ordinate_m, bins)).collect()
        };
        let shares = demands.iter().zip(&of_set_m).map(shares_at).collect::<Result<Vec<_>, _>>()?;
        let failing: Vec<&str> = (stored.units.names.iter().zip(&anew.is_reached))
            .filter_map(|(name, is_reached)| (!is_reached).then_some(name.as_str()))
            .collect();
        if !failing.is_empty() {
            events.note(&format!(
                "{} by {}: without {} no weights match the site's hazard, so the others are repaired in part only",
                stored.sites[site],
                measure.measure.label(),
                failing.join(", ")
            ));
        }
        of_sites.push(Some((of_set_m, shares, anew.ordinates_m)));
    }
    let exact_m = Array::from_fn([sites, poes, strengths], |[site, poe, strength]| {
        of_sites[site].as_ref().map_or(f64::NAN, |(of_set_m, ..)| of_set_m[strength][poe])
    });
    let shares = Array::from_fn([sites, poes, strengths, bins], |[site, poe, strength, bin]| {
        of_sites[site].as_ref().map_or(f64::NAN, |(_, shares, _)| shares[strength][poe][bin])
    });
    let without_m = (!samples.is_empty()).then(|| {
        Array::from_fn([sites, poes, records, strengths], |[site, poe, record, strength]| {
            let place = (strength * poes + poe) * samples.len() + stored.units.of[record];
            of_sites[site].as_ref().map_or(f64::NAN, |(.., without_m)| without_m[place])
        })
    });
    Ok(Influence { measure: measure.measure, repaired: true, exact_m, without_m, shares })
}

/// The influence of every record, or of every pair whose records are left out together by its first, on one spectrum,
/// the most influential first; empty where no ordinate lies above uplift.
///
/// * `without_m` — exact ordinates without each record `[site, poe, record, strength]`, m
/// * `at` — site and probability of the spectrum, by position
///
/// * `exact_m` — exact ordinates with all of them `[site, poe, strength]`, m: the change is never that between an exact
///   ordinate and one of the study's grid
pub fn rank_records(
    stored: &StoredStripes,
    exact_m: &Array<3>,
    without_m: &Array<4>,
    at: [usize; 2],
) -> Vec<RecordInfluence> {
    let [site, poe] = at;
    let mut all: Vec<RecordInfluence> = stored
        .units
        .firsts()
        .filter_map(|record| {
            let changes: Vec<(f64, f64)> = without_m
                .block([site, poe, record])
                .iter()
                .zip(exact_m.block(at))
                .zip(&stored.strengths)
                .filter(|((_, full), _)| full.is_finite() && **full > stored.uplift_displacement_m)
                .map(|((without, full), &strength)| ((without - full) / full, strength))
                .collect();
            let &(largest_change, strength) = changes.iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
            let mean_change = changes.iter().map(|change| change.0).sum::<f64>() / changes.len() as f64;
            Some(RecordInfluence { record, mean_change, largest_change, strength })
        })
        .collect();
    all.sort_by(|a, b| b.mean_change.abs().total_cmp(&a.mean_change.abs()).then(a.record.cmp(&b.record)));
    all
}

/// The level below which a share of the risk lies, in the unit of the levels: linear within a bin, 0 at its lower end
/// for the first, the last level for the last. NaN where there is no ordinate.
///
/// * `shares` — of one ordinate: below the first level, between the levels, above the last
pub fn level_of_share(levels: &[f64], shares: &[f64], share: f64) -> f64 {
    let mut sum = 0.0;
    for (bin, &part) in shares.iter().enumerate() {
        if part > 0.0 && sum + part >= share * (1.0 - 1e-12) {
            let from = if bin == 0 { 0.0 } else { levels[bin - 1] };
            let to = levels.get(bin).copied().unwrap_or(from);
            return from + (to - from) * ((share - sum) / part).clamp(0.0, 1.0);
        }
        sum += part;
    }
    f64::NAN
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_of_shares_by_hand() {
        // 10 % below 1, 40 % from 1 to 3, 50 % above 3
        let (levels, shares) = ([1.0, 3.0], [0.1, 0.4, 0.5]);
        for (share, expected) in [(0.05, 0.5), (0.1, 1.0), (0.3, 2.0), (0.5, 3.0), (0.95, 3.0)] {
            assert!((level_of_share(&levels, &shares, share) - expected).abs() < 1e-12, "{share}");
        }
        assert!(level_of_share(&levels, &[f64::NAN; 3], 0.5).is_nan());
    }
}
