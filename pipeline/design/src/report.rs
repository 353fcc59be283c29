//! A structure, and the result that it was examined under, as reports have them.

use std::path::PathBuf;

use serde::Serialize;
use uplift_job::text::HAZARD_OF_REPAIR;
use uplift_result::ResultFile;
use uplift_study::Structure;
use uplift_uniform_risk::{SpectraOfResult, StudyOfResult};

use super::limit::FrameLimit;
use crate::error::DesignError;

/// A structure and the oscillator that it is equivalent to (Table 3.1).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StructureReport {
    /// Name for people.
    #[serde(skip)]
    pub name: String,
    /// The structure file.
    pub file: PathBuf,
    /// Kind of structure.
    pub kind: &'static str,
    /// Its row of Table 3.1.
    pub table_3_1_row: u8,
    /// Equivalent mass, kg.
    pub mass_kg: f64,
    /// Force at uplift, N.
    pub uplift_force_n: f64,
    /// Uplift strength `f_up/(m g)`.
    pub strength: f64,
    /// Factor Γ on the motion.
    pub participation: f64,
    /// Strength at which a spectrum is read.
    pub spectral_strength: f64,
    /// Displacement at uplift, m.
    pub uplift_displacement_m: f64,
    /// Coefficient of restitution; none where there are several to tell.
    pub restitution: Option<f64>,
    /// Displacement capacity, m; none for a structure that has none.
    pub capacity_m: Option<f64>,
    /// Where its tendons yield or fail; none where they do not, or it has none.
    #[serde(skip)]
    pub tendon_limit: Option<FrameLimit>,
    /// Stiffness after uplift, N/m.
    pub post_uplift_stiffness_n_m: f64,
    /// What is to know before linearised equations are used for it.
    pub warnings: Vec<String>,
}

impl StructureReport {
    /// Of `structure`, whose oscillator has this restitution.
    pub fn from_structure(structure: &Structure, restitution: Option<f64>) -> Self {
        let system = &structure.system;
        Self {
            name: structure.name(),
            file: structure.file.clone(),
            kind: structure.description.kind.name(),
            table_3_1_row: system.table_row(),
            mass_kg: system.mass_kg(),
            uplift_force_n: system.uplift_force_n(),
            strength: system.strength(),
            participation: system.participation(),
            spectral_strength: system.spectral_strength(),
            uplift_displacement_m: system.conditions().uplift_displacement_m(),
            restitution,
            capacity_m: system.capacity_m(),
            tendon_limit: structure.columns.as_ref().and_then(FrameLimit::from_tendons),
            post_uplift_stiffness_n_m: system.post_uplift_stiffness_n_m(),
            warnings: system.warnings().iter().map(ToString::to_string).collect(),
        }
    }
}

/// The result that a structure was examined under.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportSource {
    /// The result file.
    pub result: PathBuf,
    /// By what the numbers of the result are known.
    #[serde(skip)]
    pub study_digest: String,
    /// Its study file as it was given.
    #[serde(skip)]
    pub study_file: String,
    /// What was changed of that for the run.
    #[serde(skip)]
    pub overrides: Vec<String>,
    /// Where its records come from, in a line.
    pub record_set: String,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// Its sites with weighted hazard curves, by measure.
    #[serde(skip)]
    weighted: Vec<(String, &'static str)>,
}

impl ReportSource {
    /// Of the result in `file`, whose study is `source`.
    pub(super) fn read(file: &ResultFile, source: &StudyOfResult) -> Result<Self, DesignError> {
        let head = file.head()?;
        let measures = source.measures.iter().map(SpectraOfResult::measure);
        let weighted = measures.flat_map(|measure| {
            let sites = source.study.sites.iter().filter(move |site| site.has_weighted_curves(measure));
            sites.map(move |site| (site.name.clone(), measure.label()))
        });
        Ok(Self {
            weighted: weighted.collect(),
            result: source.path.clone(),
            study_digest: head.study_digest(),
            study_file: head.study_file,
            overrides: head.overrides.unwrap_or_default(),
            record_set: source.record_set.clone(),
            synthetic: source.synthetic,
        })
    }

    /// Which hazard `repaired` numbers of the measure `im` are of at a site with weighted curves; none where nothing is
    /// repaired, and of a site with one curve.
    pub fn hazard_of_repair(&self, repaired: bool, site: &str, im: &str) -> Option<&'static str> {
        let is_weighted = || self.weighted.iter().any(|(own, of)| own == site && *of == im);
        (repaired && is_weighted()).then_some(HAZARD_OF_REPAIR)
    }
}
