//! What the user can type.

mod arguments;
mod hazard;
mod manual;
mod protocol;
mod pulse;
mod pushover;
mod records;
mod response;
mod restrainer;
mod result;
mod schema;
mod structures;
mod study;
mod validate;

use clap::{Parser, Subcommand};

use uplift_oscillator::InstructionSet;

use crate::error::CommandError;
use crate::terminal::{Form, Terminal};
use result::{bootstrap, consistency, export, influence, measures, plot, report, status, table, verify};
use structures::{design, overturning, risk, target};
use study::{check, merge, run, sweep};

/// Uniform risk spectra for rocking structures.
///
/// From ground motions and site hazard to the displacement that a structure of a given uplift strength must survive so
/// that its annual risk is what the engineer chose.
#[derive(Debug, Parser)]
#[command(name = "uplift", version = uplift::VERSION_AND_COMMIT, max_term_width = 100)]
#[command(
    after_help = "Exit codes: 0 done, 2 usage, 3 study or structure file, 4 input data or disk, 5 interrupted, 1 a \
                  bug.\n\
    Start with: uplift run configs/quick.toml"
)]
pub(crate) struct Arguments {
    /// Threads to use; the numbers do not depend on it [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    /// Only what was asked for, and errors: no progress, no remarks, no summary of files that are written
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// How progress, remarks and errors are told on standard error: text for people, or a line of JSON for each event
    #[arg(long, global = true, value_name = "FORM", value_enum, default_value = "text")]
    pub(crate) progress: Form,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a study: uniform risk spectra with their coefficients, displacement spectra of record sets, or the tests of
    /// a shaking table; one result file
    Run(run::RunArguments),
    /// Join the shards of a run into its result
    Merge(merge::MergeArguments),
    /// How far a run is, and what a result holds
    Status(status::StatusArguments),
    /// Check that every byte of a result is as it was written
    Verify(verify::VerifyArguments),
    /// Check a study and its input data, and say what it would cost
    Check(check::CheckArguments),
    /// Run variants of a study, each an ordinary result, and compare them
    Sweep(sweep::SweepArguments),
    /// Shake one oscillator or one rigid block with one record, or a rocking frame with its components
    Response(response::ResponseArguments),
    /// Rocking spectra of a rigid block under Ricker wavelets: figures and tables (Figures 2.2 to 2.7)
    Pulse(pulse::PulseArguments),
    /// How sure the spectra are: confidence bands from resampled records (Table 4.1)
    Bootstrap(bootstrap::BootstrapArguments),
    /// Whether the records bring the site's hazard of the other measure, and weights by which they do
    Consistency(consistency::ConsistencyArguments),
    /// Which records carry the spectra (jackknife), and which intensities (disaggregation)
    Influence(influence::InfluenceArguments),
    /// Which intensity measure to trust: efficiency and sufficiency
    Measures(measures::MeasuresArguments),
    /// Design a structure by a spectrum, and test the design by the structure's own risk
    Design(design::DesignArguments),
    /// How often a structure overturns: collapse fragility and risk, by oscillator and rigid block
    Overturning(overturning::OverturningArguments),
    /// The risk of a rocking frame itself, wobbling under both components, beside what its proxies say (Chapter 6)
    Risk(risk::FrameRiskArguments),
    /// Find the least strength, size, width, capacity or tendon stiffness for a target risk
    Target(Box<target::TargetArguments>),
    /// Push columns sideways: force, restrainer, sections and events over the displacement (Chapters 5 and 6)
    Pushover(pushover::PushoverArguments),
    /// Cyclic loading protocols: amplitudes that grow from set to set (Figure 5.11)
    Protocol(protocol::ProtocolArguments),
    /// Restrainers of tendons and disc springs: their force, and stacks out of a catalogue
    Restrainer(Box<restrainer::RestrainerArguments>),
    /// Whether computed peaks are distributed as measured ones: tests, power, bands, by class and level (Section 6.8)
    Validate(validate::ValidateArguments),
    /// Bring record files: import a folder, list, show, choose, synthesize
    Records(records::RecordsArguments),
    /// Bring hazard curves: take them from the exports of engines, show, draw
    Hazard(hazard::HazardArguments),
    /// Draw the figures of a result, or of a structure's columns
    Plot(plot::PlotArguments),
    /// Write one page with everything, to hand over: HTML that needs no network
    Report(report::ReportArguments),
    /// Write spectra, bands and coefficients of a result as an Excel workbook, CSV, JSON or a MATLAB file
    Export(export::ExportArguments),
    /// Print the coefficients of a result (Table 4.2), its design example (Tables 2.1-2.3, 3.2-3.7) or its tests (Table
    /// A1.1), beside a reference if one is given; or what the columns of a structure have (Table 5.1, Section 6.3)
    Table(table::TableArguments),
    /// Print the JSON Schema by which editors complete and check keys
    Schema(schema::SchemaArguments),
    /// Write the pages of the manual and the completions of the shells
    #[command(hide = true)]
    Manual(manual::ManualArguments),
}

/// Carry out what was typed.
///
/// # Errors
/// Whatever the user should know; see [`CommandError::exit_code`].
pub(crate) fn execute(arguments: &Arguments, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(threads) = arguments.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(threads))
            .build_global()
            .map_err(|error| CommandError::Usage(format!("--threads {threads}: {error}")))?;
    }
    // a word that is none is told by every command, whether it computes or not
    InstructionSet::chosen().map_err(|error| CommandError::Usage(error.to_string()))?;
    match &arguments.command {
        Command::Run(arguments) => run::run(arguments, terminal),
        Command::Merge(arguments) => merge::merge(arguments, terminal),
        Command::Status(arguments) => status::status(arguments),
        Command::Verify(arguments) => verify::verify(arguments, terminal),
        Command::Check(arguments) => check::check(arguments, terminal),
        Command::Sweep(arguments) => sweep::sweep(arguments, terminal),
        Command::Response(arguments) => response::response(arguments, terminal),
        Command::Pulse(arguments) => pulse::pulse(arguments, terminal),
        Command::Bootstrap(arguments) => bootstrap::bootstrap(arguments, terminal),
        Command::Consistency(arguments) => consistency::consistency(arguments, terminal),
        Command::Influence(arguments) => influence::influence(arguments, terminal),
        Command::Measures(arguments) => measures::measures(arguments, terminal),
        Command::Design(arguments) => design::design(arguments, terminal),
        Command::Overturning(arguments) => overturning::overturning(arguments, terminal),
        Command::Risk(arguments) => risk::risk(arguments, terminal),
        Command::Target(arguments) => target::target(arguments, terminal),
        Command::Pushover(arguments) => pushover::pushover(arguments, terminal),
        Command::Protocol(arguments) => protocol::protocol(arguments, terminal),
        Command::Restrainer(arguments) => restrainer::restrainer(arguments, terminal),
        Command::Validate(arguments) => validate::validate(arguments, terminal),
        Command::Records(arguments) => records::records(arguments, terminal),
        Command::Hazard(arguments) => hazard::hazard(arguments, terminal),
        Command::Plot(arguments) => plot::plot(arguments, terminal),
        Command::Report(arguments) => report::report(arguments, terminal),
        Command::Export(arguments) => export::export(arguments, terminal),
        Command::Table(arguments) => table::table(arguments, terminal),
        Command::Schema(arguments) => schema::schema(arguments),
        Command::Manual(arguments) => manual::manual(arguments),
    }
}
