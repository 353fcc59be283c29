//! The risk of a frame beside its proxies: risk curves, and the collapse fragility.

use uplift::structure::FrameRiskReport;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

use super::overturning::{counted_and_fitted, overturning_panel};
use super::remark;

/// Annual frequency over displacement with the target, and the share of records that overturn the frame.
pub fn frame_risk_figure(report: &FrameRiskReport) -> Figure {
    let drawn = report.demands.iter().filter(|demand| !demand.risk_curve.is_empty());
    let mut series: Vec<Series> = drawn
        .enumerate()
        .map(|(index, demand)| {
            let points = demand.risk_curve.iter().map(|point| (point.displacement_m, point.per_year)).collect();
            Series::line(demand.model, points, Tone::Distinct(index))
        })
        .collect();
    let ends = series.iter().flat_map(|line| &line.points).map(|point| point.0);
    let (first, last) = ends.fold((f64::INFINITY, 0.0_f64), |(first, last), at| (first.min(at), last.max(at)));
    if first < last {
        let target = vec![(first, report.target_per_year), (last, report.target_per_year)];
        series.push(Series::line("target", target, Tone::Faint));
    }
    let curves = Panel::lines("", Axis::log("displacement of the deck, m"), Axis::log("annual rate, 1/yr"), series);
    let title = format!("Risk of {} at {}", report.structure.name, report.site);
    let caption = "Annual rate at which a displacement of the deck is exceeded, by the frame and by its proxies; share \
                   of the records that overturn the frame at each level: counted (dots) and lognormal (line).";
    Figure::new("frame-risk", title, caption, vec![curves, fragility(report)])
        .with_remark(remark(report.source.synthetic))
}

fn fragility(report: &FrameRiskReport) -> Panel {
    let found = &report.overturning;
    let counts = (&found.levels[..], &found.overturned[..], report.records as f64);
    let series = counted_and_fitted("overturning", counts, found.fit.as_ref(), Tone::Distinct(0));
    overturning_panel(report.im, report.unit, series)
}
