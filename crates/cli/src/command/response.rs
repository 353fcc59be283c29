//! `uplift response`: one record through one oscillator.

use std::path::PathBuf;

use clap::Args;
use uplift::response::{ResponseOptions, response as respond};
use uplift_motion::{AccelerationUnit, STANDARD_GRAVITY_M_S2};
use uplift_report::{check_figure_file, plot_response};

use super::arguments::ForceArgument;
use crate::error::CommandError;
use crate::show::{print_json, print_response};

#[derive(Debug, Args)]
pub(super) struct ResponseArguments {
    /// Record: PEER AT2, or text with one column (acceleration) or two (time, acceleration)
    record: PathBuf,
    /// Strength: uplift force over weight
    #[arg(long, value_name = "ETA", allow_negative_numbers = true)]
    strength: f64,
    /// Factor on the record
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
    scale: f64,
    /// Displacement at uplift, m
    #[arg(long, default_value_t = 0.0005, value_name = "M", allow_negative_numbers = true)]
    uplift_displacement_m: f64,
    /// Displacement where the restoring force vanishes, m: a negative-stiffness system that can overturn
    #[arg(long, value_name = "M", conflicts_with = "post_uplift_stiffness_per_s2", allow_negative_numbers = true)]
    capacity_m: Option<f64>,
    /// Stiffness after uplift over the mass, 1/s2: a system of positive post-uplift stiffness
    #[arg(long, value_name = "K", allow_negative_numbers = true)]
    post_uplift_stiffness_per_s2: Option<f64>,
    /// Coefficient of restitution at impact
    #[arg(long, default_value_t = 0.95, value_name = "R", allow_negative_numbers = true)]
    restitution: f64,
    /// Acceleration of gravity, m/s2
    #[arg(long, default_value_t = STANDARD_GRAVITY_M_S2, value_name = "G", allow_negative_numbers = true)]
    gravity_m_s2: f64,
    /// Sampling interval of a one-column record, s
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    dt_s: Option<f64>,
    /// Unit of a text record: g, m/s2, cm/s2 or gal
    #[arg(long)]
    unit: Option<AccelerationUnit>,
    /// Which component of a file with several, counted from 1
    #[arg(long, value_name = "N")]
    channel: Option<usize>,
    /// Follow the free vibration after the record for so many seconds
    #[arg(long, default_value_t = 0.0, value_name = "S", allow_negative_numbers = true)]
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

impl ResponseArguments {
    fn options(&self) -> ResponseOptions {
        ResponseOptions {
            record: self.record.clone(),
            channel: self.channel,
            dt_s: self.dt_s,
            unit: self.unit,
            scale: self.scale,
            strength: self.strength,
            uplift_displacement_m: self.uplift_displacement_m,
            capacity_m: self.capacity_m,
            post_uplift_stiffness_per_s2: self.post_uplift_stiffness_per_s2,
            restitution: self.restitution,
            gravity_m_s2: self.gravity_m_s2,
            free_vibration_s: self.free_vibration_s,
            history: self.plot.is_some(),
            history_file: self.history.clone(),
            force: self.overwriting.force,
        }
    }
}

pub(super) fn response(arguments: &ResponseArguments) -> Result<(), CommandError> {
    if let Some(figure) = &arguments.plot {
        check_figure_file(figure, &[&arguments.record], arguments.overwriting.force)?;
    }
    let report = respond(&arguments.options())?;
    if let Some(figure) = &arguments.plot {
        plot_response(&report, figure)?;
    }
    if arguments.json { print_json(&report) } else { print_response(&report, arguments.plot.as_deref()) }
}
