//! Synthetic records of a scenario, as files with a manifest.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use polars::prelude::Column;
use serde::Serialize;
use uplift_atomic_file::io_error;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::{table_text, write_atomically};
use uplift_job::typed::{Overwriting, number};
use uplift_motion::synthetic::{Faulting, ScenarioRange, SyntheticSetOptions};
use uplift_motion::{RecordPair, STANDARD_GRAVITY_M_S2, at2_text};
use uplift_study::Range;

use super::range;
use crate::error::InputsError;
use crate::made_pairs;

/// Which records are made, and where they go.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct SynthesizeOptions {
    /// Folder for the records and their manifest.csv; made if it is not there
    #[arg(short = 'o', long = "output", value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Number of pairs
    #[arg(
        long, value_name = "N", default_value_t = SynthesizeOptions::new("").count, value_parser = count,
        allow_negative_numbers = true
    )]
    pub count: usize,
    /// Seed: the same seed makes the same records
    #[arg(long, value_name = "N", default_value_t = SynthesizeOptions::new("").seed)]
    pub seed: u64,
    /// Moment magnitude, 6 to 8: a number, or a range from which each pair has its own
    #[arg(
        long, value_name = "RANGE", value_parser = number_or_range,
        default_value_t = SynthesizeOptions::new("").magnitude
    )]
    pub magnitude: Range,
    /// Closest distance to the rupture, 8 to 100 km
    #[arg(
        long, value_name = "RANGE", value_parser = number_or_range,
        default_value_t = SynthesizeOptions::new("").rrup_km
    )]
    pub rrup_km: Range,
    /// Mean shear-wave velocity of the upper 30 m, 360 to 1100 m/s
    #[arg(
        long, value_name = "RANGE", value_parser = number_or_range,
        default_value_t = SynthesizeOptions::new("").vs30
    )]
    pub vs30: Range,
    /// Mechanism of the earthquakes
    #[arg(long, value_enum, default_value_t)]
    pub mechanism: Mechanism,
    /// Keep pairs whose geometric-mean PGA is above this, g
    #[arg(long, value_name = "G", value_parser = number, default_value_t = SynthesizeOptions::new("").minimum_pga_g)]
    pub minimum_pga_g: f64,
    /// Time step, 0.001 to 0.01 s
    #[arg(long, value_name = "SECONDS", value_parser = number, default_value_t = SynthesizeOptions::new("").dt_s)]
    pub dt_s: f64,
    /// Whether existing files are overwritten.
    #[command(flatten)]
    pub overwriting: Overwriting,
}

/// Mechanism of the earthquakes of a scenario.
#[expect(missing_docs, reason = "the help would show what their names say")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Mechanism {
    /// Even odds
    #[default]
    Either,
    StrikeSlip,
    Reverse,
}

fn between([from, to]: [f64; 2]) -> Range {
    Range { from, to }
}

fn count(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "write a whole number of pairs, 1 or more".to_owned())
}

fn number_or_range(text: &str) -> Result<Range, String> {
    match text.parse::<f64>() {
        Ok(value) => Ok(between([value, value])),
        Err(_) => range(text).and_then(|range| {
            let closed = range.from.is_finite() && range.to.is_finite();
            closed.then_some(range).ok_or_else(|| "give both ends, e.g. 6.5:7.5, or one number".to_owned())
        }),
    }
}

impl SynthesizeOptions {
    /// The embedded set, in `folder`.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        let SyntheticSetOptions { seed, pairs, dt_s, minimum_pga_g, scenario, .. } = SyntheticSetOptions::default();
        Self {
            folder: folder.into(),
            count: pairs,
            seed,
            magnitude: between(scenario.magnitude),
            rrup_km: between(scenario.rrup_km),
            vs30: between(scenario.vs30_m_s),
            mechanism: Mechanism::default(),
            minimum_pga_g,
            dt_s,
            overwriting: Overwriting::default(),
        }
    }

    fn set(&self) -> SyntheticSetOptions {
        let ends = |range: Range| [range.from, range.to];
        SyntheticSetOptions {
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
        }
    }
}

