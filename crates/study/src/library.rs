//! The file of a library of rocking response: blocks and oscillators, records, and the levels that they are scaled to.

use std::path::{Path, PathBuf};

use uplift_plausible::SIZE;

use crate::displacement::{
    OSCILLATOR_KEYS, OscillatorFamily, RECORDS_KEYS, SetRecords, check_stiffness, read_oscillators, read_records,
};
use crate::error::StudyError;
use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys, grid};
use crate::reading::other_file::Wanted;
use crate::reading::{Paths, Rule, Section, ZERO_TO_ONE};
use crate::sections::{record_source, selection, top};
use crate::study::Study;

/// Every key.
pub(crate) const KEYS: [SectionKeys; 8] = [
    SectionKeys::new("", &[&top::TITLE, &top::GRAVITY]),
    RECORDS_KEYS,
    selection::KEYS,
    record_source::SYNTHETIC_KEYS,
    SectionKeys::new("block", &[&SIZE_M, &SLENDERNESS_RAD, &RESTITUTION]),
    OSCILLATOR_KEYS,
    SectionKeys::new("strengths", &[&STRENGTHS]),
    SectionKeys::new("levels", &[&PGA, &PGV]),
];

const SIZE_M: Key<GridRule> = grid("size_m", GridRule { unit: "m", each: Rule::Within(SIZE), least_count: 1 })
    .with_default(&["1", "2.5", "5", "10"])
    .meaning("size parameters R, half the diagonal, a grid, m");
const SLENDERNESS_RAD: Key<GridRule> =
    grid("slenderness_rad", GridRule { unit: "rad", each: SLENDERNESS, least_count: 1 })
        .with_default(&["0.1", "0.2", "0.3"])
        .meaning("slendernesses α, a grid, rad");
const SLENDERNESS: Rule =
    Rule::From(1e-5, 0.95, "from 1e-5 to 0.95 rad; a stockier block does not rock (Eq. 2.3 is negative)");
const RESTITUTION: Key<GridRule> = grid("restitution", GridRule { unit: "", each: ZERO_TO_ONE, least_count: 1 })
    .without_default("that of the angular momentum, `1 - 1.5 sin²α` (Eq. 2.3)")
    .meaning("angular velocity after an impact divided by the one before, a grid");
const STRENGTHS: Key<GridRule> = grid("values", GridRule { unit: "", each: STRENGTH, least_count: 1 })
    .with_default(&["0.05", "0.1", "0.2", "0.4"])
    .meaning("uplift strengths η = f_up/(m g) of the oscillators, a grid");
const STRENGTH: Rule = Rule::From(1e-4, 100.0, "from 0.0001 to 100; levels are multiples of it");
const PGA: Key<GridRule> = grid("pga", LEVELS)
    .with_default(&["0.5", "0.99", "1.01", "1.25:0.25:3", "3.5:0.5:6", "7:1:12"])
    .meaning("levels of PGA/(g tan α) of a block, PGA/(η g) of an oscillator, a grid");
const PGV: Key<GridRule> = grid("pgv", LEVELS)
    .with_default(&["0.05", "0.1:0.1:1", "1.2:0.2:3"])
    .meaning("levels of p PGV over the same acceleration, a grid");
const LEVELS: GridRule = GridRule { unit: "", each: LEVEL, least_count: 1 };
const LEVEL: Rule = Rule::From(1e-4, 1e4, "from 1e-4 to 10000; a ratio, not a PGA or PGV itself");

/// Most systems; more is a slip of a step.
const MOST_SYSTEMS: usize = 100_000;

/// What to do about a tag.
const NO_SETS: &str = "make a manifest of these records alone: `uplift records select`";

/// A library of rocking response with every default filled in, every path found and every unit checked.
#[derive(Debug, Clone, PartialEq)]
pub struct LibraryStudy {
    /// The file it was read from.
    pub file: PathBuf,
    /// Free text.
    pub title: String,
    /// Acceleration of gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// The ground motions; every component is a motion of its own.
    pub records: SetRecords,
    /// Rigid blocks.
    pub blocks: Option<BlockGrid>,
    /// Oscillators.
    pub oscillators: Option<OscillatorFamily>,
    /// Levels of the PGA of a motion over the ground acceleration at uplift, g tan α or η g.
    pub pga_levels: Grid,
    /// Levels of p PGV over the same acceleration.
    pub pgv_levels: Grid,
}

