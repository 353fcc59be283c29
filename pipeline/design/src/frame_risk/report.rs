//! The report of the risk of a frame.

use std::path::PathBuf;

use serde::Serialize;
use uplift_fragility::LognormalFit;
use uplift_job::alarm::Alarm;
use uplift_uniform_risk::EventRisk;

use super::demand::ModelDemand;
use super::edps::{DirectionEffect, EventReport, StateAtDemand};
use crate::certainty::Bands;
use crate::limit::{FrameLimit, LimitRisk};
use crate::report::{ReportSource, StructureReport};

/// The report of the risk of a frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameRiskReport {
    /// The structure, and the oscillator that it is equivalent to.
    pub structure: StructureReport,
    /// The result that it was examined under.
    #[serde(flatten)]
    pub source: ReportSource,
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Those that the frame could be asked by, too.
    #[serde(skip)]
    pub other_measures: Vec<&'static str>,
    /// Unit of the levels.
    pub unit: &'static str,
    /// Probability of exceedance.
    pub poe: f64,
    /// Years that it refers to.
    pub years: f64,
    /// Its rate, 1/yr (Eq. 4.8).
    pub target_per_year: f64,
    /// Records; where both components of a pair are records, pairs are half as many.
    pub records: usize,
    /// Nonlinear time histories of frame and oscillators.
    pub analyses: u64,
    /// Velocity after over before an impact of the planar frame.
    pub planar_restitution: f64,
    /// Where that comes from.
    pub planar_restitution_from: &'static str,
    /// Resamples of the records that bands are made of.
    pub replicates: usize,
    /// Share of them between the limits of a band.
    pub confidence: f64,
    /// The frame itself first, then its proxies.
    pub demands: Vec<ModelDemand>,
    /// Columns and restrainers at the demand on the frame; none where it overturns more often than the target, or goes
    /// beyond the law of its restrainers.
    pub at_demand: Option<StateAtDemand>,
    /// How often each event of the frame happens.
    pub events: Vec<EventReport>,
    /// What it must not pass before it overturns; none where there is nothing.
    pub limit: Option<FrameLimit>,
    /// How often it passes that.
    pub beyond_limit: Option<LimitRisk>,
    /// How often it overturns.
    pub overturning: FrameOverturning,
    /// What the second component does; none of a planar frame.
    pub direction: Option<DirectionEffect>,
    /// What the models leave out, and what could not be done.
    pub notes: Vec<String>,
    /// What to know before using the numbers, the worst first.
    pub alarms: Vec<Alarm>,
    /// What was written.
    #[serde(skip)]
    pub files: Vec<PathBuf>,
}

impl FrameRiskReport {
    /// The limit with how often it is passed, where that and not overturning tells how often the frame fails.
    pub fn governing_limit(&self) -> Option<(FrameLimit, LimitRisk)> {
        let found = self.limit.zip(self.beyond_limit);
        found.filter(|(_, beyond)| beyond.governs(&self.overturning.risk))
    }
}

/// Overturning of the frame itself.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameOverturning {
    /// Levels of the stripes, ascending.
    pub levels: Vec<f64>,
    /// Records that overturn it at each level.
    pub overturned: Vec<u32>,
    /// How often, from the counts.
    #[serde(flatten)]
    pub risk: EventRisk,
    /// The same of records weighted so that they bring the site's hazard; none where the result has no repair.
    pub repaired: Option<EventRisk>,
    /// Median of the lognormal fragility of maximum likelihood; none where there is no fit.
    pub theta: Option<f64>,
    /// Its dispersion.
    pub beta: Option<f64>,
    /// Frequency with that fragility in place of the counts, 1/yr.
    pub lognormal_per_year: Option<f64>,
    /// Confidence band of the frequency from the counts, by the records; none where no run overturns.
    pub bands: Option<Bands>,
    /// That of the frequency by the fit; none without a fit, where that hangs on one record, and of a single one.
    pub lognormal_bands: Option<Bands>,
    /// The fit itself.
    #[serde(skip)]
    pub fit: Option<LognormalFit>,
}
