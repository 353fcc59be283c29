//! The section `[risk]`: probabilities, and how the spectrum is read from the risk integral.

use serde::{Serialize, Serializer};
use uplift_hazard::Extrapolation;
use uplift_plausible::{THRESHOLD, YEARS};

use crate::grid::{Grid, GridRule};
use crate::keys::{Boolean, Choice, Key, List, Number, SectionKeys, boolean, choice, grid, number};
use crate::reading::{Field, PROBABILITY, Rule, Section, quantity};

pub(super) const KEYS: SectionKeys =
    SectionKeys::new("risk", &[&POE, &IN_YEARS, &CONTOUR, &THRESHOLDS_M, &MAF_SURFACE, &EXTRAPOLATE]);
const POE: Key<List<Number>> = number("poe", "", PROBABILITY)
    .list()
    .with_default(&[0.02, 0.10, 0.50])
    .meaning("probabilities of exceedance in `years`, one or a list")
    .note("each once; at most 1000");
const IN_YEARS: Key<Number> =
    number("years", "yr", Rule::Within(YEARS)).with_default(50.0).meaning("time that they refer to, yr");
const CONTOUR: Key<Choice<Contour>> =
    choice("contour", &Contour::ALL, Contour::key).with_default(Contour::Exact).meaning(
        "how ordinates are read: `\"exact\"` for the analysed levels, the smallest displacement whose annual frequency \
     meets the target; `\"grid\"`, log-linear between thresholds",
    );
const THRESHOLDS_M: Key<GridRule> =
    grid("thresholds_m", GridRule { unit: "m", each: Rule::Within(THRESHOLD), least_count: 2 })
        .with_default(&["0", "0.0005", "0.001:0.001:3"])
        .meaning("displacement thresholds of the surface of annual frequencies, m, a grid")
        .note("from 0 on");
const MAF_SURFACE: Key<Boolean> = boolean("maf_surface").with_default(true).meaning("whether that surface is kept");
const EXTRAPOLATE: Key<Choice<Extrapolation>> =
    choice("extrapolate", &Extrapolation::ALL, Extrapolation::key).with_default(Extrapolation::Refuse).meaning(
        "what happens to a level outside a hazard curve: `\"refuse\"`, an error; `\"loglog\"`, the curve goes on \
         straight in logarithms",
    );

/// Most probabilities, each a spectrum for every site.
const MOST_PROBABILITIES: usize = 1000;

/// Probabilities, and how the spectrum is read from the risk integral (Eq. 4.4).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Risk {
    /// Probabilities of exceedance in `years` \[-\].
    pub poe: Vec<f64>,
    /// Time that the probabilities refer to \[yr\].
    pub years: f64,
    /// How ordinates are read.
    pub contour: Contour,
    /// Displacement thresholds of the surface of exceedance frequencies \[m\].
    pub thresholds_m: Grid,
    /// Whether the surface is kept.
    pub maf_surface: bool,
    /// What happens to a level outside a hazard curve.
    #[serde(serialize_with = "write_extrapolation")]
    pub extrapolate: Extrapolation,
}

/// How an ordinate of the spectrum is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Contour {
    /// As the exact quantile: the smallest displacement whose frequency meets the target.
    Exact,
    /// From the surface, log-linear between thresholds.
    Grid,
}

impl Contour {
    /// Every way.
    pub const ALL: [Self; 2] = [Self::Exact, Self::Grid];

    /// Its word in files and keys: exact, grid.
    pub fn key(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Grid => "grid",
        }
    }
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn write_extrapolation<S: Serializer>(extrapolation: &Extrapolation, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(extrapolation.key())
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Risk> {
    let poe = section.given(&POE).map_or_else(|| POE.default().map(<[f64]>::to_vec), |field| probabilities(&field));
    let years = section.read(&IN_YEARS);
    let contour = section.read(&CONTOUR);
    let thresholds_m = section.read(&THRESHOLDS_M);
    if let Some(&first_m) = thresholds_m.as_ref().and_then(|grid| grid.first()).filter(|first_m| **first_m != 0.0) {
        let message = format!("the grid starts at {}", quantity(first_m, "m"));
        section.mistake(THRESHOLDS_M.name, message, "let it start at 0, where every run that moves is counted");
    }
    let maf_surface = section.read(&MAF_SURFACE);
    let extrapolate = section.read(&EXTRAPOLATE);
    section.finish();
    Some(Risk {
        poe: poe?,
        years: years?,
        contour: contour?,
        thresholds_m: thresholds_m?,
        maf_surface: maf_surface?,
        extrapolate: extrapolate?,
    })
}

fn probabilities(field: &Field<'_>) -> Option<Vec<f64>> {
    let items = field.items();
    if items.is_empty() {
        return field.refuse("the list is empty", "give at least one probability, e.g. [0.1]");
    }
    if items.len() > MOST_PROBABILITIES {
        return field.refuse(
            format!("the list has {} probabilities", items.len()),
            format!("give at most {MOST_PROBABILITIES}"),
        );
    }
    let mut complete = true;
    let mut probabilities: Vec<f64> = Vec::new();
    for item in &items {
        match item.number("", PROBABILITY) {
            Some(poe) if probabilities.contains(&poe) => {
                item.mistake(format!("{poe} is given twice"), "give each probability once");
                complete = false;
            }
            Some(poe) => probabilities.push(poe),
            None => complete = false,
        }
    }
    complete.then_some(probabilities)
}
