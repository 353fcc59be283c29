//! What can be wrong with a spring, a restrainer or the columns that it holds.

use thiserror::Error;
use uplift_plausible::Implausible;
use uplift_structure::StructureError;
pub(crate) use uplift_structure::{not_negative, positive, require};

/// Why a restrainer, or what it holds, cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum StaticsError {
    /// A number of a description is beyond what any restrainer has.
    #[error("`{}`{}", .0.name, .0.to_string().trim_start_matches(.0.name))]
    Implausible(Implausible),
    /// A description lacks a quantity that a tendon which moves in its duct needs.
    #[error("`{key}` is missing: anchorage \"shifted\" needs it; {advice}")]
    MissingForPath {
        /// Name of the quantity.
        key: &'static str,
        /// What to give.
        advice: &'static str,
    },
    /// A description lacks a quantity that its kind of restrainer needs.
    #[error("`{key}` is missing: a restrainer of kind \"{kind}\" needs it; {advice}")]
    Missing {
        /// Name of the quantity.
        key: &'static str,
        /// Kind of restrainer.
        kind: &'static str,
        /// What to give.
        advice: &'static str,
    },
    /// A description gives a quantity that its kind of restrainer does not have.
    #[error("`{key}` means nothing for {what}: remove it")]
    Foreign {
        /// Name of the quantity.
        key: &'static str,
        /// The kind of restrainer, or the anchorage, that does not have it.
        what: String,
    },
    /// Two quantities say the same thing.
    #[error("`{key}` and `{other}` are both given: give one of them")]
    Twice {
        /// The one quantity.
        key: &'static str,
        /// The other.
        other: &'static str,
    },
    /// The hole of a disc is as wide as the disc.
    #[error(
        "`inner_diameter_m` is {inner_diameter_m} m: it must be below `outer_diameter_m` = {outer_diameter_m} m; \
         the outer diameter stands first in a designation such as 125/61/6"
    )]
    Hole {
        /// Inner diameter, m.
        inner_diameter_m: f64,
        /// Outer diameter, m.
        outer_diameter_m: f64,
    },
    /// The free height of a disc leaves no cone.
    #[error(
        "`free_height_m` is {free_height_m} m, not above `thickness_m` = {thickness_m} m: it is the height of the \
         unloaded disc, cone and thickness together"
    )]
    FreeHeight {
        /// Free height `l0`, m.
        free_height_m: f64,
        /// Thickness `t`, m.
        thickness_m: f64,
    },
    /// The reduced thickness of a disc with contact flats is not below its thickness.
    #[error(
        "`reduced_thickness_m` is {reduced_thickness_m} m: with contact flats it lies below `thickness_m` = \
         {thickness_m} m, at 0.94 to 0.96 of it for standard discs, and above half of it"
    )]
    ReducedThickness {
        /// Reduced thickness `t'`, m.
        reduced_thickness_m: f64,
        /// Thickness `t`, m.
        thickness_m: f64,
    },
    /// A disc whose force falls over part of its deflection stands in series with something.
    #[error(
        "the disc's cone height over its thickness is {ratio:.3}, not below √2 = 1.414: its force falls over part of \
         its deflection, and in series with other springs or with a tendon it snaps through; take a flatter or a \
         thicker disc"
    )]
    SnapThrough {
        /// `h0/t`, with contact flats `K4 h0'/t'`.
        ratio: f64,
    },
    /// The prestress is more than the tendon carries.
    #[error("`prestress_n` is {prestress_n} N, not below the tendon's {key} = {limit_n} N: reduce it")]
    PrestressAboveYield {
        /// Prestress `T0`, N.
        prestress_n: f64,
        /// Name of the limit.
        key: &'static str,
        /// The limit, N.
        limit_n: f64,
    },
    /// The prestress is more than presses the springs flat.
    #[error(
        "`prestress_n` is {prestress_n} N, not below the {flat_n:.0} N that press the springs flat: the springs would \
         do nothing; use less prestress or stronger springs"
    )]
    PrestressBeyondFlat {
        /// Prestress `T0`, N.
        prestress_n: f64,
        /// Force at which the springs are flat, N.
        flat_n: f64,
    },
    /// A loose nut and prestress exclude each other.
    #[error("`slack_m` = {slack_m} m and `prestress_n` = {prestress_n} N: a tendon is either loose or taut; give one")]
    SlackAndPrestress {
        /// Slack, m.
        slack_m: f64,
        /// Prestress, N.
        prestress_n: f64,
    },
    /// The stopper engages only when the springs are flat.
    #[error(
        "the stopper's `gap_m` is {gap_m} m, not below the {flat_m:.6} m at which the springs are flat: it would \
         never engage; shorten the gap"
    )]
    StopperBehindFlat {
        /// Gap, m.
        gap_m: f64,
        /// Deformation of the stack when flat, m.
        flat_m: f64,
    },
    /// The prestress alone engages the stopper.
    #[error(
        "`prestress_n` alone deforms the springs by {deformation_m:.6} m, not less than the stopper's `gap_m` = \
         {gap_m} m: take less prestress or a wider gap"
    )]
    StopperAtRest {
        /// Deformation under the prestress, m.
        deformation_m: f64,
        /// Gap, m.
        gap_m: f64,
    },
    /// The tendon of a shifted path ends below the top of the column.
    #[error(
        "`tendon_length_m` is {tendon_length_m} m, below the column's height of {height_m} m: a tendon that can \
         shift in its duct runs from the foot of the column to an anchorage above its top"
    )]
    TendonShorterThanColumn {
        /// Length of the tendon, m.
        tendon_length_m: f64,
        /// Height of the column, m.
        height_m: f64,
    },
    /// The duct gap reaches the edge of the column.
    #[error("`duct_gap_m` is {duct_gap_m} m: it must be below the column's half width of {half_width_m} m")]
    DuctGap {
        /// Distance from the axis at which the tendon touches, m.
        duct_gap_m: f64,
        /// Half width of the column, m.
        half_width_m: f64,
    },
    /// A displacement has no rotation of the column.
    #[error(
        "a displacement of {displacement_m} m is beyond the column's reach: it must lie between 0 and {largest_m:.6} m"
    )]
    Displacement {
        /// Displacement asked for, m.
        displacement_m: f64,
        /// The largest that the column has before its diagonal lies level, m.
        largest_m: f64,
    },
    /// The springs are flat and nothing else yields.
    #[error(
        "an elongation of {elongation_m:.6} m is beyond the {flat_m:.6} m at which the springs are flat{at}: \
         there the restrainer stops the column (`when_flat` = \"stop\", or no tendon to stretch on)"
    )]
    BeyondFlat {
        /// Elongation asked for, m.
        elongation_m: f64,
        /// Elongation at which the springs are flat, m.
        flat_m: f64,
        /// Where that is, in words with a leading blank; may be empty.
        at: String,
    },
    /// More columns are restrained than there are.
    #[error("{restrained} restrained columns of {columns}: give at most {columns}")]
    Restrained {
        /// Columns with a restrainer.
        restrained: u32,
        /// Columns.
        columns: u32,
    },
    /// A number is outside the range that makes physical sense, or the geometry of the column is wrong.
    #[error(transparent)]
    Structure(#[from] StructureError),
}

