//! The tests of a shaking table: distributions by class, and drifts test by test.

use uplift::result::{DIRECTIONS, ShakeTable};
use uplift_fragility::quantile;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};
use uplift_validation::Sample;

use super::remark;
use super::validation::stairs;

/// Every figure of the tests.
pub fn shake_table_figures(table: &ShakeTable) -> Vec<Figure> {
    [distributions(table), drifts(table), shears(table)].into_iter().chain(spectra(table)).collect()
}

/// Empirical distributions of U by class, a panel a level (Fig. 6.18, the computed lines).
fn distributions(table: &ShakeTable) -> Figure {
    let classes = table.classes();
    let panel = |index: usize, title: &str| {
        let finite = table.tests_at_level(index).map(|(_, test)| test.u_m).filter(|u_m| u_m.is_finite());
        let largest_m = finite.fold(0.0, f64::max);
        let end_m = if largest_m > 0.0 { 1.05 * largest_m } else { 1.0 };
        let of = |class: Option<&str>| -> Option<Vec<(f64, f64)>> {
            let chosen = table.tests_at_level(index).filter(|(one, _)| class.is_none_or(|class| one.class == class));
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
        "Share of the tests up to a displacement of the deck, by class (Fig. 6.18). The share missing to 1 overturns.",
        table.levels.iter().enumerate().map(|(index, level)| panel(index, &level.name)).collect(),
    )
}

/// Drift test by test, a panel a class (Fig. 6.16).
fn drifts(table: &ShakeTable) -> Figure {
    let panel = |class: &str| {
        let series = table.levels.iter().enumerate().map(|(index, level)| {
            let tests = table.tests_at_level(index).filter(|(one, _)| one.class == class);
            let points = (1..).map(f64::from).zip(tests).filter(|(_, (_, test))| test.drift.is_finite());
            let points = points.map(|(place, (_, test))| (place, 100.0 * test.drift)).collect();
            Series::dots(&level.name, points, Tone::Distinct(index))
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
        let tests = table.tests_at_level(index).filter(|(_, test)| test.drift.is_finite());
        let points = tests.map(|(_, test)| (100.0 * test.drift, 1e-3 * test.base_shear_n)).collect();
        Series::dots(&level.name, points, Tone::Distinct(index))
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

/// Response spectra of what the table plays, a panel a class, level and component (Fig. 6.12); none without motions.
fn spectra(table: &ShakeTable) -> Option<Figure> {
    let spectra = table.spectra.as_ref()?;
    let classes = table.classes();
    let line = |ordinates_m_s2: &[f64], factor: f64| -> Vec<(f64, f64)> {
        let of = |(period_s, ordinate_m_s2): (&f64, &f64)| (*period_s, factor * ordinate_m_s2);
        spectra.periods_s.iter().zip(ordinates_m_s2).map(of).collect()
    };
    let panel = |class: &str, level: usize, direction: usize| {
        let tests = table.tests_at_level(level).enumerate().filter(|(_, (one, _))| one.class == class);
        let motions: Vec<Vec<(f64, f64)>> =
            tests.map(|(place, (_, test))| line(spectra.recorded(place, direction), test.factor)).collect();
        let median = spectra.periods_s.iter().enumerate().map(|(period, period_s)| {
            let mut ordinates_m_s2: Vec<f64> = motions.iter().map(|motion| motion[period].1).collect();
            ordinates_m_s2.sort_by(f64::total_cmp);
            (*period_s, quantile(&ordinates_m_s2, 0.5))
        });
        let median = Series::line("median", median.collect(), Tone::Distinct(0));
        let motions = motions.into_iter().map(|motion| Series::line("", motion, Tone::Faint));
        let design = spectra.design_m_s2.as_ref().map(|ordinates_m_s2| line(ordinates_m_s2, 1.0));
        let design = design.map(|points| Series::line("Eurocode 8, elastic", points, Tone::Distinct(1)));
        let title = format!("{class}, {}, {}", table.levels[level].name, DIRECTIONS[direction]);
        let (x, y) = (Axis::linear("period on the table, s"), Axis::linear("spectral acceleration, m/s²"));
        Panel::lines(title, x, y, motions.chain([median]).chain(design).collect())
    };
    let panels = classes.iter().flat_map(|class| {
        (0..table.levels.len()).flat_map(move |level| (0..DIRECTIONS.len()).map(move |of| (*class, level, of)))
    });
    Some(figure(
        table,
        "shake-table-spectra",
        "Response spectra of the motions",
        "Spectral acceleration of the motions on the table at 5 % damping, by class, level and component (Fig. 6.12).",
        panels.map(|(class, level, direction)| panel(class, level, direction)).collect(),
    ))
}

fn figure(table: &ShakeTable, id: &str, title: &str, caption: &str, panels: Vec<Panel>) -> Figure {
    Figure::new(id, format!("{title}, {}", table.structure), caption, panels).with_remark(remark(table.synthetic))
}
