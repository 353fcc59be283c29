//! Hazard curves, uniform risk spectra and their fits (Figures 4.5, 4.6, 4.7, 4.11).

use super::{DISPLACEMENT, FigureSource, STRENGTH};
use uplift::hazard_curves::NamedCurve;
use uplift::result::{StoredHazard, StoredSpectra};
use uplift::text::{kind_of_risks, per_cent, risk_in_words, risk_name, spectrum_words};
use uplift_motion::IntensityMeasure;
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};

pub(super) const RATE: &str = "annual rate, 1/yr";
/// Weighted curves of a site that are drawn.
const MOST_BRANCHES: usize = 32;
/// What the caption says of them.
const BRANCHES: &str = " Thin: weighted curves of the site; thick: their mean.";
/// What the caption says of repaired spectra.
const THIN: &str = " Thin: repaired.";

pub(super) fn hazard(source: &FigureSource) -> Figure {
    let panel = |hazard: &StoredHazard| {
        let lines = |site: usize| {
            let curves = &hazard.sites[site];
            let branches = curves.branches.iter().take(MOST_BRANCHES).map(|branch| &branch.curve);
            std::iter::once(&curves.curve).chain(branches).enumerate().map(move |(place, curve)| {
                let points = curve.points().map(|point| (point.im, point.maf)).collect();
                let own = source.stored.sites[site].as_str();
                // a name in the legend is that of the site, once
                let (name, tone) = if place == 0 { (own, Tone::Distinct(site)) } else { ("", Tone::Thin(site)) };
                Series::line(name, points, tone)
            })
        };
        let label = format!("{}, {}", hazard.measure.label(), hazard.measure.unit());
        Panel::lines("", Axis::log(label), Axis::log(RATE), source.sites().flat_map(lines).collect())
    };
    let is_one_of_many = |hazard: &StoredHazard| hazard.sites.iter().any(|site| !site.branches.is_empty());
    let caption = format!(
        "Annual rate at which an intensity level is exceeded (Fig. 4.5b, c).{}",
        if source.hazard.iter().any(is_one_of_many) { BRANCHES } else { "" }
    );
    source.figure("hazard", "Hazard curves", caption, source.hazard.iter().map(panel).collect())
}

/// Curves from files, a panel for each measure and unit.
pub fn hazard_figure(curves: &[NamedCurve]) -> Figure {
    let mut panels: Vec<Panel> = Vec::new();
    for (index, NamedCurve { name, curve, .. }) in curves.iter().enumerate() {
        let label = format!("{}, {}", curve.measure(), curve.unit());
        let points = curve.points().map(|point| (point.im, point.maf)).collect();
        let series = Series::line(name, points, Tone::Distinct(index));
        match panels.iter_mut().find(|panel| panel.x.label == label) {
            Some(panel) => panel.series.push(series),
            None => panels.push(Panel::lines("", Axis::log(label), Axis::log(RATE), vec![series])),
        }
    }
    Figure::new("hazard", "Hazard curves", "Annual rate at which an intensity level is exceeded.", panels)
}

/// The rarest spectra of all sites by the first measure in one panel; none of a single site.
pub(super) fn sites(source: &FigureSource) -> Option<Figure> {
    let spectra = &source.spectra;
    let of_measure = spectra.measures.first().filter(|_| spectra.sites.len() > 1)?;
    let poe = source.rarest();
    let line = |site: usize| {
        source.over_strengths(&spectra.sites[site], of_measure.u_m.block([site, poe]), Tone::Distinct(site))
    };
    let series = source.sites().map(line).collect();
    let panel = Panel::lines("", Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), series);
    let [risk, label] = [risk_in_words(spectra.poes[poe], spectra.years), of_measure.measure.label().to_owned()];
    let title = format!("Uniform risk spectra of {risk}, by {label}");
    let caption = "Displacement of a rocking structure by uplift strength.";
    Some(source.figure("urs-sites", title, caption, vec![panel]))
}

