//! `uplift records synthesize`: synthetic records of a scenario.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use uplift::records::{SynthesizeOptions, range, synthesize as synthesize_records};
use uplift_motion::synthetic::{Faulting, ScenarioRange, SyntheticSetOptions};
use uplift_study::Range;

use crate::command::arguments::{Overwriting, number};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Synthetic records after Rezaeian and Der Kiureghian (2010, 2012), as AT2 files with a manifest.
///
/// They scatter less than real records and have no long-period pulses: what that does to a uniform risk spectrum is in
/// docs/synthetic-motions.md.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift records synthesize -o records/synthetic --count 40 --magnitude 6.5:7")]
pub(super) struct SynthesizeArguments {
    /// Folder for the records and their manifest.csv; made if it is not there
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Number of pairs
    #[arg(long, value_name = "N", default_value_t = 105)]
    count: usize,
    /// Seed: the same seed makes the same records
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Moment magnitude, 6 to 8: a number, or a range from which each pair has its own
    #[arg(long, value_name = "RANGE", value_parser = number_or_range, default_value = "6.2:7.6")]
    magnitude: Range,
    /// Closest distance to the rupture, 8 to 100 km
    #[arg(long, value_name = "RANGE", value_parser = number_or_range, default_value = "8:60")]
    rrup_km: Range,
    /// Mean shear-wave velocity of the upper 30 m, 360 to 1100 m/s
    #[arg(long, value_name = "RANGE", value_parser = number_or_range, default_value = "360:800")]
    vs30: Range,
    /// Mechanism of the earthquakes
    #[arg(long, value_enum, default_value_t = Mechanism::Either)]
    mechanism: Mechanism,
    /// Keep pairs whose geometric-mean PGA is above this, g
    #[arg(long, value_name = "G", default_value_t = 0.14, value_parser = number)]
    minimum_pga_g: f64,
    /// Time step, 0.001 to 0.01 s
    #[arg(long, value_name = "SECONDS", default_value_t = 0.01, value_parser = number)]
    dt_s: f64,
    #[command(flatten)]
    overwriting: Overwriting,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Mechanism {
    /// Even odds
    Either,
    StrikeSlip,
    Reverse,
}

fn number_or_range(text: &str) -> Result<Range, String> {
    match text.parse::<f64>() {
        Ok(value) => Ok(Range { from: value, to: value }),
        Err(_) => range(text).and_then(|range| {
            let closed = range.from.is_finite() && range.to.is_finite();
            closed.then_some(range).ok_or_else(|| "give both ends, e.g. 6.5:7.5, or one number".to_owned())
        }),
    }
}

impl SynthesizeArguments {
    fn options(&self) -> SynthesizeOptions {
        let ends = |range: Range| [range.from, range.to];
        let set = SyntheticSetOptions {
            seed: self.seed,
            pairs: self.count,
            dt_s: self.dt_s,
            minimum_pga_g: self.minimum_pga_g,
            scenario: ScenarioRange {
                magnitude: ends(self.magnitude),
                rrup_km: ends(self.rrup_km),
                vs30_m_s: ends(self.vs30),
                faulting: match self.mechanism {
                    Mechanism::Either => None,
                    Mechanism::StrikeSlip => Some(Faulting::StrikeSlip),
                    Mechanism::Reverse => Some(Faulting::Reverse),
                },
            },
            ..SyntheticSetOptions::default()
        };
        SynthesizeOptions { folder: self.output.clone(), set, force: self.overwriting.force }
    }
}

pub(super) fn synthesize(arguments: &SynthesizeArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let report = synthesize_records(&arguments.options(), terminal)?;
    if !terminal.is_quiet() {
        writeln!(output(), "{} synthetic pairs: {}", report.pairs, report.manifest.display())?;
    }
    Ok(())
}
