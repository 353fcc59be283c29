//! What a study would cost.

use std::io::Write;

use uplift::Plan;
use uplift::alarms::Severity;
use uplift::machine::Limit;
use uplift::text::{bytes, share, thousands};
use uplift::uniform_risk::LevelCheck;
use uplift_study::AnyStudy;

use super::consistency::consistency_lines;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The plan of `study`, which a terminal that is not quiet shows with every default filled in.
pub(crate) fn print_plan(plan: &Plan, study: &AnyStudy, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    if !terminal.is_quiet() {
        let toml = study.to_toml().map_err(|error| CommandError::input(error.to_string()))?;
        writeln!(out, "# The study with every default filled in\n{}", toml.trim_end())?;
        writeln!(out, "\n# The plan")?;
    }
    let head = plan.head();
    writeln!(out, "records   {}", head.record_set)?;
    if let Plan::Displacement(plan) = plan {
        for set in &plan.sets {
            writeln!(
                out,
                "set       {}: {} records, {} motions, median PGA {:.3} g, median PGV {:.1} cm/s",
                set.name, set.records, set.motions, set.median_pga_g, set.median_pgv_cm_s
            )?;
        }
    }
    writeln!(out, "analyses  {}", thousands(head.analyses))?;
    if let Plan::Displacement(plan) = plan {
        writeln!(out, "rounding  {} more, of the ordinates that are printed", thousands(plan.rounding_analyses))?;
    }
    match plan {
        Plan::Displacement(plan) if plan.has_design => {
            writeln!(out, "design    about {} more", thousands(plan.design_analyses))?;
        }
        Plan::UniformRisk(plan) => {
            for check in &plan.levels {
                writeln!(out, "levels    {}", levels(check))?;
            }
            for line in consistency_lines(&plan.consistency) {
                writeln!(out, "hazard    {line}")?;
            }
        }
        Plan::ShakeTable(plan) => {
            writeln!(out, "tests     {} excitations at {} levels", plan.excitations, plan.levels)?;
        }
        Plan::Displacement(_) => {}
    }
    writeln!(out, "time      about {} on {} threads", duration(head.seconds), head.threads)?;
    let room = &head.room;
    let there = |limit: &Option<Limit>, words: &str| {
        limit.as_ref().map_or(String::new(), |limit| format!(", of {} {words}", bytes(limit.bytes)))
    };
    writeln!(out, "memory    about {}{}", bytes(head.memory_bytes), there(&room.memory_available, "that are free"))?;
    writeln!(
        out,
        "disk      at most about {}{}: {}",
        bytes(head.disk_bytes),
        there(&room.disk_free, "that are free"),
        head.output.display()
    )?;
    for alarm in &head.alarms {
        writeln!(out, "{:<8}  {alarm}", alarm.severity.word())?;
        if !alarm.what_to_do.is_empty() {
            writeln!(out, "          {}", alarm.what_to_do)?;
        }
    }
    for note in &room.tight {
        writeln!(out, "note      {note}")?;
    }
    for note in &head.notes {
        writeln!(out, "note      {note}")?;
    }
    if room.cannot.is_empty() {
        writeln!(out, "{}", conclusion(plan))?;
    }
    Ok(())
}

/// Whether it can be run, and which of the lines above are to be seen first.
fn conclusion(plan: &Plan) -> String {
    let head = plan.head();
    let grave = head.alarms.iter().filter(|alarm| alarm.severity < Severity::Note);
    let mut marks: Vec<&str> = grave.map(|alarm| alarm.severity.word()).collect();
    marks.dedup();
    if let Plan::UniformRisk(plan) = plan
        && plan.consistency.rows.iter().any(|row| row.verdict == Some("inconsistent"))
    {
        marks.push("hazard");
    }
    let run = match (head.would_replace, &marks[..]) {
        (true, _) => "A run would be refused: its result file is that of another, see the last note.",
        (false, []) => return "The study and its input data are in order.".to_owned(),
        (false, _) => "The study can be run.",
    };
    match &marks[..] {
        [] => run.to_owned(),
        [one] => format!("{run} See first what is marked {one} above."),
        [first @ .., last] => format!("{run} See first what is marked {} and {last} above.", first.join(", ")),
    }
}

/// How far down and up the levels of a measure reach, and a line for the study where that is not far enough.
fn levels(check: &LevelCheck) -> String {
    let LevelCheck { im, unit, first_level, lower_tail_share, last_level, upper_tail_share, too_high_for, .. } = check;
    let strengths: Vec<String> = check.strengths.iter().map(|strength| format!("{strength:.3}")).collect();
    let found = format!(
        "{im}: at the strengths tried, {}, up to {} of the risk of an ordinate lies below the first level, \
         {first_level} {unit}, and up to {} above the last, {last_level} {unit}",
        strengths.join(", "),
        share(*lower_tail_share),
        share(*upper_tail_share)
    );
    let Some(worst) = too_high_for.first() else { return found };
    let others = match too_high_for.len() {
        1 => String::new(),
        count => format!(", worst of {count}"),
    };
    let remedy = match &check.proposal {
        Some(proposal) => {
            let (section, key) = proposal.line.split_once('.').unwrap_or(("", &proposal.line));
            format!("begin lower, and up to {} does: in [{section}] {key}", share(proposal.lower_tail_share))
        }
        None => "the hazard curves begin too high to begin lower: take curves from further down".to_owned(),
    };
    format!("{found}; the first is too high for {worst}{others}, whose ordinates come out too large; {remedy}")
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
