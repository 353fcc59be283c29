//! What the check of a design reports.

use serde::Serialize;
use uplift_job::alarm::Alarm;

use crate::demand::ExactDemand;
use crate::own_structure::OwnReport;
use crate::report::{ReportSource, StructureReport};
use crate::rules::{MeasureVerdict, OwnCheck, RuleOutcome};
use crate::spectrum::SpectrumDemand;
use crate::uncertain::UncertaintyReport;

/// The report of a design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignReport {
    /// The structure, with the restitution of its oscillator.
    pub structure: StructureReport,
    /// The result that it was examined under.
    #[serde(flatten)]
    pub source: ReportSource,
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Whether spectrum and risks are of records weighted so that they bring the site's hazard.
    pub repaired: bool,
    /// Probability of exceedance.
    pub poe: f64,
    /// Years that it refers to.
    pub years: f64,
    /// Its rate, 1/yr (Eq. 4.8).
    pub target_per_year: f64,
    /// Safety factor asked for.
    pub required_safety_factor: f64,
    /// What the spectrum says; none where it cannot be read.
    pub spectrum: Option<SpectrumDemand>,
    /// Why it cannot be read, which is a note as well; none where it can.
    #[serde(skip)]
    pub unread: Option<String>,
    /// What the structure's own analysis says; none where there is none.
    pub exact: Option<ExactDemand>,
    /// Whether its capacity is at least the safety factor times that demand; none without a capacity.
    pub own_check: Option<OwnCheck>,
    /// Whether it is judged by its oscillator alone, though a frame or block models it itself.
    pub by_proxy: bool,
    /// What a frame or a block says itself; none of any other, by its proxy, and without an analysis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own: Option<OwnReport>,
    /// Why such a structure is left out although no `--proxy` asks for that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_own: Option<String>,
    /// The structure where its quantities are not known exactly; none where its file says that they are, and without
    /// an analysis of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyReport>,
    /// The rules; none where they do not apply, to positive post-uplift stiffness.
    pub rules: Vec<RuleOutcome>,
    /// The rules by the spectra of the other measures of the result.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub by_other_measures: Vec<MeasureVerdict>,
    /// How the structure and the study differ, and what could not be done.
    pub notes: Vec<String>,
    /// Whether the spectrum is of another oscillator than the structure's: another uplift displacement, restitution or
    /// gravity, or uncertain; the notes say which.
    pub other_oscillator: bool,
    /// Options of `uplift run` with which the study has the structure's oscillator; none where it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own_oscillator: Option<String>,
    /// What the structure's file leaves out and an answer hangs on, with what is taken for it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<String>,
    /// What to know before using the numbers, the worst first.
    pub alarms: Vec<Alarm>,
}
