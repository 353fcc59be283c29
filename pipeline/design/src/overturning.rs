//! How often a structure overturns, by its equivalent oscillator and by the rigid block that rotates as it does
//! (Section 2.4.3).

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_alarms::{OwnRisk, Scope, alarms_of_inputs, own_risk_alarms, ranked, structure_alarms};
use uplift_engine::analysis::{Analysed, LabelledPlan, ResultJob, ShardReport, Work};
use uplift_fragility::{LognormalFit, Stripes as Stripe};
use uplift_ida::{Shard, System};
use uplift_inputs::RecordSet;
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_job::events::Events;
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_risk::{PooledDemand, RunWeights, StripeWeights};
use uplift_spectra::{NUDGES, Noisy, nudges};
use uplift_structure::UncertainQuantity;
use uplift_study::{Structure, Uncertainty, UniformRiskStudy};
use uplift_uniform_risk::{EventRisk, SpectraOfResult, Stripes, StudyOfResult, plan_stripes};

use super::certainty::{Bands, Scatter, rate_bands};
use super::collapse::{Collapse, collapse};
use super::hazard::Hazard;
use super::lognormal::lognormal_bands;
use super::models::models;
use super::opening::{
    ShakenRecords, check_tables, choose_measure, job_name, records_and_pairs, required, site_index,
    study_with_common_records,
};
use super::own_frame::{FramePeaks, OwnFrame, STOPPED, falls, of_frame};
use super::report::{ReportSource, StructureReport};
use super::risk::{OVERTURNING_M, own_risk};
use super::tables::{risk_path, write_tables};
use super::uncertain::{Event, SiteQuestions, Uncertain, UncertaintyReport};
use super::weights::RepairedWeights;
use crate::error::DesignError;

/// What is asked of the overturning of a structure.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OverturningOptions {
    /// Manifest of the records, where it is no longer where the study says.
    pub manifest: Option<PathBuf>,
    /// Site of the result; all where none is given.
    pub site: Option<String>,
    /// Intensity measure; all of the result where none is given.
    pub measure: Option<IntensityMeasure>,
    /// One coefficient of restitution for both models, in place of the structure's, the study's (oscillator) and that
    /// of angular momentum (block).
    pub restitution: Option<f64>,
    /// Leave the frame itself out.
    pub proxy: bool,
    /// CSV file of the collapse fragility to write; the risk goes to one that ends in .risk.csv beside it.
    pub table: Option<PathBuf>,
    /// Every shard of the analyses, as [`overturning_shard`] wrote them; none to compute them here.
    pub shards: Vec<PathBuf>,
    /// Whether existing files are overwritten.
    pub force: bool,
}

/// The report of the overturning of a structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverturningReport {
    /// The structure; each model has its own restitution.
    pub structure: StructureReport,
    /// The result that it was examined under.
    #[serde(flatten)]
    pub source: ReportSource,
    /// Years that probabilities refer to.
    pub years: f64,
    /// How the structure is modelled.
    pub models: Vec<ModelReport>,
    /// Fragility and risk, one a measure and model, in this order.
    pub overturning: Vec<CollapseReport>,
    /// The oscillator where its quantities are not known exactly; none where the structure file says that they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyReport>,
    /// Why a frame that can wobble is left out although no `--proxy` asks for that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_frame: Option<String>,
    /// How the models differ, and what could not be done.
    pub notes: Vec<String>,
    /// What to know before using the numbers, the worst first.
    pub alarms: Vec<Alarm>,
    /// What was written.
    #[serde(skip)]
    pub files: Vec<PathBuf>,
}

/// A model of a structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelReport {
    /// `oscillator`, `block`, `wobbling frame` or `planar frame`.
    pub model: &'static str,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Where that comes from.
    pub restitution_from: &'static str,
    /// Half diagonal R of the block, m; none for the oscillator.
    pub size_m: Option<f64>,
    /// Slenderness α of the block, rad; none for the oscillator.
    pub slenderness_rad: Option<f64>,
}

