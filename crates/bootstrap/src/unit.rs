//! What is drawn: single records, or pairs or earthquakes with all their records.

use std::collections::HashMap;

/// What a bootstrap draws.
///
/// Records of one earthquake are alike in what the earthquake was: drawn one by one they pass for independent, and the
/// band is too narrow. Drawn with their earthquakes, the band is that of another choice of earthquakes (a cluster
/// bootstrap; Davison and Hinkley, Bootstrap Methods and their Application, 1997, Section 3.8). The same holds of
/// records of one pair: its components, or the pair as it is seen from several azimuths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Unit {
    /// Records, one by one, as in Section 4.5.
    #[default]
    Record,
    /// Pairs of components, each with all its records.
    Pair,
    /// Earthquakes, each with all its records.
    Event,
}

impl Unit {
    /// Every unit.
    pub const ALL: [Self; 3] = [Self::Record, Self::Pair, Self::Event];

    /// Name in files and keys: record, pair, event.
    pub fn key(self) -> &'static str {
        match self {
            Self::Record => "record",
            Self::Pair => "pair",
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
    let mut position_of = HashMap::new();
    let mut units: Vec<Vec<usize>> = Vec::new();
    for (record, name) in unit_of.iter().enumerate() {
        let position = *position_of.entry(name).or_insert(units.len());
        if position == units.len() {
            units.push(Vec::new());
        }
        units[position].push(record);
    }
    units
}

/// The units of a sample of `size` records, where so many `units` have so many `records`: as many as have `size` of
/// them on average, one at least.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most the size, and not negative")]
pub fn units_in_sample(size: u32, units: usize, records: usize) -> u32 {
    ((f64::from(size) * units as f64 / records as f64).round() as u32).max(1)
}

/// A band by record is not quoted where it is narrower than this share of the band by earthquake.
const TOO_NARROW: f64 = 0.75;

/// Whether records that share earthquakes tell so much less than their number that their band must be by earthquake:
/// by record it is more than a quarter narrower.
///
/// - `by_record`, `by_earthquake`: widths of the two bands, in the same unit.
pub fn is_too_narrow(by_record: f64, by_earthquake: f64) -> bool {
    by_record < TOO_NARROW * by_earthquake
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_is_too_much() {
        assert_eq!(
            [(0.74, 1.0), (0.76, 1.0), (1.2, 1.0)].map(|(own, of)| is_too_narrow(own, of)),
            [true, false, false]
        );
        // up to overturning by earthquake alone
        assert!(is_too_narrow(1.0, f64::INFINITY) && !is_too_narrow(f64::INFINITY, f64::INFINITY));
        assert!(!is_too_narrow(1.0, f64::NAN));
    }

    #[test]
    fn units_have_their_records() {
        assert_eq!(units(&[4, 1, 4, 4]), [vec![0, 2, 3], vec![1]]);
        assert!(units(&[]).is_empty());
    }

    #[test]
    fn samples_have_so_many_units_on_average() {
        // 22 earthquakes of 105 records; both components of 20 pairs; never none
        assert_eq!([units_in_sample(20, 22, 105), units_in_sample(105, 22, 105)], [4, 22]);
        assert_eq!(units_in_sample(10, 20, 40), 5);
        assert_eq!(units_in_sample(1, 22, 105), 1);
    }
}
