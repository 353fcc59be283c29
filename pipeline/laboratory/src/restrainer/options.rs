//! What is asked of a design of stacks.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use std::path::PathBuf;

use clap::builder::TypedValueParser;
use clap::{ArgGroup, Args};
use uplift_design::DesignOptions;
use uplift_job::typed::{number, one_of};
use uplift_motion::IntensityMeasure;
use uplift_statics::{Limits, Ranking, Tendon};
use uplift_uniform_risk::OneRisk;

const TARGET: &str = "Target (one of the first five)";
const SPECTRUM: &str = "By a spectrum";
const STOPPER: &str = "Stoppers";
const OUTPUT: &str = "Output";

/// By what stacks are ranked, by its word on a command line.
const RANKINGS: [(&str, Ranking); 4] =
    [("target", Ranking::Target), ("mass", Ranking::Mass), ("length", Ranking::Length), ("price", Ranking::Price)];

/// What is asked of a design. Tendon, prestress and path are those of the structure's restrainer.
#[expect(clippy::struct_excessive_bools, reason = "each is an option")]
#[derive(Debug, Clone, PartialEq, Args)]
#[command(group = ArgGroup::new("target").required(true).multiple(false))]
pub struct RestrainerDesignOptions {
    /// Catalogue of discs (CSV), e.g. configs/structures/disc-springs.csv
    #[arg(long, value_name = "FILE.csv")]
    pub catalogue: PathBuf,
    /// Target secant stiffness of springs and tendon, N/m, at --at-m
    #[arg(
        long, value_name = "K", group = "target", help_heading = TARGET, allow_negative_numbers = true,
        value_parser = number
    )]
    pub stiffness_n_m: Option<f64>,
    /// Target displacement capacity, m
    #[arg(
        long, value_name = "M", group = "target", help_heading = TARGET, allow_negative_numbers = true,
        value_parser = number
    )]
    pub capacity_m: Option<f64>,
    /// Target the capacity required by the spectrum of this result
    #[arg(long, value_name = "RESULT", group = "target", help_heading = TARGET)]
    pub urs: Option<PathBuf>,
    /// Target zero stiffness after uplift
    #[arg(long, group = "target", help_heading = TARGET)]
    pub zero_stiffness: bool,
    /// Target positive stiffness after uplift
    #[arg(long, group = "target", help_heading = TARGET)]
    pub positive_stiffness: bool,
    /// Displacement of the deck for a stiffness, m [default: two column widths]
    #[arg(long, value_name = "M", help_heading = TARGET, allow_negative_numbers = true, value_parser = number)]
    pub at_m: Option<f64>,
    /// Site [default: the only one]
    #[arg(long, requires = "urs", help_heading = SPECTRUM)]
    pub site: Option<String>,
    /// The risk of the demand.
    #[command(flatten, next_help_heading = SPECTRUM)]
    pub risk: OneRisk,
    /// Intensity measure [default: pgv]
    #[arg(long, requires = "urs", help_heading = SPECTRUM)]
    pub measure: Option<IntensityMeasure>,
    /// Safety factor on the demand (Eq. 3.15)
    #[arg(
        long, value_name = "FS", default_value_t = DesignOptions::default().safety_factor, help_heading = SPECTRUM,
        allow_negative_numbers = true, value_parser = number
    )]
    pub safety_factor: f64,
    /// Judge the equivalent oscillator alone, not the frame itself
    #[arg(long, requires = "urs", help_heading = SPECTRUM)]
    pub proxy: bool,
    /// What limits the stack.
    #[command(flatten)]
    pub limits: LimitOptions,
    /// Spring deformation at which stoppers engage, m
    #[arg(
        long, value_name = "M", requires = "stopper_stiffness_n_m", help_heading = STOPPER,
        allow_negative_numbers = true, value_parser = number
    )]
    pub stopper_gap_m: Option<f64>,
    /// Stiffness EA/L of the stoppers' rods, N/m
    #[arg(
        long, value_name = "K", requires = "stopper_gap_m", help_heading = STOPPER, allow_negative_numbers = true,
        value_parser = number
    )]
    pub stopper_stiffness_n_m: Option<f64>,
    /// Rank by target, mass, length or price
    #[arg(
        long, value_parser = one_of(&RANKINGS, |(word, _)| word).map(|(_, ranking)| ranking), default_value = "mass",
        help_heading = OUTPUT
    )]
    pub rank: Ranking,
    /// Number of stacks to print [default: 3; in detail 12]
    #[arg(long, value_name = "N", help_heading = OUTPUT)]
    pub most: Option<usize>,
    /// Stack whose tolerances are reported [default: the first]
    #[arg(long, value_name = "STACK", help_heading = OUTPUT)]
    pub tolerances_of: Option<String>,
    /// Write every stack
    #[arg(short = 'o', long = "output", value_name = "FILE.csv", help_heading = OUTPUT)]
    pub table: Option<PathBuf>,
    /// Whether an existing file there is overwritten.
    #[arg(skip)]
    pub force: bool,
}

impl RestrainerDesignOptions {
    /// Site, risk, measure and safety factor of a target by a spectrum.
    pub(super) fn by_spectrum(&self) -> DesignOptions {
        DesignOptions {
            site: self.site.clone(),
            risk: self.risk,
            measure: self.measure,
            safety_factor: self.safety_factor,
            proxy: self.proxy,
            ..DesignOptions::default()
        }
    }
}

/// What limits a stack.
#[derive(Debug, Clone, PartialEq, Args)]
#[command(next_help_heading = "Limits")]
pub struct LimitOptions {
    /// Relative tolerance of a stiffness
    #[arg(long, value_name = "SHARE", default_value_t = 0.1, allow_negative_numbers = true, value_parser = number)]
    pub tolerance: f64,
    /// Relative tolerance of a capacity
    #[arg(long, value_name = "SHARE", default_value_t = 0.25, allow_negative_numbers = true, value_parser = number)]
    pub excess: f64,
    /// Largest share of the stroke: 1 is flat, 0.75 for durability
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, allow_negative_numbers = true, value_parser = number)]
    pub stroke: f64,
    /// Safety factor on the tendon's yield
    #[arg(long, value_name = "FS", default_value_t = 1.5, allow_negative_numbers = true, value_parser = number)]
    pub tendon_factor: f64,
    /// Largest force of the tendon, N
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    pub largest_force_n: Option<f64>,
    /// Largest outer diameter, m
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub largest_diameter_m: Option<f64>,
    /// Smallest inner diameter, m
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub least_inner_diameter_m: Option<f64>,
    /// Largest height of the unloaded stack, m
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub largest_length_m: Option<f64>,
    /// Most discs in parallel, 1 to 4
    #[arg(long, value_name = "N", default_value_t = 2)]
    pub parallel: u32,
    /// Most packets in series, 1 to 100
    #[arg(long, value_name = "N", default_value_t = 40)]
    pub springs: u32,
}

impl LimitOptions {
    /// The limits of a stack behind a tendon, without prestress and held in the axis at the column's foot.
    pub(super) fn behind(&self, tendon: Tendon) -> Limits {
        Limits {
            tolerance: self.tolerance,
            capacity_excess: self.excess,
            stroke_share: self.stroke,
            tendon_factor: self.tendon_factor,
            largest_force_n: self.largest_force_n,
            largest_diameter_m: self.largest_diameter_m,
            least_inner_diameter_m: self.least_inner_diameter_m,
            largest_length_m: self.largest_length_m,
            most_parallel: self.parallel,
            most_series: self.springs,
            ..Limits::behind(tendon)
        }
    }
}
