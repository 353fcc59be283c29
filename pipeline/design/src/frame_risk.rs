//! The risk of a frame itself: its own motion under the pairs and the hazard of a result, beside what its proxies say.
//!
//! The frame takes the place of the oscillator: one structure in place of the strength axis, both components of a pair
//! scaled together by the factor of the measure; stripes, fragility and risk integral are those of a spectrum. What the
//! planar frame, the equivalent oscillator and the spectrum make of the same records is their error under risk, with
//! the noise that the same resamples of the records leave of it.

mod analysis;
mod demand;
mod edps;
mod report;
mod tables;

use std::path::{Path, PathBuf};

use clap::Args;
use uplift_bootstrap::{ResamplingPlan, Unit};
use uplift_fragility::Stripes;
use uplift_frame::Model;
use uplift_ida::{PLANAR_FRAME, Shard, WOBBLING_FRAME};
use uplift_motion::IntensityMeasure;
use uplift_risk::PooledDemand;
use uplift_structure::{Kind, Rule};
use uplift_study::Structure;

pub use demand::{Banded, ModelDemand, RiskPoint};
pub use edps::{DirectionEffect, EventReport, StateAtDemand};
pub use report::{FrameOverturning, FrameRiskReport};

use super::certainty::{Bands, Scatter, rate_bands};
use super::collapse::{Collapse, collapse};
use super::design::{DesignOptions, design};
use super::hazard::Hazard;
use super::limit::{FrameLimit, LimitRisk};
use super::lognormal::lognormal_bands;
use super::opening::{Place, check_tables, choose_measure, job_name, restitution};
use super::own_structure::loss;
use super::report::{ReportSource, StructureReport};
use super::risk::{OVERTURNING_M, at_place, own_risk};
use crate::error::DesignError;
use analysis::{Demands, FrameAnalysis};
use demand::{Question, Resampled};
use tables::{levels_path, write_tables};
use uplift_alarms::{Scope, alarms_of_inputs, own_risk_alarms, ranked, structure_alarms};
use uplift_engine::analysis::ShardReport;
use uplift_inputs::TORSION;
use uplift_job::events::{Events, Silent};
use uplift_result::ResultFile;
use uplift_uniform_risk::{OneRisk, StudyOfResult, at_target_risks, consistency};

/// What is asked of the risk of a frame.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct FrameRiskOptions {
    /// Manifest of the records, where it is no longer where the study says.
    #[arg(skip)]
    pub manifest: Option<PathBuf>,
    /// Site [default: the only one]
    #[arg(long)]
    pub site: Option<String>,
    /// The risk of the demand.
    #[command(flatten)]
    pub risk: OneRisk,
    /// Intensity measure [default: pgv]
    #[arg(long)]
    pub measure: Option<IntensityMeasure>,
    /// Model of the frame: wobbling or planar [default: by the shape of its columns]
    #[arg(long, value_name = "MODEL", value_parser = frame_model)]
    pub model: Option<Model>,
    /// CSV file of the peak of every record, level and model to write; what they come to at each level goes to one that
    /// ends in .levels.csv beside it.
    #[arg(skip)]
    pub table: Option<PathBuf>,
    /// Every shard of the analyses, as [`frame_risk_shard`] wrote them; none to compute them here.
    #[arg(skip)]
    pub shards: Vec<PathBuf>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

/// Reads the name of a model of a frame.
///
/// # Errors
/// Another word.
pub fn frame_model(word: &str) -> Result<Model, String> {
    match word {
        "planar" => Ok(Model::Planar),
        "wobbling" => Ok(Model::Wobbling),
        _ => Err("it is planar or wobbling".to_owned()),
    }
}

