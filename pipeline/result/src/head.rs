//! Where the numbers of a result come from, and what it holds.

use std::collections::BTreeMap;

use serde::Serialize;
use uplift_study::Kind;

use super::declared::measure_names;
use super::file::ResultFile;
use super::kept_groups::added;
use super::layout::attribute::{self, Attribute, root};
use super::layout::axis;
use super::{MOTIONS, PEAKS, RESTRAINED_DESIGN};
use crate::error::ResultError;

/// The last version of the solver's numbers whose results do not say it: what they are known by stays as it was.
pub(super) const UNSAID_NUMERICS: u32 = 3;

/// Where the numbers of a result come from: what results of every kind say at their root.
#[derive(Debug, Clone, PartialEq)]
pub struct Head {
    /// What the study is of.
    pub kind: Kind,
    /// Version of the program that wrote it.
    pub version: String,
    /// Commit of that program, or `unknown`.
    pub commit: String,
    /// Coordinated universal time of the run, `2026-01-31T12:00:00Z`.
    pub created: String,
    /// The command line.
    pub command: String,
    /// What was changed of the study file for the run; none where an earlier version of the program did not say.
    pub overrides: Option<Vec<String>>,
    /// Title of the study.
    pub title: String,
    /// Study file as given.
    pub study_file: String,
    /// The study, every default filled in.
    pub study_toml: String,
    /// Where the records come from, in a line; says so if they are synthetic.
    pub record_set: String,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// Seed of a study of uniform risk.
    pub seed: Option<u64>,
    /// Name to SHA-256 of each record and hazard curve.
    pub input_checksums: BTreeMap<String, String>,
    /// Version of the solver's numbers that it was computed with; results that say none are of the last that did not.
    pub numerics: u32,
    /// What was noticed about the inputs; the crate `uplift_alarms` has all that is to be known.
    pub warnings: Vec<String>,
}

/// What a result holds.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Overview {
    /// Uniform risk spectra.
    UniformRisk {
        /// Nonlinear time histories by each measure, which goes by its label.
        analyses: Vec<(&'static str, u64)>,
        /// Names of the sites.
        sites: Vec<String>,
        /// What was added after the run: `bootstrap`, `influence`, `measures`, `structures`.
        added: Vec<&'static str>,
        /// Whether there are repaired spectra.
        has_repair: bool,
    },
    /// Displacement spectra.
    Displacement {
        /// What was shaken: `oscillator` or `block`.
        structure: String,
        /// Nonlinear time histories.
        analyses: u64,
        /// Name and number of records of each set, in the order of their names.
        sets: Vec<(String, u64)>,
        /// Whether there is a design example.
        has_design: bool,
    },
    /// The tests of a shaking table.
    ShakeTable {
        /// The structure file.
        structure: String,
        /// Tests.
        analyses: u64,
        /// Names of the levels.
        levels: Vec<String>,
        /// Excitations.
        excitations: usize,
    },
}

impl ResultFile {
    /// Where the numbers come from.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn head(&self) -> Result<Head, ResultError> {
        let text = |attribute: &Attribute<String>| attribute.read(&self.reader, &[]);
        Ok(Head {
            kind: self.kind(),
            version: text(&root::VERSION)?,
            commit: text(&root::COMMIT)?,
            created: text(&root::CREATED)?,
            command: text(&root::COMMAND)?,
            overrides: text(&root::OVERRIDES).ok().map(|all| all.lines().map(str::to_owned).collect()),
            title: text(&root::TITLE)?,
            study_file: text(&root::STUDY_FILE)?,
            study_toml: text(&root::STUDY_TOML)?,
            record_set: self.record_set()?,
            synthetic: self.is_synthetic()?,
            seed: (self.kind() == Kind::UniformRisk).then(|| root::SEED.read(&self.reader, &[])).transpose()?,
            input_checksums: serde_json::from_str(&text(&root::INPUT_CHECKSUMS)?)
                .map_err(|error| self.damaged(format!("attribute input_checksums of /: {error}")))?,
            numerics: self.numerics(),
            warnings: text(&root::WARNINGS)?.lines().map(str::to_owned).collect(),
        })
    }

    fn numerics(&self) -> u32 {
        let said = root::NUMERICS.read(&self.reader, &[]).ok().and_then(|said| u32::try_from(said).ok());
        said.unwrap_or(UNSAID_NUMERICS)
    }

    /// Where the records come from, in a line.
    pub(super) fn record_set(&self) -> Result<String, ResultError> {
        Ok(root::RECORD_SET.read(&self.reader, &[])?)
    }

    /// Whether the records are synthetic.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn is_synthetic(&self) -> Result<bool, ResultError> {
        Ok(root::SYNTHETIC.read(&self.reader, &[])? == 1)
    }

    /// What the result holds.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn overview(&self) -> Result<Overview, ResultError> {
        let reader = &self.reader;
        if self.kind() == Kind::Displacement {
            let records = |name: String| Ok((attribute::set::RECORDS.read(reader, &[("<set>", &name)])?, name));
            let sets =
                reader.children(MOTIONS.root())?.into_iter().map(records).collect::<Result<Vec<_>, ResultError>>()?;
            return Ok(Overview::Displacement {
                structure: root::STRUCTURE.read(reader, &[])?,
                analyses: attribute::spectra::ANALYSES.read(reader, &[])?,
                sets: sets.into_iter().map(|(records, name)| (name, records)).collect(),
                has_design: reader.exists(RESTRAINED_DESIGN.path),
            });
        }
        if self.kind() == Kind::ShakeTable {
            return Ok(Overview::ShakeTable {
                structure: attribute::shake_table::STRUCTURE.read(reader, &[])?,
                analyses: attribute::shake_table::ANALYSES.read(reader, &[])?,
                levels: reader.axis::<String>(axis::LEVEL.name)?,
                excitations: reader.axis::<String>(axis::EXCITATION.name)?.len(),
            });
        }
        let mut analyses = Vec::new();
        // by their keys, as a listing of the file has them
        let mut measures = self.measures_in(PEAKS.root());
        measures.sort_by_key(|measure| measure.key());
        for measure in measures {
            analyses.push((measure.label(), attribute::stripes::ANALYSES.read(reader, &measure_names(measure))?));
        }
        let sites =
            reader.exists(&axis::path(axis::SITE.name)).then(|| reader.axis::<String>(axis::SITE.name)).transpose()?;
        Ok(Overview::UniformRisk {
            analyses,
            sites: sites.unwrap_or_default(),
            added: added().into_iter().filter(|(group, _)| reader.exists(group)).map(|(_, name)| name).collect(),
            has_repair: self.has_repair(),
        })
    }
}
