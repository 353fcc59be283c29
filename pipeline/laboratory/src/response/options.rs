//! What is shaken, and by what.

use std::iter::repeat;
use std::path::{Path, PathBuf};

use clap::Args;
use uplift_design::frame_model;
use uplift_frame::Model;
use uplift_job::typed::number;
use uplift_motion::{AccelerationUnit, STANDARD_GRAVITY_M_S2};

/// Which system is shaken, and by what: an oscillator of a `strength`, a block, or the frame of a structure file.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ResponseOptions {
    /// Record file
    #[arg(required_unless_present = "structure")]
    pub record: Option<PathBuf>,
    /// Uplift strength: uplift force over weight
    #[arg(
        long,
        value_name = "ETA",
        required_unless_present_any = ["block", "structure"],
        conflicts_with_all = ["block", "structure"],
        allow_negative_numbers = true,
        value_parser = number,
    )]
    pub strength: Option<f64>,
    /// Scale factor of the record; negative reverses its sign
    #[arg(
        long, default_value_t = ResponseOptions::default().scale, allow_negative_numbers = true,
        value_parser = number
    )]
    pub scale: f64,
    /// Displacement at uplift, m
    #[arg(
        long,
        default_value_t = ResponseOptions::default().uplift_displacement_m,
        value_name = "M",
        conflicts_with_all = ["block", "structure"],
        allow_negative_numbers = true,
        value_parser = number
    )]
    pub uplift_displacement_m: f64,
    /// Displacement capacity, m: negative stiffness after uplift
    #[arg(
        long, value_name = "M", conflicts_with_all = ["post_uplift_stiffness_per_s2", "block", "structure"],
        allow_negative_numbers = true,
        value_parser = number,
    )]
    pub capacity_m: Option<f64>,
    /// Stiffness after uplift over mass, 1/s2: positive stiffness
    #[arg(
        long, value_name = "K", conflicts_with_all = ["block", "structure"], allow_negative_numbers = true,
        value_parser = number,
    )]
    pub post_uplift_stiffness_per_s2: Option<f64>,
    /// Coefficient of restitution [default: 0.95; block Eq. 2.3; frame its file's, else Eq. 6.5]
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number)]
    pub restitution: Option<f64>,
    /// Acceleration of gravity, m/s2
    #[arg(
        long,
        default_value_t = ResponseOptions::default().gravity_m_s2,
        value_name = "G",
        conflicts_with = "structure",
        allow_negative_numbers = true,
        value_parser = number
    )]
    pub gravity_m_s2: f64,
    /// Time step of a one-column record, s
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = number)]
    pub dt_s: Option<f64>,
    /// Unit of a text record: g, m/s2, cm/s2 or gal
    #[arg(long)]
    pub unit: Option<AccelerationUnit>,
    /// Component of a file with several, from 1; of a frame one each for --h1, --h2, --v
    #[arg(long, value_name = "N[,N…]", value_delimiter = ',')]
    pub channel: Vec<usize>,
    /// Seconds of free motion after the record
    #[arg(
        long, default_value_t = ResponseOptions::default().free_vibration_s, value_name = "S",
        allow_negative_numbers = true, value_parser = number
    )]
    pub free_vibration_s: f64,
    /// The block.
    #[command(flatten)]
    pub block: BlockOptions,
    /// The frame.
    #[command(flatten)]
    pub frame: FrameOptions,
    /// Whether the report holds the time history.
    #[arg(skip)]
    pub history: bool,
    /// A CSV file for the time history.
    #[arg(skip)]
    pub history_file: Option<PathBuf>,
    /// Whether whatever is at the place of that file is overwritten.
    #[arg(skip)]
    pub force: bool,
}

