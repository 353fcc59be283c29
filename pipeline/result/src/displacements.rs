//! The displacement spectra of a result, as figures and tables read them.

use std::collections::BTreeSet;

use serde::Serialize;
use uplift_job::Array;
use uplift_job::text::metres;
use uplift_spectra::Noisy;
use uplift_study::{Kind, Structures};

use super::declared::group;
use super::design::{BOUNDS, bounds};
use super::file::ResultFile;
use super::layout::attribute;
use super::layout::axis::{self, BOUND, PERCENTILE, RECORD_SET, SCALED_BY, SCALING};
use crate::error::ResultError;

/// The displacement spectra of a result file.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredDisplacements {
    /// Where the records come from, in a line.
    pub records: String,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// The record sets.
    pub sets: Vec<StoredSet>,
    /// What motions are scaled to: `unscaled`, `0.5 PGA`.
    pub scalings: Vec<String>,
    /// Whose peak meets it: `component`, `record`.
    pub scaled_by: Vec<String>,
    /// Percentiles over the motions of a set \[%\].
    pub percentiles: Vec<f64>,
    /// What was shaken; every combination has a line in a spectrum.
    pub structures: StoredStructures,
    /// Abscissa of the spectra: uplift strengths `f_up/(m g)`, or slendernesses tan α.
    pub abscissas: Vec<f64>,
    /// Percentiles of the peak displacements `[set, scaling, scaled_by, line, percentile, abscissa]`, m.
    pub percentile_m: Array<6>,
    /// Shares of the motions under which the structure overturned `[set, scaling, scaled_by, line, abscissa]`.
    pub overturned: Array<5>,
    /// What rounding does to some of them; none in older results.
    pub rounding: Option<StoredRounding>,
    /// Nonlinear time histories.
    pub analyses: u64,
}

/// Percentiles with their range over scale factors that differ by rounding.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredRounding {
    /// The abscissae at which they are.
    pub abscissas: Vec<f64>,
    /// Over `[set, scaling, scaled_by, line, percentile, abscissa]`, m.
    pub percentile_m: Array<6, Noisy>,
}

/// A record set.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StoredSet {
    /// Its name.
    pub name: String,
    /// Records.
    pub records: u64,
    /// Median PGA \[g\] (Eq. 2.16).
    pub median_pga_g: f64,
    /// Median PGV \[cm/s\] (Eq. 2.17).
    pub median_pgv_cm_s: f64,
}

/// What was shaken.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub enum StoredStructures {
    /// Oscillators; lines `[uplift displacement, capacity]`.
    Oscillators {
        /// Displacements at uplift `u_up` \[m\].
        uplift_displacement_m: Vec<f64>,
        /// Displacement capacities `u_cap` \[m\], infinite for zero post-uplift stiffness.
        capacity_m: Vec<f64>,
    },
    /// Blocks; lines `[height]`.
    Blocks {
        /// Heights 2H \[m\].
        height_m: Vec<f64>,
    },
}

impl StoredStructures {
    /// Lines of a spectrum.
    pub fn lines(&self) -> usize {
        self.line_axes().iter().map(|(_, length)| length).product()
    }

    /// The axes that tell lines of a spectrum apart, with their lengths.
    pub fn line_axes(&self) -> Vec<(&'static str, usize)> {
        match self {
            Self::Oscillators { uplift_displacement_m, capacity_m } => {
                vec![
                    (axis::UPLIFT_DISPLACEMENT.name, uplift_displacement_m.len()),
                    (axis::CAPACITY.name, capacity_m.len()),
                ]
            }
            Self::Blocks { height_m } => vec![(axis::HEIGHT.name, height_m.len())],
        }
    }

    /// The axes of a spectrum's abscissa, and of those of it at which a run prints its spectra.
    pub fn abscissa_axes(&self) -> [&'static str; 2] {
        match self {
            Self::Oscillators { .. } => [axis::STRENGTH.name, axis::PRINTED_STRENGTH.name],
            Self::Blocks { .. } => [axis::SLENDERNESS.name, axis::PRINTED_SLENDERNESS.name],
        }
    }

