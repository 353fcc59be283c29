//! The demands of one oscillator: records × levels.

use crate::FragilityError;

/// Peak displacements of ONE oscillator under every record scaled to every stripe level: a checked view, not a copy.
///
/// A demand is finite and zero or positive, or +∞ where the structure overturned; never NaN, but where
/// [shares](Stripes::with_shares) say that the record does not belong to the level.
#[derive(Debug, Clone, Copy)]
pub struct Stripes<'a> {
    levels: &'a [f64],
    edp_m: &'a [f64],
    record_count: usize,
    record_stride: usize,
    shares: Option<&'a [f64]>,
}

/// By how much the shares at a level may miss 1, for the rounding of whoever divided them by their sum.
const SUM_TOLERANCE: f64 = 1e-9;

impl<'a> Stripes<'a> {
    /// Views a whole array.
    ///
    /// - `levels`: stripe levels in the unit of the intensity measure (cm/s or g), strictly increasing, `[level]`.
    /// - `edp_m`: peak absolute displacements, m, `[record, level]` row-major.
    ///
    /// # Errors
    /// Empty or misshapen input, a bad level, a negative or NaN demand.
    pub fn new(levels: &'a [f64], edp_m: &'a [f64]) -> Result<Self, FragilityError> {
        let record_count = edp_m.len().checked_div(levels.len()).unwrap_or(0);
        if record_count * levels.len() != edp_m.len() {
            return Err(FragilityError::Shape {
                found: edp_m.len(),
                records: record_count,
                levels: levels.len(),
                stride: levels.len(),
            });
        }
        Self::strided(levels, edp_m, record_count, levels.len())
    }

    /// Views one oscillator inside a larger array, such as `[record, strength, level]`, without copying.
    ///
    /// - `levels`: as in [`Stripes::new`].
    /// - `edp_m`: the array from the first demand of this oscillator onwards, m.
    /// - `record_count`: number of records.
    /// - `record_stride`: distance in values from one record to the next (strengths × levels in the example).
    ///
    /// # Errors
    /// Empty or misshapen input, a bad level, a negative or NaN demand.
    pub fn strided(
        levels: &'a [f64],
        edp_m: &'a [f64],
        record_count: usize,
        record_stride: usize,
    ) -> Result<Self, FragilityError> {
        Self::with_shares(levels, edp_m, (record_count, record_stride), None)
    }

    /// The same where each level has records of its own, which need not count alike.
    ///
    /// - `record_count`, `record_stride`: as in [`Stripes::strided`].
    /// - `shares`: how much each record counts at each level, `[level, record]` row-major; at each level they add up to
    ///   one. A record with a share of 0 does not belong to the level: its demand there counts nowhere, and may be NaN.
    ///   None where every record belongs to every level and counts alike.
    ///
    /// # Errors
    /// As [`Stripes::strided`]; shares of another number, or of a level at which they do not add up to 1 or one of them
    /// is negative or NaN.
    pub fn with_shares(
        levels: &'a [f64],
        edp_m: &'a [f64],
        (record_count, record_stride): (usize, usize),
        shares: Option<&'a [f64]>,
    ) -> Result<Self, FragilityError> {
        if levels.is_empty() || record_count == 0 {
            return Err(FragilityError::Empty { levels: levels.len(), records: record_count });
        }
        let needed = (record_count - 1).checked_mul(record_stride).and_then(|before| before.checked_add(levels.len()));
        if record_stride < levels.len()
            || needed.is_none_or(|needed| needed > edp_m.len())
            || u32::try_from(record_count).is_err()
        {
            return Err(FragilityError::Shape {
                found: edp_m.len(),
                records: record_count,
                levels: levels.len(),
                stride: record_stride,
            });
        }
        check_levels(levels)?;
        if let Some(shares) = shares {
            check_shares(shares, levels.len(), record_count)?;
        }
        let stripes = Self { levels, edp_m, record_count, record_stride, shares };
        for record in 0..record_count {
            for (level, &value) in stripes.record(record).iter().enumerate() {
                if stripes.belongs(record, level) && (value.is_nan() || value < 0.0) {
                    return Err(FragilityError::Demand { record, level, value });
                }
            }
        }
        Ok(stripes)
    }

    /// Stripe levels, in the unit of the intensity measure, `[level]`.
    pub fn levels(&self) -> &'a [f64] {
        self.levels
    }

    /// Number of records.
    pub fn record_count(&self) -> usize {
        self.record_count
    }

    /// Number of stripe levels.
    pub fn level_count(&self) -> usize {
        self.levels.len()
    }

    /// How much each record counts at each level, `[level, record]`; none where all count alike.
    pub fn shares(&self) -> Option<&'a [f64]> {
        self.shares
    }

    /// Whether a record belongs to a level.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn belongs(&self, record: usize, level: usize) -> bool {
        self.shares.is_none_or(|shares| shares[level * self.record_count + record] > 0.0)
    }

    /// Demands of one record over all levels, m, `[level]`: its IDA curve.
    ///
    /// # Panics
    /// If `record` is not below [`Stripes::record_count`].
    pub fn record(&self, record: usize) -> &'a [f64] {
        assert!(record < self.record_count, "record {record} of {}", self.record_count);
        let start = record * self.record_stride;
        &self.edp_m[start..start + self.levels.len()]
    }

    /// Demands of the records of one level, m, each with how much it counts there: 1 where all count alike.
    ///
    /// # Panics
    /// If `level` is not below [`Stripes::level_count`].
    pub fn weighted_stripe(&self, level: usize) -> impl Iterator<Item = (f64, f64)> + 'a {
        let (stripes, records) = (*self, self.record_count);
        let share = move |record: usize| stripes.shares.map_or(1.0, |shares| shares[level * records + record]);
        let of_level = (0..records).filter(move |&record| stripes.belongs(record, level));
        self.stripe(level).zip(of_level.map(share))
    }

    /// Demands of all records at one level, m: a horizontal stripe.
    ///
    /// # Panics
    /// If `level` is not below [`Stripes::level_count`].
    pub fn stripe(&self, level: usize) -> impl Iterator<Item = f64> + 'a {
        assert!(level < self.levels.len(), "level {level} of {}", self.levels.len());
        let stripes = *self;
        let of_level = (0..self.record_count).filter(move |&record| stripes.belongs(record, level));
        of_level.map(move |record| stripes.record(record)[level])
    }
}

