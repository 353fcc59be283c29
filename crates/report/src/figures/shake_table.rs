//! The tests of a shaking table: distributions by class, and drifts test by test.

use uplift::result::ShakeTable;
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};
use uplift_validation::Sample;

use super::validation::stairs;

/// Every figure of the tests.
pub fn shake_table_figures(table: &ShakeTable) -> Vec<Figure> {
    vec![distributions(table), drifts(table), shears(table)]
}

/// Empirical distributions of U by class, a panel a level (Fig. 6.18, the computed lines).
fn distributions(table: &ShakeTable) -> Figure {
    let classes = table.classes();
    let panel = |index: usize, title: &str| {
        let finite = table.of_level(index).map(|(_, test)| test.u_m).filter(|u_m| u_m.is_finite());
        let largest_m = finite.fold(0.0, f64::max);
        let end_m = if largest_m > 0.0 { 1.05 * largest_m } else { 1.0 };
        let of = |class: Option<&str>| -> Option<Vec<(f64, f64)>> {
            let chosen = table.of_level(index).filter(|(one, _)| class.is_none_or(|class| one.class == class));
            Some(stairs(&Sample::new(chosen.map(|(_, test)| test.u_m).collect()).ok()?, end_m))
        };
        let all = (classes.len() > 1).then_some(("all", None));
        let wanted = all.into_iter().chain(classes.iter().map(|class| (*class, Some(*class))));
        let series = wanted
            .enumerate()
            .filter_map(|(place, (name, class))| Some(Series::line(name, of(class)?, Tone::Distinct(place))));
        let y = Axis::linear("share of the tests").between(0.0, 1.0);
        Panel::lines(title, Axis::linear("displacement U, m").between(0.0, end_m), y, series.collect())
    };
    figure(
        table,
        "shake-table-cdf",
        "Distributions of the displacement",
        "Share of the tests up to a displacement of the deck, by class (Fig. 6.18). What does not reach 1 overturns.",
        table.levels.iter().enumerate().map(|(index, level)| panel(index, &level.name)).collect(),
    )
}

/// Drift test by test, a panel a class (Fig. 6.16).
fn drifts(table: &ShakeTable) -> Figure {
    let panel = |class: &str| {
        let series = table.levels.iter().enumerate().map(|(index, level)| {
            let tests = table.of_level(index).filter(|(one, _)| one.class == class);
            let points = (1..).map(f64::from).zip(tests).filter(|(_, (_, test))| test.drift.is_finite());
            Series {
                name: level.name.clone(),
                points: points.map(|(place, (_, test))| (place, 100.0 * test.drift)).collect(),
                tone: Tone::Distinct(index),
                marks: Marks::Only,
            }
        });
        Panel::lines(class, Axis::linear("excitation of the class"), Axis::linear("drift, %"), series.collect())
    };
    figure(
        table,
        "shake-table-drift",
        "Largest drift in each test",
        "Largest displacement over the height of the columns in each test, by class (Fig. 6.16). Tests that overturn \
         have no dot.",
        table.classes().into_iter().map(panel).collect(),
    )
}

/// Base shear over drift of all tests (the peaks of Fig. 6.14a).
fn shears(table: &ShakeTable) -> Figure {
    let series = table.levels.iter().enumerate().map(|(index, level)| {
        let tests = table.of_level(index).filter(|(_, test)| test.drift.is_finite());
        Series {
            name: level.name.clone(),
            points: tests.map(|(_, test)| (100.0 * test.drift, 1e-3 * test.base_shear_n)).collect(),
            tone: Tone::Distinct(index),
            marks: Marks::Only,
        }
    });
    let (x, y) = (Axis::linear("drift, %"), Axis::linear("base shear, kN"));
    figure(
        table,
        "shake-table-shear",
        "Largest base shear over largest drift",
        "Largest base shear of the deck over the largest drift of each test; both need not be at the same time.",
        vec![Panel::lines("", x, y, series.collect())],
    )
}

fn figure(table: &ShakeTable, id: &str, title: &str, caption: &str, panels: Vec<Panel>) -> Figure {
    Figure {
        id: id.to_owned(),
        title: format!("{title}, {}", table.structure),
        caption: caption.to_owned(),
        remark: if table.synthetic { "synthetic records: not for design" } else { "" }.to_owned(),
        columns: panels.len().clamp(1, 2),
        panels,
    }
}
