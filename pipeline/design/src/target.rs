//! The least strength, size, width, capacity or tendon stiffness with which a structure meets a target risk; a frame or
//! a block is then shaken itself, at the value that its oscillator needs.
//!
//! The risk of each value that is tried is that of the structure's own oscillator under the records and the hazard of a
//! result, from exact stripes. Counts of records step, and a chaotic system may step back: the best estimate is the
//! value from which on all that was tried meets the target. The safe value is the one from which on the upper limit of
//! the frequency's band does, by all that was tried together and by that value alone. Values have as many digits as are
//! printed.

mod band;
mod candidate;
mod own;
mod report;
mod request;
mod safe;
mod search;
mod table;
mod trial;
mod words;

use std::path::{Path, PathBuf};

use uplift_hazard::HazardCurve;
use uplift_risk::{SiteWeights, risk_targeted_level};
use uplift_spectra::Noisy;
use uplift_structure::Quantity;
use uplift_study::Structure;

pub use band::{TargetBand, TargetUncertainty};
pub use own::{TargetModel, TargetOwn, TriedOwn};
pub use report::{FoundSystem, GenericTarget, TargetByMeasure, TargetReport, TriedValue};
pub use request::{Exceeded, TargetEvent, TargetOptions};
pub use search::Crossing;
pub use trial::LevelShare;

use super::certainty::Scatter;
use super::hazard::Hazard;
use super::limit::FrameLimit;
use super::opening::{Place, Repair, check_tables};
use super::own_structure::{OwnMotion, OwnStructure, what_frames_leave_out};
use super::report::{ReportSource, StructureReport};
use super::risk::{at_place, own_risk};
use crate::error::DesignError;
use band::Frequencies;
use candidate::Attempt;
use own::{Judge, OF_SIZE};
use safe::safe_alone;
use search::{crossings, digits, extend, lattice, least, narrow, rounded_up, spread};
use trial::Trials;
use uplift_alarms::{Scope, alarms_of_inputs, own_risk_alarms, ranked, structure_alarms};
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_job::events::Events;
use uplift_job::text::rounded;
use uplift_result::ResultFile;
use uplift_uniform_risk::{SpectraOfResult, StudyOfResult};
use words::{Words, assumptions, kept, with_mistakes};

/// Values tried before the search narrows, over the range.
const VALUES: usize = 13;
/// How far the range reaches below and above the structure's own value, where it is not given.
const REACH: f64 = 4.0;
/// Steps of the values tried within the band, and just above the best estimate, relative to the value.
const STEPS: [f64; 2] = [0.04, 0.01];
/// Up to how many times the best estimate, or to the safe value, the noise of single records is looked for.
const NOISY: f64 = 1.1;
/// Rounds in which new values may move the ends between which they are tried.
const ROUNDS: usize = 4;
/// Half the width about the value in which the frequencies show the noise, relative to it.
const NOISE: f64 = 0.01;

