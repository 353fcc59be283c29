//! How far a tendon is stretched as its column tilts: `Δ(θ)` for each way of anchoring it (Figures 6.3 and A2.1).
//!
//! With half width `b` and half height `h` of the column, the tendon's length `ℓ` and the distance `c` by which it can
//! move in its duct:
//!
//! | path | `Δ(θ)` |
//! |---|---|
//! | at the column's foot, centred | `2b sin(θ/2)` |
//! | in the foundation | `4b sin(θ/2)` |
//! | at the column's foot, free in the duct (Eq. A2.6) | `√(x² + y²) − ℓ` |
//! | the same, touching the duct (Eq. A2.7, corrected) | `√(4h² + c²) + √(x'² + y'²) − ℓ` |
//!
//! `x = b(1 − cos θ) + 2h sin θ`, `y = 2h cos θ + b sin θ + ℓ − 2h`,
//! `x' = b(1 − cos θ) + c cos θ`, `y' = (b − c) sin θ + ℓ − 2h`.
//!
//! Free in the duct the straight tendon lies off the axis, at the column's top, by
//! `2h [b(1 − cos θ) + (ℓ − 2h) sin θ]/[2h + b sin θ + (ℓ − 2h) cos θ]`; it touches where that equals `c`. There the
//! two forms have the same value and the same slope, as a taut string that begins to bend round a pin must; Eq. A2.7 as
//! printed lacks the `ℓ − 2h` and jumps.
//!
//! Every form is written so that it keeps its digits near `θ = 0`.

use uplift_structure::Geometry;

use crate::error::{StaticsError, not_negative, positive};

/// Where a tendon runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TendonPath {
    /// Anchored at the column's foot and held in its axis: it follows the opening at the top only.
    Column,
    /// Anchored in the foundation and held in the axis: it follows the openings at both ends.
    Foundation,
    /// Anchored at the column's foot, and free to move in a duct that is wider than it is.
    Shifted {
        /// Distance `c` by which the tendon moves until it touches: half the difference of the diameters, m.
        duct_gap_m: f64,
        /// Length `ℓ` of the tendon, m.
        tendon_length_m: f64,
    },
}

/// Elongation of a tendon, and how it grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elongation {
    /// `Δ`, m.
    pub elongation_m: f64,
    /// `Δ' = dΔ/dθ`, m/rad.
    pub rate_m: f64,
}

impl TendonPath {
    /// The path, if its lengths go with the column.
    ///
    /// # Errors
    /// A shifted tendon must reach above the column, and its gap lie between 0 and the half width.
    pub fn checked(self, column: &Geometry) -> Result<Self, StaticsError> {
        if let Self::Shifted { duct_gap_m, tendon_length_m } = self {
            not_negative("duct_gap_m", duct_gap_m, "m")?;
            positive("tendon_length_m", tendon_length_m, "m")?;
            let (half_width_m, height_m) = (column.half_width_m(), column.height_m());
            if duct_gap_m >= half_width_m {
                return Err(StaticsError::DuctGap { duct_gap_m, half_width_m });
            }
            if tendon_length_m < height_m {
                return Err(StaticsError::TendonShorterThanColumn { tendon_length_m, height_m });
            }
        }
        Ok(self)
    }

    /// Openings that the tendon follows: 1 at the column, 2 in the foundation. To first order `Δ` is `b θ` times it.
    pub fn openings(self) -> f64 {
        match self {
            Self::Column | Self::Shifted { .. } => 1.0,
            Self::Foundation => 2.0,
        }
    }

    /// Elongation at a rotation `θ ≥ 0` (rad) of the column.
    pub fn at(self, column: &Geometry, rotation_rad: f64) -> Elongation {
        let b = column.half_width_m();
        let (half_sin, half_cos) = (0.5 * rotation_rad).sin_cos();
        match self {
            Self::Column | Self::Foundation => {
                let lever_m = self.openings() * b;
                Elongation { elongation_m: 2.0 * lever_m * half_sin, rate_m: lever_m * half_cos }
            }
            Self::Shifted { duct_gap_m, tendon_length_m } => {
                let touches = touch_rotation_rad(column, duct_gap_m, tendon_length_m);
                let tilt = Tilt::new(rotation_rad);
                if touches.is_some_and(|touch_rad| rotation_rad >= touch_rad) {
                    touching(column, duct_gap_m, tendon_length_m, &tilt)
                } else {
                    free(column, tendon_length_m, &tilt)
                }
            }
        }
    }

