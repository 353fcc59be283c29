//! What the report shows of uniform risk spectra.

use super::{Content, Table};
use crate::figures::FigureSource;
use uplift::UpliftError;
use uplift::result::{MeasureBands, ResultFile, StoredBands, StoredSpectra};
use uplift::text::{metres, nearest, per_cent};

/// Strengths in the summary.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

pub(super) fn content(file: &ResultFile) -> Result<Content, UpliftError> {
    let source = FigureSource::read(file)?;
    let mut tables = vec![summary(&source.spectra), coefficients(&source.spectra)];
    tables.extend(source.bands.as_ref().map(|bands| confidence(&source.spectra, bands)));
    let stored = &source.stored;
    let mut facts = vec![("Seed", stored.seed.to_string())];
    if file.is_asked() {
        facts.push(("Probabilities", "asked for after the run, from the stripes of the result".to_owned()));
    }
    Ok(Content {
        subject: "Uniform risk spectra",
        extent: format!(
            "{} ground motions, {} uplift strengths, {} sites.",
            stored.records.len(),
            stored.strengths.len(),
            stored.sites.len()
        ),
        facts,
        tables,
        figures: source.figures()?,
    })
}

fn summary(stored: &StoredSpectra) -> Table {
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
                let u_m = measure.u_m.block([site, poe]);
                row.extend(shown.iter().map(|&strength| metres(u_m[strength])));
            }
            rows.push(row);
        }
    }
    Table {
        id: "summary".to_owned(),
        title: "Displacements to survive".to_owned(),
        note: format!(
            "Displacement in metres that is exceeded with the stated probability in {} years, for the uplift strength \
             f_up/(m g) after the dot.",
            stored.years
        ),
        header,
        text_columns: 2,
        rows,
    }
}

fn coefficients(spectra: &StoredSpectra) -> Table {
    let number =
        |value: f64, digits: usize| if value.is_nan() { "no fit".to_owned() } else { format!("{value:.digits$}") };
    let rows = spectra
        .rows()
        .map(|spectrum| {
            let fit = &spectrum.fit;
            vec![
                spectrum.site.to_owned(),
                spectrum.measure.label().to_owned(),
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
            "u = c0 exp(c1 strength) + c2 with c2 not negative, for strengths above 0.05 or as the study says; \
             probabilities in {} years.",
            spectra.years
        ),
        header: ["site", "measure", "probability", "c0, m", "c1", "c2, m", "RMSE, m"].map(str::to_owned).to_vec(),
        text_columns: 3,
        rows,
    }
}

fn confidence(stored: &StoredSpectra, bands: &StoredBands) -> Table {
    let number = |value: f64, digits: usize| if value.is_nan() { "-".to_owned() } else { format!("{value:.digits$}") };
    let rows = |of_measure: &MeasureBands| -> Vec<Vec<String>> {
        let row = |(at, error): ([usize; 3], &[f64])| {
            let [site, poe, size] = at;
            vec![
                stored.sites[site].clone(),
                of_measure.measure.label().to_owned(),
                per_cent(stored.poes[poe]),
                bands.sizes[size].to_string(),
                number(error[0], 1),
                number(of_measure.range_of_interval[at], 0),
            ]
        };
        of_measure.error_of_median.blocks().map(row).collect()
    };
    Table {
        id: "table-4-1".to_owned(),
        title: "How sure the spectra are (Table 4.1)".to_owned(),
        note: format!(
            "Error of the median and width of the {} interval over resampled records, at the strength where each is \
             largest (Eq. 4.9, 4.10).",
            per_cent(bands.confidence)
        ),
        header: ["site", "measure", "probability", "records", "e_median, %", "r, %"].map(str::to_owned).to_vec(),
        text_columns: 3,
        rows: bands.measures.iter().flat_map(rows).collect(),
    }
}
