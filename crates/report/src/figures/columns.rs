//! Columns pushed sideways, their restrainers, and what protocols do (Figures 5.4, 5.9, 5.11, 6.4, 6.8, 6.9, A2.1).

use uplift::UpliftError;
use uplift::pushover::{ProtocolReport, PushoverReport};
use uplift::restrainer::RestrainerCurve;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};
use uplift_statics::{
    LinearLaw, LoadingProtocol, Parts, ProtocolPoint, RestrainedColumns, Restrainer, Spring, StaticsError, TendonPath,
    tilt,
};

/// Points on a computed line.
const POINTS: u32 = 240;
/// Shares of the critical stiffness that Figure 5.4 has a line for.
const SHARES: [f64; 6] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.25];
/// Shares of the critical stiffness at the column that Figure 6.4a has two lines for: in the foundation the second is
/// critical.
const ANCHORED_SHARES: [f64; 3] = [0.125, 0.25, 0.375];
const DISPLACEMENT: &str = "displacement u, m";
const FORCE: &str = "force F, kN";
const FORCE_OVER_WEIGHT: &str = "force over weight F/(N W)";

/// Evenly spaced values from 0 to `to`.
fn spaced(to: f64) -> impl Iterator<Item = f64> {
    (0..=POINTS).map(move |step| to * f64::from(step) / f64::from(POINTS))
}

/// A value of the columns over the displacement, up to where the law ends.
fn line(
    columns: &RestrainedColumns,
    to_m: f64,
    value: impl Fn(&uplift_statics::PushoverState) -> f64,
) -> Vec<(f64, f64)> {
    let last_m = tilt::travel_m(columns.geometry(), columns.last_rotation_rad());
    spaced(to_m.min(last_m))
        .filter_map(|at_m| columns.at_displacement(at_m).ok().map(|state| (at_m, value(&state))))
        .collect()
}

fn linear_line(law: &LinearLaw, to_m: f64, value: impl Fn(&uplift_statics::LinearState) -> f64) -> Vec<(f64, f64)> {
    spaced(to_m).map(|at_m| (at_m, value(&law.at(at_m)))).collect()
}

fn kilo(value: f64) -> f64 {
    1e-3 * value
}

/// The pushover of a report: the exact law, linear ones, the measured curve, events.
pub fn pushover_figure(report: &PushoverReport) -> Figure {
    let columns = &report.pushed;
    let to_m = report.rows.last().map_or(0.0, |row| row.displacement_m);
    let mut series = Vec::new();
    if let Some(measured) = &report.measured {
        let points = measured.curve.iter().map(|&(at_m, force_n)| (at_m, kilo(force_n))).collect();
        series.push(Series::line("measured", points, Tone::Thin(3)));
    }
    series.push(Series::line("exact", line(columns, to_m, |state| kilo(state.force_n)), Tone::Distinct(0)));
    for (index, curve) in report.linear.iter().enumerate() {
        let points = curve.rows.iter().map(|row| (row.displacement_m, kilo(row.force_n))).collect();
        let name = format!("linear, {:.0} kN/m", kilo(curve.stiffness_n_m));
        series.push(Series::line(name, points, Tone::Distinct(index + 1)));
    }
    if let Some(cyclic) = &report.cyclic {
        let points =
            cyclic.states.iter().map(|state| (state.displacement_m, state.force_n.map_or(f64::NAN, kilo))).collect();
        series.push(Series::line("under the protocol", points, Tone::Thin(1)));
    }
    let events: Vec<(f64, f64)> = report
        .events
        .iter()
        .map(|event| (event.state.displacement_m, kilo(event.state.force_n)))
        .filter(|(at_m, _)| *at_m <= to_m)
        .collect();
    series.push(Series::dots("events", events, Tone::Distinct(0)));
    let mut panels = vec![Panel::lines("", Axis::linear(DISPLACEMENT), Axis::linear(FORCE), series)];
    let mut caption =
        "Force over displacement of the deck: the exact law with its events (dots), and the curves compared with it."
            .to_owned();
    if !report.linear.is_empty() {
        panels.push(over_weight(report, to_m));
        caption += " The exact and the linearised laws also over the weight, as in Fig. 5.4b.";
    }
    Figure::new("pushover", format!("Pushover of {}", report.name), caption, panels)
}