/// Searches the least value of a quantity of `structure` with which it meets a target risk under the records and the
/// hazard of the result at `result`.
///
/// # Errors
/// Numbers that are no target, range or tolerance, all at once; a target below what the stripes can tell; a target that
/// is met or missed at every value of the range, or missed at its upper end; a quantity that the structure does not
/// have; a file that is missing, damaged, no result, or without sites; a site or measure that the result does not have;
/// no repaired weights there where they are asked for;
/// records that cannot be read; a table that would replace something else; [`JobError::Paused`] where `events` say
/// so, [`JobError::Interrupted`] where no checkpoint can be written beside the result.
pub fn target(
    structure: &Structure,
    result: &Path,
    options: &TargetOptions,
    events: &dyn Events,
) -> Result<TargetReport, DesignError> {
    options.check()?;
    let manifest = options.manifest.as_deref();
    if let Some(path) = &options.table {
        check_tables(&[(path, table::FIRST_COLUMN)], (structure, result, manifest), options.overwriting.force)?;
    }
    let file = ResultFile::open(result)?;
    file.refuse_records_at_level("a target is looked for with the same records at every level")?;
    let source = StudyOfResult::read(&file, manifest)?;
    let place = Place::choose(&source, options.site.as_deref(), options.measure)?;
    let Place { site, measure, .. } = place;
    let curve = file.mean_curve(place.name, measure.measure())?;
    let years = options.poe.and(options.years).unwrap_or(source.study.risk.years);
    let target_per_year = options.target_per_year(years)?;
    let (range, own_value) = range(structure, options)?;
    let repair = Repair::from_file(&file, options.repaired)?;
    let (weights, hazard) = (place.weights(&repair)?, Hazard::from_file(&file, &source, (measure, site))?);
    let (others, unchecked) = others(&file, &source, place, &repair)?;
    let scatter = Scatter::from_file(&file)?;
    let of_records = (&hazard, &scatter);
    let motion = own_motion(structure, options);
    let asked = (options, years, OwnMotion::takes_pairs(&motion));
    let mut trials = Trials::from_structure(structure, &source, (place, weights), of_records, asked, events)?;
    trials.refuse_untellable(place.name, target_per_year)?;

    let meets = |attempt: &Attempt| attempt.meets(target_per_year);
    let Searched { tried, frequencies, safe_value } =
        searched((&mut trials, of_records), range, options.tolerance, target_per_year)?;
    let words = Words { options, target_per_year };
    let mut alarms = alarms_before(&file, place, (structure, options))?;
    let at = match words.first_of_met(&tried) {
        Ok(at) => at,
        Err(reason) => {
            // that is the answer: nothing is left to go on with
            trials.finish();
            return Err(JobError::Usage(with_mistakes(reason, &alarms)).into());
        }
    };
    let (value, found) = (tried[at].0, &tried[at].1);
    let crossings = crossings(&tried, meets);
    let noise = noise_about(&tried, at);
    let mut notes = words.notes(&crossings, &tried, &noise);
    // where the safe value itself misses the target
    let safe_value = safe_value.max(value);
    let judge = Judge { structure, motion, options, place, of_records, target_per_year, years };
    let (own, without_own) = judge.judge(&mut trials, [safe_value, value], range)?;
    notes.extend(own.as_ref().filter(|own| own.wobbles()).map(|_| what_frames_leave_out(structure)));
    let by_proxy = OwnStructure::has_model(structure) && own.is_none();
    notes.extend(assumptions(&file, by_proxy));
    notes.extend(trials.without_uncertainty(&source));
    let at_return_periods = trials.at_return_periods(found, curve.as_ref(), &mut notes)?;
    let counts = (trials.records.count(), scatter.pairs.len());
    let event = options.event().words();
    let of_proxy = own_risk((&event, found.risk), (place.name, measure), counts);
    let of_own = own.iter().flat_map(|of| of.own_risks(&event, place, counts));
    alarms.extend(own_risk_alarms(&at_place([of_proxy].into_iter().chain(of_own), place)));
    alarms.extend(alarms_of_answer(structure, options.quantity, own.as_ref().map_or(safe_value, |own| own.safe_value)));
    let at_safe = tried.iter().find(|(own, _)| own.total_cmp(&safe_value).is_eq()).map(|(_, of)| of);
    let mut report = TargetReport {
        uncertainty: trials.around.as_ref().map(|of| TargetUncertainty::from_tried(of, &tried, target_per_year)),
        structure: StructureReport::from_structure(structure, Some(trials.restitution)),
        site: place.name.to_owned(),
        im: measure.measure().label(),
        im_unit: measure.measure().unit(),
        repaired: options.repaired,
        quantity: options.quantity.key(),
        quantity_unit: options.quantity.unit(),
        own_value,
        event,
        by_proxy,
        tendon_limit: tendon_limit(structure, options, own.as_ref().map_or(safe_value, |own| own.safe_value)),
        own,
        without_own,
        unrepaired: if options.repaired { None } else { place.unrepaired(&file)? },
        target_per_year,
        years,
        safe_value,
        safe_risk: at_safe.map(|of| of.risk),
        safe_bands: at_safe.and_then(|of| of.bands),
        value,
        missed_at: tried[at - 1].0,
        least_met: tried.iter().find(|(_, attempt)| meets(attempt)).map_or(value, |(value, _)| *value),
        risk: found.risk,
        unchecked,
        by_other_measures: judged_by((&file, &others), &mut trials, (place, [safe_value, value], target_per_year))?,
        kept: kept(structure, trials.restitution),
        found: FoundSystem::from_system(&found.candidate.system),
        per_year_within_one_percent: noise,
        bands: frequencies.bands(value, (target_per_year, digits(options.tolerance))),
        crossings,
        at_return_periods,
        generic: curve.as_ref().map(|curve| generic_target(curve, target_per_year, options)).transpose()?.flatten(),
        tried: tried.iter().map(|tried| TriedValue::from_attempt(tried, target_per_year)).collect(),
        analyses: trials.analyses,
        notes,
        alarms: ranked(alarms),
        repeated: options.repeated(),
        files: Vec::new(),
        source: ReportSource::read(&file, &source)?,
    };
    let written = |path: &PathBuf| table::write(path, &report).map(|()| path.clone());
    report.files = options.table.iter().map(written).collect::<Result<_, _>>()?;
    trials.finish();
    Ok(report)
}

/// Another measure than that of the search, with its hazard and what runs weigh by it.
type Other<'a> = (&'a SpectraOfResult, Hazard<'a>, SiteWeights<'a>);

