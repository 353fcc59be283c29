//! Collapse fragilities of a structure: counted, and the lognormal curves beside them.

use uplift::structure::{CollapseReport, OverturningReport};
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};

/// Points on a fitted curve.
const POINTS: u32 = 120;

/// A panel for each measure: shares of the records that overturn at each level as dots, the fitted curve as a line.
pub fn overturning_figure(report: &OverturningReport) -> Figure {
    // the rows of a measure follow each other, one a model
    let panels: Vec<Panel> = report
        .overturning
        .chunk_by(|a, b| a.im == b.im)
        .map(|models| {
            Panel::lines(
                "",
                Axis::log(format!("{}, {}", models[0].im, models[0].unit)),
                Axis::linear("share of the records that overturn").between(0.0, 1.0),
                models.iter().enumerate().flat_map(|(index, found)| series(index, found)).collect(),
            )
        })
        .collect();
    Figure {
        id: "overturning".to_owned(),
        title: format!("Overturning of {}", report.structure.name),
        caption:
            "Collapse fragility: share of the records that overturn the structure at each intensity level (dots), and \
                  the lognormal curve of maximum likelihood (lines)."
                .to_owned(),
        remark: if report.source.synthetic { "synthetic records: not for design" } else { "" }.to_owned(),
        columns: panels.len().min(2),
        panels,
    }
}

/// Dots and line of one model.
fn series(index: usize, found: &CollapseReport) -> Vec<Series> {
    let (name, records) = (found.model, f64::from(found.records));
    let counted = found.levels.iter().zip(&found.overturned);
    let points = counted.map(|(&level, &overturned)| (level, f64::from(overturned) / records)).collect();
    let tone = Tone::Distinct(index);
    let mut series = vec![Series { name: format!("{name}, counted"), points, tone, marks: Marks::Only }];
    if let (Some(fit), [first, .., last]) = (&found.fit, &found.levels[..]) {
        let ratio = last / first;
        let curve = (0..=POINTS).map(|step| {
            let level = first * ratio.powf(f64::from(step) / f64::from(POINTS));
            (level, fit.fragility.probability(level))
        });
        series.push(Series::line(format!("{name}, lognormal"), curve.collect(), tone));
    }
    series
}
