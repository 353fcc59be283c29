//! The report: one HTML file that opens anywhere. It leads with the spectrum, its numbers and at most three warnings;
//! then confidence, sources of the risk, fitted curves, structures, and what reproduces it.
//!
//! Styles and scripts are inside the file and nothing is fetched; its own policy forbids it. The figures are those of
//! [`figures`](crate::figures), as SVG, with their values beside them for the script that reads them off.

mod consistency;
mod differences;
mod displacement;
pub(crate) mod displacements;
mod drawn;
mod risk;
mod shake_table;
mod structures;

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use minijinja::{Environment, Value, context};
use serde::Serialize;
use uplift::alarms::{Alarm, alarms};
use uplift::bootstrap::resampled;
use uplift::events::Events;
use uplift::export::calculator;
use uplift::outputs;
use uplift::result::{Head, Kind, ResultFile, at_target_risks};
use uplift::text::{Table, typed_path, visible};
use uplift::{JobError, UpliftError};
use uplift_plot::{Figure, html};

use crate::figures::{FigureSource, together};
use crate::report::ReportOptions;
use differences::{differences, names};
use drawn::DrawnFigure;
use structures::AskedStructure;

/// What every page begins with: its style, and how a table is written.
pub(crate) const STYLE: &str = include_str!("page/report.css");
const REPORT: &str = concat!(include_str!("page/table.html"), include_str!("page/report.html"));

/// A table and what is said of it; its headings have raised and lowered parts.
#[derive(Debug, Serialize)]
pub(crate) struct TitledTable {
    id: String,
    title: String,
    note: String,
    /// What stands above the headings of the numbers; empty for nothing.
    group: &'static str,
    #[serde(flatten)]
    table: Table,
}

