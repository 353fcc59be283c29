//! The influence of records and intensities as `uplift influence` left it in a result.

use uplift_job::Array;
use uplift_motion::IntensityMeasure;

use super::declared::{group, measure_names};
use super::file::ResultFile;
use super::layout::axis::{BIN, POE, RECORD, SITE, STRENGTH};
use crate::error::ResultError;

/// Influence on the spectra of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredInfluence {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Exact ordinates without each record `[site, poe, record, strength]`, m; none for a single record.
    pub without_m: Option<Array<4>>,
    /// Levels from which the bins of the shares reach up, the last without end, in the unit of the measure.
    pub bins: Vec<f64>,
    /// Shares of the risk at each exact ordinate `[site, poe, strength, bin]`; NaN where there is no ordinate.
    pub shares: Array<4>,
}

group! {
    /// Ordinates without each record; `<left_out>` is the record, or its pair where both are left out.
    pub const INFLUENCE: Array<4> = "/influence/<im>";
    "u_without_m" [SITE, POE, RECORD, STRENGTH] F64 "m" "uniform risk displacement without the <left_out>"
        ("the spectra without each record; absent for a single record; where azimuths or structures of a pair are \
          records, without all of the pair") = |of, at| of[at];
}

group! {
    /// The same of the repaired spectra.
    pub const INFLUENCE_REPAIRED: Array<4> = "/influence/<im>/consistent";
    "u_without_m" [SITE, POE, RECORD, STRENGTH] F64 "m" "uniform risk displacement without the <left_out>"
        ("the repaired spectra without each record, their weights solved anew; NaN at sites without repair")
        = |of, at| of[at];
}

group! {
    /// Shares of the risk at each ordinate.
    pub const DISAGGREGATION: Array<4> = "/disaggregation/<im>";
    "share" [SITE, POE, STRENGTH, BIN] F64 "1" "share of the risk at the ordinate"
        ("share of the risk at the ordinate; NaN where that is 0 or censored") = |of, at| of[at];
}

group! {
    /// The same of the repaired spectra.
    pub const DISAGGREGATION_REPAIRED: Array<4> = "/disaggregation/<im>/consistent";
    "share" [SITE, POE, STRENGTH, BIN] F64 "1" "share of the risk at the ordinate"
        ("the same at the repaired ordinates; NaN at sites without repair") = |of, at| of[at];
}

impl ResultFile {
    /// Whether `uplift influence` left something, of the probabilities of the study.
    pub fn has_influence(&self) -> bool {
        self.measures().iter().any(|&measure| DISAGGREGATION.is_in(self, &measure_names(measure)))
    }

    /// The influence on the spectra of each measure of a result of uniform risk; none before `uplift influence`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn influence(&self) -> Result<Vec<StoredInfluence>, ResultError> {
        let axes = self.axes()?;
        let (site, poe) = ((SITE.name, axes.sites.len()), (POE.name, axes.poes.len()));
        let (record, strength) = ((RECORD.name, axes.records.len()), (STRENGTH.name, axes.strengths.len()));
        let of = |measure: IntensityMeasure| {
            let bin = BIN.for_measure(measure);
            let bins = self.reader.axis::<f64>(&bin)?;
            let names = measure_names(measure);
            let shares = DISAGGREGATION.read_array("share", self, &names, [site, poe, strength, (&bin, bins.len())])?;
            let without_m = INFLUENCE
                .is_in(self, &names)
                .then(|| INFLUENCE.read_array("u_without_m", self, &names, [site, poe, record, strength]))
                .transpose()?;
            Ok(StoredInfluence { measure, without_m, bins, shares })
        };
        let has = |measure: &IntensityMeasure| DISAGGREGATION.is_in(self, &measure_names(*measure));
        self.measures().into_iter().filter(has).map(of).collect()
    }
}
