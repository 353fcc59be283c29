//! `uplift response`: one record through one oscillator or one rigid block, or components of one through a frame.

use std::path::PathBuf;

use clap::Args;
use uplift::response::{
    BlockResponseOptions, ComponentFile, FrameResponseOptions, ResponseOptions, Shaking, block_response,
    frame_response, response as respond,
};
use uplift::structure::frame_model;
use uplift::study::Structure;
use uplift_frame::Model;
use uplift_motion::{AccelerationUnit, STANDARD_GRAVITY_M_S2};
use uplift_report::{check_figure_file, plot_block_response, plot_frame_response, plot_response};

use super::arguments::{Overwriting, number};
use crate::error::CommandError;
use crate::show::{print_block_response, print_frame_response, print_json, print_response};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    uplift response motion.at2 --strength 0.1 --plot history.svg\n  \
    uplift response motion.at2 --block --width-m 0.6 --height-m 3\n  \
    uplift response --structure configs/structures/footbridge.toml --h1 x.at2 --h2 y.at2")]
pub(super) struct ResponseArguments {
    /// Record file
    #[arg(required_unless_present = "structure")]
    record: Option<PathBuf>,
    /// Uplift strength: uplift force over weight
    #[arg(
        long,
        value_name = "ETA",
        required_unless_present_any = ["block", "structure"],
        conflicts_with_all = ["block", "structure"],
        allow_negative_numbers = true,
        value_parser = number,
    )]
    strength: Option<f64>,
    /// Scale factor of the record; negative reverses its sign
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true, value_parser = number)]
    scale: f64,
    /// Displacement at uplift, m
    #[arg(
        long,
        default_value_t = 0.0005,
        value_name = "M",
        conflicts_with_all = ["block", "structure"],
        allow_negative_numbers = true,
        value_parser = number
    )]
    uplift_displacement_m: f64,
    /// Displacement capacity, m: negative stiffness after uplift
    #[arg(
        long, value_name = "M", conflicts_with_all = ["post_uplift_stiffness_per_s2", "block", "structure"],
        allow_negative_numbers = true,
        value_parser = number,
    )]
    capacity_m: Option<f64>,
    /// Stiffness after uplift over mass, 1/s2: positive stiffness
    #[arg(
        long, value_name = "K", conflicts_with_all = ["block", "structure"], allow_negative_numbers = true,
        value_parser = number,
    )]
    post_uplift_stiffness_per_s2: Option<f64>,
    /// Coefficient of restitution [default: 0.95; block Eq. 2.3; frame its file's, else Eq. 6.5]
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number)]
    restitution: Option<f64>,
    #[command(flatten)]
    block: BlockArguments,
    #[command(flatten)]
    frame: FrameArguments,
    /// Acceleration of gravity, m/s2
    #[arg(
        long,
        default_value_t = STANDARD_GRAVITY_M_S2,
        value_name = "G",
        conflicts_with = "structure",
        allow_negative_numbers = true,
        value_parser = number
    )]
    gravity_m_s2: f64,
    /// Time step of a one-column record, s
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = number)]
    dt_s: Option<f64>,
    /// Unit of a text record: g, m/s2, cm/s2 or gal
    #[arg(long)]
    unit: Option<AccelerationUnit>,
    /// Component of a file with several, from 1; of a frame one each for --h1, --h2, --v
    #[arg(long, value_name = "N[,N…]", value_delimiter = ',')]
    channel: Vec<usize>,
    /// Seconds of free motion after the record
    #[arg(long, default_value_t = 0.0, value_name = "S", allow_negative_numbers = true, value_parser = number)]
    free_vibration_s: f64,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write the time history with uplifts and impacts
    #[arg(long, value_name = "FILE.csv")]
    history: Option<PathBuf>,
    /// Draw the time history
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    overwriting: Overwriting,
}