/// What the page shows of one result.
#[derive(Serialize)]
struct Content {
    /// What the result is of, e.g. `Uniform risk spectra`.
    subject: &'static str,
    /// The sites or record sets that it is of, in a few words.
    place: String,
    /// What was shaken, but for its strength; none where it is in the facts.
    oscillator: Option<String>,
    /// The figure before all others.
    lead: Option<DrawnFigure>,
    /// The table beside it.
    summary: Option<TitledTable>,
    facts: Vec<(&'static str, String)>,
    parts: Vec<Part>,
    /// Its spectra, to be laid over those of others.
    #[serde(skip)]
    source: Option<FigureSource>,
}

/// Figures and tables that answer one question.
#[derive(Debug, Serialize)]
struct Part {
    /// Its name in links.
    key: &'static str,
    title: &'static str,
    /// A sentence below the title; empty for none.
    note: &'static str,
    figures: Vec<DrawnFigure>,
    /// Folded below them.
    tables: Vec<TitledTable>,
}

/// A result that was read.
struct Read {
    head: Head,
    alarms: Vec<Alarm>,
    /// Its name and digest, of which the page says to be made.
    mark: String,
    file: String,
    /// The file as a command names it.
    typed: String,
    content: Content,
    structures: Vec<AskedStructure>,
}

/// The page on the results of `options`, in their order, as HTML.
///
/// # Errors
/// A result that is missing, damaged or without sites; a page to embed that is not the calculator's.
pub fn page(options: &ReportOptions, events: &dyn Events) -> Result<String, UpliftError> {
    let (mut results, mut live) = (Vec::new(), None);
    for path in &options.results {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        let result = resampled(at_target_risks(ResultFile::open(path)?, &options.risk)?, events)?;
        if let Some(built) = &options.explore {
            let calculator = calculator(&result, built)?.replace('&', "&amp;").replace('"', "&quot;");
            live = Some(Value::from_safe_string(calculator));
        }
        results.push(read(path, &result)?);
    }
    let heads: Vec<&Head> = results.iter().map(|of| &of.head).collect();
    let titles: Vec<&str> = results.iter().map(Read::title).collect();
    let files: Vec<&str> = results.iter().map(|of| of.file.as_str()).collect();
    let differences = differences(&heads);
    let names = names(&differences, &titles, &files);
    let sources: Vec<(&str, &FigureSource)> = names
        .iter()
        .zip(&results)
        .filter_map(|(name, of)| Some((name.as_str(), of.content.source.as_ref()?)))
        .collect();
    let common = if sources.len() > 1 { together(&sources) } else { None };
    let common = common.map(|figure| DrawnFigure::new(&figure)).transpose()?;
    let mut heading = titles.iter().map(|&title| title.to_owned()).collect::<Vec<_>>();
    heading.dedup();
    let mut subjects: Vec<&str> = results.iter().map(|of| of.content.subject).collect();
    subjects.dedup();
    let subjects = subjects.join(", ");
    let several = results.len() > 1;
    let mut places: Vec<String> = results.iter().map(|of| of.content.place.clone()).collect();
    places.dedup();
    let place = Some(places.join("; ")).filter(|place| !heading.iter().any(|title| title.contains(place)));
    let marks: Vec<&str> = results.iter().map(|of| of.mark.as_str()).collect();
    let mark = format!("{}; {}", outputs::mark(), marks.join("; "));
    let sections = results.into_iter().zip(&names).enumerate().map(|(index, (result, name))| {
        let title = if several { name } else { result.title() };
        let Read { head, content, .. } = &result;
        let checksums = head.input_checksums.iter().map(|(name, sum)| format!("{sum}  {name}\n"));
        context! {
            key => format!("r{}", index + 1),
            title,
            file => result.typed,
            record_set => head.record_set,
            alarms => result.alarms,
            structures => result.structures,
            program => format!("uplift {} ({})", head.version, head.commit),
            created => head.created,
            command => head.command,
            study => STANDARD.encode(&head.study_toml),
            checksums => STANDARD.encode(checksums.collect::<String>()),
            ..Value::from_serialize(content)
        }
    });
    let sections: Vec<Value> = sections.collect();
    render(
        REPORT,
        context! {
            sections, subjects, heading, place, several, names, differences, common, live,
            style => STYLE,
            script => include_str!("page/report.js"),
            mark,
            version => uplift::VERSION,
            commit => uplift::COMMIT,
        },
    )
}

/// The page that `template` makes of `context`.
///
/// # Errors
/// None for the templates of this crate.
pub(crate) fn render(template: &'static str, context: Value) -> Result<String, UpliftError> {
    let mut templates = Environment::new();
    templates.add_filter("typeset", |text: &str| Value::from_safe_string(html(text)));
    Ok(templates
        .add_template("page.html", template)
        .and_then(|()| templates.get_template("page.html"))
        .and_then(|template| template.render(context))
        // what is no letter may be hidden in a text of the results, and is of no page
        .map(|page| visible(&page).into_owned())
        .map_err(|error| JobError::input(format!("cannot create the page: {error}")))?)
}

impl TitledTable {
    pub(crate) fn new(id: &str, title: impl Into<String>, note: impl Into<String>, table: impl Into<Table>) -> Self {
        Self { id: id.to_owned(), title: title.into(), note: note.into(), group: "", table: table.into() }
    }

    /// The same, unless there is nothing to show.
    pub(crate) fn unless_empty(self) -> Option<Self> {
        (!self.table.is_empty()).then_some(self)
    }
}

/// Every one of `figures`, drawn.
fn drawn(figures: impl IntoIterator<Item = Figure>) -> Result<Vec<DrawnFigure>, UpliftError> {
    figures.into_iter().map(|figure| DrawnFigure::new(&figure)).collect()
}

impl Read {
    /// The title of the study, or the name of the file where it has none.
    fn title(&self) -> &str {
        if self.head.title.is_empty() { &self.file } else { &self.head.title }
    }
}

fn read(path: &Path, result: &ResultFile) -> Result<Read, UpliftError> {
    let content = match result.kind() {
        Kind::UniformRisk => risk::content(result)?,
        Kind::Displacement => displacement::content(result)?,
        Kind::ShakeTable => shake_table::content(result)?,
    };
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let typed = typed_path(path);
    let alarms: Vec<Alarm> = alarms(result)?.into_iter().map(|alarm| alarm.naming(&typed)).collect();
    let structures = structures::structures(result, &alarms, &typed)?;
    Ok(Read { head: result.head()?, alarms, mark: result.name_and_digest()?, file, typed, content, structures })
}
