//! What a search for a target risk reports.

use std::path::PathBuf;

use serde::Serialize;
use uplift_job::alarm::Alarm;
use uplift_spectra::Noisy;
use uplift_structure::EquivalentSystem;
use uplift_uniform_risk::EventRisk;

use super::band::{TargetBand, TargetUncertainty};
use super::candidate::Attempt;
use super::own::TargetOwn;
use super::search::Crossing;
use super::trial::LevelShare;
use crate::certainty::Bands;
use crate::limit::FrameLimit;
use crate::report::{ReportSource, StructureReport};
use crate::uncertain::Spread;

/// The report of a search for a target risk.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetReport {
    /// The structure as its file has it, with the restitution of its oscillator.
    pub structure: StructureReport,
    /// The result that it was examined under.
    #[serde(flatten)]
    pub source: ReportSource,
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Unit of its levels.
    pub im_unit: &'static str,
    /// Whether its records have the weights of a repair.
    pub repaired: bool,
    /// What is varied: `width`.
    pub quantity: &'static str,
    /// Its unit.
    pub quantity_unit: &'static str,
    /// Its value in the structure file; none of what the structure does not have.
    pub own_value: Option<f64>,
    /// What must not happen more often: `overturning`, or which displacement is exceeded.
    pub event: String,
    /// Whether all numbers are those of its oscillator, though a frame or block models it itself.
    pub by_proxy: bool,
    /// What the structure itself says, a frame or a block; none of any other, and by its proxy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own: Option<TargetOwn>,
    /// Why it is left out although no `--proxy` asks for that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_own: Option<String>,
    /// The yield or failure of its tendons at the value that it needs, where they come before the capacity that it is
    /// not to exceed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tendon_limit: Option<FrameLimit>,
    /// How the records miss the site's hazard, which the repair of the result would mend; none with its weights, and
    /// where they do not miss it.
    #[serde(skip)]
    pub unrepaired: Option<String>,
    /// How often it may happen, 1/yr.
    pub target_per_year: f64,
    /// Years that probabilities refer to.
    pub years: f64,
    /// The least value from which on the upper limit of the fullest band of the frequency meets the target, by all that
    /// was tried together and by each value alone; infinite beyond the values searched.
    pub safe_value: f64,
    /// The risk at it; none beyond the values searched.
    pub safe_risk: Option<EventRisk>,
    /// The bands of its frequency by the runs at it alone, as `overturning` has them, 1/yr; none beyond the values
    /// searched, of a structure that is not known exactly, of a single record, and where no run shows it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub safe_bands: Option<Bands>,
    /// The best estimate: the least value from which on everything tried meets the target.
    pub value: f64,
    /// The largest value tried that misses it.
    pub missed_at: f64,
    /// The least value tried that meets it; below [`value`](Self::value) where the risk does not fall all the way.
    pub least_met: f64,
    /// The risk at the value; of a structure that is not known exactly the mean of those that it may be.
    pub risk: EventRisk,
    /// The same at the safe value, or at the best estimate where there is none, by the other measures of the result.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub by_other_measures: Vec<TargetByMeasure>,
    /// Measures of the result that could not be asked, for want of a repair by them.
    #[serde(skip)]
    pub unchecked: Vec<&'static str>,
    /// What every value keeps of the structure: its displacement at uplift and restitution, in words.
    pub kept: String,
    /// The structure at the value.
    pub found: FoundSystem,
    /// The frequency within one per cent of the value, 1/yr: the noise of a chaotic system.
    pub per_year_within_one_percent: Noisy,
    /// Bands of the value, the one that takes account of most last; none of a single record.
    pub bands: Vec<TargetBand>,
    /// The structures that every value may be; none where the structure file says that all is known, and with the
    /// weights of a repair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<TargetUncertainty>,
    /// Every place where the frequency crosses the target, ascending.
    pub crossings: Vec<Crossing>,
    /// What happens at levels of given return periods, for the structure at the value; none with the weights of a
    /// repair.
    pub at_return_periods: Vec<LevelShare>,
    /// The level that a generic fragility asks for; none where none was given.
    pub generic: Option<GenericTarget>,
    /// Everything that was tried, ascending.
    pub tried: Vec<TriedValue>,
    /// Nonlinear time histories of the search.
    pub analyses: u64,
    /// What to know of the search.
    pub notes: Vec<String>,
    /// What to know before using the numbers, the worst first.
    pub alarms: Vec<Alarm>,
    /// What a command has to repeat of the one that asked, with a space before each.
    #[serde(skip)]
    pub repeated: String,
    /// What was written.
    #[serde(skip)]
    pub files: Vec<PathBuf>,
}

