//! Demands, fragilities and risk of one oscillator (Figures A2.13, A2.14, 4.3, 4.4).

use uplift_fragility::{exceedance_probabilities, quantile, weighted_quantile};
use uplift_risk::{RiskCurve, ThresholdGrid};

use super::spectra::RATE;
use super::{DISPLACEMENT, FigureSource, STRENGTH};
use uplift::text::{nearest, risk_in_words};
use uplift::{JobError, UpliftError};
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

/// Strength of the oscillator shown.
const SHOWN_STRENGTH: f64 = 0.2;
/// Displacements whose fragilities are shown, m.
const THRESHOLDS_M: [f64; 4] = [0.01, 0.05, 0.2, 0.5];
/// Rates whose contours of the risk surface are shown, 1/yr, and their names.
const RATES_PER_YEAR: [f64; 4] = [1e-4, 1e-3, 1e-2, 1e-1];
const RATE_NAMES: [&str; 4] = ["10^{−4} per year", "10^{−3} per year", "10^{−2} per year", "10^{−1} per year"];
/// Strengths whose risk curves are shown.
const RISK_STRENGTHS: [f64; 4] = [0.05, 0.1, 0.2, 0.4];

impl FigureSource {
    /// Position of the strength of the oscillator shown.
    fn shown_strength(&self) -> usize {
        nearest(&self.stored.strengths, &[SHOWN_STRENGTH]).first().copied().unwrap_or_default()
    }

    /// The strength at an index, for the title of a panel.
    fn strength_words(&self, index: usize) -> String {
        format!("strength η = {:.3}", self.stored.strengths[index])
    }

    pub(crate) fn fail(&self, error: &dyn std::fmt::Display) -> UpliftError {
        JobError::input(format!("{}: {error}", self.stored.path.display())).into()
    }
}

pub(super) fn ida_curves(source: &FigureSource) -> Result<Figure, UpliftError> {
    let stored = &source.stored;
    let strength = source.shown_strength();
    let mut panels = Vec::new();
    for measure in &stored.measures {
        let stripes = measure.stripes(strength).map_err(|error| source.fail(&error))?;
        let curve = |record: usize| -> Vec<(f64, f64)> {
            let points = stripes.record(record).iter().copied().zip(measure.levels.iter().copied());
            // there is no point where a record does not belong to a level
            points.enumerate().filter(|(level, _)| stripes.belongs(record, *level)).map(|(_, point)| point).collect()
        };
        let mut series: Vec<Series> =
            (0..stripes.record_count()).map(|record| Series::line("", curve(record), Tone::Faint)).collect();
        series.push(Series::line(format!("record {}", stored.records[0]), curve(0), Tone::Distinct(1)));
        for (index, (probability, name)) in [(0.16, "16 %"), (0.5, "median"), (0.84, "84 %")].into_iter().enumerate() {
            let points = measure
                .levels
                .iter()
                .enumerate()
                .map(|(level, &im)| {
                    let mut demands: Vec<(f64, f64)> = stripes.weighted_stripe(level).collect();
                    demands.sort_by(|a, b| a.0.total_cmp(&b.0));
                    (percentile(&demands, stripes.shares().is_some(), probability), im)
                })
                .collect();
            series.push(Series::line(name, points, Tone::Distinct([5, 4, 0][index])));
        }
        panels.push(Panel::lines(
            source.strength_words(strength),
            Axis::log(DISPLACEMENT),
            Axis::linear(format!("{}, {}", measure.measure.label(), measure.measure.unit())),
            series,
        ));
    }
    let title = format!("Incremental dynamic analysis at η = {:.3}", stored.strengths[strength]);
    let caption = if stored.measures.iter().any(|measure| measure.shares.is_some()) {
        "Peak displacement of every record at the levels that it was selected for (grey), of the first record, and \
         weighted percentiles over the records of each level."
    } else {
        "Peak displacement of every record scaled to every level (grey), of the first record, and percentiles over the \
         records at each level (Fig. A2.13, A2.14)."
    };
    Ok(source.figure("ida", title, caption, panels))
}

/// A percentile of demands in ascending order with how much they count, where this is not alike.
fn percentile(demands: &[(f64, f64)], is_weighted: bool, probability: f64) -> f64 {
    if is_weighted {
        return weighted_quantile(demands, probability);
    }
    let demands: Vec<f64> = demands.iter().map(|(demand, _)| *demand).collect();
    quantile(&demands, probability)
}

