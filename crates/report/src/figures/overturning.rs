//! Collapse fragilities of a structure: counted, and the lognormal curves beside them.

use uplift_motion::IntensityMeasure;

use uplift::structure::Collapse;
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};

/// Points on a fitted curve.
const POINTS: u32 = 120;

/// A panel for each measure: shares of the records that overturn at each level as dots, the fitted curve as a line.
///
/// * `title` — of the figure
/// * `remark` — inside it; empty for none
/// * `measures` — each with its models by name
pub fn overturning_figure(
    title: &str,
    remark: &str,
    measures: &[(IntensityMeasure, Vec<(&str, &Collapse)>)],
) -> Figure {
    let panels = measures
        .iter()
        .map(|(measure, models)| {
            let lines = models.iter().enumerate().flat_map(|(index, (name, found))| series(index, name, found));
            Panel::lines(
                "",
                Axis::log(format!("{}, {}", measure.label(), measure.unit())),
                Axis::linear("share of the records that overturn").between(0.0, 1.0),
                lines.collect(),
            )
        })
        .collect::<Vec<_>>();
    Figure {
        id: "overturning".to_owned(),
        title: title.to_owned(),
        caption: "Collapse fragility: the share of the records that overturn the structure at each level (dots) and \
                  the lognormal curve of maximum likelihood (lines)."
            .to_owned(),
        remark: remark.to_owned(),
        columns: panels.len().min(2),
        panels,
    }
}

/// Dots and line of one model.
fn series(index: usize, name: &str, found: &Collapse) -> Vec<Series> {
    let share = |exceedances: u32, trials: u32| f64::from(exceedances) / f64::from(trials);
    let points = found.counts.iter().map(|count| (count.level, share(count.exceedances, count.trials))).collect();
    let tone = Tone::Distinct(index);
    let mut series = vec![Series { name: format!("{name}, counted"), points, tone, marks: Marks::Only }];
    if let (Ok(fit), [first, .., last]) = (&found.fit, &found.counts[..]) {
        let ratio = last.level / first.level;
        let curve = (0..=POINTS).map(|step| {
            let level = first.level * ratio.powf(f64::from(step) / f64::from(POINTS));
            (level, fit.fragility.probability(level))
        });
        series.push(Series::line(format!("{name}, lognormal"), curve.collect(), tone));
    }
    series
}
