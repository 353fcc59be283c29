//! Collapse fragilities of a structure: counted, and the lognormal curves beside them.

use uplift::structure::OverturningReport;
use uplift_fragility::{LognormalFit, LognormalFragility};
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

use super::remark;

/// Steps between the points on a fitted curve.
const STEPS: u32 = 120;

/// A panel for each measure: shares of the records that overturn at each level as dots, the fitted curve as a line.
pub fn overturning_figure(report: &OverturningReport) -> Figure {
    // the rows of a measure follow each other, one a model
    let panels: Vec<Panel> = report
        .overturning
        .chunk_by(|a, b| a.im == b.im)
        .map(|models| {
            let series = models.iter().enumerate().flat_map(|(index, found)| {
                let counts = (&found.levels[..], &found.overturned[..], f64::from(found.records));
                counted_and_fitted(found.model, counts, found.fit.as_ref(), Tone::Distinct(index))
            });
            overturning_panel(models[0].im, models[0].unit, series.collect())
        })
        .collect();
    let title = format!("Overturning of {}", report.structure.name);
    let caption = "Collapse fragility: share of the records that overturn the structure at each intensity level \
                   (dots), and the lognormal curve of maximum likelihood (lines).";
    Figure::new("overturning", title, caption, panels).with_remark(remark(report.source.synthetic))
}

/// Shares of the records that overturn over the levels of a measure.
pub(super) fn overturning_panel(measure: &str, unit: &str, series: Vec<Series>) -> Panel {
    let y = Axis::linear("share of the records that overturn").between(0.0, 1.0);
    Panel::lines("", Axis::log(format!("{measure}, {unit}")), y, series)
}

/// Dots for the records counted at each level, of so many, and the line of the fit.
pub(super) fn counted_and_fitted(
    name: &str,
    (levels, overturned, records): (&[f64], &[u32], f64),
    fit: Option<&LognormalFit>,
    tone: Tone,
) -> Vec<Series> {
    let points = levels.iter().zip(overturned).map(|(&level, &count)| (level, f64::from(count) / records)).collect();
    let mut series = vec![Series::dots(format!("{name}, counted"), points, tone)];
    if let (Some(fit), &[first, .., last]) = (fit, levels) {
        series.push(Series::line(format!("{name}, lognormal"), fitted(&fit.fragility, first, last), tone));
    }
    series
}

/// A lognormal curve between two levels.
pub(super) fn fitted(fragility: &LognormalFragility, first: f64, last: f64) -> Vec<(f64, f64)> {
    let level = |step| first * (last / first).powf(f64::from(step) / f64::from(STEPS));
    (0..=STEPS).map(level).map(|level| (level, fragility.probability(level))).collect()
}
