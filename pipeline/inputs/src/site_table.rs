//! Many sites: a table of them, and the exports that hold their hazard curves.
//!
//! The exports are gone through twice: before the analyses to find each site and every mistake, and after them for the
//! curves, site by site, so that memory does not grow with the curves.

mod export;
mod places;

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use uplift_hazard::HazardCurve;
use uplift_motion::IntensityMeasure;
use uplift_risk::StripeWeights;

pub use self::export::SharedCurve;
use self::export::{Index, Read, Row, Stream, reason_of};
pub use self::places::ListedSite;
use super::curve_file::{by_the_records_definition, stripe_weights};
use crate::error::InputsError;
use uplift_job::JobError;
use uplift_job::checksum::checksum_of_file;
use uplift_job::text::thousands;
use uplift_study::{Branch, Repair, SiteTable, UniformRiskStudy, levels_place};

const SITES_NAMED: usize = 4;
/// How the table of sites is called among the inputs of a result.
const TABLE: &str = "site table";

/// The sites of a study's table, each with its place in the exports.
#[derive(Debug, Clone)]
pub struct SiteList {
    /// The sites in the order of the table, or of the first export where there is no table.
    pub sites: Vec<ListedSite>,
    /// Positions of those that are asked for: the whole table, or a slice of it.
    pub range: Range<usize>,
    /// Names of further columns of the table.
    pub carried: Vec<String>,
    /// The exports of the measures that the study is analysed by, in their order.
    pub exports: Vec<SiteExport>,
    /// Where the study repairs, those of other measures: what the records bring is held against them.
    pub compared: Vec<SiteExport>,
    /// Those of the weighted realizations of the analysed measures, all of one measure together.
    pub branches: Vec<BranchExport>,
    /// What to know: sites without spectra, what was taken for granted.
    pub notes: Vec<String>,
    /// Name to SHA-256 of each file read.
    pub checksums: BTreeMap<String, String>,
}

/// The export of one realization of a logic tree.
#[derive(Debug, Clone)]
pub struct BranchExport {
    /// Position of its measure among [`SiteList::exports`].
    pub of: usize,
    /// Its weight.
    pub weight: f64,
    /// The export.
    pub export: SiteExport,
}

/// The export with the hazard of one measure.
#[derive(Debug, Clone)]
pub struct SiteExport {
    /// The measure.
    pub measure: IntensityMeasure,
    path: PathBuf,
    checksum: String,
    /// Which curve of the export belongs to each site; none where no site of the export is near enough.
    items: Vec<Option<u32>>,
    within_km: f64,
}

impl SiteExport {
    /// A curve of the export in field units, cm/s or g, for the definition of the measure that the records are combined
    /// by.
    ///
    /// # Errors
    /// A curve of another definition without a conversion, for instance; as the reason for a table.
    pub fn curve(&self, study: &UniformRiskStudy, exported: &HazardCurve) -> Result<HazardCurve, String> {
        let curve = exported.in_field_units(study.gravity_m_s2).map_err(|error| reason_of(&error))?;
        Ok(by_the_records_definition(study, self.measure, &curve)?.unwrap_or(curve))
    }

    /// What each stripe of the study weighs at a site with this [`curve`](Self::curve).
    ///
    /// # Errors
    /// A curve that does not cover the levels, for instance; as the reason for a table.
    pub fn weights(&self, study: &UniformRiskStudy, curve: &HazardCurve) -> Result<StripeWeights, String> {
        let plan = study.measures.iter().find(|plan| plan.measure == self.measure);
        stripe_weights(study, plan.ok_or_else(|| "the measure is not one of the study's".to_owned())?, curve)
    }
}

