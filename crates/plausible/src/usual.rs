//! What the same numbers usually are: outside of these narrower ranges a number is used, and a warning says what it was
//! probably meant to be.

use crate::range::Range;

const fn usual(least: f64, most: f64, unit: &'static str, hint: &'static str) -> Range {
    Range { least, most, unit, hint }
}

/// Acceleration of gravity on the ground, with what rounding makes of it: 9.76 to 9.83 are measured.
pub const USUAL_GRAVITY: Range =
    usual(9.7, 9.9, "m/s2", "9.81 on Earth; 981 would be cm/s2, and 1 a multiple of itself");

/// Uplift strength: the slenderness of what rocks, 0.05 to 0.5, and some units where tendons hold it down.
pub const USUAL_STRENGTH: Range =
    usual(0.0, 2.0, "", "uplift force over weight, tan of the slenderness; was it meant in m/s2 or in per cent?");

/// Displacement at uplift: from a squat block on rock to a flexible pier of 50 m.
pub const USUAL_UPLIFT_DISPLACEMENT: Range =
    usual(1e-5, 0.05, "m", "the dissertation has 0.0005 m; was it meant in mm or cm?");

/// Displacement that a structure is not to exceed: as its capacity, or some times what it has at uplift.
pub const USUAL_THRESHOLD: Range =
    usual(1e-4, 20.0, "m", "of the order of the width of a base; was it meant in mm or cm?");

/// How often a year a structure may fail: from a nuclear plant to what is put right after every earthquake.
pub const USUAL_TARGET: Range = usual(
    1e-8,
    0.2,
    "1/yr",
    "a mean annual frequency, 2e-4 for once in 5000 years; was a return period or a percentage meant?",
);

/// Velocity after an impact over the one before: Housner's for slenderness below 0.6, and measured ones.
pub const USUAL_RESTITUTION: Range =
    usual(0.5, 1.0, "", "0.8 to 0.98 are measured; a share of the energy lost is another number");

/// Displacement capacity: the width of a base.
pub const USUAL_CAPACITY: Range =
    usual(0.01, 20.0, "m", "of the order of the width of a base; was it meant in mm or cm?");

/// Standard deviation of a quantity over its mean: what is hardly known at all has 1.
pub const USUAL_VARIATION: Range =
    usual(0.0, 1.0, "", "standard deviation over mean, 0.06 for 6 %; was it meant in per cent?");

/// Side of a block, column or frame: from a cabinet's foot to the tallest piers but a few.
pub const USUAL_LENGTH: Range = usual(0.02, 150.0, "m", "was it meant in mm or cm?");

/// Width of a base, the displacement capacity of what its weight alone holds: from a cabinet's foot to a wide pier.
pub const USUAL_WIDTH: Range = usual(0.02, 20.0, "m", "of the base; was it meant in mm or cm?");

/// Mass of what rocks: from a model on a shaking table to a long deck.
pub const USUAL_MASS: Range = usual(1.0, 1e9, "kg", "was it meant in t, or is it a weight in N?");

/// Moment of inertia about the pivot over m R²: 1 of a point mass, 4/3 of a uniform block, 2 of a slender one with half
/// its mass at either end, 4 of a tower with a heavy top on a heavy foundation.
pub const USUAL_INERTIA: Range =
    usual(1.0, 5.0, "", "4/3 of a uniform block, R to its centre; are mass_kg in kg and the inertia in kg m2?");

/// Period of a structure on its base: from a squat block on rock to a tall pier.
pub const USUAL_PERIOD: Range =
    usual(0.01, 4.0, "s", "piers have 0.2 to 2 s before they uplift; is it the period of rocking?");

/// Mass of a deck over that of its columns; one lighter than a twentieth was probably given in tonnes.
pub const USUAL_DECK: Range = usual(0.05, 1e4, "", "times the mass of the columns; is it in kg?");

/// Mass over width² times height: what a block or column as deep as it is wide would have for a density. Walls are
/// deeper and boxes hollow: a tenth of light timber, a hundred times concrete.
pub const USUAL_BULK: Range = usual(
    20.0,
    3e5,
    "kg/m3",
    "mass over width squared times height, 2400 for a square column of concrete; is it in kg and in m?",
);

/// Stiffness of a tendon with its spring.
pub const USUAL_TENDON_STIFFNESS: Range =
    usual(1e4, 1e9, "N/m", "EA over its length: a metre of 100 mm2 has 2e7; was it meant in kN/m or N/mm?");

/// Rotation at which a structure has lost its stability: above, sin θ and θ differ by more than 1.5 %, and Table 3.1 is
/// linear.
pub const USUAL_ROTATION: Range =
    usual(0.0, 0.3, "rad", "Table 3.1 is for small rotations, and a tendon that gives so much must stretch as far");

/// Safety factor on a displacement: Eq. 3.15 has 2.5.
pub const USUAL_SAFETY_FACTOR: Range = usual(1.0, 10.0, "", "Section 3.4.5 has 2.5; was a percentage meant?");

