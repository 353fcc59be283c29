//! A structure checked against a uniform risk spectrum, and the check itself put to the test (Sections 3.3.2 and
//! 3.4.5).
//!
//! The rules take the demand on a structure from that on the ZSBE oscillator of the same strength. Under one set of
//! records scaled to one intensity their error is known (Tables 3.2 to 3.7); here it is that of the ordinate of a given
//! risk, over all intensities of a site: the structure's own oscillator is put through the records and the hazard that
//! the spectrum was made from.

mod analysis;
mod verdict;

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use uplift_alarms::{OwnRisk, Scope, alarms_within, own_risk_alarms, ranked, safety_factor_alarm, structure_alarms};
use uplift_engine::analysis::{ResultJob, ShardReport};
use uplift_ida::Shard;
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_job::events::Events;
use uplift_job::text::rounded;
use uplift_job::typed::number;
use uplift_motion::IntensityMeasure;
use uplift_oscillator::PostUplift;
use uplift_plausible::SAFETY_FACTOR;
use uplift_questions::bootstrap::resampled;
use uplift_result::ResultFile;
use uplift_study::Structure;
use uplift_uniform_risk::{EventRisk, OneRisk, SpectraOfResult, StudyOfResult, at};

use super::certainty::Scatter;
use super::demand::ExactDemand;
use super::opening::{Place, job_name, records_and_pairs, restitution};
use super::own_frame::{FrameReport, OwnFrame, STOPPED, of_frame};
use super::report::{ReportSource, StructureReport};
use super::risk::own_risk;
use super::rules::{MeasureVerdict, OwnCheck, RuleDemands, RuleOutcome, apply_rules, verdicts_by_curve};
use super::spectrum::SpectrumDemand;
use super::uncertain::UncertaintyReport;
use super::weights::{RepairedWeights, SiteWeights};
use crate::error::DesignError;
use analysis::{DesignAnalysis, OwnAnalysis, Question};

/// What is asked of a design.
#[expect(clippy::struct_excessive_bools, reason = "each is an option")]
#[derive(Debug, Clone, PartialEq, Args)]
pub struct DesignOptions {
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
    /// Use records weighted for hazard consistency (uplift consistency --repair)
    #[arg(long)]
    pub repaired: bool,
    /// Safety factor on the demand (Eq. 3.15)
    #[arg(
        long,
        value_name = "FS",
        default_value_t = DesignOptions::default().safety_factor,
        allow_negative_numbers = true,
        value_parser = number,
    )]
    pub safety_factor: f64,
    /// Apply the rules to the spectrum without analysing the structure
    #[arg(long)]
    pub spectrum_only: bool,
    /// Judge the proxy alone, without the wobbling frame
    #[arg(long)]
    pub proxy: bool,
    /// Say what a small change of the strength and rounding make of the numbers, with 16 times the analyses.
    #[arg(skip)]
    pub sensitivity: bool,
    /// Every shard of the structure's own analysis, as [`design_shard`] wrote them with the same `sensitivity`; none to
    /// compute it here.
    #[arg(skip)]
    pub shards: Vec<PathBuf>,
}

impl Default for DesignOptions {
    /// The safety factor of Section 3.4.5, 2.5.
    fn default() -> Self {
        Self {
            manifest: None,
            site: None,
            risk: OneRisk::default(),
            measure: None,
            repaired: false,
            safety_factor: 2.5,
            spectrum_only: false,
            proxy: false,
            sensitivity: false,
            shards: Vec::new(),
        }
    }
}