/// A rigid rocking block (Eq. 2.1 to 2.3). Two numbers make it: width and height, or a slenderness and one length.
/// Without free vibration it is followed to its first peak after the record, the last that may be the largest.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Rigid rocking block (two of its numbers)")]
pub struct BlockOptions {
    /// Shake a rigid block instead of an oscillator
    #[arg(long)]
    pub block: bool,
    /// Width 2b, m
    #[arg(long, value_name = "M", requires = "block", allow_negative_numbers = true, value_parser = number)]
    pub width_m: Option<f64>,
    /// Height 2h, m
    #[arg(long, value_name = "M", requires = "block", allow_negative_numbers = true, value_parser = number)]
    pub height_m: Option<f64>,
    /// Size R, half the diagonal, m
    #[arg(long, value_name = "M", requires = "block", allow_negative_numbers = true, value_parser = number)]
    pub size_m: Option<f64>,
    /// Slenderness alpha, atan(width/height), rad
    #[arg(
        long = "slenderness", value_name = "RAD", requires = "block", allow_negative_numbers = true,
        value_parser = number
    )]
    pub slenderness_rad: Option<f64>,
}

/// A rocking frame (Chapter 6), and what shakes it. Without free vibration it is followed to its first peak after the
/// shaking, the last that may be the largest; whether it survives is then a root of its energy.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Rocking frame (Chapter 6)")]
pub struct FrameOptions {
    /// Shake the frame of this structure file
    #[arg(long, value_name = "FRAME.toml", conflicts_with = "block")]
    pub structure: Option<PathBuf>,
    /// First horizontal component
    #[arg(long, value_name = "FILE", requires = "structure")]
    pub h1: Option<PathBuf>,
    /// Second horizontal component
    #[arg(long, value_name = "FILE", requires = "structure")]
    pub h2: Option<PathBuf>,
    /// Vertical component, upwards positive
    #[arg(long, value_name = "FILE", requires = "structure")]
    pub v: Option<PathBuf>,
    /// Model of the frame: planar or wobbling [default: by the shape of its columns]
    #[arg(long, value_name = "MODEL", requires = "structure", value_parser = frame_model)]
    pub model: Option<Model>,
    /// Rotation below which the frame rests, rad [default: 1e-5 wobbling, 0 planar]
    #[arg(long, value_name = "RAD", requires = "structure", allow_negative_numbers = true, value_parser = number)]
    pub rest_amplitude_rad: Option<f64>,
    /// Initial tilt of a wobbling frame, rad [default: 1e-12]
    #[arg(long, value_name = "RAD", requires = "structure", allow_negative_numbers = true, value_parser = number)]
    pub start_rotation_rad: Option<f64>,
}

impl Default for ResponseOptions {
    /// Neither a system nor a record; else the values of the studies.
    fn default() -> Self {
        Self {
            record: None,
            strength: None,
            scale: 1.0,
            uplift_displacement_m: 0.0005,
            capacity_m: None,
            post_uplift_stiffness_per_s2: None,
            restitution: None,
            block: BlockOptions::default(),
            frame: FrameOptions::default(),
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            dt_s: None,
            unit: None,
            channel: Vec::new(),
            free_vibration_s: 0.0,
            history: false,
            history_file: None,
            force: false,
        }
    }
}

impl ResponseOptions {
    /// Files that are read.
    pub fn inputs(&self) -> Vec<&Path> {
        let FrameOptions { structure, h1, h2, v, .. } = &self.frame;
        [&self.record, structure, h1, h2, v].into_iter().filter_map(|file| file.as_deref()).collect()
    }

    /// The components that shake a frame, each with what it is called and the channel of its file.
    pub(super) fn components(&self) -> impl Iterator<Item = (&'static str, &Path, Option<usize>)> {
        let FrameOptions { h1, h2, v, .. } = &self.frame;
        let given =
            [("h1", h1), ("h2", h2), ("v", v)].into_iter().filter_map(|(name, file)| Some((name, file.as_deref()?)));
        let channels = self.channel.iter().copied().map(Some).chain(repeat(None));
        given.zip(channels).map(|((name, file), channel)| (name, file, channel))
    }
}