/// `F/(N W)` of the exact law and of linear ones.
fn over_weight(report: &PushoverReport, to_m: f64) -> Panel {
    let columns = &report.pushed;
    let weight_n = f64::from(columns.columns()) * columns.weight_n();
    let exact = line(columns, to_m, |state| state.force_n / weight_n);
    let mut series = vec![Series::line("exact", exact, Tone::Distinct(0))];
    for (index, curve) in report.linear.iter().enumerate() {
        let points = curve.rows.iter().map(|row| (row.displacement_m, row.force_n / weight_n)).collect();
        let name = format!("linear, {:.0} kN/m", kilo(curve.stiffness_n_m));
        series.push(Series::line(name, points, Tone::Distinct(index + 1)));
    }
    force_over_weight("", series)
}

fn force_over_weight(title: &str, series: Vec<Series>) -> Panel {
    Panel::lines(title, Axis::linear(DISPLACEMENT), Axis::linear(FORCE_OVER_WEIGHT), series)
}

/// Springs, and springs with their tendon (Figures 5.9 and 6.8).
pub fn restrainer_figure(report: &RestrainerCurve) -> Figure {
    restrainer_figure_of(&report.name, &report.restrainer, report.rows.last().map_or(0.0, |row| row.elongation_m))
}

fn restrainer_figure_of(name: &str, restrainer: &Restrainer, to_m: f64) -> Figure {
    let system =
        spaced(to_m).filter_map(|at_m| restrainer.at(at_m).ok().map(|state| (1e3 * at_m, kilo(state.force_n))));
    let mut series = vec![Series::line("restrainer", system.collect(), Tone::Distinct(0))];
    if let Spring::Discs(stack) = restrainer.parts().spring {
        let law = stack.law();
        let points = spaced(stack.flat_deformation_m()).map(|d_m| (1e3 * d_m, kilo(law.force_n(d_m)))).collect();
        series.push(Series::line("springs alone", points, Tone::Distinct(1)));
    }
    let x = Axis::linear("elongation, or deformation of the springs, mm");
    Figure::new(
        "restrainer",
        format!("Restrainer of {name}"),
        "Force over elongation of the restrainer, tendon included, and over deformation of its springs alone (Fig. \
         5.9, 6.8).",
        vec![Panel::lines("", x, Axis::linear("force T, kN"), series)],
    )
}

/// A loading protocol over time (Figure 5.11).
pub fn protocol_figure(report: &ProtocolReport) -> Figure {
    protocol_figure_of(&report.history)
}

fn protocol_figure_of(history: &[ProtocolPoint]) -> Figure {
    let points = history.iter().map(|point| (point.time_s / 3600.0, 100.0 * point.drift)).collect();
    let series = vec![Series::line("drift", points, Tone::Distinct(0))];
    Figure::new(
        "protocol",
        "Loading protocol",
        "Drift over time (Fig. 5.11).",
        vec![Panel::lines("", Axis::linear("time, h"), Axis::linear("drift, %"), series)],
    )
}

/// Every figure of a structure's columns: its pushover, sections and the protocol of Fig. 5.11; of restrained ones
/// linear restrainers of several stiffnesses (Fig. 5.4) and in both anchorages (Fig. 6.4a), the moment at the base by
/// anchorage (Fig. 6.4b, c), the restrainer (Fig. 5.9, 6.8) and the path of its tendon (Fig. 6.9, A2.1).
///
/// # Errors
/// Columns that cannot be restrained otherwise: none that could be pushed.
pub fn column_figures(report: &PushoverReport) -> Result<Vec<Figure>, UpliftError> {
    let columns = &report.pushed;
    let history = LoadingProtocol::default().history(1)?;
    let mut figures = vec![pushover_figure(report)];
    // of a structure without tendons nobody asks what they do
    let restrainer = columns.restrainer();
    if restrainer.is_some() {
        figures.extend([stiffnesses(columns)?, anchorages(columns)?, base_moments(columns)?]);
    }
    figures.extend([sections(report), protocol_figure_of(&history)]);
    if let Some(restrainer) = restrainer {
        let to_m = report.rows.last().map_or(0.0, |row| row.elongation_m);
        let flat_m = restrainer.elongation_at_m(uplift_statics::Threshold::SpringsFlat).unwrap_or(f64::INFINITY);
        figures.push(restrainer_figure_of(&report.name, restrainer, to_m.min(flat_m)));
        figures.push(paths(report, restrainer)?);
    }
    Ok(figures)
}