pub(super) fn spectra(source: &FigureSource) -> Vec<Figure> {
    let spectra = &source.spectra;
    spectra
        .measures
        .iter()
        .zip(&source.band_of)
        .map(|(of_measure, band_of)| {
            let label = of_measure.measure.label();
            let panel = |site: usize| {
                let line = |(poe, probability): (usize, &f64)| {
                    let name = risk_name(*probability, spectra.years);
                    source.over_strengths(name, of_measure.u_m.block([site, poe]), Tone::Distinct(poe))
                };
                let mut series: Vec<Series> = spectra.poes.iter().enumerate().map(line).collect();
                series.extend(repaired(source, of_measure.measure, site));
                let title = spectra.sites[site].clone();
                let poes = 0..spectra.poes.len();
                let bands = poes
                    .filter_map(|poe| source.band_of_set(of_measure.measure, [site, poe], Tone::Distinct(poe)))
                    .collect();
                Panel { bands, ..Panel::lines(title, Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), series) }
            };
            let banded = source.bands.as_ref().and_then(|bands| Some((bands, bands.by_measure(of_measure.measure)?)));
            let banded = banded.map_or_else(String::new, |(bands, own)| {
                let confidence = per_cent(bands.confidence);
                let by = band_of.words();
                let size = bands.sizes[bands.place_of_set(source.stored.records.len())];
                if own.inferred.is_some() {
                    let records = source.stored.records.len();
                    let of = if usize::try_from(size) == Ok(records) { "from" } else { "as of sets of" };
                    format!(" Areas: {confidence} confidence bands{by}, {of} {size} records.")
                } else {
                    format!(" Areas: {confidence} of the spectra of {}, {size} records in each.", bands.drawn_words())
                }
            });
            let is_thin = |panel: &Panel| panel.series.iter().any(|line| matches!(line.tone, Tone::Thin(_)));
            let panels: Vec<Panel> = source.sites().map(panel).collect();
            let thin = if panels.iter().any(is_thin) { THIN } else { "" };
            let caption = format!("As Fig. 4.6 and 4.7{}.{banded}{thin}", kind(spectra));
            let id = format!("urs-{}", of_measure.measure.key());
            let title = format!("Uniform risk spectra by {label}");
            source.figure(id, title, caption, panels)
        })
        .collect()
}

/// What a caption says of the risks that a legend names.
fn kind(spectra: &StoredSpectra) -> String {
    kind_of_risks(&spectra.poes, spectra.years).map_or_else(String::new, |kind| format!("; {kind}"))
}

/// Spectra of weighted records at a site whose hazard the records do not have without weights.
fn repaired(source: &FigureSource, measure: IntensityMeasure, site: usize) -> Vec<Series> {
    let Some(u_m) = source.repaired(measure, site) else { return Vec::new() };
    let spectra = &source.spectra;
    let line = |(poe, &probability): (usize, &f64)| {
        let points = spectra.strengths.iter().copied().zip(u_m.block([site, poe]).iter().copied()).collect();
        Series::line(spectrum_words(&risk_name(probability, spectra.years), true), points, Tone::Thin(poe))
    };
    spectra.poes.iter().enumerate().map(line).collect()
}

pub(super) fn fits(source: &FigureSource) -> Option<Figure> {
    let spectra = &source.spectra;
    // PGV, as Table 4.2 is, where it is studied
    let by_first = spectra.measures.first()?;
    let panel = |site: usize| {
        let mut series = Vec::new();
        for (poe, &probability) in spectra.poes.iter().enumerate() {
            let tone = Tone::Distinct(poe);
            let mut points = source.over_strengths("spectrum", by_first.u_m.block([site, poe]), tone);
            points.marks = Marks::Only;
            // some seventy at most: the curve must be seen between them
            let step = points.points.len().div_ceil(76).max(1);
            points.points = points.points.into_iter().step_by(step).collect();
            series.push(points);
            if let Some(curve) = by_first.fits[[site, poe]].curve() {
                let fitted = spectra.strengths.iter().filter(|&&strength| strength > 0.05);
                let name = format!("fit, {}", risk_name(probability, spectra.years));
                let points = fitted.map(|&strength| (strength, curve.at(strength))).collect();
                series.push(Series::line(name, points, tone));
            }
        }
        let title = spectra.sites[site].clone();
        Panel::lines(title, Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), series)
    };
    let caption = format!(
        "Spectra by {} (dots) and their fits u = c_{{0}} exp(c_{{1}} η) + c_{{2}} (lines; Eq. 4.11, Fig. 4.11){}.",
        by_first.measure.label(),
        kind(spectra)
    );
    Some(source.figure("fits", "Fitted spectra", caption, source.sites().map(panel).collect()))
}
