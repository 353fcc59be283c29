//! How often a structure overturns, by its equivalent oscillator and by the rigid block that rotates as it does
//! (Section 2.4.3).

mod analysis;
mod options;
mod report;

use std::path::Path;

use uplift_alarms::{OwnRisk, Scope, alarms_of_inputs, own_risk_alarms, ranked, structure_alarms};
use uplift_engine::analysis::{Analysed, ShardReport};
use uplift_fragility::Stripes as Stripe;
use uplift_ida::{Shard, System};
use uplift_inputs::RecordSet;
use uplift_job::events::Events;
use uplift_result::ResultFile;
use uplift_risk::{PooledDemand, RunWeights};
use uplift_study::{Structure, UniformRiskStudy};
use uplift_uniform_risk::consistency::Reweighing;
use uplift_uniform_risk::{EventRisk, SpectraOfResult, Stripes, StudyOfResult};

use super::certainty::{Scatter, rate_bands};
use super::collapse::collapse;
use super::hazard::Hazard;
use super::limit::{FrameLimit, LimitRisk};
use super::lognormal::lognormal_bands;
use super::opening::{check_tables, job_name, site_index};
use super::own_structure::{OwnLevels, OwnPeaks, OwnStructure, what_frames_leave_out};
use super::report::{ReportSource, StructureReport};
use super::risk::{OVERTURNING_M, own_risk};
use super::tables::{risk_path, write_tables};
use super::uncertain::{Event, SiteQuestions, Uncertain, UncertaintyReport};
use crate::error::DesignError;
use analysis::{OSCILLATOR, factors};
pub(crate) use analysis::{OverturningAnalysis, peaks_m};
pub use options::OverturningOptions;
pub use report::{CollapseReport, ModelReport, OverturningReport, SiteRisk};
use report::{Collapses, FrameCollapses, reports};

/// How often `structure` overturns under the records and the hazard of the result at `result`.
///
/// # Errors
/// A file that is missing, damaged, no result, or without sites; a site or measure that it does not have; a restitution
/// that cannot be; records that cannot be read; tables that cannot be written or would replace something else; shards
/// that do not belong together; [`JobError::Paused`](uplift_job::JobError::Paused) where `events` say so,
/// [`JobError::Interrupted`](uplift_job::JobError::Interrupted) where no checkpoint can be written beside the result.
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
    file.refuse_records_at_level("overturning is counted among the same records at every level")?;
    let source = StudyOfResult::read(&file, manifest)?;
    let sites = match &options.site {
        Some(site) => vec![site_index(&source, Some(site))?],
        None => (0..source.sites.len()).collect(),
    };
    let mut notes = Vec::new();
    let analysis = OverturningAnalysis::from_structure(structure, &source, options, &mut notes)?;
    notes.extend(after_the_end(&source.study));
    let factors = factors(options.sensitivity);
    let work = analysis.work(&job_name("overturning", structure), &factors)?;
    let (analysed, checkpoint) = work.asked_of(result, &options.shards, events)?;
    let OverturningAnalysis { study, records, measures, models, uncertain, .. } = &analysis;
    let reweighing = Reweighing::from_motions(&file)?;
    let scatter = Scatter::from_file(&file)?;
    let limit = analysis.frame.as_ref().and_then(|(frame, _)| frame.limit);
    let at_sites = |&measure: &_| AtSites::new(&file, (&source, &sites), (measure, reweighing.as_ref()), &scatter);
    let weighed = measures.iter().map(at_sites).collect::<Result<Vec<_>, _>>()?;
    let mut analysed = analysed.into_iter();
    let mut found: Vec<OfMeasure<'_>> = Vec::new();
    for (&measure, at) in measures.iter().zip(&weighed) {
        let levels = &measure.plan.levels;
        let of_model = |((model, _), analysed): (&(System, _), Analysed)| {
            let rounded_m: Vec<_> = (1..factors.len()).map(|nudge| peaks_m(&analysed, levels.len(), nudge)).collect();
            let limit_m = limit.map(|limit| limit.displacement_m / structure.system.participation());
            let limit_m = limit_m.filter(|_| matches!(model, System::Oscillator(_)));
            let peaks_m = (&peaks_m(&analysed, levels.len(), 0)[..], &rounded_m[..]);
            at.collapses(levels, peaks_m, (model.can_overturn(), limit_m))
        };
        found.push((measure, models.iter().zip(analysed.by_ref()).map(of_model).collect::<Result<_, _>>()?));
    }
    let peaks = analysis.frame_peaks(&mut analysed);
    let of_frame = peaks.iter().zip(&weighed).map(|(peaks, at)| at.frame_collapses(peaks, limit));
    let of_frame = of_frame.collect::<Result<Vec<_>, _>>()?;
    let kinds: Vec<&str> = models.iter().map(|(model, _)| analysis.kind(model)).collect();
    notes.extend(notes_on(&analysis, &kinds, &found));
    notes
        .extend(analysis.frame.as_ref().filter(|(frame, _)| frame.wobbles()).map(|_| what_frames_leave_out(structure)));
    let names: Vec<&str> = sites.iter().map(|&site| source.sites[site].as_str()).collect();
    let uncertainty = uncertain
        .as_ref()
        .map(|uncertain| uncertainty_report(uncertain, (&found, &weighed, &names), (analysed, &records.set)))
        .transpose()?;
    let site = sites.first().copied().filter(|_| sites.len() == 1);
    let mut alarms =
        alarms_of_inputs(&file, &Scope { site, measure: options.measure, repaired: true, ..Scope::default() })?;
    alarms.extend(structure_alarms(structure));
    let counts = (records.count(), scatter.pairs.len());
    let places: Vec<(usize, &str)> = sites.iter().copied().zip(names.iter().copied()).collect();
    alarms.extend(own_risk_alarms(&own_risks(&kinds, (&found, &of_frame), &places, counts)));
    let records = u32::try_from(records.count()).unwrap_or(u32::MAX);
    let mut report = OverturningReport {
        structure: StructureReport::from_structure(structure, None),
        years: study.risk.years,
        by_proxy: OwnStructure::has_model(structure) && analysis.models().count() == 1,
        models: analysis.models().map(ModelReport::from_model).collect(),
        limit,
        overturning: reports((&found, &of_frame), &kinds, records, &names),
        uncertainty,
        without_own: analysis.without_own.clone(),
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
    let work = analysis.work(&job_name("overturning", structure), &factors(options.sensitivity))?;
    Ok(work.shard_beside(result, shard, events)?)
}

