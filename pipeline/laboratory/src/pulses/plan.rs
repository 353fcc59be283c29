//! What is computed.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use clap::Args;
use clap::builder::TypedValueParser;
use uplift_block::{BlockError, PulseSpectrumPlan, RickerPulse, RickerShape, RockingBlock, SizeMeasure};
use uplift_job::JobError;
use uplift_job::text::thousands;
use uplift_job::typed::{number, one_of};
use uplift_motion::STANDARD_GRAVITY_M_S2;
use uplift_plausible::{Implausible, PULSE_AMPLITUDE, PULSE_PERIOD, PULSE_RATIO, SIZE};
use uplift_study::{Grid, GridError};

use crate::error::LaboratoryError;

/// Points of a map that a figure can show, and then some.
const MOST_POINTS: usize = 4_000_000;
/// Lines that a figure can distinguish.
const MOST_LINES: usize = 7;

/// Wavelets by their word on a command line.
const SHAPES: [(&str, &[RickerShape]); 3] = [
    ("symmetric", &[RickerShape::Symmetric]),
    ("antisymmetric", &[RickerShape::Antisymmetric]),
    ("both", &[RickerShape::Symmetric, RickerShape::Antisymmetric]),
];
const AXES: &str = "Axes (numbers, or start:step:stop, set apart by commas)";
const BLOCKS: &str = "Blocks with a size in metres";

/// The spectra of Figures 2.2 to 2.7; their axes have values above zero, increasing.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct PulsePlan {
    /// Wavelet: second or third derivative of the Gaussian (Eq. 2.7, 2.8)
    #[arg(
        long = "shape", value_name = "SHAPE", default_value = "both",
        value_parser = one_of(&SHAPES, |(word, _)| word).map(|(_, shapes)| shapes)
    )]
    pub shapes: &'static [RickerShape],
    /// Slenderness alpha of the block, atan(b/h), rad
    #[arg(
        long = "slenderness", value_name = "RAD", default_value_t = 0.1,
        allow_negative_numbers = true, value_parser = number
    )]
    pub slenderness_rad: f64,
    /// Coefficient of restitution at impact [default: Housner's, Eq. 2.3]
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number)]
    pub restitution: Option<f64>,
    /// Axis omega_p/p of the spectra
    #[arg(
        long, value_name = "GRID", default_value = "0.04:0.04:8", help_heading = AXES,
        value_parser = axis, allow_negative_numbers = true
    )]
    pub frequencies: Grid,
    /// Axis a_p/(g tan alpha) of the spectra
    #[arg(
        long, value_name = "GRID", default_value = "0.5:0.05:10", help_heading = AXES,
        value_parser = axis, allow_negative_numbers = true
    )]
    pub accelerations: Grid,
    /// Axis b omega_p^2/a_p of the spectrum by the width of the base
    #[arg(
        long, value_name = "GRID", default_value = "0.025:0.025:6", help_heading = AXES,
        value_parser = axis, allow_negative_numbers = true
    )]
    pub half_widths: Grid,
    /// Values of omega_p/p drawn over the acceleration
    #[arg(
        long, value_name = "GRID", default_value = "1,2,3,4,6,8", help_heading = AXES,
        value_parser = lines, allow_negative_numbers = true
    )]
    pub frequency_lines: Grid,
    /// Values of a_p/(g tan alpha) drawn over the size-frequency parameter
    #[arg(
        long, value_name = "GRID", default_value = "1.25,1.5,2,3,5,8", help_heading = AXES,
        value_parser = lines, allow_negative_numbers = true
    )]
    pub acceleration_lines: Grid,
    /// Blocks of several sizes and slendernesses under one wavelet of each shape (Figure 2.6).
    #[command(flatten)]
    pub blocks: BlockPlan,
}

