//! The report of a run of a study of displacement spectra.

use serde::Serialize;
use uplift_inputs::NamedSet;
use uplift_job::study_run::RunHead;
use uplift_result::{DesignRow, ResultFile, StoredSet};
use uplift_spectra::{MotionSet, Noisy};
use uplift_study::{DisplacementStudy, Kind, Structures};

use crate::error::StudiesError;

/// The report of a run.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// What every kind reports.
    #[serde(flatten)]
    pub head: RunHead,
    /// `displacement spectra`.
    pub kind: &'static str,
    /// The record sets.
    pub sets: Vec<SetReport>,
    /// Nonlinear time histories of the spectra.
    pub analyses: u64,
    /// The values of the design examples; empty where the study has none.
    pub design: Vec<DesignRow>,
    /// Whether the study asks for a design example.
    #[serde(skip)]
    pub has_design: bool,
    /// What was shaken.
    #[serde(skip)]
    pub structures: Structures,
    /// Percentiles over the motions of a set, %.
    #[serde(skip)]
    pub percentiles: Vec<f64>,
    /// The spectra, one a set and way of scaling.
    #[serde(skip)]
    pub spectra: Vec<SpectraReport>,
}

/// A record set.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SetReport {
    /// Its name.
    pub name: String,
    /// Its records.
    pub records: usize,
    /// Its motions, two a record.
    pub motions: usize,
    /// Median PGA, g (Eq. 2.16).
    pub median_pga_g: f64,
    /// Median PGV, cm/s (Eq. 2.17).
    pub median_pgv_cm_s: f64,
}

/// The spectra of one set, scaled in one way.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectraReport {
    /// Name of the record set.
    pub record_set: String,
    /// What the motions are scaled to.
    pub scaling: String,
    /// Whose peak meets it.
    pub scaled_by: &'static str,
    /// Percentiles of the peak displacements over `[line, percentile, abscissa]`, m; infinite where overturned.
    pub percentile_m: Vec<f64>,
    /// Those that are printed with their range over scale factors that differ by rounding, over `[line, percentile,
    /// printed abscissa]`, m.
    pub rounding: Vec<Noisy>,
}

impl SetReport {
    pub(super) fn from_motions(set: &NamedSet, motions: &MotionSet<'_>) -> Self {
        Self {
            name: set.name.clone(),
            records: set.members.len(),
            motions: motions.motions().len(),
            median_pga_g: motions.median_pga_g(),
            median_pgv_cm_s: motions.median_pgv_cm_s(),
        }
    }

    fn from_stored(set: &StoredSet) -> Self {
        let records = usize::try_from(set.records).unwrap_or(usize::MAX);
        Self {
            name: set.name.clone(),
            records,
            motions: records.saturating_mul(2),
            median_pga_g: set.median_pga_g,
            median_pgv_cm_s: set.median_pgv_cm_s,
        }
    }
}

impl RunReport {
    /// The report on the result of `study` in `file`, with a `head`; none where an earlier version wrote it, which did
    /// not repeat ordinates at neighbouring scale factors.
    ///
    /// # Errors
    /// A file that is damaged or of another kind.
    pub fn read(file: &ResultFile, study: &DisplacementStudy, head: RunHead) -> Result<Option<Self>, StudiesError> {
        let stored = file.displacements()?;
        let Some(rounding) = &stored.rounding else { return Ok(None) };
        let design = file.design()?;
        let mut spectra = Vec::new();
        for (set, of_set) in stored.sets.iter().enumerate() {
            for (scaling, to) in stored.scalings.iter().enumerate() {
                for (by, scaled_by) in study.scaling.by.iter().enumerate() {
                    spectra.push(SpectraReport {
                        record_set: of_set.name.clone(),
                        scaling: to.clone(),
                        scaled_by: scaled_by.key(),
                        percentile_m: stored.percentile_m.block([set, scaling, by]).to_vec(),
                        rounding: rounding.percentile_m.block([set, scaling, by]).to_vec(),
                    });
                }
            }
        }
        Ok(Some(Self {
            head,
            kind: Kind::Displacement.key(),
            sets: stored.sets.iter().map(SetReport::from_stored).collect(),
            analyses: stored.analyses,
            has_design: design.is_some(),
            design: design.map_or_else(Vec::new, |design| design.rows),
            structures: study.structures.clone(),
            percentiles: stored.percentiles,
            spectra,
        }))
    }
}