/// Overturning by a measure, of each model.
type OfMeasure<'a> = (&'a SpectraOfResult, Vec<Collapses>);

/// What the stripes of the structures say by each measure at each of the `sites`, beside what was `found` of the
/// structure as described.
fn uncertainty_report(
    uncertain: &Uncertain<'_>,
    (found, weighed, sites): (&[OfMeasure<'_>], &[AtSites<'_>], &[&str]),
    (analysed, set): (impl Iterator<Item = Analysed>, &RecordSet),
) -> Result<UncertaintyReport, DesignError> {
    let (mut results, mut analyses) = (Vec::new(), 0);
    for (((measure, found), at), analysed) in found.iter().zip(weighed).zip(analysed) {
        let described = found[OSCILLATOR].own.risks.iter().map(|risk| vec![(Event::Overturning, risk.per_year)]);
        let asked = sites.iter().zip(&at.hazard).zip(described);
        let asked: Vec<_> = asked.map(|((name, hazard), asked)| SiteQuestions { name, hazard, asked }).collect();
        analyses += analysed.analyses;
        results.extend(uncertain.results(&Stripes::new(&measure.plan, set, analysed), &asked, at.scatter)?);
    }
    Ok(uncertain.report(analyses, results))
}

/// What peaks by one measure are weighed by, `[site]`.
struct AtSites<'a> {
    hazard: Vec<Hazard<'a>>,
    repaired: Vec<Option<&'a RunWeights>>,
    scatter: &'a Scatter,
    years: f64,
}

impl<'a> AtSites<'a> {
    fn new(
        file: &ResultFile,
        (source, sites): (&StudyOfResult, &[usize]),
        (measure, reweighing): (&'a SpectraOfResult, Option<&'a Reweighing>),
        scatter: &'a Scatter,
    ) -> Result<Self, DesignError> {
        let hazard = sites.iter().map(|&site| Hazard::from_file(file, source, (measure, site)));
        let repaired = sites.iter().map(|&site| reweighing?.weights(measure.measure(), site)).collect();
        Ok(Self { hazard: hazard.collect::<Result<_, _>>()?, repaired, scatter, years: source.study.risk.years })
    }