/// Blocks of several sizes and slendernesses under one wavelet of each shape (Figure 2.6).
#[derive(Debug, Clone, PartialEq, Args)]
pub struct BlockPlan {
    /// Largest ground acceleration a_p, g
    #[arg(
        long, value_name = "G", default_value_t = 1.0, help_heading = BLOCKS,
        allow_negative_numbers = true, value_parser = number
    )]
    pub amplitude_g: f64,
    /// Period T_p of the wavelet, s [default: 0.5 symmetric, 1 antisymmetric]
    #[arg(long, value_name = "S", help_heading = BLOCKS, allow_negative_numbers = true, value_parser = number)]
    pub period_s: Option<f64>,
    /// Axis of sizes: parameter R, half the diagonal of the block, m
    #[arg(
        long, value_name = "GRID", default_value = "0.5:0.05:30", help_heading = BLOCKS,
        value_parser = axis, allow_negative_numbers = true
    )]
    pub sizes_m: Grid,
    /// Slendernesses to draw, rad
    #[arg(
        long = "slendernesses", value_name = "GRID", default_value = "0.1:0.1:0.6", help_heading = BLOCKS,
        value_parser = lines, allow_negative_numbers = true
    )]
    pub slendernesses_rad: Grid,
}

/// Values above zero.
fn positive(text: &str) -> Result<Grid, String> {
    let grid: Grid = text.parse().map_err(|error: GridError| error.to_string())?;
    match grid.first() {
        Some(first) if *first <= 0.0 => Err(format!("{first} is not above zero: give values above zero")),
        _ => Ok(grid),
    }
}

fn axis(text: &str) -> Result<Grid, String> {
    let grid = positive(text)?;
    if grid.len() < 2 { Err("an axis has at least two values: write start:step:stop".to_owned()) } else { Ok(grid) }
}

fn lines(text: &str) -> Result<Grid, String> {
    let grid = positive(text)?;
    if grid.len() > MOST_LINES {
        return Err(format!("{} lines are too many for one figure: give at most {MOST_LINES}", grid.len()));
    }
    Ok(grid)
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
            ("frequency lines", &self.frequency_lines),
            ("acceleration lines", &self.acceleration_lines),
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
        let slendernesses = std::iter::once(&self.slenderness_rad).chain(self.blocks.slendernesses_rad.iter());
        let blocks = slendernesses.flat_map(|&alpha| sizes_m.into_iter().flatten().map(move |&size_m| (size_m, alpha)));
        let mut mistakes: Vec<BlockError> = blocks
            .filter_map(|(size_m, alpha)| self.block(size_m, alpha).err())
            .chain(self.shapes.iter().filter_map(|&shape| self.blocks.pulse(shape).err()))
            .collect();
        mistakes.dedup_by_key(|error| error.to_string());
        if mistakes.is_empty() { Ok(()) } else { Err(LaboratoryError::Blocks(mistakes)) }
    }

    /// Accelerations that uplift no block: their figures and lines stay empty.
    pub(super) fn without_uplift(&self) -> Vec<String> {
        let amplitude_g = self.blocks.amplitude_g.abs();
        let stays = |alpha: &&f64| amplitude_g <= alpha.tan();
        let at_rest: Vec<String> =
            self.blocks.slendernesses_rad.iter().filter(stays).map(ToString::to_string).collect();
        let largest = self.accelerations.last().filter(|&&largest| largest <= 1.0);
        let spectra =
            largest.map(|largest| format!("accelerations up to {largest} g tan alpha do not uplift the block"));
        let low: Vec<String> =
            self.acceleration_lines.iter().filter(|&&line| line <= 1.0).map(ToString::to_string).collect();
        let lines = (!low.is_empty())
            .then(|| format!("acceleration lines at {} g tan alpha do not uplift the block", low.join(", ")));
        let blocks = (!at_rest.is_empty())
            .then(|| format!("{amplitude_g} g does not uplift blocks of slenderness {}", at_rest.join(", ")));
        spectra.into_iter().chain(lines).chain(blocks).collect()
    }

    /// A block with the restitution that was asked for.
    pub(super) fn block(&self, size_m: f64, slenderness_rad: f64) -> Result<RockingBlock, BlockError> {
        let block = RockingBlock::new(size_m, slenderness_rad)?;
        self.restitution.map_or(Ok(block), |restitution| block.with_restitution(restitution))
    }

    /// How many motions are computed.
    pub fn points(&self) -> u64 {
        let (frequencies, accelerations) = (self.frequencies.len(), self.accelerations.len());
        let of_a_shape = accelerations * (frequencies + self.frequency_lines.len() + self.half_widths.len())
            + self.acceleration_lines.len() * frequencies
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