/// Overturning of one model by one measure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CollapseReport {
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Unit of the levels.
    pub unit: &'static str,
    /// `oscillator`, `block`, `wobbling frame` or `planar frame`.
    pub model: &'static str,
    /// Levels of the stripes, ascending.
    pub levels: Vec<f64>,
    /// Records that overturn the structure at each level.
    pub overturned: Vec<u32>,
    /// Fewest and most of them with all scale factors up to 4e-15 smaller and larger: another count than the one above
    /// hangs on runs beyond double precision (docs/method.md, section 1.5).
    pub overturned_rounding: Vec<[u32; 2]>,
    /// Records.
    pub records: u32,
    /// Median of the lognormal fragility of maximum likelihood; none where there is no fit.
    pub theta: Option<f64>,
    /// Its dispersion.
    pub beta: Option<f64>,
    /// The median with its range over the same scale factors; NaN where one of them has no fit.
    pub theta_rounding: Option<Noisy>,
    /// The dispersion with its range.
    pub beta_rounding: Option<Noisy>,
    /// Its logarithmic likelihood.
    pub log_likelihood: Option<f64>,
    /// The risk at each site.
    pub sites: Vec<SiteRisk>,
    /// The fit itself.
    #[serde(skip)]
    pub fit: Option<LognormalFit>,
}

/// The risk of overturning at one site.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SiteRisk {
    /// The site.
    pub site: String,
    /// From the counts, with no curve fitted.
    #[serde(flatten)]
    pub risk: EventRisk,
    /// Its confidence band by the records; none where no run shows it, and of a single record.
    pub bands: Option<Bands>,
    /// From the counts with repaired weights, by which the records bring the site's hazard; none where the result has
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repaired: Option<EventRisk>,
    /// How sure that is; none where there is none, and where no run shows it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repaired_bands: Option<Bands>,
    /// Frequency with the lognormal fragility in place of the counts, 1/yr; none without a fit.
    pub lognormal_per_year: Option<f64>,
    /// Its confidence band by the records; none without a fit, where that hangs on one record, and of a single one.
    pub lognormal_bands: Option<Bands>,
    /// The frequency from the counts with its range over scale factors up to 4e-15 smaller and larger, 1/yr.
    pub per_year_rounding: Noisy,
    /// That with the lognormal fragility; NaN where one of them has no fit.
    pub lognormal_per_year_rounding: Option<Noisy>,
}

