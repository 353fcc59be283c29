//! The section `[site_table]`: many sites, their hazard in the exports of an engine.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::{Serialize, Serializer};
use serde_json::json;
use uplift_motion::IntensityMeasure;
use uplift_plausible::DISTANCE;

use super::branches::{self, Branch};
use super::{curve, measures};
use crate::grid::{Grid, GridRule};
use crate::keys::{Boolean, File, Key, Number, SectionKeys, Special, Text, boolean, file, grid, number, special, text};
use crate::reading::{Field, Paths, Rule, Section, Value, optional, quantity};
use crate::sections::strengths;

pub(super) const KEYS: SectionKeys =
    SectionKeys::new("site_table", &[&SITES, &EXPORT, &WITHIN_KM, &STRENGTHS, &BANDS, &SLICE]);
const SITES: Key<File> = file("sites")
    .without_default("every site of the first export")
    .meaning(
        "table of the sites (CSV): columns longitude and latitude in degrees, a name if there is one; other columns \
         are carried into the results",
    )
    .note("existing file");
const EXPORT: Key<Special> = special("pgv", || json!({ "type": ["string", "object"] }))
    .also(&["pga", "sa_1s"])
    .without_default("one of a measure that is switched on is needed")
    .meaning(
        "export of mean hazard curves of a measure, named by its key: OpenQuake's CSV, NRML or the JSON of the USGS, \
         PGV in cm/s and PGA in g as they write them; a repair (`consistency.repair`) uses the curves of a second \
         measure even if the study is not analysed by it. Or a table: `file`, and `branches` as a site's, an export a \
         realization",
    )
    .note("existing file, or a table");
const WITHIN_KM: Key<Number> = number("within_km", "km", Rule::Within(DISTANCE))
    .with_default(1.0)
    .meaning("largest distance from a site to the nearest site of the export, whose curve it gets; km");
const STRENGTHS: Key<GridRule> = grid("strengths", strengths::RULE)
    .without_default("all in the table; on the map those nearest to 0.1, 0.2 and 0.4")
    .meaning("strengths whose ordinates are written, a grid")
    .note("each one of `strengths.values`");
const BANDS: Key<Boolean> = boolean("bands")
    .with_default(false)
    .meaning("whether each ordinate that is written has its 90 % band; at 20 strengths some nine times the time");
const SLICE: Key<Text> = text("slice")
    .without_default("the whole table")
    .meaning("one part of the table: `3/1000` is the third of a thousand; `uplift run --sites 3/1000` sets it");

/// Most slices of a table.
const MOST_SLICES: usize = 1_000_000;

/// One of several parts of a table of sites, each of neighbours in it: for one machine of many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SiteSlice {
    /// Which, from 1.
    pub number: usize,
    /// Of how many.
    pub count: usize,
}

impl SiteSlice {
    /// Positions of its sites in a table of so many.
    pub fn range(self, sites: usize) -> Range<usize> {
        // a table of sites is in memory: its length times a million is far from the end of 128 bits
        let end = |number: usize| (sites as u128 * number as u128 / self.count as u128) as usize;
        end(self.number - 1)..end(self.number)
    }
}

impl FromStr for SiteSlice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').map(|(number, count)| [number, count].map(|part| part.trim().parse()));
        match numbers {
            Some([Ok(number), Ok(count)]) if (1..=count).contains(&number) && count <= MOST_SLICES => {
                Ok(Self { number, count })
            }
            _ => Err(format!("write 3/1000 for the third of a thousand slices; at most {MOST_SLICES}")),
        }
    }
}

impl fmt::Display for SiteSlice {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(text, "{}/{}", self.number, self.count)
    }
}

/// Many sites with the exports that hold their hazard curves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SiteTable {
    /// Table of the sites, absolute; if none, the sites are those of the first export.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sites: Option<PathBuf>,
    /// An engine's export of hazard curves for each measure that has one, in the order of the measures.
    #[serde(flatten, serialize_with = "write_exports")]
    pub exports: Vec<ExportFiles>,
    /// Farthest distance between a site and the site of an export that is taken for it \[km\].
    pub within_km: f64,
    /// Strengths whose ordinates are written, all of them strengths of the study; if none, all into tables and a few
    /// into the map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strengths: Option<Grid>,
    /// Whether each ordinate that is written has its 90 % band.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub bands: bool,
    /// The part of the table that is computed; if none, the whole.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "write_slice")]
    pub slice: Option<SiteSlice>,
}

