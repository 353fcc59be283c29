//! Many sites whose records are weighted so that they bring the hazard of both measures: one solve a site and measure.

use uplift_consistency::{RecordSet, Verdict};
use uplift_hazard::HazardCurve;
use uplift_inputs::{SiteExport, SiteList};
use uplift_motion::IntensityMeasure;
use uplift_result::SiteConsistency;
use uplift_uniform_risk::consistency::Question;
use uplift_uniform_risk::{SiteRisk, SiteSpectra};

use crate::error::StudiesError;

/// A site whose records are weighted so that they have its hazard of the other measure.
#[derive(Debug, Clone, PartialEq)]
pub struct RepairedSite {
    /// How far they miss it without weights.
    pub consistency: SiteConsistency,
    /// The spectra of the weighted records, or why there are none.
    pub spectra: Result<SiteSpectra, String>,
}

impl RepairedSite {
    /// Nothing is known, and why.
    fn unknown(reason: String) -> Self {
        let [bias, max, least_effective] = [f64::NAN; 3];
        Self { consistency: SiteConsistency { bias, max, verdict: "", least_effective }, spectra: Err(reason) }
    }
}

/// What the repair of every site has in common.
pub struct SiteRepair<'a> {
    question: &'a Question,
    /// Of those of [`SiteList::exports`], `[export]`; none for a measure without another beside it.
    sets: Vec<Option<ScaledExport>>,
}

struct ScaledExport {
    scaled_to: IntensityMeasure,
    levels: Vec<f64>,
    /// The measure compared, and its position among [`SiteList::all_exports`].
    other: (IntensityMeasure, usize),
    set: RecordSet,
}

impl<'a> SiteRepair<'a> {
    /// For the exports of `list`.
    pub(crate) fn new(question: &'a Question, list: &SiteList) -> Result<Self, StudiesError> {
        let measures: Vec<IntensityMeasure> = list.all_exports().map(|export| export.measure).collect();
        let scaled = |export: &SiteExport| -> Result<Option<ScaledExport>, StudiesError> {
            let scaled_to = export.measure;
            let Some(other) = question.other_among(&measures, scaled_to) else { return Ok(None) };
            let position = measures.iter().position(|own| *own == other);
            let Some(position) = position else { return Ok(None) };
            let (levels, set) = (question.levels(scaled_to).to_vec(), question.set(scaled_to, other)?);
            Ok(Some(ScaledExport { scaled_to, levels, other: (other, position), set }))
        };
        Ok(Self { question, sets: list.exports.iter().map(scaled).collect::<Result<_, _>>()? })
    }

    /// The site with `curves` of [`SiteList::all_exports`], where the spectra of the export at `export` are those of
    /// `risk`.
    pub fn repair_site(
        &self,
        export: usize,
        risk: &SiteRisk<'_>,
        curves: &[Result<HazardCurve, String>],
    ) -> RepairedSite {
        let Some(scaled) = &self.sets[export] else {
            return RepairedSite::unknown(
                "the table has an export of one measure alone: add that of another".to_owned(),
            );
        };
        let (own, compared) = match (&curves[export], &curves[scaled.other.1]) {
            (Ok(own), Ok(compared)) => (own, compared),
            (Err(reason), _) => return RepairedSite::unknown(format!("{}: {reason}", scaled.scaled_to.label())),
            (_, Err(reason)) => return RepairedSite::unknown(format!("{}: {reason}", scaled.other.0.label())),
        };
        let stripes = (scaled.scaled_to, &scaled.levels[..]);
        match self.question.finding_of(0, stripes, scaled.other.0, &scaled.set, (own, compared), true) {
            Err(error) => RepairedSite::unknown(error.to_string()),
            Ok(finding) => {
                let deviation = finding.diagnosis.deviation.as_ref();
                let spectra = match finding.repaired() {
                    Some(repaired) => risk.spectra(&repaired.weights),
                    None => Err(self.question.no_repair(&finding).unwrap_or_default()),
                };
                let least = finding.repaired().and_then(|repaired| repaired.diagnosis.least_effective.as_ref());
                let consistency = SiteConsistency {
                    bias: deviation.map_or(f64::NAN, |own| own.bias),
                    max: deviation.map_or(f64::NAN, |own| own.max),
                    verdict: finding.diagnosis.verdict().map_or("", Verdict::key),
                    least_effective: least.map_or(f64::NAN, |least| least.records),
                };
                RepairedSite { consistency, spectra }
            }
        }
    }
}