    /// Names of the axes of a spectrum.
    pub fn names(&self) -> [(&'static str, &'static str); 4] {
        let [line, of_line] = match self {
            Self::Oscillators { .. } => [axis::UPLIFT_DISPLACEMENT.name, axis::CAPACITY.name],
            Self::Blocks { .. } => [axis::HEIGHT.name, ""],
        };
        let [abscissa, printed] = self.abscissa_axes();
        [("<line>", line), ("<of_line>", of_line), ("<abscissa>", abscissa), ("<printed>", printed)]
    }
}

impl From<&Structures> for StoredStructures {
    fn from(structures: &Structures) -> Self {
        match structures {
            Structures::Oscillators(family) => Self::Oscillators {
                uplift_displacement_m: family.uplift_displacement_m.to_vec(),
                capacity_m: family.capacity_m.clone(),
            },
            Structures::Blocks(family) => Self::Blocks { height_m: family.height_m.to_vec() },
        }
    }
}

/// What a set asks of the structures. A way of scaling is `[to, by]` of the study; a line is a combination of uplift
/// displacement and capacity, or a height; the abscissa is a strength or a slenderness.
#[derive(Debug, Clone)]
pub struct SetSpectra {
    /// Peak displacements over `[way, line, abscissa, motion]`, m; infinite where the structure overturned.
    pub displacement_m: Vec<f64>,
    /// What each motion is multiplied by, over `[way, motion]`.
    pub factors: Vec<f64>,
    /// Their percentiles over `[way, line, percentile, abscissa]`, m.
    pub percentile_m: Vec<f64>,
    /// Shares of the motions under which the structure overturned, over `[way, line, abscissa]`.
    pub overturned: Vec<f64>,
    /// Largest abscissa at which a percentile is infinite, over `[way, line, percentile]`; NaN where it never is.
    pub critical: Vec<f64>,
}

group! {
    /// Percentiles over the motions of each set.
    pub const SPECTRA: SetSpectra = "/spectra";
    "u_m" [RECORD_SET, SCALING, SCALED_BY, "<line>", "<of_line>", PERCENTILE, "<abscissa>"] F64 "m"
        "percentile of the peak displacements, infinite where it falls on an overturned structure"
        ("percentile of the peak displacements; `inf` where it falls on a motion under which the structure overturns")
        = |of, at| of.percentile_m[at];
    "overturned" [RECORD_SET, SCALING, SCALED_BY, "<line>", "<of_line>", "<abscissa>"] F64 "1"
        "share of the motions under which the structure overturns" = |of, at| of.overturned[at];
    "critical" [RECORD_SET, SCALING, SCALED_BY, "<line>", "<of_line>", PERCENTILE] F64 "1"
        "largest <abscissa> at which the percentile is infinite"
        ("largest abscissa at which the percentile is infinite: the figures draw a line to the right of it; NaN if \
          there is none") = |of, at| of.critical[at];
}

group! {
    /// Printed percentiles of each set with their range over scale factors that differ by rounding.
    pub const ROUNDED_SPECTRA: Vec<Noisy> = SPECTRA.path;
    "u_m_rounding" [RECORD_SET, SCALING, SCALED_BY, "<line>", "<of_line>", PERCENTILE, "<printed>", BOUND]
        Made "m" "printed percentile of the peak displacements, with scale factors some 1e-15 smaller and larger"
        ("the percentile there, and the lowest and highest that it takes with all scale factors up to 4e-15 smaller \
          and larger ([method](method.md), Section 1.5); absent in earlier results")
        = |of, at| bounds(of[at / BOUNDS.len()])[at % BOUNDS.len()];
}

