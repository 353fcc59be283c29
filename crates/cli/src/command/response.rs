//! `uplift response`: one record through one oscillator or one rigid block.

use std::path::PathBuf;

use clap::Args;
use uplift::response::{BlockResponseOptions, ResponseOptions, Shaking, block_response, response as respond};
use uplift_motion::{AccelerationUnit, STANDARD_GRAVITY_M_S2};
use uplift_report::{check_figure_file, plot_block_response, plot_response};

use super::arguments::{ForceArgument, number};
use crate::error::CommandError;
use crate::show::{print_block_response, print_json, print_response};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct ResponseArguments {
    /// Record: PEER AT2, or text with one column (acceleration) or two (time, acceleration)
    record: PathBuf,
    /// Strength of the oscillator: uplift force over weight
    #[arg(
        long,
        value_name = "ETA",
        required_unless_present = "block",
        conflicts_with = "block",
        allow_negative_numbers = true,
        value_parser = number,
    )]
    strength: Option<f64>,
    /// Factor on the record
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true, value_parser = number)]
    scale: f64,
    /// Displacement at uplift, m
    #[arg(
        long,
        default_value_t = 0.0005,
        value_name = "M",
        conflicts_with = "block",
        allow_negative_numbers = true,
        value_parser = number
    )]
    uplift_displacement_m: f64,
    /// Displacement where the restoring force vanishes, m: a negative-stiffness system that can overturn
    #[arg(
        long, value_name = "M", conflicts_with_all = ["post_uplift_stiffness_per_s2", "block"],
        allow_negative_numbers = true,
        value_parser = number,
    )]
    capacity_m: Option<f64>,
    /// Stiffness after uplift over the mass, 1/s2: a system of positive post-uplift stiffness
    #[arg(long, value_name = "K", conflicts_with = "block", allow_negative_numbers = true, value_parser = number)]
    post_uplift_stiffness_per_s2: Option<f64>,
    /// Coefficient of restitution at impact [default: 0.95; of a block Housner's, Eq. 2.3]
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number)]
    restitution: Option<f64>,
    #[command(flatten)]
    block: BlockArguments,
    /// Acceleration of gravity, m/s2
    #[arg(
        long,
        default_value_t = STANDARD_GRAVITY_M_S2,
        value_name = "G",
        allow_negative_numbers = true,
        value_parser = number
    )]
    gravity_m_s2: f64,
    /// Sampling interval of a one-column record, s
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = number)]
    dt_s: Option<f64>,
    /// Unit of a text record: g, m/s2, cm/s2 or gal
    #[arg(long)]
    unit: Option<AccelerationUnit>,
    /// Which component of a file with several, counted from 1
    #[arg(long, value_name = "N")]
    channel: Option<usize>,
    /// Follow the free vibration after the record for so many seconds; without it an oscillator is followed to the end
    /// of the record, a block to its first peak after it
    #[arg(long, default_value_t = 0.0, value_name = "S", allow_negative_numbers = true, value_parser = number)]
    free_vibration_s: f64,
    /// Print the response as JSON
    #[arg(long)]
    json: bool,
    /// Write the time history, with uplifts and impacts in their places, to this CSV file
    #[arg(long, value_name = "FILE.csv")]
    history: Option<PathBuf>,
    /// Draw the time history, its impacts marked, as SVG or PNG
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    overwriting: ForceArgument,
}

/// A rigid rocking block (Eq. 2.1 to 2.3).
#[derive(Debug, Args)]
#[command(next_help_heading = "Rigid rocking block (two of its numbers)")]
struct BlockArguments {
    /// Shake a rigid rocking block in place of an oscillator: its full nonlinear motion
    #[arg(long)]
    block: bool,
    /// Width 2b, m
    #[arg(long, value_name = "M", requires = "block", allow_negative_numbers = true, value_parser = number)]
    width_m: Option<f64>,
    /// Height 2h, m
    #[arg(long, value_name = "M", requires = "block", allow_negative_numbers = true, value_parser = number)]
    height_m: Option<f64>,
    /// Size R, half the diagonal, m
    #[arg(long, value_name = "M", requires = "block", allow_negative_numbers = true, value_parser = number)]
    size_m: Option<f64>,
    /// Slenderness alpha, atan(width/height), rad
    #[arg(long, value_name = "RAD", requires = "block", allow_negative_numbers = true, value_parser = number)]
    slenderness: Option<f64>,
}

impl ResponseArguments {
    fn shaking(&self) -> Shaking {
        Shaking {
            record: self.record.clone(),
            channel: self.channel,
            dt_s: self.dt_s,
            unit: self.unit,
            scale: self.scale,
            gravity_m_s2: self.gravity_m_s2,
            free_vibration_s: self.free_vibration_s,
            history: self.plot.is_some(),
            history_file: self.history.clone(),
            force: self.overwriting.force,
        }
    }

    /// The oscillator of this `strength`.
    fn oscillator(&self, strength: f64) -> ResponseOptions {
        let usual = ResponseOptions::new("", strength);
        ResponseOptions {
            shaking: self.shaking(),
            uplift_displacement_m: self.uplift_displacement_m,
            capacity_m: self.capacity_m,
            post_uplift_stiffness_per_s2: self.post_uplift_stiffness_per_s2,
            restitution: self.restitution.unwrap_or(usual.restitution),
            ..usual
        }
    }

    fn block(&self) -> BlockResponseOptions {
        BlockResponseOptions {
            shaking: self.shaking(),
            width_m: self.block.width_m,
            height_m: self.block.height_m,
            size_m: self.block.size_m,
            slenderness_rad: self.block.slenderness,
            restitution: self.restitution,
        }
    }
}

pub(super) fn response(arguments: &ResponseArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let figure = arguments.plot.as_deref();
    if let Some(figure) = figure {
        check_figure_file(figure, &[&arguments.record], arguments.overwriting.force)?;
    }
    if let Some(strength) = arguments.strength {
        let report = respond(&arguments.oscillator(strength))?;
        if let Some(figure) = figure {
            plot_response(&report, figure)?;
        }
        if arguments.json { print_json(&report) } else { print_response(&report, figure, terminal) }
    } else {
        let report = block_response(&arguments.block())?;
        if let Some(figure) = figure {
            plot_block_response(&report, figure)?;
        }
        if arguments.json { print_json(&report) } else { print_block_response(&report, figure, terminal) }
    }
}
