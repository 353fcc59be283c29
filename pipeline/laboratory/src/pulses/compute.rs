//! The spectra themselves.

use rayon::prelude::*;
use uplift_block::{
    BlockError, BlockResponse, FreeRocking, PulseSpectrumPlan, RickerShape, SizeMeasure, SpectrumPoint, pulse_spectrum,
    respond,
};
use uplift_ida::Watch;
use uplift_job::JobError;

use super::plan::PulsePlan;
use crate::error::LaboratoryError;

/// The spectra of one wavelet.
#[derive(Debug, Clone, PartialEq)]
pub struct PulseSpectra {
    /// The wavelet.
    pub shape: RickerShape,
    /// Over ωₚ/p and aₚ/(g tan α) (Figures 2.2 and 2.3).
    pub by_frequency: Spectrum,
    /// Over aₚ/(g tan α), for a few ωₚ/p (Figure 2.4).
    pub over_acceleration: Spectrum,
    /// Over ωₚ/p, for a few aₚ/(g tan α) (Figure 2.5).
    pub over_frequency: Spectrum,
    /// Blocks with a size in metres (Figure 2.6).
    pub blocks: BlockResponses,
    /// Over b ωₚ²/aₚ and aₚ/(g tan α) (Figure 2.7).
    pub by_half_width: Spectrum,
}

/// A spectrum with what it was computed for.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// What it was computed for.
    pub plan: PulseSpectrumPlan,
    /// `[acceleration, size]`.
    pub points: Vec<SpectrumPoint>,
}

/// Blocks of several sizes and slendernesses under one wavelet.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockResponses {
    /// Size parameters R \[m\].
    pub sizes_m: Vec<f64>,
    /// Slendernesses α \[rad\].
    pub slendernesses_rad: Vec<f64>,
    /// `[slenderness, size]`.
    pub responses: Vec<BlockResponse>,
}

/// Compute what `plan` asks for, wavelet by wavelet.
///
/// # Errors
/// What no block and no pulse has; an interruption by `watch`.
///
/// # Source
/// Reggiani Manzo, Sections 2.2 and 2.3.
pub fn compute(plan: &PulsePlan, watch: &impl Watch) -> Result<Vec<PulseSpectra>, LaboratoryError> {
    use SizeMeasure::{Frequency, HalfWidth};
    plan.shapes
        .iter()
        .map(|&shape| {
            let (frequencies, accelerations) = (&plan.frequencies[..], &plan.accelerations[..]);
            let of = |measure, sizes: &[f64], accelerations: &[f64]| {
                spectrum(plan.spectrum(shape, measure, sizes, accelerations), watch)
            };
            Ok(PulseSpectra {
                shape,
                by_frequency: of(Frequency, frequencies, accelerations)?,
                over_acceleration: of(Frequency, &plan.frequency_lines, accelerations)?,
                over_frequency: of(Frequency, frequencies, &plan.acceleration_lines)?,
                blocks: blocks(plan, shape, watch)?,
                by_half_width: of(HalfWidth, &plan.half_widths, accelerations)?,
            })
        })
        .collect()
}

fn go_on(watch: &impl Watch) -> Result<(), LaboratoryError> {
    if watch.cancelled() { Err(JobError::Interrupted.into()) } else { Ok(()) }
}

/// A spectrum, row by row, so that it can be watched and stopped.
fn spectrum(plan: PulseSpectrumPlan, watch: &impl Watch) -> Result<Spectrum, LaboratoryError> {
    let mut points = Vec::with_capacity(plan.sizes.len() * plan.accelerations.len());
    for &acceleration in &plan.accelerations {
        go_on(watch)?;
        let row = PulseSpectrumPlan { accelerations: vec![acceleration], ..plan.clone() };
        points.extend(pulse_spectrum(&row)?.points());
        watch.finished(plan.sizes.len() as u64);
    }
    Ok(Spectrum { plan, points })
}

/// The blocks of Figure 2.6.
fn blocks(plan: &PulsePlan, shape: RickerShape, watch: &impl Watch) -> Result<BlockResponses, LaboratoryError> {
    let of_plan = &plan.blocks;
    let pulse = of_plan.pulse(shape)?;
    let respond_of = |size_m: f64, slenderness_rad: f64| {
        respond(&plan.block(size_m, slenderness_rad)?, pulse, FreeRocking::FirstPeak)
    };
    let mut responses = Vec::with_capacity(of_plan.sizes_m.len() * of_plan.slendernesses_rad.len());
    for &slenderness_rad in of_plan.slendernesses_rad.iter() {
        go_on(watch)?;
        let row = of_plan.sizes_m.par_iter().map(|&size_m| respond_of(size_m, slenderness_rad));
        responses.extend(row.collect::<Result<Vec<_>, BlockError>>()?);
        watch.finished(of_plan.sizes_m.len() as u64);
    }
    Ok(BlockResponses {
        sizes_m: of_plan.sizes_m.to_vec(),
        slendernesses_rad: of_plan.slendernesses_rad.to_vec(),
        responses,
    })
}

impl Spectrum {
    /// The values of a row: those of one acceleration over all sizes.
    pub fn over_sizes(&self, acceleration: usize) -> impl Iterator<Item = (f64, &SpectrumPoint)> {
        let columns = self.plan.sizes.len();
        self.plan.sizes.iter().copied().zip(&self.points[acceleration * columns..])
    }

    /// The values of a column: those of one size over all accelerations.
    pub fn over_accelerations(&self, size: usize) -> impl Iterator<Item = (f64, &SpectrumPoint)> {
        let columns = self.plan.sizes.len();
        self.plan.accelerations.iter().copied().zip(self.points.iter().skip(size).step_by(columns))
    }

    /// Every point with its size and acceleration, in the order of [`Spectrum::points`].
    pub fn rows(&self) -> impl Iterator<Item = (f64, f64, &SpectrumPoint)> {
        self.plan
            .accelerations
            .iter()
            .enumerate()
            .flat_map(|(row, &acceleration)| self.over_sizes(row).map(move |(size, point)| (size, acceleration, point)))
    }
}

impl BlockResponses {
    /// The responses of one slenderness over all sizes R \[m\].
    pub fn over_sizes(&self, slenderness: usize) -> impl Iterator<Item = (f64, &BlockResponse)> {
        let columns = self.sizes_m.len();
        self.sizes_m.iter().copied().zip(&self.responses[slenderness * columns..])
    }
}