    /// Overturning of a model with these peaks, m, over `[record, level]`, and with those of its neighbours; held
    /// against `limit_m` where there is one.
    fn collapses(
        &self,
        levels: &[f64],
        (own_m, rounded_m): (&[f64], &[Vec<f64>]),
        (may_overturn, limit_m): (bool, Option<f64>),
    ) -> Result<Collapses, DesignError> {
        let Self { hazard, repaired, scatter, years } = self;
        let weights: Vec<_> = hazard.iter().map(|of| of.mean).zip(repaired.iter().copied()).collect();
        let of_peaks = |peaks_m: &[f64]| collapse(levels, (peaks_m, &scatter.pairs), &weights, *years, may_overturn);
        let demand = PooledDemand::new(&Stripe::new(levels, own_m)?)?;
        let bands = |hazard: &Hazard<'_>, runs: Option<&RunWeights>| {
            rate_bands(&demand, (hazard, runs), scatter, OVERTURNING_M)
        };
        let of_repaired = |(hazard, runs): (&Hazard<'_>, Option<&RunWeights>)| {
            runs.map_or(Ok(None), |runs| bands(hazard, Some(runs)))
        };
        let beyond = |limit_m: f64| {
            let of_site = |hazard| LimitRisk::new(&demand, (hazard, None), scatter, (limit_m, *years));
            hazard.iter().map(of_site).collect::<Result<Vec<_>, _>>()
        };
        Ok(Collapses {
            own: of_peaks(own_m)?,
            rounded: rounded_m.iter().map(|peaks_m| of_peaks(peaks_m)).collect::<Result<_, _>>()?,
            bands: hazard.iter().map(|hazard| bands(hazard, None)).collect::<Result<_, _>>()?,
            beyond_limit: limit_m.map(beyond).transpose()?.unwrap_or_default(),
            repaired_bands: hazard.iter().zip(repaired.iter().copied()).map(of_repaired).collect::<Result<_, _>>()?,
            lognormal_bands: lognormal_bands((levels, own_m), hazard, scatter)?,
        })
    }

    /// The same of a frame at the levels of these positions among those of the measure.
    fn frame_collapses(
        &self,
        (_, levels, peaks): &(&SpectraOfResult, &OwnLevels, OwnPeaks),
        limit: Option<FrameLimit>,
    ) -> Result<FrameCollapses, DesignError> {
        let OwnLevels { places, values: levels } = levels;
        let means = self.hazard.iter().map(|of| of.mean.at_levels(places)).collect::<Result<Vec<_>, _>>()?;
        let hazard = self.hazard.iter().zip(&means).map(|(of, mean)| of.at_levels(mean, places));
        let repaired = self.repaired.iter().map(|runs| runs.map(|runs| runs.at_levels(places)).transpose());
        let repaired = repaired.collect::<Result<Vec<_>, _>>()?;
        let at = AtSites {
            hazard: hazard.collect::<Result<_, _>>()?,
            repaired: repaired.iter().map(Option::as_ref).collect(),
            scatter: self.scatter,
            years: self.years,
        };
        let asked = (true, limit.map(|limit| limit.displacement_m));
        peaks.each().map(|(model, peaks_m)| Ok((model, at.collapses(levels, (peaks_m, &[]), asked)?))).collect()
    }
}

/// What counts after the end of a record, where the study does not look at it.
fn after_the_end(study: &UniformRiskStudy) -> Option<String> {
    let note = "the study ends with its records (free_vibration = false); here what falls after their end counts as \
                overturned";
    (!study.oscillator.free_vibration).then(|| note.to_owned())
}

/// What the numbers rest on.
fn notes_on(analysis: &OverturningAnalysis<'_>, kinds: &[&str], found: &[OfMeasure<'_>]) -> Vec<String> {
    let mut notes = Vec::new();
    let of_models: Vec<_> = analysis.models().collect();
    if let [(a, ..), (b, kind, _)] = of_models[..]
        && a.restitution().to_bits() != b.restitution().to_bits()
    {
        notes.push(format!(
            "the oscillator keeps {} of its velocity at an impact, the {kind} {:.4}, which explains part of the \
             difference (--restitution gives both the same)",
            a.restitution(),
            b.restitution()
        ));
    }
    for (measure, found) in found {
        let label = measure.measure().label();
        for (found, kind) in found.iter().zip(kinds) {
            if let Err(reason) = &found.own.fit {
                notes.push(format!("no lognormal fragility of the {kind} by {label}: {reason}"));
            }
        }
    }
    notes
}

/// The risk of every model at every site by every measure.
fn own_risks(
    kinds: &[&str],
    (found, of_frame): (&[OfMeasure<'_>], &[FrameCollapses]),
    places: &[(usize, &str)],
    counts: (usize, usize),
) -> Vec<OwnRisk> {
    let mut risks = Vec::new();
    for (place, (measure, found)) in found.iter().enumerate() {
        let of_frame = of_frame.get(place).into_iter().flatten().map(|(model, found)| (*model, found));
        let of_models = kinds.iter().copied().zip(found);
        for (model, found) in of_models.chain(of_frame) {
            let event = format!("overturning of the {model}");
            let of_site = |(&(site, name), &risk): (&(usize, &str), &EventRisk)| {
                let beyond_per_year = measure.weights[site].upper_tail_per_year();
                OwnRisk { beyond_per_year, ..own_risk((&event, risk), (name, measure), counts) }
            };
            risks.extend(places.iter().zip(&found.own.risks).map(of_site));
        }
    }
    risks
}
