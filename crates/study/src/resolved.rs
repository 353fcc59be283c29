//! The resolved study: nothing left to default, to find or to check.

use std::path::{Path, PathBuf};

use uplift_motion::{Combination, Component, IntensityMeasure};

use super::form::Form;
use super::grid::Grid;
use super::hazard::Hazard;
use super::selection::RecordSelection;
use super::site_table::SiteTable;

/// Pairs of horizontal components in the synthetic record set, unless a study says otherwise.
pub const DEFAULT_SYNTHETIC_PAIRS: u64 = 105;

/// Seed of the synthetic record set that comes with the program.
pub const DEFAULT_SYNTHETIC_SEED: u64 = 1;

/// A study with every default filled in, every path found and every unit checked.
///
/// It is serialised as a study file that loads to an equal value, wherever it is stored.
#[derive(Debug, Clone, PartialEq)]
pub struct ResolvedStudy {
    /// Free text.
    pub title: String,
    /// Seed of whatever is drawn at random; below 2⁶³.
    pub seed: u64,
    /// Acceleration of gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// Which ground motions.
    pub records: Records,
    /// The oscillator but for its strength.
    pub oscillator: Oscillator,
    /// Uplift strengths η = `f_up`/(m g) \[-\].
    pub strengths: Grid,
    /// Intensity measures with the levels that records are scaled to; at least one.
    pub measures: Vec<MeasurePlan>,
    /// Probabilities, and how the spectrum is read from the risk integral.
    pub risk: Risk,
    /// What the hazard curves have in common.
    pub hazard: Hazard,
    /// Sites; each has a curve of each measure in `measures`.
    pub sites: Vec<Site>,
    /// Many sites, their hazard in exports.
    pub site_table: Option<SiteTable>,
    /// The fit of Eq. 4.11.
    pub regression: Regression,
    /// The bootstrap over records.
    pub bootstrap: Bootstrap,
    /// What is written where.
    pub output: Output,
    /// What is allowed but probably not meant.
    pub warnings: Vec<String>,
}

impl ResolvedStudy {
    /// The study as TOML, complete and loadable; the warnings are left out, since loading finds
    /// them again.
    ///
    /// # Errors
    ///
    /// Where TOML cannot hold a value; a study that was loaded has none such.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(self)
    }
}

impl serde::Serialize for ResolvedStudy {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Form::of(self).serialize(serializer)
    }
}

/// Which ground motions are used.
#[derive(Debug, Clone, PartialEq)]
pub struct Records {
    /// Where they come from.
    pub source: RecordSource,
    /// The component that shakes the planar oscillator.
    pub component: Component,
    /// How the peaks of the two components make the intensity of a pair.
    pub intensity: Combination,
    /// Which of them are used.
    pub select: RecordSelection,
    /// Use only so many of these records, the first; all if none.
    pub first: Option<u64>,
}

/// Where ground motions come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RecordSource {
    /// Record files listed in a manifest.
    Manifest {
        /// The manifest, absolute.
        manifest: PathBuf,
        /// Only rows whose `set_tags` contain it; all rows if none.
        tag: Option<String>,
    },
    /// Synthetic motions, made by the program.
    Synthetic {
        /// Number of pairs of horizontal components.
        pairs: u64,
        /// Seed of the generator.
        seed: u64,
    },
}

/// The oscillator but for its strength (Eq. 4.1 to 4.3).
#[derive(Debug, Clone, PartialEq)]
pub struct Oscillator {
    /// Displacement at uplift `u_up` \[m\].
    pub uplift_displacement_m: f64,
    /// Coefficient of restitution of the velocity at each impact \[-\].
    pub restitution: f64,
    /// Whether the free motion after the end of a record counts.
    pub free_vibration: bool,
    /// The force after uplift.
    pub uplifted: Uplifted,
}

/// The force of the oscillator after uplift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Uplifted {
    /// Constant: zero stiffness, bilinear elastic (ZSBE).
    ZeroStiffness,
    /// Falls to zero at a displacement: negative stiffness, bilinear elastic (NSBE).
    NegativeStiffness {
        /// Displacement at which the force is zero `u_cap` \[m\], above the one at uplift.
        capacity_m: f64,
    },
    /// Rises.
    PositiveStiffness {
        /// Stiffness divided by mass \[1/s²\].
        stiffness_per_s2: f64,
    },
}

/// An intensity measure with its levels.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasurePlan {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Levels in [`IntensityMeasure::unit`], cm/s for PGV and g for PGA; at least two.
    pub levels: Grid,
}

