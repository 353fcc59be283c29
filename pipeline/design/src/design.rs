//! A structure checked against a uniform risk spectrum, and the check itself put to the test (Sections 3.3.2 and
//! 3.4.5).
//!
//! The rules take the demand on a structure from that on the ZSBE oscillator of the same strength. Under one set of
//! records scaled to one intensity their error is known (Tables 3.2 to 3.7); here it is that of the ordinate of a given
//! risk, over all intensities of a site: the structure's own oscillator is put through the records and the hazard that
//! the spectrum was made from.

mod analysis;
mod options;
mod report;
mod verdict;
mod words;

use std::path::Path;

use uplift_alarms::{OwnRisk, Scope, alarms_within, own_risk_alarms, ranked, safety_factor_alarm, structure_alarms};
use uplift_engine::analysis::ShardReport;
use uplift_ida::Shard;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_plausible::SAFETY_FACTOR;
use uplift_questions::bootstrap::resampled;
use uplift_result::ResultFile;
use uplift_risk::SiteWeights;
use uplift_study::Structure;
use uplift_uniform_risk::{EventRisk, OneRisk, SpectraOfResult, StudyOfResult, at_target_risks};

use super::certainty::Scatter;
use super::demand::ExactDemand;
use super::opening::{Place, Repair, job_name, records_and_pairs, restitution};
use super::own_structure::{OwnMotion, OwnStructure, what_frames_leave_out};
use super::report::{ReportSource, StructureReport};
use super::risk::{at_place, own_risk};
use super::rules::{MeasureVerdict, OwnCheck, RuleDemands, apply_rules, verdicts_by_curve};
use super::spectrum::SpectrumDemand;
use crate::error::DesignError;
use analysis::{DesignAnalysis, OwnAnalysis, Question};
pub use options::DesignOptions;
pub use report::DesignReport;
pub(super) use words::without_uncertainty;
use words::{assumed, beside, beyond_spectrum, differences, require_zero_stiffness};

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
    let repair = Repair::from_file(&file, options.repaired)?;
    let weights = place.weights(&repair)?;
    let restitution = restitution(structure, &source.study);
    let (mut notes, own_oscillator) = differences(structure, &source, restitution);
    let other_oscillator = !notes.is_empty();
    let plain = spectrum_demand(structure, &source, source.spectrum(measure, site, poe));
    let repaired =
        repaired_spectrum(&file, measure, [site, poe])?.and_then(|u_m| spectrum_demand(structure, &source, &u_m));
    let spectrum = if options.repaired { repaired } else { plain };
    notes.extend(if options.repaired { None } else { beside(plain, repaired) });
    let unread = spectrum.is_none().then(|| beyond_spectrum(structure, &source));
    notes.extend(unread.clone());
    let motion = OwnMotion::from_structure(structure, options.proxy);
    let mut own = None;
    if !options.spectrum_only {
        match records_and_pairs(&source, options.manifest.as_deref(), OwnMotion::takes_pairs(&motion))? {
            Ok(records) => {
                let question = Question { place, weights: &weights, target_per_year };
                let analysed = (options, records);
                own = Some(OwnAnalysis::from_structure(
                    (structure, motion),
                    (&file, &source),
                    &question,
                    analysed,
                    events,
                )?);
            }
            Err(reason) => {
                notes.push(format!("the structure itself is not analysed; all below is from the spectrum: {reason}"));
            }
        }
    }
    let (exact, uncertainty, itself, without_own, checkpoint) = match own {
        Some(own) => (Some(own.exact), own.uncertainty, own.itself, own.without_own, Some(own.checkpoint)),
        None => (None, None, None, None, None),
    };
    notes.extend(itself.as_ref().filter(|own| own.wobbles()).map(|_| what_frames_leave_out(structure)));
    if structure.uncertainty.is_some() && uncertainty.is_none() {
        notes.push(without_uncertainty(options.repaired, &source));
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
    let own_check = own_check(exact.as_ref(), told.capacity_m, safety_factor);
    let mut alarms = alarms_within(&file, &scope((place, poe), spectrum, options.repaired))?;
    alarms.extend(structure_alarms(structure).into_iter().chain(safety_factor_alarm(safety_factor)));
    if let Some(exact) = &exact {
        let scatter = Scatter::from_file(&file)?;
        let of_oscillator = own_risks((exact, target_per_year), place, (&scatter.pairs, &weights));
        let of_own = itself.iter().flat_map(|itself| itself.own_risks(place, &scatter));
        alarms.extend(own_risk_alarms(&at_place(of_oscillator.into_iter().chain(of_own), place)));
    }
    if let Some(checkpoint) = checkpoint {
        checkpoint.remove();
    }
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
        by_proxy: OwnStructure::has_model(structure) && itself.is_none(),
        without_own,
        uncertainty,
        rules,
        by_other_measures,
        other_oscillator,
        own_oscillator,
        unread,
        assumed: assumed(structure, restitution, itself.as_ref()),
        own: itself,
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
    let file = at_target_risks(ResultFile::open(result)?, &options.risk.into())?;
    let source = StudyOfResult::read(&file, options.manifest.as_deref())?;
    require_zero_stiffness(&source)?;
    // one shard serves every site
    let site = options.site.as_ref().or(source.sites.first()).map(String::as_str);
    let Place { measure, .. } = Place::choose(&source, site, options.measure)?;
    let motion = OwnMotion::from_structure(structure, options.proxy);
    let with_pairs = OwnMotion::takes_pairs(&motion);
    let records = records_and_pairs(&source, options.manifest.as_deref(), with_pairs)?.map_err(JobError::input)?;
    let analysis = DesignAnalysis::from_structure((structure, motion), (&source, measure), (records, options))?;
    let work = analysis.work(&source, &job_name("design", structure))?;
    Ok(work.shard_beside(result, shard, events)?)
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
        for_design: true,
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

/// The capacity held against the demand on the structure's oscillator.
fn own_check(exact: Option<&ExactDemand>, capacity_m: Option<f64>, safety_factor: f64) -> Option<OwnCheck> {
    let (exact, capacity_m) = exact.zip(capacity_m)?;
    let upper_m = exact.bands.map(|bands| bands.demand_m.quoted()[1]);
    Some(OwnCheck::new(capacity_m, (exact.demand_m, upper_m), safety_factor))
}

/// The spectrum read at the strength of the structure; none where it cannot be.
fn spectrum_demand(structure: &Structure, source: &StudyOfResult, u_m: &[f64]) -> Option<SpectrumDemand> {
    let system = &structure.system;
    let strength = system.spectral_strength_at(source.study.gravity_m_s2);
    SpectrumDemand::read(&source.study.strengths, u_m, (strength, system.participation()))
}

/// The result at the risk asked for, with its bands there where it keeps draws: alarms take them, and what is quoted
/// needs none.
fn result_at(path: &Path, risk: OneRisk, events: &dyn Events) -> Result<ResultFile, DesignError> {
    let file = at_target_risks(ResultFile::open(path)?, &risk.into())?;
    Ok(if file.draws()?.is_some() { resampled(file, events)? } else { file })
}

/// What may come from outside the stripes: the demand, exceeding the capacity, overturning.
fn own_risks(
    (exact, target_per_year): (&ExactDemand, f64),
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
    let shares = EventRisk { lower_tail_share, upper_tail_share, at_most_per_year: None, ..exact.overturning };
    let demand = EventRisk { per_year: target_per_year, ..shares };
    let mut risks = vec![own("demand on its oscillator", demand), own("overturning", exact.overturning)];
    risks.extend(exact.beyond_capacity.map(|risk| own("exceeding the capacity", risk)));
    risks
}
