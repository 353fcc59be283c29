//! The hazard curve as a value.

use std::fmt::Write as _;

use crate::component::ComponentDefinition;
use crate::error::{HazardError, Place, check_positive};
use crate::unit::{CurveUnit, Dimension, same_unit};

/// One point of a hazard curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HazardPoint {
    /// Intensity level, in the curve's unit.
    pub im: f64,
    /// Mean annual frequency of exceeding it, 1/yr.
    pub maf: f64,
}

/// A site's hazard curve λ(im): mean annual frequency of exceeding each level of one intensity measure.
///
/// A curve that exists is valid: at least 2 points, levels finite, above 0 and strictly increasing, rates finite, above
/// 0 and strictly decreasing. So it can be inverted, and both logarithms exist.
///
/// # Source
/// Reggiani Manzo, dissertation, Section 4.3.2.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    measure: String,
    unit: String,
    source: String,
    component: Option<ComponentDefinition>,
    im: Vec<f64>,
    maf: Vec<f64>,
}

impl HazardCurve {
    /// Builds a curve from levels `im`, in `unit`, and annual rates of exceedance `maf`, 1/yr, one per level.
    ///
    /// `measure` is the intensity measure ("PGV", "PGA", "SA(1.0)", or any other name), `unit` its unit ("cm/s", "g"),
    /// `source` says where the numbers come from and may be empty. PGV, CAV and the Arias intensity must be in a unit
    /// of velocity, PGA and SA in one of acceleration, PGD and SI in one of displacement; other measures may have any
    /// unit.
    ///
    /// # Errors
    /// [`HazardError`] with the index and both values for the first point that breaks a rule; an empty label; a unit
    /// that does not belong to the measure.
    pub fn new(
        measure: impl Into<String>,
        unit: impl Into<String>,
        source: impl Into<String>,
        im: Vec<f64>,
        maf: Vec<f64>,
    ) -> Result<Self, HazardError> {
        Self::new_at(measure.into(), unit.into(), source.into(), im, maf, Place::Point)
    }

    /// [`HazardCurve::new`] for a reader, which knows better names for its points than an index.
    pub(crate) fn new_at(
        measure: String,
        unit: String,
        source: String,
        im: Vec<f64>,
        maf: Vec<f64>,
        place: impl Fn(usize) -> Place,
    ) -> Result<Self, HazardError> {
        check_labels(&measure, &unit)?;
        if im.len() != maf.len() {
            return Err(HazardError::LengthMismatch { im: im.len(), maf: maf.len() });
        }
        if im.len() < 2 {
            return Err(HazardError::TooFewPoints { name: format!("hazard curve of {measure}"), found: im.len() });
        }
        for (index, (&level, &rate)) in im.iter().zip(&maf).enumerate() {
            for (what, value, its_unit) in [("intensity", level, unit.as_str()), ("annual rate", rate, "1/yr")] {
                if !(value.is_finite() && value > 0.0) {
                    let what = format!("{what} [{its_unit}]");
                    return Err(HazardError::NotPositive { place: place(index), what, value });
                }
            }
            let Some(before) = index.checked_sub(1) else {
                continue;
            };
            if level <= im[before] {
                return Err(HazardError::LevelsNotIncreasing {
                    place: place(index),
                    previous_place: place(before),
                    value: level,
                    previous: im[before],
                    unit,
                });
            }
            if rate >= maf[before] {
                return Err(HazardError::RatesNotDecreasing {
                    place: place(index),
                    previous_place: place(before),
                    value: rate,
                    previous: maf[before],
                });
            }
        }
        Ok(Self { measure, unit, source, component: None, im, maf })
    }

    /// The intensity measure, e.g. "PGV".
    pub fn measure(&self) -> &str {
        &self.measure
    }

    /// Unit of the levels, e.g. "cm/s".
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// Where the numbers come from; for a file its comment lines, or its name where it has none.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// How the horizontal components are combined in the measure, where the source says so.
    pub fn component(&self) -> Option<ComponentDefinition> {
        self.component
    }

    /// The same curve with another statement of how the horizontal components are combined; the numbers stay.
    #[must_use]
    pub fn with_component(self, component: Option<ComponentDefinition>) -> Self {
        Self { component, ..self }
    }

    /// The curve of another definition of the measure, `to`: every level is multiplied by `factor`, the ratio of the
    /// measure by `to` over the measure by the definition of this curve.
    ///
    /// # Errors
    /// [`HazardError::Argument`] for a factor that is not finite and above 0; the errors of [`HazardCurve::new`] where
    /// rounding makes levels collapse.
    pub fn converted(&self, factor: f64, to: ComponentDefinition) -> Result<Self, HazardError> {
        check_positive("conversion factor", factor)?;
        let im = self.im.iter().map(|level| level * factor).collect();
        let curve = Self::new(self.measure.clone(), self.unit.clone(), self.source.clone(), im, self.maf.clone())?;
        Ok(curve.with_component(Some(to)))
    }

