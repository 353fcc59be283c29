//! What the jobs report, as a person reads it; a program gets the same values as JSON.

mod alarms;
mod bootstrap;
mod consistency;
mod design;
mod displacement;
mod efficiency;
mod frame_response;
mod frame_risk;
mod hazard;
mod import;
mod influence;
mod library;
mod overturning;
mod plan;
mod pulse;
mod pushover;
mod records;
mod response;
mod restrainer;
mod run;
mod shake_table;
mod spectrum;
mod status;
mod structure;
mod sweep;
mod table;
mod target;
mod uncertainty;
mod validate;
mod verify;

pub(crate) use alarms::print_all_warnings;
pub(crate) use bootstrap::print_bootstrap;
pub(crate) use consistency::print_consistency;
pub(crate) use design::print_design;
pub(crate) use efficiency::print_efficiency;
pub(crate) use frame_response::print_frame_response;
pub(crate) use frame_risk::print_frame_risk;
pub(crate) use hazard::{print_curves, print_hazard_import};
pub(crate) use import::{print_import, tell_remarks};
pub(crate) use influence::print_influence;
pub(crate) use library::print_library;
pub(crate) use overturning::print_overturning;
pub(crate) use plan::{print_plan, print_study};
pub(crate) use pulse::print_pulses;
pub(crate) use pushover::{print_protocol, print_pushover};
pub(crate) use records::{print_at_level, print_record, print_records, print_selection};
pub(crate) use response::{print_block_response, print_response};
pub(crate) use restrainer::{print_restrainer_curve, print_restrainer_design};
pub(crate) use run::{print_run, print_run_json, print_shard};
pub(crate) use spectrum::{print_spectrum, print_spectrum_csv};
pub(crate) use status::print_status;
pub(crate) use sweep::print_sweep;
pub(crate) use table::print_table;
pub(crate) use target::print_target;
pub(crate) use validate::print_validation;
pub(crate) use verify::print_verified;

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::Value;
use uplift::alarms::name_result;
pub(crate) use uplift::text::{shown_path, typed_path};

use crate::error::CommandError;
use crate::terminal::{Terminal, output, visible_json};

pub(crate) fn print_json(report: &impl Serialize) -> Result<(), CommandError> {
    print_value(&json(report)?)
}

/// The same of an answer from `result`, which the commands of its warnings name.
pub(crate) fn print_answer_json(report: &impl Serialize, result: &Path) -> Result<(), CommandError> {
    let mut value = json(report)?;
    name_result(&mut value, &typed_path(result));
    print_value(&value)
}

fn json(report: &impl Serialize) -> Result<Value, CommandError> {
    serde_json::to_value(report).map_err(|error| CommandError::input(error.to_string()))
}

fn print_value(value: &Value) -> Result<(), CommandError> {
    Ok(writeln!(output(), "{}", visible_json(&format!("{value:#}")))?)
}

/// Files that were written; a quiet terminal shows none.
pub(crate) fn print_files(files: &[PathBuf], terminal: &Terminal) -> Result<(), CommandError> {
    if !terminal.is_quiet() {
        let mut out = output();
        for file in files {
            writeln!(out, "{}", shown_path(file).display())?;
        }
    }
    Ok(())
}

/// That there is more to see, unless all of it is shown.
fn print_more(out: &mut impl Write, terminal: &Terminal) -> Result<(), CommandError> {
    if terminal.shows_details() || terminal.is_quiet() { Ok(()) } else { Ok(writeln!(out, "Details  --details")?) }
}

/// What an asterisk says of a number of displacement spectra and their designs.
const ROUNDING_DECIDES: &str = "*: the last digits are not significant (rounding, docs/method.md, section 1.5)";
