//! A result file: opened once, and read part by part as each is asked for.

use std::ops::Deref;
use std::path::Path;

use uplift_job::outputs::{SITE_ARRAYS, SITE_COEFFICIENTS, SITE_SPECTRA, beside};
use uplift_motion::IntensityMeasure;
use uplift_study::Repair;

use super::bands::StoredBands;
use super::consistency::StoredConsistency;
use super::spectra::StoredSpectra;
use super::spread::StoredSpread;
use super::stored_result::{RiskAxes, StoredResult};
use crate::error::ResultError;

/// The result of a study of any kind, open for reading.
///
/// Nothing but the first attributes is read before it is asked for. What is read is checked against its axes and
/// returned as a plain value: keep it, each call reads anew.
///
/// ```no_run
/// use std::path::Path;
/// use uplift_result::ResultFile;
///
/// let file = ResultFile::open(Path::new("results/europe.h5"))?;
/// println!("{}", file.head()?.record_set);
/// for spectrum in file.spectra()?.rows() {
///     println!("{} {}: {:?}", spectrum.site, spectrum.measure.label(), spectrum.u_m);
/// }
/// # Ok::<(), uplift_result::ResultError>(())
/// ```
///
/// | of a result of any kind | |
/// |---|---|
/// | [`head`](Self::head) | where the numbers come from |
/// | [`overview`](Self::overview) | what it holds |
/// | **of uniform risk** | |
/// | [`axes`](Self::axes) | records, strengths, probabilities, sites |
/// | [`records`](Self::records) | what is known of the records |
/// | [`hazard`](Self::hazard) | the hazard curves as used |
/// | [`spectra`](Self::spectra) | the spectra and their coefficients, as the study read them |
/// | [`peaks`](StoredResult::peaks) | peak displacements of all runs |
/// | [`bands`](Self::bands), [`draws`](StoredResult::draws) | confidence bands and their draws |
/// | [`influence`](Self::influence) | what each record and intensity does to the spectra |
/// | [`findings`](Self::findings) | what structures were asked, and the answers |
/// | [`stored_study`](Self::stored_study) | the study itself |
/// | **of displacement spectra** | |
/// | [`displacements`](Self::displacements) | the spectra |
/// | [`motions`](Self::motions) | every peak displacement of a set |
/// | [`design`](Self::design) | the design example |
/// | **of a shaking table** | |
/// | [`shake_table`](Self::shake_table) | every test |
pub struct ResultFile {
    stored: StoredResult,
    /// What it was asked for in place of the risks of its study.
    at_target_risks: Option<SpectraAtTargetRisks>,
}

/// What a result says of the risks that it was asked for.
struct SpectraAtTargetRisks {
    /// The spectra.
    spectra: StoredSpectra,
    /// Whether the records have the hazard of the other measure.
    consistency: Vec<StoredConsistency>,
    /// Bands; none until they are made.
    bands: Option<StoredBands>,
}

impl Deref for ResultFile {
    type Target = StoredResult;

    fn deref(&self) -> &StoredResult {
        &self.stored
    }
}

impl ResultFile {
    /// Opens the result at `path`.
    ///
    /// # Errors
    /// A file that is missing, damaged, not a result, or of another layout.
    pub fn open(path: &Path) -> Result<Self, ResultError> {
        Ok(Self { stored: StoredResult::open(path)?, at_target_risks: None })
    }

