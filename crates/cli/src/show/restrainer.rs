//! Restrainers in lines and tables.

use std::io::Write;

use uplift::restrainer::{RestrainerCurve, RestrainerDesign, stack_name};
use uplift::text::table;
use uplift_statics::Candidate;

use super::{print_files, shown_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// What it is, where its law changes, and the rows.
pub(crate) fn print_restrainer_curve(report: &RestrainerCurve, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    let RestrainerCurve { name, kind, anchorage, .. } = report;
    writeln!(out, "restrainer {name}: {kind}, anchorage {anchorage} ({})", shown_path(&report.file).display())?;
    if let Some(stack) = &report.stack {
        let parallel = if stack.parallel > 1 { format!(" packets of {}", stack.parallel) } else { String::new() };
        writeln!(
            out,
            "stack      {}{parallel} in alternate sense: flat at {:.2} mm and {} kN, {:.1} mm high, h0/t {:.3}, \
             K4 {:.4}",
            stack.springs,
            1e3 * stack.flat_deformation_m,
            kilo(stack.flat_force_n),
            1e3 * stack.free_height_m,
            stack.snap_ratio,
            stack.flats_factor
        )?;
    }
    if let Some(stiffness_n_m) = report.tendon_stiffness_n_m {
        writeln!(out, "tendon     {} kN/m", kilo(stiffness_n_m))?;
    }
    let optional =
        |value: Option<f64>, factor: f64| value.map_or("-".to_owned(), |value| format!("{:.2}", factor * value));
    if !report.events.is_empty() {
        let rows: Vec<Vec<String>> = report
            .events
            .iter()
            .map(|event| {
                vec![
                    event.event.to_owned(),
                    format!("{:.2}", 1e3 * event.elongation_m),
                    kilo(event.force_n),
                    optional(event.spring_m, 1e3),
                ]
            })
            .collect();
        writeln!(out, "\n{}", table(&["event", "elongation, mm", "T, kN", "springs, mm"], &rows))?;
    }
    let rows: Vec<Vec<String>> = report
        .rows
        .iter()
        .map(|row| {
            vec![
                format!("{:.2}", 1e3 * row.elongation_m),
                kilo(row.force_n),
                optional(row.secant_n_m, 1e-3),
                format!("{:.2}", 1e-3 * row.stiffness_n_m),
                optional(row.spring_m, 1e3),
                optional(row.spring_secant_n_m, 1e-3),
                format!("{:.1}", row.energy_j),
            ]
        })
        .collect();
    let header =
        ["elongation, mm", "T, kN", "secant, kN/m", "tangent, kN/m", "springs, mm", "their secant, kN/m", "energy, J"];
    writeln!(out, "\n{}", table(&header, &rows))?;
    drop(out);
    print_files(&report.files, terminal)
}

/// The target, the stacks, and what imperfections do to the first.
pub(crate) fn print_restrainer_design(report: &RestrainerDesign, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    writeln!(out, "structure  {} ({})", report.name, shown_path(&report.file).display())?;
    let target = &report.target;
    writeln!(out, "target     {}", target.words)?;
    writeln!(
        out,
        "           linear: {} kN/m; the force stays at {} kN/m",
        kilo(target.stiffness_n_m),
        kilo(target.critical_stiffness_n_m)
    )?;
    let (found, discs) = (report.found, report.discs);
    let shown = report.stacks.len();
    writeln!(out, "stacks     {found} of {discs} discs in {}", shown_path(&report.catalogue).display())?;
    let rows: Vec<Vec<String>> = report.stacks.iter().map(cells).collect();
    let header = [
        "stack",
        "miss, %",
        "secant, kN/m",
        "u, m",
        "T, kN",
        "of yield, %",
        "springs, mm",
        "of stroke, %",
        "u_cap, m",
        "linear",
        "length, m",
        "mass, kg",
        "price",
        "first",
    ];
    writeln!(out, "\n{}", table(&header, &rows))?;
    if shown < found {
        writeln!(out, "{} more: --most {found} shows them, -o FILE.csv writes them", found - shown)?;
    }
    if let Some(demand_m) = target.demand_m {
        let rows: Vec<Vec<String>> = report
            .stacks
            .iter()
            .zip(&report.at_demand)
            .map(|(stack, state)| vec![stack_name(stack), kilo(state.tendon_n), format!("{:.2}", 1e3 * state.spring_m)])
            .collect();
        let title = format!("at the demand, {demand_m:.4} m");
        writeln!(out, "\n{}", table(&[&title, "T, kN", "springs, mm"], &rows))?;
    }
    if !report.stoppers.is_empty() {
        let rows: Vec<Vec<String>> = report
            .stacks
            .iter()
            .zip(&report.stoppers)
            .map(|(stack, stopper)| {
                vec![
                    stack_name(stack),
                    stopper.engages_at_m.map_or("-".to_owned(), |at_m| format!("{at_m:.4}")),
                    kilo(stopper.engages_at_n),
                    stopper.most_yield_n.map_or("none".to_owned(), kilo),
                ]
            })
            .collect();
        writeln!(out, "\n{}", table(&["stopper of", "engages at u, m", "T, kN", "yield at most, kN"], &rows))?;
    }
    let rows: Vec<Vec<String>> = report
        .tolerances
        .iter()
        .map(|tolerance| {
            vec![
                tolerance.imperfection.clone(),
                tolerance.capacity_m.map_or("none".to_owned(), |capacity_m| format!("{capacity_m:.4}")),
                tolerance.change.map_or("-".to_owned(), |change| format!("{:+.1}", 100.0 * change)),
            ]
        })
        .collect();
    let title = format!("{} with", report.tolerances_of);
    writeln!(out, "\n{}", table(&[&title, "u_cap, m", "change, %"], &rows))?;
    drop(out);
    print_files(&report.files, terminal)
}

fn cells(stack: &Candidate) -> Vec<String> {
    let metres = |value: Option<f64>| value.map_or("none".to_owned(), |value| format!("{value:.4}"));
    vec![
        stack_name(stack),
        format!("{:+.1}", 100.0 * stack.miss),
        format!("{:.0}", 1e-3 * stack.secant_n_m),
        format!("{:.4}", stack.at_m),
        kilo(stack.tendon_n),
        stack.tendon_utilisation.map_or("-".to_owned(), |share| format!("{:.0}", 100.0 * share)),
        format!("{:.2}", 1e3 * stack.spring_m),
        format!("{:.0}", 100.0 * stack.stroke_share),
        metres(stack.capacity_m),
        metres(stack.linear_capacity_m),
        format!("{:.3}", stack.length_m),
        format!("{:.2}", stack.mass_kg),
        stack.price.map_or("-".to_owned(), |price| format!("{price:.2}")),
        stack.first.map_or("-".to_owned(), |(event, at_m)| format!("{} at {at_m:.3} m", event.words())),
    ]
}

fn kilo(value: f64) -> String {
    let value = 1e-3 * value;
    if value.abs() < 1000.0 { format!("{value:.2}") } else { format!("{value:.0}") }
}
