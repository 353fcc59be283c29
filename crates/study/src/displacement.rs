//! A study of displacement spectra: what record sets ask of rocking structures, without any hazard (Sections 2.4, 3.4 and 3.5 of
//! Reggiani Manzo's dissertation).

mod form;
mod lists;
mod read;
mod sets;
mod structures;

use std::path::Path;

use uplift_motion::IntensityMeasure;
use uplift_spectra::{NoiseSweep, ScaledBy, Scaling, SpectraError};

use super::grid::Grid;
use super::resolved::{Output, RecordSource};
use super::selection::RecordSelection;
use form::Form;
pub(super) use read::study;

/// A study of displacement spectra with every default filled in, every path found and every unit checked.
///
/// It is serialised as a study file that loads to an equal value, wherever it is stored.
#[derive(Debug, Clone, PartialEq)]
pub struct DisplacementStudy {
    /// Free text.
    pub title: String,
    /// Acceleration of gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// Which ground motions there are to choose from.
    pub records: SetRecords,
    /// The record sets; where none is named, all records are one.
    pub record_sets: Vec<SetPlan>,
    /// How the motions of a set are scaled.
    pub scaling: ScalingPlan,
    /// Percentiles of the displacements of a set \[%\].
    pub percentiles: Grid,
    /// What is shaken.
    pub structures: Structures,
    /// The design example, if asked for.
    pub design: Option<DesignPlan>,
    /// What is written where.
    pub output: Output,
    /// What is allowed but probably not meant.
    pub warnings: Vec<String>,
}

impl DisplacementStudy {
    /// The study as TOML, complete and loadable; the warnings are left out, since loading finds them again.
    ///
    /// # Errors
    ///
    /// Where TOML cannot hold a value; a study that was loaded has none such.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(&Form::of(self))
    }
}

/// Which ground motions there are to choose from.
#[derive(Debug, Clone, PartialEq)]
pub struct SetRecords {
    /// Where they come from; the tag is that of a set, not of them all.
    pub source: RecordSource,
    /// Which of them are used, in every set.
    pub select: RecordSelection,
    /// Use only so many of the records of each set, the first; all if none.
    pub first: Option<u64>,
}

impl SetRecords {
    /// The manifest, if the records are of one.
    pub fn manifest(&self) -> Option<&Path> {
        match &self.source {
            RecordSource::Manifest { manifest, .. } => Some(manifest),
            RecordSource::Synthetic { .. } => None,
        }
    }
}

/// A record set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SetPlan {
    /// Its name, of no other set.
    pub name: String,
    /// Only rows of the manifest whose `set_tags` contain it; all rows if none.
    pub tag: Option<String>,
    /// Records that do not belong to it, by identifier or record sequence number.
    pub leave_out: Vec<String>,
}

/// How the motions of a set are scaled.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalingPlan {
    /// To what; at least one.
    pub to: Vec<ScaledTo>,
    /// By whose peak; at least one.
    pub by: Vec<ScaledBy>,
}

impl ScalingPlan {
    /// The ways of scaling that differ, and which of them each combination `[to][by]` is: motions that are not scaled are the same
    /// whosever peak it would be.
    pub fn ways(&self) -> (Vec<Scaling>, Vec<usize>) {
        let mut ways: Vec<Scaling> = Vec::new();
        let mut places = Vec::new();
        for (&to, &by) in self.to.iter().flat_map(|to| self.by.iter().map(move |by| (to, by))) {
            let way = match to {
                ScaledTo::Unscaled => Scaling::Unscaled,
                ScaledTo::Median { multiple, measure } => Scaling::To { measure, multiple, by },
            };
            places.push(ways.iter().position(|known| *known == way).unwrap_or_else(|| {
                ways.push(way);
                ways.len() - 1
            }));
        }
        (ways, places)
    }
}

/// What the motions of a set are scaled to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ScaledTo {
    /// As recorded.
    Unscaled,
    /// A multiple of the set's median peak (Eq. 2.16, 2.17).
    Median {
        /// The multiple.
        multiple: f64,
        /// Of which peak.
        measure: IntensityMeasure,
    },
}

