//! From a folder of downloads, or the zip archive that PEER gives, to a manifest: files are found, read, paired,
//! measured and listed.

mod collect;
mod component;
mod group;
mod measured;
mod name;
mod scan;
mod search_results;
mod table;
mod unpack;
mod warnings;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{ArgAction, Args};
use polars::prelude::Column;
use serde::Serialize;

pub use measured::PairMeasures;
pub(crate) use name::sequence_number;
pub use warnings::pair_warnings;
pub(crate) use warnings::unusual_peaks;
pub use warnings::{Remarks, Warning};

use crate::FileOptions;
use crate::error::InputsError;
use collect::find_pairs;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::{table_text, write_atomically};
use uplift_job::text::counted;
use uplift_job::typed::Overwriting;

/// Columns of a manifest by which records are chosen, and which not every file says.
const WANTED: [&str; 3] = ["magnitude", "rrup_km", "vs30"];

/// Which folder is imported, and where its manifest goes.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ImportOptions {
    /// Folder with record files, or the zip archive of PEER
    #[arg(value_name = "FOLDER|ZIP")]
    pub folder: PathBuf,
    /// Manifest to write (CSV), or a folder for it
    #[arg(short, long, value_name = "SET")]
    pub output: PathBuf,
    /// What the files do not say.
    #[command(flatten)]
    pub files: FileOptions,
    /// Skip the search for velocity pulses (faster)
    #[arg(long = "no-pulses", action = ArgAction::SetFalse)]
    pub pulses: bool,
    /// Whether existing files are overwritten.
    #[command(flatten)]
    pub overwriting: Overwriting,
}

/// What an import found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ImportReport {
    /// The manifest; none where no two components make a pair, and the remarks say why.
    pub manifest: Option<PathBuf>,
    /// Pairs in it.
    pub pairs: usize,
    /// Files read.
    pub files: usize,
    /// Components in them.
    pub components: usize,
    /// What deserves a look, kind by kind.
    pub remarks: Vec<Remarks>,
    /// The file that holds all remarks; none where there is none.
    pub remarks_file: Option<PathBuf>,
    /// Columns of the manifest that no file says anything for, although records are chosen by them.
    pub blank_columns: Vec<&'static str>,
    /// Wall time, s.
    pub seconds: f64,
}

impl ImportOptions {
    fn manifest(&self) -> PathBuf {
        if self.output.is_dir() { self.output.join("manifest.csv") } else { self.output.clone() }
    }

    /// Refuses what cannot be imported or written, before the work.
    fn check(&self, manifest: &Path) -> Result<(), InputsError> {
        if !self.folder.exists() {
            return Err(JobError::input(format!(
                "{}: there is no such folder or file: give the folder with your downloads, or a zip archive",
                self.folder.display()
            ))
            .into());
        }
        if !self.folder.is_dir() && !unpack::is_archive(&self.folder) {
            return Err(JobError::input(format!(
                "{} is neither a folder nor a zip archive: name the folder that the records are in",
                self.folder.display()
            ))
            .into());
        }
        let folder = folder_of(manifest);
        if !folder.as_os_str().is_empty() && !folder.is_dir() {
            return Err(JobError::input(format!("{} is not a folder: create it first", folder.display())).into());
        }
        let outputs = [
            Output::new(manifest, OutputKind::Manifest),
            Output::new(manifest.with_extension("remarks.txt"), OutputKind::Remarks),
        ];
        Ok(outputs::check(&outputs, &[&self.folder], self.overwriting.force)?)
    }
}

/// Imports the records of a folder or an archive: a manifest of the pairs in it, and a file with everything that
/// deserves a look.
///
/// # Errors
/// A folder that cannot be read, a manifest that is there already or cannot be written; an interruption. What is wrong
/// with single files is among the remarks.
pub fn import(options: &ImportOptions, events: &dyn Events) -> Result<ImportReport, InputsError> {
    let manifest = options.manifest();
    options.check(&manifest)?;
    let start = Instant::now();
    let mut folder = options.folder.clone();
    if !folder.is_dir() {
        folder = unpack::folder_of(&options.folder, &manifest);
        unpack::unpack(&options.folder, &folder, events)?;
    }
    let imported = find_pairs(&folder, options.files, options.pulses, events)?;
    let remarks = Remarks::from_import(&imported.passed_over, &imported.warnings);
    let remarks_file = (!remarks.is_empty()).then(|| manifest.with_extension("remarks.txt"));
    if let Some(file) = &remarks_file {
        let mut text = format!("# {}: remarks of records import\n", outputs::mark());
        text.extend(remarks.iter().map(ToString::to_string));
        write_atomically(file, text.as_bytes())?;
    }
    let mut report = ImportReport {
        manifest: None,
        pairs: imported.pairs.len(),
        files: imported.files,
        components: imported.components,
        remarks,
        remarks_file,
        blank_columns: Vec::new(),
        seconds: 0.0,
    };
    if !imported.pairs.is_empty() {
        let pairs = counted(report.pairs, "pair");
        let line = format!("uplift {} ({}), records import, {pairs}", uplift_job::VERSION, uplift_job::COMMIT);
        let columns = table::manifest_columns(&imported.pairs, folder_of(&manifest), options.files);
        report.blank_columns = WANTED
            .into_iter()
            .filter(|key| columns.iter().any(|column| column.name() == key && all_blank(column)))
            .collect();
        let content = table_text(&manifest, &line, columns)?;
        // what a study would refuse is not written
        crate::manifest::read_bytes(&content, &manifest, None).map_err(JobError::Inputs)?;
        write_atomically(&manifest, &content)?;
        report.manifest = Some(manifest);
    }
    report.seconds = start.elapsed().as_secs_f64();
    Ok(report)
}

fn folder_of(manifest: &Path) -> &Path {
    manifest.parent().unwrap_or(Path::new(""))
}

fn all_blank(column: &Column) -> bool {
    column.str().is_ok_and(|cells| cells.iter().all(|cell| cell.is_none_or(str::is_empty)))
}
