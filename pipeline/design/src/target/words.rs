//! What is said of a search: why it has no answer, where it crosses the target, what it takes for granted.

use uplift_job::alarm::{Alarm, Severity};
use uplift_job::text::{rate, rounded};
use uplift_result::ResultFile;
use uplift_spectra::Noisy;
use uplift_structure::UncertainQuantity;
use uplift_study::Structure;
use uplift_uniform_risk::EventRisk;

use super::TargetOptions;
use super::candidate::Attempt;
use super::search::{Crossing, crossings};

/// A refusal with the numbers that are probably mistaken: the reason for it, most likely.
pub(super) fn with_mistakes(reason: String, alarms: &[Alarm]) -> String {
    let mistakes = alarms.iter().filter(|alarm| alarm.severity == Severity::Mistake);
    let line = |alarm: &Alarm| format!("\n{} {alarm}: {}", alarm.severity.word(), alarm.what_to_do);
    mistakes.fold(reason, |said, alarm| said + &line(alarm))
}

/// Crossings that are listed: more are noise.
const MOST_CROSSINGS: usize = 12;

/// What is to be said of the values that were tried.
pub(super) struct Words<'a> {
    pub(super) options: &'a TargetOptions,
    pub(super) target_per_year: f64,
}

impl Words<'_> {
    /// Position of the least value from which on all meet the target.
    ///
    /// # Errors
    /// Why there is none.
    pub(super) fn first_of_met(&self, tried: &[(f64, Attempt)]) -> Result<usize, String> {
        let Self { options, target_per_year } = self;
        let (key, event) = (options.quantity.key(), options.event().words());
        let at = |(value, attempt): &(f64, Attempt)| {
            let frequency = match attempt.risk {
                EventRisk { per_year: 0.0, at_most_per_year: Some(bound), .. } => format!("less than {}", rate(bound)),
                EventRisk { per_year: 0.0, .. } => "none".to_owned(),
                EventRisk { per_year, .. } => rate(per_year),
            };
            format!("{frequency} at {}", self.value(*value))
        };
        let ends = || match (tried.first(), tried.last()) {
            (Some(first), Some(last)) => format!("{} and {}", at(first), at(last)),
            _ => String::new(),
        };
        let allowed = rate(*target_per_year);
        let missed = tried.iter().rposition(|(_, attempt)| !attempt.meets(*target_per_year));
        match missed {
            None => Err(format!(
                "the target is met at every {key} tried: the annual rate of {event} is {}; the target is {allowed}: \
                  give a lower --from, or a rarer target",
                ends()
            )),
            Some(last) if last + 1 < tried.len() => Ok(last + 1),
            Some(_) => {
                let found = crossings(tried, |attempt| attempt.meets(*target_per_year));
                if found.is_empty() {
                    return Err(format!(
                        "the target is missed at every {key} tried: the annual rate of {event} is {}; the target is \
                         {allowed}: give a higher --to, or vary something else",
                        ends()
                    ));
                }
                Err(format!(
                    "the target is met in between and missed at the largest {key}: {}. A larger one is not safer \
                     here: choose --to below the last of these crossings",
                    self.crossings(&found)
                ))
            }
        }
    }

    /// What is to be said of these crossings, and of the frequencies about the value.
    pub(super) fn notes(&self, found: &[Crossing], tried: &[(f64, Attempt)], noise: &Noisy) -> Vec<String> {
        let margin = (noise.highest > self.target_per_year).then(|| {
            let [lowest, highest] = [noise.lowest, noise.highest].map(rate);
            format!(
                "within 1 % of this {} the annual rate varies from {lowest} to {highest}: add a margin",
                self.options.quantity.key()
            )
        });
        self.crossings_in_words(found, tried).into_iter().chain(margin).collect()
    }

    fn crossings_in_words(&self, found: &[Crossing], tried: &[(f64, Attempt)]) -> Option<String> {
        if found.len() < 2 {
            return None;
        }
        let least = tried.iter().find(|(_, attempt)| attempt.meets(self.target_per_year));
        let least = least.map_or_else(String::new, |(value, _)| {
            format!(", below it only some do, the smallest {}", self.value(*value))
        });
        Some(format!(
            "the annual rate crosses the target {} times ({}): above the best estimate every value tried meets it\
             {least}",
            found.len(),
            self.crossings(found)
        ))
    }

    fn value(&self, value: f64) -> String {
        // six digits, and no more of a stiffness than of a width
        let rounded = format!("{value:.5e}").parse::<f64>().unwrap_or(value);
        format!("{rounded} {}", self.options.quantity.unit()).trim_end().to_owned()
    }

    fn crossings(&self, found: &[Crossing]) -> String {
        let words: Vec<String> = found
            .iter()
            .take(MOST_CROSSINGS)
            .map(|crossing| {
                let becomes = if crossing.becomes_met { "met" } else { "missed" };
                format!("{becomes} from {} on", self.value(crossing.to))
            })
            .collect();
        let more = if found.len() > MOST_CROSSINGS {
            format!(", and {} more", found.len() - MOST_CROSSINGS)
        } else {
            String::new()
        };
        format!("{}{more}", words.join(", "))
    }
}

/// What a structure of every value keeps, but for what is drawn, in words; its restitution is this.
pub(super) fn kept(structure: &Structure, restitution: f64) -> String {
    let is_drawn = |quantity| structure.uncertainty.as_ref().is_some_and(|of| of.quantities.contains(&quantity));
    let uplift_mm = rounded(1e3 * structure.system.conditions().uplift_displacement_m(), 4);
    let period_s = structure.description.period_s;
    let uplift = period_s.map_or_else(|| format!("uplift displacement {uplift_mm} mm"), |s| format!("period {s} s"));
    let uplift = Some(uplift).filter(|_| !is_drawn(UncertainQuantity::UpliftDisplacement));
    let restitution = Some(restitution).filter(|_| !is_drawn(UncertainQuantity::Restitution));
    let restitution = restitution.map(|restitution| format!("restitution {restitution}"));
    // a wider column of the same mass is another material
    let mass = structure.description.column_mass_kg.map(|mass_kg| format!("column mass {mass_kg} kg"));
    let kept = uplift.into_iter().chain(restitution).chain(mass);
    kept.collect::<Vec<_>>().join(", ")
}

/// What is taken for granted of the records and of the model.
pub(super) fn assumptions(file: &ResultFile, by_proxy: bool) -> Vec<String> {
    let mut notes = Vec::new();
    if file.stored_study().is_ok_and(|study| study.records.vertical) {
        notes.push(
            "the equivalent oscillator ignores the vertical components of the records, which shake frames and blocks"
                .to_owned(),
        );
    }
    if by_proxy {
        notes.push("the value is that of the equivalent oscillator, not of the structure itself".to_owned());
    }
    notes
}
