//! Hazard curves, uniform risk spectra and their fits (Figures 4.5, 4.6, 4.7, 4.11).

use super::{FigureSource, STRENGTH};
use uplift::UpliftError;
use uplift::hazard_curves::NamedCurve;
use uplift::result::StoredResult;
use uplift::text::per_cent;
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};
use uplift_regression::Exponential;

const RATE: &str = "mean annual frequency, 1/yr";

pub(super) fn hazard(source: &FigureSource) -> Result<Option<Figure>, UpliftError> {
    let stored = &source.stored;
    let mut panels = Vec::new();
    for measure in &stored.measures {
        let measure = measure.measure;
        let mut series = Vec::new();
        for site in source.sites() {
            let name = &stored.sites[site];
            let maf = source.reader.array_f64(&format!("/hazard/{name}/{}/maf_per_year", measure.key()))?;
            let im = source.reader.axis_f64(maf.dims.first().map_or("", String::as_str))?;
            series.push(Series::line(name, im.into_iter().zip(maf.values).collect(), Tone::Distinct(site)));
        }
        panels.push(Panel::lines(
            "",
            Axis::log(format!("{}, {}", measure.label(), measure.unit())),
            Axis::log(RATE),
            series,
        ));
    }
    let caption = "Mean annual frequency of exceeding a level of the intensity measure, as used (Fig. 4.5b, c).";
    Ok(Some(source.figure("hazard", "Hazard curves", caption, panels)))
}

/// Curves from files, a panel for each measure and unit.
pub fn hazard_figure(curves: &[NamedCurve]) -> Figure {
    let mut panels: Vec<Panel> = Vec::new();
    for (index, NamedCurve { name, curve }) in curves.iter().enumerate() {
        let label = format!("{}, {}", curve.measure(), curve.unit());
        let points = curve.points().map(|point| (point.im, point.maf)).collect();
        let series = Series::line(name, points, Tone::Distinct(index));
        match panels.iter_mut().find(|panel| panel.x.label == label) {
            Some(panel) => panel.series.push(series),
            None => panels.push(Panel::lines("", Axis::log(label), Axis::log(RATE), vec![series])),
        }
    }
    Figure {
        id: "hazard".to_owned(),
        title: "Hazard curves".to_owned(),
        caption: "Mean annual frequency of exceeding a level of the intensity measure.".to_owned(),
        remark: String::new(),
        columns: panels.len().min(2),
        panels,
    }
}

pub(super) fn spectra(source: &FigureSource) -> Vec<Figure> {
    let stored = &source.stored;
    stored
        .measures
        .iter()
        .map(|measure| {
            let label = measure.measure.label();
            let panels = source
                .sites()
                .map(|site| Panel::lines(
                    stored.sites[site].clone(),
                    Axis::linear(STRENGTH),
                    Axis::log("displacement, m"),
                    (0..stored.poes.len())
                        .map(|poe| {
                            let name = format!("{} in {} years", per_cent(stored.poes[poe]), stored.years);
                            source.over_strengths(name, stored.spectrum(&measure.spectra_m, site, poe), Tone::Distinct(poe))
                        })
                        .collect(),
                ))
                .collect();
            let caption = format!(
                "Displacement that a rocking structure of a given uplift strength exceeds with the stated probability, from stripes by {label} (Fig. 4.6, 4.7). Ordinates that are zero or censored are left out."
            );
            let id = format!("urs-{}", measure.measure.key());
            source.figure(id, format!("Uniform risk spectra by {label}"), caption, panels)
        })
        .collect()
}

pub(super) fn fits(source: &FigureSource) -> Result<Option<Figure>, UpliftError> {
    let stored = &source.stored;
    let result = StoredResult::read(&stored.path)?;
    let panels = source
        .sites()
        .map(|site| {
            let mut series = Vec::new();
            let own =
                result.spectra.iter().filter(|spectrum| spectrum.im == "PGV" && spectrum.site == stored.sites[site]);
            for (poe, spectrum) in own.enumerate() {
                let tone = Tone::Distinct(poe);
                let mut points = source.over_strengths("", &spectrum.u_m, tone);
                points.marks = Marks::Only;
                // every fourth point: the curve must be seen between them
                points.points = points.points.into_iter().step_by(4).collect();
                series.push(points);
                let fit = &spectrum.fit;
                if fit.c0_m.is_finite() {
                    let curve = Exponential { c0: fit.c0_m, c1: fit.c1, c2: fit.c2_m };
                    let fitted = stored.strengths.iter().filter(|&&strength| strength > 0.05);
                    let name = format!("fit, {} in {} years", per_cent(spectrum.poe), result.years);
                    series.push(Series::line(
                        name,
                        fitted.map(|&strength| (strength, curve.at(strength))).collect(),
                        tone,
                    ));
                }
            }
            Panel::lines(stored.sites[site].clone(), Axis::linear(STRENGTH), Axis::log("displacement, m"), series)
        })
        .collect::<Vec<_>>();
    if panels.iter().all(|panel| panel.series.is_empty()) {
        return Ok(None);
    }
    let caption = "Spectra by PGV (dots) and the exponential c0 exp(c1 strength) + c2 fitted to them (lines; Eq. 4.11, Fig. 4.11, Table 4.2).";
    Ok(Some(source.figure("fits", "Fitted spectra", caption, panels)))
}
