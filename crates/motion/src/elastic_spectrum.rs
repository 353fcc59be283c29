//! The elastic response spectrum of Eurocode 8, for figures that show motions beside what a code asks.

use serde::{Deserialize, Serialize};

/// The longest period of the spectrum \[s\].
const LONGEST_S: f64 = 4.0;
/// Spectral acceleration over that of the ground on the plateau, at 5 % damping.
const AMPLIFICATION: f64 = 2.5;

/// Ground type (EN 1998-1, Table 3.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum GroundType {
    /// Rock.
    A,
    /// Very dense sand or gravel, very stiff clay.
    B,
    /// Deep deposits of dense sand, gravel or stiff clay.
    C,
    /// Loose to medium cohesionless soil, soft to firm cohesive soil.
    D,
    /// A surface layer of C or D on stiffer material.
    E,
}

impl GroundType {
    /// Every type.
    pub const ALL: [Self; 5] = [Self::A, Self::B, Self::C, Self::D, Self::E];

    /// Its letter.
    pub fn key(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
            Self::D => "D",
            Self::E => "E",
        }
    }
}

/// Shape of the spectrum (EN 1998-1, 3.2.2.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SpectrumShape {
    /// Type 1: earthquakes of a surface-wave magnitude above 5.5 contribute most.
    Type1,
    /// Type 2: they do not.
    Type2,
}

impl SpectrumShape {
    /// Both shapes.
    pub const ALL: [Self; 2] = [Self::Type1, Self::Type2];

    /// Its word.
    pub fn key(self) -> &'static str {
        match self {
            Self::Type1 => "type1",
            Self::Type2 => "type2",
        }
    }
}

/// The horizontal elastic response spectrum `S_e(T)` of EN 1998-1 (2004), Eq. 3.2 to 3.5, at 5 % damping (η = 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticSpectrum {
    /// Ground acceleration on type A, `a_g = γ_I a_gR` \[m/s²\].
    pub ground_acceleration_m_s2: f64,
    /// Ground type.
    pub ground: GroundType,
    /// Shape.
    pub shape: SpectrumShape,
}

impl ElasticSpectrum {
    /// `S_e` \[m/s²\] at a period \[s\]; none for periods that the code leaves out: negative, or above 4 s.
    ///
    /// # Source
    ///
    /// EN 1998-1:2004, Eq. 3.2 to 3.5 with the parameters of Tables 3.2 and 3.3.
    pub fn acceleration_m_s2(&self, period_s: f64) -> Option<f64> {
        if !(0.0..=LONGEST_S).contains(&period_s) {
            return None;
        }
        let (soil_factor, [b_s, c_s, d_s]) = self.parameters();
        let of_plateau = if period_s < b_s {
            1.0 / AMPLIFICATION + period_s / b_s * (1.0 - 1.0 / AMPLIFICATION)
        } else if period_s <= c_s {
            1.0
        } else if period_s <= d_s {
            c_s / period_s
        } else {
            c_s * d_s / (period_s * period_s)
        };
        Some(self.ground_acceleration_m_s2 * soil_factor * AMPLIFICATION * of_plateau)
    }

