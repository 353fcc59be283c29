//! What is to be raised about a structure: its own numbers, and risks of it that the analysed levels do not hold.

use uplift_job::alarm::{Alarm, Case, Severity};
use uplift_job::text::{per_cent, rate, records_in_words, share as share_in_words};
use uplift_motion::IntensityMeasure;
use uplift_plausible::USUAL_SAFETY_FACTOR;
use uplift_risk::DECISIVE_SHARE;
use uplift_structure::Warning;
use uplift_study::{Structure, levels_key};
use uplift_uniform_risk::{BOUND_CONFIDENCE, EventRisk};

use super::inputs::warning_alarm;

/// A risk of the structure itself by the stripes of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnRisk {
    /// What happens, where and by what: `overturning, Athens, PGV`.
    pub subject: String,
    /// How often it happens.
    pub risk: EventRisk,
    /// The measure of the stripes.
    pub measure: IntensityMeasure,
    /// The first and the last level of the stripes.
    pub levels: (f64, f64),
    /// Records of the set.
    pub records: usize,
    /// Pairs that they are of.
    pub pairs: usize,
    /// To how many pairs that count alike these amount.
    pub effective_pairs: f64,
    /// Rate of motions above the last level, 1/yr; infinite where it is not known.
    pub beyond_per_year: f64,
}

/// Numbers of the structure file that are probably in another unit, or exchanged.
pub fn structure_alarms(structure: &Structure) -> Vec<Alarm> {
    let unlikely = structure.warnings.iter().map(|warning| warning_alarm(&structure.name(), warning));
    unlikely.chain(wider_than_tall(structure)).collect()
}

/// A body whose width and height were probably exchanged: the theory is of slender ones.
fn wider_than_tall(structure: &Structure) -> Option<Alarm> {
    let is_wide = |warning: &&Warning| match warning {
        Warning::Stocky { slenderness_rad, .. } => *slenderness_rad > std::f64::consts::FRAC_PI_4,
        _ => false,
    };
    let what = structure.system.warnings().iter().find(is_wide)?;
    let what_to_do = "Swap width and height if they were mixed up";
    Some(Alarm::new(
        Severity::Mistake,
        "unlikely-number",
        &structure.name(),
        format!("wider than tall, {what}"),
        what_to_do,
    ))
}

/// A safety factor that was probably meant otherwise.
pub fn safety_factor_alarm(safety_factor: f64) -> Option<Alarm> {
    let found = USUAL_SAFETY_FACTOR.unlikely("--safety-factor", safety_factor)?;
    let what_to_do = "Give --safety-factor as a factor, or leave it if it is meant";
    Some(Alarm::new(Severity::Mistake, "unlikely-number", "design", found.to_string(), what_to_do))
}

/// Risks that come from outside the stripes, and those that no run of them shows.
pub fn own_risk_alarms(risks: &[OwnRisk]) -> Vec<Alarm> {
    let outside = risks.iter().filter_map(outside_levels).collect();
    let unseen = risks.iter().filter_map(none_seen).collect();
    let kinds = [("risk-outside-levels", outside), ("none-overturned", unseen)];
    kinds.into_iter().filter_map(|(kind, cases)| Alarm::from_cases(kind, cases)).collect()
}

fn outside_levels(own: &OwnRisk) -> Option<Case> {
    let (share, what) = own.risk.outside_levels(own.levels, own.measure.unit(), own.beyond_per_year, share_in_words)?;
    Some(Case {
        severity: if share > DECISIVE_SHARE { Severity::Caution } else { Severity::Note },
        badness: share,
        subject: own.subject.clone(),
        what,
        what_to_do: format!(
            "Add higher levels to {}; extend the hazard curve if it ends there",
            levels_key(own.measure)
        ),
    })
}

fn none_seen(own: &OwnRisk) -> Option<Case> {
    let at_most_per_year = own.risk.at_most_per_year?;
    Some(Case {
        severity: Severity::Note,
        badness: at_most_per_year,
        subject: own.subject.clone(),
        what: format!(
            "0 of {}{weighted} up to {} {}: at most {} a year ({} confidence)",
            records_in_words(own.records, own.pairs),
            own.levels.1,
            own.measure.unit(),
            rate(at_most_per_year),
            per_cent(BOUND_CONFIDENCE),
            weighted = if own.effective_pairs < own.pairs as f64 {
                format!(" (weighted, they count as {:.0})", own.effective_pairs)
            } else {
                String::new()
            },
        ),
        what_to_do: format!("Raise {} for a smaller bound", levels_key(own.measure)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RISK: EventRisk = EventRisk {
        per_year: 1e-5,
        probability: 5e-4,
        lower_tail_share: 0.0,
        upper_tail_share: 0.0,
        at_most_per_year: None,
    };

    fn own(risk: EventRisk) -> OwnRisk {
        let subject = "overturning, Here, PGV".to_owned();
        OwnRisk {
            subject,
            risk,
            measure: IntensityMeasure::Pgv,
            levels: (1.0, 200.0),
            records: 30,
            pairs: 30,
            effective_pairs: 30.0,
            beyond_per_year: f64::INFINITY,
        }
    }

    #[test]
    fn a_risk_from_outside_the_levels_says_which_way_it_is_wrong() {
        assert_eq!(own_risk_alarms(&[own(RISK)]), []);
        let [above] = &own_risk_alarms(&[own(EventRisk { upper_tail_share: 0.078, ..RISK })])[..] else { panic!() };
        assert_eq!(above.severity, Severity::Note);
        assert!(above.what == "rate too low (7.8 % of the risk lies above the last level, 200 cm/s)", "{above}");
        let [below] = &own_risk_alarms(&[own(EventRisk { lower_tail_share: 0.5, ..RISK })])[..] else { panic!() };
        assert!(
            below.severity == Severity::Caution
                && below.what.ends_with("too high (50 % of the risk lies below the first level, 1 cm/s)"),
            "{below}"
        );
    }

    #[test]
    fn none_of_thirty_is_not_never() {
        let [none] = &own_risk_alarms(&[own(EventRisk { per_year: 0.0, at_most_per_year: Some(2.3e-5), ..RISK })])[..]
        else {
            panic!()
        };
        for words in ["0 of 30 records up to 200 cm/s", "at most 2.3e-5 a year (95 % confidence)"] {
            assert!(none.what.contains(words), "{words}: {none}");
        }
    }

    #[test]
    fn none_of_thirty_pairs_is_no_more_for_having_two_components() {
        let both = OwnRisk { records: 60, ..own(EventRisk { per_year: 0.0, at_most_per_year: Some(2.3e-5), ..RISK }) };
        let [none] = &own_risk_alarms(&[both])[..] else { panic!() };
        for words in ["0 of 60 records of 30 pairs up to", "at most 2.3e-5 a year"] {
            assert!(none.what.contains(words), "{words}: {none}");
        }
    }

    #[test]
    fn a_safety_factor_of_forty_raises_a_warning() {
        assert_eq!(safety_factor_alarm(2.5), None);
        assert!(safety_factor_alarm(40.0).is_some_and(|alarm| alarm.what.starts_with("--safety-factor is 40")));
    }
}