/// The report of a design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignReport {
    /// The structure, with the restitution of its oscillator.
    pub structure: StructureReport,
    /// The result that it was examined under.
    #[serde(flatten)]
    pub source: ReportSource,
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Whether spectrum and risks are of records weighted so that they bring the site's hazard.
    pub repaired: bool,
    /// Probability of exceedance.
    pub poe: f64,
    /// Years that it refers to.
    pub years: f64,
    /// Its rate, 1/yr (Eq. 4.8).
    pub target_per_year: f64,
    /// Safety factor asked for.
    pub required_safety_factor: f64,
    /// What the spectrum says; none where it cannot be read.
    pub spectrum: Option<SpectrumDemand>,
    /// Why it cannot be read, which is a note as well; none where it can.
    #[serde(skip)]
    pub unread: Option<String>,
    /// What the structure's own analysis says; none where there is none.
    pub exact: Option<ExactDemand>,
    /// Whether its capacity is at least the safety factor times that demand; none without a capacity.
    pub own_check: Option<OwnCheck>,
    /// Whether the structure describes a frame that can wobble.
    pub wobbles: bool,
    /// What the frame itself says; none of a structure that cannot wobble, by its proxy, and without an analysis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<FrameReport>,
    /// Why a frame that can wobble is left out although no `--proxy` asks for that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_frame: Option<String>,
    /// The structure where its quantities are not known exactly; none where its file says that they are, and without
    /// an analysis of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyReport>,
    /// The rules; none where they do not apply, to positive post-uplift stiffness.
    pub rules: Vec<RuleOutcome>,
    /// The rules by the spectra of the other measures of the result.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub by_other_measures: Vec<MeasureVerdict>,
    /// How the structure and the study differ, and what could not be done.
    pub notes: Vec<String>,
    /// Whether the spectrum is of another oscillator than the structure's: another uplift displacement, restitution or
    /// gravity, or uncertain; the notes say which.
    pub other_oscillator: bool,
    /// Options of `uplift run` with which the study has the structure's oscillator; none where it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own_oscillator: Option<String>,
    /// What the structure's file leaves out and an answer hangs on, with what is taken for it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<String>,
    /// What to know before using the numbers, the worst first.
    pub alarms: Vec<Alarm>,
}

/// Designs `structure` by a spectrum of the result at `result`, and tests the design by the structure's own risk.
///
/// # Errors
/// A safety factor below 1 or implausibly large; a file that is missing, damaged, no result, or without sites; spectra
/// of another system than ZSBE; a site or measure that the result does not have, or no repaired spectrum where one is
/// asked for; a risk that is none; records of a manifest that was given and cannot be read; shards that do
/// not belong together; [`JobError::Paused`] where `events` say so, [`JobError::Interrupted`] where no checkpoint
/// can be written beside the result.
pub fn design(
    structure: &Structure,
    result: &Path,
    options: &DesignOptions,
    events: &dyn Events,
) -> Result<DesignReport, DesignError> {
    let safety_factor = options.safety_factor;
    SAFETY_FACTOR.check("--safety-factor", safety_factor).map_err(|mistake| JobError::Implausible(vec![mistake]))?;
    let file = result_at(result, options.risk, events)?;
    let source = StudyOfResult::read(&file, options.manifest.as_deref())?;
    require_zero_stiffness(&source)?;
    let place @ Place { site, measure, .. } = Place::choose(&source, options.site.as_deref(), options.measure)?;
    let poe = source.rarest()?;
    let target_per_year = source.target_per_year(poe)?;
    let repaired_m = repaired_spectrum(&file, measure, [site, poe])?;
    let repaired_weights = options.repaired.then(|| RepairedWeights::from_file(&file)).transpose()?;
    let weights = site_weights(repaired_weights.as_ref(), place, &source)?;
    let restitution = restitution(structure, &source.study);
    let (mut notes, own_oscillator) = differences(structure, &source, restitution);
    let other_oscillator = !notes.is_empty();

    let plain = spectrum_demand(structure, &source, source.spectrum(measure, site, poe));
    let repaired = repaired_m.and_then(|u_m| spectrum_demand(structure, &source, &u_m));
    let spectrum = if options.repaired { repaired } else { plain };
    notes.extend(if options.repaired { None } else { beside(plain, repaired) });
    let unread = spectrum.is_none().then(|| beyond_spectrum(structure, &source));
    notes.extend(unread.clone());
    let [wobbles, is_shaken] = [OwnFrame::is_described(structure), OwnFrame::can_be_shaken(structure)];
    let mut without_frame = (wobbles && !is_shaken && !options.proxy).then(|| STOPPED.to_owned());
    let mut own = None;
    if !options.spectrum_only {
        match records_and_pairs(&source, options.manifest.as_deref(), is_shaken && !options.proxy)? {
            Ok(records) => {
                let question = Question { place, weights: &weights, target_per_year };
                let analysed = (options, records);
                own = Some(OwnAnalysis::from_structure(structure, (&file, &source), &question, analysed, events)?);
            }
            Err(reason) => notes.push(format!(
                "the structure itself is not analysed, and what follows is what the spectrum alone says: {reason}"
            )),
        }
    }
    let (exact, uncertainty, frame, checkpoint) = match own {
        Some(own) => {
            without_frame = without_frame.or(own.without_frame);
            (Some(own.exact), own.uncertainty, own.frame, Some(own.checkpoint))
        }
        None => (None, None, None, None),
    };
    notes.extend(frame.as_ref().map(|_| of_frame(structure)));
    if structure.uncertainty.is_some() && uncertainty.is_none() {
        notes.push(without_uncertainty(options, &source));
    }
    let demands = RuleDemands {
        of_spectrum_m: spectrum.map(|spectrum| spectrum.zero_stiffness_demand_m),
        exact_m: exact.map(|exact| exact.zero_stiffness_demand_m).filter(|demand_m| demand_m.is_finite()),
        of_structure_m: exact.map(|exact| exact.demand_m),
    };
    let rules = apply_rules(structure, safety_factor, demands)?;
    if spectrum.is_some() && !options.repaired {
        let spectra = file.branch_spectra(measure.measure(), place.name, poe)?;
        let demands = spectra.iter().map(|(weight, u_m)| (*weight, spectrum_demand(structure, &source, u_m)));
        notes.extend(verdicts_by_curve(structure, safety_factor, demands)?);
    }
    let by_other_measures =
        verdicts_by_measure(structure, safety_factor, (&file, &source), (place, poe), options.repaired)?;
    let told = StructureReport::from_structure(structure, Some(restitution));
    let mut alarms = alarms_within(&file, &scope((place, poe), spectrum, options.repaired))?;
    alarms.extend(structure_alarms(structure));
    alarms.extend(safety_factor_alarm(safety_factor));
    if let Some(exact) = &exact {
        let scatter = Scatter::from_file(&file)?;
        let mut risks = own_risks(exact, place, (&scatter.pairs, &weights));
        risks.extend(frame.iter().flat_map(|frame| frame.own_risks(place, &scatter)));
        alarms.extend(own_risk_alarms(&risks));
    }
    if let Some(checkpoint) = checkpoint {
        checkpoint.remove();
    }
    let own_check =
        exact.zip(told.capacity_m).map(|(own, capacity_m)| OwnCheck::new(capacity_m, own.demand_m, safety_factor));
    Ok(DesignReport {
        structure: told,
        site: place.name.to_owned(),
        im: measure.measure().label(),
        repaired: options.repaired,
        poe: source.study.risk.poe[poe],
        years: source.study.risk.years,
        source: ReportSource::read(&file, &source)?,
        target_per_year,
        required_safety_factor: safety_factor,
        spectrum,
        exact,
        own_check,
        wobbles,
        frame,
        without_frame,
        uncertainty,
        rules,
        by_other_measures,
        other_oscillator,
        own_oscillator,
        unread,
        assumed: assumed(structure, restitution),
        notes,
        alarms: ranked(alarms),
    })
}