pub(super) fn fragilities(source: &FigureSource) -> Result<Figure, UpliftError> {
    let stored = &source.stored;
    let strength = source.shown_strength();
    let mut panels = Vec::new();
    for measure in &stored.measures {
        let stripes = measure.stripes(strength).map_err(|error| source.fail(&error))?;
        let mut series = Vec::new();
        for (index, threshold_m) in THRESHOLDS_M.into_iter().enumerate() {
            let probabilities = exceedance_probabilities(&stripes, threshold_m).map_err(|error| source.fail(&error))?;
            let points = measure.levels.iter().copied().zip(probabilities).collect();
            series.push(Series::line(format!("u_{{max}} > {threshold_m} m"), points, Tone::Distinct(index)));
        }
        panels.push(Panel::lines(
            source.strength_words(strength),
            Axis::log(format!("{}, {}", measure.measure.label(), measure.measure.unit())),
            Axis::linear("probability of exceedance").between(0.0, 1.0),
            series,
        ));
    }
    let title = format!("Fragility at η = {:.3}", stored.strengths[strength]);
    let caption = if stored.measures.iter().any(|measure| measure.shares.is_some()) {
        "Weighted share of the records of each level that exceed a displacement (Eq. 4.7): counted, not fitted."
    } else {
        "Share of the records that exceed a displacement at each level (Eq. 4.7): counted, not fitted."
    };
    Ok(source.figure("fragility", title, caption, panels))
}

pub(super) fn risk_curves(source: &FigureSource) -> Result<Vec<Figure>, UpliftError> {
    let stored = &source.stored;
    let thresholds_m: Vec<f64> =
        std::iter::once(0.0).chain((0..=160).map(|step| 1e-4 * 10.0_f64.powf(f64::from(step) / 36.0))).collect();
    let grid = ThresholdGrid::new(thresholds_m).map_err(|error| source.fail(&error))?;
    let shown = nearest(&stored.strengths, &RISK_STRENGTHS);
    let mut figures = Vec::new();
    for measure in &stored.measures {
        let mut panels: Vec<Panel> = source
            .sites()
            .map(|site| Panel::lines(stored.sites[site].clone(), Axis::log(DISPLACEMENT), Axis::log(RATE), Vec::new()))
            .collect();
        for (index, &strength) in shown.iter().enumerate() {
            let demand = measure.demand(strength).map_err(|error| source.fail(&error))?;
            for (site, panel) in panels.iter_mut().enumerate() {
                let curve = RiskCurve::new(&demand, &measure.weights[site]).map_err(|error| source.fail(&error))?;
                let rates = curve.mean_annual_frequencies(&grid);
                let points = grid.thresholds_m().iter().copied().zip(rates).skip(1).collect();
                let name = format!("η = {:.3}", stored.strengths[strength]);
                panel.series.push(Series::line(name, points, Tone::Distinct(index)));
            }
        }
        for panel in &mut panels {
            panel.series.extend(source.targets((1e-4, 2.8), Tone::Distinct(5)));
        }
        let label = measure.measure.label();
        let caption = "Annual rate at which a displacement is exceeded (Fig. 4.4a).";
        figures.push(source.figure(
            format!("risk-{}", measure.measure.key()),
            format!("Risk of exceeding a displacement, by {label}"),
            caption,
            panels,
        ));
    }
    Ok(figures)
}

/// The risk surface over strength and displacement as a map: lines of equal mean annual frequency.
pub(super) fn risk_surfaces(source: &FigureSource) -> Result<Vec<Figure>, UpliftError> {
    let stored = &source.stored;
    let strengths = stored.strengths.len();
    let mut figures = Vec::new();
    for measure in &stored.measures {
        // [site][rate][strength]
        let mut contours_m = vec![vec![Vec::with_capacity(strengths); RATES_PER_YEAR.len()]; source.sites().len()];
        for strength in 0..strengths {
            let demand = measure.demand(strength).map_err(|error| source.fail(&error))?;
            for (site, of_site) in contours_m.iter_mut().enumerate() {
                let ordinates = RiskCurve::new(&demand, &measure.weights[site])
                    .and_then(|curve| curve.exact_ordinates(&RATES_PER_YEAR))
                    .map_err(|error| source.fail(&error))?;
                for (of_rate, ordinate) in of_site.iter_mut().zip(ordinates) {
                    of_rate.push(ordinate.displacement_m);
                }
            }
        }
        let rarest = source.rarest();
        let panels = contours_m
            .iter()
            .enumerate()
            .map(|(site, of_site)| {
                let named = RATE_NAMES.iter().zip(of_site).enumerate();
                let contour = |(index, (name, u_m)): (usize, (&&str, &Vec<f64>))| {
                    source.over_strengths(*name, u_m, Tone::Distinct(index))
                };
                let mut series: Vec<Series> = named.map(contour).collect();
                let name = risk_in_words(stored.poes[rarest], stored.years);
                let spectrum = source.u_m(measure.measure).map(|u_m| u_m.block([site, rarest]));
                series.extend(spectrum.map(|u_m| source.over_strengths(name, u_m, Tone::Distinct(4))));
                Panel::lines(stored.sites[site].clone(), Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), series)
            })
            .collect();
        let label = measure.measure.label();
        let caption = "Contours of the risk surface, seen from above: lines of equal annual rate of exceedance. The \
                       contour of a target rate is the uniform risk spectrum (Fig. 4.4).";
        let id = format!("surface-{}", measure.measure.key());
        figures.push(source.figure(id, format!("Risk surface by {label}"), caption, panels));
    }
    Ok(figures)
}
