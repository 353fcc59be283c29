//! Synthetic records of a scenario, as files with a manifest.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use serde::Serialize;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::{table_text, write_atomically};
use uplift_motion::synthetic::SyntheticSetOptions;
use uplift_motion::{RecordPair, STANDARD_GRAVITY_M_S2, at2_text};

use crate::error::InputsError;
use crate::made_pairs;

/// Which records are made, and where they go.
#[derive(Debug, Clone)]
pub struct SynthesizeOptions {
    /// Folder for the records and their `manifest.csv`; made if it is not there.
    pub folder: PathBuf,
    /// The scenario, the number of pairs and the seed.
    pub set: SyntheticSetOptions,
    /// Whether existing files are overwritten.
    pub force: bool,
}

/// What was made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SynthesizeReport {
    /// Pairs of components.
    pub pairs: usize,
    /// The manifest that lists them.
    pub manifest: PathBuf,
}

/// Makes synthetic records after Rezaeian and Der Kiureghian (2010, 2012), as AT2 files with a manifest.
///
/// # Errors
/// A manifest that is there already; a scenario outside the range of the method; files that cannot be written.
pub fn synthesize(options: &SynthesizeOptions, events: &dyn Events) -> Result<SynthesizeReport, InputsError> {
    let SynthesizeOptions { folder, set, force } = options;
    let nothing: [&Path; 0] = [];
    let manifest = folder.join("manifest.csv");
    outputs::check(&[Output::new(&manifest, OutputKind::Manifest)], &nothing, *force)?;
    events.note("synthetic records: not for design");
    let pairs = made_pairs(set, events)?;
    let records = pairs.iter().flat_map(|pair| ["H1", "H2"].map(|component| folder.join(file_name(pair, component))));
    let records: Vec<Output> = records.map(|path| Output::new(path, OutputKind::Record)).collect();
    outputs::check(&records, &nothing, *force)?;
    for pair in &pairs {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        for (component, motion) in [("H1", &pair.h1), ("H2", &pair.h2)] {
            let said = |key: &str| pair.metadata.get(key).map_or("", String::as_str);
            let title = format!("SYNTHETIC MOTION, NOT RECORDED: uplift {}", uplift_job::VERSION);
            let head = [said("event"), "none", said("station"), component];
            let text = at2_text(motion, &title, head, STANDARD_GRAVITY_M_S2);
            write_atomically(&folder.join(file_name(pair, component)), text.as_bytes())?;
        }
    }
    let line = format!("uplift {} ({}), synthetic records: {set:?}", uplift_job::VERSION, uplift_job::COMMIT);
    write_atomically(&manifest, &table_text(&manifest, &line, columns(&pairs))?)?;
    Ok(SynthesizeReport { pairs: pairs.len(), manifest })
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
