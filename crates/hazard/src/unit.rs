//! Units of intensity: what they are called and how they convert.

/// What a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dimension {
    Velocity,
    Acceleration,
    Displacement,
}

impl Dimension {
    /// Dimension of the measures known by name; others may carry any unit.
    pub(crate) fn from_measure(measure: &str) -> Option<Self> {
        let name = measure.trim().to_ascii_lowercase();
        match name.as_str() {
            "pgv" | "cav" | "ia" | "arias" => Some(Self::Velocity),
            "pga" | "sa" | "psa" | "avgsa" => Some(Self::Acceleration),
            "pgd" | "si" => Some(Self::Displacement),
            _ if ["sa(", "sa_", "avgsa(", "avgsa_"].iter().any(|start| name.starts_with(start)) => {
                Some(Self::Acceleration)
            }
            _ => None,
        }
    }

    /// Units to suggest in a message.
    pub(crate) fn examples(self) -> &'static str {
        match self {
            Self::Velocity => "cm/s or m/s",
            Self::Acceleration => "g, m/s2 or cm/s2",
            Self::Displacement => "cm or m",
        }
    }

    /// The unit of the field: cm/s for velocities, g for accelerations, cm for displacements.
    pub(crate) fn field_unit(self) -> CurveUnit {
        match self {
            Self::Velocity => CurveUnit::CmPerS,
            Self::Acceleration => CurveUnit::G,
            Self::Displacement => CurveUnit::Cm,
        }
    }
}

/// Units of the levels of a hazard curve that convert into each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CurveUnit {
    /// Centimetres per second.
    CmPerS,
    /// Metres per second.
    MPerS,
    /// The acceleration of gravity times a second, a velocity.
    GS,
    /// The acceleration of gravity.
    G,
    /// Metres per second squared.
    MPerS2,
    /// Centimetres per second squared.
    CmPerS2,
    /// Centimetres.
    Cm,
    /// Metres.
    M,
}

impl CurveUnit {
    /// Every unit.
    pub const ALL: [Self; 8] =
        [Self::CmPerS, Self::MPerS, Self::GS, Self::G, Self::MPerS2, Self::CmPerS2, Self::Cm, Self::M];

    /// Recognises a unit as people write it; column names cannot hold a slash, so `_` stands for it too.
    pub fn parse(text: &str) -> Option<Self> {
        let plain = text.trim().to_ascii_lowercase().replace('²', "2").replace('^', "");
        match plain.as_str() {
            "cm/s" | "cm_s" | "cm/sec" | "cm s-1" => Some(Self::CmPerS),
            "m/s" | "m_s" | "m/sec" | "m s-1" => Some(Self::MPerS),
            "g s" | "g_s" | "g-s" | "g sec" | "g-sec" => Some(Self::GS),
            "g" => Some(Self::G),
            "m/s2" | "m_s2" | "m/s/s" | "m s-2" => Some(Self::MPerS2),
            "cm/s2" | "cm_s2" | "cm/s/s" | "cm s-2" | "gal" => Some(Self::CmPerS2),
            "cm" => Some(Self::Cm),
            "m" => Some(Self::M),
            _ => None,
        }
    }

    /// Name in text, files and keys: cm/s, m/s, g s, g, m/s2, cm/s2, cm, m.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::CmPerS => "cm/s",
            Self::MPerS => "m/s",
            Self::GS => "g s",
            Self::G => "g",
            Self::MPerS2 => "m/s2",
            Self::CmPerS2 => "cm/s2",
            Self::Cm => "cm",
            Self::M => "m",
        }
    }

    /// How many times too large a number in this unit comes out where it is read as one in `read`: 9.81 for m/s2 read
    /// as g; none where the two measure different things.
    ///
    /// * `gravity_m_s2` — acceleration of gravity, m/s²
    pub fn times_too_large_as(self, read: Self, gravity_m_s2: f64) -> Option<f64> {
        (self.dimension() == read.dimension()).then(|| self.per_si(gravity_m_s2) / read.per_si(gravity_m_s2))
    }

    pub(crate) fn dimension(self) -> Dimension {
        match self {
            Self::CmPerS | Self::MPerS | Self::GS => Dimension::Velocity,
            Self::G | Self::MPerS2 | Self::CmPerS2 => Dimension::Acceleration,
            Self::Cm | Self::M => Dimension::Displacement,
        }
    }

    /// How many of this unit make one SI unit (m/s, m/s² or m): whole numbers where possible, so that
    /// conversions round once.
    pub(crate) fn per_si(self, gravity_m_s2: f64) -> f64 {
        match self {
            Self::MPerS | Self::MPerS2 | Self::M => 1.0,
            Self::CmPerS | Self::CmPerS2 | Self::Cm => 100.0,
            Self::G | Self::GS => 1.0 / gravity_m_s2,
        }
    }
}

/// Whether two texts name the same unit.
pub(crate) fn same_unit(a: &str, b: &str) -> bool {
    match (CurveUnit::parse(a), CurveUnit::parse(b)) {
        (Some(a), Some(b)) => a == b,
        (None, None) => a.trim() == b.trim(),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings() {
        for (text, unit) in [
            ("cm/s", CurveUnit::CmPerS),
            ("CM_S", CurveUnit::CmPerS),
            ("cm s^-1", CurveUnit::CmPerS),
            ("m/s", CurveUnit::MPerS),
            ("m/s2", CurveUnit::MPerS2),
            ("m/s^2", CurveUnit::MPerS2),
            ("m/s²", CurveUnit::MPerS2),
            ("m/s/s", CurveUnit::MPerS2),
            ("gal", CurveUnit::CmPerS2),
            ("cm_s2", CurveUnit::CmPerS2),
            (" g ", CurveUnit::G),
            ("g-sec", CurveUnit::GS),
            ("CM", CurveUnit::Cm),
        ] {
            assert_eq!(CurveUnit::parse(text), Some(unit), "{text}");
            assert_eq!(CurveUnit::parse(unit.symbol()), Some(unit));
        }
        assert!(CurveUnit::ALL.iter().all(|unit| CurveUnit::parse(unit.symbol()) == Some(*unit)));
        for text in ["", "mm/s", "ms", "kg", "%g", "s", "km"] {
            assert_eq!(CurveUnit::parse(text), None, "{text}");
        }
    }

    #[test]
    fn numbers_in_one_unit_read_as_another() {
        // a gravity that divides without rounding
        let times = |unit: CurveUnit, read| unit.times_too_large_as(read, 8.0);
        assert_eq!(times(CurveUnit::MPerS2, CurveUnit::G), Some(8.0));
        assert_eq!(times(CurveUnit::CmPerS2, CurveUnit::G), Some(800.0));
        assert_eq!(times(CurveUnit::MPerS, CurveUnit::CmPerS), Some(0.01));
        assert_eq!(times(CurveUnit::CmPerS, CurveUnit::MPerS), Some(100.0));
        assert_eq!(times(CurveUnit::Cm, CurveUnit::CmPerS), None);
    }

    #[test]
    fn unknown_units_compare_by_text() {
        assert!(same_unit("mm/s", " mm/s"));
        assert!(!same_unit("mm/s", "cm/s"));
        assert!(same_unit("gal", "cm/s2"));
    }
}
