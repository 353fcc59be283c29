//! A study of displacement spectra, section by section.

use std::path::Path;

use uplift_motion::STANDARD_GRAVITY_M_S2;

use super::super::grid::{Grid, GridRule};
use super::super::paths::Folders;
use super::super::reader::{ABOVE_ZERO, Ledger, Rule, Section};
use super::super::resolve::output;
use super::super::warnings::of_gravity;
use super::lists::scaling;
use super::structures::{designed, structures};
use super::{DesignPlan, DisplacementStudy, sets};

/// Percentiles \[%\], unless a study says otherwise: the median, one standard deviation of a normal distribution, and that of Chapter 3.
const PERCENTILES: [&str; 4] = ["16", "50", "84", "90"];

const PERCENT: Rule = Rule { holds: |value| (0.0..=100.0).contains(&value), words: "from 0 to 100 (the median is 50)" };
const SAFETY: Rule = Rule { holds: |value| value >= 1.0, words: "1 or above" };
const NARROW: Rule = Rule { holds: |value| (0.0..=0.5).contains(&value), words: "from 0 to 0.5 (1 % is 0.01)" };
/// Most points of the sweep around a value.
const MOST_POINTS: u64 = 1001;

/// Reads the whole study; what is wrong goes into the ledger. None where something is.
pub(in super::super) fn study(
    mut root: Section<'_>,
    ledger: &Ledger,
    folders: &Folders,
    study_file: &Path,
) -> Option<DisplacementStudy> {
    let title = root.field("title").map_or(Some(String::new()), |field| field.text().map(str::to_owned));
    let gravity = root.number_or("gravity_m_s2", "m/s2", ABOVE_ZERO, STANDARD_GRAVITY_M_S2);
    let records = sets::records(root.section("records"), folders);
    let record_sets = sets::read(root.field("record_sets"));
    let scaling = scaling(root.section("scaling"));
    let percentiles = percentiles(root.section("spectrum"), ledger);
    let structures = structures(&mut root, ledger);
    let of_blocks = root.field("block").is_some() && root.field("oscillator").is_none();
    let design = design(root.section("design"), of_blocks, structures.as_ref());
    let manifest = records.as_ref().and_then(super::SetRecords::manifest);
    let output = output(root.section("output"), folders, study_file, manifest.into_iter().chain([study_file]));
    root.finish();
    let gravity_m_s2 = gravity?;
    Some(DisplacementStudy {
        title: title?,
        gravity_m_s2,
        records: records?,
        record_sets: record_sets?,
        scaling: scaling?,
        percentiles: percentiles?,
        structures: structures?,
        design: design?,
        output: output?,
        warnings: of_gravity(gravity_m_s2).into_iter().collect(),
    })
}

fn percentiles(mut section: Section<'_>, ledger: &Ledger) -> Option<Grid> {
    let rule = GridRule { unit: "%", each: PERCENT, least_count: 1 };
    let percentiles = Grid::of_key(&mut section, "percentiles", rule, &PERCENTILES, ledger);
    section.finish();
    percentiles
}

/// The design example; without the section there is none.
#[allow(clippy::option_option)] // wrong and absent are different things, and the ledger has the rest
fn design(
    mut section: Section<'_>,
    of_blocks: bool,
    structures: Option<&super::Structures>,
) -> Option<Option<DesignPlan>> {
    if !section.is_present() {
        return Some(None);
    }
    let designed = designed(&mut section, of_blocks, structures);
    let safety_factor = section.number_or("safety_factor", "", SAFETY, 2.5);
    let percentile = section.number_or("percentile", "%", PERCENT, 50.0);
    let noise_relative = section.number_or("noise_relative", "", NARROW, 0.01);
    let noise_points = section.field("noise_points").map_or(Some(21), |field| {
        let points = field.integer(1, MOST_POINTS)?;
        if points.is_multiple_of(2) {
            field.mistake(
                format!("{points} points have none in the middle"),
                format!("take an odd number, {}", points + 1),
            );
            return None;
        }
        usize::try_from(points).ok()
    });
    section.finish();
    Some(Some(DesignPlan {
        designed: designed?,
        safety_factor: safety_factor?,
        percentile: percentile?,
        noise_relative: noise_relative?,
        noise_points: noise_points?,
    }))
}
