//! How often a structure overturns, by its equivalent oscillator and by the rigid block that rotates as it does
//! (Section 2.4.3).

mod analysis;
mod report;

use std::path::{Path, PathBuf};

use clap::Args;
use uplift_alarms::{OwnRisk, Scope, alarms_of_inputs, own_risk_alarms, ranked, structure_alarms};
use uplift_engine::analysis::{Analysed, ResultJob, ShardReport};
use uplift_fragility::Stripes as Stripe;
use uplift_ida::{Shard, System};
use uplift_inputs::RecordSet;
use uplift_job::events::Events;
use uplift_job::typed::number;
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_risk::{PooledDemand, RunWeights, StripeWeights};
use uplift_spectra::NUDGES;
use uplift_study::{Structure, UniformRiskStudy};
use uplift_uniform_risk::{EventRisk, SpectraOfResult, Stripes, StudyOfResult};

use super::certainty::{Scatter, rate_bands};
use super::collapse::collapse;
use super::hazard::Hazard;
use super::limit::{FrameLimit, LimitRisk};
use super::lognormal::lognormal_bands;
use super::opening::{check_tables, job_name, site_index, study_with_common_records};
use super::own_frame::{FramePeaks, of_frame};
use super::report::{ReportSource, StructureReport};
use super::risk::{OVERTURNING_M, own_risk};
use super::tables::{risk_path, write_tables};
use super::uncertain::{Event, SiteQuestions, Uncertain, UncertaintyReport};
use super::weights::RepairedWeights;
use crate::error::DesignError;
use analysis::{OSCILLATOR, factors};
pub(crate) use analysis::{OverturningAnalysis, peaks_m};
pub use report::{CollapseReport, ModelReport, OverturningReport, SiteRisk};
use report::{Collapses, FrameCollapses, reports};

/// What is asked of the overturning of a structure.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct OverturningOptions {
    /// Manifest of the records, where it is no longer where the study says.
    #[arg(skip)]
    pub manifest: Option<PathBuf>,
    /// Site [default: all]
    #[arg(long)]
    pub site: Option<String>,
    /// Intensity measure [default: all]
    #[arg(long)]
    pub measure: Option<IntensityMeasure>,
    /// Coefficient of restitution of both models
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number)]
    pub restitution: Option<f64>,
    /// Count the proxy alone, without the wobbling frame
    #[arg(long)]
    pub proxy: bool,
    /// CSV file of the collapse fragility to write; the risk goes to one that ends in .risk.csv beside it.
    #[arg(skip)]
    pub table: Option<PathBuf>,
    /// Every shard of the analyses, as [`overturning_shard`] wrote them; none to compute them here.
    #[arg(skip)]
    pub shards: Vec<PathBuf>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

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
    let reason = "overturning is counted among the same records at every level";
    let source = study_with_common_records(&file, manifest, reason)?;
    let sites = match &options.site {
        Some(site) => vec![site_index(&source, Some(site))?],
        None => (0..source.sites.len()).collect(),
    };
    let mut notes = Vec::new();
    let analysis = OverturningAnalysis::from_structure(structure, &source, options, &mut notes)?;
    notes.extend(after_the_end(&source.study));
    let name = job_name("overturning", structure);
    let job = ResultJob { result, name: &name };
    let (analysed, checkpoint) = job.results(analysis.work(&name, &factors())?, &options.shards, events)?;
    let OverturningAnalysis { study, records, measures, models, uncertain, .. } = &analysis;
    let repaired = RepairedWeights::from_file(&file)?;
    let scatter = Scatter::from_file(&file)?;
    let limit = analysis.frame.as_ref().and_then(|(frame, _)| frame.limit);
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
            let limit_m = limit.map(|limit| limit.displacement_m / structure.system.participation());
            let limit_m = limit_m.filter(|_| matches!(model, System::Oscillator(_)));
            let beyond_limit = beyond_limit(&demand, (&hazard, &scatter), (limit_m, study.risk.years))?;
            let own = at_nudge(0)?;
            Ok::<_, DesignError>(Collapses { own, rounded, bands, beyond_limit, repaired_bands, lognormal_bands })
        });
        found.push((measure, of_models.collect::<Result<_, _>>()?));
        hazards.push(hazard);
    }
    let (sites_of, years) = (&sites[..], study.risk.years);
    let asked = FrameSites { sites: sites_of, repaired: &repaired, scatter: &scatter, limit, years };
    let of_frame = analysis
        .frame_peaks(&mut analysed)
        .iter()
        .zip(&hazards)
        .map(|((measure, places, peaks), hazard)| asked.collapses((measure, places), hazard, peaks))
        .collect::<Result<Vec<_>, _>>()?;
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
        limit,
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

/// How often the peaks of a model exceed `limit_m` at each site; nothing without a limit.
fn beyond_limit(
    demand: &PooledDemand,
    (hazard, scatter): (&[Hazard<'_>], &Scatter),
    (limit_m, years): (Option<f64>, f64),
) -> Result<Vec<LimitRisk>, DesignError> {
    let Some(limit_m) = limit_m else { return Ok(Vec::new()) };
    hazard.iter().map(|hazard| LimitRisk::new(demand, (hazard, None), scatter, (limit_m, years))).collect()
}

/// By what the peaks of a frame are weighed.
struct FrameSites<'a> {
    /// Positions of the sites.
    sites: &'a [usize],
    repaired: &'a RepairedWeights,
    scatter: &'a Scatter,
    limit: Option<FrameLimit>,
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
            let limit_m = self.limit.map(|limit| limit.displacement_m);
            let beyond_limit = beyond_limit(&demand, (&hazard, self.scatter), (limit_m, self.years))?;
            Ok((model, Collapses { own, rounded: Vec::new(), bands, beyond_limit, repaired_bands, lognormal_bands }))
        };
        peaks.each().map(of_model).collect()
    }
}

/// What counts after the end of a record, where the study does not look at it.
fn after_the_end(study: &UniformRiskStudy) -> Option<String> {
    let note = "the study ends with its records (free_vibration = false); here what falls after their end counts as \
                overturned";
    (!study.oscillator.free_vibration).then(|| note.to_owned())
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