/// `F/(N W)` over `u/2b` for linear restrainers of several stiffnesses: exact and linearised (Fig. 5.4b).
fn stiffnesses(columns: &RestrainedColumns) -> Result<Figure, UpliftError> {
    let free = columns.clone().with_restrained(0)?;
    let (geometry, weight_n) = (columns.geometry(), f64::from(columns.columns()) * columns.weight_n());
    let to_m = 5.0 * geometry.width_m();
    let critical_n_m = free.linear(0.0)?.critical_stiffness_n_m();
    let (mut exact, mut linear) = (Vec::new(), Vec::new());
    for (index, share) in SHARES.into_iter().enumerate() {
        let name = format!("{share} k_{{crit}}");
        let law = Restrainer::new(Parts::linear(share * critical_n_m))?;
        let path = if columns.path() == TendonPath::Foundation { TendonPath::Foundation } else { TendonPath::Column };
        let held = free.clone().with_restrainer(law, path)?;
        let points = line(&held, to_m, |state| state.force_n / weight_n);
        exact.push(Series::line(name.clone(), points, Tone::Distinct(index)));
        let law = held.linear(share * critical_n_m)?;
        linear.push(Series::line(
            name,
            linear_line(&law, to_m, |state| state.force_n / weight_n),
            Tone::Distinct(index),
        ));
    }
    Ok(Figure::new(
        "stiffnesses",
        "Force over displacement for linear restrainers",
        "Force over displacement for linear restrainers of several shares of the critical stiffness: linearised as in \
         Fig. 5.4b, and exact.",
        vec![force_over_weight("linearised", linear), force_over_weight("exact", exact)],
    ))
}

/// `F/(N W)` over the displacement for the same linear restrainers anchored at the column and in the foundation (Fig.
/// 6.4a): linearised and exact.
fn anchorages(columns: &RestrainedColumns) -> Result<Figure, UpliftError> {
    let free = columns.clone().with_restrained(0)?;
    let weight_n = f64::from(columns.columns()) * columns.weight_n();
    let to_m = 5.0 * columns.geometry().width_m();
    let held = |stiffness_n_m: f64, path| -> Result<RestrainedColumns, StaticsError> {
        free.clone().with_restrainer(Restrainer::new(Parts::linear(stiffness_n_m))?, path)
    };
    let critical_n_m = held(0.0, TendonPath::Column)?.linear(0.0)?.critical_stiffness_n_m();
    let (mut exact, mut linear) = (Vec::new(), Vec::new());
    for (index, share) in ANCHORED_SHARES.into_iter().enumerate() {
        let stiffness_n_m = share * critical_n_m;
        for (place, path, tone) in [
            ("column", TendonPath::Column, Tone::Distinct(index)),
            ("foundation", TendonPath::Foundation, Tone::Thin(index)),
        ] {
            let name = format!("{place}, {:.0} kN/m", kilo(stiffness_n_m));
            let columns = held(stiffness_n_m, path)?;
            let law = columns.linear(stiffness_n_m)?;
            let points = linear_line(&law, to_m, |state| state.force_n / weight_n);
            linear.push(Series::line(name.clone(), points, tone));
            exact.push(Series::line(name, line(&columns, to_m, |state| state.force_n / weight_n), tone));
        }
    }
    Ok(Figure::new(
        "anchorages",
        "Force over displacement by anchorage",
        "Force over displacement for the same linear restrainers anchored at the column (bold) and in the foundation \
         (thin, Fig. 6.4a), where each is as stiff as four: linearised, and exact.",
        vec![force_over_weight("linearised", linear), force_over_weight("exact", exact)],
    ))
}

