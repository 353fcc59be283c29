//! The risk of a frame beside its proxies: risk curves, and the collapse fragility.

use uplift::structure::FrameRiskReport;
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};

/// Points on a fitted curve.
const POINTS: u32 = 120;

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
    Figure {
        id: "frame-risk".to_owned(),
        title: format!("Risk of {} at {}", report.structure.name, report.site),
        caption:
            "Annual rate at which a displacement of the deck is exceeded, by the frame and by its proxies; share of \
                  the records that overturn the frame at each level: counted (dots) and lognormal (line)."
                .to_owned(),
        remark: if report.source.synthetic { "synthetic records: not for design" } else { "" }.to_owned(),
        panels: vec![curves, fragility(report)],
        columns: 2,
    }
}

fn fragility(report: &FrameRiskReport) -> Panel {
    let found = &report.overturning;
    let shares = found.levels.iter().zip(&found.overturned);
    let points = shares.map(|(&level, &count)| (level, f64::from(count) / report.records as f64)).collect();
    let counted = "overturning, counted".to_owned();
    let mut series = vec![Series { name: counted, points, tone: Tone::Distinct(0), marks: Marks::Only }];
    if let (Some(fit), [first, .., last]) = (&found.fit, &found.levels[..]) {
        let ratio = last / first;
        let curve = (0..=POINTS).map(|step| {
            let level = first * ratio.powf(f64::from(step) / f64::from(POINTS));
            (level, fit.fragility.probability(level))
        });
        series.push(Series::line("overturning, lognormal", curve.collect(), Tone::Distinct(0)));
    }
    Panel::lines(
        "",
        Axis::log(format!("{}, {}", report.im, report.unit)),
        Axis::linear("share of the records that overturn").between(0.0, 1.0),
        series,
    )
}
