//! How blocks and oscillators respond over normalised intensities.

use uplift::library::{FitReport, LevelReport, LibraryReport, MeasureReport, Normalised, SystemReport};
use uplift_fragility::LognormalFragility;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

use super::overturning::fitted;

/// Names of the figures.
pub(crate) const LIBRARY_FIGURES: [&str; 4] = ["block-pga", "block-pgv", "oscillator-pga", "oscillator-pgv"];
/// Columns of panels, and systems in a panel: of more, so many from the first to the last.
const MOST_COLUMNS: usize = 3;
const MOST_LINES: usize = 7;

/// A figure for each kind of system and intensity: under which share of the motions it overturns and rocks, and its
/// median response.
pub fn library_figures(report: &LibraryReport) -> Vec<Figure> {
    let mut figures = Vec::new();
    for kind in ["block", "oscillator"] {
        for measure in Normalised::ALL {
            let shown = |system: &&SystemReport| system.kind == kind && measure_report(system, measure).is_some();
            let systems: Vec<&SystemReport> = report.systems.iter().filter(shown).collect();
            if !systems.is_empty() {
                figures.push(figure(report, &systems, measure));
            }
        }
    }
    figures
}

fn measure_report(system: &SystemReport, measure: Normalised) -> Option<&MeasureReport> {
    system.measures.iter().find(|of| of.measure == measure)
}

fn figure(report: &LibraryReport, systems: &[&SystemReport], measure: Normalised) -> Figure {
    let mut columns: Vec<(String, Vec<&SystemReport>)> = Vec::new();
    for system in systems {
        let title = column_title(system);
        match columns.iter_mut().find(|(known, _)| *known == title) {
            Some((_, members)) => members.push(system),
            None => columns.push((title, vec![system])),
        }
    }
    let columns = spread(&columns, MOST_COLUMNS);
    let mut panels = Vec::new();
    for event in ["overturning", "rocking"] {
        // a block rocks above PGA = g tan α whatever it is: a step without fit says nothing
        let is_fitted = |system: &&SystemReport| fit(system, measure, event).is_some_and(|fit| fit.median.is_some());
        if systems.iter().any(is_fitted) {
            panels.extend(columns.iter().map(|column| panel(column, measure, Some(event))));
        }
    }
    panels.extend(columns.iter().map(|column| panel(column, measure, None)));
    let kind = systems.first().map_or("", |system| system.kind);
    let id = format!("{kind}-{}", measure.key());
    let title = format!("Rocking response of {kind}s over normalised {}", measure.key().to_uppercase());
    let caption = "Shares of the motions, counted (dots) and lognormal (lines), and the median response over all \
                   motions, which ends where half of them overturn.";
    let columns = if columns.len() == 1 { panels.len() } else { columns.len() };
    Figure { columns, ..Figure::new(id, title, caption, panels).with_remark(super::remark(report.synthetic)) }
}

/// What the systems of a column have in common.
fn column_title(system: &SystemReport) -> String {
    match (system.slenderness_rad, system.uplift_displacement_m, system.capacity_m) {
        (Some(slenderness_rad), ..) => format!("α = {slenderness_rad} rad, r = {:.3}", system.restitution),
        (_, Some(uplift_m), Some(capacity_m)) => format!("u_{{up}} = {uplift_m} m, u_{{cap}} = {capacity_m} m"),
        (_, uplift_m, _) => format!("u_{{up}} = {} m, constant force", uplift_m.unwrap_or_default()),
    }
}

fn line_name(system: &SystemReport) -> String {
    match (system.size_m, system.strength) {
        (Some(size_m), _) => format!("R = {size_m} m"),
        (_, strength) => format!("η = {}", strength.unwrap_or_default()),
    }
}

/// At most so many of `all`, evenly from the first to the last.
fn spread<T: Clone>(all: &[T], most: usize) -> Vec<T> {
    let count = all.len().min(most);
    (0..count).map(|place| all[place * (all.len() - 1) / count.saturating_sub(1).max(1)].clone()).collect()
}

/// The shares of an `event`, or the median response.
fn panel((title, systems): &(String, Vec<&SystemReport>), measure: Normalised, event: Option<&str>) -> Panel {
    let label = match systems.first() {
        Some(system) if system.kind == "oscillator" => measure.label().replace("g tan α", "η g"),
        _ => measure.label().to_owned(),
    };
    let y = match (event, systems.first().map_or("", |system| system.response)) {
        (Some(event), _) => {
            Axis::linear(if event == "rocking" { "share that rocks" } else { "share that overturns" }).between(0.0, 1.0)
        }
        (None, "theta/alpha") => Axis::linear("median of θ/α").between(0.0, 1.0),
        (None, "u/u_cap") => Axis::linear("median of u/u_{cap}").between(0.0, 1.0),
        (None, _) => Axis::linear("median of u, m"),
    };
    let series = spread(systems, MOST_LINES).into_iter().enumerate().flat_map(|(index, system)| {
        let tone = Tone::Distinct(index);
        match event {
            Some(event) => shares(system, measure, event, tone),
            None => vec![Series::line(line_name(system), points(system, measure, |level| level.percentiles[1]), tone)],
        }
    });
    Panel::lines(title.clone(), Axis::log(label), y, series.collect())
}

fn points(system: &SystemReport, measure: Normalised, value: impl Fn(&LevelReport) -> f64) -> Vec<(f64, f64)> {
    measure_report(system, measure).into_iter().flat_map(|of| &of.levels).map(|own| (own.level, value(own))).collect()
}

fn fit<'a>(system: &'a SystemReport, measure: Normalised, event: &str) -> Option<&'a FitReport> {
    measure_report(system, measure)?.fits.iter().find(|fit| fit.of == event)
}

/// Dots, and the line of the fit.
fn shares(system: &SystemReport, measure: Normalised, event: &str, tone: Tone) -> Vec<Series> {
    let count = |level: &LevelReport| if event == "rocking" { level.rocking } else { level.overturned };
    let points = points(system, measure, |level| f64::from(count(level)) / f64::from(level.motions));
    let ends = points.first().zip(points.last()).map(|(first, last)| (first.0, last.0));
    let parameters = fit(system, measure, event).and_then(|fit| Some((fit.median?, fit.dispersion?)));
    let curve = parameters.zip(ends).and_then(|((median, dispersion), (first, last))| {
        Some(fitted(&LognormalFragility::new(median, dispersion).ok()?, first, last))
    });
    // without a fit it is a name for the legend alone
    let line = Series::line(line_name(system), curve.unwrap_or_default(), tone);
    vec![Series::dots("", points, tone), line]
}
