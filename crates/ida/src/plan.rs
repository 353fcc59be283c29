//! Motions with their scale factors, and systems, checked before the first analysis.

use uplift_instructions::InstructionSet;
use uplift_motion::Accelerogram;
use uplift_oscillator::Excitation;

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
    /// Its scale factors, as many as every other motion of the plan has; NaN where it is not run
    /// ([`Plan::selected`]).
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
    /// As many as motions, or none.
    upwards: Vec<&'a Accelerogram>,
    azimuths: Option<Azimuths<'a>>,
    /// Whether a factor may be NaN: no run.
    with_gaps: bool,
    /// Whether every motion shakes systems of its own.
    with_own_systems: bool,
}

/// The motions of a plan as they are seen from more than one azimuth.
#[derive(Debug, Clone)]
struct Azimuths<'a> {
    /// From all azimuths but the first, which is that of the motion itself; `[motion]`, as many of each.
    others: Vec<&'a [Accelerogram]>,
    percentile: u8,
}

/// What shakes a system in one run: along the plane of a planar model, across it and upwards.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ground<'a> {
    /// Of the motion.
    pub(crate) id: &'a str,
    pub(crate) along: &'a Accelerogram,
    pub(crate) across: Option<&'a Accelerogram>,
    pub(crate) upwards: Option<&'a Accelerogram>,
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
        let motions = records.into_iter().map(scaled).collect::<Result<_, _>>()?;
        Self::checked("records", motions, systems, (with_free_peak, false))
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
        Self::checked("motions", motions, systems, (with_free_peak, false))
    }

    /// Plan motions that are not all run at every scale: a factor of NaN stands for no run. Its peak comes out as NaN,
    /// without impacts.
    ///
    /// # Errors
    /// As [`scaled`](Self::scaled); a motion without any run.
    pub fn selected(
        motions: Vec<ScaledMotion<'a>>,
        systems: &'a [System],
        with_free_peak: bool,
    ) -> Result<Self, IdaError> {
        Self::checked("motions", motions, systems, (with_free_peak, true))
    }

    fn checked(
        called: &'static str,
        motions: Vec<ScaledMotion<'a>>,
        systems: &'a [System],
        (with_free_peak, with_gaps): (bool, bool),
    ) -> Result<Self, IdaError> {
        // whoever asks for other instructions than there are is reported, before anything is computed
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
            if with_gaps && motion.runs() == 0 {
                return Err(IdaError::NoRun { motion: named() });
            }
            let refused = |scale: f64| !(scale.is_finite() || with_gaps && scale.is_nan());
            if let Some((index, &value)) = motion.scales.iter().enumerate().find(|(_, scale)| refused(**scale)) {
                return Err(IdaError::Scale { motion: named(), index, value });
            }
            motion.excitation_of(motion.accelerogram)?;
            motion.check_peaks(motion.accelerogram)?;
        }
        Ok(Self {
            motions,
            systems,
            with_free_peak,
            across: Vec::new(),
            upwards: Vec::new(),
            azimuths: None,
            with_gaps,
            with_own_systems: false,
        })
    }

    /// This plan with systems of its own for every motion, as many for each: the first so many are those of the first
    /// motion, and so on.
    ///
    /// # Errors
    /// A number of systems that is no multiple of that of motions.
    pub fn with_own_systems(self) -> Result<Self, IdaError> {
        let (systems, motions) = (self.systems.len(), self.motions.len());
        if systems % motions != 0 {
            return Err(IdaError::OwnSystems { systems, motions });
        }
        Ok(Self { with_own_systems: true, ..self })
    }

    /// The system at a position of the second axis of the result, under a motion.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn system(&self, motion: usize, system: usize) -> &'a System {
        if self.with_own_systems { &self.systems[motion * self.axes().systems + system] } else { &self.systems[system] }
    }

    /// This plan with the second horizontal component of every motion, scaled by the same factors: what shakes a
    /// wobbling frame beside the first. All else never feels it.
    ///
    /// # Errors
    /// Another number of components than of motions; a scaled one that no ground has.
    pub fn across(mut self, across: Vec<&'a Accelerogram>) -> Result<Self, IdaError> {
        self.check_beside("second components", across.len())?;
        for (motion, second) in self.motions.iter().zip(&across) {
            motion.check_peaks(second)?;
        }
        self.across = across;
        Ok(self)
    }

    /// This plan with the vertical component of every motion, upwards positive, scaled by the same factors: blocks and
    /// frames feel it, oscillators never do.
    ///
    /// # Errors
    /// Another number of components than of motions; motions whose ground falls as fast as gravity at some scale, all
    /// of them at once: what leaves the ground is in no model.
    pub fn upwards(mut self, upwards: Vec<&'a Accelerogram>) -> Result<Self, IdaError> {
        self.check_beside("vertical components", upwards.len())?;
        let gravity_m_s2 = self.systems.iter().filter_map(System::gravity_m_s2).fold(f64::INFINITY, f64::min);
        let falling = self.falling(&upwards, gravity_m_s2);
        if !falling.is_empty() {
            return Err(IdaError::Falls { falling });
        }
        self.upwards = upwards;
        Ok(self)
    }

    /// Motions whose vertical component, one a motion, falls as fast as gravity (m/s²) at a scale factor: each once,
    /// with the first.
    pub fn falling(&self, upwards: &[&Accelerogram], gravity_m_s2: f64) -> Vec<String> {
        let falls = |(motion, vertical): (&ScaledMotion<'_>, &&Accelerogram)| {
            let (least, most) = vertical
                .acceleration_m_s2()
                .iter()
                .fold((0.0, 0.0), |(least, most): (f64, f64), a| (least.min(*a), most.max(*a)));
            let first = motion.scales.iter().position(|scale| (scale * least).min(scale * most) <= -gravity_m_s2)?;
            Some(format!("{} by {:.4} (scale factor {first})", motion.id, motion.scales[first]))
        };
        let mut falling: Vec<String> = self.motions.iter().zip(upwards).filter_map(falls).collect();
        // both components of a pair are reported once
        falling.dedup();
        falling
    }

    /// This plan with every motion as it is seen from other azimuths too: a peak is a percentile of the peaks from all,
    /// the smallest that `percentile` per cent of them do not exceed, what overturns being the largest. It is for
    /// models in the plane.
    ///
    /// # Errors
    /// Another number of motions, or of azimuths from one motion to the next; a second component; a percentile above
    /// 100; a scaled motion that no ground has.
    pub fn from_azimuths(mut self, others: Vec<&'a [Accelerogram]>, percentile: u8) -> Result<Self, IdaError> {
        self.check_beside("motions of other azimuths", others.len())?;
        let count = others.first().map_or(0, |first| first.len());
        if !self.across.is_empty() || percentile > 100 || others.iter().any(|of_motion| of_motion.len() != count) {
            return Err(IdaError::Azimuths { percentile });
        }
        for (motion, others) in self.motions.iter().zip(&others) {
            for other in *others {
                motion.check_peaks(other)?;
                motion.excitation_of(other)?;
            }
        }
        self.azimuths = Some(Azimuths { others, percentile });
        Ok(self)
    }

    fn check_beside(&self, what: &'static str, count: usize) -> Result<(), IdaError> {
        let expected = self.motions.len();
        if count == expected { Ok(()) } else { Err(IdaError::Beside { what, count, expected }) }
    }

    /// The vertical component of a motion; none where the plan has none.
    pub fn upwards_of(&self, motion: usize) -> Option<&'a Accelerogram> {
        self.upwards.get(motion).copied()
    }

    /// A motion as it is seen from the other azimuths, and the percentile that is taken; none where there is one
    /// azimuth.
    pub fn other_azimuths_of(&self, motion: usize) -> Option<(&'a [Accelerogram], u8)> {
        self.azimuths.as_ref().map(|azimuths| (azimuths.others[motion], azimuths.percentile))
    }

    /// Time histories behind each peak: azimuths of a percentile, else 1.
    pub fn histories_per_peak(&self) -> usize {
        self.other_azimuths_of(0).map_or(1, |(others, _)| 1 + others.len())
    }

    /// Time histories of a motion for each system.
    pub fn histories_of(&self, motion: usize) -> usize {
        self.motions[motion].runs() * self.histories_per_peak()
    }

    /// What shakes a system under a motion: one ground an azimuth.
    pub(crate) fn grounds_of(&self, motion: usize) -> impl Iterator<Item = Ground<'a>> + '_ {
        let of_motion = &self.motions[motion];
        let others = self.other_azimuths_of(motion).map_or(&[][..], |(others, _)| others);
        std::iter::once(of_motion.accelerogram).chain(others).map(move |along| Ground {
            id: of_motion.id,
            along,
            across: self.across.get(motion).copied(),
            upwards: self.upwards_of(motion),
        })
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
        let (across, upwards, azimuths) = (self.across, self.upwards, self.azimuths);
        let with_own_systems = self.with_own_systems;
        let marks = (self.with_free_peak, self.with_gaps);
        let plan = Self::checked("motions", self.motions, self.systems, marks)?;
        let mut plan = Self { with_own_systems, ..plan };
        if !across.is_empty() {
            plan = plan.across(across)?;
        }
        if !upwards.is_empty() {
            plan = plan.upwards(upwards)?;
        }
        match azimuths {
            Some(Azimuths { others, percentile }) => plan.from_azimuths(others, percentile),
            None => Ok(plan),
        }
    }

    /// Lengths of the axes of its result.
    pub fn axes(&self) -> Axes {
        let scales = self.motions.first().map_or(0, |motion| motion.scales.len());
        let (motions, all) = (self.motions.len(), self.systems.len());
        Axes { motions, systems: if self.with_own_systems { all / motions } else { all }, scales }
    }

    /// Number of nonlinear time histories in the plan.
    pub fn analyses(&self) -> u64 {
        let of_a_system: usize = (0..self.motions.len()).map(|motion| self.histories_of(motion)).sum();
        (of_a_system * self.axes().systems) as u64
    }

    /// The motions, the first axis of the result.
    pub fn motions(&self) -> &[ScaledMotion<'a>] {
        &self.motions
    }

    /// All systems: the second axis of the result, unless every motion has [its own](Self::with_own_systems).
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
        let implausible = |scale: f64| scale.abs() > MOST_SCALE || (scale * peak_m_s2).abs() > MOST_PEAK_M_S2;
        match self.scales.iter().enumerate().find(|(_, scale)| implausible(**scale)) {
            Some((index, &value)) => {
                let peak_m_s2 = (value * peak_m_s2).abs();
                Err(IdaError::Implausible { motion: self.id.to_owned(), index, value, peak_m_s2 })
            }
            None => Ok(()),
        }
    }

    /// At how many of its scales it is run.
    pub fn runs(&self) -> usize {
        self.scales.iter().filter(|scale| !scale.is_nan()).count()
    }

    fn excitation_of<'b>(&self, component: &'b Accelerogram) -> Result<Excitation<'b>, IdaError>
    where
        'a: 'b,
    {
        Ground { id: self.id, along: component, across: None, upwards: None }.excitation()
    }
}

impl<'a> Ground<'a> {
    /// As an oscillator feels it.
    pub(crate) fn excitation(&self) -> Result<Excitation<'a>, IdaError> {
        Excitation::new(self.along.dt_s(), self.along.acceleration_m_s2())
            .map_err(|source| IdaError::Oscillator { motion: self.id.to_owned(), source })
    }
}

#[cfg(test)]
mod tests {
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
        assert!(matches!(plan(&strong, f64::NAN).unwrap_err(), IdaError::Scale { index: 1, .. }));
        for (record, scale) in [(&quiet, 1e29), (&strong, 1e308), (&strong, -5e7)] {
            let error = plan(record, scale).unwrap_err();
            assert!(matches!(error, IdaError::Implausible { index: 1, .. }), "{error}");
        }
    }
}
