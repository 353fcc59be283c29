//! What an engineer would raise before using the numbers of a result: one ranked list, each thing said once with what
//! to do about it.
//!
//! It is derived from the result file, so that the summary of a run, `uplift table`, the page, an export and a design
//! say the same; thresholds and their reasons: docs/warnings.md.
//!
//! | module | what it looks at |
//! |---|---|
//! | `inputs` | the study's numbers, the records, what was noticed about the inputs |
//! | `curves_at_site` | the curves of a site, and which of them is odd |
//! | `hazard` | hazard curves that are probably mistaken, by the three that follow |
//! | `probabilities` | those that look like probabilities |
//! | `implausible` | those by which extreme shaking is frequent, or the faintest rare |
//! | `branches` | weighted ones of which some are far from the others |
//! | `levels` | ordinates that rest on what lies outside the analysed levels, or do not exist |
//! | `curves` | hazard curves of PGV and of PGA that cannot be of one site |
//! | `consistency` | records that miss the hazard of the other measure |
//! | `measures` | spectra by PGV and by PGA that disagree |
//! | `numbers` | numbers of a command line in another unit, probably |
//! | `fit` | fitted curves that leave their spectrum |
//! | `structure` | a structure's numbers, and risks of its own that the levels do not hold |

mod branches;
mod consistency;
mod curves;
mod curves_at_site;
mod error;
mod evidence;
mod fit;
mod hazard;
mod implausible;
mod inputs;
mod levels;
mod measures;
mod numbers;
mod probabilities;
mod structure;

use uplift_job::alarm::{Alarm, Severity};
use uplift_motion::IntensityMeasure;

pub use consistency::FEW_EFFECTIVE_RECORDS;
pub use curves::curves_alarm;
pub use curves_at_site::CurvesAtSite;
pub use error::AlarmsError;
pub use evidence::{Evidence, Scope, spectrum_name};
pub use fit::{FitReach, reach_of_fit};
pub use hazard::hazard_alarms;
pub use inputs::{far_factors_alarm, few, few_earthquakes, noticed_alarm, study_alarms, synthetic_records};
pub use levels::{BELOW_FIRST_LEVEL, BEYOND_LAST_LEVEL, UpperEnd, below_first_case};
pub use numbers::number_alarms;
pub use structure::{OwnRisk, own_risk_alarms, safety_factor_alarm, structure_alarms};
use uplift_result::{Kind, ResultFile};
pub use uplift_risk::COMPARED_FROM_M;

/// The alarms in the order in which they should be read: the worst first, and what was noticed of the inputs last.
pub fn ranked(mut alarms: Vec<Alarm>) -> Vec<Alarm> {
    alarms.sort_by_key(|alarm| (alarm.severity, alarm.kind == inputs::NOTICED));
    alarms
}

/// All that is to be raised about the result `file`, the worst first.
///
/// # Errors
/// A file that is damaged.
pub fn alarms(file: &ResultFile) -> Result<Vec<Alarm>, AlarmsError> {
    alarms_of(file, &Scope::default())
}

/// The alarms of the spectra within `scope`, the worst first.
///
/// # Errors
/// A file that is damaged.
pub fn alarms_of(file: &ResultFile, scope: &Scope) -> Result<Vec<Alarm>, AlarmsError> {
    let mut alarms = inputs::result_alarms(file)?;
    if file.kind() == Kind::UniformRisk && !file.axes()?.sites.is_empty() {
        let evidence = Evidence::read(file, scope)?;
        put_repair_first(&mut alarms, &evidence, scope);
        alarms.extend(spectra_alarms(&evidence, scope)?);
    }
    Ok(ranked(alarms))
}

