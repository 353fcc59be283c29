//! The components of a record set as independent motions.

use uplift_ida::{IdaError, Plan, ScaledMotion, System};
use uplift_motion::{Accelerogram, IntensityMeasure, geometric_mean};

use crate::error::SpectraError;
use crate::scaling::{ScaledBy, Scaling};
use crate::statistics::percentile;

/// A record as a set takes it.
#[derive(Debug, Clone, Copy)]
pub struct RecordOfSet<'a> {
    /// Identifier, for messages and results.
    pub id: &'a str,
    /// Its two horizontal components.
    pub components: [&'a Accelerogram; 2],
}

/// One horizontal component as an independent motion (Section 3.4.1).
#[derive(Debug, Clone)]
pub struct Motion<'a> {
    /// Record and component, `RSN753 h1`.
    pub id: String,
    /// The component.
    pub accelerogram: &'a Accelerogram,
    /// The vertical component of its record, upwards positive, where that shakes blocks too.
    pub vertical: Option<&'a Accelerogram>,
    /// Its own peak ground acceleration, g.
    pub pga_g: f64,
    /// Its own peak ground velocity, cm/s.
    pub pgv_cm_s: f64,
    /// Geometric mean of the peak ground accelerations of its record's components, g.
    pub record_pga_g: f64,
    /// Geometric mean of the peak ground velocities of its record's components, cm/s.
    pub record_pgv_cm_s: f64,
}

impl Motion<'_> {
    /// The peak that a scaling refers to, in the unit of the measure; NaN for a measure that is neither PGA nor PGV.
    pub fn peak(&self, measure: IntensityMeasure, by: ScaledBy) -> f64 {
        match (measure, by) {
            (IntensityMeasure::Pga, ScaledBy::Component) => self.pga_g,
            (IntensityMeasure::Pga, ScaledBy::Record) => self.record_pga_g,
            (IntensityMeasure::Pgv, ScaledBy::Component) => self.pgv_cm_s,
            (IntensityMeasure::Pgv, ScaledBy::Record) => self.record_pgv_cm_s,
            _ => f64::NAN,
        }
    }
}

/// A record set: the two components of the first record, those of the second, and so on.
#[derive(Debug, Clone)]
pub struct MotionSet<'a> {
    name: String,
    motions: Vec<Motion<'a>>,
    median_pga_g: f64,
    median_pgv_cm_s: f64,
}

impl<'a> MotionSet<'a> {
    /// The set of these records, whose PGA in g refers to `gravity_m_s2`.
    ///
    /// # Errors
    /// [`SpectraError::EmptySet`]; [`SpectraError::Unscalable`] for a component without motion.
    pub fn new(
        name: &str,
        records: impl IntoIterator<Item = RecordOfSet<'a>>,
        gravity_m_s2: f64,
    ) -> Result<Self, SpectraError> {
        let mut motions = Vec::new();
        let (mut pga_g, mut pgv_cm_s) = (Vec::new(), Vec::new());
        for record in records {
            let own_pga_g = record.components.map(|component| component.pga_m_s2() / gravity_m_s2);
            let own_pgv_cm_s = record.components.map(|component| 100.0 * component.pgv_m_s());
            let record_pga_g = geometric_mean(own_pga_g[0], own_pga_g[1]);
            let record_pgv_cm_s = geometric_mean(own_pgv_cm_s[0], own_pgv_cm_s[1]);
            for (which, label) in ["h1", "h2"].into_iter().enumerate() {
                let id = format!("{} {label}", record.id);
                for (measure, value) in [("PGA", own_pga_g[which]), ("PGV", own_pgv_cm_s[which])] {
                    if !(value.is_finite() && value > 0.0) {
                        return Err(SpectraError::Unscalable { motion: id, measure, value });
                    }
                }
                motions.push(Motion {
                    id,
                    accelerogram: record.components[which],
                    vertical: None,
                    pga_g: own_pga_g[which],
                    pgv_cm_s: own_pgv_cm_s[which],
                    record_pga_g,
                    record_pgv_cm_s,
                });
            }
            pga_g.push(record_pga_g);
            pgv_cm_s.push(record_pgv_cm_s);
        }
        if motions.is_empty() {
            return Err(SpectraError::EmptySet { set: name.to_owned() });
        }
        let [median_pga_g, median_pgv_cm_s] = [pga_g, pgv_cm_s].map(|peaks| percentile(&peaks, 50.0));
        Ok(Self { name: name.to_owned(), motions, median_pga_g, median_pgv_cm_s })
    }

    /// The same with the vertical component of every record, in their order: it takes the factor of each motion.
    #[must_use]
    pub fn upwards(mut self, verticals: impl IntoIterator<Item = &'a Accelerogram>) -> Self {
        for (motions, vertical) in self.motions.chunks_mut(2).zip(verticals) {
            for motion in motions {
                motion.vertical = Some(vertical);
            }
        }
        self
    }

    /// Name of the set.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its motions, two a record.
    pub fn motions(&self) -> &[Motion<'a>] {
        &self.motions
    }

    /// Median over the records of the geometric mean of both peak ground accelerations, g (Eq. 2.16, 3.12).
    pub fn median_pga_g(&self) -> f64 {
        self.median_pga_g
    }

    /// Median over the records of the geometric mean of both peak ground velocities, cm/s (Eq. 2.17, 3.13).
    pub fn median_pgv_cm_s(&self) -> f64 {
        self.median_pgv_cm_s
    }

    /// The median that multiples in a scaling refer to, in the unit of the measure; NaN as for [`Motion::peak`].
    pub fn median(&self, measure: IntensityMeasure) -> f64 {
        match measure {
            IntensityMeasure::Pga => self.median_pga_g,
            IntensityMeasure::Pgv => self.median_pgv_cm_s,
            _ => f64::NAN,
        }
    }

    /// What every motion is multiplied by, in the order of [`motions`](Self::motions).
    pub fn factors(&self, scaling: Scaling) -> Vec<f64> {
        let factor = |motion: &Motion<'_>| match scaling {
            Scaling::Unscaled => 1.0,
            Scaling::To { measure, multiple, by } => multiple * self.median(measure) / motion.peak(measure, by),
        };
        self.motions.iter().map(factor).collect()
    }

    /// The plan of shaking each of `systems` by every motion, scaled in each of the ways of `scalings`: these are the
    /// last axis of its result.
    ///
    /// * `with_free_peak` — whether the first peak of the free motion after a record counts
    ///
    /// # Errors
    /// No system, no scaling, a factor that is not finite; a vertical component that falls as fast as gravity.
    pub fn plan<'b>(
        &'b self,
        scalings: &[Scaling],
        systems: &'b [System],
        with_free_peak: bool,
    ) -> Result<Plan<'b>, IdaError> {
        let factors: Vec<Vec<f64>> = scalings.iter().map(|scaling| self.factors(*scaling)).collect();
        let scaled = |(place, motion): (usize, &'b Motion<'a>)| ScaledMotion {
            id: &motion.id,
            accelerogram: motion.accelerogram,
            scales: factors.iter().map(|of_scaling| of_scaling[place]).collect(),
        };
        let plan = Plan::scaled(self.motions.iter().enumerate().map(scaled).collect(), systems, with_free_peak)?;
        let verticals: Vec<&Accelerogram> = self.motions.iter().filter_map(|motion| motion.vertical).collect();
        if verticals.is_empty() { Ok(plan) } else { plan.upwards(verticals) }
    }
}
