//! Disc springs: conical shells loaded along their axis (Almen and Laszlo 1936; DIN 2093).
//!
//! With `d = De/Di`, thickness `t` and cone height `h0` a disc deflected by `s` carries
//!
//! `F(s) = 4E/(1 − ν²) · t⁴/(K1 De²) · (s/t) [(h0/t − s/t)(h0/t − s/(2t)) + 1]`,
//! `K1 = (1/π) ((d − 1)/d)²/((d + 1)/(d − 1) − 2/ln d)`.
//!
//! Discs thicker than 6 mm have contact flats. They are ground to a reduced thickness `t'` so that the force at
//! 0.75 `h0` stays, with `t'` for `t`, `h0' = l0 − t'` for `h0`, a factor `K4²` before the whole and before the product
//! of the two brackets, and
//!
//! `K4 = √(−C1/2 + √(C1²/4 + C2))`, `C1 = (t'/t)²/[(l0/(4t) − t'/t + 3/4)(5 l0/(8t) − t'/t + 3/8)]`,
//! `C2 = C1 (t/t')³ [(5/32)(l0/t − 1)² + 1]`.
//!
//! The tangent stiffness is positive throughout for `h0/t < √2`, with flats for `K4 h0'/t' < √2`. Above that a disc
//! snaps through, and only its deflection, never its force, says where it is.
//!
//! # Source
//! J. O. Almen, A. Laszlo, The uniform-section disk spring, Transactions of the ASME 58 (1936); DIN 2093 and
//! EN 16983 for the flats.

use std::f64::consts::{PI, SQRT_2};

use crate::cubic::Cubic;
use crate::error::{StaticsError, positive, require};

/// Young's modulus of spring steel that DIN 2093 reckons with, Pa.
pub const SPRING_STEEL_YOUNG_MODULUS_PA: f64 = 206e9;
/// Poisson's ratio of steel.
pub const STEEL_POISSON: f64 = 0.3;

/// Dimensions of a disc, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscDimensions {
    /// Outer diameter `De`, m.
    pub outer_diameter_m: f64,
    /// Inner diameter `Di`, m.
    pub inner_diameter_m: f64,
    /// Thickness `t`, m.
    pub thickness_m: f64,
    /// Height of the cone `h0 = l0 − t`: the deflection until flat, m.
    pub cone_height_m: f64,
    /// Thickness `t'` of a disc with contact flats, m; none without.
    pub reduced_thickness_m: Option<f64>,
}

/// A disc spring.
///
/// ```
/// use uplift_statics::{DiscDimensions, DiscSpring};
/// // 125/61/6 of Section 6.3.3: flat at 3.6 mm and 64 kN
/// let disc = DiscSpring::new(DiscDimensions {
///     outer_diameter_m: 0.125,
///     inner_diameter_m: 0.061,
///     thickness_m: 0.006,
///     cone_height_m: 0.0036,
///     reduced_thickness_m: None,
/// })?;
/// assert!((disc.flat_force_n() / 64e3 - 1.0).abs() < 1e-3);
/// # Ok::<(), uplift_statics::StaticsError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscSpring {
    dimensions: DiscDimensions,
    flats_factor: f64,
    law: Cubic,
}

impl DiscSpring {
    /// A disc of spring steel.
    ///
    /// # Errors
    /// As for [`of_material`](Self::from_material).
    pub fn new(dimensions: DiscDimensions) -> Result<Self, StaticsError> {
        Self::from_material(dimensions, SPRING_STEEL_YOUNG_MODULUS_PA, STEEL_POISSON)
    }

