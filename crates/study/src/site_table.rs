//! The section `[site_table]`: many sites, their hazard in the exports of an engine.

use std::path::{Path, PathBuf};

use uplift_motion::IntensityMeasure;

use super::grid::{Grid, GridRule};
use super::measures::MEASURES;
use super::paths::Folders;
use super::reader::{ABOVE_ZERO, Field, Section, ZERO_OR_MORE, optional, quantity};
use super::resolved::ResolvedStudy;

/// Farthest distance between a site and the site of an export that is taken for it, unless a study says otherwise \[km\].
const WITHIN_KM: f64 = 1.0;

/// Many sites with the exports that hold their hazard curves.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteTable {
    /// Table of the sites, absolute; if none, the sites are those of the first export.
    pub sites: Option<PathBuf>,
    /// An engine's export of hazard curves for each measure that has one, in the order of the measures.
    pub exports: Vec<(IntensityMeasure, PathBuf)>,
    /// Farthest distance between a site and the site of an export that is taken for it \[km\].
    pub within_km: f64,
    /// Strengths whose ordinates are written, all of them strengths of the study; if none, all into tables and a few into the map.
    pub strengths: Option<Grid>,
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

/// Reads the section; each of its strengths must be one of `strengths`, and one of `measures` must have an export.
#[allow(clippy::option_option)] // wrong and absent are different things, and the ledger has the rest
pub(super) fn read(
    field: Option<&Field<'_>>,
    measures: &[IntensityMeasure],
    strengths: Option<&Grid>,
    folders: &Folders,
) -> Option<Option<SiteTable>> {
    optional(field, |field| section(field.section(), measures, strengths, folders))
}

fn section(
    mut section: Section<'_>,
    measures: &[IntensityMeasure],
    known: Option<&Grid>,
    folders: &Folders,
) -> Option<SiteTable> {
    if !section.is_present() {
        return None;
    }
    let sites_field = section.field("sites");
    let sites = optional(sites_field.as_ref(), |field| folders.input(field));
    let mut exports = Some(Vec::new());
    let mut of_the_study = false;
    for keys in &MEASURES {
        let Some(field) = section.field(keys.section) else { continue };
        of_the_study |= measures.contains(&keys.measure);
        match (&mut exports, folders.input(&field)) {
            (Some(exports), Some(path)) => exports.push((keys.measure, path)),
            _ => exports = None,
        }
    }
    if !of_the_study && !measures.is_empty() {
        let keys: Vec<&str> =
            MEASURES.iter().filter(|keys| measures.contains(&keys.measure)).map(|keys| keys.section).collect();
        section.mistake(
            "",
            "the site table has no hazard curves of a measure that the study switches on",
            format!("add {} = \"path of an engine's export of mean hazard curves\"", keys.join(" or ")),
        );
        exports = None;
    }
    let within_km = section.number_or("within_km", "km", ABOVE_ZERO, WITHIN_KM);
    let strengths_field = section.field("strengths");
    let strengths = optional(strengths_field.as_ref(), |field| strengths_of(field, known));
    section.finish();
    Some(SiteTable { sites: sites?, exports: exports?, within_km: within_km?, strengths: strengths? })
}

/// A grid of strengths that are all `known`; where the study's own are wrong, only the notation is checked.
fn strengths_of(field: &Field<'_>, known: Option<&Grid>) -> Option<Grid> {
    let grid = Grid::read(field, GridRule { unit: "", each: ZERO_OR_MORE, least_count: 1 })?;
    let Some(known) = known else { return Some(grid) };
    let Some(&missing) = grid.iter().find(|&&strength| !known.contains(&strength)) else { return Some(grid) };
    let nearest = known.iter().min_by(|a, b| (*a - missing).abs().total_cmp(&(*b - missing).abs())).copied();
    field.mistake(
        format!("{} is not among the strengths of the study", quantity(missing, "")),
        format!("the nearest one of strengths.values is {}", quantity(nearest.unwrap_or_default(), "")),
    );
    None
}

/// The section as a study file has it.
#[derive(serde::Serialize)]
pub(super) struct SiteTableForm<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    sites: Option<&'a Path>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pgv: Option<&'a Path>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pga: Option<&'a Path>,
    within_km: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    strengths: Option<&'a Grid>,
}

impl<'a> SiteTableForm<'a> {
    pub(super) fn of(study: &'a ResolvedStudy) -> Option<Self> {
        let table = study.site_table.as_ref()?;
        Some(Self {
            sites: table.sites.as_deref(),
            pgv: table.export(IntensityMeasure::Pgv),
            pga: table.export(IntensityMeasure::Pga),
            within_km: table.within_km,
            strengths: table.strengths.as_ref(),
        })
    }
}
