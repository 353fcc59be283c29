//! The section `[uncertainty]`: what of the oscillators is not known exactly.

use uplift_structure::UncertainQuantity;
use uplift_uncertainty::Distribution;

use super::{Oscillator, Records};
use crate::keys::{Key, SectionKeys};
use crate::reading::Section;
use crate::sections::uncertainty::{self, Described, Doubt, Uncertainty};
use crate::warning::Warning;

pub(super) const KEYS: SectionKeys = SectionKeys {
    section: "uncertainty",
    keys: &[
        Key {
            names: &["kind"],
            meaning: "`\"epistemic\"`, one structure of which it is not known which: all records shake the same \
                      `samples` structures, and the spectrum has a band over them; `\"aleatory\"`, another structure \
                      in every earthquake: each record shakes `draws` structures of its own",
            default: "`\"epistemic\"`",
            range: "",
        },
        Key {
            names: &["sampling"],
            meaning: "`\"sobol\"`, scrambled Sobol' points, or `\"latin-hypercube\"`",
            default: "`\"sobol\"`",
            range: "",
        },
        Key {
            names: &["samples"],
            meaning: "structures of an epistemic study, each as many analyses again",
            default: "64",
            range: "8 to 4096; a power of two for `\"sobol\"`",
        },
        Key {
            names: &["draws"],
            meaning: "structures of each record in an aleatory study, each as many analyses again",
            default: "10",
            range: "1 to 100",
        },
        Key { names: &["seed"], meaning: "where the random numbers begin", default: "1", range: "0 to 2⁶³ − 1" },
    ],
};

pub(super) const QUANTITY_KEYS: SectionKeys = SectionKeys {
    section: "uncertainty.restitution",
    keys: &[
        Key {
            names: &["distribution"],
            meaning: "`\"lognormal\"`, `\"normal\"`, `\"uniform\"` or `\"triangular\"`. The same keys in \
                      `[uncertainty.uplift_displacement_m]` and, where the oscillator has one, \
                      `[uncertainty.capacity_m]`; in `[uncertainty.strength]` this and `coefficient_of_variation` \
                      alone, about each of the strengths",
            default: "required",
            range: "",
        },
        Key {
            names: &["coefficient_of_variation"],
            meaning: "standard deviation over mean; 0 is a quantity that is known",
            default: "none",
            range: "",
        },
        Key { names: &["mean"], meaning: "the mean beside it", default: "that of `[oscillator]`", range: "" },
        Key {
            names: &["percentiles"],
            meaning: "two percentages with their values in place of these, `[[5, 0.9], [95, 0.97]]`",
            default: "none",
            range: "",
        },
        Key {
            names: &["lower", "upper"],
            meaning: "limits of a uniform or triangular one in place of these",
            default: "none",
            range: "",
        },
        Key { names: &["mode"], meaning: "of a triangular one with limits", default: "the middle", range: "" },
    ],
};

pub(super) const CORRELATION_KEYS: SectionKeys = SectionKeys {
    section: "uncertainty.correlation",
    keys: &[
        Key {
            names: &["between"],
            meaning: "two quantities that go together, `[\"strength\", \"restitution\"]`",
            default: "required",
            range: "",
        },
        Key {
            names: &["coefficient"],
            meaning: "of the normal quantities behind them (Gaussian copula)",
            default: "required",
            range: "above −1 and below 1",
        },
    ],
};

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
        Some(None) => Described::Impossible("the oscillator has no capacity: its force does not fall after uplift"),
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
            let what = format!("{:.1} % of the {} are cut off, where it cannot be", 100.0 * share, quantity.name());
            Warning::new(what, "its mean is another than the one that is written: give limits, or less scatter")
        })
    };
    let of_cuts = uncertainty.quantities.iter().zip(uncertainty.vector.distributions()).filter_map(cut);
    let warnings = doubts.iter().map(asked).chain(of_cuts).collect();
    Some((Some(uncertainty), warnings))
}

/// Whether the records are the same at every level, where something is uncertain; else a mistake.
pub(super) fn without_sets_of_levels(root: &Section<'_>, records: Option<&Records>, is_uncertain: bool) -> bool {
    if !is_uncertain || records.is_none_or(|records| records.at_level.is_none()) {
        return true;
    }
    root.mistake(
        "records.at_level",
        "levels with records of their own, and oscillators that are not known exactly",
        "leave one of them out: [uncertainty] shakes structures by one set of records",
    );
    false
}
