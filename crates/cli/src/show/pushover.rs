//! A pushover and a protocol in lines and tables.

use std::io::Write;

use uplift::pushover::{MeasuredCurve, ProtocolReport, PushoverReport};
use uplift::text::{Table, TableOf, counted};
use uplift_statics::{Capacity, PushoverState};
use uplift_structure::{NO_CAPACITY, NO_CAPACITY_REASON};

use super::{print_files, shown_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Cycles that are reported, the largest.
const CYCLES: usize = 6;

/// The structure, how far it goes, what happens on the way, and the rows.
pub(crate) fn print_pushover(report: &PushoverReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    head(&mut out, report)?;
    let events = Table::from_rows(&report.events).left("event", |event| event.event.words());
    writeln!(out, "\n{}", way(events, |event| &event.state).build())?;
    let states = way(Table::from_rows(report.rows.iter().enumerate()), |(_, state)| state)
        .right("N, kN", |(_, state)| kilo(state.sections.top_axial_n))
        .right("M, kN m", |(_, state)| kilo(state.sections.top_moment_n_m))
        .right("V, kN", |(_, state)| kilo(state.sections.top_shear_n))
        .right("M base", |(_, state)| kilo(state.sections.base_moment_n_m))
        .each(&report.linear, |table, curve| {
            let heading = format!("F lin {:.0}", 1e-3 * curve.stiffness_n_m);
            table.right(heading, |(index, _)| kilo(curve.rows[index].force_n))
        });
    writeln!(out, "\n{}", states.build().with_left(1))?;
    for curve in &report.linear {
        let capacity = |capacity_m: f64| format!("capacity {capacity_m:.4} m");
        let capacity = curve.capacity_m.map_or_else(|| NO_CAPACITY.to_owned(), capacity);
        let (k, share) = (kilo(curve.stiffness_n_m), curve.share_of_critical);
        writeln!(out, "linear, {k} kN/m ({share:.3} of the critical stiffness): {capacity}")?;
    }
    if let Some(cyclic) = &report.cyclic {
        let stoppers = match cyclic.dissipated_j {
            dissipated_j if dissipated_j > 0.0 => format!(", {dissipated_j:.1} J dissipated by stoppers"),
            _ => String::new(),
        };
        writeln!(
            out,
            "protocol   {} sets up to {:.2} %, {:.1} h: F up to {} kN, T up to {} kN{stoppers}",
            cyclic.amplitudes.len(),
            100.0 * cyclic.amplitudes.last().copied().unwrap_or_default(),
            cyclic.duration_s / 3600.0,
            kilo(cyclic.largest_force_n),
            kilo(cyclic.largest_tendon_n)
        )?;
    }
    if let Some(measured) = &report.measured {
        print_measured(&mut out, measured)?;
    }
    for warning in &report.warnings {
        writeln!(out, "warning    {warning}")?;
    }
    drop(out);
    print_files(&report.files, terminal)
}

fn head(out: &mut impl Write, report: &PushoverReport) -> Result<(), CommandError> {
    let PushoverReport { name, columns, width_m, height_m, slenderness_rad, .. } = report;
    writeln!(out, "structure  {name} ({})", shown_path(&report.file).display())?;
    writeln!(
        out,
        "           {} of {width_m} m x {height_m} m, slenderness {slenderness_rad:.4} rad",
        counted(*columns as usize, "column")
    )?;
    let (load, weight) = (kilo(report.top_load_n), kilo(report.column_weight_n));
    write!(out, "           each carries {load} kN and weighs {weight} kN")?;
    match report.axial_load_ratio {
        Some(ratio) => writeln!(out, ": {:.1} % of its strength", 100.0 * ratio)?,
        None => writeln!(out)?,
    }
    match report.anchorage {
        Some(anchorage) => writeln!(out, "           {} restrained, anchorage {anchorage}", report.restrained)?,
        None => writeln!(out, "           no restrainers")?,
    }
    writeln!(out, "force at uplift             {} kN", kilo(report.uplift_force_n))?;
    let capacity = &report.capacity;
    writeln!(out, "displacement capacity       {}", capacity_words(capacity.exact.as_ref()))?;
    if let Some(without) = &capacity.exact_without_stoppers {
        writeln!(out, "  without stoppers          {}", capacity_words(Some(without)))?;
    }
    let linear = capacity.linear_m.map_or_else(|| format!("none: {NO_CAPACITY_REASON}"), |m| format!("{m:.4} m"));
    let (k, critical) = (kilo(capacity.linear_stiffness_n_m), kilo(capacity.critical_stiffness_n_m));
    writeln!(out, "  linear                    {linear}, with {k} kN/m; critical {critical} kN/m")?;
    if report.restrained > 0 {
        let stiffness = kilo(capacity.equivalent_stiffness_n_m);
        writeln!(out, "stiffness of the equivalent oscillator's tendons {stiffness} kN/m")?;
    }
    Ok(())
}

fn capacity_words(capacity: Option<&Capacity>) -> String {
    let Some(capacity) = capacity else {
        return "none: the force does not vanish before the springs are flat".to_owned();
    };
    let restrainer = capacity.secant_n_m.map(|secant_n_m| format!(", restrainer {} kN/m", kilo(secant_n_m)));
    let springs = capacity.spring_m.map(|spring_m| format!(", springs pressed by {:.2} mm", 1e3 * spring_m));
    format!("{:.4} m{}{}", capacity.displacement_m, restrainer.unwrap_or_default(), springs.unwrap_or_default())
}

fn kilo(value: f64) -> String {
    let value = 1e-3 * value;
    let words = if value.abs() < 1000.0 { format!("{value:.3}") } else { format!("{value:.1}") };
    // at a neutral point rounding alone says which sign
    if words == "-0.000" { "0.000".to_owned() } else { words }
}

fn millimetres(value: Option<f64>) -> String {
    value.map_or("-".to_owned(), |value| format!("{:.2}", 1e3 * value))
}

/// Columns on the way of the structure in each row.
fn way<'a, T: Copy>(table: TableOf<T>, state: impl Fn(T) -> &'a PushoverState) -> TableOf<T> {
    table
        .right("u, m", |row| format!("{:.4}", state(row).displacement_m))
        .right("drift, %", |row| format!("{:.2}", 100.0 * state(row).drift))
        .right("F, kN", |row| kilo(state(row).force_n))
        .right("T, kN", |row| kilo(state(row).tendon_n))
        .right("springs, mm", |row| millimetres(state(row).spring_m))
}

