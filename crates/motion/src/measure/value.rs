//! What a measure of a pair is.

use super::{IntensityMeasure, geometric_mean};
use crate::accelerogram::Accelerogram;
use crate::combination::Combination;
use crate::error::MotionError;
use crate::pair::RecordPair;
use crate::response_spectrum::{average, rotated_spectral_accelerations, spectrum_intensity_m};
use crate::rotation::in_directions;

impl IntensityMeasure {
    /// The measure of an unscaled pair, in [`IntensityMeasure::unit`] (PGV in cm/s, Eq. 4.6; PGA in g, Eq. 4.5), with
    /// the acceleration of gravity `gravity_m_s2` \[m/s²\]; the geometric mean of the components.
    ///
    /// # Source
    ///
    /// Reggiani Manzo, dissertation, Section 4.3.1.
    pub fn pair_value(self, pair: &RecordPair, gravity_m_s2: f64) -> f64 {
        match self {
            Self::Pgv => 100.0 * geometric_mean(pair.h1.pgv_m_s(), pair.h2.pgv_m_s()),
            Self::Pga => geometric_mean(pair.h1.pga_m_s2(), pair.h2.pga_m_s2()) / gravity_m_s2,
            _ => {
                let [h1, h2] = [&pair.h1, &pair.h2].map(|component| self.component_value(component, gravity_m_s2));
                geometric_mean(h1, h2)
            }
        }
    }

    /// The measure of an unscaled pair whose components are combined in any way, in [`IntensityMeasure::unit`], with
    /// the acceleration of gravity `gravity_m_s2` \[m/s²\].
    ///
    /// In a direction θ the motion is a₁ cos θ + a₂ sin θ, and the measure that of this motion; `RotD50` and `RotD100`
    /// are the median and the largest over 180 directions. Of several periods, each has its own directions, and the
    /// mean or the integral is taken of the combined ordinates.
    ///
    /// # Errors
    ///
    /// [`MotionError::UnequalTimeSteps`] for a rotated measure where the components have different time steps.
    pub fn combined_value(
        self,
        combination: Combination,
        pair: &RecordPair,
        gravity_m_s2: f64,
    ) -> Result<f64, MotionError> {
        let Some(chosen) = combination.over_directions() else { return Ok(self.pair_value(pair, gravity_m_s2)) };
        let ordinate_m_s2 = |period_s| rotated_spectral_accelerations(pair, period_s).map(chosen);
        Ok(match self {
            Self::Pgv => combination.peaks_of(pair)?.pgv_cm_s(),
            Self::Pga => combination.peaks_of(pair)?.pga_g(gravity_m_s2),
            Self::Sa(period) => ordinate_m_s2(period.s())? / gravity_m_s2,
            Self::AvgSa { from, to } => average([from.s(), to.s()], ordinate_m_s2)? / gravity_m_s2,
            Self::SpectrumIntensity => 100.0 * spectrum_intensity_m(ordinate_m_s2)?,
            Self::Pgd | Self::Cav | Self::Arias | Self::D575 | Self::D595 => {
                chosen(in_directions(pair, |motion| self.component_value(motion, gravity_m_s2))?)
            }
        })
    }

    /// The measure of one component, in [`IntensityMeasure::unit`], with the acceleration of gravity `gravity_m_s2`
    /// \[m/s²\].
    pub fn component_value(self, component: &Accelerogram, gravity_m_s2: f64) -> f64 {
        match self {
            Self::Pgv => 100.0 * component.pgv_m_s(),
            Self::Pga => component.pga_m_s2() / gravity_m_s2,
            Self::Sa(period) => component.spectral_acceleration_m_s2(period.s()) / gravity_m_s2,
            Self::AvgSa { from, to } => component.average_spectral_acceleration_m_s2(from.s(), to.s()) / gravity_m_s2,
            Self::Pgd => 100.0 * component.pgd_m(),
            Self::Cav => 100.0 * component.cumulative_absolute_velocity_m_s(),
            Self::Arias => 100.0 * component.arias_intensity_m_s(gravity_m_s2),
            Self::SpectrumIntensity => 100.0 * component.spectrum_intensity_m(),
            Self::D575 => component.d5_75_s(),
            Self::D595 => component.d5_95_s(),
        }
    }
}
