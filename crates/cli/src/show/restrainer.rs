//! Restrainers in lines and tables.

use std::io::Write;
use std::path::Path;

use uplift::restrainer::{RestrainerCurve, RestrainerDesign, stack_name};
use uplift::structure::verdict_word;
use uplift::text::{Table, TableOf, counted};
use uplift_statics::Candidate;

use super::alarms::print_warnings;
use super::{print_files, print_more, shown_path};
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
        let table = Table::from_rows(&report.events)
            .left("event", |event| event.event)
            .right("elongation, mm", |event| format!("{:.2}", 1e3 * event.elongation_m))
            .right("T, kN", |event| kilo(event.force_n))
            .right("springs, mm", |event| optional(event.spring_m, 1e3));
        writeln!(out, "\n{table}")?;
    }
    let table = Table::from_rows(&report.rows)
        .left("elongation, mm", |row| format!("{:.2}", 1e3 * row.elongation_m))
        .right("T, kN", |row| kilo(row.force_n))
        .right("secant, kN/m", |row| optional(row.secant_n_m, 1e-3))
        .right("tangent, kN/m", |row| format!("{:.2}", 1e-3 * row.stiffness_n_m))
        .right("springs, mm", |row| optional(row.spring_m, 1e3))
        .right("their secant, kN/m", |row| optional(row.spring_secant_n_m, 1e-3))
        .right("energy, J", |row| format!("{:.1}", row.energy_j));
    writeln!(out, "\n{table}")?;
    drop(out);
    print_files(&report.files, terminal)
}

/// Stacks in the answer where nothing says how many.
const MOST: usize = 3;

/// The best stacks, as many as asked for; in detail all of them, their states, and what imperfections do to the first.
pub(crate) fn print_restrainer_design(
    report: &RestrainerDesign,
    most: Option<usize>,
    urs: Option<&Path>,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    let mut out = output();
    print_best(&mut out, report, most.unwrap_or(MOST))?;
    if terminal.shows_details() && report.found > 0 {
        print_details(&mut out, report)?;
    }
    print_warnings(&mut out, &report.alarms, urs, terminal)?;
    print_more(&mut out, terminal)?;
    drop(out);
    print_files(&report.files, terminal)
}

/// The best stack, and the next ones.
fn print_best(out: &mut impl Write, report: &RestrainerDesign, most: usize) -> Result<(), CommandError> {
    let (name, words) = (&report.name, frame_words(report));
    if let Some(best) = report.stacks.first() {
        writeln!(out, "Stack     {} for {name}{words}", stack_name(best))?;
    } else {
        let has = format!("the columns have {:.4} m without any restrainer", report.target.free_capacity_m);
        writeln!(out, "Stack     none needed by the oscillator of {name}: {has}{words}")?;
    }
    if let Some(reason) = &report.without_frame {
        writeln!(out, "Frame     left out: {reason}")?;
    }
    writeln!(out, "Target    {}", report.target.words)?;
    if report.found > 0 {
        let (found, discs) = (counted(report.found, "stack"), report.discs);
        writeln!(out, "Found     {found} of {discs} discs in {}", shown_path(&report.catalogue).display())?;
    }
    let table = Table::from_rows(report.stacks.iter().take(most))
        .left("stack", stack_name)
        .right("off target, %", |stack| format!("{:+.1}", 100.0 * stack.miss))
        .right("T, kN", |stack| kilo(stack.tendon_n))
        .right("of stroke, %", |stack| format!("{:.0}", 100.0 * stack.stroke_share))
        .right("u_cap, m", |stack| metres_or("none", stack.capacity_m));
    if table.is_empty() { Ok(()) } else { Ok(writeln!(out, "\n{table}")?) }
}

/// What the frame itself says of the best stack.
fn frame_words(report: &RestrainerDesign) -> String {
    let Some(frame) = &report.frame else {
        return if report.proxy && report.found > 0 { ", by its oscillator alone".to_owned() } else { String::new() };
    };
    let own = frame.decisive();
    let Some(check) = own.check else { return String::new() };
    // each takes analyses of its own
    let others = if check.satisfied || report.found < 2 { "" } else { " (other stacks not tried)" };
    let without = if report.found == 0 { "without tendons " } else { "" };
    let verdict = format!("{without}{}", verdict_word(check.satisfied));
    if check.required_capacity_m.is_infinite() {
        return format!("; {verdict} by the {}, which overturns more often than the target{others}", own.model);
    }
    let [demand_m, required_m] = [own.demand_m, check.required_capacity_m];
    format!("; {verdict} by the {}, which moves {demand_m:.2} m and requires {required_m:.2} m{others}", own.model)
}