/// How often it happens by another measure than that of the search.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetByMeasure {
    /// `PGV`, `PGA`, …
    pub im: &'static str,
    /// The risk.
    #[serde(flatten)]
    pub risk: EventRisk,
    /// Whether it meets the target by the best estimate; none where the records cannot tell.
    pub is_met: Option<bool>,
    /// How its records miss the site's hazard, which the repair of the result would mend.
    #[serde(skip)]
    pub unrepaired: Option<String>,
}

/// The equivalent oscillator at the value that was found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FoundSystem {
    /// Uplift strength `f_up/(m g)`.
    pub strength: f64,
    /// Strength at which a spectrum is read.
    pub spectral_strength: f64,
    /// Force at uplift, N.
    pub uplift_force_n: f64,
    /// Displacement capacity, m; none for a structure that has none.
    pub capacity_m: Option<f64>,
    /// Stiffness after uplift, N/m.
    pub post_uplift_stiffness_n_m: f64,
}

impl FoundSystem {
    pub(super) fn from_system(system: &EquivalentSystem) -> Self {
        Self {
            strength: system.strength(),
            spectral_strength: system.spectral_strength(),
            uplift_force_n: system.uplift_force_n(),
            capacity_m: system.capacity_m(),
            post_uplift_stiffness_n_m: system.post_uplift_stiffness_n_m(),
        }
    }
}

/// The level to design for by a generic lognormal fragility (Luco et al. 2007): risk-targeted, beside that of a return
/// period.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GenericTarget {
    /// Dispersion of the fragility.
    pub dispersion: f64,
    /// Its probability at the level to design for.
    pub probability: f64,
    /// That level, with which the fragility has the target risk, in the unit of the measure.
    pub level: f64,
    /// Median of the fragility, in the unit of the measure.
    pub median: f64,
    /// Share of the risk from above the hazard curve.
    pub upper_tail_share: f64,
    /// The longest return period that was asked for, years.
    pub return_period_years: f64,
    /// Its level; none outside the hazard curve.
    pub uniform_hazard_level: Option<f64>,
    /// Risk-targeted over uniform-hazard level; none without the latter.
    pub risk_coefficient: Option<f64>,
}

/// One value that was tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TriedValue {
    /// The value.
    pub value: f64,
    /// The risk at it.
    #[serde(flatten)]
    pub risk: EventRisk,
    /// The 5, 16, 50, 84 and 95 % percentiles of the frequencies of branches, of which that of the risk is the mean,
    /// 1/yr; none where there are no branches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub structure_percentiles_per_year: Option<[f64; 5]>,
    /// The upper limit of its band by the runs of this value alone, 1/yr; none where `safe_bands` would be none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub upper_per_year: Option<f64>,
    /// Whether it meets the target.
    pub is_met: bool,
}

impl TriedValue {
    pub(super) fn from_attempt((value, attempt): &(f64, Attempt), target_per_year: f64) -> Self {
        let branches = || Spread::from_values(attempt.structures.iter().map(|of| of.risk.per_year).collect());
        let structure_percentiles_per_year = (attempt.structures.len() > 1).then(|| branches().percentiles);
        Self {
            value: *value,
            risk: attempt.risk,
            structure_percentiles_per_year,
            upper_per_year: attempt.bands.map(|bands| bands.fullest()[1]),
            is_met: attempt.meets(target_per_year),
        }
    }
}
