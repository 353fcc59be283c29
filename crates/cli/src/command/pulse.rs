//! `uplift pulse`: rocking spectra of a rigid block under Ricker wavelets.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use uplift::pulses::{BlockPlan, PulseOptions, PulsePlan, pulses};
use uplift_block::RickerShape;
use uplift_report::{FigureOptions, check_pulse_figures, plot_pulses};
use uplift_study::Grid;

use super::arguments::{Overwriting, number, require_folder};
use crate::error::CommandError;
use crate::show::{print_json, print_pulses};
use crate::terminal::Terminal;

/// Lines that a figure can distinguish.
const MOST_LINES: usize = 7;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift pulse --slenderness 0.2 -o results/pulses")]
pub(super) struct PulseArguments {
    /// Folder for figures and tables
    #[arg(short, long, value_name = "FOLDER", default_value = "results/pulses")]
    output: PathBuf,
    /// Wavelet: second or third derivative of the Gaussian (Eq. 2.7, 2.8)
    #[arg(long, value_enum, default_value_t = Shape::Both)]
    shape: Shape,
    /// Slenderness alpha of the block, atan(b/h), rad
    #[arg(long, value_name = "RAD", default_value_t = 0.1, allow_negative_numbers = true, value_parser = number)]
    slenderness: f64,
    /// Coefficient of restitution at impact [default: Housner's, Eq. 2.3]
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number)]
    restitution: Option<f64>,
    /// Axis omega_p/p of the spectra
    #[arg(
        long, value_name = "GRID", default_value = "0.04:0.04:8", help_heading = AXES,
        value_parser = axis, allow_negative_numbers = true
    )]
    frequencies: Grid,
    /// Axis a_p/(g tan alpha) of the spectra
    #[arg(
        long, value_name = "GRID", default_value = "0.5:0.05:10", help_heading = AXES,
        value_parser = axis, allow_negative_numbers = true
    )]
    accelerations: Grid,
    /// Axis b omega_p^2/a_p of the spectrum by the width of the base
    #[arg(
        long, value_name = "GRID", default_value = "0.025:0.025:6", help_heading = AXES,
        value_parser = axis, allow_negative_numbers = true
    )]
    half_widths: Grid,
    /// Values of omega_p/p drawn over the acceleration
    #[arg(
        long, value_name = "GRID", default_value = "1,2,3,4,6,8", help_heading = AXES,
        value_parser = lines, allow_negative_numbers = true
    )]
    frequency_lines: Grid,
    /// Values of a_p/(g tan alpha) drawn over the size-frequency parameter
    #[arg(
        long, value_name = "GRID", default_value = "1.25,1.5,2,3,5,8", help_heading = AXES,
        value_parser = lines, allow_negative_numbers = true
    )]
    acceleration_lines: Grid,
    /// Largest ground acceleration a_p, g
    #[arg(
        long,
        value_name = "G",
        default_value_t = 1.0,
        help_heading = BLOCKS,
        allow_negative_numbers = true,
        value_parser = number
    )]
    amplitude_g: f64,
    /// Period T_p of the wavelet, s [default: 0.5 symmetric, 1 antisymmetric]
    #[arg(long, value_name = "S", help_heading = BLOCKS, allow_negative_numbers = true, value_parser = number)]
    period_s: Option<f64>,
    /// Axis of sizes: parameter R, half the diagonal of the block, m
    #[arg(
        long, value_name = "GRID", default_value = "0.5:0.05:30", help_heading = BLOCKS,
        value_parser = axis, allow_negative_numbers = true
    )]
    sizes_m: Grid,
    /// Slendernesses to draw, rad
    #[arg(
        long, value_name = "GRID", default_value = "0.1:0.1:0.6", help_heading = BLOCKS,
        value_parser = lines, allow_negative_numbers = true
    )]
    slendernesses: Grid,
    #[command(flatten)]
    figures: FigureOptions,
    #[command(flatten)]
    overwriting: Overwriting,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

const AXES: &str = "Axes (numbers, or start:step:stop, set apart by commas)";
const BLOCKS: &str = "Blocks with a size in metres";

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Shape {
    Symmetric,
    Antisymmetric,
    Both,
}

/// Values above zero.
fn positive(text: &str) -> Result<Grid, String> {
    let grid: Grid = text.parse().map_err(|error: uplift_study::GridError| error.to_string())?;
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

impl PulseArguments {
    fn plan(&self) -> PulsePlan {
        PulsePlan {
            shapes: match self.shape {
                Shape::Symmetric => vec![RickerShape::Symmetric],
                Shape::Antisymmetric => vec![RickerShape::Antisymmetric],
                Shape::Both => vec![RickerShape::Symmetric, RickerShape::Antisymmetric],
            },
            slenderness_rad: self.slenderness,
            restitution: self.restitution,
            frequencies: self.frequencies.to_vec(),
            accelerations: self.accelerations.to_vec(),
            half_widths: self.half_widths.to_vec(),
            frequency_slices: self.frequency_lines.to_vec(),
            acceleration_slices: self.acceleration_lines.to_vec(),
            blocks: BlockPlan {
                amplitude_g: self.amplitude_g,
                period_s: self.period_s,
                sizes_m: self.sizes_m.to_vec(),
                slendernesses_rad: self.slendernesses.to_vec(),
            },
        }
    }
}

pub(super) fn pulse(arguments: &PulseArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let folder = &arguments.output;
    require_folder(folder, "figures and tables")?;
    let (figures, force) = (arguments.figures, arguments.overwriting.force);
    check_pulse_figures(folder, figures, force)?;
    let mut report = pulses(&PulseOptions { plan: arguments.plan(), folder: Some(folder.clone()), force }, terminal)?;
    let figures = plot_pulses(&report, folder, figures)?;
    report.files.splice(..0, figures);
    if arguments.json { print_json(&report) } else { print_pulses(&report, terminal) }
}
