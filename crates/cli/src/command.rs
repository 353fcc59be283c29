//! What the user can type.

mod arguments;
mod hazard;
mod library;
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

use std::fmt::Write as _;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use uplift_instructions::InstructionSet;
use uplift_study::did_you_mean;

use crate::error::CommandError;
use crate::terminal::{Form, Terminal, tell};
use result::{
    bootstrap, consistency, export, influence, measures, plot, report, spectrum, status, table, verify, warnings,
};
use structures::{design, overturning, risk, target};
use study::{check, init, merge, run, sweep};

/// What every command takes.
const GENERAL: &str = "General options";

/// Uniform risk spectra for rocking structures.
///
/// From ground motions and site hazard to the displacement that a structure of a given uplift strength must accommodate
/// so that its annual risk is what the engineer chose.
#[derive(Debug, Parser)]
#[command(name = "uplift", version = uplift::VERSION_AND_COMMIT, max_term_width = 100)]
#[command(after_help = "Start with:\n  uplift init first\n  uplift run first/study.toml\n\n\
    Exit codes: 0 done, 2 usage, 3 study or structure file, 4 input data or disk, 5 interrupted, 1 a bug")]
pub(crate) struct Arguments {
    /// Number of threads; results do not depend on it [default: all cores]
    #[arg(
        long,
        global = true,
        help_heading = GENERAL,
        value_name = "N",
        value_parser = clap::value_parser!(u16).range(1..=4096)
    )]
    threads: Option<u16>,
    /// Print only results, probable mistakes and errors
    #[arg(long, short, global = true, help_heading = GENERAL)]
    pub(crate) quiet: bool,
    /// Show every table and warning
    #[arg(long, global = true, help_heading = GENERAL)]
    pub(crate) details: bool,
    /// Form of progress and errors on standard error
    #[arg(long, global = true, help_heading = GENERAL, value_name = "FORM", value_enum, default_value = "text")]
    pub(crate) progress: Form,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Write a small study to start from
    Init(init::InitArguments),
    /// Run a study
    Run(run::RunArguments),
    /// Check a study and estimate its cost
    Check(check::CheckArguments),
    /// Show the progress of a run or the content of a result
    Status(status::StatusArguments),
    /// Run variants of a study and compare them
    Sweep(sweep::SweepArguments),
    /// Join the shards of a run
    Merge(merge::MergeArguments),
    /// Check that results are as they were written
    Verify(verify::VerifyArguments),
    /// Print the JSON Schema for editors
    Schema(schema::SchemaArguments),
    /// Import and manage records
    Records(records::RecordsArguments),
    /// Import and show hazard curves
    Hazard(hazard::HazardArguments),
    /// Read displacements at any strength and return period
    Spectrum(spectrum::SpectrumArguments),
    /// Compute confidence bands
    Bootstrap(bootstrap::BootstrapArguments),
    /// Check and repair hazard consistency
    Consistency(consistency::ConsistencyArguments),
    /// Find the records and intensities that matter
    Influence(influence::InfluenceArguments),
    /// Rank intensity measures
    Measures(measures::MeasuresArguments),
    /// List the warnings about the spectra of a result
    ///
    /// Notes on the repair of its records: `uplift consistency RESULT --details`.
    Warnings(warnings::WarningsArguments),
    /// Check a structure against a spectrum
    Design(design::DesignArguments),
    /// Compute how often a structure overturns
    Overturning(overturning::OverturningArguments),
    /// Compute the risk of a rocking frame
    Risk(risk::FrameRiskArguments),
    /// Find the least size or strength for a target risk
    Target(Box<target::TargetArguments>),
    /// Design restrainers of tendons and disc springs
    Restrainer(Box<restrainer::RestrainerArguments>),
    /// Push columns sideways
    Pushover(pushover::PushoverArguments),
    /// Shake a structure with one record
    Response(response::ResponseArguments),
    /// Compute a library of rocking response
    Library(library::LibraryArguments),
    /// Write a page with figures and tables
    Report(report::ReportArguments),
    /// Draw figures
    Plot(plot::PlotArguments),
    /// Write CSV, Excel, JSON or MATLAB files
    Export(export::ExportArguments),
    /// Print coefficients, design example or tests
    Table(table::TableArguments),
    /// Compute rocking spectra under wavelets
    Pulse(pulse::PulseArguments),
    /// Make cyclic loading protocols
    Protocol(protocol::ProtocolArguments),
    /// Compare computed with measured peaks
    Validate(validate::ValidateArguments),
    /// Write manual pages and shell completions
    #[command(hide = true)]
    Manual(manual::ManualArguments),
}

/// The commands by what they are for, in the order of the help.
const GROUPS: [(&str, &[&str]); 6] = [
    ("Study", &["init", "run", "check", "status", "sweep", "merge", "verify", "schema"]),
    ("Data", &["records", "hazard"]),
    ("Spectrum", &["spectrum", "bootstrap", "consistency", "influence", "measures", "warnings"]),
    ("Structure", &["design", "overturning", "risk", "target", "restrainer", "pushover", "response", "library"]),
    ("Output", &["report", "plot", "export", "table"]),
    ("Dissertation", &["pulse", "protocol", "validate"]),
];

/// The program's arguments, with its commands in groups.
pub(crate) fn program() -> clap::Command {
    let program = Arguments::command();
    let mut listed = String::new();
    for (title, names) in GROUPS {
        let _ = writeln!(listed, "{title}:");
        for name in names {
            let about = program.find_subcommand(name).and_then(clap::Command::get_about);
            let _ = writeln!(listed, "  {name:<12} {}", about.map(ToString::to_string).unwrap_or_default());
        }
        listed.push('\n');
    }
    program.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{listed}Options:\n{{options}}{{after-help}}"
    ))
}

