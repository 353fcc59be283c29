//! The section `[design]`: the design example, if asked for.

use serde::Serialize;
use uplift_plausible::{LENGTH, SAFETY_FACTOR};
use uplift_spectra::{NoiseSweep, SpectraError};

use super::blocks::HEIGHT;
use super::spectrum::PERCENT;
use super::structures::Structures;
use crate::keys::{Integer, Key, Number, SectionKeys, integer, number};
use crate::reading::{Rule, Section, quantity};

pub(super) const KEYS: SectionKeys = SectionKeys::new(
    "design",
    &[&WIDTH_M, &HEIGHT_M, &BLOCK_HEIGHT_M, &ENDLESS_HEIGHT_M, &SAFETY, &PERCENTILE, &NOISE_RELATIVE, &NOISE_POINTS],
);
const WIDTH_M: Key<Number> = number("width_m", "m", Rule::Within(LENGTH))
    .with_default(1.6)
    .meaning("oscillators: width 2b of the columns, m")
    .note("above the smallest uplift displacement and below the height");
const HEIGHT_M: Key<Number> =
    number("height_m", "m", Rule::Within(LENGTH)).with_default(9.6).meaning("oscillators: height 2h of the columns, m");
const BLOCK_HEIGHT_M: Key<Number> =
    number("height_m", "m", HEIGHT).with_default(10.0).meaning("blocks: height 2H of the block, m");
const ENDLESS_HEIGHT_M: Key<Number> = number("endless_height_m", "m", HEIGHT)
    .with_default(1000.0)
    .meaning("blocks: height that stands for an endless one, m");
const SAFETY: Key<Number> =
    number("safety_factor", "", Rule::Within(SAFETY_FACTOR)).with_default(2.5).meaning("safety factor FS");
const PERCENTILE: Key<Number> =
    number("percentile", "%", PERCENT).with_default(50.0).meaning("percentile of the displacements that counts, %");
const NOISE_RELATIVE: Key<Number> =
    number("noise_relative", "", NARROW).with_default(0.01).meaning("width of the sweep around each value, relative");
const NOISE_POINTS: Key<Integer> =
    integer("noise_points", 1, MOST_POINTS).with_default(21).meaning("points in the sweep; 1: no sweep").note("odd");

const NARROW: Rule = Rule::From(0.0, 0.5, "from 0 to 0.5 (1 % is 0.01)");
/// Most points of the sweep around a value.
const MOST_POINTS: u64 = 1001;

/// A design example (Section 2.4.3 or 3.4.5).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignPlan {
    /// What is designed.
    #[serde(flatten)]
    pub designed: Designed,
    /// Safety factor FS \[-\].
    pub safety_factor: f64,
    /// Percentile of the displacements that counts \[%\].
    pub percentile: f64,
    /// Width of the sweep around each value that shows its noise, relative to the abscissa \[-\].
    pub noise_relative: f64,
    /// Points of that sweep, an odd number.
    pub noise_points: usize,
}

impl DesignPlan {
    /// The sweep around each value.
    ///
    /// # Errors
    /// None for a study that was loaded: its width and points were checked.
    pub fn noise(&self) -> Result<NoiseSweep, SpectraError> {
        NoiseSweep::new(self.noise_relative, self.noise_points)
    }
}

/// What is designed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Designed {
    /// The capacity of a restrained bridge; its strength is that of its columns, tan(2b/2h) as Section 3.5 writes it.
    Bridge {
        /// Width of a column 2b, the capacity without restraint \[m\].
        width_m: f64,
        /// Height of a column 2h \[m\].
        height_m: f64,
    },
    /// The slenderness of a block.
    Block {
        /// Its height 2H \[m\].
        height_m: f64,
        /// Height that stands for an endless one \[m\].
        endless_height_m: f64,
    },
}

/// The design example; without the section there is none.
#[allow(clippy::option_option)] // wrong and absent are different things, and what is wrong is among the findings
pub(super) fn read(
    mut section: Section<'_>,
    of_blocks: bool,
    structures: Option<&Structures>,
) -> Option<Option<DesignPlan>> {
    if !section.is_present() {
        return Some(None);
    }
    let designed = designed(&mut section, of_blocks, structures);
    let safety_factor = section.read(&SAFETY);
    let percentile = section.read(&PERCENTILE);
    let noise_relative = section.read(&NOISE_RELATIVE);
    let noise_points = section.read(&NOISE_POINTS).filter(|points| {
        if points.is_multiple_of(2)
            && let Some(field) = section.given(&NOISE_POINTS)
        {
            field.mistake(
                format!("{points} points have none in the middle"),
                format!("take an odd number, {}", points + 1),
            );
        }
        !points.is_multiple_of(2)
    });
    let noise_points = noise_points.and_then(|points| usize::try_from(points).ok());
    section.finish();
    Some(Some(DesignPlan {
        designed: designed?,
        safety_factor: safety_factor?,
        percentile: percentile?,
        noise_relative: noise_relative?,
        noise_points: noise_points?,
    }))
}

/// What the section designs: the columns of Section 3.4.5 and the block of Section 2.4.3 unless it says otherwise.
fn designed(section: &mut Section<'_>, of_blocks: bool, structures: Option<&Structures>) -> Option<Designed> {
    if of_blocks {
        let height = section.read(&BLOCK_HEIGHT_M);
        let endless = section.read(&ENDLESS_HEIGHT_M);
        return Some(Designed::Block { height_m: height?, endless_height_m: endless? });
    }
    let width = section.read(&WIDTH_M);
    let height = section.read(&HEIGHT_M);
    let (width_m, height_m) = (width?, height?);
    if width_m >= height_m {
        return section.refuse(
            WIDTH_M.name,
            format!("a column {} wide and {} high does not rock", quantity(width_m, "m"), quantity(height_m, "m")),
            "give a column that is higher than wide: its strength is tan(width/height)",
        );
    }
    if let Some(Structures::Oscillators(family)) = structures
        && width_m <= family.uplift_displacement_m[0]
    {
        return section.refuse(
            WIDTH_M.name,
            format!(
                "a column of width {}, its capacity, is not above the uplift displacement {}",
                quantity(width_m, "m"),
                quantity(family.uplift_displacement_m[0], "m")
            ),
            "the width of a column is about a metre",
        );
    }
    Some(Designed::Bridge { width_m, height_m })
}