/// A rigid rocking block (Eq. 2.1 to 2.3).
#[derive(Debug, Args)]
#[command(next_help_heading = "Rigid rocking block (two of its numbers)")]
struct BlockArguments {
    /// Shake a rigid block instead of an oscillator
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

/// A rocking frame (Chapter 6).
#[derive(Debug, Args)]
#[command(next_help_heading = "Rocking frame (Chapter 6)")]
struct FrameArguments {
    /// Shake the frame of this structure file
    #[arg(long, value_name = "FRAME.toml", conflicts_with = "block")]
    structure: Option<PathBuf>,
    /// First horizontal component
    #[arg(long, value_name = "FILE", requires = "structure")]
    h1: Option<PathBuf>,
    /// Second horizontal component
    #[arg(long, value_name = "FILE", requires = "structure")]
    h2: Option<PathBuf>,
    /// Vertical component, upwards positive
    #[arg(long, value_name = "FILE", requires = "structure")]
    v: Option<PathBuf>,
    /// Model of the frame: planar or wobbling [default: by the shape of its columns]
    #[arg(long, value_name = "MODEL", requires = "structure", value_parser = frame_model)]
    model: Option<Model>,
    /// Rotation below which the frame rests, rad [default: 1e-5 wobbling, 0 planar]
    #[arg(long, value_name = "RAD", requires = "structure", allow_negative_numbers = true, value_parser = number)]
    rest_amplitude_rad: Option<f64>,
    /// Initial tilt of a wobbling frame, rad [default: 1e-12]
    #[arg(long, value_name = "RAD", requires = "structure", allow_negative_numbers = true, value_parser = number)]
    start_rotation_rad: Option<f64>,
}

impl ResponseArguments {
    fn shaking(&self) -> Shaking {
        Shaking {
            record: self.record.clone().unwrap_or_default(),
            channel: self.channel.first().copied(),
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

    /// Files that are read.
    fn inputs(&self) -> Vec<&PathBuf> {
        let FrameArguments { structure, h1, h2, v, .. } = &self.frame;
        [&self.record, structure, h1, h2, v].into_iter().flatten().collect()
    }

    fn of_frame(&self) -> Result<FrameResponseOptions, CommandError> {
        let FrameArguments { h1, h2, v, .. } = &self.frame;
        let given = [h1, h2, v].into_iter().flatten().count();
        if !(self.channel.is_empty() || self.channel.len() == given) {
            return Err(CommandError::Usage(format!(
                "--channel has {} numbers, and {given} components are given: one for each",
                self.channel.len()
            )));
        }
        let mut channels = self.channel.iter().copied();
        let [h1, h2, vertical] = [h1, h2, v]
            .map(|file| file.as_ref().map(|record| ComponentFile { record: record.clone(), channel: channels.next() }));
        Ok(FrameResponseOptions {
            shaking: self.shaking(),
            h1,
            h2,
            vertical,
            model: self.frame.model,
            restitution: self.restitution,
            rest_amplitude_rad: self.frame.rest_amplitude_rad,
            start_rotation_rad: self.frame.start_rotation_rad,
        })
    }
}

pub(super) fn response(arguments: &ResponseArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let figure = arguments.plot.as_deref();
    if let Some(figure) = figure {
        check_figure_file(figure, &arguments.inputs(), arguments.overwriting.force)?;
    }
    if let Some(file) = &arguments.frame.structure {
        if let Some(record) = &arguments.record {
            let (record, h1) = (record.display(), &arguments.frame.h1);
            let mend = if h1.is_some() { "leave out" } else { "write --h1" };
            return Err(CommandError::Usage(format!(
                "a structure takes its records by --h1, --h2 and --v: {mend} {record}"
            )));
        }
        let report = frame_response(&Structure::load(file)?, &arguments.of_frame()?)?;
        if let Some(figure) = figure {
            plot_frame_response(&report, figure)?;
        }
        return if arguments.json { print_json(&report) } else { print_frame_response(&report, figure, terminal) };
    }
    if arguments.channel.len() > 1 {
        return Err(CommandError::Usage("--channel has several numbers: one record has one component".to_owned()));
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