/// Read the study's table of sites and find the sites in the exports; none where the study has no such table.
///
/// # Errors
/// Everything that is wrong with the files, at once; a measure that no site has a curve of that can be used.
pub fn read_site_list(study: &UniformRiskStudy) -> Result<Option<SiteList>, InputsError> {
    let Some(table) = &study.site_table else { return Ok(None) };
    let mut mistakes = Vec::new();
    let places = table.sites.as_deref().and_then(|path| noted(places::read(path), &mut mistakes));
    let mut found: Vec<(Read<'_>, &Path, Index)> = Vec::new();
    for read in to_be_read(study, table) {
        let Some(path) = table.export(read.measure()) else { continue };
        let with_names = table.sites.is_none() && found.is_empty();
        let index = noted(Index::read(study, read, path, with_names), &mut mistakes);
        found.extend(index.map(|index| (read, path, index)));
    }
    let (true, Some((_, _, first))) = (mistakes.is_empty(), found.first()) else {
        return Err(JobError::Inputs(mistakes).into());
    };
    let (sites, carried) = match places {
        Some(places) => (places.sites, places.carried),
        None => (first.sites(), Vec::new()),
    };
    let (notes, checksums) = (Vec::new(), site_table_checksums(study)?);
    let range = table.slice.map_or(0..sites.len(), |slice| slice.range(sites.len()));
    if table.slice.is_some_and(|slice| slice.count > sites.len()) {
        let most = count(sites.len());
        let words = format!("site_table.slice: the table has {most} sites: at most {most} slices");
        return Err(JobError::input(words).into());
    }
    let (exports, compared, branches) = (Vec::new(), Vec::new(), Vec::new());
    let mut list = SiteList { sites, range, carried, exports, compared, branches, notes, checksums };
    let (mut failures, mut useless) = (Vec::new(), Vec::new());
    for (number, (read, path, index)) in found.iter().enumerate() {
        let rows: Vec<Option<Row>> = if table.sites.is_none() && number == 0 {
            index.rows().iter().copied().map(Some).collect()
        } else {
            let near = |site: &ListedSite| {
                index.nearest(site.longitude_deg, site.latitude_deg, table.within_km).map(|(row, _)| *row)
            };
            list.sites.par_iter().map(near).collect()
        };
        let (measure, is_analysed) = (read.measure(), matches!(read, Read::Analysed(_)));
        let label = measure.label();
        // every analysis by such a measure would be for nothing
        if is_analysed && !rows.iter().flatten().any(|row| row.usable) {
            let section = levels_place(measure).0;
            useless.push(format!(
                "no site of the table has hazard of {label} that can be used: correct this, or leave out [{section}] \
                 and its export"
            ));
        }
        failures.extend(list.without_hazard(label, path, index, &rows, table.within_km));
        list.notes.extend(index.notes.iter().cloned());
        let checksum = list.checksums.get(&name_of_export(measure)).cloned().unwrap_or_default();
        let items = rows.iter().map(|row| row.map(|row| row.item)).collect();
        let path = (*path).to_owned();
        let export = SiteExport { measure, path, checksum, items, within_km: table.within_km };
        if is_analysed { list.exports.push(export) } else { list.compared.push(export) }
    }
    if !useless.is_empty() {
        return Err(JobError::Inputs([useless, failures].concat()).into());
    }
    list.notes.splice(0..0, failures);
    read_branches(study, table, &mut list)?;
    Ok(Some(list))
}

/// Finds the sites of `list` in the exports of the realizations.
fn read_branches(study: &UniformRiskStudy, table: &SiteTable, list: &mut SiteList) -> Result<(), InputsError> {
    let mut mistakes = Vec::new();
    for (of, plan) in study.measures.iter().filter(|plan| table.export(plan.measure).is_some()).enumerate() {
        let measure = plan.measure;
        for branch in table.exports_of(measure).into_iter().flat_map(|own| &own.branches) {
            let Some(index) = noted(Index::read(study, Read::Analysed(plan), &branch.file, false), &mut mistakes)
            else {
                continue;
            };
            let near = |site: &ListedSite| {
                let found = index.nearest(site.longitude_deg, site.latitude_deg, table.within_km);
                found.map(|(row, _)| row.item)
            };
            let items = list.sites.par_iter().map(near).collect();
            let checksum = list.checksums.get(&name_of_branch(measure, branch)).cloned().unwrap_or_default();
            let path = branch.file.clone();
            let export = SiteExport { measure, path, checksum, items, within_km: table.within_km };
            list.branches.push(BranchExport { of, weight: branch.weight, export });
        }
    }
    if mistakes.is_empty() { Ok(()) } else { Err(JobError::Inputs(mistakes).into()) }
}

/// Name to SHA-256 of each file of the study's table of sites that is read.
///
/// # Errors
/// A file that cannot be read.
pub fn site_table_checksums(study: &UniformRiskStudy) -> Result<BTreeMap<String, String>, InputsError> {
    let Some(table) = &study.site_table else { return Ok(BTreeMap::new()) };
    let exports = to_be_read(study, table).filter_map(|read| {
        let path = table.export(read.measure())?;
        Some((name_of_export(read.measure()), path))
    });
    let branches =
        study.measures.iter().filter_map(|plan| table.exports_of(plan.measure)).flat_map(|own| {
            own.branches.iter().map(|branch| (name_of_branch(own.measure, branch), branch.file.as_path()))
        });
    let sites = table.sites.as_deref().map(|path| (TABLE.to_owned(), path));
    exports.chain(branches).chain(sites).map(|(name, path)| Ok((name, summed(path)?))).collect()
}

/// How the export of a measure is called among the inputs of a result.
fn name_of_export(measure: IntensityMeasure) -> String {
    format!("{TABLE} {}", measure.label())
}

fn name_of_branch(measure: IntensityMeasure, branch: &Branch) -> String {
    format!("{} {}", name_of_export(measure), branch.name)
}

/// The exports that are wanted: those of measures that the study is analysed by come first.
fn to_be_read<'a>(study: &'a UniformRiskStudy, table: &'a SiteTable) -> impl Iterator<Item = Read<'a>> {
    let is_repaired = study.consistency.repair == Repair::Weights;
    let is_other = |measure: &IntensityMeasure| study.measures.iter().all(|plan| plan.measure != *measure);
    let others = table.exports.iter().map(|own| own.measure).filter(move |own| is_repaired && is_other(own));
    study.measures.iter().map(Read::Analysed).chain(others.map(Read::Compared))
}

fn noted<T>(read: Result<T, Vec<String>>, mistakes: &mut Vec<String>) -> Option<T> {
    read.map_err(|reasons| mistakes.extend(reasons)).ok()
}

fn summed(path: &Path) -> Result<String, InputsError> {
    Ok(checksum_of_file(path).map_err(|error| JobError::input(format!("{}: {error}", path.display())))?)
}

fn count(number: usize) -> String {
    thousands(number as u64)
}

impl SiteList {
    /// All exports of the mean hazard, first those that have spectra.
    pub fn all_exports(&self) -> impl Iterator<Item = &SiteExport> {
        self.exports.iter().chain(&self.compared)
    }

    /// Those, and after them those of the realizations.
    fn all_files(&self) -> impl Iterator<Item = &SiteExport> {
        self.all_exports().chain(self.branches.iter().map(|branch| &branch.export))
    }

    /// Refuses exports that are not any more what they were when the sites were found in them.
    ///
    /// # Errors
    /// [`JobError::Inputs`] with the first of them; an export that cannot be read.
    pub fn require_unchanged(&self) -> Result<(), InputsError> {
        for export in self.all_files() {
            if summed(&export.path)? != export.checksum {
                let name = export.path.display();
                let words = format!("{name}: was changed during the run: run the study again");
                return Err(JobError::input(words).into());
            }
        }
        Ok(())
    }

    /// The sites in words, for a line on the screen.
    pub fn description(&self) -> String {
        let exports = self.all_exports().map(|export| {
            let found = export.items.iter().flatten().count();
            format!("{} found in the export of {}", count(found), export.measure.label())
        });
        let slice = if self.range.len() < self.sites.len() {
            format!("{} of ", count(self.range.len()))
        } else {
            String::new()
        };
        format!("{slice}{}; {}", count(self.sites.len()), exports.collect::<Vec<_>>().join(", "))
    }

    /// What keeps sites from having spectra of a measure, counted, the first ones named.
    fn without_hazard(
        &self,
        label: &str,
        path: &Path,
        index: &Index,
        rows: &[Option<Row>],
        within_km: f64,
    ) -> Vec<String> {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let all = count(self.sites.len());
        let shown = |site: &ListedSite| {
            let name: String = site.name.chars().take(40).collect();
            format!("{} ({}, {})", name.escape_debug(), site.longitude_deg, site.latitude_deg)
        };
        let pairs = || self.sites.iter().zip(rows);
        let mut messages = Vec::new();
        let unknown = rows.iter().filter(|row| row.is_none()).count();
        if unknown > 0 {
            let examples = pairs().filter(|(_, row)| row.is_none()).take(SITES_NAMED).map(|(site, _)| {
                let far = index.nearest(site.longitude_deg, site.latitude_deg, f64::INFINITY);
                format!("{}{}", shown(site), far.map_or(String::new(), |(_, km)| format!(" is {km:.1} km away")))
            });
            let examples: Vec<String> = examples.collect();
            // latitude first is the slip to expect where nothing is found
            let swapped = |site: &ListedSite| {
                site.longitude_deg.abs() <= 90.0
                    && index.nearest(site.latitude_deg, site.longitude_deg, within_km).is_some()
            };
            let hint = if unknown == self.sites.len() && self.sites.iter().take(SITES_NAMED).any(swapped) {
                "; are longitude and latitude swapped?"
            } else {
                ""
            };
            messages.push(format!(
                "site table, {label}: {} of {all} sites have no site of {name} within {within_km} km: {}{}{hint}",
                count(unknown),
                examples.join("; "),
                if unknown > examples.len() { "; …" } else { "" },
            ));
        }
        let unusable =
            || pairs().filter_map(|(site, row)| row.as_ref().filter(|row| !row.usable).map(|row| (site, row)));
        let total = unusable().count();
        if total > 0 {
            let reason = |(site, row): (&ListedSite, &Row)| {
                let reason = index.reason(row).unwrap_or("see the tables");
                let (what, advice) = reason.split_once("; ").unwrap_or((reason, ""));
                (format!("{}: {what}", shown(site)), advice.to_owned())
            };
            let examples: Vec<(String, String)> = unusable().take(SITES_NAMED).map(reason).collect();
            // what to do is told once where it is the same at all
            let is_common = examples.iter().all(|(_, advice)| *advice == examples[0].1);
            let told = |parts: &[&str]| {
                let parts: Vec<&str> = parts.iter().copied().filter(|part| !part.is_empty()).collect();
                parts.join("; ")
            };
            let of = |(what, advice): &(String, String)| if is_common { what.clone() } else { told(&[what, advice]) };
            let sites: Vec<String> = examples.iter().map(of).collect();
            let sites = sites.join("; ");
            let rest = if total > examples.len() { "…" } else { "" };
            let advice = if is_common { &*examples[0].1 } else { "" };
            messages.push(format!(
                "site table, {label}: {} of {all} sites have no hazard curve that can be used: {}",
                count(total),
                told(&[&sites, rest, advice]),
            ));
        }
        messages
    }
}

/// A site with its hazard curve in each export.
pub struct BatchSite {
    /// Its position in the list.
    pub site: usize,
    /// The curve as exported, or why there is none, for each of [`SiteList::all_exports`], and after them for each of
    /// the [`SiteList::branches`].
    pub curves: Vec<SharedCurve>,
}

/// The hazard curves of a list of sites, in its order.
pub struct SiteCurves<'a> {
    list: &'a SiteList,
    streams: Vec<Stream>,
    left: Range<usize>,
}

