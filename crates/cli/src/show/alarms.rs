//! What is to be known before numbers are used, the same wherever they are shown.

use std::io::Write;

use uplift::alarms::Alarm;

use crate::error::CommandError;

/// Alarms printed; all of them are in what `--json` prints.
const SHOWN: usize = 12;

/// The alarms, the worst first, each with what to do; nothing where there are none.
pub(super) fn print_alarms(out: &mut impl Write, alarms: &[Alarm]) -> Result<(), CommandError> {
    if alarms.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nBefore you use these numbers:")?;
    for alarm in alarms.iter().take(SHOWN) {
        writeln!(out, "  {:<8}  {alarm}", alarm.severity.word())?;
        if !alarm.what_to_do.is_empty() {
            writeln!(out, "            {}", alarm.what_to_do)?;
        }
    }
    if alarms.len() > SHOWN {
        writeln!(out, "  {} more with --json", alarms.len() - SHOWN)?;
    }
    Ok(())
}