/// The risk of the frame of `structure` under the records and the hazard of the result at `result`.
///
/// # Errors
/// A structure that is no frame, or of rectangular columns that are to wobble; a file that is missing, damaged, no
/// result, or without sites; spectra of another system than ZSBE; a site or measure that the result does not have; a
/// risk that is none; records that cannot be read; tables that cannot be written or would replace something
/// else; shards that do not belong together; [`JobError::Paused`](uplift_job::JobError::Paused) where `events` say so,
/// [`JobError::Interrupted`](uplift_job::JobError::Interrupted) where no checkpoint can be written beside the result.
pub fn frame_risk(
    structure: &Structure,
    result: &Path,
    options: &FrameRiskOptions,
    events: &dyn Events,
) -> Result<FrameRiskReport, DesignError> {
    let manifest = options.manifest.as_deref();
    if let Some(path) = &options.table {
        let levels = levels_path(path);
        let tables: [(&Path, _); 2] = [(path, tables::PEAKS_COLUMN), (&levels, tables::LEVELS_COLUMN)];
        check_tables(&tables, (structure, result, manifest), options.force)?;
    }
    let file = at_target_risks(ResultFile::open(result)?, &options.risk.into())?;
    file.refuse_records_at_level("a frame is shaken by the same records at every level")?;
    let source = StudyOfResult::read(&file, manifest)?;
    let place = Place::choose(&source, options.site.as_deref(), options.measure)?;
    let Place { site, measure, .. } = place;
    let poe = source.rarest()?;
    let target_per_year = source.target_per_year(poe)?;
    let analysis = FrameAnalysis::from_structure(structure, &source, options.model)?;
    // what the spectrum says, and how an engineer reads it
    let asked = DesignOptions {
        manifest: options.manifest.clone(),
        site: options.site.clone(),
        risk: options.risk,
        measure: options.measure,
        spectrum_only: true,
        ..DesignOptions::default()
    };
    let design = design(structure, result, &asked, &Silent)?;
    let work = analysis.work(measure, &job_name("risk", structure))?;
    let (analysed, checkpoint) = work.asked_of(result, &options.shards, events)?;
    let demands = analysis.demands(analysed);

    let reweighing = consistency::Reweighing::from_motions(&file)?;
    let repaired = reweighing.as_ref().and_then(|of| of.weights(measure.measure(), site));
    let weights = &measure.weights[site];
    let settings = &source.study.bootstrap;
    let plan = draws(&file, &source, &analysis)?;
    let levels: &[f64] = &measure.plan.levels;
    let (scatter, confidence) = (&Scatter::from_file(&file)?, settings.confidence);
    let question = Question { levels, weights, repaired, target_per_year, scatter, plan: &plan, confidence };
    let own_m = demands.wobbling_m.as_ref().unwrap_or(&demands.planar_m);
    let own = question.ask(own_m, 1.0)?;
    let demand_m = own.demand_m;
    let rows = rows(&question, own, &demands, (structure, &design))?;
    let years = source.study.risk.years;
    let runs_m = analysis.once_a_run(&demands);
    let pairs = uplift_bootstrap::units(&analysis.pair_of());
    let mut overturning = collapse(levels, (&runs_m, &pairs), &[(weights, None)], years, true)?;
    if repaired.is_some() {
        // the weights of a repair are of records
        overturning.repaired = collapse(levels, (own_m, &pairs), &[(weights, repaired)], years, true)?.repaired;
    }
    let hazard = Hazard::from_file(&file, &source, (measure, site))?;
    let counted = PooledDemand::new(&Stripes::new(levels, own_m)?)?;
    let bands = rate_bands(&counted, (&hazard, None), scatter, OVERTURNING_M)?;
    let limit = FrameLimit::from_structure(structure, Some(analysis.frame.columns()));
    let of_limit =
        |limit: FrameLimit| LimitRisk::new(&counted, (&hazard, None), scatter, (limit.displacement_m, years));
    let beyond_limit = limit.map(of_limit).transpose()?;
    let mut of_fit = lognormal_bands((levels, own_m), &[hazard], scatter)?;
    let scope = Scope { site: Some(site), measure: Some(measure.measure()), repaired: true, ..Scope::default() };
    let mut alarms = alarms_of_inputs(&file, &scope)?;
    alarms.extend(structure_alarms(structure));
    let counts = (runs_m.len() / levels.len(), pairs.len());
    // what may come from outside the stripes
    let event =
        format!("overturning of the {}", if structure.description.kind == Kind::Block { "block" } else { "frame" });
    let own = overturning.risks.iter().map(|&risk| (event.as_str(), risk));
    let own = own.map(|event| own_risk(event, (place.name, measure), counts));
    alarms.extend(own_risk_alarms(&at_place(own, place)));
    let mut report = FrameRiskReport {
        structure: StructureReport::from_structure(structure, Some(restitution(structure, &source.study))),
        site: place.name.to_owned(),
        im: measure.measure().label(),
        other_measures: design.by_other_measures.iter().map(|of| of.im).collect(),
        unit: measure.measure().unit(),
        poe: source.study.risk.poe[poe],
        years,
        target_per_year,
        records: analysis.records.count(),
        analyses: demands.analyses,
        planar_restitution: analysis.restitution.0,
        planar_restitution_from: analysis.restitution.1,
        replicates: plan.replicates(),
        confidence: settings.confidence,
        at_demand: StateAtDemand::at_displacement(&analysis.frame, demand_m),
        events: edps::events(&analysis.frame, levels, (weights, &runs_m), (repaired, own_m), &pairs, years)?,
        direction: demands.wobbling_m.is_some().then(|| DirectionEffect::from_peaks(&demands.directions_m)),
        notes: notes(&analysis, (structure, &demands), &source, &overturning),
        demands: rows,
        limit,
        beyond_limit,
        overturning: FrameOverturning::from_collapse(&overturning, [bands, of_fit.pop().flatten()]),
        alarms: ranked(alarms),
        files: Vec::new(),
        source: ReportSource::read(&file, &source)?,
    };
    if let Some(path) = &options.table {
        write_tables(path, &report, (&analysis.records.set, levels, &demands))?;
        report.files = vec![path.clone(), levels_path(path)];
    }
    checkpoint.remove();
    Ok(report)
}