impl std::fmt::Display for ScaledTo {
    /// `unscaled`, or `0.5 PGA`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unscaled => f.write_str("unscaled"),
            Self::Median { multiple, measure } => write!(f, "{multiple} {}", measure.label()),
        }
    }
}

impl ScaledTo {
    /// Reads `unscaled`, `0.5 PGA` or `0.5PGA`, capitals aside; none for anything else.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim().to_lowercase();
        if text == "unscaled" {
            return Some(Self::Unscaled);
        }
        IntensityMeasure::ALL.into_iter().find_map(|measure| {
            let multiple: f64 = text.strip_suffix(measure.key())?.trim().parse().ok()?;
            (multiple.is_finite() && multiple > 0.0).then_some(Self::Median { multiple, measure })
        })
    }
}

/// What is shaken.
#[derive(Debug, Clone, PartialEq)]
pub enum Structures {
    /// Oscillators that uplift, by strength (Chapter 3).
    Oscillators(OscillatorFamily),
    /// Rigid blocks, by slenderness (Chapter 2).
    Blocks(BlockFamily),
}

/// Oscillators of every strength, uplift displacement and capacity of these.
#[derive(Debug, Clone, PartialEq)]
pub struct OscillatorFamily {
    /// Displacements at uplift `u_up` \[m\].
    pub uplift_displacement_m: Grid,
    /// Displacements at which the force is zero `u_cap` \[m\]; infinite for zero post-uplift stiffness.
    pub capacity_m: Vec<f64>,
    /// Coefficient of restitution of the velocity at each impact \[-\].
    pub restitution: f64,
    /// Whether the free motion after the end of a record counts.
    pub free_vibration: bool,
    /// Uplift strengths η = `f_up`/(m g) \[-\].
    pub strengths: Grid,
}

/// Blocks of every height and slenderness of these.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockFamily {
    /// Heights 2H \[m\].
    pub height_m: Grid,
    /// Coefficient of restitution of the angular velocity at each impact \[-\]; Housner's (Eq. 2.3) if none.
    pub restitution: Option<f64>,
    /// Slendernesses tan α \[-\].
    pub slendernesses: Grid,
}

impl Structures {
    /// The abscissa of the spectra: strengths or slendernesses.
    pub fn abscissa(&self) -> &Grid {
        match self {
            Self::Oscillators(family) => &family.strengths,
            Self::Blocks(family) => &family.slendernesses,
        }
    }

    /// How many lines a spectrum has: all combinations but for the abscissa.
    pub fn lines(&self) -> usize {
        match self {
            Self::Oscillators(family) => family.uplift_displacement_m.len() * family.capacity_m.len(),
            Self::Blocks(family) => family.height_m.len(),
        }
    }
}

/// A design example (Section 2.4.3 or 3.4.5).
#[derive(Debug, Clone, PartialEq)]
pub struct DesignPlan {
    /// What is designed.
    pub designed: Designed,
    /// Safety factor FS \[-\].
    pub safety_factor: f64,
    /// Percentile of the displacements that counts \[%\].
    pub percentile: f64,
    /// Width of the sweep around each value that shows its noise, relative to the abscissa \[-\].
    pub noise_relative: f64,
    /// Points of that sweep, an odd number.
    pub noise_points: usize,
}

impl DesignPlan {
    /// The sweep around each value.
    ///
    /// # Errors
    /// None for a study that was loaded: its width and points were checked.
    pub fn noise(&self) -> Result<NoiseSweep, SpectraError> {
        NoiseSweep::new(self.noise_relative, self.noise_points)
    }
}

/// What is designed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Designed {
    /// The capacity of a restrained bridge; its strength is that of its columns, tan(2b/2h) as Section 3.5 writes it.
    Bridge {
        /// Width of a column 2b, the capacity without restraint \[m\].
        width_m: f64,
        /// Height of a column 2h \[m\].
        height_m: f64,
    },
    /// The slenderness of a block.
    Block {
        /// Its height 2H \[m\].
        height_m: f64,
        /// Height that stands for an endless one \[m\].
        endless_height_m: f64,
    },
}
