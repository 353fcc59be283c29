//! Whose scatter a quoted confidence band is of.

use serde::Serialize;
use uplift_bootstrap::{is_too_narrow, units};
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;

use crate::Precision;
use crate::consistency::Question;
use crate::error::UniformRiskError;

/// What a confidence band takes for independent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(into = "&'static str")]
pub enum BandOf {
    /// Records; the components of a pair are one.
    Records,
    /// Earthquakes with all their records.
    Earthquakes,
}

impl BandOf {
    /// What to say behind a band of whom it is; nothing of one by record, which is what it seems to be.
    pub fn words(self) -> &'static str {
        match self {
            Self::Records => "",
            Self::Earthquakes => " by earthquake",
        }
    }
}

impl From<BandOf> for &'static str {
    /// `records` or `earthquakes`, as files and JSON have it.
    fn from(of: BandOf) -> Self {
        match of {
            BandOf::Records => "records",
            BandOf::Earthquakes => "earthquakes",
        }
    }
}

/// The units whose scatter makes the quoted bands of the spectra by a measure.
#[derive(Debug, Clone, PartialEq)]
pub struct QuotedUnits {
    /// What they are.
    pub of: BandOf,
    /// Positions of the records of each.
    pub records: Vec<Vec<usize>>,
}

impl QuotedUnits {
    /// Those of every measure of `file`, in order.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn from_file(file: &ResultFile) -> Result<Vec<Self>, UniformRiskError> {
        let question = Question::from_result(file)?;
        Ok(file.measures().into_iter().map(|measure| Self::read(file, measure, &question)).collect())
    }

    /// Those of the spectra by `measure` in `file`: earthquakes, where records share them and the band by record is
    /// more than a quarter narrower ([`is_too_narrow`], of the half-widths that a run stores).
    ///
    /// - `question`: knows pairs and earthquakes of the records.
    pub fn read(file: &ResultFile, measure: IntensityMeasure, question: &Question) -> Self {
        let is_by_earthquake =
            file.half_widths(measure).is_some_and(|[by_record, by_event]| is_too_narrow(by_record, by_event));
        Self::new(is_by_earthquake, question)
    }

    /// Those of bands by the `precision` of their measure; none of a single record.
    pub fn from_precision(precision: Option<&Precision>, question: &Question) -> Self {
        let widths = precision.and_then(|of| Some((of.half_width[0], of.half_width_by_event?)));
        Self::new(widths.is_some_and(|(by_record, by_event)| is_too_narrow(by_record, by_event)), question)
    }

    fn new(is_by_earthquake: bool, question: &Question) -> Self {
        if is_by_earthquake {
            Self { of: BandOf::Earthquakes, records: units(&question.event_of()) }
        } else {
            Self { of: BandOf::Records, records: units(&question.pair_of()) }
        }
    }
}
