//! What is shaken: oscillators or blocks.

use serde::{Serialize, Serializer};

use super::blocks::{self, BlockFamily};
use super::oscillators::{self, OscillatorFamily};
use crate::grid::Grid;
use crate::reading::Section;
use crate::sections::strengths;

/// Most structures under each motion; more is a slip of a step.
const MOST_STRUCTURES: usize = 1_000_000;

/// What is shaken.
#[derive(Debug, Clone, PartialEq)]
pub enum Structures {
    /// Oscillators that uplift, by strength (Chapter 3).
    Oscillators(OscillatorFamily),
    /// Rigid blocks, by slenderness (Chapter 2).
    Blocks(BlockFamily),
}

impl Structures {
    /// The abscissa of the spectra: strengths or slendernesses.
    pub fn abscissa(&self) -> &Grid {
        match self {
            Self::Oscillators(family) => &family.strengths,
            Self::Blocks(family) => &family.slendernesses,
        }
    }

    /// How many lines a spectrum has: all combinations but for the abscissa.
    pub fn lines(&self) -> usize {
        match self {
            Self::Oscillators(family) => family.uplift_displacement_m.len() * family.capacity_m.len(),
            Self::Blocks(family) => family.height_m.len(),
        }
    }
}

/// As the two sections of a study file.
impl Serialize for Structures {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Values<'a>(#[serde(serialize_with = "strengths::write")] &'a Grid);
        #[derive(Serialize)]
        #[serde(untagged)]
        enum Written<'a> {
            Oscillators { oscillator: &'a OscillatorFamily, strengths: Values<'a> },
            Blocks { block: &'a BlockFamily, slenderness: Values<'a> },
        }
        let written = match self {
            Self::Oscillators(family) => {
                Written::Oscillators { oscillator: family, strengths: Values(&family.strengths) }
            }
            Self::Blocks(family) => Written::Blocks { block: family, slenderness: Values(&family.slendernesses) },
        };
        written.serialize(serializer)
    }
}

/// Reads `[oscillator]` with `[strengths]`, or `[block]` with `[slenderness]`.
pub(super) fn read(root: &mut Section<'_>) -> Option<Structures> {
    let (oscillator, strengths) = (root.section("oscillator"), root.section("strengths"));
    let (block, slenderness) = (root.section("block"), root.section("slenderness"));
    let structures = match (oscillator.is_present(), block.is_present()) {
        (true, true) => {
            return block.refuse("", "a study has oscillators or blocks, not both", "keep [oscillator] or [block]");
        }
        (false, false) => {
            return root.refuse(
                "",
                "the study has nothing to shake",
                "add a section [oscillator] (Chapter 3) or [block] (Chapter 2); it may be empty",
            );
        }
        (true, false) => {
            if slenderness.is_present() {
                slenderness.mistake("", "oscillators have no slenderness", "their abscissa is [strengths]");
            }
            Structures::Oscillators(oscillators::read(oscillator, strengths::read(strengths))?)
        }
        (false, true) => {
            if strengths.is_present() {
                strengths.mistake("", "blocks have no strength", "their abscissa is [slenderness], tan(alpha)");
            }
            Structures::Blocks(blocks::read(block, slenderness)?)
        }
    };
    let count = structures.lines().saturating_mul(structures.abscissa().len());
    if count > MOST_STRUCTURES {
        return root.refuse(
            "",
            format!("the lists and grids make {count} structures"),
            format!("take larger steps: at most {MOST_STRUCTURES}"),
        );
    }
    Some(structures)
}
