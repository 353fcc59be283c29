//! What limits an equivalent system that is nevertheless computed.

use std::fmt;

use crate::equivalent::NO_CAPACITY;

/// A property of the structure that limits what its equivalent oscillator is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Warning {
    /// The body is not slender: `tan α` and `α` differ by more than
    /// [`SLENDER_TOLERANCE`](crate::geometry::SLENDER_TOLERANCE).
    Stocky {
        /// Slenderness `α`, rad.
        slenderness_rad: f64,
        /// `(tan α − α)/tan α`: what linearisation takes off the static uplift force.
        linearisation_error: f64,
    },
    /// The force is constant after uplift: the structure is the ZSBE system itself and has no displacement capacity.
    ZeroStiffness,
    /// The force rises after uplift: there is no displacement capacity, and the rules of Section 3.3.2 do not apply.
    PositiveStiffness {
        /// Stiffness after uplift, N/m.
        stiffness_n_m: f64,
    },
    /// The curved extensions end before the force vanishes: the loop is trilinear, and the bilinear one replaces it by
    /// its chord from uplift to the overturning of the extended base, which is never above it.
    ExtensionEnds {
        /// Displacement at which rolling ends, m.
        rolling_until_m: f64,
        /// Displacement at which rolling would have lost all force, m: infinite where rolling does not soften.
        rolling_capacity_m: f64,
        /// Displacement at which the extended base overturns, `2 R' sin α'`, m.
        overturning_m: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stocky { slenderness_rad, linearisation_error } => write!(
                f,
                "slenderness {slenderness_rad:.4} rad: the body is stocky, the linearised uplift force is {:.1} % \
                 below the static one",
                100.0 * linearisation_error
            ),
            Self::ZeroStiffness => {
                write!(f, "post-uplift stiffness zero: the structure is the ZSBE system, with {NO_CAPACITY}")
            }
            Self::PositiveStiffness { stiffness_n_m } => write!(
                f,
                "post-uplift stiffness {stiffness_n_m:.6e} N/m, positive: {NO_CAPACITY}, and spectra and rules of \
                 negative-stiffness systems do not apply"
            ),
            Self::ExtensionEnds { rolling_until_m, rolling_capacity_m, overturning_m } => write!(
                f,
                "the curved extensions end at {rolling_until_m:.4} m, before the force vanishes (rolling alone: {}): \
                 the loop is trilinear, taken as the straight line to the overturning of the extended base at \
                 {overturning_m:.4} m",
                if rolling_capacity_m.is_finite() { format!("{rolling_capacity_m:.4} m") } else { "never".to_owned() }
            ),
        }
    }
}
