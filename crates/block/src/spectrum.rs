//! Nondimensional rocking spectra under Ricker wavelets (Figures 2.2–2.7).

use rayon::prelude::*;

use crate::block::RockingBlock;
use crate::error::{BlockError, within};
use crate::response::{FreeRocking, Overturning, respond};
use crate::ricker::{RickerPulse, RickerShape};

/// What measures the size of the block against the pulse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SizeMeasure {
    /// Size-frequency parameter ωₚ/p (Eq. 2.6 and 2.12; Figures 2.2–2.5).
    Frequency,
    /// Half-width against the length scale of the pulse, b ωₚ²/aₚ (Eq. 2.15; Figure 2.7).
    HalfWidth,
}

/// What a spectrum is computed for.
#[derive(Debug, Clone, PartialEq)]
pub struct PulseSpectrumPlan {
    /// Shape of the wavelet.
    pub shape: RickerShape,
    /// Slenderness α \[rad\].
    pub slenderness_rad: f64,
    /// Coefficient of restitution; Housner's (Eq. 2.3) if none is given.
    pub restitution: Option<f64>,
    /// What `sizes` are.
    pub size_measure: SizeMeasure,
    /// Values of the size measure, above zero.
    pub sizes: Vec<f64>,
    /// Values of the nondimensional acceleration aₚ/(g tan α), above zero.
    pub accelerations: Vec<f64>,
}

/// Response at one point of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumPoint {
    /// θmax/α; +∞ if the block overturns.
    pub rotation: f64,
    /// `u_max` ωₚ²/aₚ; +∞ if the block overturns.
    pub displacement: f64,
    /// Impacts, up to the peak of free rocking after the pulse or to overturning.
    pub impacts: u64,
    /// Whether the block overturns, and how.
    pub overturning: Overturning,
}

/// A computed spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct PulseSpectrum {
    sizes: usize,
    points: Vec<SpectrumPoint>,
}

impl PulseSpectrum {
    /// The point of a size and an acceleration, by their indices in the plan; none if there is no such index.
    pub fn point(&self, size: usize, acceleration: usize) -> Option<&SpectrumPoint> {
        if size < self.sizes { self.points.get(acceleration * self.sizes + size) } else { None }
    }

    /// All points: the sizes of the first acceleration, those of the second, and so on.
    pub fn points(&self) -> &[SpectrumPoint] {
        &self.points
    }
}

/// Computes a spectrum on the threads of the current rayon pool. Every point depends on its own values alone: the
/// numbers are the same for any number of threads.
///
/// # Errors
/// [`BlockError::Empty`] for an axis without values, [`BlockError::OutOfRange`] for one that is not above zero (and
/// below 1e6), or for what no block and no pulse has; [`BlockError::TooLong`] for a pulse of more than 1e7/p.
///
/// # Source
/// Reggiani Manzo, Sections 2.2 and 2.3.
pub fn pulse_spectrum(plan: &PulseSpectrumPlan) -> Result<PulseSpectrum, BlockError> {
    let axes = [
        ("sizes", "nondimensional size", &plan.sizes),
        ("accelerations", "nondimensional acceleration", &plan.accelerations),
    ];
    for (axis, name, values) in axes {
        if values.is_empty() {
            return Err(BlockError::Empty { axis });
        }
        for value in values {
            within(name, *value, "(pure number)", f64::MIN_POSITIVE..=1e6, "above zero, and 1e6 at most")?;
        }
    }
    let block = reference_block(plan)?;
    let sizes = plan.sizes.len();
    let points = (0..sizes * plan.accelerations.len())
        .into_par_iter()
        .map(|i| point(plan, &block, plan.sizes[i % sizes], plan.accelerations[i / sizes]))
        .collect::<Result<_, _>>()?;
    Ok(PulseSpectrum { sizes, points })
}

/// By similarity any size will do.
fn reference_block(plan: &PulseSpectrumPlan) -> Result<RockingBlock, BlockError> {
    let block = RockingBlock::new(1.0, plan.slenderness_rad)?;
    plan.restitution.map_or(Ok(block), |restitution| block.with_restitution(restitution))
}

fn point(
    plan: &PulseSpectrumPlan,
    block: &RockingBlock,
    size: f64,
    acceleration: f64,
) -> Result<SpectrumPoint, BlockError> {
    let frequency = match plan.size_measure {
        SizeMeasure::Frequency => size,
        // b ωₚ²/aₚ = (3/4) cos α (ωₚ/p)² / (aₚ/(g tan α))
        SizeMeasure::HalfWidth => (size * acceleration / (0.75 * plan.slenderness_rad.cos())).sqrt(),
    };
    let omega_rad_s = frequency * block.frequency_parameter_rad_s();
    let amplitude_m_s2 = acceleration * block.uplift_acceleration_m_s2();
    let pulse = RickerPulse::new(plan.shape, amplitude_m_s2, std::f64::consts::TAU / omega_rad_s)?;
    let response = respond(block, pulse, FreeRocking::FirstPeak)?;
    Ok(SpectrumPoint {
        rotation: response.rotation_rad / block.slenderness_rad(),
        displacement: response.displacement_m * pulse.frequency_rad_s().powi(2) / amplitude_m_s2,
        impacts: response.impacts,
        overturning: response.overturning,
    })
}
