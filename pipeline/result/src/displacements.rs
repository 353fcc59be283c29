//! The displacement spectra of a result, as figures and tables read them.

use serde::Serialize;
use uplift_job::Array;
use uplift_job::text::metres;
use uplift_spectra::Noisy;
use uplift_study::Kind;

use super::design::BOUNDS;
use super::file::ResultFile;
use super::layout::{axis, set, spectra};
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
    /// What rounding does to some of them; none in results of before.
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
    fn line_axes(&self) -> Vec<(&'static str, usize)> {
        match self {
            Self::Oscillators { uplift_displacement_m, capacity_m } => {
                vec![(axis::UPLIFT_DISPLACEMENT, uplift_displacement_m.len()), (axis::CAPACITY, capacity_m.len())]
            }
            Self::Blocks { height_m } => vec![(axis::HEIGHT, height_m.len())],
        }
    }

    /// The axis of those abscissae at which a run prints its spectra.
    fn printed_axis(&self) -> &'static str {
        match self {
            Self::Oscillators { .. } => axis::PRINTED_STRENGTH,
            Self::Blocks { .. } => axis::PRINTED_SLENDERNESS,
        }
    }

    /// The axis of a spectrum's abscissa.
    fn abscissa_axis(&self) -> &'static str {
        match self {
            Self::Oscillators { .. } => axis::STRENGTH,
            Self::Blocks { .. } => axis::SLENDERNESS,
        }
    }
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
    pub fn of_motion_m(&self, place: SpectrumPlace, line: usize, motion: usize) -> impl Iterator<Item = f64> {
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
        let (scalings, scaled_by) = (reader.axis_text(axis::SCALING)?, reader.axis_text(axis::SCALED_BY)?);
        let percentiles = reader.axis_f64(axis::PERCENTILE)?;
        let abscissas = reader.axis_f64(structures.abscissa_axis())?;
        let sets = reader.axis_text(axis::RECORD_SET)?;
        let shape =
            [sets.len(), scalings.len(), scaled_by.len(), structures.lines(), percentiles.len(), abscissas.len()];
        if shape.contains(&0) {
            return Err(self.damaged("an axis of its spectra is empty"));
        }
        let mut axes =
            vec![(axis::RECORD_SET, sets.len()), (axis::SCALING, scalings.len()), (axis::SCALED_BY, scaled_by.len())];
        axes.extend(structures.line_axes());
        axes.extend([(axis::PERCENTILE, percentiles.len()), (structures.abscissa_axis(), abscissas.len())]);
        let percentile_m = self.checked(spectra::U_M, reader.array_f64(spectra::U_M)?, &axes)?;
        axes.truncate(axes.len() - 1);
        let rounding = self.rounding(&structures, axes, shape)?;
        Ok(StoredDisplacements {
            records: self.record_set()?,
            synthetic: self.is_synthetic()?,
            sets: sets.into_iter().map(|name| self.set(name)).collect::<Result<_, _>>()?,
            scalings,
            scaled_by,
            percentiles,
            structures,
            abscissas,
            percentile_m: Array::new(shape, percentile_m)
                .map_err(|error| self.damaged(format!("{}: {error}", spectra::U_M)))?,
            rounding,
            analyses: reader.attribute_u64(spectra::GROUP, "analyses")?,
        })
    }

    /// What rounding does to percentiles over the first `axes` of their `shape`.
    fn rounding(
        &self,
        structures: &StoredStructures,
        mut axes: Vec<(&'static str, usize)>,
        mut shape: [usize; 6],
    ) -> Result<Option<StoredRounding>, ResultError> {
        if !self.reader.exists(spectra::U_M_ROUNDING) {
            return Ok(None);
        }
        let abscissas = self.reader.axis_f64(structures.printed_axis())?;
        axes.extend([(structures.printed_axis(), abscissas.len()), (axis::BOUND, BOUNDS.len())]);
        shape[5] = abscissas.len();
        let values = self.checked(spectra::U_M_ROUNDING, self.reader.array_f64(spectra::U_M_ROUNDING)?, &axes)?;
        let of = |bounds: &[f64]| Noisy { value: bounds[0], lowest: bounds[1], highest: bounds[2] };
        let percentile_m = Array::new(shape, values.chunks_exact(BOUNDS.len()).map(of).collect())
            .map_err(|error| self.damaged(format!("{}: {error}", spectra::U_M_ROUNDING)))?;
        Ok(Some(StoredRounding { abscissas, percentile_m }))
    }

    /// The motions of the set at the position `position`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn motions(&self, position: usize) -> Result<StoredMotions, ResultError> {
        self.require(Kind::Displacement)?;
        let reader = &self.reader;
        let structures = self.structures()?;
        let sets = reader.axis_text(axis::RECORD_SET)?;
        let Some(set) = sets.get(position) else {
            return Err(self.fail(format!("has {} record sets, and number {} is wanted", sets.len(), position + 1)));
        };
        let pgv_cm_s = reader.array_f64(&set::array(set, "pgv_cm_s"))?;
        let [motion] = &pgv_cm_s.dims[..] else {
            return Err(self.damaged(format!("{} does not run over motions", set::array(set, "pgv_cm_s"))));
        };
        let motion = motion.clone();
        let motions = (motion.as_str(), pgv_cm_s.values.len());
        let texts = |name: &str| {
            let path = set::array(set, name);
            self.checked(&path, reader.array_text(&path)?, &[motions])
        };
        let names = texts("record")?.into_iter().zip(texts("component")?);
        let ways = [reader.axis_text(axis::SCALING)?.len(), reader.axis_text(axis::SCALED_BY)?.len()];
        let abscissas = (structures.abscissa_axis(), reader.axis_f64(structures.abscissa_axis())?.len());
        let mut axes = vec![(axis::SCALING, ways[0]), (axis::SCALED_BY, ways[1])];
        axes.extend(structures.line_axes());
        axes.extend([abscissas, motions]);
        let path = set::array(set, "u_m");
        let u_m = self.checked(&path, reader.array_f64(&path)?, &axes)?;
        let shape = [ways[0], ways[1], structures.lines(), abscissas.1, motions.1];
        if shape.contains(&0) {
            return Err(self.damaged(format!("an axis of {path} is empty")));
        }
        Ok(StoredMotions {
            names: names.map(|(record, component)| format!("{record} {component}")).collect(),
            u_m: Array::new(shape, u_m).map_err(|error| self.damaged(format!("{path}: {error}")))?,
            pgv_cm_s: pgv_cm_s.values,
        })
    }

    fn structures(&self) -> Result<StoredStructures, ResultError> {
        let reader = &self.reader;
        Ok(if reader.attribute_text("/", "structure")? == "block" {
            StoredStructures::Blocks { height_m: reader.axis_f64(axis::HEIGHT)? }
        } else {
            StoredStructures::Oscillators {
                uplift_displacement_m: reader.axis_f64(axis::UPLIFT_DISPLACEMENT)?,
                capacity_m: reader.axis_f64(axis::CAPACITY)?,
            }
        })
    }

    fn set(&self, name: String) -> Result<StoredSet, ResultError> {
        let group = set::group(&name);
        Ok(StoredSet {
            records: self.reader.attribute_u64(&group, "records")?,
            median_pga_g: self.reader.attribute_f64(&group, "median_pga_g")?,
            median_pgv_cm_s: self.reader.attribute_f64(&group, "median_pgv_cm_s")?,
            name,
        })
    }
}