/// Carry out what was typed.
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
        Command::Init(arguments) => init::init(arguments, terminal),
        Command::Run(arguments) => run::run(arguments, terminal),
        Command::Merge(arguments) => merge::merge(arguments, terminal),
        Command::Status(arguments) => status::status(arguments),
        Command::Verify(arguments) => verify::verify(arguments, terminal),
        Command::Check(arguments) => check::check(arguments, terminal),
        Command::Sweep(arguments) => sweep::sweep(arguments, terminal),
        Command::Response(arguments) => response::response(arguments, terminal),
        Command::Library(arguments) => library::library(arguments, terminal),
        Command::Pulse(arguments) => pulse::pulse(arguments, terminal),
        Command::Spectrum(arguments) => spectrum::spectrum(arguments, terminal),
        Command::Warnings(arguments) => warnings::warnings(arguments),
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

/// Options that people give to a command which has none of the kind or calls it otherwise, and what to type instead.
const ELSEWHERE: [(&str, &str, &str); 4] = [
    ("run", "--site", "a run computes every site; read one by `uplift spectrum RESULT --site NAME`"),
    ("overturning", "--poe", "it reports annual rates; to size for a probability: `uplift target --poe`"),
    ("spectrum", "--period", "write --return-period"),
    ("export", "--excel", "write --xlsx"),
];

/// What was typed; a mistake ends the program with its message.
pub(crate) fn typed() -> Arguments {
    let typed = program().try_get_matches().and_then(|found| Arguments::from_arg_matches(&found));
    typed.unwrap_or_else(|mut error| {
        if let Some(option) = error.get(ContextKind::InvalidArg).map(ToString::to_string)
            && let Some(command) = std::env::args().skip(1).find(|word| program().find_subcommand(word).is_some())
            && error.kind() == ErrorKind::UnknownArgument
        {
            let hint = ELSEWHERE.iter().find(|(of, name, _)| *of == command && *name == option);
            let hint = hint.map(|(.., hint)| (*hint).to_owned()).or_else(|| commands_with(&option));
            if let Some(hint) = hint {
                tell(&format!("uplift: {command} has no {option}: {hint}"));
                std::process::exit(error.exit_code())
            }
            // that such an option could be meant as a value
            error.remove(ContextKind::Suggested);
        }
        if let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) {
            let program = program();
            // below a command of several, such as `records`, those of that one
            let group = std::env::args().skip(1).find_map(|typed| {
                program.get_subcommands().find(|own| own.get_name() == typed && own.has_subcommands())
            });
            let names: Vec<&str> = group.unwrap_or(&program).get_subcommands().map(clap::Command::get_name).collect();
            if let Some(hint) = did_you_mean(word, &names) {
                tell(&format!("uplift: there is no command `{word}`: {hint}"));
                std::process::exit(error.exit_code())
            }
        }
        error.exit()
    })
}

/// Which commands have the option of this name, in words; none where none has.
fn commands_with(option: &str) -> Option<String> {
    let long = option.strip_prefix("--")?;
    let program = Arguments::command();
    let has = |own: &&clap::Command| !own.is_hide_set() && own.get_arguments().any(|own| own.get_long() == Some(long));
    let names: Vec<&str> = program.get_subcommands().filter(has).map(clap::Command::get_name).collect();
    match &names[..] {
        [] => None,
        [only] => Some(format!("it is an option of `uplift {only}`")),
        [first @ .., last] => Some(format!("it is an option of {} and {last}", first.join(", "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_in_one_group_and_has_one_short_line() {
        let program = Arguments::command();
        let mut listed: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        let mut known: Vec<&str> =
            program.get_subcommands().filter(|own| !own.is_hide_set()).map(clap::Command::get_name).collect();
        listed.sort_unstable();
        known.sort_unstable();
        assert_eq!(listed, known);
        for own in program.get_subcommands() {
            let about = own.get_about().map(ToString::to_string).unwrap_or_default();
            assert!((1..=60).contains(&about.len()), "{}: {about}", own.get_name());
        }
    }

    /// Commands that do something, with the two words of those of two levels.
    fn leaves(of: &clap::Command, path: &str, found: &mut Vec<(String, String)>) {
        if of.has_subcommands() {
            for own in of.get_subcommands() {
                leaves(own, &format!("{path} {}", own.get_name()), found);
            }
        } else if !of.is_hide_set() {
            found.push((path.to_owned(), of.get_after_help().map(ToString::to_string).unwrap_or_default()));
        }
    }

    #[test]
    fn every_help_ends_with_examples_that_the_program_takes() {
        let mut found = Vec::new();
        leaves(&Arguments::command(), "uplift", &mut found);
        for (path, help) in found {
            let joined = help.replace("\\\n", "");
            let lines = joined.lines().map(|line| line.split(" > ").next().unwrap_or_default().trim());
            let examples: Vec<&str> = lines.filter(|line| line.starts_with("uplift ")).collect();
            assert!(examples.iter().any(|line| line.starts_with(&path)), "{path}: {help}");
            for example in examples {
                let typed = Arguments::command().try_get_matches_from(example.split_whitespace());
                assert!(typed.is_ok(), "{example}: {}", typed.err().map(|error| error.to_string()).unwrap_or_default());
            }
        }
    }
}
