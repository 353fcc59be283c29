//! The table.

use crate::range::Range;

const fn range(least: f64, most: f64, unit: &'static str, hint: &'static str) -> Range {
    Range { least, most, unit, hint }
}

/// Acceleration of gravity. A comet has less and no centrifuge more.
pub const GRAVITY: Range =
    range(0.1, 2000.0, "m/s2", "9.81 on Earth, 1.62 on the Moon; in m/s2, not in cm/s2 or mm/s2");

/// Uplift strength η, force over weight: that of a slender block is its tan α, a strap-down column has some units.
pub const STRENGTH: Range = range(0.0, 100.0, "", "uplift force over weight, mostly below 1; not a force");

/// Displacement at uplift. Below a micrometre is no structure, but a stiffness that no motion resolves.
pub const UPLIFT_DISPLACEMENT: Range = range(1e-6, 10.0, "m", "the dissertation has 0.0005 m; in m, not in mm");

/// Period of a structure before it uplifts.
pub const PERIOD: Range = range(0.01, 10.0, "s", "of the structure with closed joints: piers have 0.2 to 2 s");

/// Velocity after an impact divided by the one before.
pub const RESTITUTION: Range = range(0.0, 1.0, "", "velocity after an impact over the one before; 95 % is 0.95");

/// Standard deviation over mean.
pub const VARIATION: Range = range(0.0, 10.0, "", "standard deviation over mean: 0.1 is 10 %");

/// Displacement at which the force has fallen to zero: the width of a base.
pub const CAPACITY: Range = range(1e-6, 1e6, "m", "of the order of the width of a column; in m, not in mm");

/// Stiffness after uplift over the mass: a period from 6 hours down to 60 µs.
pub const POST_UPLIFT_STIFFNESS: Range =
    range(1e-7, 1e10, "1/s2", "the square of an angular frequency: a stiffness in N/m divided by the mass in kg");

/// Side of a block, a column or a frame: from a grain of sand to what stands for an endless one.
pub const LENGTH: Range = range(1e-3, 1e6, "m", "in m, not in mm");

/// Size parameter R, half the diagonal: an endless one may stand for a system that never overturns.
pub const SIZE: Range = range(1e-3, 1e9, "m", "half the diagonal, in m, not in mm");

/// Radius of curved ends; none is a flat base.
pub const CURVATURE_RADIUS: Range = range(0.0, 1e6, "m", "in m, not in mm");

/// Mass: from a model of paper to a thousand suspension bridges.
pub const MASS: Range = range(1e-6, 1e12, "kg", "in kg, not in t or N");

/// Moment of inertia: those masses times the square of such lengths.
pub const MOMENT_OF_INERTIA: Range = range(1e-12, 1e24, "kg m2", "about the pivot, in kg m2");

/// Stiffness of a tendon; none is a structure without.
pub const TENDON_STIFFNESS: Range = range(0.0, 1e13, "N/m", "in N/m, EA over its length: a metre of 100 mm2 has 2e7");

/// Diameter of a disc spring: from a watch to a crane.
pub const DISC_DIAMETER: Range =
    range(1e-3, 3.0, "m", "in m, not in mm: the standard's discs have from 0.008 to 0.25 m");

/// Thickness, reduced thickness, cone height or free height of a disc spring.
pub const DISC_HEIGHT: Range =
    range(1e-5, 0.3, "m", "in m, not in mm: the standard's discs are from 0.0002 to 0.014 m thick");

/// Young's modulus.
pub const YOUNG_MODULUS: Range = range(1e6, 1e13, "Pa", "in Pa, not in MPa or GPa: steel has 2.06e11");

/// Area of a tendon.
pub const TENDON_AREA: Range = range(1e-8, 10.0, "m2", "in m2, not in mm2: a strand of 150 mm2 has 150e-6");

/// Design strength of concrete under compression.
pub const CONCRETE_STRENGTH: Range = range(1e5, 1e9, "Pa", "in Pa, not in MPa: 20 MPa are 20e6");

/// Elongation of a restrainer.
pub const ELONGATION: Range = range(1e-6, 10.0, "m", "in m, not in mm");

/// Force of a tendon, or of the rods beside its springs.
pub const TENDON_FORCE: Range = range(0.0, 1e12, "N", "in N: a strand of 150 mm2 yields at some 2.4e5");

/// What a spring is pressed by, a nut is loose by or a duct is wider by.
pub const SPRING_GAP: Range = range(0.0, 5.0, "m", "in m, not in mm");

/// Number of columns of a frame.
pub const COLUMNS: Range = range(1.0, 1e6, "", "columns of one frame");

/// Safety factor on a displacement.
pub const SAFETY_FACTOR: Range = range(1.0, 1000.0, "", "a factor, not a percentage");

/// Peak ground velocity that records are scaled to. The strongest recorded is some 300 cm/s.
pub const PGV_LEVEL: Range = range(1e-5, 1e4, "cm/s", "in cm/s, not in m/s or mm/s; 300 is the most that was recorded");

/// Peak ground acceleration that records are scaled to. The strongest recorded is some 4 g.
pub const PGA_LEVEL: Range = range(1e-7, 1000.0, "g", "in g, not in cm/s2 or m/s2; 4 is the most that was recorded");

/// Spectral acceleration that records are scaled to.
pub const SA_LEVEL: Range = range(1e-7, 1000.0, "g", "in g, not in cm/s2 or m/s2");

/// Peak ground displacement, or spectrum intensity, that records are scaled to.
pub const DISPLACEMENT_LEVEL: Range = range(1e-5, 1e5, "cm", "in cm, not in m or mm");

