//! A result as its file has it: opened and known to be one, its arrays held against their axes.

use std::path::{Path, PathBuf};

use uplift_job::outputs::SITES_KIND;
use uplift_job::{Array, JobError};
use uplift_labelled::{LabelledArray, LabelledReader};
use uplift_motion::IntensityMeasure;
use uplift_study::Kind;

use super::layout::attribute::root;
use super::layout::{LAYOUT, axis};
use super::other_file::no_result;
use crate::error::ResultError;

/// A result as its file has it; [`ResultFile`](crate::ResultFile) is read at other risks, too.
pub struct StoredResult {
    pub(super) path: PathBuf,
    pub(super) reader: LabelledReader,
    kind: Kind,
}

/// The axes of a result of uniform risk.
#[derive(Debug, Clone, PartialEq)]
pub struct RiskAxes {
    /// Names of the records.
    pub records: Vec<String>,
    /// Uplift strengths.
    pub strengths: Vec<f64>,
    /// Probabilities of exceedance.
    pub poes: Vec<f64>,
    /// Years that they refer to.
    pub years: f64,
    /// Names of the sites; none in a study that ends with the stripes.
    pub sites: Vec<String>,
}

/// What the result in `reader` is of; uniform risk where it does not say.
fn kind_of(reader: &LabelledReader) -> Kind {
    let is = |kind: &Kind| root::KIND.read(reader, &[]).is_ok_and(|word| word == kind.key());
    Kind::ALL.into_iter().find(is).unwrap_or(Kind::UniformRisk)
}

impl StoredResult {
    /// Opens the result at `path`.
    ///
    /// # Errors
    /// A file that is missing, damaged, not a result, or of another layout.
    pub(super) fn open(path: &Path) -> Result<Self, ResultError> {
        let reader = LabelledReader::open(path).map_err(|error| no_result(path, error))?;
        let program = root::PROGRAM.read(&reader, &[]).unwrap_or_default();
        if program != "uplift" {
            let is_sites = root::KIND.read(&reader, &[]).is_ok_and(|kind| kind == SITES_KIND);
            let what = if is_sites { "these are the sites of a result" } else { "this is a file of another program" };
            return Err(JobError::input(format!("{}: {what}: give a result of `uplift run`", path.display())).into());
        }
        let layout = root::LAYOUT.read(&reader, &[])?;
        if layout != LAYOUT {
            return Err(JobError::input(format!(
                "{}: has layout {layout}, this version of uplift ({}) reads layout {LAYOUT}: run the study again",
                path.display(),
                uplift_job::VERSION
            ))
            .into());
        }
        let kind = kind_of(&reader);
        Ok(Self { path: path.to_owned(), reader, kind })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Checksum of the file.
    pub(super) fn identity(&self) -> &str {
        self.reader.identity()
    }

    /// Seed of the study.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn seed(&self) -> Result<u64, ResultError> {
        Ok(root::SEED.read(&self.reader, &[])?)
    }

    /// What its study is of.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The axes as the file has them.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn stored_axes(&self) -> Result<RiskAxes, ResultError> {
        self.require(Kind::UniformRisk)?;
        let reader = &self.reader;
        let axes = RiskAxes {
            records: reader.axis::<String>(axis::RECORD.name)?,
            strengths: reader.axis::<f64>(axis::STRENGTH.name)?,
            poes: reader.axis::<f64>(axis::POE.name)?,
            years: root::POE_YEARS.read(reader, &[])?,
            sites: if reader.exists(&axis::path(axis::SITE.name)) {
                reader.axis::<String>(axis::SITE.name)?
            } else {
                Vec::new()
            },
        };
        for (name, length) in [
            (axis::RECORD.name, axes.records.len()),
            (axis::STRENGTH.name, axes.strengths.len()),
            (axis::POE.name, axes.poes.len()),
        ] {
            if length == 0 {
                return Err(self.damaged(format!("{} is empty", axis::path(name))));
            }
        }
        Ok(axes)
    }

    /// Refuses a result of another kind than `wanted`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn require(&self, wanted: Kind) -> Result<(), ResultError> {
        if self.kind == wanted {
            return Ok(());
        }
        Err(self.fail(match self.kind {
            Kind::Displacement => {
                "holds displacement spectra of record sets, not uniform risk spectra: use `uplift table`, `plot`, \
                 `report`, `status` or `verify`, or the CSV tables beside it (other programs: docs/exports.md)"
            }
            Kind::ShakeTable => {
                "holds the tests of a shaking table: use `uplift table`, `plot`, `report`, `validate`, `status` or \
                 `verify`, or the CSV table beside it"
            }
            Kind::UniformRisk if wanted == Kind::ShakeTable => {
                "holds uniform risk spectra, not tests of a shaking table"
            }
            Kind::UniformRisk => "holds uniform risk spectra, not displacement spectra of record sets",
        }))
    }

    /// An array over `axes`, each its name and length.
    pub(super) fn array<const N: usize>(&self, path: &str, axes: [(&str, usize); N]) -> Result<Array<N>, ResultError> {
        self.over(path, self.reader.array::<f64>(path)?, axes)
    }

    /// `array`, read from `path`, if it runs over `axes`, each its name and length.
    pub(super) fn over<const N: usize, T>(
        &self,
        path: &str,
        array: LabelledArray<T>,
        axes: [(&str, usize); N],
    ) -> Result<Array<N, T>, ResultError> {
        let values = self.checked(path, array, &axes)?;
        Array::new(axes.map(|(_, length)| length), values).map_err(|error| self.damaged(format!("{path}: {error}")))
    }

    /// The values of `array`, read from `path`, if it runs over `axes`, each its name and length.
    pub(super) fn checked<T>(
        &self,
        path: &str,
        array: LabelledArray<T>,
        axes: &[(impl AsRef<str>, usize)],
    ) -> Result<Vec<T>, ResultError> {
        let names: Vec<&str> = axes.iter().map(|(name, _)| name.as_ref()).collect();
        let shape: Vec<usize> = axes.iter().map(|(_, length)| *length).collect();
        if array.dims != names {
            return Err(self.damaged(format!(
                "{path} runs over {}, not over {}",
                array.dims.join(", "),
                names.join(", ")
            )));
        }
        if array.shape != shape {
            return Err(self.damaged(format!("{path} has the shape {:?}, not {shape:?} as its axes", array.shape)));
        }
        Ok(array.values)
    }

    /// The measures with a group of their own in `group`, PGV first; none where there is no such group.
    pub(super) fn measures_in(&self, group: &str) -> Vec<IntensityMeasure> {
        let children = self.reader.children(group).unwrap_or_default();
        let mut measures: Vec<IntensityMeasure> = children.iter().filter_map(|name| name.parse().ok()).collect();
        measures.sort_unstable();
        measures
    }

    /// What is wrong with this file.
    pub fn fail(&self, reason: impl std::fmt::Display) -> ResultError {
        JobError::input(format!("{}: {reason}", self.path.display())).into()
    }

    /// A contradiction within this file.
    pub fn damaged(&self, what: impl std::fmt::Display) -> ResultError {
        self.fail(format!("{what}: the file is damaged"))
    }
}
