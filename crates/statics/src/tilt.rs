//! Where the deck is when its columns are tilted.
//!
//! `u(θ) = 4R sin(θ/2) cos(α − θ/2)`, `v(θ) = 4R sin(θ/2) sin(α − θ/2)`: the half-angle forms of
//! `2R [sin α + sin(θ − α)]` and `2R [cos(α − θ) − cos α]`, which keep their digits near `θ = 0`.

use std::f64::consts::FRAC_PI_2;

use uplift_structure::Geometry;

use crate::error::StaticsError;

/// Horizontal travel `u` of the deck at a rotation `θ` (rad), m.
pub fn travel_m(column: &Geometry, rotation_rad: f64) -> f64 {
    let half = 0.5 * rotation_rad;
    4.0 * column.size_m() * half.sin() * (column.slenderness_rad() - half).cos()
}

/// Rise `v` of the deck at a rotation `θ` (rad), m.
pub fn rise_m(column: &Geometry, rotation_rad: f64) -> f64 {
    let half = 0.5 * rotation_rad;
    4.0 * column.size_m() * half.sin() * (column.slenderness_rad() - half).sin()
}

/// The rotation `α + π/2` at which the diagonal of the column lies level: the travel is largest there, rad.
pub fn largest_rotation_rad(column: &Geometry) -> f64 {
    column.slenderness_rad() + FRAC_PI_2
}

/// The rotation at which the deck has travelled by `u` (m): `θ = α + asin(u/(2R) − sin α)`, rad.
///
/// # Errors
/// The travel must lie between 0 and the largest that the column has.
pub fn rotation_rad(column: &Geometry, travel: f64) -> Result<f64, StaticsError> {
    let (alpha, diagonal_m) = (column.slenderness_rad(), 2.0 * column.size_m());
    let largest_m = travel_m(column, largest_rotation_rad(column));
    if !(travel >= 0.0 && travel <= largest_m) {
        return Err(StaticsError::Displacement { displacement_m: travel, largest_m });
    }
    let mut rotation = (alpha + (travel / diagonal_m - alpha.sin()).clamp(-1.0, 1.0).asin()).max(0.0);
    // the difference above has lost digits where the travel is small: one step of Newton's method brings them back
    for _ in 0..2 {
        let slope_m = diagonal_m * (alpha - rotation).cos();
        if slope_m > 1e-6 * diagonal_m {
            rotation -= (travel_m(column, rotation) - travel) / slope_m;
        }
    }
    Ok(rotation.max(0.0))
}
