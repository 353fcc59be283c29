//! What the report shows of uniform risk spectra.

use std::path::Path;

use super::{Content, Table};
use crate::figures::FigureSource;
use uplift::UpliftError;
use uplift::result::{StoredResult, StoredStripes, open_result};
use uplift::text::{metres, nearest, per_cent};

/// Strengths in the summary.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

pub(super) fn content(path: &Path) -> Result<Content, UpliftError> {
    let stored = StoredStripes::read(path)?;
    let result = StoredResult::read(path)?;
    let mut tables = vec![summary(&stored), coefficients(&result)];
    tables.extend(confidence(&stored)?);
    Ok(Content {
        subject: "Uniform risk spectra",
        extent: format!(
            "{} ground motions, {} uplift strengths, {} sites.",
            stored.records.len(),
            stored.strengths.len(),
            stored.sites.len()
        ),
        facts: vec![("Seed", stored.seed.to_string())],
        tables,
        figures: FigureSource::new(stored)?.figures()?,
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