fn check_shares(shares: &[f64], levels: usize, records: usize) -> Result<(), FragilityError> {
    if shares.len() != levels * records {
        return Err(FragilityError::Shares { found: shares.len(), levels, records });
    }
    for (level, row) in shares.chunks_exact(records).enumerate() {
        let sum: f64 = row.iter().sum();
        if !(row.iter().all(|&share| share >= 0.0) && (sum - 1.0).abs() <= SUM_TOLERANCE) {
            return Err(FragilityError::ShareSum { level, sum });
        }
    }
    Ok(())
}

/// Positive, finite, strictly increasing.
pub(crate) fn check_levels(levels: &[f64]) -> Result<(), FragilityError> {
    let mut previous = 0.0;
    for (index, &value) in levels.iter().enumerate() {
        if !value.is_finite() || value <= previous {
            return Err(FragilityError::Level { index, value });
        }
        previous = value;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_is_not_a_stripe_array() {
        let levels = [1.0, 2.0];
        let bad = |levels: &[f64], edp: &[f64]| Stripes::new(levels, edp).unwrap_err();
        assert!(matches!(bad(&[], &[]), FragilityError::Empty { .. }));
        assert!(matches!(bad(&[], &[1.0]), FragilityError::Shape { .. }));
        assert!(matches!(bad(&levels, &[]), FragilityError::Empty { .. }));
        assert!(matches!(bad(&levels, &[0.0; 3]), FragilityError::Shape { .. }));
        for levels in [[0.0, 1.0], [1.0, 1.0], [2.0, 1.0], [1.0, f64::NAN], [1.0, f64::INFINITY]] {
            assert!(matches!(bad(&levels, &[0.0; 2]), FragilityError::Level { .. }));
        }
        let nan = bad(&levels, &[0.0, 0.0, 0.0, f64::NAN]);
        assert!(matches!(nan, FragilityError::Demand { record: 1, level: 1, .. }));
        assert!(matches!(bad(&levels, &[0.0, -1e-9]), FragilityError::Demand { record: 0, level: 1, .. }));
        assert!(Stripes::new(&levels, &[0.0, f64::INFINITY]).is_ok());
    }

    #[test]
    fn a_demand_counts_where_its_record_has_a_share() {
        let levels = [1.0, 2.0];
        let edp = [0.1, f64::NAN, 0.2, 0.4, f64::NAN, 0.3];
        let shares = [0.25, 0.75, 0.0, 0.0, 0.5, 0.5];
        let with = |shares: &'static [f64]| Stripes::with_shares(&levels, &edp, (3, 2), Some(shares));
        let stripes = Stripes::with_shares(&levels, &edp, (3, 2), Some(&shares)).unwrap();
        assert_eq!(stripes.stripe(0).collect::<Vec<_>>(), [0.1, 0.2]);
        assert_eq!(stripes.stripe(1).collect::<Vec<_>>(), [0.4, 0.3]);
        assert_eq!(stripes.weighted_stripe(0).collect::<Vec<_>>(), [(0.1, 0.25), (0.2, 0.75)]);
        assert!(!stripes.belongs(2, 0) && stripes.belongs(2, 1));
        // the second record belongs to the first level here, and so does its NaN to the first record's second
        let nan = with(&[0.25, 0.75, 0.0, 0.5, 0.5, 0.0]).unwrap_err();
        assert!(matches!(nan, FragilityError::Demand { record: 0, level: 1, .. }), "{nan}");
        assert!(matches!(with(&[1.0, 0.0, 0.0]).unwrap_err(), FragilityError::Shares { found: 3, .. }));
        let none = with(&[0.25, 0.75, 0.0, 0.0, 0.0, 0.0]).unwrap_err();
        assert!(matches!(none, FragilityError::ShareSum { level: 1, .. }), "{none}");
        assert!(with(&[1.5, -0.5, 0.0, 0.0, 0.5, 0.5]).is_err());
    }

    #[test]
    fn strided_view_sees_one_strength_of_a_three_dimensional_array() {
        // [record, strength, level] = [2, 3, 2]; the value spells its indices.
        let edp: Vec<f64> = (0..12).map(f64::from).collect();
        let levels = [1.0, 2.0];
        let middle = Stripes::strided(&levels, &edp[2..], 2, 6).unwrap();
        assert_eq!(middle.record(0), [2.0, 3.0]);
        assert_eq!(middle.record(1), [8.0, 9.0]);
        assert_eq!(middle.stripe(1).collect::<Vec<_>>(), [3.0, 9.0]);
        assert!(Stripes::strided(&levels, &edp[4..], 2, 6).is_ok());
        for (offset, records, stride) in [(5, 2, 6), (0, 3, 6), (0, 2, 1), (0, 2, usize::MAX), (0, usize::MAX, 2)] {
            let error = Stripes::strided(&levels, &edp[offset..], records, stride).unwrap_err();
            assert!(matches!(error, FragilityError::Shape { .. }), "{offset} {records} {stride}");
        }
    }
}