fn print_details(out: &mut impl Write, report: &RestrainerDesign) -> Result<(), CommandError> {
    writeln!(out, "\nstructure  {} ({})", report.name, shown_path(&report.file).display())?;
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
    writeln!(out, "\n{}", stacks(&report.stacks))?;
    if shown < found {
        writeln!(out, "{} more: --most {found} shows them, -o FILE.csv writes them", found - shown)?;
    }
    if let Some(demand_m) = target.demand_m {
        let table = Table::from_rows(report.stacks.iter().zip(&report.at_demand))
            .left(format!("at the demand, {demand_m:.4} m"), |(stack, _)| stack_name(stack))
            .right("T, kN", |(_, state)| kilo(state.tendon_n))
            .right("springs, mm", |(_, state)| format!("{:.2}", 1e3 * state.spring_m));
        writeln!(out, "\n{table}")?;
    }
    if !report.stoppers.is_empty() {
        let table = Table::from_rows(report.stacks.iter().zip(&report.stoppers))
            .left("stopper of", |(stack, _)| stack_name(stack))
            .right("engages at u, m", |(_, stopper)| metres_or("-", stopper.engages_at_m))
            .right("T, kN", |(_, stopper)| kilo(stopper.engages_at_n))
            .right("yield at most, kN", |(_, stopper)| stopper.most_yield_n.map_or("none".to_owned(), kilo));
        writeln!(out, "\n{table}")?;
    }
    let change = |change: Option<f64>| change.map_or("-".to_owned(), |change| format!("{:+.1}", 100.0 * change));
    let table = Table::from_rows(&report.tolerances)
        .left(format!("{} with", report.tolerances_of), |tolerance| &tolerance.imperfection)
        .right("u_cap, m", |tolerance| metres_or("none", tolerance.capacity_m))
        .right("change, %", |tolerance| change(tolerance.change));
    Ok(writeln!(out, "\n{table}")?)
}

fn stacks(stacks: &[Candidate]) -> TableOf<&Candidate> {
    let or_dash = |value: Option<f64>, factor: f64, digits: usize| {
        value.map_or("-".to_owned(), |value| format!("{:.digits$}", factor * value))
    };
    Table::from_rows(stacks)
        .left("stack", stack_name)
        .right("off target, %", |stack| format!("{:+.1}", 100.0 * stack.miss))
        .right("secant, kN/m", |stack| format!("{:.0}", 1e-3 * stack.secant_n_m))
        .right("u, m", |stack| format!("{:.4}", stack.at_m))
        .right("T, kN", |stack| kilo(stack.tendon_n))
        .right("of yield, %", |stack| or_dash(stack.tendon_utilisation, 100.0, 0))
        .right("springs, mm", |stack| format!("{:.2}", 1e3 * stack.spring_m))
        .right("of stroke, %", |stack| format!("{:.0}", 100.0 * stack.stroke_share))
        .right("u_cap, m", |stack| metres_or("none", stack.capacity_m))
        .right("linear", |stack| metres_or("none", stack.linear_capacity_m))
        .right("length, m", |stack| format!("{:.3}", stack.length_m))
        .right("mass, kg", |stack| format!("{:.2}", stack.mass_kg))
        .right("price", |stack| or_dash(stack.price, 1.0, 2))
        .right("first", |stack| {
            stack.first.map_or("-".to_owned(), |(event, at_m)| format!("{} at {at_m:.3} m", event.words()))
        })
}

fn metres_or(none: &str, value: Option<f64>) -> String {
    value.map_or(none.to_owned(), |value| format!("{value:.4}"))
}

fn kilo(value: f64) -> String {
    let value = 1e-3 * value;
    if value.abs() < 1000.0 { format!("{value:.2}") } else { format!("{value:.0}") }
}