impl<'a> SiteCurves<'a> {
    /// Opens the exports again for the sites at the positions of `range`.
    ///
    /// # Errors
    /// An export that cannot be read.
    pub fn open(list: &'a SiteList, range: Range<usize>) -> Result<Self, InputsError> {
        let stream =
            |export: &SiteExport| Stream::open(&export.path, export.items[range.clone()].iter().copied().flatten());
        let streams = list.all_files().map(stream).collect::<Result<_, _>>()?;
        Ok(Self { list, streams, left: range })
    }

    /// The next sites, at most so many; none at the end.
    ///
    /// # Errors
    /// An export that cannot be read any more.
    pub fn next_batch(&mut self, most: usize) -> Result<Vec<BatchSite>, InputsError> {
        let end = self.left.end.min(self.left.start + most);
        let batch = (self.left.start..end)
            .map(|site| {
                let curves = self.list.all_files().zip(&mut self.streams).map(|(export, stream)| {
                    match export.items.get(site).copied().flatten() {
                        Some(item) => stream.take(item),
                        None => {
                            Ok(SharedCurve::new(Err(format!("no site of the export within {} km", export.within_km))))
                        }
                    }
                });
                Ok(BatchSite { site, curves: curves.collect::<Result<_, _>>()? })
            })
            .collect::<Result<_, InputsError>>()?;
        self.left.start = end;
        Ok(batch)
    }
}