fn print_measured(out: &mut impl Write, measured: &MeasuredCurve) -> Result<(), CommandError> {
    writeln!(out, "\nmeasured   {}, {} points", shown_path(&measured.file).display(), measured.points)?;
    let slope = |slope: Option<f64>| slope.map_or("-".to_owned(), kilo);
    let table = Table::from_rows([("+", &measured.positive), ("-", &measured.negative)])
        .left("side", |(name, _)| name)
        .right("peak, kN", |(_, side)| kilo(side.peak_n))
        .right("at drift, %", |(_, side)| format!("{:.2}", 100.0 * side.drift_at_peak))
        .right("slope 3-15 %, kN/m", |(_, side)| slope(side.slope_n_m))
        .right("computed", |(_, side)| slope(side.computed_slope_n_m));
    writeln!(out, "{table}")?;
    let mut cycles: Vec<_> = measured.cycles.iter().enumerate().collect();
    cycles.sort_by(|left, right| right.1.largest_m.total_cmp(&left.1.largest_m));
    let damping = |share: Option<f64>| share.map_or("-".to_owned(), |share| format!("{:.2}", 100.0 * share));
    let table = Table::from_rows(cycles.into_iter().take(CYCLES))
        .left("cycle", |(index, _)| index + 1)
        .right("u max, m", |(_, cycle)| format!("{:.4}", cycle.largest_m))
        .right("u min, m", |(_, cycle)| format!("{:.4}", cycle.least_m))
        .right("loop, J", |(_, cycle)| format!("{:.1}", cycle.dissipated_j))
        .right("equivalent damping, %", |(_, cycle)| damping(cycle.equivalent_damping));
    if !table.is_empty() {
        writeln!(out, "{table}")?;
    }
    Ok(())
}

/// Amplitudes and duration.
pub(crate) fn print_protocol(report: &ProtocolReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    let table = Table::from_rows(report.amplitudes.iter().enumerate())
        .left("set", |(index, _)| index + 1)
        .right("amplitude, %", |(_, amplitude)| format!("{:.3}", 100.0 * amplitude));
    writeln!(out, "{table}")?;
    writeln!(out, "duration {:.0} s, {:.1} h", report.duration_s, report.duration_s / 3600.0)?;
    drop(out);
    print_files(&report.files, terminal)
}
