//! Sets of their own at each level: which records are run there, by which factors, and how much they count.

use crate::ConsistencyError;

/// Sets of their own at each stripe, as record selection by conditional spectra makes them.
///
/// A record that does not belong to a level has a share of 0 there.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelSets {
    records: usize,
    /// `[level, record]`.
    relative_factors: Vec<f64>,
    /// `[level, record]`; none where every record belongs to every level and counts alike.
    shares: Option<Vec<f64>>,
}

impl LevelSets {
    /// From what `records` are multiplied by, and how much they count.
    ///
    /// - `relative_factors`: scale factors over the ones that bring the records to the level by the intensities of the
    ///   set, `[level, record]`: 1 where a factor does just that, and whatever where a record has no share.
    /// - `shares`: `[level, record]`; at each level they add up to 1. None where every record belongs to every level
    ///   and counts alike.
    ///
    /// # Errors
    /// Factors that are no whole number of levels, shares of another number than factors; a factor of a record with a
    /// share that is not finite and above 0.
    pub fn new(records: usize, relative_factors: Vec<f64>, shares: Option<Vec<f64>>) -> Result<Self, ConsistencyError> {
        let count = |what, found, expected| Err(ConsistencyError::Count { what, found, expected });
        let found = relative_factors.len();
        if records == 0 || found == 0 || !found.is_multiple_of(records) {
            return count("factors", found, records * (found / records.max(1)).max(1));
        }
        if let Some(shares) = shares.as_ref().filter(|shares| shares.len() != found) {
            return count("shares of levels", shares.len(), found);
        }
        let sets = Self { records, relative_factors, shares };
        for (cell, &value) in sets.relative_factors.iter().enumerate() {
            let (level, record) = (cell / records, cell % records);
            if sets.belongs(level, record) && !(value.is_finite() && value > 0.0) {
                return Err(ConsistencyError::Intensity { record, what: "factor over that of its level", value });
            }
        }
        Ok(sets)
    }

    /// Number of levels.
    pub fn level_count(&self) -> usize {
        self.relative_factors.len() / self.records
    }

    /// Number of records of all levels together.
    pub fn record_count(&self) -> usize {
        self.records
    }

    /// How much each record counts, `[level, record]`; none where all count alike.
    pub fn shares(&self) -> Option<&[f64]> {
        self.shares.as_deref()
    }

    /// Whether a record is of a level.
    pub(crate) fn belongs(&self, level: usize, record: usize) -> bool {
        self.shares.as_ref().is_none_or(|shares| shares[level * self.records + record] > 0.0)
    }

    /// The factor of a record at a level over level/intensity; 1 where it is not of the level.
    pub(crate) fn relative_factor(&self, level: usize, record: usize) -> f64 {
        if self.belongs(level, record) { self.relative_factors[level * self.records + record] } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_asked_of_the_records_of_a_level_alone() {
        let shares = Some(vec![1.0, 0.0, 0.5, 0.5]);
        let sets = LevelSets::new(2, vec![1.1, f64::NAN, 1.0, 2.0], shares.clone()).unwrap();
        assert_eq!((sets.level_count(), sets.record_count()), (2, 2));
        assert!(sets.belongs(0, 0) && !sets.belongs(0, 1) && sets.belongs(1, 1));
        assert_eq!(
            [sets.relative_factor(0, 0), sets.relative_factor(0, 1), sets.relative_factor(1, 1)],
            [1.1, 1.0, 2.0]
        );
        for (factors, shares) in [
            (vec![1.0, 1.0, f64::NAN, 1.0], shares.clone()),
            (vec![1.0, 1.0, 0.0, 1.0], None),
            (vec![1.0; 3], None),
            (vec![1.0; 2], shares),
            (Vec::new(), None),
        ] {
            assert!(LevelSets::new(2, factors, shares).is_err());
        }
        assert!(LevelSets::new(0, vec![1.0], None).is_err());
    }
}