    /// A disc of a material with Young's modulus (Pa) and Poisson's ratio.
    ///
    /// # Errors
    /// Lengths and modulus must be finite and positive, the inner diameter below the outer one, Poisson's ratio in
    /// \[0, 0.5\], a reduced thickness between half the thickness and the thickness.
    pub fn from_material(
        dimensions: DiscDimensions,
        young_modulus_pa: f64,
        poisson: f64,
    ) -> Result<Self, StaticsError> {
        let DiscDimensions { outer_diameter_m, inner_diameter_m, thickness_m: t, cone_height_m, .. } = dimensions;
        positive("outer_diameter_m", outer_diameter_m, "m")?;
        positive("inner_diameter_m", inner_diameter_m, "m")?;
        positive("thickness_m", t, "m")?;
        positive("cone_height_m", cone_height_m, "m")?;
        positive("young_modulus_pa", young_modulus_pa, "Pa")?;
        require((0.0..=0.5).contains(&poisson), "poisson", poisson, "", "from 0 to 0.5")?;
        if inner_diameter_m >= outer_diameter_m {
            return Err(StaticsError::Hole { inner_diameter_m, outer_diameter_m });
        }
        let (thickness_m, cone_m, k4) = match dimensions.reduced_thickness_m {
            None => (t, cone_height_m, 1.0),
            Some(reduced_thickness_m) => {
                positive("reduced_thickness_m", reduced_thickness_m, "m")?;
                if !(reduced_thickness_m < t && reduced_thickness_m > 0.5 * t) {
                    return Err(StaticsError::ReducedThickness { reduced_thickness_m, thickness_m: t });
                }
                let free_m = cone_height_m + t;
                (reduced_thickness_m, free_m - reduced_thickness_m, flats_factor(reduced_thickness_m / t, free_m / t))
            }
        };
        let ratio = outer_diameter_m / inner_diameter_m;
        let scale_n = 4.0 * young_modulus_pa / (1.0 - poisson * poisson) * thickness_m.powi(4)
            / (shape_factor(ratio) * outer_diameter_m * outer_diameter_m);
        let (slope, bracket) = (cone_m / thickness_m, k4 * k4);
        let outside_n = scale_n * bracket;
        let law = Cubic::new([
            outside_n * (bracket * slope * slope + 1.0) / thickness_m,
            -1.5 * outside_n * bracket * slope / thickness_m.powi(2),
            0.5 * outside_n * bracket / thickness_m.powi(3),
        ]);
        Ok(Self { dimensions, flats_factor: k4, law })
    }

    /// The same disc of a material so many times as stiff.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { law: Cubic::new(self.law.coefficients().map(|c| factor * c)), ..*self }
    }

    /// The dimensions.
    pub fn dimensions(&self) -> DiscDimensions {
        self.dimensions
    }

    /// `K4`; 1 without contact flats.
    pub fn flats_factor(&self) -> f64 {
        self.flats_factor
    }

    /// Force over deflection; meant for deflections from 0 to [`flat_deflection_m`](Self::flat_deflection_m).
    pub fn law(&self) -> Cubic {
        self.law
    }

    /// Force at a deflection `s` (m), N.
    pub fn force_n(&self, deflection_m: f64) -> f64 {
        self.law.force_n(deflection_m)
    }

    /// Deflection at which the disc is flat, `h0`, m.
    pub fn flat_deflection_m(&self) -> f64 {
        self.dimensions.cone_height_m
    }

    /// Force at which the disc is flat, N.
    pub fn flat_force_n(&self) -> f64 {
        self.force_n(self.flat_deflection_m())
    }

    /// `h0/t`, with contact flats `K4 h0'/t'`: from √2 on the force falls over part of the deflection.
    pub fn snap_ratio(&self) -> f64 {
        let DiscDimensions { thickness_m, cone_height_m, reduced_thickness_m, .. } = self.dimensions;
        match reduced_thickness_m {
            None => cone_height_m / thickness_m,
            Some(reduced_m) => self.flats_factor * (cone_height_m + thickness_m - reduced_m) / reduced_m,
        }
    }

    /// True where the force falls, or rests, somewhere between 0 and flat.
    pub fn snaps_through(&self) -> bool {
        self.snap_ratio() >= SQRT_2
    }
}

/// `K1` for `d = De/Di`.
fn shape_factor(ratio: f64) -> f64 {
    let share = (ratio - 1.0) / ratio;
    share * share / (PI * ((ratio + 1.0) / (ratio - 1.0) - 2.0 / ratio.ln()))
}

/// `K4` for `t'/t` and `l0/t`.
fn flats_factor(reduced: f64, free: f64) -> f64 {
    let c1 = reduced * reduced / ((0.25 * free - reduced + 0.75) * (0.625 * free - reduced + 0.375));
    let c2 = c1 / reduced.powi(3) * (5.0 / 32.0 * (free - 1.0).powi(2) + 1.0);
    // √(c1²/4 + c2) − c1/2 without the difference
    (c2 / (0.5 * c1 + (0.25 * c1 * c1 + c2).sqrt())).sqrt()
}