/// The other measures of the result that have the weights asked for at the place, and the names of those that have not.
fn others<'a>(
    file: &ResultFile,
    source: &'a StudyOfResult,
    Place { site, measure, .. }: Place<'a>,
    repair: &'a Repair<'a>,
) -> Result<(Vec<Other<'a>>, Vec<&'static str>), DesignError> {
    let (mut others, mut unchecked) = (Vec::new(), Vec::new());
    for other in source.measures.iter().filter(|other| other.measure() != measure.measure()) {
        match repair.weights((other, site)) {
            Some(weights) => others.push((other, Hazard::from_file(file, source, (other, site))?, weights)),
            None => unchecked.push(other.measure().label()),
        }
    }
    Ok((others, unchecked))
}

/// What other measures say of the safe value, or of the best estimate where there is none.
fn judged_by<'a>(
    (file, others): (&ResultFile, &'a [Other<'a>]),
    trials: &mut Trials<'a>,
    (place, [safe_value, value], target_per_year): (Place<'a>, [f64; 2], f64),
) -> Result<Vec<TargetByMeasure>, DesignError> {
    let value = if safe_value.is_finite() { safe_value } else { value };
    let judged = |(measure, hazard, weights): &'a Other<'a>| {
        let attempt = trials.attempt_by(value, (*measure, hazard, *weights))?;
        let is_told = attempt.risk.at_most_per_year.is_none_or(|bound| bound <= target_per_year);
        let is_met = is_told.then(|| attempt.meets(target_per_year));
        let unrepaired = match weights {
            SiteWeights::Alike(_) => Place { measure, ..place }.unrepaired(file)?,
            SiteWeights::Repaired(_) => None,
        };
        Ok(TargetByMeasure { im: measure.measure().label(), risk: attempt.risk, is_met, unrepaired })
    };
    others.iter().map(judged).collect()
}

/// What is to be raised of curves, records, structure and request.
fn alarms_before(
    file: &ResultFile,
    place: Place<'_>,
    (structure, options): (&Structure, &TargetOptions),
) -> Result<Vec<Alarm>, DesignError> {
    let (site, measure) = (Some(place.site), Some(place.measure.measure()));
    let scope = Scope { site, measure, repaired: options.repaired, ..Scope::default() };
    let mut alarms = alarms_of_inputs(file, &scope)?;
    alarms.extend(structure_alarms(structure));
    alarms.extend(options.doubtful());
    Ok(alarms)
}

/// How the structure is shaken itself; none where `--proxy` asks for the oscillator alone, or that is all there is.
///
/// # Errors
/// Why it is left out although it is asked for.
fn own_motion(structure: &Structure, options: &TargetOptions) -> Result<Option<OwnMotion>, String> {
    let motion = OwnMotion::from_structure(structure, options.proxy)?;
    let has_size = !matches!(options.quantity, Quantity::Strength | Quantity::Capacity);
    if has_size || motion.is_none() { Ok(motion) } else { Err(OF_SIZE.to_owned()) }
}

/// The limit of its tendons below the capacity that a structure of this value is not to exceed; nothing beyond the
/// range.
fn tendon_limit(structure: &Structure, options: &TargetOptions, value: f64) -> Option<FrameLimit> {
    let is_asked = value.is_finite() && matches!(options.event(), TargetEvent::BeyondCapacity(_));
    let found = if is_asked { structure.varied(options.quantity, value).ok().flatten()? } else { return None };
    let limit = FrameLimit::from_tendons(found.columns.as_ref()?)?;
    (limit.displacement_m < found.system.capacity_m()?).then_some(limit)
}

/// What cannot be meant of the structure that was found, though that of the file is sound; nothing beyond the range.
fn alarms_of_answer(structure: &Structure, quantity: Quantity, value: f64) -> Vec<Alarm> {
    let before = structure_alarms(structure);
    let found = if value.is_finite() { structure.varied(quantity, value).ok().flatten() } else { None };
    let of_found = found.map_or_else(Vec::new, |found| structure_alarms(&found));
    let is_new = |alarm: &Alarm| before.iter().all(|own| own.kind != alarm.kind);
    // the file's own value is sound
    let at_value = |alarm: Alarm| {
        let subject = format!("{} with {} {} {}", alarm.subject, quantity.key(), rounded(value, 4), quantity.unit());
        Alarm { subject, ..alarm }
    };
    of_found.into_iter().filter(is_new).map(at_value).collect()
}

/// What a search has tried.
struct Searched {
    /// Everything, ascending.
    tried: Vec<(f64, Attempt)>,
    /// Without what was tried for the safe value, unless the best estimate follows from that.
    frequencies: Frequencies,
    /// Infinite beyond the range.
    safe_value: f64,
}

