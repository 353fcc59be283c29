//! What a study would cost.

use std::io::Write;

use uplift::Plan;
use uplift::machine::Limit;
use uplift::text::{bytes, share, thousands};
use uplift::uniform_risk::LevelCheck;
use uplift_study::AnyStudy;

use super::alarms::{is_doubted, print_lines, told, warning};
use super::consistency::consistency_lines;
use super::shown_path;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// What a study costs, what to see first, and whether it can be run; in detail the levels and hazard behind it. A quiet
/// terminal gets the verdict, the cost and probable mistakes.
pub(crate) fn print_plan(plan: &Plan, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    let head = plan.head();
    let room = &head.room;
    let there = |limit: &Option<Limit>| {
        limit.as_ref().map_or(String::new(), |limit| format!(" of {} free", bytes(limit.bytes)))
    };
    let (analyses, time) = (thousands(head.analyses), duration(head.seconds));
    writeln!(out, "{}: {analyses} analyses, about {time} on {} threads", verdict(plan), head.threads)?;
    writeln!(out, "Records   {}", head.record_set)?;
    let (memory, disk) = (bytes(head.memory_bytes), bytes(head.disk_bytes));
    let (memory_free, disk_free) = (there(&room.memory_available), there(&room.disk_free));
    writeln!(out, "Memory    {memory}{memory_free}; disk {disk}{disk_free}")?;
    writeln!(out, "Result    {}", shown_path(&head.output).display())?;
    if terminal.shows_details() {
        print_details(&mut out, plan)?;
    }
    // a warning of a run may say "(uplift check)", which is this command
    let own = |alarm| warning(alarm, None).replace("(uplift check)", "as proposed");
    let warnings: Vec<_> = told(&head.alarms, terminal).map(own).collect();
    print_lines(&mut out, &warnings, terminal.shows_details() || terminal.is_quiet())?;
    if terminal.is_quiet() {
        return Ok(());
    }
    if let Plan::UniformRisk(plan) = plan {
        for proposal in plan.levels.iter().filter_map(|check| check.proposal.as_ref()) {
            let (section, key) = proposal.line.split_once('.').unwrap_or(("", &proposal.line));
            writeln!(out, "  Proposed: [{section}] {key}")?;
        }
    }
    for note in room.tight.iter().chain(&head.notes) {
        writeln!(out, "Note      {note}")?;
    }
    Ok(())
}

/// The study with every default filled in.
pub(crate) fn print_study(study: &AnyStudy) -> Result<(), CommandError> {
    let toml = study.to_toml().map_err(|error| CommandError::input(error.to_string()))?;
    Ok(writeln!(output(), "{}", toml.trim_end())?)
}

/// What stands behind the cost and the warnings.
fn print_details(out: &mut impl Write, plan: &Plan) -> Result<(), CommandError> {
    match plan {
        Plan::Displacement(plan) => {
            for set in &plan.sets {
                writeln!(
                    out,
                    "Set       {}: {} records, {} motions, median PGA {:.3} g, median PGV {:.1} cm/s",
                    set.name, set.records, set.motions, set.median_pga_g, set.median_pgv_cm_s
                )?;
            }
            let rounding = thousands(plan.rounding_analyses);
            writeln!(out, "Rounding  {rounding} more analyses, of the ordinates that are printed")?;
            if plan.has_design {
                writeln!(out, "Design    about {} more analyses", thousands(plan.design_analyses))?;
            }
        }
        Plan::UniformRisk(plan) => {
            for check in &plan.levels {
                writeln!(out, "Levels    {}", levels(check))?;
            }
            for line in consistency_lines(&plan.consistency) {
                writeln!(out, "Hazard    {line}")?;
            }
        }
        Plan::ShakeTable(plan) => {
            writeln!(out, "Tests     {} excitations at {} levels", plan.excitations, plan.levels)?;
        }
    }
    Ok(())
}

/// Whether it can be run.
fn verdict(plan: &Plan) -> &'static str {
    let head = plan.head();
    if head.would_replace.is_some() {
        "A run would be refused, since its result file belongs to another study, see below"
    } else if !head.room.cannot.is_empty() {
        "There is no room for a run, see below"
    } else if is_doubted(&head.alarms) {
        "The study can be run, subject to the mistake? below"
    } else {
        "The study can be run"
    }
}

/// Strengths tried that are named one by one.
const STRENGTHS_NAMED: usize = 5;

/// How far down and up the levels of a measure reach.
fn levels(check: &LevelCheck) -> String {
    let LevelCheck { im, unit, first_level, lower_tail_share, last_level, upper_tail_share, .. } = check;
    let strengths = match &check.strengths[..] {
        [first, .., last] if check.strengths.len() > STRENGTHS_NAMED => {
            format!("{} from {first:.3} to {last:.3}", check.strengths.len())
        }
        few => few.iter().map(|strength| format!("{strength:.3}")).collect::<Vec<_>>().join(", "),
    };
    format!(
        "{im}, at the strengths tried ({strengths}): up to {} of the risk lies below the first level, {first_level} \
         {unit}, up to {} above the last, {last_level} {unit}",
        share(*lower_tail_share),
        share(*upper_tail_share)
    )
}

/// A time for people.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "a second".to_owned(),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