/// The exports of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportFiles {
    /// The measure.
    pub measure: IntensityMeasure,
    /// That of the mean hazard, absolute.
    pub file: PathBuf,
    /// Epistemic uncertainty: an export of each realization; none, or two and more whose weights add up to 1.
    pub branches: Vec<Branch>,
}

impl ExportFiles {
    /// Every file that is read.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        std::iter::once(&self.file).chain(self.branches.iter().map(|own| &own.file)).map(PathBuf::as_path)
    }
}

impl SiteTable {
    /// The exports of `measure`.
    pub fn exports_of(&self, measure: IntensityMeasure) -> Option<&ExportFiles> {
        self.exports.iter().find(|own| own.measure == measure)
    }

    /// The export of the mean hazard of `measure`.
    pub fn export(&self, measure: IntensityMeasure) -> Option<&Path> {
        self.exports_of(measure).map(|own| own.file.as_path())
    }

    /// Every file that is read.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        self.sites.iter().map(PathBuf::as_path).chain(self.exports.iter().flat_map(ExportFiles::files))
    }
}

#[allow(clippy::ref_option)] // as serde calls it
fn write_slice<S: Serializer>(slice: &Option<SiteSlice>, serializer: S) -> Result<S::Ok, S::Error> {
    slice.map(|slice| slice.to_string()).serialize(serializer)
}

/// The exports of a measure as they stand in a study.
#[derive(Serialize)]
#[serde(untagged)]
enum Written<'a> {
    Mean(&'a Path),
    Weighted { file: &'a Path, branches: &'a [Branch] },
}

fn write_exports<S: Serializer>(exports: &[ExportFiles], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(exports.iter().map(|ExportFiles { measure, file, branches }| {
        let written = if branches.is_empty() { Written::Mean(file) } else { Written::Weighted { file, branches } };
        (measure.key(), written)
    }))
}

/// Reads the section; each of its strengths must be one of `strengths`, and one of `measures` must have an export.
#[allow(clippy::option_option)] // wrong and absent are different things, and what is wrong is among the findings
pub(super) fn read(
    field: Option<&Field<'_>>,
    measures: &[IntensityMeasure],
    strengths: Option<&Grid>,
    paths: &Paths,
) -> Option<Option<SiteTable>> {
    optional(field, |field| section(field.section(), measures, strengths, paths))
}

fn section(
    mut section: Section<'_>,
    studied: &[IntensityMeasure],
    known: Option<&Grid>,
    paths: &Paths,
) -> Option<SiteTable> {
    if !section.is_present() {
        return None;
    }
    let sites_field = section.given(&SITES);
    let sites = optional(sites_field.as_ref(), |field| paths.input(field));
    let mut exports = Some(Vec::new());
    let mut of_the_study = false;
    for measure in measures::named(&section) {
        let Some(field) = section.field(measure.key()) else { continue };
        if !measure.can_be_scaled_to() {
            field.mistake(measures::cannot_be_scaled_to(measure), "leave the export out");
            exports = None;
            continue;
        }
        of_the_study |= studied.contains(&measure);
        match (&mut exports, export(&field, measure, studied, paths)) {
            (Some(exports), Some(export)) => exports.push(export),
            _ => exports = None,
        }
    }
    let has_exports = exports.as_ref().is_none_or(|exports| !exports.is_empty());
    if let Some(slice) = section.given(&SLICE).filter(|_| !has_exports && !of_the_study) {
        slice.mistake("the study has no table of sites to slice", "add [site_table], or leave --sites out");
        exports = None;
    } else if !of_the_study && !studied.is_empty() {
        let keys: Vec<&str> = studied.iter().map(|measure| measure.key()).collect();
        section.mistake(
            "",
            "the site table has no hazard curves of a measure that the study switches on",
            format!("add {} = \"path of an engine's export of mean hazard curves\"", keys.join(" or ")),
        );
        exports = None;
    }
    let within_km = section.read(&WITHIN_KM);
    let strengths_field = section.given(&STRENGTHS);
    let strengths = optional(strengths_field.as_ref(), |field| strengths_of(field, known));
    let bands = section.read(&BANDS);
    let slice_field = section.given(&SLICE);
    let slice = optional(slice_field.as_ref(), slice_of);
    section.finish();
    Some(SiteTable {
        sites: sites?,
        exports: exports?,
        within_km: within_km?,
        strengths: strengths?,
        bands: bands?,
        slice: slice?,
    })
}

