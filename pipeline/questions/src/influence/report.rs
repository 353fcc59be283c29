//! The report on the influence of records and intensities.

use std::path::PathBuf;

use serde::Serialize;
use uplift_job::Array;
use uplift_job::text::nearest;
use uplift_uniform_risk::StoredStripes;

use super::change::{Influence, RecordInfluence, level_of_share};
use super::write::influence_path;

/// Strengths at which the risk is taken apart.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

/// The report on the influence of records and intensities.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfluenceReport {
    /// The most influential records of every measure, site and probability, in this order.
    pub records: Vec<RecordChange>,
    /// The intensities that make the risk of one probability, at a few strengths of every measure and site.
    pub intensities: Vec<IntensityShares>,
    /// Whether the records are synthetic.
    pub synthetic: bool,
    /// That probability.
    #[serde(skip)]
    pub poe: f64,
    /// Years that it refers to.
    #[serde(skip)]
    pub years: f64,
    /// The result file, which holds all of it now.
    #[serde(skip)]
    pub result: PathBuf,
    /// The table of all records beside it.
    #[serde(skip)]
    pub table: PathBuf,
}

/// How a spectrum changes without one record, over the strengths that rock.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecordChange {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Whether the spectrum is the repaired one.
    #[serde(skip_serializing_if = "is_plain")]
    pub repaired: bool,
    /// Probability of exceedance.
    pub poe: f64,
    /// The record.
    pub record: String,
    /// Mean change of the ordinates, per cent.
    pub mean_change_pct: f64,
    /// A strength in the middle of those of structures.
    pub strength: f64,
    /// Change of the ordinate at it, per cent; NaN where there is none.
    pub change_pct: f64,
    /// Largest change by magnitude, per cent.
    pub largest_change_pct: f64,
    /// The strength at which it is.
    pub at_strength: f64,
}

/// The intensities that make the risk at one ordinate; NaN where there is no ordinate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IntensityShares {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Whether the spectrum is the repaired one.
    #[serde(skip_serializing_if = "is_plain")]
    pub repaired: bool,
    /// Unit of the levels.
    pub unit: &'static str,
    /// Probability of exceedance.
    pub poe: f64,
    /// Uplift strength.
    pub strength: f64,
    /// The ordinate, m; infinite where censored.
    pub u_m: f64,
    /// Level below which 5 % of the risk lie.
    pub level_05: f64,
    /// Level below which half of the risk lies.
    pub level_50: f64,
    /// Level below which 95 % of the risk lie.
    pub level_95: f64,
    /// Share of the risk from below the first stripe, 0 to 1.
    pub share_below_stripes: f64,
    /// Share of the risk from above the last stripe, 0 to 1.
    pub share_above_stripes: f64,
}

impl InfluenceReport {
    pub(super) fn new(
        stored: &StoredStripes,
        influences: &[Influence],
        rankings: &[Array<2, Vec<RecordInfluence>>],
        poe: usize,
        top: usize,
    ) -> Self {
        let middle = nearest(&stored.strengths, &SHOWN_STRENGTHS[1..2])[0];
        let mut records = Vec::new();
        for (influence, rankings) in influences.iter().zip(rankings) {
            for ([site, poe], ranking) in rankings.blocks() {
                let full_m = influence.exact_m[[site, poe, middle]];
                for entry in ranking[0].iter().take(top) {
                    let without_m = influence.without_m.as_ref().map(|own| own[[site, poe, entry.record, middle]]);
                    records.push(RecordChange {
                        site: stored.sites[site].clone(),
                        im: influence.measure.label(),
                        repaired: influence.repaired,
                        poe: stored.poes[poe],
                        record: stored.units.name(entry.record).to_owned(),
                        mean_change_pct: 100.0 * entry.mean_change,
                        strength: stored.strengths[middle],
                        change_pct: without_m
                            .filter(|without_m| full_m > stored.uplift_displacement_m && without_m.is_finite())
                            .map_or(f64::NAN, |without_m| 100.0 * (without_m / full_m - 1.0)),
                        largest_change_pct: 100.0 * entry.largest_change,
                        at_strength: entry.strength,
                    });
                }
            }
        }
        Self {
            records,
            intensities: intensities(stored, influences, poe),
            synthetic: stored.synthetic,
            poe: stored.poes[poe],
            years: stored.years,
            result: stored.path.clone(),
            table: influence_path(&stored.path),
        }
    }
}

/// Whether a spectrum is a plain one, of which nothing is said.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde asks")]
fn is_plain(repaired: &bool) -> bool {
    !repaired
}

fn intensities(stored: &StoredStripes, influences: &[Influence], poe: usize) -> Vec<IntensityShares> {
    let shown = nearest(&stored.strengths, &SHOWN_STRENGTHS);
    let mut rows = Vec::new();
    for influence in influences {
        let Some(measure) = stored.measures.iter().find(|own| own.measure == influence.measure) else { continue };
        for (site, name) in stored.sites.iter().enumerate() {
            for &strength in &shown {
                let at = [site, poe, strength];
                if influence.exact_m[at].is_nan() {
                    continue;
                }
                let shares = influence.shares.block(at);
                let level = |share: f64| level_of_share(&measure.levels, shares, share);
                rows.push(IntensityShares {
                    site: name.clone(),
                    im: measure.measure.label(),
                    repaired: influence.repaired,
                    unit: measure.measure.unit(),
                    poe: stored.poes[poe],
                    strength: stored.strengths[strength],
                    u_m: influence.exact_m[at],
                    level_05: level(0.05),
                    level_50: level(0.5),
                    level_95: level(0.95),
                    share_below_stripes: shares[0],
                    share_above_stripes: shares[shares.len() - 1],
                });
            }
        }
    }
    rows
}