/// Computes one shard of the analyses into a file beside the result, for [`FrameRiskOptions::shards`].
///
/// # Errors
/// As [`frame_risk`].
pub fn frame_risk_shard(
    structure: &Structure,
    result: &Path,
    options: &FrameRiskOptions,
    shard: Shard,
    events: &dyn Events,
) -> Result<ShardReport, DesignError> {
    let source = StudyOfResult::read(&ResultFile::open(result)?, options.manifest.as_deref())?;
    let measure = choose_measure(&source, options.measure)?;
    let analysis = FrameAnalysis::from_structure(structure, &source, options.model)?;
    Ok(analysis.work(measure, &job_name("risk", structure))?.shard_beside(result, shard, events)?)
}

/// The draws of the bands: pairs, or earthquakes with all their records.
fn draws(file: &ResultFile, source: &StudyOfResult, analysis: &FrameAnalysis) -> Result<ResamplingPlan, DesignError> {
    let settings = &source.study.bootstrap;
    let records = analysis.records.count();
    let sizes = [u32::try_from(records).unwrap_or(u32::MAX)];
    let replicates = usize::try_from(settings.replicates).unwrap_or(usize::MAX);
    let drawn_together = match settings.unit {
        Unit::Event => Some(consistency::Question::from_motions(file)?.event_of()),
        // all records of a pair are one wobbling run
        Unit::Record | Unit::Pair if analysis.pairs.all.len() < records && analysis.pairs.all.len() > 1 => {
            Some(analysis.pair_of())
        }
        Unit::Record | Unit::Pair => None,
    };
    let plan = match drawn_together {
        Some(units) => ResamplingPlan::draw_events(&units, &sizes, replicates, source.study.seed),
        None => ResamplingPlan::draw(records, &sizes, replicates, source.study.seed),
    };
    Ok(plan?)
}

