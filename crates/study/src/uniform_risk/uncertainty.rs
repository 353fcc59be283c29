//! The section `[uncertainty]`: what of the oscillators is not known exactly.

use uplift_structure::UncertainQuantity;
use uplift_uncertainty::Distribution;

use super::Oscillator;
use crate::reading::Section;
use crate::sections::uncertainty::{self, Described, Doubt, Uncertainty};
use crate::warning::Warning;

/// Ways to give a distribution that a strength, which scatters about each of the study's, has not.
const NOT_OF_STRENGTH: [&str; 5] = ["mean", "percentiles", "lower", "upper", "mode"];

/// A share of a distribution that may be cut off in silence.
const LITTLE: f64 = 0.001;

/// Reads the section, and what is to be asked about it. None where something is wrong.
pub(super) fn read(
    mut section: Section<'_>,
    oscillator: Option<&Oscillator>,
) -> Option<(Option<Uncertainty>, Vec<Warning>)> {
    if !section.is_present() {
        return Some((None, Vec::new()));
    }
    let mut of_strength = section.section(UncertainQuantity::Strength.key());
    for key in NOT_OF_STRENGTH {
        if let Some(field) = of_strength.field(key) {
            field.mistake(
                "a study has many strengths, and each scatters about its own value",
                "give coefficient_of_variation alone",
            );
        }
    }
    let described = |quantity: UncertainQuantity| match oscillator.map(|oscillator| oscillator.value(quantity)) {
        Some(Some(value)) => Described::As(value),
        Some(None) => Described::NoCapacity,
        None => Described::Mistaken,
    };
    let mut doubts = Vec::new();
    let uncertainty = uncertainty::read(section, &described, &mut doubts)?;
    let asked = |Doubt { key, what, .. }: &Doubt| Warning {
        unlikely: true,
        ..Warning::new(format!("{key}{what}"), format!("correct {key}, or leave it if it is meant"))
    };
    let cut = |(quantity, of): (&UncertainQuantity, &Distribution)| {
        let share = of.cut_off_share();
        (share > LITTLE).then(|| {
            let what = format!(
                "{:.1} % of the {} are outside the possible range, and are cut off",
                100.0 * share,
                quantity.name()
            );
            Warning::new(what, "this moves its mean: give limits, or less scatter")
        })
    };
    let of_cuts = uncertainty.quantities.iter().zip(uncertainty.vector.distributions()).filter_map(cut);
    let warnings = doubts.iter().map(asked).chain(of_cuts).collect();
    Some((Some(uncertainty), warnings))
}

/// A mistake for records that are not the same at every level.
pub(super) fn refuse_sets_of_levels(root: &Section<'_>) {
    root.mistake(
        "records.at_level",
        "levels with records of their own, and oscillators that are not known exactly",
        "leave one of them out: [uncertainty] shakes structures by one set of records",
    );
}