/// Blocks of every size, slenderness and restitution of these.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockGrid {
    /// Size parameters R \[m\].
    pub size_m: Grid,
    /// Slendernesses α \[rad\].
    pub slenderness_rad: Grid,
    /// Coefficients of restitution; that of the angular momentum (Eq. 2.3) if none.
    pub restitution: Option<Grid>,
}

impl LibraryStudy {
    /// Reads the file `file`, of `-` standard input, applies the `overrides`, each `key=value`, and checks it all.
    ///
    /// # Errors
    /// [`StudyError`] with every mistake in the file and the overrides; those of TOML syntax come alone.
    pub fn load(file: &Path, overrides: &[String]) -> Result<Self, StudyError> {
        let study = Study::read_or_input(file, Wanted::Library)?.resolve_by(overrides, read)?;
        Ok(Self { file: file.to_owned(), ..study })
    }

    /// The files that it names to be read.
    pub fn inputs(&self) -> Vec<&Path> {
        std::iter::once(self.file.as_path()).chain(self.records.manifest()).collect()
    }
}

/// Reads the whole file; none where something is wrong.
pub(crate) fn read(mut root: Section<'_>, paths: &Paths) -> Option<LibraryStudy> {
    let title = root.read(&top::TITLE);
    let gravity = root.read(&top::GRAVITY);
    let records = read_records(root.section("records"), paths, NO_SETS);
    if records.as_ref().is_some_and(|records| records.vertical) {
        root.mistake(
            "records.vertical",
            "a library scales its records until blocks overturn, and so the ground would fall faster than gravity",
            "leave it out",
        );
    }
    let (block, oscillator) = (root.section("block"), root.section("oscillator"));
    let mut strengths = root.section("strengths");
    let (has_blocks, has_oscillators) = (block.is_present(), oscillator.is_present());
    if !(has_blocks || has_oscillators) {
        let help = "add a section [block] or [oscillator], or both; they may be empty";
        root.mistake("", "the library has nothing to shake", help);
    }
    if strengths.is_present() && !has_oscillators {
        strengths.mistake("", "only oscillators have strengths", "add a section [oscillator], or leave this one out");
    }
    let values = strengths.read(&STRENGTHS);
    strengths.finish();
    let blocks = if has_blocks { blocks(block).map(Some) } else { Some(None) };
    let oscillators = if has_oscillators { read_oscillators(oscillator, values).map(Some) } else { Some(None) };
    if let (Some(Some(family)), Some(gravity)) = (&oscillators, gravity) {
        check_stiffness(&root, family, gravity);
    }
    let mut levels = root.section("levels");
    let (pga_levels, pgv_levels) = (levels.read(&PGA), levels.read(&PGV));
    levels.finish();
    let count = |blocks: &BlockGrid| {
        let restitutions = blocks.restitution.as_ref().map_or(1, |grid| grid.len());
        blocks.size_m.len() * blocks.slenderness_rad.len() * restitutions
    };
    let of_oscillators = |family: &OscillatorFamily| {
        family.uplift_displacement_m.len() * family.capacity_m.len() * family.strengths.len()
    };
    let systems = blocks.iter().flatten().map(count).sum::<usize>()
        + oscillators.iter().flatten().map(of_oscillators).sum::<usize>();
    if systems > MOST_SYSTEMS {
        let help = format!("take larger steps: at most {MOST_SYSTEMS}");
        root.mistake("", format!("the grids make {systems} blocks and oscillators"), help);
    }
    root.finish();
    Some(LibraryStudy {
        file: PathBuf::new(),
        title: title?,
        gravity_m_s2: gravity?,
        records: records?,
        blocks: blocks?,
        oscillators: oscillators?,
        pga_levels: pga_levels?,
        pgv_levels: pgv_levels?,
    })
}

fn blocks(mut section: Section<'_>) -> Option<BlockGrid> {
    let (size, slenderness) = (section.read(&SIZE_M), section.read(&SLENDERNESS_RAD));
    let restitution = section.optional(&RESTITUTION);
    section.finish();
    Some(BlockGrid { size_m: size?, slenderness_rad: slenderness?, restitution: restitution? })
}