/// How the files of synthetic records begin.
const MADE_BY: &str = "SYNTHETIC MOTION, NOT RECORDED: uplift ";

/// What the head of their manifest says.
const SET_OF: &str = ", synthetic records: ";

/// What was made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SynthesizeReport {
    /// Pairs of components.
    pub pairs: usize,
    /// The manifest that lists them.
    pub manifest: PathBuf,
}

/// Makes synthetic records after Rezaeian and Der Kiureghian (2010, 2012), as AT2 files with a manifest. They scatter
/// less than real records and have no long-period pulses: what that does to a uniform risk spectrum is in
/// docs/synthetic-motions.md.
///
/// # Errors
/// A manifest that is there already; a scenario outside the range of the method; files that cannot be written.
pub fn synthesize(options: &SynthesizeOptions, events: &dyn Events) -> Result<SynthesizeReport, InputsError> {
    let (folder, set, force) = (&options.folder, &options.set(), options.overwriting.force);
    let nothing: [&Path; 0] = [];
    let manifest = folder.join("manifest.csv");
    outputs::check(&[Output::new(&manifest, OutputKind::Manifest)], &nothing, force)?;
    events.note("synthetic records: not for design");
    let pairs = made_pairs(set, events)?;
    let records = pairs.iter().flat_map(|pair| ["H1", "H2"].map(|component| folder.join(file_name(pair, component))));
    let records: Vec<Output> = records.map(|path| Output::new(path, OutputKind::Record)).collect();
    outputs::check(&records, &nothing, force)?;
    let earlier = earlier_records(&manifest, folder);
    for pair in &pairs {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        for (component, motion) in [("H1", &pair.h1), ("H2", &pair.h2)] {
            let said = |key: &str| pair.metadata.get(key).map_or("", String::as_str);
            let title = format!("{MADE_BY}{}", uplift_job::VERSION);
            let head = [said("event"), "none", said("station"), component];
            let text = at2_text(motion, &title, head, STANDARD_GRAVITY_M_S2);
            write_atomically(&folder.join(file_name(pair, component)), text.as_bytes())?;
        }
    }
    let line = format!("uplift {} ({}){SET_OF}{set:?}", uplift_job::VERSION, uplift_job::COMMIT);
    write_atomically(&manifest, &table_text(&manifest, &line, columns(&pairs))?)?;
    for left in earlier.iter().filter(|path| records.iter().all(|record| record.path() != *path)) {
        std::fs::remove_file(left).map_err(|error| JobError::from(io_error(left, "remove the file")(error)))?;
    }
    Ok(SynthesizeReport { pairs: pairs.len(), manifest })
}

/// The records of the set that an earlier `manifest` of this program names in `folder`: files of the names and the head
/// that this program gives them, and no others.
fn earlier_records(manifest: &Path, folder: &Path) -> Vec<PathBuf> {
    let text = std::fs::read_to_string(manifest).unwrap_or_default();
    let is_set = |head: &str| head.starts_with("# uplift ") && head.contains(SET_OF);
    if !text.lines().next().is_some_and(is_set) {
        return Vec::new();
    }
    let is_name = |name: &&str| {
        let id = ["_H1.AT2", "_H2.AT2"].iter().find_map(|ending| name.strip_suffix(ending)?.strip_prefix("SYN"));
        id.is_some_and(|number| !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit()))
    };
    let is_ours = |path: &PathBuf| {
        let mut head = vec![0; MADE_BY.len()];
        // no link is followed
        path.symlink_metadata().is_ok_and(|data| data.is_file())
            && File::open(path).and_then(|mut file| file.read_exact(&mut head)).is_ok()
            && head == MADE_BY.as_bytes()
    };
    let names = text.lines().flat_map(|line| line.split(',')).filter(is_name);
    names.map(|name| folder.join(name)).filter(is_ours).collect()
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