group! {
    /// Every peak displacement of a set.
    pub const SET_SPECTRA: SetSpectra = MOTIONS.path;
    "u_m" [SCALING, SCALED_BY, "<line>", "<of_line>", "<abscissa>", "<motion>"] F64 "m"
        "peak displacement, infinite where overturned" ("every peak displacement; `inf` = overturned")
        = |of, at| of.displacement_m[at];
    "factor" [SCALING, SCALED_BY, "<motion>"] F64 "1" "factor on the motion" ("what the motion is multiplied by")
        = |of, at| of.factors[at];
}

/// A motion of a set: a horizontal component of a record.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StoredMotion {
    /// PGA, unscaled \[g\].
    pub pga_g: f64,
    /// PGV, unscaled \[cm/s\].
    pub pgv_cm_s: f64,
    /// PGA of the record \[g\].
    pub record_pga_g: f64,
    /// PGV of the record \[cm/s\].
    pub record_pgv_cm_s: f64,
    /// Its record.
    pub record: String,
    /// `h1` or `h2`.
    pub component: String,
    /// Its earthquake; empty if not known.
    pub event: String,
    /// Its station; empty if not known.
    pub station: String,
    /// Moment magnitude; NaN if not known.
    pub magnitude: f64,
    /// Closest distance to the rupture \[km\]; NaN if not known.
    pub rrup_km: f64,
    /// Mean shear-wave velocity of the upper 30 m \[m/s\]; NaN if not known.
    pub vs30: f64,
    /// Sampling interval \[s\].
    pub dt_s: f64,
    /// Number of samples.
    pub samples: u32,
    /// SHA-256 of the component.
    pub checksum: String,
}

group! {
    /// The motions of a set, a row each; first what figures put them in order by.
    pub const MOTIONS: StoredMotion = "/sets/<set>";
    "pgv_cm_s" ["<motion>"] F64 "cm/s" "PGV of the component, unscaled" = |of, _at| of.pgv_cm_s;
    "pga_g" ["<motion>"] F64 "g" "PGA of the component, unscaled" = |of, _at| of.pga_g;
    "record_pga_g" ["<motion>"] F64 "g" "PGA of the record, geometric mean"
        ("PGA of the record, geometric mean over both components") = |of, _at| of.record_pga_g;
    "record_pgv_cm_s" ["<motion>"] F64 "cm/s" "PGV of the record, geometric mean" = |of, _at| of.record_pgv_cm_s;
    "record" ["<motion>"] Text "" "record" = |of, _at| of.record;
    "component" ["<motion>"] Text "" "horizontal component" ("`h1` or `h2`") = |of, _at| of.component;
    "event" ["<motion>"] Text "" "earthquake" ("earthquake; empty if not known") = |of, _at| of.event;
    "station" ["<motion>"] Text "" "recording station" ("recording station; empty if not known")
        = |of, _at| of.station;
    "magnitude" ["<motion>"] F64 "1" "moment magnitude" ("moment magnitude; NaN if not known, as the next ones")
        = |of, _at| of.magnitude;
    "rrup_km" ["<motion>"] F64 "km" "closest distance to the rupture" = |of, _at| of.rrup_km;
    "vs30" ["<motion>"] F64 "m/s" "mean shear-wave velocity of the upper 30 m" = |of, _at| of.vs30;
    "dt_s" ["<motion>"] F64 "s" "sampling interval" = |of, _at| of.dt_s;
    "samples" ["<motion>"] U32 "1" "number of samples" = |of, _at| of.samples;
    "checksum" ["<motion>"] Text "" "SHA-256 of the component" ("SHA-256 of its file; of the samples if synthetic")
        = |of, _at| of.checksum;
}

/// Which spectrum: positions in a result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SpectrumPlace {
    /// Record set.
    pub set: usize,
    /// What its motions are scaled to.
    pub scaling: usize,
    /// Whose peak meets it.
    pub scaled_by: usize,
}

