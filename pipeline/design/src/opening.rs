//! How every job on a structure begins: a result is opened, a site and a measure of it are chosen, its records are
//! read, and nothing that the job reads is overwritten.

use std::path::{Path, PathBuf};

use uplift_inputs::manifest::record_files;
use uplift_inputs::{RecordSet, motion_keys};
use uplift_job::JobError;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::text::typed_path;
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_risk::SiteWeights;
use uplift_study::{AnyStudy, Structure, UniformRiskStudy};
use uplift_uniform_risk::consistency::{Reweighing, missed_in_words};
use uplift_uniform_risk::{SpectraOfResult, StudyOfResult};

use super::pairs::Pairs;
use crate::error::DesignError;

/// The site of a result at which a structure is examined, and the measure by which it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'a> {
    /// Position of the site.
    pub(super) site: usize,
    /// Its name.
    pub(super) name: &'a str,
    pub(super) measure: &'a SpectraOfResult,
}

impl<'a> Place<'a> {
    /// The `site` and the `measure` of a result; its only site and its first measure where none are given.
    ///
    /// # Errors
    /// A site or measure that the result does not have; none where it has several sites.
    pub(super) fn choose(
        source: &'a StudyOfResult,
        site: Option<&str>,
        measure: Option<IntensityMeasure>,
    ) -> Result<Self, DesignError> {
        let site = site_index(source, site)?;
        Ok(Self { site, name: &source.sites[site], measure: choose_measure(source, measure)? })
    }

    /// What runs weigh there, by the repair that is asked for.
    ///
    /// # Errors
    /// No repaired spectrum there.
    pub(super) fn weights(&self, repair: &'a Repair<'a>) -> Result<SiteWeights<'a>, DesignError> {
        let Self { site, name, measure } = *self;
        if let Some(weights) = repair.weights((measure, site)) {
            return Ok(weights);
        }
        let found = repair.file.consistency()?;
        let was_tried = found.iter().any(|of| of.scaled_to == measure.measure() && of.u_m.is_some());
        let (measure, result) = (measure.measure().label(), typed_path(repair.file.path()));
        Err(JobError::Usage(if was_tried {
            format!(
                "--repaired: no weights match both hazard curves of {name} by {measure}: leave --repaired out, and see \
                 why: uplift consistency {result} --details"
            )
        } else {
            format!(
                "--repaired: the result has no repaired spectrum of {name} by {measure}: `uplift consistency {result} \
                 --repair` computes it"
            )
        })
        .into())
    }

    /// How the records miss the hazard there, where the result has a repair that mends it.
    pub(super) fn unrepaired(&self, file: &ResultFile) -> Result<Option<String>, DesignError> {
        let found = file.consistency()?;
        let own = found.iter().find(|of| of.scaled_to == self.measure.measure() && of.is_repaired(self.site));
        Ok(own.and_then(|of| missed_in_words(of, self.site)))
    }
}

/// The weights of a result's repair, where they are asked for.
pub(super) struct Repair<'a> {
    file: &'a ResultFile,
    is_asked: bool,
    /// None where they are not asked for, and of a result without.
    reweighing: Option<Reweighing>,
}

impl<'a> Repair<'a> {
    pub(super) fn from_file(file: &'a ResultFile, is_asked: bool) -> Result<Self, DesignError> {
        let reweighing = if is_asked { Reweighing::from_motions(file)? } else { None };
        Ok(Self { file, is_asked, reweighing })
    }

