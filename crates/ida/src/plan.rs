//! Motions with their scale factors, and systems, checked before the first analysis.

use uplift_motion::Accelerogram;
use uplift_oscillator::Excitation;

use crate::error::IdaError;
use crate::peaks::Axes;
use crate::system::System;

/// A record as stripes need it: one component, and the intensity that the scale factors refer to.
#[derive(Debug, Clone, Copy)]
pub struct StripeRecord<'a> {
    /// Identifier, for messages.
    pub id: &'a str,
    /// The component that shakes the planar model.
    pub accelerogram: &'a Accelerogram,
    /// Intensity measure of the unscaled record, of both components (Eq. 4.5, 4.6), in the unit of the levels.
    pub intensity: f64,
}

/// A motion with what it is multiplied by.
#[derive(Debug, Clone)]
pub struct ScaledMotion<'a> {
    /// Identifier, for messages.
    pub id: &'a str,
    /// The component that shakes the planar model.
    pub accelerogram: &'a Accelerogram,
    /// Its scale factors, as many as every other motion of the plan has.
    pub scales: Vec<f64>,
}

/// A checked plan: every system under every motion at each of the motion's scale factors.
#[derive(Debug, Clone)]
pub struct Plan<'a> {
    motions: Vec<ScaledMotion<'a>>,
    systems: &'a [System],
    with_free_peak: bool,
}

impl<'a> Plan<'a> {
    /// Plan stripes: every record scaled to every level of an intensity measure.
    ///
    /// * `records` — with their unscaled intensities
    /// * `systems` — one a strength, say
    /// * `levels` — intensity levels of the stripes, ascending, in the unit of the records' intensities
    /// * `with_free_peak` — whether the first peak of the free motion after a record counts
    ///
    /// # Errors
    /// An empty axis, levels that do not ascend, a record of zero intensity.
    pub fn stripes(
        records: Vec<StripeRecord<'a>>,
        systems: &'a [System],
        levels: &[f64],
        with_free_peak: bool,
    ) -> Result<Self, IdaError> {
        if levels.is_empty() {
            return Err(IdaError::Empty { what: "levels" });
        }
        let mut before = 0.0;
        for (index, &value) in levels.iter().enumerate() {
            if !(value.is_finite() && value > before) {
                return Err(IdaError::Levels { index, value, before });
            }
            before = value;
        }
        let scaled = |StripeRecord { id, accelerogram, intensity }: StripeRecord<'a>| {
            if !(intensity.is_finite() && intensity > 0.0) {
                return Err(IdaError::Unscalable { record: id.to_owned(), value: intensity });
            }
            Ok(ScaledMotion { id, accelerogram, scales: levels.iter().map(|level| level / intensity).collect() })
        };
        Self::checked("records", records.into_iter().map(scaled).collect::<Result<_, _>>()?, systems, with_free_peak)
    }

    /// Plan motions with given scale factors.
    ///
    /// * `motions` — each with as many scale factors as the first
    /// * `systems`, `with_free_peak` — as for [`stripes`](Self::stripes)
    ///
    /// # Errors
    /// An empty axis, another number of factors than the first motion has, a factor that is not finite.
    pub fn scaled(
        motions: Vec<ScaledMotion<'a>>,
        systems: &'a [System],
        with_free_peak: bool,
    ) -> Result<Self, IdaError> {
        Self::checked("motions", motions, systems, with_free_peak)
    }

    fn checked(
        called: &'static str,
        motions: Vec<ScaledMotion<'a>>,
        systems: &'a [System],
        with_free_peak: bool,
    ) -> Result<Self, IdaError> {
        let expected = motions.first().ok_or(IdaError::Empty { what: called })?.scales.len();
        for (what, length) in [("systems", systems.len()), ("scale factors", expected)] {
            if length == 0 {
                return Err(IdaError::Empty { what });
            }
        }
        for motion in &motions {
            let named = || motion.id.to_owned();
            if motion.scales.len() != expected {
                return Err(IdaError::Scales { motion: named(), count: motion.scales.len(), expected });
            }
            if let Some((index, &value)) = motion.scales.iter().enumerate().find(|(_, scale)| !scale.is_finite()) {
                return Err(IdaError::Scale { motion: named(), index, value });
            }
            motion.excitation()?;
        }
        Ok(Self { motions, systems, with_free_peak })
    }

    /// This plan with every scale factor multiplied by `factor`; by 1 it stays what it is, to the bit.
    ///
    /// # Errors
    /// A factor that is not finite.
    pub fn multiplied(mut self, factor: f64) -> Result<Self, IdaError> {
        for motion in &mut self.motions {
            motion.scales.iter_mut().for_each(|scale| *scale *= factor);
        }
        Self::checked("motions", self.motions, self.systems, self.with_free_peak)
    }

    /// Lengths of the axes of its result.
    pub fn axes(&self) -> Axes {
        let scales = self.motions.first().map_or(0, |motion| motion.scales.len());
        Axes { motions: self.motions.len(), systems: self.systems.len(), scales }
    }

    /// Number of nonlinear time histories in the plan.
    pub fn analyses(&self) -> u64 {
        self.axes().cells() as u64
    }

    /// The motions, the first axis of the result.
    pub fn motions(&self) -> &[ScaledMotion<'a>] {
        &self.motions
    }

    /// The systems, the second axis of the result.
    pub fn systems(&self) -> &'a [System] {
        self.systems
    }

    /// Whether the first peak of the free motion after a record counts.
    pub fn with_free_peak(&self) -> bool {
        self.with_free_peak
    }
}

impl<'a> ScaledMotion<'a> {
    pub(crate) fn excitation(&self) -> Result<Excitation<'a>, IdaError> {
        Excitation::new(self.accelerogram.dt_s(), self.accelerogram.acceleration_m_s2())
            .map_err(|source| IdaError::Oscillator { motion: self.id.to_owned(), source })
    }
}
