//! What is drawn: single records, or earthquakes with all their records.

/// What a bootstrap draws.
///
/// Records of one earthquake are alike in what the earthquake was: drawn one by one they pass for independent, and the
/// band is too narrow. Drawn with their earthquakes, the band is that of another choice of earthquakes (a cluster
/// bootstrap; Davison and Hinkley, Bootstrap Methods and their Application, 1997, Section 3.8).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Unit {
    /// Records, one by one, as in Section 4.5.
    #[default]
    Record,
    /// Earthquakes, each with all its records.
    Event,
}

impl Unit {
    /// Every unit.
    pub const ALL: [Self; 2] = [Self::Record, Self::Event];

    /// Name in files and keys: record, event.
    pub fn key(self) -> &'static str {
        match self {
            Self::Record => "record",
            Self::Event => "event",
        }
    }
}

/// The records of every unit, `[unit]`, by their positions.
///
/// - `unit_of`: the unit that a record belongs to, `[record]`: any numbers, alike for the records of one unit.
///
/// Units come in the order of their first records.
pub fn units(unit_of: &[usize]) -> Vec<Vec<usize>> {
    let mut names: Vec<usize> = Vec::new();
    let mut units: Vec<Vec<usize>> = Vec::new();
    for (record, name) in unit_of.iter().enumerate() {
        let position = names.iter().position(|known| known == name).unwrap_or_else(|| {
            names.push(*name);
            units.push(Vec::new());
            names.len() - 1
        });
        units[position].push(record);
    }
    units
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_their_records() {
        assert_eq!(units(&[4, 1, 4, 4]), [vec![0, 2, 3], vec![1]]);
        assert!(units(&[]).is_empty());
    }
}
