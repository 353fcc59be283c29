//! What is computed.

use uplift_block::{BlockError, PulseSpectrumPlan, RickerPulse, RickerShape, RockingBlock, SizeMeasure};
use uplift_job::JobError;
use uplift_job::text::thousands;
use uplift_motion::STANDARD_GRAVITY_M_S2;
use uplift_plausible::{Implausible, PULSE_AMPLITUDE, PULSE_PERIOD, PULSE_RATIO, SIZE};

use crate::error::LaboratoryError;

/// Points of a map that a figure can show, and then some.
const MOST_POINTS: usize = 4_000_000;

/// The spectra of Figures 2.2 to 2.7. All axes have values above zero, increasing.
#[derive(Debug, Clone, PartialEq)]
pub struct PulsePlan {
    /// Wavelets.
    pub shapes: Vec<RickerShape>,
    /// Slenderness α of the block of the nondimensional spectra \[rad\].
    pub slenderness_rad: f64,
    /// Coefficient of restitution; Housner's (Eq. 2.3) if none is given.
    pub restitution: Option<f64>,
    /// Axis ωₚ/p (Figures 2.2, 2.3, 2.5).
    pub frequencies: Vec<f64>,
    /// Axis aₚ/(g tan α) (Figures 2.2, 2.3, 2.4, 2.7).
    pub accelerations: Vec<f64>,
    /// Axis b ωₚ²/aₚ (Figure 2.7).
    pub half_widths: Vec<f64>,
    /// Values of ωₚ/p that have a line each (Figure 2.4).
    pub frequency_slices: Vec<f64>,
    /// Values of aₚ/(g tan α) that have a line each (Figure 2.5).
    pub acceleration_slices: Vec<f64>,
    /// Blocks with a size in metres (Figure 2.6).
    pub blocks: BlockPlan,
}

/// Blocks of several sizes and slendernesses under one wavelet of each shape (Figure 2.6).
#[derive(Debug, Clone, PartialEq)]
pub struct BlockPlan {
    /// Largest ground acceleration aₚ \[g\].
    pub amplitude_g: f64,
    /// Period Tₚ of the wavelets \[s\]; if none is given 0.5 s for the symmetric and 1 s for the antisymmetric one.
    pub period_s: Option<f64>,
    /// Size parameters R, half the diagonal \[m\].
    pub sizes_m: Vec<f64>,
    /// Slendernesses α \[rad\].
    pub slendernesses_rad: Vec<f64>,
}

/// What a wavelet is called.
pub fn wavelet(shape: RickerShape) -> &'static str {
    match shape {
        RickerShape::Symmetric => "symmetric",
        RickerShape::Antisymmetric => "antisymmetric",
    }
}

impl BlockPlan {
    /// Period of a wavelet \[s\].
    pub fn period_s(&self, shape: RickerShape) -> f64 {
        self.period_s.unwrap_or(match shape {
            RickerShape::Symmetric => 0.5,
            RickerShape::Antisymmetric => 1.0,
        })
    }

    /// The wavelet of a shape.
    ///
    /// # Errors
    /// An amplitude or a period that no pulse has.
    pub fn pulse(&self, shape: RickerShape) -> Result<RickerPulse, BlockError> {
        RickerPulse::new(shape, self.amplitude_g * STANDARD_GRAVITY_M_S2, self.period_s(shape))
    }
}

impl PulsePlan {
    /// Whether there are such blocks and pulses, and no more of them than a figure shows, so that a mistake is reported
    /// before the work.
    ///
    /// # Errors
    /// A slenderness, size, restitution, amplitude or period that no block or pulse has; a map of too many points.
    pub fn check(&self) -> Result<(), LaboratoryError> {
        for (name, sizes) in [("frequencies", &self.frequencies), ("half-widths", &self.half_widths)] {
            let points = sizes.len() * self.accelerations.len();
            if points > MOST_POINTS {
                return Err(JobError::Usage(format!(
                    "the axes of {name} and accelerations give a map of {} points, more than {}: use larger steps",
                    thousands(points as u64),
                    thousands(MOST_POINTS as u64)
                ))
                .into());
            }
        }
        let ratios = [
            ("frequencies", &self.frequencies),
            ("accelerations", &self.accelerations),
            ("half-widths", &self.half_widths),
            ("frequency lines", &self.frequency_slices),
            ("acceleration lines", &self.acceleration_slices),
        ];
        let ends = ratios
            .into_iter()
            .flat_map(|(name, axis)| axis.first().into_iter().chain(axis.last()).map(move |end| (name, *end)));
        let mut implausible: Vec<Implausible> =
            ends.filter_map(|(name, end)| PULSE_RATIO.check(name, end).err()).collect();
        let sizes_m = [self.blocks.sizes_m.first(), self.blocks.sizes_m.last()].into_iter().flatten();
        implausible.extend(sizes_m.filter_map(|&size_m| SIZE.check("size", size_m).err()));
        implausible.extend(PULSE_AMPLITUDE.check("amplitude", self.blocks.amplitude_g.abs()).err());
        implausible.extend(self.blocks.period_s.and_then(|period_s| PULSE_PERIOD.check("period", period_s).err()));
        if !implausible.is_empty() {
            return Err(JobError::Implausible(implausible).into());
        }
        let sizes_m = [self.blocks.sizes_m.first(), self.blocks.sizes_m.last()];
        let slendernesses = std::iter::once(&self.slenderness_rad).chain(&self.blocks.slendernesses_rad);
        let blocks = slendernesses.flat_map(|&alpha| sizes_m.into_iter().flatten().map(move |&size_m| (size_m, alpha)));
        let mut mistakes: Vec<BlockError> = blocks
            .filter_map(|(size_m, alpha)| self.block(size_m, alpha).err())
            .chain(self.shapes.iter().filter_map(|&shape| self.blocks.pulse(shape).err()))
            .collect();
        mistakes.dedup_by_key(|error| error.to_string());
        if mistakes.is_empty() { Ok(()) } else { Err(LaboratoryError::Blocks(mistakes)) }
    }

    /// A block with the restitution that was asked for.
    pub(super) fn block(&self, size_m: f64, slenderness_rad: f64) -> Result<RockingBlock, BlockError> {
        let block = RockingBlock::new(size_m, slenderness_rad)?;
        self.restitution.map_or(Ok(block), |restitution| block.with_restitution(restitution))
    }

    /// How many motions are computed.
    pub fn points(&self) -> u64 {
        let (frequencies, accelerations) = (self.frequencies.len(), self.accelerations.len());
        let of_a_shape = accelerations * (frequencies + self.frequency_slices.len() + self.half_widths.len())
            + self.acceleration_slices.len() * frequencies
            + self.blocks.sizes_m.len() * self.blocks.slendernesses_rad.len();
        (self.shapes.len() * of_a_shape) as u64
    }

    pub(super) fn spectrum(
        &self,
        shape: RickerShape,
        size_measure: SizeMeasure,
        sizes: &[f64],
        accelerations: &[f64],
    ) -> PulseSpectrumPlan {
        PulseSpectrumPlan {
            shape,
            slenderness_rad: self.slenderness_rad,
            restitution: self.restitution,
            size_measure,
            sizes: sizes.to_vec(),
            accelerations: accelerations.to_vec(),
        }
    }
}