/// The alarms that concern a structure which is read into the spectra of `file` within `scope`; not ranked yet.
///
/// # Errors
/// A file that is damaged, or without sites.
pub fn alarms_within(file: &ResultFile, scope: &Scope) -> Result<Vec<Alarm>, AlarmsError> {
    let evidence = Evidence::read(file, scope)?;
    let mut alarms = inputs::result_alarms(file)?;
    put_repair_first(&mut alarms, &evidence, scope);
    alarms.extend(hazard::alarms(&evidence, scope));
    alarms.extend(levels::alarms(&evidence, scope)?);
    if !scope.repaired {
        alarms.extend(measures::alarms(&evidence, scope));
        alarms.extend(consistency::alarms(&evidence, scope));
    }
    Ok(alarms)
}

/// The alarms that concern curves and records alone, whoever asks something new of them; not ranked yet.
///
/// # Errors
/// A file that is damaged, or without sites.
pub fn alarms_of_inputs(file: &ResultFile, scope: &Scope) -> Result<Vec<Alarm>, AlarmsError> {
    let mut alarms = inputs::result_alarms(file)?;
    let evidence = Evidence::read(file, scope)?;
    alarms.extend(hazard::alarms(&evidence, scope));
    // of what is repaired already a note says how to read the spectrum, which is another question
    alarms.extend(consistency::alarms(&evidence, scope).filter(|alarm| alarm.severity != Severity::Note));
    alarms.extend(scope.repaired.then(|| consistency::few_effective(&evidence, scope)).flatten());
    Ok(alarms)
}

fn spectra_alarms(evidence: &Evidence, scope: &Scope) -> Result<Vec<Alarm>, AlarmsError> {
    let mut alarms = hazard::alarms(evidence, scope);
    alarms.extend(levels::alarms(evidence, scope)?);
    if !scope.repaired {
        alarms.extend(measures::alarms(evidence, scope));
        alarms.extend(consistency::alarms(evidence, scope));
    }
    alarms.extend(consistency::without_repair(evidence, scope));
    // of the whole result: a plain spectrum has nothing to do with weights
    if *scope == Scope::default() {
        alarms.extend(consistency::repair_alarms(evidence, scope));
    }
    Ok(alarms)
}

/// What a repaired spectrum that is asked for rests on, before what is true of any spectrum of the records.
fn put_repair_first(alarms: &mut Vec<Alarm>, evidence: &Evidence, scope: &Scope) {
    if scope.repaired {
        alarms.splice(..0, consistency::repair_alarms(evidence, scope));
    }
}

/// What is to be raised about the fitted curves (Eq. 4.11) of `file`, by one `measure` or by all: it belongs beside
/// their coefficients, since nearly every curve leaves its spectrum somewhere.
///
/// # Errors
/// A file that is damaged, or without sites.
pub fn fit_alarms(file: &ResultFile, measure: Option<IntensityMeasure>) -> Result<Vec<Alarm>, AlarmsError> {
    let scope = Scope { measure, ..Scope::default() };
    Ok(fit::alarms(&Evidence::read(file, &scope)?, &scope))
}

#[cfg(test)]
mod tests {
    use uplift_job::alarm::Case;

    use super::*;

    #[test]
    fn the_worst_speaks_for_all_and_comes_first() {
        let case = |badness: f64, severity, subject: &str| Case {
            severity,
            badness,
            subject: subject.to_owned(),
            what: format!("is off by {badness}"),
            what_to_do: "mend it".to_owned(),
        };
        let cases = vec![case(2.0, Severity::Note, "Here"), case(3.0, Severity::Caution, "There")];
        let found = Alarm::from_cases("off", cases).into_iter().collect::<Vec<_>>();
        assert_eq!(found[0].to_string(), "There (2 cases): is off by 3");
        assert_eq!((found[0].severity, &found[0].also[..]), (Severity::Caution, &["Here".to_owned()][..]));
        assert_eq!(Alarm::from_cases("off", Vec::new()), None);

        let of = |severity| Alarm::new(severity, "kind", "subject", String::new(), "");
        let order = ranked(vec![of(Severity::Note), of(Severity::Mistake), of(Severity::Caution)]);
        let order: Vec<Severity> = order.iter().map(|alarm| alarm.severity).collect();
        assert_eq!(order, [Severity::Mistake, Severity::Caution, Severity::Note]);
    }
}
