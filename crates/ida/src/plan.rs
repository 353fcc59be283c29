//! Motions with their scale factors, and systems, checked before the first analysis.

use uplift_motion::Accelerogram;
use uplift_oscillator::{Excitation, InstructionSet};

use crate::error::IdaError;
use crate::peaks::Axes;
use crate::system::System;

/// Largest factor on a record: one that needs more is noise.
pub(crate) const MOST_SCALE: f64 = 1e8;
/// Largest acceleration of a scaled record, m/s²: far above what moves any structure, far below what overflows.
pub(crate) const MOST_PEAK_M_S2: f64 = 1e8;

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
    /// As many as motions, or none.
    across: Vec<&'a Accelerogram>,
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
    /// An empty axis, levels that do not ascend, a record of zero intensity, or so weak that its factors are
    /// implausible.
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
    /// An empty axis, another number of factors than the first motion has, a factor that is not finite or implausible.
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
        // whoever asks for other instructions than there are is told, before anything is computed
        InstructionSet::chosen().map_err(IdaError::Instructions)?;
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
            motion.check_peaks(motion.accelerogram)?;
        }
        Ok(Self { motions, systems, with_free_peak, across: Vec::new() })
    }

    /// This plan with the second horizontal component of every motion, scaled by the same factors: what shakes a
    /// wobbling frame beside the first. All else never feels it.
    ///
    /// # Errors
    /// Another number of components than of motions; a scaled one that no ground has.
    pub fn across(mut self, across: Vec<&'a Accelerogram>) -> Result<Self, IdaError> {
        if across.len() != self.motions.len() {
            return Err(IdaError::Across { count: across.len(), expected: self.motions.len() });
        }
        for (motion, second) in self.motions.iter().zip(&across) {
            motion.check_peaks(second)?;
        }
        self.across = across;
        Ok(self)
    }

    /// The second horizontal component of a motion; none where the plan has none.
    pub(crate) fn across_of(&self, motion: usize) -> Option<&'a Accelerogram> {
        self.across.get(motion).copied()
    }

    /// This plan with every scale factor multiplied by each of `factors`: all of them by the first, then all by the
    /// second, and so on. By 1 they stay what they are, to the bit.
    ///
    /// # Errors
    /// No factor, one that is not finite.
    pub fn multiplied(mut self, factors: &[f64]) -> Result<Self, IdaError> {
        for motion in &mut self.motions {
            let by = |factor: &f64| motion.scales.iter().map(|scale| scale * factor).collect::<Vec<_>>();
            motion.scales = factors.iter().flat_map(by).collect();
        }
        let across = self.across;
        Ok(Self { across, ..Self::checked("motions", self.motions, self.systems, self.with_free_peak)? })
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
    /// Refuses scale factors that make noise of a `component`, or a motion that no ground has.
    fn check_peaks(&self, component: &Accelerogram) -> Result<(), IdaError> {
        let peak_m_s2 = component.pga_m_s2();
        let implausible = |scale: f64| !(scale.abs() <= MOST_SCALE && (scale * peak_m_s2).abs() <= MOST_PEAK_M_S2);
        match self.scales.iter().enumerate().find(|(_, scale)| implausible(**scale)) {
            Some((index, &value)) => {
                let peak_m_s2 = (value * peak_m_s2).abs();
                Err(IdaError::Implausible { motion: self.id.to_owned(), index, value, peak_m_s2 })
            }
            None => Ok(()),
        }
    }

    pub(crate) fn excitation(&self) -> Result<Excitation<'a>, IdaError> {
        Excitation::new(self.accelerogram.dt_s(), self.accelerogram.acceleration_m_s2())
            .map_err(|source| IdaError::Oscillator { motion: self.id.to_owned(), source })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use uplift_oscillator::Oscillator;

    use super::*;

    #[test]
    fn factors_that_make_noise_or_overflow_of_a_record_are_refused() {
        let [quiet, strong] = [1e-30, 9.0].map(|peak| Accelerogram::new(0.01, vec![0.0, peak]).unwrap());
        let systems = [System::Oscillator(Oscillator::zsbe(0.3).unwrap())];
        let plan = |accelerogram: &Accelerogram, scale: f64| {
            let motion = ScaledMotion { id: "RSN1 h1", accelerogram, scales: vec![1.0, scale] };
            Plan::scaled(vec![motion], &systems, true).map(|plan| plan.analyses())
        };
        assert!(plan(&strong, 100.0).is_ok() && plan(&strong, -1e7).is_ok() && plan(&quiet, 1e7).is_ok());
        for (record, scale) in [(&quiet, 1e29), (&strong, 1e308), (&strong, -5e7)] {
            let error = plan(record, scale).unwrap_err();
            assert!(matches!(error, IdaError::Implausible { index: 1, .. }), "{error}");
        }
    }
}
