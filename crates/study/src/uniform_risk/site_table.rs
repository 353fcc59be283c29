//! The section `[site_table]`: many sites, their hazard in the exports of an engine.

use std::path::{Path, PathBuf};

use serde::{Serialize, Serializer};
use uplift_motion::IntensityMeasure;
use uplift_plausible::DISTANCE;

use super::measures;
use crate::grid::{Grid, GridRule};
use crate::keys::{Boolean, File, Key, Number, SectionKeys, boolean, file, grid, number};
use crate::reading::{Field, Paths, Rule, Section, optional, quantity};
use crate::sections::strengths;

pub(super) const KEYS: SectionKeys = SectionKeys::new("site_table", &[&SITES, &EXPORT, &WITHIN_KM, &STRENGTHS, &BANDS]);
const SITES: Key<File> = file("sites")
    .without_default("every site of the first export")
    .meaning(
        "table of the sites (CSV): columns longitude and latitude in degrees, a name if there is one; other columns \
         are carried into the results",
    )
    .note("existing file");
const EXPORT: Key<File> = file("pgv")
    .also(&["pga", "sa_1s"])
    .without_default("one of a measure that is switched on is needed")
    .meaning(
        "export of mean hazard curves of any measure, by its name: OpenQuake's CSV, NRML or the JSON of the USGS, PGV \
         in cm/s and PGA in g as they write them; a repair (`consistency.repair`) holds what the records bring against \
         that of another measure, switched on or not",
    )
    .note("existing file");
const WITHIN_KM: Key<Number> = number("within_km", "km", Rule::Within(DISTANCE))
    .with_default(1.0)
    .meaning("farthest distance between a site and the site of the export that is taken for it, the nearest; km");
const STRENGTHS: Key<GridRule> = grid("strengths", strengths::RULE)
    .without_default("all in the table; on the map those nearest to 0.1, 0.2 and 0.4")
    .meaning("strengths whose ordinates are written, a grid")
    .note("each one of `strengths.values`");
const BANDS: Key<Boolean> = boolean("bands")
    .with_default(false)
    .meaning("whether each ordinate that is written has its 90 % band; at 20 strengths some five times the time");

/// Many sites with the exports that hold their hazard curves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SiteTable {
    /// Table of the sites, absolute; if none, the sites are those of the first export.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sites: Option<PathBuf>,
    /// An engine's export of hazard curves for each measure that has one, in the order of the measures.
    #[serde(flatten, serialize_with = "write_exports")]
    pub exports: Vec<(IntensityMeasure, PathBuf)>,
    /// Farthest distance between a site and the site of an export that is taken for it \[km\].
    pub within_km: f64,
    /// Strengths whose ordinates are written, all of them strengths of the study; if none, all into tables and a few
    /// into the map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strengths: Option<Grid>,
    /// Whether each ordinate that is written has its 90 % band.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub bands: bool,
}

impl SiteTable {
    /// The export of `measure`.
    pub fn export(&self, measure: IntensityMeasure) -> Option<&Path> {
        self.exports.iter().find_map(|(known, path)| (*known == measure).then_some(path.as_path()))
    }

    /// Every file that is read.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        self.sites.iter().chain(self.exports.iter().map(|(_, path)| path)).map(PathBuf::as_path)
    }
}

fn write_exports<S: Serializer>(exports: &[(IntensityMeasure, PathBuf)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(exports.iter().map(|(measure, path)| (measure.key(), path)))
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
        match (&mut exports, paths.input(&field)) {
            (Some(exports), Some(path)) => exports.push((measure, path)),
            _ => exports = None,
        }
    }
    if !of_the_study && !studied.is_empty() {
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
    section.finish();
    Some(SiteTable { sites: sites?, exports: exports?, within_km: within_km?, strengths: strengths?, bands: bands? })
}

/// A grid of strengths that are all `known`; where the study's own are wrong, only the notation is checked.
fn strengths_of(field: &Field<'_>, known: Option<&Grid>) -> Option<Grid> {
    let grid = STRENGTHS.read(field)?;
    let Some(known) = known else { return Some(grid) };
    let Some(&missing) = grid.iter().find(|&&strength| !known.contains(&strength)) else { return Some(grid) };
    let nearest = known.iter().min_by(|a, b| (*a - missing).abs().total_cmp(&(*b - missing).abs())).copied();
    field.mistake(
        format!("{} is not among the strengths of the study", quantity(missing, "")),
        format!("the nearest one of strengths.values is {}", quantity(nearest.unwrap_or_default(), "")),
    );
    None
}
