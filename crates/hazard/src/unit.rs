//! Units of intensity: what they are called and how they convert.

/// What a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dimension {
    Velocity,
    Acceleration,
}

impl Dimension {
    /// Dimension of the measures known by name; others may carry any unit.
    pub(crate) fn of_measure(measure: &str) -> Option<Self> {
        let name = measure.trim().to_ascii_lowercase();
        match name.as_str() {
            "pgv" => Some(Self::Velocity),
            "pga" | "sa" | "psa" => Some(Self::Acceleration),
            _ if name.starts_with("sa(") => Some(Self::Acceleration),
            _ => None,
        }
    }

    /// Units to suggest in a message.
    pub(crate) fn examples(self) -> &'static str {
        match self {
            Self::Velocity => "cm/s or m/s",
            Self::Acceleration => "g, m/s2 or cm/s2",
        }
    }

    /// The unit of the field: cm/s for velocities, g for accelerations.
    pub(crate) fn field_unit(self) -> CurveUnit {
        match self {
            Self::Velocity => CurveUnit::CmPerS,
            Self::Acceleration => CurveUnit::G,
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
    /// The acceleration of gravity.
    G,
    /// Metres per second squared.
    MPerS2,
    /// Centimetres per second squared.
    CmPerS2,
}

impl CurveUnit {
    /// Every unit.
    pub const ALL: [Self; 5] = [Self::CmPerS, Self::MPerS, Self::G, Self::MPerS2, Self::CmPerS2];

    /// Recognises a unit as people write it; column names cannot hold a slash, so `_` stands for it too.
    pub fn parse(text: &str) -> Option<Self> {
        let plain = text.trim().to_ascii_lowercase().replace('²', "2").replace('^', "");
        match plain.as_str() {
            "cm/s" | "cm_s" | "cm/sec" | "cm s-1" => Some(Self::CmPerS),
            "m/s" | "m_s" | "m/sec" | "m s-1" => Some(Self::MPerS),
            "g" => Some(Self::G),
            "m/s2" | "m_s2" | "m/s/s" | "m s-2" => Some(Self::MPerS2),
            "cm/s2" | "cm_s2" | "cm/s/s" | "cm s-2" | "gal" => Some(Self::CmPerS2),
            _ => None,
        }
    }

    /// Name in text, files and keys: cm/s, m/s, g, m/s2, cm/s2.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::CmPerS => "cm/s",
            Self::MPerS => "m/s",
            Self::G => "g",
            Self::MPerS2 => "m/s2",
            Self::CmPerS2 => "cm/s2",
        }
    }

    pub(crate) fn dimension(self) -> Dimension {
        match self {
            Self::CmPerS | Self::MPerS => Dimension::Velocity,
            Self::G | Self::MPerS2 | Self::CmPerS2 => Dimension::Acceleration,
        }
    }

    /// How many of this unit make one SI unit (m/s or m/s²): whole numbers where possible, so that
    /// conversions round once.
    pub(crate) fn per_si(self, gravity_m_s2: f64) -> f64 {
        match self {
            Self::MPerS | Self::MPerS2 => 1.0,
            Self::CmPerS | Self::CmPerS2 => 100.0,
            Self::G => 1.0 / gravity_m_s2,
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
        ] {
            assert_eq!(CurveUnit::parse(text), Some(unit), "{text}");
            assert_eq!(CurveUnit::parse(unit.symbol()), Some(unit));
        }
        assert!(CurveUnit::ALL.iter().all(|unit| CurveUnit::parse(unit.symbol()) == Some(*unit)));
        for text in ["", "mm/s", "ms", "kg", "%g", "s", "m"] {
            assert_eq!(CurveUnit::parse(text), None, "{text}");
        }
    }

    #[test]
    fn unknown_units_compare_by_text() {
        assert!(same_unit("mm/s", " mm/s"));
        assert!(!same_unit("mm/s", "cm/s"));
        assert!(same_unit("gal", "cm/s2"));
    }
}
