//! The displacement spectra of a result file, as figures and tables read them.

use std::path::Path;

use crate::error::UpliftError;
use crate::result::open_any_result;
use uplift_labelled::LabelledReader;

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
    /// `[set, scaling, scaled_by, line, percentile, abscissa]`, m.
    percentile_m: Vec<f64>,
}

/// A record set.
#[derive(Debug, Clone, PartialEq)]
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
#[derive(Debug, Clone, PartialEq)]
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
        match self {
            Self::Oscillators { uplift_displacement_m, capacity_m } => uplift_displacement_m.len() * capacity_m.len(),
            Self::Blocks { height_m } => height_m.len(),
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
    u_m: Vec<f64>,
}

impl StoredDisplacements {
    /// Read the displacement spectra of the result at `path`.
    ///
    /// # Errors
    /// A file that is missing, damaged, no result of displacement spectra, or of another layout.
    pub fn read(path: &Path) -> Result<Self, UpliftError> {
        let reader = open_any_result(path)?;
        let damaged = |what: &str| {
            UpliftError::input(format!("{}: {what} has not the shape of its axes: the file is damaged", path.display()))
        };
        let structures = if reader.attribute_text("/", "structure")? == "block" {
            StoredStructures::Blocks { height_m: reader.axis_f64("height")? }
        } else {
            StoredStructures::Oscillators {
                uplift_displacement_m: reader.axis_f64("uplift_displacement")?,
                capacity_m: reader.axis_f64("capacity")?,
            }
        };
        let abscissa = match structures {
            StoredStructures::Oscillators { .. } => "strength",
            StoredStructures::Blocks { .. } => "slenderness",
        };
        let stored = Self {
            records: reader.attribute_text("/", "record_set")?,
            synthetic: reader.attribute_i64("/", "synthetic")? == 1,
            sets: reader
                .axis_text("record_set")?
                .into_iter()
                .map(|name| StoredSet::read(&reader, name))
                .collect::<Result<_, _>>()?,
            scalings: reader.axis_text("scaling")?,
            scaled_by: reader.axis_text("scaled_by")?,
            percentiles: reader.axis_f64("percentile")?,
            structures,
            abscissas: reader.axis_f64(abscissa)?,
            percentile_m: reader.array_f64("/spectra/u_m")?.values,
        };
        let spectra = stored.sets.len() * stored.scalings.len() * stored.scaled_by.len();
        let of_a_spectrum = stored.structures.lines() * stored.percentiles.len() * stored.abscissas.len();
        if stored.percentile_m.is_empty() || stored.percentile_m.len() != spectra * of_a_spectrum {
            return Err(damaged("/spectra/u_m"));
        }
        Ok(stored)
    }

    /// The motions of the set at the position `set`, of the file at `path` that this was read from.
    ///
    /// # Errors
    /// A file that is missing or damaged.
    pub fn motions(&self, path: &Path, set: usize) -> Result<StoredMotions, UpliftError> {
        let reader = open_any_result(path)?;
        let name = &self.sets[set].name;
        let group = format!("/sets/{name}");
        let texts = |array: &str| reader.array_text(&format!("{group}/{array}")).map(|array| array.values);
        let names = texts("record")?.into_iter().zip(texts("component")?);
        let motions = StoredMotions {
            names: names.map(|(record, component)| format!("{record} {component}")).collect(),
            pgv_cm_s: reader.array_f64(&format!("{group}/pgv_cm_s"))?.values,
            u_m: reader.array_f64(&format!("{group}/u_m"))?.values,
        };
        let spectra = self.scalings.len() * self.scaled_by.len() * self.structures.lines() * self.abscissas.len();
        let count = motions.names.len();
        if count == 0 || motions.pgv_cm_s.len() != count || motions.u_m.len() != spectra * count {
            return Err(UpliftError::input(format!(
                "{}: {group} has not the shape of its axes: the file is damaged",
                path.display()
            )));
        }
        Ok(motions)
    }

    /// Percentile of the peak displacements over the abscissas \[m\]: of the spectrum at `place`, its line and percentile by position.
    pub fn percentile_m(&self, place: SpectrumPlace, line: usize, percentile: usize) -> &[f64] {
        let row = (self.line(place, line) * self.percentiles.len() + percentile) * self.abscissas.len();
        &self.percentile_m[row..row + self.abscissas.len()]
    }

    /// Peak displacements under one of `motions` over the abscissas, m.
    pub fn motion_m<'a>(
        &self,
        motions: &'a StoredMotions,
        place: SpectrumPlace,
        line: usize,
        motion: usize,
    ) -> impl Iterator<Item = f64> + 'a {
        let count = motions.names.len();
        let start = self.line(SpectrumPlace { set: 0, ..place }, line) * self.abscissas.len() * count;
        motions.u_m[start..start + self.abscissas.len() * count].iter().skip(motion).step_by(count).copied()
    }

    /// Position of a line among those of all spectra.
    fn line(&self, place: SpectrumPlace, line: usize) -> usize {
        let spectrum = (place.set * self.scalings.len() + place.scaling) * self.scaled_by.len() + place.scaled_by;
        spectrum * self.structures.lines() + line
    }
}

impl StoredSet {
    fn read(reader: &LabelledReader, name: String) -> Result<Self, UpliftError> {
        let group = format!("/sets/{name}");
        Ok(Self {
            records: reader.attribute_u64(&group, "records")?,
            median_pga_g: reader.attribute_f64(&group, "median_pga_g")?,
            median_pgv_cm_s: reader.attribute_f64(&group, "median_pgv_cm_s")?,
            name,
        })
    }
}