    /// What runs weigh by a measure at a site; none where a repair is asked for and missing.
    pub(super) fn weights<'b>(&'b self, (measure, site): (&'b SpectraOfResult, usize)) -> Option<SiteWeights<'b>> {
        let runs = self.reweighing.as_ref().and_then(|of| of.weights(measure.measure(), site));
        (runs.is_some() || !self.is_asked).then(|| SiteWeights::new(&measure.weights[site], runs))
    }
}

/// Position of the site `wanted`; of the only one where none is.
pub(super) fn site_index(source: &StudyOfResult, wanted: Option<&str>) -> Result<usize, DesignError> {
    Ok(match (wanted, &source.sites[..]) {
        (Some(wanted), known) => uplift_uniform_risk::site_index("--site", known, wanted)?,
        (None, [_]) => 0,
        (None, known) => {
            let (option, noun, known) = ("--site", "site", known.to_vec());
            return Err(JobError::Choice { option, noun, wanted: None, known }.into());
        }
    })
}

/// The measure `wanted`; the first where none is, which is PGV if the result has it.
pub(super) fn choose_measure(
    source: &StudyOfResult,
    wanted: Option<IntensityMeasure>,
) -> Result<&SpectraOfResult, DesignError> {
    let known: Vec<IntensityMeasure> = source.measures.iter().map(SpectraOfResult::measure).collect();
    Ok(&source.measures[uplift_uniform_risk::measure_index(&known, wanted)?])
}

/// Coefficient of restitution of a structure's oscillator: its own, else that of the study.
pub(super) fn restitution(structure: &Structure, study: &UniformRiskStudy) -> f64 {
    structure.description.restitution.unwrap_or(study.oscillator.restitution)
}

/// The records that shake a structure.
#[derive(Debug)]
pub(super) struct ShakenRecords {
    pub(super) set: RecordSet,
    /// Keys of their motions.
    pub(super) motions: Vec<String>,
}

impl ShakenRecords {
    pub(super) fn from_set(set: RecordSet) -> Self {
        Self { motions: motion_keys(&set.records), set }
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.set.records.len()
    }
}

/// The records of the result, with the pairs that they are of where a structure is `with_pairs`; none where they cannot
/// be read, with the reason, unless a manifest was given for them.
pub(super) fn records_and_pairs(
    source: &StudyOfResult,
    manifest: Option<&Path>,
    with_pairs: bool,
) -> Result<Result<(ShakenRecords, Option<Pairs>), String>, DesignError> {
    let per_pair = source.study.records.component.records_per_pair();
    let found = if with_pairs {
        source.records_and_pairs().map(|(set, pairs)| (set, Some(Pairs::new(pairs, per_pair))))
    } else {
        source.records().map(|set| (set, None))
    };
    match found {
        Err(reason) if manifest.is_some() => Err(JobError::input(reason).into()),
        found => Ok(found.map(|(set, pairs)| (ShakenRecords::from_set(set), pairs))),
    }
}

/// What was read of the records, without which `subject` cannot be computed.
pub(super) fn required<T>(found: Result<T, String>, subject: &str) -> Result<T, DesignError> {
    Ok(found.map_err(|reason| {
        JobError::input(format!(
            "{reason}; {subject} needs the records that the result was made from (--manifest says where they are)"
        ))
    })?)
}

/// A job on a structure, for the names of its files: `design pier`.
pub(super) fn job_name(verb: &str, structure: &Structure) -> String {
    format!("{verb} {}", structure.file.file_stem().unwrap_or_default().to_string_lossy())
}

/// Refuses `tables`, each with a column by which it is known, that would overwrite something, before anything is
/// computed.
///
/// # Errors
/// A table in place of a file that the job reads, or of one that it did not write; a place that cannot be written to.
pub(super) fn check_tables(
    tables: &[(&Path, &'static str)],
    (structure, result, manifest): (&Structure, &Path, Option<&Path>),
    force: bool,
) -> Result<(), DesignError> {
    let inputs = inputs(structure, result, manifest);
    let output =
        |&(path, column): &(&Path, &'static str)| Output::new(path, OutputKind::Table(column)).with_result(result);
    Ok(outputs::check(&tables.iter().map(output).collect::<Vec<_>>(), &inputs, force)?)
}

/// The structure, the result, the manifest that is given in place of the study's, and the files that the result was
/// made from, where they still are; a result that cannot be opened is reported later.
fn inputs(structure: &Structure, result: &Path, manifest: Option<&Path>) -> Vec<PathBuf> {
    let of_study = || {
        let study = AnyStudy::UniformRisk(Box::new(ResultFile::open(result).ok()?.stored_study().ok()?));
        Some(study.inputs().into_iter().map(Path::to_owned).collect::<Vec<_>>())
    };
    let mut inputs = vec![structure.file.clone(), result.to_owned()];
    inputs.extend(manifest.map(Path::to_owned));
    inputs.extend(of_study().unwrap_or_default());
    let records: Vec<PathBuf> = inputs.iter().skip(2).flat_map(|path| record_files(path)).collect();
    inputs.extend(records);
    inputs
}
