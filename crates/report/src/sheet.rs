//! The design sheet: one page on one structure at one site, to hand over.
//!
//! It leads with verdict, demand and risk in a sentence each, of the structure itself first; then the structure to
//! scale, the numbers, and what they rest on. Style and policy are those of the report.

mod bands;
mod drawing;
mod lead;
mod numbers;

use std::path::Path;

use minijinja::{Value, context};
use uplift::UpliftError;
use uplift::alarms::Alarm;
use uplift::outputs::{self, Output, OutputKind};
use uplift::result::{ResultFile, write_atomically};
use uplift::structure::DesignReport;
use uplift::study::Structure;
use uplift::text::typed_path;

use crate::page::{STYLE, render};
pub(crate) use bands::bands;
use drawing::drawing;
pub(crate) use drawing::drawing as elevation;
use lead::lead;
pub(crate) use numbers::facts;
use numbers::{kind_name, rounding_words, tables};

const SHEET: &str = concat!(include_str!("page/table.html"), include_str!("sheet/sheet.html"));

/// Refuses a name that is none of a page, and one that would replace something else, before anything is computed.
///
/// # Errors
/// As [`outputs::check`].
pub fn check_design_sheet(file: &Path, result: &Path, inputs: &[&Path], force: bool) -> Result<(), UpliftError> {
    Ok(outputs::check(&[Output::new(file, OutputKind::Page).with_result(result)], inputs, force)?)
}

/// Writes the design of `structure` as one HTML page.
///
/// # Errors
/// A file that cannot be written.
pub fn write_design_sheet(structure: &Structure, report: &DesignReport, file: &Path) -> Result<(), UpliftError> {
    let rounding = rounding_words(report);
    let noted = report
        .structure
        .warnings
        .iter()
        .chain(&report.notes)
        .chain(&rounding)
        .map(|note| context! { severity => "note", what => note });
    let typed = typed_path(&report.source.result);
    let named = |alarm: &Alarm| Value::from_serialize(alarm.clone().naming(&typed));
    let alarms: Vec<Value> = report.alarms.iter().map(named).chain(noted).collect();
    let mark = ResultFile::open(&report.source.result)?.mark()?;
    let page = render(
        SHEET,
        context! {
            name => report.structure.name,
            kind => kind_name(&report.structure),
            lead => lead(report),
            alarms,
            drawing => drawing(&structure.description),
            facts => facts(structure, &report.structure),
            bands => bands(&report.finding(structure)?.rows),
            tables => tables(report),
            result => report.source.result.file_name().map(|name| name.to_string_lossy().into_owned()),
            record_set => report.source.record_set,
            style => STYLE,
            script => include_str!("page/report.js"),
            mark,
            version => uplift::VERSION,
            commit => uplift::COMMIT,
        },
    )?;
    Ok(write_atomically(file, page.as_bytes())?)
}