    /// Rotation at which a shifted tendon touches its duct, rad; none for one that is held in the axis.
    pub fn touch_rotation_rad(self, column: &Geometry) -> Option<f64> {
        match self {
            Self::Column | Self::Foundation => None,
            Self::Shifted { duct_gap_m, tendon_length_m } => touch_rotation_rad(column, duct_gap_m, tendon_length_m),
        }
    }
}

/// Functions of the rotation that lose no digits near 0.
struct Tilt {
    sin: f64,
    cos: f64,
    /// `1 − cos θ`.
    versine: f64,
}

impl Tilt {
    fn new(rotation_rad: f64) -> Self {
        let (sin, cos) = rotation_rad.sin_cos();
        Self { sin, cos, versine: 2.0 * (0.5 * rotation_rad).sin().powi(2) }
    }
}

/// Eq. A2.6.
fn free(column: &Geometry, length_m: f64, tilt: &Tilt) -> Elongation {
    let (b, height_m) = (column.half_width_m(), column.height_m());
    let x = b * tilt.versine + height_m * tilt.sin;
    // y − ℓ
    let rise_m = b * tilt.sin - height_m * tilt.versine;
    let y = length_m + rise_m;
    let stretched_m = x.hypot(y);
    let (x_rate, y_rate) = (b * tilt.sin + height_m * tilt.cos, b * tilt.cos - height_m * tilt.sin);
    Elongation {
        elongation_m: (x * x + rise_m * (y + length_m)) / (stretched_m + length_m),
        rate_m: (x * x_rate + y * y_rate) / stretched_m,
    }
}

/// Eq. A2.7, corrected.
fn touching(column: &Geometry, gap_m: f64, length_m: f64, tilt: &Tilt) -> Elongation {
    let (b, height_m) = (column.half_width_m(), column.height_m());
    let above_m = length_m - height_m;
    let lever_m = b - gap_m;
    let x = b * tilt.versine + gap_m * tilt.cos;
    let rise_m = lever_m * tilt.sin;
    let y = rise_m + above_m;
    let upper_m = x.hypot(y);
    // √(4h² + c²) − 2h and √(x² + y²) − (ℓ − 2h) without the differences
    let lower_rise_m = gap_m * gap_m / (height_m.hypot(gap_m) + height_m);
    let upper_rise_m = if upper_m > 0.0 { (x * x + rise_m * (y + above_m)) / (upper_m + above_m) } else { 0.0 };
    let (x_rate, y_rate) = (lever_m * tilt.sin, lever_m * tilt.cos);
    // with neither gap nor length above the column the upper part begins at 0, as 2b sin(θ/2)
    let rate_m = if upper_m > 0.0 { (x * x_rate + y * y_rate) / upper_m } else { lever_m };
    Elongation { elongation_m: lower_rise_m + upper_rise_m, rate_m }
}

/// Rotation at which the free tendon is `c` off the axis at the column's top: with `t = tan(θ/2)` and `m = ℓ − 2h`,
/// `t² (4hb − 2hc + cm) + t (4hm − 2bc) − c (2h + m) = 0`.
fn touch_rotation_rad(column: &Geometry, gap_m: f64, length_m: f64) -> Option<f64> {
    let (b, height_m) = (column.half_width_m(), column.height_m());
    let above_m = length_m - height_m;
    let quadratic = 2.0 * height_m * b - height_m * gap_m + gap_m * above_m;
    let linear = 2.0 * (height_m * above_m - b * gap_m);
    let constant = gap_m * length_m;
    let root = (linear * linear + 4.0 * quadratic * constant).sqrt();
    // the positive root, by the form that adds
    let tangent = if linear >= 0.0 {
        if constant == 0.0 { 0.0 } else { 2.0 * constant / (linear + root) }
    } else {
        (root - linear) / (2.0 * quadratic)
    };
    tangent.is_finite().then(|| 2.0 * tangent.atan())
}
