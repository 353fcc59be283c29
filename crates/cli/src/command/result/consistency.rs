//! `uplift consistency`: whether the records bring the hazard of the other measure, and weights by which they do.

use clap::{Args, ValueEnum};
use uplift::consistency::{ConsistencyOptions, ConsistencyReport, consistency as run};

use crate::command::arguments::ResultArguments;
use crate::error::CommandError;
use crate::show::{print_consistency, print_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  uplift consistency results/study.h5\n  uplift consistency results/study.h5 --repair"
)]
pub(crate) struct ConsistencyArguments {
    #[command(flatten)]
    result: ResultArguments,
    #[command(flatten)]
    options: ConsistencyOptions,
    /// Fail with exit code 4 if any verdict is worse than this
    #[arg(long, value_name = "VERDICT")]
    require: Option<Required>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// The worst verdict that is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Required {
    /// Bias within 0.9 to 1.1, nowhere further off than 0.15 in the logarithm
    Consistent,
    /// Bias within 0.75 to 1.33, nowhere further off than 0.4
    Off,
}

impl Required {
    /// The verdicts that it takes.
    fn takes(self) -> &'static [&'static str] {
        match self {
            Self::Consistent => &["consistent"],
            Self::Off => &["consistent", "off"],
        }
    }
}

pub(crate) fn consistency(arguments: &ConsistencyArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let found = arguments.result.find(terminal)?;
    let options = ConsistencyOptions {
        repair: arguments.options.repair || found.repair,
        force: arguments.result.force(),
        ..arguments.options.clone()
    };
    let report = run(&found.path, &options, terminal)?;
    if arguments.json {
        print_json(&report)?;
    } else {
        print_consistency(&report, terminal)?;
    }
    arguments.require.map_or(Ok(()), |required| require(&report, required))
}

/// Fails where a row does not have the verdict required, or has none.
fn require(report: &ConsistencyReport, required: Required) -> Result<(), CommandError> {
    if report.rows.is_empty() {
        return Err(CommandError::input(format!("--require: {}", report.note)));
    }
    let worse = report.rows.iter().filter(|row| !row.verdict.is_some_and(|own| required.takes().contains(&own)));
    let worse: Vec<String> = worse
        .map(|row| format!("{} by {}: {}", row.site, row.scaled_to, row.verdict.unwrap_or("no verdict")))
        .collect();
    let unasked = report.unasked.iter().map(|site| format!("{site}: has no curves of two measures"));
    let worse: Vec<String> = worse.into_iter().chain(unasked).collect();
    if worse.is_empty() {
        return Ok(());
    }
    let required = required.takes().last().copied().unwrap_or_default();
    Err(CommandError::input(format!("--require {required}: {}", worse.join("; "))))
}
