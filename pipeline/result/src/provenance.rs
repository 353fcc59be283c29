//! Where the numbers of a result come from.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use uplift_ida::NUMERICS;
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_job::checksum::checksum;
use uplift_job::study_run::{RunHead, RunOptions};
use uplift_labelled::LabelledWriter;

use super::digest::study_digest;
use super::file::ResultFile;
use super::layout::LAYOUT;
use super::layout::attribute::root;
use crate::error::ResultError;

/// What someone needs to repeat a run.
#[derive(Debug, Clone)]
pub struct Provenance {
    /// Study file as given.
    pub study_file: String,
    /// By which a later run knows its own study: a checksum of where the file lies, which tells nobody where.
    pub study_place: String,
    /// The command line.
    pub command: String,
    /// What was changed of the study file for the run.
    pub overrides: Vec<String>,
    /// Coordinated universal time of the run, `2026-01-31T12:00:00Z`.
    pub created: String,
    /// Threads used; the numbers do not depend on it.
    pub threads: usize,
    /// Wall time up to the writing of the file, s.
    pub wall_time_s: f64,
    /// Name to SHA-256 of each record and hazard curve.
    pub input_checksums: BTreeMap<String, String>,
    /// Name of the result file.
    pub result: String,
    /// By what its numbers are known, see [`Head::study_digest`](super::Head::study_digest).
    pub study_digest: String,
}

impl Provenance {
    /// Provenance of a run on these inputs, name to SHA-256.
    pub fn new(options: &RunOptions, input_checksums: BTreeMap<String, String>) -> Self {
        Self {
            study_file: options.study_file.display().to_string(),
            study_place: place_of(&options.study_file),
            command: options.command.clone(),
            overrides: options.overrides.clone(),
            created: uplift_job::now(),
            threads: rayon::current_num_threads(),
            wall_time_s: 0.0,
            input_checksums,
            result: String::new(),
            study_digest: String::new(),
        }
    }

    /// The same of the result at `path`, of a study that says `study_toml`, once all inputs are known.
    #[must_use]
    pub fn with_result(mut self, path: &Path, study_toml: &str) -> Self {
        self.result = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        self.study_digest = study_digest(study_toml, &self.input_checksums);
        self
    }

    /// What a run tells, whatever the kind of its study; `records` are the description of the set and whether it is
    /// synthetic.
    pub fn head(
        &self,
        title: &str,
        (record_set, synthetic): (&str, bool),
        alarms: Vec<Alarm>,
        files: Vec<PathBuf>,
        seconds: f64,
    ) -> RunHead {
        RunHead {
            program: "uplift",
            version: uplift_job::VERSION,
            commit: uplift_job::COMMIT,
            study: self.study_file.clone(),
            title: title.to_owned(),
            record_set: record_set.to_owned(),
            synthetic,
            files,
            alarms,
            seconds,
            done_already: false,
        }
    }

    /// One line for the head of a table; `records` says where the records come from.
    pub fn line(&self, title: &str, records: &str) -> String {
        let program = [uplift_job::VERSION, uplift_job::COMMIT, &self.created];
        line(program, (&self.study_file, title), (&self.result, &self.study_digest), records)
    }

    /// Writes the attributes of the root that results of every kind have: of a study with this title and acceleration
    /// of gravity (m/s²) that says `study_toml`; of `records`, their description and whether they are synthetic; and
    /// the `warnings`, what was noticed about the inputs.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(
        &self,
        writer: &mut LabelledWriter,
        (title, gravity_m_s2, study_toml): (&str, f64, &str),
        (record_set, synthetic): (&str, bool),
        warnings: &[String],
    ) -> Result<(), ResultError> {
        let checksums =
            serde_json::to_string(&self.input_checksums).map_err(|error| JobError::input(error.to_string()))?;
        root::PROGRAM.write(writer, &[], "uplift")?;
        root::VERSION.write(writer, &[], uplift_job::VERSION)?;
        root::COMMIT.write(writer, &[], uplift_job::COMMIT)?;
        root::LAYOUT.write(writer, &[], LAYOUT)?;
        root::NUMERICS.write(writer, &[], NUMERICS)?;
        root::CREATED.write(writer, &[], self.created.as_str())?;
        root::COMMAND.write(writer, &[], self.command.as_str())?;
        root::OVERRIDES.write(writer, &[], self.overrides.join("\n"))?;
        root::TITLE.write(writer, &[], title)?;
        root::STUDY_FILE.write(writer, &[], self.study_file.as_str())?;
        root::STUDY_PLACE.write(writer, &[], self.study_place.as_str())?;
        root::STUDY_TOML.write(writer, &[], study_toml)?;
        root::GRAVITY_M_S2.write(writer, &[], gravity_m_s2)?;
        root::RECORD_SET.write(writer, &[], record_set)?;
        root::SYNTHETIC.write(writer, &[], synthetic)?;
        root::INPUT_CHECKSUMS.write(writer, &[], checksums)?;
        root::WARNINGS.write(writer, &[], warnings.join("\n"))?;
        root::THREADS.write(writer, &[], i64::try_from(self.threads).unwrap_or(i64::MAX))?;
        root::WALL_TIME_S.write(writer, &[], self.wall_time_s)?;
        root::PLATFORM.write(writer, &[], format!("{} {}", std::env::consts::OS, std::env::consts::ARCH))?;
        Ok(())
    }
}

impl ResultFile {
    /// [`Provenance::line`] of the run that wrote this result.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn line(&self) -> Result<String, ResultError> {
        let head = self.head()?;
        let program = [&*head.version, &head.commit, &head.created];
        let name = self.path().file_name().unwrap_or_default().to_string_lossy();
        Ok(line(program, (&head.study_file, &head.title), (&name, &head.study_digest()), &head.record_set))
    }
}

fn line(
    [version, commit, created]: [&str; 3],
    (study, title): (&str, &str),
    (result, digest): (&str, &str),
    records: &str,
) -> String {
    let title = if title.is_empty() { String::new() } else { format!("{title}; ") };
    format!(
        "uplift {version} ({commit}), {created}; study {study}; {title}result {result}; study digest {digest}; \
         records: {records}"
    )
    .replace(['\n', '\r'], " ")
}

/// A checksum of where a study file lies; empty where there is none.
pub(super) fn place_of(study_file: &Path) -> String {
    study_file.canonicalize().map_or_else(|_| String::new(), |place| checksum(place.as_os_str().as_encoded_bytes()))
}