/// The motions of one set.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredMotions {
    /// `<record> h1`, `<record> h2`.
    pub names: Vec<String>,
    /// PGV of the component, unscaled \[cm/s\].
    pub pgv_cm_s: Vec<f64>,
    /// Peak displacements `[scaling, scaled_by, line, abscissa, motion]`, m.
    pub u_m: Array<5>,
}

impl StoredMotions {
    /// Peak displacements under the motion at `motion` over the abscissas, m; the set of `place` does not matter.
    pub fn motion_displacements_m(
        &self,
        place: SpectrumPlace,
        line: usize,
        motion: usize,
    ) -> impl Iterator<Item = f64> {
        let abscissas = self.u_m.block([place.scaling, place.scaled_by, line]);
        abscissas.chunks_exact(self.names.len()).map(move |motions| motions[motion])
    }
}

impl StoredDisplacements {
    /// Percentile of the peak displacements over the abscissas \[m\]: of the spectrum at `place`, its line and
    /// percentile by position.
    pub fn percentile_m(&self, place: SpectrumPlace, line: usize, percentile: usize) -> &[f64] {
        self.percentile_m.block([place.set, place.scaling, place.scaled_by, line, percentile])
    }
}

impl StoredDisplacements {
    /// Abscissae of the spectrum at `place` where rounding alone changes the digits that a run prints, with the
    /// ordinate and its range, m.
    pub fn hanging_on_rounding(
        &self,
        place: SpectrumPlace,
        line: usize,
        percentile: usize,
    ) -> impl Iterator<Item = (f64, Noisy)> {
        self.rounding.iter().flat_map(move |rounding| {
            let at = [place.set, place.scaling, place.scaled_by, line, percentile];
            let ordinates = rounding.percentile_m.block(at).iter().copied();
            let of = rounding.abscissas.iter().copied().zip(ordinates);
            of.filter(|(_, ordinate)| ordinate.shows_otherwise(metres))
        })
    }
}