/// The highest level of PGV that records are scaled to: what is meant in m/s ends with 1 to 4.
pub const USUAL_TOP_PGV: Range =
    usual(5.0, 1000.0, "cm/s", "300 is the most that was recorded; was the level meant in m/s or mm/s?");

/// Level of PGV of a shaking table, of both components together: a third of it and less for small models, tables stop
/// at some m/s.
pub const USUAL_TABLE_PGV: Range =
    usual(0.005, 5.0, "m/s", "0.1675 and 0.335 in the dissertation; was it meant in cm/s or mm/s?");

/// Lengths of a prototype over those of its model on a shaking table.
pub const USUAL_LENGTH_SCALE: Range =
    usual(1.0, 100.0, "", "5 where the model is a fifth of the prototype; was the fraction meant?");

/// The largest of the percentiles of a spectrum.
pub const USUAL_PERCENTILE: Range = usual(2.0, 100.0, "%", "50 is the median; was a fraction, 0 to 1, meant?");

/// Ground acceleration of a code's design spectrum.
pub const USUAL_DESIGN_ACCELERATION: Range = usual(0.01, 1.2, "g", "0.16 in Athens; was it meant in m/s2?");

/// The highest level of PGA that records are scaled to.
pub const USUAL_TOP_PGA: Range =
    usual(0.05, 10.0, "g", "4 is the most that was recorded; was the level meant in m/s2 or cm/s2?");

/// The largest acceleration of a record that shakes one system, scaled.
pub const USUAL_RECORD_PGA: Range =
    usual(1e-4, 10.0, "g", "4 is the most that was recorded; is the unit of the record right, and its scale?");

/// The largest velocity of a record that shakes one system, scaled.
pub const USUAL_RECORD_PGV: Range =
    usual(1e-3, 1000.0, "cm/s", "300 is the most that was recorded; are time step and unit of the record right?");

/// Years that a probability refers to.
pub const USUAL_YEARS: Range = usual(1.0, 10_000.0, "yr", "50 years are usual");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        CAPACITY, GRAVITY, LENGTH, MASS, PERIOD, PGA_LEVEL, PGV_LEVEL, SAFETY_FACTOR, STRENGTH, TENDON_STIFFNESS,
        THRESHOLD, UPLIFT_DISPLACEMENT, VARIATION, YEARS,
    };

    #[test]
    fn what_is_usual_is_plausible() {
        for (usual, plausible) in [
            (USUAL_GRAVITY, GRAVITY),
            (USUAL_STRENGTH, STRENGTH),
            (USUAL_UPLIFT_DISPLACEMENT, UPLIFT_DISPLACEMENT),
            (USUAL_CAPACITY, CAPACITY),
            (USUAL_THRESHOLD, THRESHOLD),
            (USUAL_LENGTH, LENGTH),
            (USUAL_WIDTH, LENGTH),
            (USUAL_MASS, MASS),
            (USUAL_PERIOD, PERIOD),
            (USUAL_TENDON_STIFFNESS, TENDON_STIFFNESS),
            (USUAL_SAFETY_FACTOR, SAFETY_FACTOR),
            (USUAL_TOP_PGV, PGV_LEVEL),
            (USUAL_TOP_PGA, PGA_LEVEL),
            (USUAL_VARIATION, VARIATION),
            (USUAL_YEARS, YEARS),
            (USUAL_RECORD_PGA, PGA_LEVEL),
            (USUAL_RECORD_PGV, PGV_LEVEL),
        ] {
            assert!(plausible.contains(usual.least) && plausible.contains(usual.most), "{usual}");
            assert_eq!(usual.unit, plausible.unit);
        }
    }

    #[test]
    fn likely_mistakes_of_unit_are_unusual_though_possible() {
        for (usual, plausible, value) in [
            (USUAL_GRAVITY, GRAVITY, 981.0),
            (USUAL_GRAVITY, GRAVITY, 1.0),
            (USUAL_STRENGTH, STRENGTH, 40.0),
            (USUAL_UPLIFT_DISPLACEMENT, UPLIFT_DISPLACEMENT, 5.0),
            (USUAL_LENGTH, LENGTH, 220.0),
            (USUAL_SAFETY_FACTOR, SAFETY_FACTOR, 40.0),
        ] {
            assert!(plausible.contains(value) && !usual.contains(value), "{value} {usual}");
        }
        let unlikely = USUAL_UPLIFT_DISPLACEMENT.unlikely("uplift_displacement_m", 5.0);
        let words = "uplift_displacement_m is 5 m; usual is from 1e-5 to 0.05 m (the dissertation has 0.0005 m; was it \
                     meant in mm or cm?)";
        assert_eq!(unlikely.map(|found| found.to_string()).as_deref(), Some(words));
        assert_eq!(USUAL_UPLIFT_DISPLACEMENT.unlikely("uplift_displacement_m", 0.001), None);
    }
}
