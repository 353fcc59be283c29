//! `uplift export`: a result for other programs.

use clap::Args;
use uplift::Events;
use uplift::export::{ExportOptions, export as export_result};

use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    uplift export results/quick.h5 --xlsx\n  \
    uplift export results/quick.h5 --fragility openquake --strength 0.2 --displacement-m 0.1,0.3\n  \
    uplift export results/quick.h5 --fragility csv --structure configs/structures/pier.toml\n  \
    uplift export results/quick.h5 --demand Athens --return-period 475 --strength 0.2")]
pub(crate) struct ExportArguments {
    #[command(flatten)]
    options: ExportOptions,
}

pub(crate) fn export(arguments: &ExportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let report = export_result(&arguments.options, terminal)?;
    for note in &report.notes {
        terminal.note(note);
    }
    print_files(&report.files, terminal)
}