impl ResultFile {
    /// The displacement spectra of a result of these.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn displacements(&self) -> Result<StoredDisplacements, ResultError> {
        self.require(Kind::Displacement)?;
        let reader = &self.reader;
        let structures = self.structures()?;
        let (scalings, scaled_by) = (reader.axis::<String>(SCALING.name)?, reader.axis::<String>(SCALED_BY.name)?);
        let percentiles = reader.axis::<f64>(PERCENTILE.name)?;
        let (names, [abscissa, printed]) = (structures.names(), structures.abscissa_axes());
        let abscissas = reader.axis::<f64>(abscissa)?;
        let sets = reader.axis::<String>(RECORD_SET.name)?;
        let mut shape =
            [sets.len(), scalings.len(), scaled_by.len(), structures.lines(), percentiles.len(), abscissas.len()];
        if shape.contains(&0) {
            return Err(self.damaged("an axis of its spectra is empty"));
        }
        let mut lengths =
            vec![(RECORD_SET.name, sets.len()), (SCALING.name, scalings.len()), (SCALED_BY.name, scaled_by.len())];
        lengths.extend(structures.line_axes());
        lengths.extend([(PERCENTILE.name, percentiles.len()), (abscissa, abscissas.len()), (BOUND.name, BOUNDS.len())]);
        let u_m = SPECTRA.read_floats("u_m", self, &names, &lengths)?;
        let percentile_m = Array::new(shape, u_m).map_err(|error| self.damaged(error))?;
        let [of_set, to, by, line, _, of_abscissa] = shape;
        let overturned = SPECTRA.read_floats("overturned", self, &names, &lengths)?;
        let overturned = Array::new([of_set, to, by, line, of_abscissa], overturned);
        let overturned = overturned.map_err(|error| self.damaged(error))?;
        let rounding = if ROUNDED_SPECTRA.is_in(self, &names) {
            let abscissas = reader.axis::<f64>(printed)?;
            lengths.push((printed, abscissas.len()));
            shape[5] = abscissas.len();
            let values = ROUNDED_SPECTRA.read_floats("u_m_rounding", self, &names, &lengths)?;
            let of = |bounds: &[f64]| Noisy { value: bounds[0], lowest: bounds[1], highest: bounds[2] };
            let values = values.chunks_exact(BOUNDS.len()).map(of).collect();
            let percentile_m = Array::new(shape, values).map_err(|error| self.damaged(error))?;
            Some(StoredRounding { abscissas, percentile_m })
        } else {
            None
        };
        Ok(StoredDisplacements {
            records: self.record_set()?,
            synthetic: self.is_synthetic()?,
            sets: sets.into_iter().map(|name| self.set(name)).collect::<Result<_, _>>()?,
            scalings,
            scaled_by,
            percentiles,
            structures,
            abscissas,
            percentile_m,
            overturned,
            rounding,
            analyses: attribute::spectra::ANALYSES.read(reader, &[])?,
        })
    }

    /// The motions of the set at the position `position`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn motions(&self, position: usize) -> Result<StoredMotions, ResultError> {
        self.require(Kind::Displacement)?;
        let reader = &self.reader;
        let structures = self.structures()?;
        let sets = reader.axis::<String>(RECORD_SET.name)?;
        let Some(set) = sets.get(position) else {
            return Err(self.fail(format!("has {} record sets, and number {} is wanted", sets.len(), position + 1)));
        };
        let mut taken = BTreeSet::new();
        let motion = sets[..=position].iter().map(|set| axis::motion(set, &mut taken)).last().unwrap_or_default();
        let motions = reader.axis::<String>(&motion)?;
        let names = [&structures.names()[..], &[("<set>", set), ("<motion>", &motion)]].concat();
        let [abscissa, _] = structures.abscissa_axes();
        let ways = [reader.axis::<String>(SCALING.name)?.len(), reader.axis::<String>(SCALED_BY.name)?.len()];
        let mut lengths = vec![(SCALING.name, ways[0]), (SCALED_BY.name, ways[1]), (motion.as_str(), motions.len())];
        lengths.extend(structures.line_axes());
        lengths.push((abscissa, reader.axis::<f64>(abscissa)?.len()));
        let shape = [ways[0], ways[1], structures.lines(), lengths[lengths.len() - 1].1, motions.len()];
        if shape.contains(&0) {
            return Err(self.damaged(format!("an axis of {} is empty", SET_SPECTRA.first_path(&names))));
        }
        let u_m = SET_SPECTRA.read_floats("u_m", self, &names, &lengths)?;
        Ok(StoredMotions {
            names: motions,
            u_m: Array::new(shape, u_m).map_err(|error| self.damaged(error))?,
            pgv_cm_s: MOTIONS.read_floats("pgv_cm_s", self, &names, &lengths)?,
        })
    }

    /// Whether the motions of the set `name` are exactly these.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn holds_motions(&self, name: &str, motions: &[StoredMotion]) -> Result<bool, ResultError> {
        MOTIONS.holds(self, &[("<set>", name)], motions)
    }

    fn structures(&self) -> Result<StoredStructures, ResultError> {
        let reader = &self.reader;
        Ok(if attribute::root::STRUCTURE.read(reader, &[])? == "block" {
            StoredStructures::Blocks { height_m: reader.axis::<f64>(axis::HEIGHT.name)? }
        } else {
            StoredStructures::Oscillators {
                uplift_displacement_m: reader.axis::<f64>(axis::UPLIFT_DISPLACEMENT.name)?,
                capacity_m: reader.axis::<f64>(axis::CAPACITY.name)?,
            }
        })
    }

    fn set(&self, name: String) -> Result<StoredSet, ResultError> {
        let names = [("<set>", &*name)];
        Ok(StoredSet {
            records: attribute::set::RECORDS.read(&self.reader, &names)?,
            median_pga_g: attribute::set::MEDIAN_PGA_G.read(&self.reader, &names)?,
            median_pgv_cm_s: attribute::set::MEDIAN_PGV_CM_S.read(&self.reader, &names)?,
            name,
        })
    }
}