/// An export: a path, or a table with those of the realizations.
fn export(
    field: &Field<'_>,
    measure: IntensityMeasure,
    studied: &[IntensityMeasure],
    paths: &Paths,
) -> Option<ExportFiles> {
    let Value::Table(_) = field.node.value else {
        return Some(ExportFiles { measure, file: paths.input(field)?, branches: Vec::new() });
    };
    let mut section = field.section();
    let file = section.needed(&curve::FILE, "there is no export of the mean hazard", "add file = \"path\"");
    let file = file.and_then(|field| paths.input(&field));
    let branches = section.given(&curve::BRANCHES).map_or(Some(Vec::new()), |field| branches::read(&field, &[], paths));
    if branches.as_ref().is_some_and(|own| !own.is_empty()) && !studied.is_empty() && !studied.contains(&measure) {
        let what = format!("the study has no spectra by {}", measure.label());
        section.mistake(
            curve::BRANCHES.name,
            what,
            format!("leave them out, or add a section [{}]", measures::section_of(measure)),
        );
    }
    section.finish();
    Some(ExportFiles { measure, file: file?, branches: branches? })
}

fn slice_of(field: &Field<'_>) -> Option<SiteSlice> {
    let text = SLICE.read(field)?;
    text.parse().map_err(|help: String| field.mistake(format!("{text:?} is not a slice of a table"), help)).ok()
}

/// A grid of strengths that are all `known`; where the study's own are wrong, only the notation is checked.
fn strengths_of(field: &Field<'_>, known: Option<&Grid>) -> Option<Grid> {
    let grid = STRENGTHS.read(field)?;
    let Some(known) = known else { return Some(grid) };
    let Some(&missing) = grid.iter().find(|&&strength| !known.contains(&strength)) else { return Some(grid) };
    let nearest = known.iter().min_by(|a, b| (*a - missing).abs().total_cmp(&(*b - missing).abs())).copied();
    field.refuse(
        format!("{} is not among the strengths of the study", quantity(missing, "")),
        format!("the nearest one of strengths.values is {}", quantity(nearest.unwrap_or_default(), "")),
    )
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn slices_are_read_and_written_alike() {
        for text in ["1/1", "3/1000", "1000/1000"] {
            assert_eq!(text.parse::<SiteSlice>().unwrap().to_string(), text);
        }
        assert_eq!(" 3 / 8".parse(), Ok(SiteSlice { number: 3, count: 8 }));
        for text in ["", "3", "0/3", "4/3", "1/0", "a/b", "1/2/3", "1/1000001", "-1/2"] {
            assert!(text.parse::<SiteSlice>().is_err(), "{text}");
        }
    }

    proptest! {
        #[test]
        fn slices_hold_every_site_once_and_almost_as_many_each(sites in 0..5000_usize, count in 1..300_usize) {
            let ranges: Vec<Range<usize>> =
                (1..=count).map(|number| SiteSlice { number, count }.range(sites)).collect();
            prop_assert_eq!(ranges[0].start, 0);
            prop_assert_eq!(ranges[count - 1].end, sites);
            prop_assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start));
            let lengths = ranges.iter().map(ExactSizeIterator::len);
            prop_assert!(lengths.clone().max().unwrap() - lengths.min().unwrap() <= 1);
        }
    }
}
