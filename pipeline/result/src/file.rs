//! A result file: opened once, and read part by part as each is asked for.

use std::path::{Path, PathBuf};

use uplift_job::outputs::{SITE_ARRAYS, SITE_SPECTRA, SITES_KIND, beside};
use uplift_job::{Array, JobError};
use uplift_labelled::{LabelledArray, LabelledReader};
use uplift_study::Kind;

use super::asked_spectra::AskedSpectra;
use super::head::kind_of;
use super::layout::attribute::root;
use super::layout::{LAYOUT, axis};
use super::other_file::no_result;
use crate::error::ResultError;

/// The result of a study of any kind, open for reading.
///
/// Nothing but the first attributes is read before it is asked for. What is read is checked against its axes and
/// returned as a plain value: keep it, each call reads anew.
///
/// ```no_run
/// use std::path::Path;
/// use uplift_result::ResultFile;
///
/// let file = ResultFile::open(Path::new("results/europe.h5"))?;
/// println!("{}", file.head()?.record_set);
/// for spectrum in file.spectra()?.rows() {
///     println!("{} {}: {:?}", spectrum.site, spectrum.measure.label(), spectrum.u_m);
/// }
/// # Ok::<(), uplift_result::ResultError>(())
/// ```
///
/// | of a result of any kind | |
/// |---|---|
/// | [`head`](Self::head) | where the numbers come from |
/// | [`overview`](Self::overview) | what it holds |
/// | **of uniform risk** | |
/// | [`axes`](Self::axes) | records, strengths, probabilities, sites |
/// | [`records`](Self::records) | what is known of the records |
/// | [`hazard`](Self::hazard) | the hazard curves as used |
/// | [`spectra`](Self::spectra) | the spectra and their coefficients, as the study read them |
/// | [`peaks`](Self::peaks) | peak displacements of all runs |
/// | [`bands`](Self::bands), [`draws`](Self::draws) | confidence bands and their draws |
/// | [`influence`](Self::influence) | what each record and intensity does to the spectra |
/// | [`findings`](Self::findings) | what structures were asked, and the answers |
/// | [`stored_study`](Self::stored_study) | the study itself |
/// | **of displacement spectra** | |
/// | [`displacements`](Self::displacements) | the spectra |
/// | [`motions`](Self::motions) | every peak displacement of a set |
/// | [`design`](Self::design) | the design example |
/// | **of a shaking table** | |
/// | [`shake_table`](Self::shake_table) | every test |
pub struct ResultFile {
    pub(super) path: PathBuf,
    pub(super) reader: LabelledReader,
    kind: Kind,
    /// What it was asked for in place of the risks of its study.
    pub(super) asked: Option<AskedSpectra>,
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

impl ResultFile {
    /// Open the result at `path`.
    ///
    /// # Errors
    /// A file that is missing, damaged, not a result, or of another layout.
    pub fn open(path: &Path) -> Result<Self, ResultError> {
        let reader = LabelledReader::open(path).map_err(|error| no_result(path, error))?;
        let program = root::PROGRAM.read(&reader, &[]).unwrap_or_default();
        if program != "uplift" {
            let is_sites = root::KIND.read(&reader, &[]).is_ok_and(|kind| kind == SITES_KIND);
            let what = if is_sites { "the sites of a result as arrays" } else { "an HDF5 file" };
            return Err(JobError::input(format!(
                "{}: is {what}, but not a result of uplift: give the file that `uplift run` wrote",
                path.display()
            ))
            .into());
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
        Ok(Self { path: path.to_owned(), reader, kind, asked: None })
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

    /// The axes of a result of uniform risk, with the probabilities that it was asked for, if it was.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn axes(&self) -> Result<RiskAxes, ResultError> {
        let mut axes = self.stored_axes()?;
        if let Some(asked) = &self.asked {
            axes.poes.clone_from(&asked.spectra.poes);
            axes.years = asked.spectra.years;
        }
        Ok(axes)
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

    /// The axes of a result of uniform risk with sites.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn axes_with_sites(&self) -> Result<RiskAxes, ResultError> {
        let axes = self.axes()?;
        if axes.sites.is_empty() { Err(self.without_spectra()) } else { Ok(axes) }
    }

    /// Why a result of uniform risk without sites has no spectra, and where those of a table of sites are.
    pub fn without_spectra(&self) -> ResultError {
        if self.stored_study().is_ok_and(|study| study.site_table.is_some()) {
            let [arrays, table] = [SITE_ARRAYS, SITE_SPECTRA].map(|ending| beside(&self.path, ending));
            let (name, arrays, table) = (self.path.display(), arrays.display(), table.display());
            return self.fail(format!(
                "the spectra of a table of sites are not in the result, but in {arrays} and {table}: open these, or \
                 draw the map, `uplift plot {name} --only map`"
            ));
        }
        self.fail("the study has no sites, so the result has no spectra: add [[sites]] and run it again")
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

    /// What is wrong with this file.
    pub fn fail(&self, reason: impl std::fmt::Display) -> ResultError {
        JobError::input(format!("{}: {reason}", self.path.display())).into()
    }

    /// A contradiction within this file.
    pub fn damaged(&self, what: impl std::fmt::Display) -> ResultError {
        self.fail(format!("{what}: the file is damaged"))
    }
}
