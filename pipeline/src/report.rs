//! The report: one HTML file that opens anywhere, with every figure, the tables and where the numbers come from.
//!
//! Styles and scripts are inside the file and nothing is fetched; its own policy forbids it. The figures are those of [`figures`](crate::figures), as SVG,
//! with their values beside them for the script that reads them off.

use std::collections::BTreeMap;
use std::path::Path;

use minijinja::{Environment, context};
use serde::Serialize;

use crate::error::UpliftError;
use crate::figures::FigureSource;
use crate::plot::{Figure, Marks, PanelPlace, Width, svg};
use crate::result::{StoredResult, StoredStripes, open_result};
use crate::table::{metres, nearest, per_cent};

/// Strengths in the summary.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

/// What the page shows of one result.
#[derive(Debug, Serialize)]
struct Section {
    key: String,
    title: String,
    file: String,
    record_set: String,
    synthetic: bool,
    records: usize,
    strengths: usize,
    sites: usize,
    facts: Vec<(&'static str, String)>,
    warnings: Vec<String>,
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

/// The page on the results at `paths`, in their order.
///
/// # Errors
/// A result that is missing, damaged or without sites.
pub fn report(paths: &[impl AsRef<Path>]) -> Result<String, UpliftError> {
    let sections = paths
        .iter()
        .enumerate()
        .map(|(index, path)| section(&format!("r{}", index + 1), path.as_ref()))
        .collect::<Result<Vec<_>, _>>()?;
    let mut templates = Environment::new();
    templates
        .add_template("report.html", include_str!("report/report.html"))
        .and_then(|()| templates.get_template("report.html"))
        .and_then(|template| {
            template.render(context! {
                sections,
                style => include_str!("report/report.css"),
                script => include_str!("report/report.js"),
                version => crate::VERSION,
                commit => crate::COMMIT,
            })
        })
        .map_err(|error| UpliftError::input(format!("the report cannot be made: {error}")))
}

fn section(key: &str, path: &Path) -> Result<Section, UpliftError> {
    let stored = StoredStripes::read(path)?;
    let result = StoredResult::read(path)?;
    let reader = open_result(path)?;
    let text = |name: &str| reader.attribute_text("/", name);
    let title = text("title")?;
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let warnings = text("warnings")?.lines().map(str::to_owned).collect();
    let checksums = serde_json::from_str(&text("input_checksums")?).unwrap_or_default();
    let facts = vec![
        ("Result", file.clone()),
        ("Records", stored.record_set.clone()),
        ("Program", format!("uplift {} ({})", text("version")?, text("commit")?)),
        ("Made", text("created")?),
        ("Command", text("command")?),
        ("Seed", stored.seed.to_string()),
    ];
    let synthetic = reader.attribute_i64("/", "synthetic")? == 1;
    let mut tables = vec![summary(&stored)];
    tables.push(coefficients(&result));
    tables.extend(confidence(&stored)?);
    for table in &mut tables {
        table.id = format!("{key}-{}", table.id);
    }
    let (records, strengths, sites) = (stored.records.len(), stored.strengths.len(), stored.sites.len());
    let record_set = stored.record_set.clone();
    let figures = FigureSource::new(stored)?.figures()?;
    let figures = figures.iter().map(|figure| drawn(key, figure)).collect::<Result<Vec<_>, _>>()?;
    Ok(Section {
        key: key.to_owned(),
        title: if title.is_empty() { file.clone() } else { title },
        file,
        record_set,
        synthetic,
        records,
        strengths,
        sites,
        facts,
        warnings,
        tables,
        figures,
        study_toml: text("study_toml")?,
        checksums,
    })
}

fn summary(stored: &StoredStripes) -> Table {
    let shown = nearest(&stored.strengths, &SHOWN_STRENGTHS);
    let mut header: Vec<String> = ["site", "measure"].map(str::to_owned).to_vec();
    for &probability in &stored.poes {
        header.extend(
            shown.iter().map(|&strength| format!("{} · {:.2}", per_cent(probability), stored.strengths[strength])),
        );
    }
    let mut rows = Vec::new();
    for (site, name) in stored.sites.iter().enumerate() {
        for measure in &stored.measures {
            let mut row = vec![name.clone(), measure.measure.label().to_owned()];
            for poe in 0..stored.poes.len() {
                row.extend(
                    shown.iter().map(|&strength| metres(measure.spectra_m[stored.ordinate(site, poe, strength)])),
                );
            }
            rows.push(row);
        }
    }
    Table {
        id: "summary".to_owned(),
        title: "Displacements to survive".to_owned(),
        note: format!(
            "Displacement in metres that is exceeded with the stated probability in {} years, for the uplift strength f_up/(m g) after the dot.",
            stored.years
        ),
        header,
        text_columns: 2,
        rows,
    }
}

fn coefficients(result: &StoredResult) -> Table {
    let number =
        |value: f64, digits: usize| if value.is_nan() { "no fit".to_owned() } else { format!("{value:.digits$}") };
    let rows = result
        .spectra
        .iter()
        .map(|spectrum| {
            let fit = &spectrum.fit;
            vec![
                spectrum.site.clone(),
                spectrum.im.clone(),
                per_cent(spectrum.poe),
                number(fit.c0_m, 4),
                number(fit.c1, 4),
                number(fit.c2_m, 4),
                number(fit.rmse_m, 4),
            ]
        })
        .collect();
    Table {
        id: "table-4-2".to_owned(),
        title: "Coefficients (Table 4.2)".to_owned(),
        note: format!(
            "u = c0 exp(c1 strength) + c2 with c2 not negative, for strengths above 0.05 or as the study says; probabilities in {} years.",
            result.years
        ),
        header: ["site", "measure", "probability", "c0, m", "c1", "c2, m", "RMSE, m"].map(str::to_owned).to_vec(),
        text_columns: 3,
        rows,
    }
}

fn confidence(stored: &StoredStripes) -> Result<Option<Table>, UpliftError> {
    let reader = open_result(&stored.path)?;
    if !reader.exists("/bootstrap") {
        return Ok(None);
    }
    let sizes = reader.axis_u32("sample_size")?;
    let confidence = reader.attribute_f64("/bootstrap", "confidence")?;
    let mut rows = Vec::new();
    for measure in &stored.measures {
        let group = format!("/bootstrap/{}", measure.measure.key());
        if !reader.exists(&group) {
            continue;
        }
        let errors = reader.array_f64(&format!("{group}/e_median"))?.values;
        let ranges = reader.array_f64(&format!("{group}/r_90ci"))?.values;
        if errors.len() != stored.sites.len() * stored.poes.len() * sizes.len() {
            return Err(UpliftError::input(format!(
                "{}: {group} is damaged: run the bootstrap again",
                stored.path.display()
            )));
        }
        for (cell, (error, range)) in errors.iter().zip(&ranges).enumerate() {
            let spectrum = cell / sizes.len();
            let number =
                |value: f64, digits: usize| if value.is_nan() { "-".to_owned() } else { format!("{value:.digits$}") };
            rows.push(vec![
                stored.sites[spectrum / stored.poes.len()].clone(),
                measure.measure.label().to_owned(),
                per_cent(stored.poes[spectrum % stored.poes.len()]),
                sizes[cell % sizes.len()].to_string(),
                number(*error, 1),
                number(*range, 0),
            ]);
        }
    }
    Ok(Some(Table {
        id: "table-4-1".to_owned(),
        title: "How sure the spectra are (Table 4.1)".to_owned(),
        note: format!(
            "Error of the median and width of the {} interval over resampled records, at the strength where each is largest (Eq. 4.9, 4.10).",
            per_cent(confidence)
        ),
        header: ["site", "measure", "probability", "records", "e_median, %", "r, %"].map(str::to_owned).to_vec(),
        text_columns: 3,
        rows,
    }))
}

fn drawn(key: &str, figure: &Figure) -> Result<DrawnFigure, UpliftError> {
    let drawing = svg(figure, Width::Double).map_err(|error| UpliftError::input(format!("{}: {error}", figure.id)))?;
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