/// Moment at the base of a column over the displacement, by anchorage (Fig. 6.4b, c): restrainers of equal pushovers.
fn base_moments(columns: &RestrainedColumns) -> Result<Figure, UpliftError> {
    let free = columns.clone().with_restrained(0)?;
    let to_m = 5.0 * columns.geometry().width_m();
    let at_column_n_m = 0.5
        * free
            .clone()
            .with_restrainer(Restrainer::new(Parts::linear(0.0))?, TendonPath::Column)?
            .linear(0.0)?
            .critical_stiffness_n_m();
    let mut series = Vec::new();
    for (index, (name, path, stiffness_n_m)) in [
        ("tendon in the foundation", TendonPath::Foundation, 0.25 * at_column_n_m),
        ("tendon in the column", TendonPath::Column, at_column_n_m),
    ]
    .into_iter()
    .enumerate()
    {
        let held = free.clone().with_restrainer(Restrainer::new(Parts::linear(stiffness_n_m))?, path)?;
        let points = line(&held, to_m, |state| kilo(state.sections.base_moment_n_m));
        series.push(Series::line(name, points, Tone::Distinct(index)));
    }
    let y = Axis::linear("moment at the base of a column, kN m");
    Ok(Figure::new(
        "base-moment",
        "Moment at the base by anchorage",
        "Moment at the base of a column with restrainers of the same pushover, half the critical stiffness: anchored \
         in the foundation it grows with the tendon's force, in the column it does not (Fig. 6.4b, c).",
        vec![Panel::lines("", Axis::linear(DISPLACEMENT), y, series)],
    ))
}

/// Axial force, shear and moment of the critical section over the displacement.
fn sections(report: &PushoverReport) -> Figure {
    let columns = &report.pushed;
    let to_m = report.rows.last().map_or(0.0, |row| row.displacement_m);
    let forces = vec![
        Series::line("axial force N", line(columns, to_m, |state| kilo(state.sections.top_axial_n)), Tone::Distinct(0)),
        Series::line("shear V", line(columns, to_m, |state| kilo(state.sections.top_shear_n)), Tone::Distinct(1)),
        Series::line("tendon T", line(columns, to_m, |state| kilo(state.tendon_n)), Tone::Distinct(2)),
    ];
    let moments = vec![
        Series::line("top", line(columns, to_m, |state| kilo(state.sections.top_moment_n_m)), Tone::Distinct(0)),
        Series::line("base", line(columns, to_m, |state| kilo(state.sections.base_moment_n_m)), Tone::Distinct(1)),
    ];
    Figure::new(
        "sections",
        format!("Sections of {}", report.name),
        "Forces on the end sections of a column over the displacement of the deck (Eq. 5.4 to 5.7, exact).",
        vec![
            Panel::lines("forces at the top", Axis::linear(DISPLACEMENT), Axis::linear("force, kN"), forces),
            Panel::lines("moments", Axis::linear(DISPLACEMENT), Axis::linear("moment, kN m"), moments),
        ],
    )
}

/// The same restrainer with the tendon held in the axis and, where the structure says how far it moves, shifted (Fig.
/// 6.9, A2.1).
fn paths(report: &PushoverReport, restrainer: &Restrainer) -> Result<Figure, UpliftError> {
    let columns = &report.pushed;
    let bare = Restrainer::new(Parts { stopper: None, ..*restrainer.parts() })?;
    let own = columns.path();
    let mut wanted = vec![("tendon in the axis", TendonPath::Column)];
    match own {
        TendonPath::Shifted { .. } => wanted.push(("tendon shifted in its duct", own)),
        TendonPath::Foundation => wanted.push(("tendon in the foundation", own)),
        TendonPath::Column => {}
    }
    let (mut forces, mut elongations) = (Vec::new(), Vec::new());
    for (index, (name, path)) in wanted.into_iter().enumerate() {
        let held = columns.clone().with_restrainer(bare.clone(), path)?;
        let to_m = held.capacity().map_or(5.0 * columns.geometry().width_m(), |found| 1.05 * found.displacement_m);
        forces.push(Series::line(name, line(&held, to_m, |state| kilo(state.force_n)), Tone::Distinct(index)));
        let points = line(&held, to_m, |state| 1e3 * state.elongation_m);
        elongations.push(Series::line(name, points, Tone::Distinct(index)));
    }
    Ok(Figure::new(
        "tendon-path",
        "Path of the tendon",
        "Force and elongation of the tendon by its path, without stoppers: held in the axis, or free in its duct (Fig. \
         6.9, A2.1).",
        vec![
            Panel::lines("", Axis::linear(DISPLACEMENT), Axis::linear(FORCE), forces),
            Panel::lines("", Axis::linear(DISPLACEMENT), Axis::linear("elongation Δ, mm"), elongations),
        ],
    ))
}
