//! The demands on a structure at every level, and the displacements at which its limit states begin: what fragilities
//! are made of.

use std::path::{Path, PathBuf};

use uplift_ida::System;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_study::Structure;
use uplift_uniform_risk::StudyOfResult;

use super::certainty::Scatter;
use super::models::travel_over_block;
use super::opening::job_name;
use super::overturning::{OverturningAnalysis, OverturningOptions, peaks_m};
use super::risk::{OVERTURNING_M, oscillator_capacity_m};
use crate::error::DesignError;

/// What is asked of the limit states of a structure.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitOptions {
    /// Manifest of the records, where it is no longer where the study says.
    pub manifest: Option<PathBuf>,
    /// Intensity measure; all of the result where none is given.
    pub measure: Option<IntensityMeasure>,
    /// The part of its displacement capacity at which a limit state of its own begins, between 0 and 1.
    pub capacity_share: f64,
}

/// The [part of the capacity](LimitOptions::capacity_share) that is a limit state unless another is asked for.
pub const CAPACITY_SHARE: f64 = 0.5;

/// A limit state: a displacement that is exceeded.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitState {
    /// `uplift`, `capacity_50pct`, `capacity` or `overturning`.
    pub name: String,
    /// The displacement of the structure, m; infinite for overturning.
    pub displacement_m: f64,
    /// The same of the model, which is held against its demands, m: larger than any displacement for overturning.
    pub threshold_m: f64,
}

/// One model of a structure under the records of a result, scaled to every level of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitStripes {
    /// The measure.
    pub measure: IntensityMeasure,
    /// `oscillator`, `block`, `equivalent block`, `wobbling frame` or `planar frame`.
    pub model: &'static str,
    /// The levels, in the unit of the measure, ascending.
    pub levels: Vec<f64>,
    /// Names of the records: each motion once, whatever structures of the study it shakes.
    pub records: Vec<String>,
    /// Peak displacements of the model `[record, level]`, m; infinite where it overturns.
    pub demands_m: Vec<f64>,
    /// Displacement of the structure over that of the model.
    pub participation: f64,
    /// Its limit states, the first that begins first.
    pub limits: Vec<LimitState>,
}

/// The demands on `structure` under the records of the result at `result`: by each measure its models, as
/// [`overturning`](super::overturning) has them.
///
/// # Errors
/// A share of the capacity that is none; a file that is missing, damaged, no result, or without sites; records that
/// cannot be read, or that are others at each level; [`JobError::Paused`] where `events` say so,
/// [`JobError::Interrupted`] where no checkpoint can be written beside the result.
pub fn limit_stripes(
    structure: &Structure,
    result: &Path,
    options: &LimitOptions,
    events: &dyn Events,
) -> Result<Vec<LimitStripes>, DesignError> {
    let share = options.capacity_share;
    if !(share > 0.0 && share < 1.0) {
        return Err(JobError::Usage(format!("--capacity-share {share}: give a share between 0 and 1")).into());
    }
    let file = ResultFile::open(result)?;
    file.refuse_records_at_level("limit states are counted among the same records at every level")?;
    let source = StudyOfResult::read(&file, options.manifest.as_deref())?;
    let asked =
        OverturningOptions { manifest: options.manifest.clone(), measure: options.measure, ..Default::default() };
    let mut analysis = OverturningAnalysis::from_structure(structure, &source, &asked, &mut Vec::new())?;
    // the structure as it is described alone
    analysis.uncertain = None;
    let work = analysis.work(&job_name("fragility", structure), &[1.0])?;
    let (analysed, checkpoint) = work.asked_of(result, &[], events)?;
    let mut analysed = analysed.into_iter();
    let records: Vec<String> = analysis.records.set.records.iter().map(|record| record.id.clone()).collect();
    let mut found = Vec::new();
    for measure in &analysis.measures {
        for ((model, _), analysed) in analysis.models.iter().zip(analysed.by_ref()) {
            let levels = measure.plan.levels.to_vec();
            found.push(LimitStripes {
                measure: measure.measure(),
                model: analysis.kind(model),
                records: records.clone(),
                demands_m: peaks_m(&analysed, levels.len(), 0),
                participation: participation(model, structure),
                limits: limits(model, structure, share),
                levels,
            });
        }
    }
    let frame_models = || analysis.models().skip(analysis.models.len()).map(|(model, ..)| model);
    for (measure, levels, peaks) in analysis.frame_peaks(&mut analysed) {
        for ((model, demands_m), system) in peaks.each().zip(frame_models()) {
            found.push(LimitStripes {
                measure: measure.measure(),
                model,
                levels: levels.values.clone(),
                records: records.clone(),
                demands_m: demands_m.to_vec(),
                participation: participation(system, structure),
                limits: limits(system, structure, share),
            });
        }
    }
    checkpoint.remove();
    Ok(found)
}

/// The positions of the records of each earthquake of a result where there are several that are known, else of each
/// pair: what is independent of the others.
///
/// # Errors
/// A file that is damaged, or of another kind.
pub fn independent_records(file: &ResultFile) -> Result<Vec<Vec<usize>>, DesignError> {
    Ok(Scatter::from_file(file)?.coarsest().to_vec())
}

/// Displacement of the structure over that of one of its models.
fn participation(model: &System, structure: &Structure) -> f64 {
    match model {
        System::Oscillator(_) => structure.system.participation(),
        System::Block(block) => travel_over_block(structure, block),
        System::Frame(_) => 1.0,
    }
}

/// The limit states of one model of a structure.
fn limits(model: &System, structure: &Structure, share: f64) -> Vec<LimitState> {
    let (uplift_m, capacity_m) = match model {
        System::Oscillator(oscillator) => (oscillator.uplift_displacement_m(), oscillator_capacity_m(oscillator)),
        // the corner of a block that stands on its other one is above it
        System::Block(block) => (0.0, Some(block.top_displacement_m(block.slenderness_rad()))),
        System::Frame(_) => (0.0, structure.system.capacity_m()),
    };
    let factor = participation(model, structure);
    let at = |name: String, threshold_m: f64| LimitState { name, displacement_m: factor * threshold_m, threshold_m };
    let mut limits = vec![at("uplift".to_owned(), uplift_m)];
    if let Some(capacity_m) = capacity_m {
        limits.push(at(format!("capacity_{}pct", (1e4 * share).round() / 1e2), share * capacity_m));
        limits.push(at("capacity".to_owned(), capacity_m));
    }
    if model.can_overturn() {
        let name = "overturning".to_owned();
        limits.push(LimitState { name, displacement_m: f64::INFINITY, threshold_m: OVERTURNING_M });
    }
    limits.retain(|limit| limit.name == "uplift" || limit.threshold_m > uplift_m);
    limits
}