/// Cumulative absolute velocity, or Arias intensity, that records are scaled to.
pub const CUMULATIVE_LEVEL: Range = range(1e-8, 1e6, "cm/s", "in cm/s, not in m/s or g s");

/// Displacement whose annual frequency of exceedance is asked for.
pub const THRESHOLD: Range = range(0.0, 1e4, "m", "in m, not in mm or cm");

/// Time that a probability refers to: from a shift on a building site to a repository.
pub const YEARS: Range = range(1e-3, 1e7, "yr", "50 years are usual");

/// Probability of exceedance: twelve nines are as near to certain as a double can tell, and rarer than the other end
/// nothing is known.
pub const PROBABILITY: Range = range(1e-12, 0.999_999_999_999, "", "10 % is 0.1");

/// Return period of a risk: from days to the age of rocks.
pub const RETURN_PERIOD: Range = range(1e-2, 1e9, "yr", "in years; 10 % in 50 years is 475");

/// Conversion of a measure from one definition of the horizontal component to another.
pub const CONVERSION: Range =
    range(0.1, 10.0, "", "definitions of the horizontal component differ by some tens of per cent");

/// Distance between a site and its point of a hazard grid: half around the Earth.
pub const DISTANCE: Range = range(1e-3, 20_040.0, "km", "in km");

/// Multiple of the median peak that records are scaled to.
pub const MULTIPLE: Range = range(1e-4, 1e4, "", "a multiple of the median peak, 0.5 or 2, not the peak itself");

/// Factor that multiplies a record.
pub const SCALE: Range =
    range(-1e6, 1e6, "", "a factor on the record, whose sign reverses it: a record that needs more is noise");

/// Time between the samples of a record: shock tables sample at 100 kHz, early digitizations at 50 Hz.
pub const TIME_STEP: Range = range(1e-6, 10.0, "s", "in s, 0.005 or 0.01 mostly; not in ms, nor a frequency");

/// Largest acceleration of a record: that of shock tables. The strongest recorded on the ground is some 4 g.
pub const PEAK_ACCELERATION: Range = range(
    0.0,
    1e4,
    "m/s2",
    "1e4 m/s2 are 1020 g, and 4 g the most that was recorded: is its unit right, cm/s2 perhaps?",
);

/// Largest acceleration of a wavelet.
pub const PULSE_AMPLITUDE: Range = range(1e-6, 1000.0, "g", "in g, not in cm/s2 or m/s2");

/// Period of a wavelet.
pub const PULSE_PERIOD: Range = range(1e-4, 1e4, "s", "in s, 0.2 to 10 of recorded pulses");

/// Ratios that the axes of wavelet spectra have, ωₚ/p and aₚ/(g tan α) above all.
pub const PULSE_RATIO: Range = range(1e-4, 1e4, "", "a ratio of the order of 1 to 10");

/// Time for which free vibration is followed after a record.
pub const FREE_VIBRATION: Range = range(0.0, 3600.0, "s", "in s; after an hour nothing moves but by rounding");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odd_but_legitimate_cases_are_within() {
        // Moon, a large centrifuge; a shaking table's model, a block of a kilometre; a shock table; old digitizations
        for (range, values) in [
            (GRAVITY, &[1.62, 981.0][..]),
            (STRENGTH, &[0.0, 0.005, 5.0]),
            (UPLIFT_DISPLACEMENT, &[1e-5, 0.05]),
            (PERIOD, &[0.02, 5.0]),
            (CAPACITY, &[0.01, 1000.0]),
            (LENGTH, &[0.02, 1000.0]),
            (MASS, &[0.01, 4e8]),
            (PGV_LEVEL, &[0.01, 1000.0]),
            (PGA_LEVEL, &[1e-5, 100.0]),
            (SA_LEVEL, &[1e-5, 100.0]),
            (DISPLACEMENT_LEVEL, &[0.01, 10_000.0]),
            (CUMULATIVE_LEVEL, &[1e-5, 100_000.0]),
            (YEARS, &[0.02, 1.0, 10_000.0]),
            (TIME_STEP, &[1e-5, 0.02, 1.0]),
            (PEAK_ACCELERATION, &[1e-6, 40.0, 981.0]),
            (SCALE, &[-1.0, 0.0, 1000.0]),
            (TENDON_STIFFNESS, &[0.0, 2e9]),
            (DISC_DIAMETER, &[0.003, 1.0]),
            (DISC_HEIGHT, &[5e-5, 0.05]),
            (YOUNG_MODULUS, &[1e8, 2.1e11]),
            (TENDON_AREA, &[1e-6, 0.5]),
            (CONCRETE_STRENGTH, &[1e6, 1.5e8]),
            (ELONGATION, &[1e-5, 2.0]),
        ] {
            for &value in values {
                assert!(range.contains(value), "{value} {range}");
            }
        }
    }

    #[test]
    fn mistakes_of_unit_are_not() {
        for (range, value) in [
            (GRAVITY, 9810.0),
            (UPLIFT_DISPLACEMENT, 500.0),
            (RESTITUTION, 95.0),
            (STRENGTH, 1e10),
            (PGV_LEVEL, 1e9),
            (PGA_LEVEL, 4000.0),
            (TIME_STEP, 1e3),
            (TIME_STEP, 1e-9),
            (PEAK_ACCELERATION, 1e6),
            (SCALE, 1e308),
            (DISC_DIAMETER, 125.0),
            (DISC_HEIGHT, 0.5),
            (YOUNG_MODULUS, 206e3),
            (TENDON_AREA, 150.0),
            (SPRING_GAP, 15.0),
            (CONCRETE_STRENGTH, 20.0),
            (ELONGATION, 50.0),
        ] {
            assert!(!range.contains(value), "{value} {range}");
        }
    }
}