impl StaticsError {
    /// Keys of a description whose values are at fault, the one to change first before the others; empty where none is.
    pub fn keys(&self) -> &[&'static str] {
        match self {
            Self::Missing { key, .. }
            | Self::MissingForPath { key, .. }
            | Self::Foreign { key, .. }
            | Self::Twice { key, .. } => std::slice::from_ref(key),
            Self::Implausible(Implausible { name, .. }) => std::slice::from_ref(name),
            Self::Hole { .. } => &["inner_diameter_m", "outer_diameter_m"],
            Self::FreeHeight { .. } => &["free_height_m", "thickness_m"],
            Self::ReducedThickness { .. } => &["reduced_thickness_m", "thickness_m"],
            Self::SnapThrough { .. } => &["cone_height_m", "free_height_m", "thickness_m"],
            Self::PrestressAboveYield { .. } | Self::PrestressBeyondFlat { .. } | Self::StopperAtRest { .. } => {
                &["prestress_n"]
            }
            Self::SlackAndPrestress { .. } => &["slack_m", "prestress_n"],
            Self::StopperBehindFlat { .. } => &["gap_m"],
            Self::TendonShorterThanColumn { .. } => &["tendon_length_m"],
            Self::DuctGap { .. } => &["duct_gap_m"],
            Self::Structure(mistake) => mistake.keys(),
            Self::Displacement { .. } | Self::BeyondFlat { .. } | Self::Restrained { .. } => &[],
        }
    }
}