/// Tries values of the `range`: few all over it, more within the band, and most just above the best estimate.
fn searched(
    (trials, (hazard, scatter)): (&mut Trials<'_>, (&Hazard<'_>, &Scatter)),
    range: [f64; 2],
    tolerance: f64,
    target_per_year: f64,
) -> Result<Searched, DesignError> {
    let meets = |attempt: &Attempt| attempt.meets(target_per_year);
    let repaired = trials.weights.repaired();
    let frequencies = |tried: &[(f64, Attempt)]| Frequencies::from_trials(tried, (hazard, repaired), scatter);
    let digits = digits(tolerance);
    let mut tried = Vec::new();
    let attempt = &mut |values: &[f64]| trials.attempt(values);
    extend(&mut tried, spread(range, VALUES, digits), attempt)?;
    for (part, step) in STEPS.into_iter().enumerate() {
        for _ in 0..ROUNDS {
            let [best, lower, upper] = frequencies(&tried)?.crossings(target_per_year);
            // missed by the largest, or met by all
            if least(&tried, meets).is_none_or(|at| at == 0) {
                break;
            }
            let ends = [[lower, upper], [best, upper.min(NOISY * best)]][part];
            let next = lattice(&tried, ends, step.max(tolerance), digits);
            if !extend(&mut tried, next, attempt)? {
                break;
            }
        }
    }
    narrow(&mut tried, (tolerance, digits), &mut *attempt, meets)?;
    let of_all = frequencies(&tried)?;
    let [_, _, upper] = of_all.crossings(target_per_year);
    let best = |tried: &[(f64, Attempt)]| least(tried, meets).map_or(f64::INFINITY, |at| tried[at].0);
    let at_first = best(&tried);
    let from = rounded_up(upper, digits, range[1]).max(at_first);
    let safe_value = safe_alone(&mut tried, from, (target_per_year, tolerance), attempt, frequencies)?;
    let is_moved = best(&tried).total_cmp(&at_first).is_ne();
    let frequencies = if is_moved { frequencies(&tried)? } else { of_all };
    Ok(Searched { tried, frequencies, safe_value })
}

/// The frequencies of what was `tried` near the value at this position.
fn noise_about(tried: &[(f64, Attempt)], at: usize) -> Noisy {
    let (value, found) = &tried[at];
    let near = tried.iter().filter(|(other, _)| (other / value - 1.0).abs() <= NOISE);
    Noisy::around(found.risk.per_year, near.map(|(_, attempt)| attempt.risk.per_year))
}

/// What the generic fragility that was asked for makes of `curve`; none where none was.
fn generic_target(
    curve: &HazardCurve,
    target_per_year: f64,
    options: &TargetOptions,
) -> Result<Option<GenericTarget>, DesignError> {
    let Some((dispersion, probability)) = options.generic() else { return Ok(None) };
    let found = risk_targeted_level(curve, target_per_year, probability, dispersion)?;
    let return_period_years = options.return_periods.iter().copied().fold(0.0, f64::max);
    let uniform_hazard_level = curve.im_at_rate(1.0 / return_period_years).ok();
    Ok(Some(GenericTarget {
        dispersion,
        probability,
        level: found.level,
        median: found.fragility.median(),
        upper_tail_share: found.risk.upper_tail_per_year / found.risk.per_year,
        return_period_years,
        uniform_hazard_level,
        risk_coefficient: uniform_hazard_level.map(|level| found.level / level),
    }))
}

/// The range of the search, and the value that the structure has.
fn range(structure: &Structure, options: &TargetOptions) -> Result<([f64; 2], Option<f64>), DesignError> {
    let of_structure = |mistakes: Vec<uplift_structure::StructureError>| {
        let words: Vec<String> = mistakes.iter().map(ToString::to_string).collect();
        JobError::Usage(format!("--vary {}: {}", options.quantity.key(), words.join("; ")))
    };
    let own = options.quantity.value(&structure.description).map_err(of_structure)?;
    let around = |factor: f64| own.filter(|own| *own > 0.0).map(|own| rounded(own * factor, digits(options.tolerance)));
    let end = |given: Option<f64>, factor: f64, option: &str| {
        given.or(around(factor)).ok_or_else(|| {
            JobError::Usage(format!(
                "{option}: the structure has no {} above 0 to start from: give both --from and --to",
                options.quantity.key()
            ))
        })
    };
    let range = [end(options.from, 1.0 / REACH, "--from")?, end(options.to, REACH, "--to")?];
    if range[0] >= range[1] {
        let [from, to] = range;
        return Err(JobError::Usage(format!("--from {from} is not below --to {to}: give a range that rises")).into());
    }
    Ok((range, own))
}
