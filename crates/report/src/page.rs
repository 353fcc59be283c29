//! The report: one HTML file that opens anywhere, with every figure, the tables and where the numbers come from.
//!
//! Styles and scripts are inside the file and nothing is fetched; its own policy forbids it. The figures are those of
//! [`figures`](crate::figures), as SVG, with their values beside them for the script that reads them off.

mod displacement;
mod risk;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use minijinja::{Environment, context};
use serde::Serialize;

use crate::files::drawing_of;
use uplift::UpliftError;
use uplift::alarms::{Alarm, alarms};
use uplift::events::Events;
use uplift::outputs::mark;
use uplift::result::{AskedRisk, Kind, ResultFile};
use uplift::text::visible;
use uplift_plot::{Figure, Marks, PanelPlace, Width};

/// What the page shows of one result.
#[derive(Debug, Serialize)]
struct Section {
    key: String,
    title: String,
    subject: &'static str,
    extent: String,
    file: String,
    record_set: String,
    synthetic: bool,
    facts: Vec<(&'static str, String)>,
    alarms: Vec<Alarm>,
    tables: Vec<Table>,
    figures: Vec<DrawnFigure>,
    study_toml: String,
    checksums: BTreeMap<String, String>,
}

/// A table; all columns but the first `text_columns` hold numbers.
#[derive(Debug, Serialize)]
struct Table {
    id: String,
    title: String,
    note: String,
    header: Vec<String>,
    text_columns: usize,
    rows: Vec<Vec<String>>,
}

/// A figure with the values that can be read off it.
#[derive(Debug, Serialize)]
struct DrawnFigure {
    id: String,
    title: String,
    caption: String,
    svg: String,
    panels: Vec<ReadablePanel>,
}

/// A panel whose values can be read off.
#[derive(Debug, Serialize)]
struct ReadablePanel {
    place: PanelPlace,
    title: String,
    x: String,
    y: String,
    lines: Vec<ReadableLine>,
}

/// A line whose values can be read off.
#[derive(Debug, Serialize)]
struct ReadableLine {
    name: String,
    points: Vec<(f64, f64)>,
}

/// The page on the results at `paths`, in their order and at the risks `asked` for, as HTML.
///
/// # Errors
/// A result that is missing, damaged or without sites.
pub fn page(paths: &[PathBuf], asked: &AskedRisk, events: &dyn Events) -> Result<String, UpliftError> {
    let mut sections = Vec::new();
    for (index, path) in paths.iter().enumerate() {
        if events.cancelled() {
            return Err(UpliftError::Interrupted);
        }
        let result = ResultFile::open(path)?.at(asked)?.resampled(events)?;
        sections.push(section(&format!("r{}", index + 1), path, &result)?);
    }
    let mut subjects: Vec<&str> = sections.iter().map(|section| section.subject).collect();
    subjects.dedup();
    let subjects = subjects.join(", ");
    let mut templates = Environment::new();
    templates
        .add_template("report.html", include_str!("page/report.html"))
        .and_then(|()| templates.get_template("report.html"))
        .and_then(|template| {
            template.render(context! {
                sections,
                subjects,
                style => include_str!("page/report.css"),
                script => include_str!("page/report.js"),
                mark => mark(paths.first().map(PathBuf::as_path)),
                version => uplift::VERSION,
                commit => uplift::COMMIT,
            })
        })
        // what is no letter may be hidden in a text of the results, and is of no page
        .map(|page| visible(&page).into_owned())
        .map_err(|error| UpliftError::input(format!("the report cannot be made: {error}")))
}

/// What differs between the kinds of results.
struct Content {
    /// What the result is of, e.g. `Uniform risk spectra`.
    subject: &'static str,
    /// How much it is of, a sentence.
    extent: String,
    facts: Vec<(&'static str, String)>,
    tables: Vec<Table>,
    figures: Vec<Figure>,
}

fn section(key: &str, path: &Path, result: &ResultFile) -> Result<Section, UpliftError> {
    let head = result.head()?;
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let content = match result.kind() {
        Kind::UniformRisk => risk::content(result)?,
        Kind::Displacement => displacement::content(result)?,
    };
    let mut facts = vec![
        ("Result", file.clone()),
        ("Records", head.record_set.clone()),
        ("Program", format!("uplift {} ({})", head.version, head.commit)),
        ("Made", head.created),
        ("Command", head.command),
    ];
    facts.extend(content.facts);
    let mut tables = content.tables;
    for table in &mut tables {
        table.id = format!("{key}-{}", table.id);
    }
    let figures = content.figures.iter().map(|figure| drawn(key, figure)).collect::<Result<Vec<_>, _>>()?;
    Ok(Section {
        key: key.to_owned(),
        title: if head.title.is_empty() { file.clone() } else { head.title },
        subject: content.subject,
        extent: content.extent,
        file,
        record_set: head.record_set,
        synthetic: head.synthetic,
        facts,
        alarms: alarms(&result)?,
        tables,
        figures,
        study_toml: head.study_toml,
        checksums: head.input_checksums,
    })
}

fn drawn(key: &str, figure: &Figure) -> Result<DrawnFigure, UpliftError> {
    let drawing = drawing_of(figure, Width::Double)?;
    let panels = figure
        .panels
        .iter()
        .zip(drawing.places)
        .map(|(panel, place)| ReadablePanel {
            place,
            title: panel.title.clone(),
            x: panel.x.label.clone(),
            y: panel.y.label.clone(),
            lines: panel
                .series
                .iter()
                .filter(|series| !series.name.is_empty() && series.marks == Marks::None && series.points.len() > 2)
                .map(|series| ReadableLine {
                    name: series.name.clone(),
                    points: series
                        .points
                        .iter()
                        .filter(|point| point.0.is_finite() && point.1.is_finite())
                        .map(|&(x, y)| (short(x), short(y)))
                        .collect(),
                })
                .collect(),
        })
        .collect();
    Ok(DrawnFigure {
        id: format!("{key}-{}", figure.id),
        title: figure.title.clone(),
        caption: figure.caption.clone(),
        svg: drawing.svg,
        panels,
    })
}

/// A number to the five digits that a reader takes off a curve.
fn short(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