/// How often `structure` overturns under the records and the hazard of the result at `result`.
///
/// # Errors
/// A file that is missing, damaged, no result, or without sites; a site or measure that it does not have; a restitution
/// that cannot be; records that cannot be read; tables that cannot be written or would replace something else; shards
/// that do not belong together; [`JobError::Paused`] where `events` say so, [`JobError::Interrupted`] where no
/// checkpoint can be written beside the result.
pub fn overturning(
    structure: &Structure,
    result: &Path,
    options: &OverturningOptions,
    events: &dyn Events,
) -> Result<OverturningReport, DesignError> {
    let manifest = options.manifest.as_deref();
    if let Some(path) = &options.table {
        let risk = risk_path(path);
        check_tables(&[(path, "im"), (&risk, "site")], (structure, result, manifest), options.force)?;
    }
    let file = ResultFile::open(result)?;
    let reason = "overturning is counted among the same records at every level";
    let source = study_with_common_records(&file, manifest, reason)?;
    let sites = match &options.site {
        Some(site) => vec![site_index(&source, Some(site))?],
        None => (0..source.sites.len()).collect(),
    };
    let mut notes = Vec::new();
    let analysis = OverturningAnalysis::from_structure(structure, &source, options, &mut notes)?;
    if !source.study.oscillator.free_vibration {
        notes.push(
            "the study ends with its records (free_vibration = false); here what falls after their end counts as \
             overturned"
                .to_owned(),
        );
    }
    let name = job_name("overturning", structure);
    let job = ResultJob { result, name: &name };
    let (analysed, checkpoint) = job.results(analysis.work(&name, &factors())?, &options.shards, events)?;
    let OverturningAnalysis { study, records, measures, models, uncertain, .. } = &analysis;
    let repaired = RepairedWeights::from_file(&file)?;
    let scatter = Scatter::from_file(&file)?;
    let mut analysed = analysed.into_iter();
    let mut found: Vec<(&SpectraOfResult, Vec<Collapses>)> = Vec::new();
    let mut hazards: Vec<Vec<Hazard<'_>>> = Vec::new();
    for &measure in measures {
        let hazard = Hazard::from_sites(&file, (&source, &sites), measure)?;
        let weights: Vec<(&StripeWeights, Option<&RunWeights>)> =
            sites.iter().map(|&site| (&measure.weights[site], repaired.at(measure, site))).collect();
        let of_models = models.iter().zip(analysed.by_ref()).map(|((model, _), analysed)| {
            let levels = &measure.plan.levels;
            let peaks_m_at = |nudge: usize| peaks_m(&analysed, levels.len(), nudge);
            let at_nudge = |nudge: usize| {
                let runs = (&peaks_m_at(nudge)[..], &scatter.pairs[..]);
                collapse(levels, runs, &weights, study.risk.years, model.can_overturn())
            };
            let rounded = (1..=NUDGES).map(at_nudge).collect::<Result<_, _>>()?;
            let demand = PooledDemand::new(&Stripe::new(levels, &peaks_m_at(0))?)?;
            let of_site = |hazard: &Hazard<'_>| rate_bands(&demand, (hazard, None), &scatter, OVERTURNING_M);
            let bands = hazard.iter().map(of_site).collect::<Result<_, _>>()?;
            let of_repaired = |(hazard, (_, repaired)): (&Hazard<'_>, &(&StripeWeights, Option<&RunWeights>))| {
                let of = |own| rate_bands(&demand, (hazard, Some(own)), &scatter, OVERTURNING_M);
                Ok::<_, DesignError>(repaired.map(of).transpose()?.flatten())
            };
            let repaired_bands = hazard.iter().zip(&weights).map(of_repaired).collect::<Result<_, _>>()?;
            let lognormal_bands = lognormal_bands((levels, &peaks_m_at(0)), &hazard, &scatter)?;
            Ok::<_, DesignError>(Collapses { own: at_nudge(0)?, rounded, bands, repaired_bands, lognormal_bands })
        });
        found.push((measure, of_models.collect::<Result<_, _>>()?));
        hazards.push(hazard);
    }
    let asked = FrameSites { sites: &sites, repaired: &repaired, scatter: &scatter, years: study.risk.years };
    let of_frame = analysis.frame_collapses(&mut analysed, &hazards, &asked)?;
    notes.extend(notes_on(models, &found));
    notes.extend(analysis.frame.as_ref().map(|_| self::of_frame(structure)));
    let names: Vec<&str> = sites.iter().map(|&site| source.sites[site].as_str()).collect();
    let uncertainty = match uncertain {
        Some(uncertain) => {
            let described = |measure: usize, place: usize| found[measure].1[OSCILLATOR].own.risks[place].per_year;
            let measures: Vec<(&SpectraOfResult, &[Hazard<'_>])> =
                found.iter().zip(&hazards).map(|((measure, _), hazard)| (*measure, &hazard[..])).collect();
            Some(uncertainty_report(uncertain, (&measures, &names), (analysed, (&records.set, &scatter)), &described)?)
        }
        None => None,
    };
    let mut alarms = alarms_of_inputs(&file, &Scope { measure: options.measure, ..Scope::default() })?;
    alarms.extend(structure_alarms(structure));
    let counts = (records.count(), scatter.pairs.len());
    alarms.extend(own_risk_alarms(&own_risks(models, &found, &names, counts)));
    let records = u32::try_from(records.count()).unwrap_or(u32::MAX);
    let mut report = OverturningReport {
        structure: StructureReport::from_structure(structure, None),
        years: study.risk.years,
        models: analysis.models().map(|(model, origin)| ModelReport::from_model(model, origin)).collect(),
        overturning: reports((&found, &of_frame), models, records, &names),
        uncertainty,
        without_frame: analysis.without_frame.clone(),
        notes,
        alarms: ranked(alarms),
        files: Vec::new(),
        source: ReportSource::read(&file, &source)?,
    };
    if let Some(path) = &options.table {
        write_tables(path, &report)?;
        report.files = vec![path.clone(), risk_path(path)];
    }
    checkpoint.remove();
    Ok(report)
}

/// Computes one shard of the analyses into a file beside the result, for [`OverturningOptions::shards`].
///
/// # Errors
/// As [`overturning`].
pub fn overturning_shard(
    structure: &Structure,
    result: &Path,
    options: &OverturningOptions,
    shard: Shard,
    events: &dyn Events,
) -> Result<ShardReport, DesignError> {
    let source = StudyOfResult::read(&ResultFile::open(result)?, options.manifest.as_deref())?;
    let analysis = OverturningAnalysis::from_structure(structure, &source, options, &mut Vec::new())?;
    let name = job_name("overturning", structure);
    Ok(ResultJob { result, name: &name }.shard(analysis.work(&name, &factors())?, shard, events)?)
}

/// Place of the equivalent oscillator among the models.
const OSCILLATOR: usize = 0;

/// The measure `wanted` of a result; all where none is.
fn measures(source: &StudyOfResult, wanted: Option<IntensityMeasure>) -> Result<Vec<&SpectraOfResult>, DesignError> {
    match wanted {
        Some(measure) => Ok(vec![choose_measure(source, Some(measure))?]),
        None => Ok(source.measures.iter().collect()),
    }
}

/// Peaks of the only system of an analysis, m, `[record, level]`, where the scale factors of all levels have factors on
/// them, of which this is the one at `factor`.
pub(super) fn peaks_m(analysed: &Analysed, levels: usize, factor: usize) -> Vec<f64> {
    let records = 0..analysed.peaks.axes().motions;
    records.flat_map(|record| &analysed.peaks.row_m(record, 0)[factor * levels..][..levels]).copied().collect()
}

/// The models of a structure, and the records that shake them.
pub(super) struct OverturningAnalysis<'a> {
    /// The study of the result, with what happens after the end of a record.
    study: UniformRiskStudy,
    records: ShakenRecords,
    pub(super) measures: Vec<&'a SpectraOfResult>,
    /// Each with the origin of its restitution.
    pub(super) models: Vec<(System, &'static str)>,
    /// The frame itself, with the positions of its levels, `[measure]`; none of a structure that cannot wobble.
    frame: Option<(OwnFrame, Vec<Vec<usize>>)>,
    /// Why one that can wobble is left out.
    without_frame: Option<String>,
    /// The structures that it may be; none where all of it is known.
    uncertain: Option<Uncertain<'a>>,
}

impl<'a> OverturningAnalysis<'a> {
    /// Of `structure` under the records of a result; `notes` gets what is left out of its models.
    pub(super) fn from_structure(
        structure: &'a Structure,
        source: &'a StudyOfResult,
        options: &OverturningOptions,
        notes: &mut Vec<String>,
    ) -> Result<Self, DesignError> {
        let measures = measures(source, options.measure)?;
        let mut models = models(structure, source, options.restitution, notes)?;
        let with_pairs = OwnFrame::can_be_shaken(structure) && !options.proxy;
        let stops = OwnFrame::is_described(structure) && !OwnFrame::can_be_shaken(structure) && !options.proxy;
        let mut without_frame = stops.then(|| STOPPED.to_owned());
        let found = records_and_pairs(source, options.manifest.as_deref(), with_pairs)?;
        let (records, pairs) = required(found, "overturning")?;
        let frame = pairs.map(|pairs| OwnFrame::from_structure(structure, pairs)).transpose()?;
        let mut frame = frame.map(|frame| {
            let levels = measures.iter().map(|of| frame.levels_that_uplift(&records.set, of)).collect::<Vec<_>>();
            (frame, levels)
        });
        if let Some((of, places)) = &frame {
            for (measure, places) in measures.iter().zip(places) {
                let levels: Vec<f64> = places.iter().map(|&place| measure.plan.levels[place]).collect();
                let falls = of.leaves_the_ground(&records.set, (measure.measure(), &levels))?;
                without_frame = without_frame.or(falls);
            }
        }
        frame = frame.filter(|_| without_frame.is_none());
        let mut study = source.study.clone();
        // what is lost when a record ends has overturned, whoever looks
        study.oscillator.free_vibration = true;
        if let Some(reason) = block_leaves_the_ground(&models, &study, &measures, &records.set)? {
            models.truncate(OSCILLATOR + 1);
            notes.push(format!("the block is not analysed: {reason}"));
        }
        let uncertain = uncertain_structures(structure, options.restitution, (&models[OSCILLATOR].0, records.count()))?;
        Ok(Self { study, records, measures, models, frame, without_frame, uncertain })
    }

    /// The same of the structure as it is described alone, without those that it may be.
    pub(super) fn described_alone(self) -> Self {
        Self { uncertain: None, ..self }
    }

    /// Oscillator and block, then the models of the frame, each with the origin of its restitution.
    pub(super) fn models(&self) -> impl Iterator<Item = (&System, &'static str)> {
        let of_frame = self.frame.iter().flat_map(|(frame, _)| frame.models());
        self.models.iter().map(|(model, origin)| (model, *origin)).chain(of_frame)
    }

    /// What the frame comes to by each measure: its stripes are the next of those `analysed`.
    fn frame_collapses(
        &self,
        analysed: &mut impl Iterator<Item = Analysed>,
        hazards: &[Vec<Hazard<'_>>],
        asked: &FrameSites<'_>,
    ) -> Result<Vec<FrameCollapses>, DesignError> {
        let of_measures = self.frame_peaks(analysed).into_iter().zip(hazards);
        of_measures
            .map(|((measure, places, peaks), hazard)| asked.collapses((measure, places), hazard, &peaks))
            .collect()
    }

    /// The peaks of the frame by each measure, with the positions of its levels; their stripes are the next of those
    /// `analysed`. None of a structure that cannot wobble.
    pub(super) fn frame_peaks(
        &self,
        analysed: &mut impl Iterator<Item = Analysed>,
    ) -> Vec<(&'a SpectraOfResult, &[usize], FramePeaks)> {
        let Some((frame, places)) = &self.frame else { return Vec::new() };
        let measures = self.measures.iter().zip(places);
        measures
            .map_while(|(&measure, places)| {
                let [wobbling, planar] = [analysed.next()?, analysed.next()?];
                Some((measure, &places[..], frame.peaks(&wobbling, Some(&planar))))
            })
            .collect()
    }

    /// The stripes of each model by each measure, the models running fastest, with each of the `factors` on all scale
    /// factors in turn. After all of them those of the frame, two a measure, and those of the structures
    /// that it may be, one a measure.
    pub(super) fn work(&self, title: &str, factors: &[f64]) -> Result<Work<'_>, DesignError> {
        let mut plans = Vec::new();
        let ShakenRecords { set, motions } = &self.records;
        for measure in &self.measures {
            for (model, _) in &self.models {
                let plan = plan_stripes(&self.study, &measure.plan, set, std::slice::from_ref(model))?;
                let plan = plan.multiplied(factors)?;
                let label = format!("{}, {}", measure.measure().label(), model.kind());
                plans.push(LabelledPlan { label, remark: None, plan, motions, known: None });
            }
        }
        for (place, measure) in self.measures.iter().enumerate() {
            let Some((frame, places)) = self.frame.as_ref().map(|(frame, places)| (frame, &places[place])) else {
                break;
            };
            let levels: Vec<f64> = places.iter().map(|&place| measure.plan.levels[place]).collect();
            plans.extend(frame.plans(&self.records, (measure.measure(), &levels))?);
        }
        if let Some(uncertain) = &self.uncertain {
            for measure in &self.measures {
                let label = measure.measure().label();
                plans.push(uncertain.plan((label, &self.study), &measure.plan, &self.records)?);
            }
        }
        Ok(Work::new(title, plans))
    }
}

/// Factors on every scale factor: 1, then those of its neighbours some roundings away.
fn factors() -> Vec<f64> {
    [1.0].into_iter().chain(nudges()).collect()
}

/// Why the block among `models` cannot be shaken: its records, scaled, let it leave the ground.
fn block_leaves_the_ground(
    models: &[(System, &'static str)],
    study: &UniformRiskStudy,
    measures: &[&SpectraOfResult],
    set: &RecordSet,
) -> Result<Option<String>, DesignError> {
    let verticals: Vec<_> = set.records.iter().filter_map(|record| record.vertical.as_ref()).collect();
    let verticals: Vec<_> = verticals.iter().map(|vertical| &vertical.accelerogram).collect();
    let Some(gravity_m_s2) = models.iter().find_map(|(model, _)| model.gravity_m_s2()) else { return Ok(None) };
    for measure in measures.iter().filter(|_| !verticals.is_empty()) {
        // the oscillator feels no vertical motion
        let plan = plan_stripes(study, &measure.plan, set, std::slice::from_ref(&models[OSCILLATOR].0))?;
        let falling = plan.multiplied(&factors())?.falling(&verticals, gravity_m_s2);
        if let Some(reason) = falls(&falling) {
            return Ok(Some(reason));
        }
    }
    Ok(None)
}

/// The structures that `structure` may be, whose `oscillator` is that of the structure as described; none where all of
/// it is known.
///
/// # Errors
/// A structure that cannot be; one restitution for all where the file says that it is uncertain.
fn uncertain_structures<'a>(
    structure: &'a Structure,
    for_both: Option<f64>,
    (oscillator, records): (&System, usize),
) -> Result<Option<Uncertain<'a>>, DesignError> {
    let is_uncertain = |of: &Uncertainty| of.quantities.contains(&UncertainQuantity::Restitution);
    if for_both.is_some() && structure.uncertainty.as_ref().is_some_and(is_uncertain) {
        return Err(JobError::Usage(format!(
            "--restitution: {} says that the restitution is uncertain: leave the option out, or \
             [uncertainty.restitution]",
            structure.file.display()
        ))
        .into());
    }
    Uncertain::from_structure(structure, oscillator.restitution(), records)
}

/// What the stripes of the structures say by each of `measures`, with the hazard of each of the sites; `described` is
/// the frequency for the structure as described, by the positions of measure and site.
fn uncertainty_report(
    uncertain: &Uncertain<'_>,
    (measures, sites): (&[(&SpectraOfResult, &[Hazard<'_>])], &[&str]),
    (analysed, (set, scatter)): (impl Iterator<Item = Analysed>, (&RecordSet, &Scatter)),
    described: &dyn Fn(usize, usize) -> f64,
) -> Result<UncertaintyReport, DesignError> {
    let (mut results, mut analyses) = (Vec::new(), 0);
    for ((index, (measure, hazard)), analysed) in measures.iter().enumerate().zip(analysed) {
        let asked = sites.iter().zip(*hazard).enumerate().map(|(place, (&name, hazard))| SiteQuestions {
            name,
            hazard,
            asked: vec![(Event::Overturning, described(index, place))],
        });
        let asked: Vec<SiteQuestions<'_>> = asked.collect();
        analyses += analysed.analyses;
        results.extend(uncertain.results(&Stripes::new(&measure.plan, set, analysed), &asked, scatter)?);
    }
    Ok(uncertain.report(analyses, results))
}

/// Overturning at the scale factors themselves, and at their neighbours some roundings away.
struct Collapses {
    own: Collapse,
    /// None of a frame, whose neighbours are not analysed.
    rounded: Vec<Collapse>,
    /// How sure its risks are, `[site]`.
    bands: Vec<Option<Bands>>,
    /// The same of those with repaired weights.
    repaired_bands: Vec<Option<Bands>>,
    /// The same of those by the lognormal fragility.
    lognormal_bands: Vec<Option<Bands>>,
}

/// Overturning of a frame by each of its models.
type FrameCollapses = Vec<(&'static str, Collapses)>;

/// The rows of a report: by each measure the models, those of the frame last.
fn reports(
    (found, of_frame): (&[(&SpectraOfResult, Vec<Collapses>)], &[FrameCollapses]),
    models: &[(System, &'static str)],
    records: u32,
    sites: &[&str],
) -> Vec<CollapseReport> {
    let of_measure = |(place, (measure, found)): (usize, &(&SpectraOfResult, Vec<Collapses>))| {
        let own = found.iter().zip(models).map(|(found, (model, _))| (found, model.kind()));
        let of_frame = of_frame.get(place).into_iter().flatten().map(|(model, found)| (found, *model));
        let report = |(found, model)| CollapseReport::from_collapse(found, measure.measure(), model, records, sites);
        own.chain(of_frame).map(report).collect::<Vec<_>>()
    };
    found.iter().enumerate().flat_map(of_measure).collect()
}

/// By what the peaks of a frame are weighed.
struct FrameSites<'a> {
    /// Positions of the sites.
    sites: &'a [usize],
    repaired: &'a RepairedWeights,
    scatter: &'a Scatter,
    years: f64,
}

impl FrameSites<'_> {
    /// Overturning at the levels of these positions among those of a measure, whose hazard is that of each site.
    fn collapses(
        &self,
        (measure, places): (&SpectraOfResult, &[usize]),
        hazard: &[Hazard<'_>],
        peaks: &FramePeaks,
    ) -> Result<FrameCollapses, DesignError> {
        let levels: Vec<f64> = places.iter().map(|&place| measure.plan.levels[place]).collect();
        let means = hazard.iter().map(|of| of.mean.at_levels(places)).collect::<Result<Vec<_>, _>>()?;
        let of_site = |(hazard, mean): (&Hazard<'_>, _)| hazard.at_levels(mean, places);
        let hazard = hazard.iter().zip(&means).map(of_site).collect::<Result<Vec<_>, _>>()?;
        let repaired = self.sites.iter().map(|&site| self.repaired.at(measure, site));
        let repaired = repaired.map(|runs| runs.map(|runs| runs.at_levels(places)).transpose());
        let repaired = repaired.collect::<Result<Vec<_>, _>>()?;
        let weights: Vec<_> = means.iter().zip(repaired.iter().map(Option::as_ref)).collect();
        let of_model = |(model, peaks_m): (&'static str, &[f64])| {
            let own = collapse(&levels, (peaks_m, &self.scatter.pairs), &weights, self.years, true)?;
            let demand = PooledDemand::new(&Stripe::new(&levels, peaks_m)?)?;
            let of = |hazard: &Hazard<'_>, runs: Option<&RunWeights>| {
                rate_bands(&demand, (hazard, runs), self.scatter, OVERTURNING_M)
            };
            let bands = hazard.iter().map(|hazard| of(hazard, None)).collect::<Result<_, _>>()?;
            let of_repaired = |(hazard, runs): (&Hazard<'_>, &Option<RunWeights>)| {
                runs.as_ref().map_or(Ok(None), |runs| of(hazard, Some(runs)))
            };
            let repaired_bands = hazard.iter().zip(&repaired).map(of_repaired).collect::<Result<_, _>>()?;
            let lognormal_bands = lognormal_bands((&levels, peaks_m), &hazard, self.scatter)?;
            Ok((model, Collapses { own, rounded: Vec::new(), bands, repaired_bands, lognormal_bands }))
        };
        peaks.each().map(of_model).collect()
    }
}

/// What the numbers rest on.
fn notes_on(models: &[(System, &'static str)], found: &[(&SpectraOfResult, Vec<Collapses>)]) -> Vec<String> {
    let mut notes = Vec::new();
    if let [(a, _), (b, _)] = models
        && a.restitution().to_bits() != b.restitution().to_bits()
    {
        notes.push(format!(
            "the oscillator keeps {} of its velocity at an impact, the block {:.4}, which explains part of the \
             difference (--restitution gives both the same)",
            a.restitution(),
            b.restitution()
        ));
    }
    for (measure, found) in found {
        let label = measure.measure().label();
        for (found, (model, _)) in found.iter().zip(models) {
            if let Err(reason) = &found.own.fit {
                notes.push(format!("no lognormal fragility of the {} by {label}: {reason}", model.kind()));
            }
        }
    }
    notes
}

/// The risk of every model at every site by every measure.
fn own_risks(
    models: &[(System, &'static str)],
    found: &[(&SpectraOfResult, Vec<Collapses>)],
    sites: &[&str],
    counts: (usize, usize),
) -> Vec<OwnRisk> {
    let mut risks = Vec::new();
    for (measure, found) in found {
        for (found, (model, _)) in found.iter().zip(models) {
            let event = format!("overturning of the {}", model.kind());
            let of_site = |(site, &risk): (&&str, &EventRisk)| own_risk((&event, risk), (site, measure), counts);
            risks.extend(sites.iter().zip(&found.own.risks).map(of_site));
        }
    }
    risks
}

impl ModelReport {
    fn from_model(model: &System, restitution_from: &'static str) -> Self {
        let block = match model {
            System::Oscillator(_) | System::Frame(_) => None,
            System::Block(block) => Some(block),
        };
        Self {
            model: model.kind(),
            restitution: model.restitution(),
            restitution_from,
            size_m: block.map(uplift_block::RockingBlock::size_m),
            slenderness_rad: block.map(uplift_block::RockingBlock::slenderness_rad),
        }
    }
}

impl CollapseReport {
    fn from_collapse(
        Collapses { own, rounded, bands, repaired_bands, lognormal_bands }: &Collapses,
        measure: IntensityMeasure,
        model: &'static str,
        records: u32,
        sites: &[&str],
    ) -> Self {
        let around = |value: &dyn Fn(&Collapse) -> f64| Noisy::around(value(own), rounded.iter().map(value));
        let fit = own.fit.as_ref().ok();
        let of_fit = |value: &dyn Fn(&LognormalFit) -> f64| {
            fit.map(|_| around(&|found| found.fit.as_ref().map_or(f64::NAN, value)))
        };
        let site = |(index, site): (usize, &&str)| SiteRisk {
            site: (*site).to_owned(),
            risk: own.risks[index],
            bands: bands[index],
            repaired: own.repaired[index],
            repaired_bands: repaired_bands[index],
            lognormal_per_year: own.fitted.as_ref().map(|fitted| fitted[index].per_year),
            lognormal_bands: lognormal_bands[index],
            per_year_rounding: around(&|found| found.risks[index].per_year),
            lognormal_per_year_rounding: own
                .fitted
                .as_ref()
                .map(|_| around(&|found| found.fitted.as_ref().map_or(f64::NAN, |fitted| fitted[index].per_year))),
        };
        let count = |found: &Collapse, level: usize| found.counts[level].exceedances;
        let counts_at = |level: usize| {
            let counts = rounded.iter().map(move |found| count(found, level));
            counts.fold([count(own, level); 2], |[fewest, most], other| [fewest.min(other), most.max(other)])
        };
        Self {
            im: measure.label(),
            unit: measure.unit(),
            model,
            levels: own.counts.iter().map(|count| count.level).collect(),
            overturned: own.counts.iter().map(|count| count.exceedances).collect(),
            overturned_rounding: (0..own.counts.len()).map(counts_at).collect(),
            records,
            theta: fit.map(|fit| fit.fragility.median()),
            beta: fit.map(|fit| fit.fragility.dispersion()),
            theta_rounding: of_fit(&|fit| fit.fragility.median()),
            beta_rounding: of_fit(&|fit| fit.fragility.dispersion()),
            log_likelihood: fit.map(|fit| fit.log_likelihood),
            sites: sites.iter().enumerate().map(site).collect(),
            fit: fit.copied(),
        }
    }
}
