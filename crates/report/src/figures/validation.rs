//! Computed peaks beside measured ones: distributions with a band, and motion by motion.

use uplift::validate::{GroupReport, ValidateReport};
use uplift_plot::{Axis, Band, Figure, Panel, Series, Tone};
use uplift_validation::{BandRule, Sample};

/// What a factor of two is called.
const FACTOR: f64 = 2.0;

/// Empirical distributions of each group, the measured one with its 95 % band (Fig. 6.18).
pub fn distributions_figure(report: &ValidateReport) -> Figure {
    let rule = match report.band {
        BandRule::Greenwood => "pointwise by Greenwood's formula",
        BandRule::Dkw => "of the whole distribution, by Dvoretzky, Kiefer and Wolfowitz",
        BandRule::Bootstrap => "pointwise over resamples of the motions",
    };
    let caption = format!(
        "Share of the peaks up to a value, measured with a 95 % band ({rule}) and computed. The share missing to 1 \
         collapsed, or exceeds the measuring range."
    );
    let panels = report.groups.iter().map(|group| distributions(report, group)).collect();
    Figure::new("validation", "Distributions of computed and measured peaks", caption, panels)
}

/// Computed over measured peak of each motion (Fig. 6.19), with lines of equality and of factors of two.
pub fn pairs_figure(report: &ValidateReport) -> Figure {
    let caption = "Computed over measured peak of each motion; lines: equality, and a factor of two either way. \
                   Collapses are counted in the table alone.";
    let panels = report.groups.iter().map(|group| pairs(report, group)).collect();
    Figure::new("validation-pairs", "Computed over measured peaks", caption, panels)
}

/// The value with its unit: `u_m` is `u, m`.
fn label(report: &ValidateReport) -> String {
    match report.value.strip_suffix(report.unit).and_then(|name| name.strip_suffix('_')) {
        Some(name) if !report.unit.is_empty() => format!("{name}, {}", report.unit),
        _ => report.value.clone(),
    }
}

fn distributions(report: &ValidateReport, group: &GroupReport) -> Panel {
    let largest =
        group.samples.iter().flat_map(Sample::sorted).copied().filter(|value| value.is_finite()).fold(0.0, f64::max);
    let end = if largest > 0.0 { 1.05 * largest } else { 1.0 };
    let [measured, computed] = &group.samples;
    let ends = group.band.iter().skip(1).map(|(value, ..)| *value).chain([end]);
    let band = group.band.iter().zip(ends).flat_map(|(&(at, low, high), to)| [(at, low, high), (to, low, high)]);
    Panel {
        bands: vec![Band { name: "95 %, measured".to_owned(), points: band.collect(), tone: Tone::Distinct(0) }],
        ..Panel::lines(
            title(group, &format!("D = {:.3}, p = {:.3}", group.kolmogorov_smirnov.distance, group.p)),
            Axis::linear(label(report)).between(0.0, end),
            Axis::linear("share of the motions").between(0.0, 1.0),
            vec![
                Series::line("measured", stairs(measured, end), Tone::Distinct(0)),
                Series::line("computed", stairs(computed, end), Tone::Distinct(1)),
            ],
        )
    }
}

/// The steps of an empirical distribution from 0 to `end`.
pub(super) fn stairs(sample: &Sample, end: f64) -> Vec<(f64, f64)> {
    let mut points = vec![(0.0, 0.0)];
    let mut share = 0.0;
    for &value in sample.sorted().iter().filter(|value| value.is_finite()) {
        points.push((value, share));
        share = sample.cdf(value);
        points.push((value, share));
    }
    points.push((end, share));
    points
}

fn pairs(report: &ValidateReport, group: &GroupReport) -> Panel {
    let points: Vec<(f64, f64)> = group
        .values
        .iter()
        .copied()
        .filter(|(measured, computed)| [measured, computed].iter().all(|value| value.is_finite() && **value > 0.0))
        .collect();
    let ends = points
        .iter()
        .flat_map(|(m, c)| [*m, *c])
        .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    // a group without finite pairs has an empty panel
    let (low, high) = if points.is_empty() { (0.1, 1.0) } else { (0.8 * ends.0, 1.25 * ends.1) };
    let line = |factor: f64| vec![(low, factor * low), (high, factor * high)];
    let remark = group
        .pairs
        .as_ref()
        .and_then(|pairs| pairs.pearson)
        .map_or_else(String::new, |pearson| format!("correlation {pearson:.2}"));
    Panel::lines(
        title(group, &remark),
        Axis::log(format!("measured {}", label(report))).between(low, high),
        Axis::log(format!("computed {}", label(report))).between(low, high),
        vec![
            Series::line("equal", line(1.0), Tone::Distinct(2)),
            Series::line("a factor of two", line(FACTOR), Tone::Thin(2)),
            Series::line("", line(1.0 / FACTOR), Tone::Thin(2)),
            Series::dots("motions", points, Tone::Distinct(0)),
        ],
    )
}

fn title(group: &GroupReport, remark: &str) -> String {
    let name = ValidateReport::name(group);
    if remark.is_empty() { name } else { format!("{name}: {remark}") }
}