/// Computes one shard of the structure's own analysis into a file beside the result, for [`DesignOptions::shards`].
///
/// # Errors
/// As [`design`], and where the records of the result cannot be read.
pub fn design_shard(
    structure: &Structure,
    result: &Path,
    options: &DesignOptions,
    shard: Shard,
    events: &dyn Events,
) -> Result<ShardReport, DesignError> {
    let file = at(ResultFile::open(result)?, &options.risk.into())?;
    let source = StudyOfResult::read(&file, options.manifest.as_deref())?;
    require_zero_stiffness(&source)?;
    let target_per_year = source.target_per_year(source.rarest()?)?;
    let with_pairs = OwnFrame::can_be_shaken(structure) && !options.proxy;
    // the levels of a frame are those of a site; oscillators are the same at all of them
    let any_site = source.sites.first().filter(|_| !with_pairs);
    let place = Place::choose(&source, options.site.as_ref().or(any_site).map(String::as_str), options.measure)?;
    let records = records_and_pairs(&source, options.manifest.as_deref(), with_pairs)?.map_err(JobError::input)?;
    let analysis = DesignAnalysis::from_structure(structure, &source, (place, target_per_year), (records, options))?;
    let name = job_name("design", structure);
    Ok(ResultJob { result, name: &name }.shard(
        analysis.work(&source, (place, target_per_year), &name)?,
        shard,
        events,
    )?)
}

/// What runs weigh at a place: as a repair says where there is one.
fn site_weights<'a>(
    repaired: Option<&'a RepairedWeights>,
    place: Place<'a>,
    source: &StudyOfResult,
) -> Result<SiteWeights<'a>, DesignError> {
    let Place { site, measure, .. } = place;
    Ok(match repaired {
        None => SiteWeights::Alike(&measure.weights[site]),
        Some(repaired) => SiteWeights::Repaired(repaired.at(measure, site).ok_or_else(|| not_repaired(source, place))?),
    })
}