    /// Soil factor S, and the corner periods `T_B`, `T_C` and `T_D` \[s\].
    fn parameters(&self) -> (f64, [f64; 3]) {
        match (self.shape, self.ground) {
            (SpectrumShape::Type1, GroundType::A) => (1.0, [0.15, 0.4, 2.0]),
            (SpectrumShape::Type1, GroundType::B) => (1.2, [0.15, 0.5, 2.0]),
            (SpectrumShape::Type1, GroundType::C) => (1.15, [0.2, 0.6, 2.0]),
            (SpectrumShape::Type1, GroundType::D) => (1.35, [0.2, 0.8, 2.0]),
            (SpectrumShape::Type1, GroundType::E) => (1.4, [0.15, 0.5, 2.0]),
            (SpectrumShape::Type2, GroundType::A) => (1.0, [0.05, 0.25, 1.2]),
            (SpectrumShape::Type2, GroundType::B) => (1.35, [0.05, 0.25, 1.2]),
            (SpectrumShape::Type2, GroundType::C) => (1.5, [0.1, 0.25, 1.2]),
            (SpectrumShape::Type2, GroundType::D) => (1.8, [0.1, 0.3, 1.2]),
            (SpectrumShape::Type2, GroundType::E) => (1.6, [0.05, 0.25, 1.2]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUNDS: [GroundType; 5] = [GroundType::A, GroundType::B, GroundType::C, GroundType::D, GroundType::E];

    fn spectrum(shape: SpectrumShape, ground: GroundType) -> ElasticSpectrum {
        ElasticSpectrum { ground_acceleration_m_s2: 2.0, ground, shape }
    }

    /// Ground type C, type 1, `a_g` = 2 m/s², each branch of the formulae by hand.
    #[test]
    fn values_by_hand() {
        let of = spectrum(SpectrumShape::Type1, GroundType::C);
        for (period_s, expected) in
            [(0.0, 2.3), (0.1, 2.3 * 1.75), (0.2, 5.75), (0.6, 5.75), (1.2, 2.875), (2.0, 1.725), (4.0, 0.43125)]
        {
            let found = of.acceleration_m_s2(period_s).unwrap();
            assert!((found - expected).abs() < 1e-12, "{period_s} s: {found} {expected}");
        }
        assert_eq!((of.acceleration_m_s2(4.001), of.acceleration_m_s2(-0.1)), (None, None));
        let other = spectrum(SpectrumShape::Type2, GroundType::D);
        assert!((other.acceleration_m_s2(0.2).unwrap() - 9.0).abs() < 1e-12);
        assert!((other.acceleration_m_s2(2.4).unwrap() - 9.0 * 0.3 * 1.2 / 5.76).abs() < 1e-12);
    }

    /// Soil factors and corner periods of EN 1998-1, Tables 3.2 and 3.3, seen where each of them alone decides.
    #[test]
    fn parameters_are_those_of_the_tables() {
        let type_1 = [(1.0, 0.15, 0.4), (1.2, 0.15, 0.5), (1.15, 0.2, 0.6), (1.35, 0.2, 0.8), (1.4, 0.15, 0.5)];
        let type_2 = [(1.0, 0.05, 0.25), (1.35, 0.05, 0.25), (1.5, 0.1, 0.25), (1.8, 0.1, 0.3), (1.6, 0.05, 0.25)];
        for (shape, d_s, rows) in [(SpectrumShape::Type1, 2.0, type_1), (SpectrumShape::Type2, 1.2, type_2)] {
            for (ground, (soil_factor, b_s, c_s)) in GROUNDS.into_iter().zip(rows) {
                let of = |period_s: f64| spectrum(shape, ground).acceleration_m_s2(period_s).unwrap();
                let plateau = 2.0 * soil_factor * 2.5;
                for (period_s, expected) in [
                    (0.0, 2.0 * soil_factor),
                    (0.5 * b_s, 2.0 * soil_factor * 1.75),
                    (b_s, plateau),
                    (c_s, plateau),
                    (d_s, plateau * c_s / d_s),
                    (4.0, plateau * c_s * d_s / 16.0),
                ] {
                    assert!((of(period_s) / expected - 1.0).abs() < 1e-12, "{shape:?} {ground:?} {period_s} s");
                }
            }
        }
    }

    /// No branch begins where the one before did not end.
    #[test]
    fn every_spectrum_is_continuous() {
        for shape in [SpectrumShape::Type1, SpectrumShape::Type2] {
            for ground in GROUNDS {
                let of = spectrum(shape, ground);
                for corner_s in of.parameters().1 {
                    let [before, after] =
                        [corner_s - 1e-12, corner_s + 1e-12].map(|at_s| of.acceleration_m_s2(at_s).unwrap());
                    assert!((before / after - 1.0).abs() < 1e-9, "{shape:?} {ground:?} {corner_s} s");
                }
            }
        }
    }
}