    /// The curve as the text that [`read_csv`](crate::read_csv) reads back to the bit, the lines of
    /// `remarks` first as comments.
    pub fn to_csv(&self, remarks: &[String]) -> String {
        let component = self.component.map_or_else(String::new, |component| format!("; component: {component}"));
        let mut text = String::new();
        // a String takes everything
        for line in remarks.iter().flat_map(|remark| remark.lines()) {
            let _ = writeln!(text, "# {line}");
        }
        let _ = writeln!(text, "# IM: {} [{}]{component}\niml,maf", self.measure, self.unit);
        for HazardPoint { im, maf } in self.points() {
            let _ = writeln!(text, "{im},{maf:e}");
        }
        text
    }

    /// Intensity levels, strictly increasing, in [`HazardCurve::unit`].
    pub fn im(&self) -> &[f64] {
        &self.im
    }

    /// Mean annual frequencies of exceedance, strictly decreasing, 1/yr.
    pub fn maf(&self) -> &[f64] {
        &self.maf
    }

    /// Number of points, at least 2.
    #[expect(clippy::len_without_is_empty, reason = "a curve is never empty")]
    pub fn len(&self) -> usize {
        self.im.len()
    }

    /// The points in order of increasing intensity.
    pub fn points(&self) -> impl ExactSizeIterator<Item = HazardPoint> + '_ {
        self.im.iter().zip(&self.maf).map(|(&im, &maf)| HazardPoint { im, maf })
    }

    /// The point of lowest intensity and highest rate.
    pub fn first(&self) -> HazardPoint {
        self.point(0)
    }

    /// The point of highest intensity and lowest rate.
    pub fn last(&self) -> HazardPoint {
        self.point(self.len() - 1)
    }

    pub(crate) fn point(&self, index: usize) -> HazardPoint {
        HazardPoint { im: self.im[index], maf: self.maf[index] }
    }

    /// The same curve with its levels in the units of the field: cm/s for velocities, g for accelerations, cm for
    /// displacements.
    ///
    /// `gravity_m_s2` is the acceleration that 1 g stands for, m/s². A curve whose unit is not known here is returned
    /// as it is.
    ///
    /// # Errors
    /// As [`HazardCurve::in_unit`].
    pub fn in_field_units(&self, gravity_m_s2: f64) -> Result<Self, HazardError> {
        match CurveUnit::parse(&self.unit) {
            Some(unit) => self.in_unit(unit.dimension().field_unit().symbol(), gravity_m_s2),
            None => Ok(self.clone()),
        }
    }

    /// The same curve with its levels in another `unit` of the same dimension: cm/s, m/s or g s; g, m/s2 or cm/s2; cm
    /// or m.
    ///
    /// `gravity_m_s2` is the acceleration that 1 g stands for, m/s².
    ///
    /// # Errors
    /// [`HazardError::Conversion`] for unknown units and different dimensions, [`HazardError::Argument`] for a gravity
    /// that is not finite and above 0; the errors of [`HazardCurve::new`] where rounding makes levels collapse.
    pub fn in_unit(&self, unit: &str, gravity_m_s2: f64) -> Result<Self, HazardError> {
        check_positive("gravity [m/s2]", gravity_m_s2)?;
        if same_unit(&self.unit, unit) {
            // No arithmetic, so no rounding.
            return Ok(Self { unit: unit.to_owned(), ..self.clone() });
        }
        let (from, to) = match (CurveUnit::parse(&self.unit), CurveUnit::parse(unit)) {
            (Some(from), Some(to)) if from.dimension() == to.dimension() => (from, to),
            _ => {
                let (measure, from) = (self.measure.clone(), self.unit.clone());
                return Err(HazardError::Conversion { measure, from, to: unit.to_owned() });
            }
        };
        let (numerator, denominator) = (to.per_si(gravity_m_s2), from.per_si(gravity_m_s2));
        let im = self.im.iter().map(|level| level * numerator / denominator).collect();
        let curve = Self::new(self.measure.clone(), unit, self.source.clone(), im, self.maf.clone())?;
        Ok(curve.with_component(self.component))
    }
}

/// Refuses empty labels, and units that a known measure cannot have.
fn check_labels(measure: &str, unit: &str) -> Result<(), HazardError> {
    for (what, label) in [("measure", measure), ("unit", unit)] {
        if label.trim().is_empty() {
            return Err(HazardError::EmptyLabel { what });
        }
    }
    match Dimension::from_measure(measure) {
        Some(dimension) if CurveUnit::parse(unit).map(CurveUnit::dimension) != Some(dimension) => {
            let (measure, unit) = (measure.to_owned(), unit.to_owned());
            Err(HazardError::UnitOfMeasure { measure, unit, expected: dimension.examples() })
        }
        _ => Ok(()),
    }
}
