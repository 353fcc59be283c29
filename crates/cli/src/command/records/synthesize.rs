//! `uplift records synthesize`: synthetic records of a scenario.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use polars::prelude::Column;
use uplift_motion::synthetic::{Faulting, ScenarioRange, SyntheticSetOptions, generate};
use uplift_motion::{RecordPair, STANDARD_GRAVITY_M_S2, at2_text};

use super::{CommandError, Range, Terminal, range};
use uplift::result::{write_atomically, write_table};

/// Synthetic records after Rezaeian and Der Kiureghian (2010, 2012), as AT2 files with a manifest.
///
/// They scatter less than real records and have no long-period pulses: what that does to a uniform risk spectrum is in
/// docs/synthetic-motions.md.
#[derive(Debug, Args)]
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
    #[arg(long, value_name = "G", default_value_t = 0.14)]
    minimum_pga_g: f64,
    /// Time step, 0.001 to 0.01 s
    #[arg(long, value_name = "SECONDS", default_value_t = 0.01)]
    dt_s: f64,
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

pub(super) fn synthesize(arguments: &SynthesizeArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let folder = &arguments.output;
    let manifest = folder.join("manifest.csv");
    if manifest.exists() {
        return Err(CommandError::Usage(format!("{} is there already: name another folder", manifest.display())));
    }
    let ends = |range: Range| [range.from, range.to];
    let options = SyntheticSetOptions {
        seed: arguments.seed,
        pairs: arguments.count,
        dt_s: arguments.dt_s,
        minimum_pga_g: arguments.minimum_pga_g,
        scenario: ScenarioRange {
            magnitude: ends(arguments.magnitude),
            rrup_km: ends(arguments.rrup_km),
            vs30_m_s: ends(arguments.vs30),
            faulting: match arguments.mechanism {
                Mechanism::Either => None,
                Mechanism::StrikeSlip => Some(Faulting::StrikeSlip),
                Mechanism::Reverse => Some(Faulting::Reverse),
            },
        },
        ..SyntheticSetOptions::default()
    };
    terminal.say("synthetic records: not for design");
    let pairs = generate(&options).map_err(|error| CommandError::Usage(error.to_string()))?;
    std::fs::create_dir_all(folder)
        .map_err(|error| CommandError::input(format!("{} cannot be made: {error}", folder.display())))?;
    for pair in &pairs {
        for (component, motion) in [("H1", &pair.h1), ("H2", &pair.h2)] {
            let said = |key: &str| pair.metadata.get(key).map_or("", String::as_str);
            let title = format!("SYNTHETIC MOTION, NOT RECORDED: uplift {}", uplift::VERSION);
            let head = [said("event"), "none", said("station"), component];
            let text = at2_text(motion, &title, head, STANDARD_GRAVITY_M_S2);
            write_atomically(&folder.join(file_name(pair, component)), text.as_bytes())?;
        }
    }
    let line = format!("uplift {} ({}), synthetic records: {options:?}", uplift::VERSION, uplift::COMMIT);
    write_table(&manifest, &line, columns(&pairs))?;
    writeln!(std::io::stdout(), "{} synthetic pairs: {}", pairs.len(), manifest.display())?;
    Ok(())
}

fn file_name(pair: &RecordPair, component: &str) -> String {
    format!("{}_{component}.AT2", pair.id)
}

fn columns(pairs: &[RecordPair]) -> Vec<Column> {
    let column = |name: &str, cell: &dyn Fn(&RecordPair) -> String| {
        Column::new(name.into(), pairs.iter().map(cell).collect::<Vec<String>>())
    };
    let mut columns = vec![
        column("record_id", &|pair| pair.id.clone()),
        column("file_h1", &|pair| file_name(pair, "H1")),
        column("file_h2", &|pair| file_name(pair, "H2")),
    ];
    for key in ["event", "magnitude", "mechanism", "rrup_km", "vs30", "station", "set_tags"] {
        columns.push(column(key, &|pair| pair.metadata.get(key).cloned().unwrap_or_default()));
    }
    columns
}