/// Probabilities, and how the spectrum is read from the risk integral (Eq. 4.4).
#[derive(Debug, Clone, PartialEq)]
pub struct Risk {
    /// Probabilities of exceedance in `years` \[-\].
    pub poe: Vec<f64>,
    /// Time that the probabilities refer to \[yr\].
    pub years: f64,
    /// How ordinates are read.
    pub contour: Contour,
    /// Displacement thresholds of the surface of exceedance frequencies \[m\].
    pub thresholds_m: Grid,
    /// Whether the surface is kept.
    pub maf_surface: bool,
    /// What happens to a level outside a hazard curve.
    pub extrapolate: Extrapolate,
}

/// How an ordinate of the spectrum is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contour {
    /// As the exact quantile: the smallest displacement whose frequency meets the target.
    Exact,
    /// From the surface, log-linear between thresholds.
    Grid,
}

/// What happens to a level outside a hazard curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extrapolate {
    /// It is an error.
    Refuse,
    /// The curve goes on as a straight line in logarithms.
    Loglog,
}

/// A site.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Its name, of no other site.
    pub name: String,
    /// Its hazard curves, at most one of each measure; at least those of the measures studied.
    pub curves: Vec<CurveFile>,
}

impl Site {
    /// The hazard curve of `measure`.
    pub fn curve(&self, measure: IntensityMeasure) -> Option<&CurveFile> {
        self.curves.iter().find(|curve| curve.measure == measure)
    }
}

/// A file with a hazard curve, and what its numbers mean.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveFile {
    /// The measure.
    pub measure: IntensityMeasure,
    /// The file, absolute; none where the mean of the branches is taken.
    pub file: Option<PathBuf>,
    /// Unit of its levels, and of those of the branches.
    pub unit: CurveUnit,
    /// What it gives for each level.
    pub kind: CurveKind,
    /// Epistemic uncertainty: weighted alternatives to the curve; none, or two and more whose weights add up to 1.
    pub branches: Vec<Branch>,
}

impl CurveFile {
    /// Every file with numbers of this curve.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        self.file.iter().chain(self.branches.iter().map(|branch| &branch.file)).map(PathBuf::as_path)
    }
}

/// One of several weighted hazard curves of a site, a realization of a logic tree for instance.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Its name, of no other branch of the curve.
    pub name: String,
    /// Its weight \[-\].
    pub weight: f64,
    /// The file, absolute.
    pub file: PathBuf,
}

/// The unit of the levels in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveUnit {
    /// Centimetres per second.
    CmPerS,
    /// Metres per second.
    MPerS,
    /// Of gravity.
    G,
    /// Metres per second squared.
    MPerS2,
    /// Centimetres per second squared.
    CmPerS2,
}

impl CurveUnit {
    /// The symbol: cm/s, m/s, g, m/s2, cm/s2.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::CmPerS => "cm/s",
            Self::MPerS => "m/s",
            Self::G => "g",
            Self::MPerS2 => "m/s2",
            Self::CmPerS2 => "cm/s2",
        }
    }
}

/// What a file gives for each level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveKind {
    /// The mean annual frequency of exceedance \[1/yr\].
    Maf,
    /// The probability of exceedance \[-\].
    Poe {
        /// Time that it refers to \[yr\].
        years: f64,
    },
}

/// The fit of Eq. 4.11.
#[derive(Debug, Clone, PartialEq)]
pub struct Regression {
    /// Only strengths above this take part \[-\].
    pub strength_above: f64,
}

/// The bootstrap over records (Section 4.5).
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
#[serde(default)]
pub struct Bootstrap {
    /// Records in a sample; if none, 20, 40, 60 and 80 as far as the set has more, and the whole set.
    pub sizes: Option<Vec<u32>>,
    /// Samples of each size.
    pub replicates: u64,
    /// Share of the replicates between the limits of a band \[-\].
    pub confidence: f64,
    /// How a limit is read.
    pub interval: IntervalKind,
    /// Whether bands that hold whole spectra are made too.
    pub simultaneous: bool,
    /// Only strengths above this count in Eq. 4.9 and 4.10 \[-\].
    pub strength_above: f64,
}

impl Default for Bootstrap {
    /// As in Section 4.5: 1000 replicates, 90 % between the limits, percentiles.
    fn default() -> Self {
        Self {
            sizes: None,
            replicates: 1000,
            confidence: 0.9,
            interval: IntervalKind::Percentile,
            simultaneous: false,
            strength_above: 0.0,
        }
    }
}

/// How the limits of a band are read from the replicates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum IntervalKind {
    /// As their quantiles.
    Percentile,
    /// As their quantiles at levels corrected for bias and skewness.
    Bca,
}

/// What is written where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// The result file, absolute; it need not exist.
    pub file: PathBuf,
    /// Whether tables are written as CSV beside it.
    pub csv: bool,
}

impl Output {
    /// The folder of the results.
    pub fn folder(&self) -> &Path {
        self.file.parent().unwrap_or(&self.file)
    }
}