/// Why the structures that it may be are not analysed.
fn without_uncertainty(options: &DesignOptions, source: &StudyOfResult) -> String {
    let reason = if options.repaired {
        "their risk is not computed with repaired weights (leave --repaired out)"
    } else if source.study.records.at_level.is_some() {
        "their risk is not computed with records of their own at each level (records.at_level)"
    } else {
        "the structure itself is not analysed"
    };
    format!("[uncertainty]: all numbers are of the structure as described, without its uncertainty: {reason}")
}

/// The repaired spectrum at a site and probability, m, `[strength]`; none where there is none.
fn repaired_spectrum(
    file: &ResultFile,
    measure: &SpectraOfResult,
    [site, poe]: [usize; 2],
) -> Result<Option<Vec<f64>>, DesignError> {
    let consistency = file.consistency()?;
    let own = consistency.iter().find(|of| of.scaled_to == measure.measure() && of.is_repaired(site));
    Ok(own.and_then(|of| Some(of.u_m.as_ref()?.block([site, poe]).to_vec())))
}

/// Which warnings concern a design: those of the spectrum that it is by, around its strength.
fn scope((place, poe): (Place<'_>, usize), spectrum: Option<SpectrumDemand>, repaired: bool) -> Scope {
    Scope {
        site: Some(place.site),
        measure: Some(place.measure.measure()),
        poe: Some(poe),
        strengths: spectrum.map(|spectrum| spectrum.between_strengths).or(Some((f64::NAN, f64::NAN))),
        repaired,
    }
}

/// The rules by the spectra of all measures but that of `place`; of those alone that can be read.
fn verdicts_by_measure(
    structure: &Structure,
    safety_factor: f64,
    (file, source): (&ResultFile, &StudyOfResult),
    (place, poe): (Place<'_>, usize),
    repaired: bool,
) -> Result<Vec<MeasureVerdict>, DesignError> {
    let mut verdicts = Vec::new();
    for other in source.measures.iter().filter(|other| other.measure() != place.measure.measure()) {
        let repaired_m = if repaired { repaired_spectrum(file, other, [place.site, poe])? } else { None };
        let u_m = if repaired { repaired_m } else { Some(source.spectrum(other, place.site, poe).to_vec()) };
        let Some(demand) = u_m.and_then(|u_m| spectrum_demand(structure, source, &u_m)) else { continue };
        let of_spectrum_m = Some(demand.zero_stiffness_demand_m);
        let demands = RuleDemands { of_spectrum_m, exact_m: None, of_structure_m: None };
        let rules = apply_rules(structure, safety_factor, demands)?;
        verdicts.push(MeasureVerdict { im: other.measure().label(), rules });
    }
    Ok(verdicts)
}

/// Why there is no repaired spectrum of a site.
fn not_repaired(source: &StudyOfResult, place: Place<'_>) -> DesignError {
    JobError::input(format!(
        "{}: has no repaired spectrum of {} by {}: compute it, or see why there is none: `uplift consistency {} \
         --repair`",
        source.path.display(),
        place.name,
        place.measure.measure().label(),
        source.path.display()
    ))
    .into()
}

fn beside(plain: Option<SpectrumDemand>, repaired: Option<SpectrumDemand>) -> Option<String> {
    let [plain_m, repaired_m] = [plain?, repaired?].map(|demand| demand.zero_stiffness_demand_m);
    Some(format!(
        "the repaired spectrum has {repaired_m:.4} m with zero stiffness, the plain one {plain_m:.4} m: --repaired \
         designs by it"
    ))
}

/// The rules start from the ZSBE system: a spectrum of another says nothing to them.
fn require_zero_stiffness(source: &StudyOfResult) -> Result<(), DesignError> {
    let (what, key) = match source.study.oscillator.post_uplift {
        PostUplift::Zero => return Ok(()),
        PostUplift::Negative { capacity_m } => (format!("negative stiffness (capacity {capacity_m} m)"), "capacity_m"),
        PostUplift::Positive { stiffness_per_s2 } => {
            (format!("positive stiffness ({stiffness_per_s2} 1/s2 after uplift)"), "post_uplift_stiffness_per_s2")
        }
    };
    Err(JobError::input(format!(
        "{}: its oscillator has {what}, but the rules start from zero stiffness (ZSBE): run the study without \
         oscillator.{key}",
        source.path.display()
    ))
    .into())
}

/// The spectrum read at the strength of the structure; none where it cannot be.
fn spectrum_demand(structure: &Structure, source: &StudyOfResult, u_m: &[f64]) -> Option<SpectrumDemand> {
    let system = &structure.system;
    let strength = system.spectral_strength_at(source.study.gravity_m_s2);
    SpectrumDemand::read(&source.study.strengths, u_m, (strength, system.participation()))
}

/// Why the spectrum cannot be read.
fn beyond_spectrum(structure: &Structure, source: &StudyOfResult) -> String {
    let strengths = &source.study.strengths;
    let (first, last) = (strengths[0], strengths[strengths.len() - 1]);
    let strength = structure.system.spectral_strength_at(source.study.gravity_m_s2);
    let why = if (first..=last).contains(&strength) {
        "an ordinate beside it is censored".to_owned()
    } else {
        format!("its strengths go from {first} to {last}; widen strengths.values and run the study again")
    };
    format!("the spectrum has no value at strength {strength:.4}: {why}")
}

/// The result at the risk asked for, with its bands there where it keeps draws: alarms take them, and what is quoted
/// needs none.
fn result_at(path: &Path, risk: OneRisk, events: &dyn Events) -> Result<ResultFile, DesignError> {
    let file = at(ResultFile::open(path)?, &risk.into())?;
    Ok(if file.draws()?.is_some() { resampled(file, events)? } else { file })
}

/// `restitution 0.95`, where the structure's file does not say so, and likewise.
fn assumed(structure: &Structure, restitution: f64) -> Vec<String> {
    let description = &structure.description;
    let uplift_mm = rounded(1e3 * structure.system.conditions().uplift_displacement_m(), 4);
    let uplift = description.assumes_uplift_displacement().then(|| format!("uplift displacement {uplift_mm} mm"));
    let restitution = description.restitution.is_none().then(|| format!("restitution {restitution}"));
    uplift.into_iter().chain(restitution).collect()
}

/// What the structure and the study's oscillator do not have in common, and the options with which they would.
fn differences(structure: &Structure, source: &StudyOfResult, restitution: f64) -> (Vec<String>, Option<String>) {
    let (system, oscillator) = (&structure.system, &source.study.oscillator);
    let apart = |a: f64, b: f64| (a - b).abs() > 1e-9 * a.abs().max(b.abs());
    let (mut notes, mut settings) = (Vec::new(), Vec::new());
    if source.study.uncertainty.is_some() {
        notes.push(
            "the spectrum is of uncertain oscillators ([uncertainty] of its study); the structure is compared with \
             the one that the study describes"
                .to_owned(),
        );
    }
    if !system.is_of_uplift_displacement(oscillator.uplift_displacement_m) {
        notes.push(format!(
            "The spectrum is of another oscillator: its uplift displacement is {} mm; this structure's is {} mm ({} mm \
             divided by Γ)",
            rounded(1e3 * oscillator.uplift_displacement_m, 4),
            rounded(1e3 * system.spectral_uplift_displacement_m(), 3),
            rounded(1e3 * system.conditions().uplift_displacement_m(), 4)
        ));
        let own_m = rounded(system.spectral_uplift_displacement_m(), 4);
        settings.push(format!("--set oscillator.uplift_displacement_m={own_m}"));
    }
    if apart(restitution, oscillator.restitution) {
        notes.push(format!(
            "The spectrum is of another oscillator: its restitution is {}; this structure's is {restitution}",
            oscillator.restitution
        ));
        settings.push(format!("--set oscillator.restitution={restitution}"));
    }
    let gravity_m_s2 = system.conditions().gravity_m_s2();
    if apart(gravity_m_s2, source.study.gravity_m_s2) {
        notes.push(format!(
            "the spectrum is of a gravity of {} m/s2, the structure's is {gravity_m_s2} m/s2",
            source.study.gravity_m_s2
        ));
        settings.push(format!("--set gravity_m_s2={gravity_m_s2}"));
    }
    (notes, (!settings.is_empty()).then(|| settings.join(" ")))
}

/// What may come from outside the stripes: the demand, exceeding the capacity, overturning.
fn own_risks(
    exact: &ExactDemand,
    place: Place<'_>,
    (pairs, weights): (&[Vec<usize>], &SiteWeights<'_>),
) -> Vec<OwnRisk> {
    let effective_pairs = weights.effective_pairs(pairs);
    let counts = (pairs.iter().map(Vec::len).sum(), pairs.len());
    let own = |event: &str, risk: EventRisk| OwnRisk {
        effective_pairs,
        ..own_risk((event, risk), (place.name, place.measure), counts)
    };
    let ExactDemand { lower_tail_share, upper_tail_share, .. } = *exact;
    let demand = EventRisk { lower_tail_share, upper_tail_share, at_most_per_year: None, ..exact.overturning };
    let mut risks = vec![own("demand on the structure", demand), own("overturning", exact.overturning)];
    risks.extend(exact.beyond_capacity.map(|risk| own("exceeding the capacity", risk)));
    risks
}