    /// The axes of a result of uniform risk, with the probabilities that it was asked for, if it was.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn axes(&self) -> Result<RiskAxes, ResultError> {
        let mut axes = self.stored_axes()?;
        if let Some(own) = &self.at_target_risks {
            axes.poes.clone_from(&own.spectra.poes);
            axes.years = own.spectra.years;
        }
        Ok(axes)
    }

    /// The axes of a result of uniform risk with sites.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn axes_with_sites(&self) -> Result<RiskAxes, ResultError> {
        let axes = self.axes()?;
        if axes.sites.is_empty() { Err(self.without_spectra()) } else { Ok(axes) }
    }

    /// Why a result of uniform risk without sites has no spectra, and where those of a table of sites are.
    pub fn without_spectra(&self) -> ResultError {
        if self.stored_study().is_ok_and(|study| study.site_table.is_some()) {
            let [arrays, table] = [SITE_ARRAYS, SITE_SPECTRA].map(|ending| beside(&self.path, ending));
            let (name, arrays, table) = (self.path.display(), arrays.display(), table.display());
            return self.fail(format!(
                "the spectra of a table of sites are not in the result, but in {arrays} and {table}: open these, or \
                 draw the map, `uplift plot {name} --only map`"
            ));
        }
        self.fail("the study has no sites, so the result has no spectra: add [[sites]] and run it again")
    }

    /// Why a result of uniform risk whose sites are a table has no verdicts on hazard consistency, and where they are;
    /// none where the study has no table of sites.
    pub fn without_verdicts(&self) -> Option<ResultError> {
        let study = self.stored_study().ok().filter(|study| study.site_table.is_some())?;
        let verdicts = match study.consistency.repair {
            Repair::Weights => {
                let table = beside(&self.path, SITE_COEFFICIENTS);
                format!("their verdicts are the column `verdict` of {}", table.display())
            }
            Repair::None => "its column `verdict` needs consistency.repair = \"weights\"".to_owned(),
        };
        Some(self.fail(format!("its sites are a table: {verdicts}")))
    }

    /// The spectra and coefficients of a result of uniform risk; of the risks that it was asked for, if it was
    /// ([`with_spectra`](Self::with_spectra)).
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn spectra(&self) -> Result<StoredSpectra, ResultError> {
        self.at_target_risks.as_ref().map_or_else(|| self.stored_spectra(), |own| Ok(own.spectra.clone()))
    }

    /// The consistency of the records with the hazard of another measure, at the risks asked for.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn consistency(&self) -> Result<Vec<StoredConsistency>, ResultError> {
        self.at_target_risks.as_ref().map_or_else(|| self.stored_consistency(), |own| Ok(own.consistency.clone()))
    }

    /// The confidence bands of a result of uniform risk; none before `uplift bootstrap`, and none of risks that it was
    /// asked for before they are resampled.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn bands(&self) -> Result<Option<StoredBands>, ResultError> {
        self.at_target_risks.as_ref().map_or_else(|| self.stored_bands(), |own| Ok(own.bands.clone()))
    }

    /// The spectra by each of the weighted hazard curves of a site ([`StoredResult::stored_branch_spectra`]); none of a
    /// result that was asked for other risks than those of its study.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn branch_spectra(
        &self,
        measure: IntensityMeasure,
        site: &str,
        poe: usize,
    ) -> Result<Vec<(f64, Vec<f64>)>, ResultError> {
        if self.is_at_target_risks() {
            return Ok(Vec::new());
        }
        self.stored_branch_spectra(&self.axes_with_sites()?, (measure, site), poe)
    }

    /// Every spread that the result has ([`StoredResult::stored_spreads`]); none of a result that was asked for other
    /// risks than those of its study.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn spreads(&self) -> Result<Vec<StoredSpread>, ResultError> {
        if self.is_at_target_risks() { Ok(Vec::new()) } else { self.stored_spreads(&self.axes_with_sites()?) }
    }

    /// The same result with other spectra: axes, spectra and coefficients are from now on of these.
    #[must_use]
    pub fn with_spectra(mut self, spectra: StoredSpectra) -> Self {
        self.at_target_risks = Some(SpectraAtTargetRisks { spectra, consistency: Vec::new(), bands: None });
        self
    }

    /// The same with what consistency says at the risks that it was asked for.
    #[must_use]
    pub fn with_consistency(mut self, consistency: Vec<StoredConsistency>) -> Self {
        if let Some(own) = &mut self.at_target_risks {
            own.consistency = consistency;
        }
        self
    }

    /// The same with `bands` at the risks that it was asked for.
    #[must_use]
    pub fn with_bands(mut self, bands: StoredBands) -> Self {
        if let Some(own) = &mut self.at_target_risks {
            own.bands = Some(bands);
        }
        self
    }

    /// Whether it was asked for other risks than those of its study.
    pub fn is_at_target_risks(&self) -> bool {
        self.at_target_risks.is_some()
    }
}