/// The demand on the frame itself, then on its proxies.
fn rows(
    question: &Question<'_>,
    own: Resampled,
    demands: &Demands,
    (structure, design): (&Structure, &super::DesignReport),
) -> Result<Vec<ModelDemand>, DesignError> {
    let factor = structure.system.participation();
    let zero = question.ask(&demands.zero_stiffness_m, factor)?;
    let oscillator = question.ask(&demands.oscillator_m, factor)?;
    let mut rows = Vec::new();
    if demands.wobbling_m.is_some() {
        rows.push(question.row(PLANAR_FRAME, question.ask(&demands.planar_m, 1.0)?, Some(&own)));
    }
    rows.push(question.row("equivalent oscillator", oscillator, Some(&own)));
    if let Some(spectrum) = &design.spectrum {
        let read = zero.through(spectrum.zero_stiffness_demand_m, Ok)?;
        rows.push(question.row("spectrum, zero stiffness", read, Some(&own)));
    }
    for outcome in &design.rules {
        let Some(check) = &outcome.from_spectrum else { continue };
        let rule = |zero_m: f64| -> Result<f64, DesignError> {
            if zero_m.is_infinite() {
                return Ok(f64::INFINITY);
            }
            let demand = structure.system.capacity().and_then(|capacity| outcome.rule.demand(&capacity, zero_m))?;
            Ok(demand.displacement_m())
        };
        let model = match outcome.rule {
            Rule::EqualDisplacement => "spectrum, equal displacement",
            Rule::EqualEnergy => "spectrum, equal energy",
        };
        rows.push(question.row(model, zero.through(check.demand_m, rule)?, Some(&own)));
    }
    let model = if demands.wobbling_m.is_some() { WOBBLING_FRAME } else { PLANAR_FRAME };
    rows.insert(0, question.row(model, own, None));
    Ok(rows)
}

/// What the models leave out, and what is assumed of the records.
fn notes(
    analysis: &FrameAnalysis,
    (structure, demands): (&Structure, &Demands),
    source: &StudyOfResult,
    overturning: &Collapse,
) -> Vec<String> {
    let mut notes = Vec::new();
    if structure.uncertainty.is_some() {
        notes.push(
            "[uncertainty] applies to the equivalent oscillator and is ignored here: uplift overturning and uplift \
             design include it"
                .to_owned(),
        );
    }
    if demands.wobbling_m.is_some() {
        notes.push(TORSION.to_owned());
        notes.push(loss(structure));
        let alone = analysis.without_second();
        if !alone.is_empty() {
            notes.push(format!(
                "{} of {} pairs have the same motion as both components, and move the frame along one line: {}",
                alone.len(),
                analysis.pairs.all.len(),
                alone.join(", ")
            ));
        }
        let apart: Vec<&str> = (analysis.pairs.all.iter())
            .filter(|pair| pair.metadata.contains_key(uplift_inputs::pairs::START_APART))
            .map(|pair| pair.id.as_str())
            .collect();
        if !apart.is_empty() {
            notes.push(format!(
                "{} pairs have components that begin at different times, and are taken to begin together: {}",
                apart.len(),
                apart.join(", ")
            ));
        }
    } else if analysis.frame.shape() == uplift_frame::ColumnShape::Rectangle {
        notes.push(
            "a rectangular section does not wobble: the motion is planar, under the components of the study \
             (column_shape = \"cylinder\" wobbles)"
                .to_owned(),
        );
    }
    if !source.study.oscillator.free_vibration {
        notes.push(
            "the study ends with its records (free_vibration = false); a frame that falls after their end counts as \
             overturned"
                .to_owned(),
        );
    }
    notes.extend(overturning.fit.as_ref().err().map(|reason| format!("no lognormal fragility: {reason}")));
    notes
}

impl FrameOverturning {
    fn from_collapse(found: &Collapse, [bands, lognormal_bands]: [Option<Bands>; 2]) -> Self {
        let fit = found.fit.as_ref().ok();
        Self {
            levels: found.counts.iter().map(|count| count.level).collect(),
            overturned: found.counts.iter().map(|count| count.exceedances).collect(),
            risk: found.risks[0],
            repaired: found.repaired[0],
            theta: fit.map(|fit| fit.fragility.median()),
            beta: fit.map(|fit| fit.fragility.dispersion()),
            lognormal_per_year: found.fitted.as_ref().map(|fitted| fitted[0].per_year),
            bands,
            lognormal_bands,
            fit: fit.copied(),
        }
    }
}
