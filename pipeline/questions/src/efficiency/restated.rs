//! The stripes of one measure told by another: what the same runs say of a measure that the records were not scaled to.
//!
//! A record's factor at a stripe fixes every measure of it there. So each record's curve of displacement over factor
//! is one of displacement over any measure, and is read at levels common to all: along straight lines of ln u over the
//! logarithm of the factor, between neighbouring stripes.

use uplift_fragility::uplift_levels;
use uplift_job::Array;
use uplift_motion::IntensityMeasure;
use uplift_uniform_risk::{StoredMeasure, StoredStripes};

use crate::error::QuestionsError;

/// A measure with its value of each unscaled record, in its unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured<'a> {
    pub(super) measure: IntensityMeasure,
    pub(super) of_records: &'a [f64],
}

impl Measured<'_> {
    /// What grows as the scale factor does: the measure of a record, or its root.
    pub(super) fn amplitude(&self, record: usize) -> f64 {
        self.measure.amplitude(self.of_records[record])
    }

    pub(super) fn factor(&self, record: usize, level: f64) -> f64 {
        self.measure.amplitude(level) / self.amplitude(record)
    }

    /// The level to which a factor brings a record.
    fn level(&self, record: usize, factor: f64) -> f64 {
        self.of_records[record] * factor.powi(i32::from(self.measure.power()))
    }
}

/// The runs of a measure, told by another.
pub(super) struct Restated {
    /// At levels that every record was brought to.
    pub(super) stripes: StoredMeasure,
    /// The level of the other measure at which each record first lifts the structure, `[strength][record]`: exact where
    /// the stripes have it.
    pub(super) uplift_levels: Vec<Vec<f64>>,
}

/// The runs of `own`, scaled to the measure `from`, told by the measure `to`; none where there are no two levels that
/// all records were brought to.
pub(super) fn restated(
    stored: &StoredStripes,
    own: &StoredMeasure,
    (from, to): (Measured<'_>, Measured<'_>),
) -> Result<Option<Restated>, QuestionsError> {
    let [records, strengths, _] = own.edp_m.shape();
    let factors: Vec<Vec<f64>> =
        (0..records).map(|record| own.levels.iter().map(|&level| from.factor(record, level)).collect()).collect();
    let levels = common_levels(own, &factors, to);
    if levels.len() < 2 {
        return Ok(None);
    }
    // where each level lies among the stripes of each record, for all strengths
    let places: Vec<Vec<Place>> = (0..records)
        .map(|record| levels.iter().map(|&level| Place::new(to.factor(record, level), &factors[record])).collect())
        .collect();
    let edp_m = Array::from_fn([records, strengths, levels.len()], |[record, strength, level]| {
        places[record][level].read(own.edp_m.block([record, strength]))
    });
    let of_strength = |strength: usize| {
        let first = uplift_levels(&own.stripes(strength)?, stored.uplift_displacement_m);
        let told = first.iter().enumerate().map(|(record, &level)| to.level(record, from.factor(record, level)));
        Ok(told.collect())
    };
    let uplift_levels = (0..strengths).map(of_strength).collect::<Result<_, QuestionsError>>()?;
    let exact_m = Array::from_fn([0, 0, strengths], |_| f64::NAN);
    let stripes = StoredMeasure {
        measure: to.measure,
        levels,
        edp_m,
        shares: None,
        weights: Vec::new(),
        branches: Vec::new(),
        exact_m,
    };
    Ok(Some(Restated { stripes, uplift_levels }))
}

/// As many levels as the stripes have, brought by a record in the middle, as far as all records reach them.
fn common_levels(own: &StoredMeasure, factors: &[Vec<f64>], to: Measured<'_>) -> Vec<f64> {
    let ends = |chosen: fn(&[f64]) -> Option<&f64>| {
        factors.iter().enumerate().filter_map(move |(record, of)| Some(to.level(record, *chosen(of)?)))
    };
    let (least, most) = (ends(<[f64]>::first).fold(0.0, f64::max), ends(<[f64]>::last).fold(f64::INFINITY, f64::min));
    let middle = |level: usize| {
        let logarithms = factors.iter().enumerate().map(|(record, of)| to.level(record, of[level]).ln());
        (logarithms.sum::<f64>() / factors.len() as f64).exp()
    };
    (0..own.levels.len()).map(middle).filter(|level| (least..=most).contains(level)).collect()
}

/// Between which two stripes a factor lies, and how far from the first of them, in logarithms.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Place {
    after: usize,
    share: f64,
}

impl Place {
    /// `factor` among the rising `factors` of a record, within them but for rounding.
    fn new(factor: f64, factors: &[f64]) -> Self {
        let after = factors.partition_point(|&known| known <= factor).clamp(1, factors.len() - 1) - 1;
        let share = (factor / factors[after]).ln() / (factors[after + 1] / factors[after]).ln();
        Self { after, share: share.clamp(0.0, 1.0) }
    }

    /// The demand there, m. Where one has no logarithm, the nearer one.
    fn read(self, demands_m: &[f64]) -> f64 {
        let (low, high) = (demands_m[self.after], demands_m[self.after + 1]);
        let both = [low, high].iter().all(|demand| *demand > 0.0 && demand.is_finite());
        match self.share {
            share if share == 0.0 || low == high => low,
            share if both => low * (share * (high / low).ln()).exp(),
            share if share < 0.5 => low,
            _ => high,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn demands_between_stripes_lie_on_straight_lines_of_logarithms() {
        let factors = [1.0, 2.0, 8.0];
        let at = |factor: f64, demands_m: &[f64]| Place::new(factor, &factors).read(demands_m);
        let power = [3.0, 3.0 * 2_f64.powf(1.5), 3.0 * 8_f64.powf(1.5)];
        for factor in [1.0, 1.3, 2.0, 4.0, 7.9, 8.0] {
            assert!((at(factor, &power) / (3.0 * factor.powf(1.5)) - 1.0).abs() < 1e-14, "{factor}");
        }
        let overturned = [1.0, 2.0, f64::INFINITY];
        assert_eq!((at(3.9, &overturned), at(4.1, &overturned)), (2.0, f64::INFINITY));
        assert_eq!(at(1.2, &[0.0, 2.0, 3.0]), 0.0);
        assert_eq!(at(1.9, &[0.0, 2.0, 3.0]), 2.0);
    }

    fn pgv(of_records: &[f64]) -> Measured<'_> {
        Measured { measure: IntensityMeasure::Pgv, of_records }
    }

    proptest! {
        // u = c (level of the other measure)^b of every record: told by it, no scatter is left.
        #[test]
        fn a_perfect_measure_leaves_no_scatter(
            pairs in prop::collection::vec((0.5..2.0_f64, 0.5..2.0_f64), 2..12), exponent in 0.2..3.0_f64,
        ) {
            let (x, y): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
            let levels: Vec<f64> = (0..60).map(|i| 1.15_f64.powi(i)).collect();
            for measure in [IntensityMeasure::Pga, IntensityMeasure::Arias] {
                let (from, to) = (pgv(&x), Measured { measure, of_records: &y });
                let edp_m = Array::from_fn([x.len(), 1, levels.len()], |[record, _, level]| {
                    to.level(record, from.factor(record, levels[level])).powf(exponent)
                });
                let own = StoredMeasure {
                    measure: IntensityMeasure::Pgv,
                    levels: levels.clone(),
                    edp_m,
                    shares: None,
                    weights: Vec::new(),
                    branches: Vec::new(),
                    exact_m: Array::from_fn([0, 0, 1], |_| 0.0),
                };
                let of_record = |record| levels.iter().map(|&level| from.factor(record, level)).collect();
                let factors: Vec<Vec<f64>> = (0..x.len()).map(of_record).collect();
                let common = common_levels(&own, &factors, to);
                prop_assert!(common.len() > 1);
                for &level in &common {
                    for (record, factors) in factors.iter().enumerate() {
                        let place = Place::new(to.factor(record, level), factors);
                        let found = place.read(own.edp_m.block([record, 0]));
                        prop_assert!((found / level.powf(exponent) - 1.0).abs() < 1e-11, "{} {}", found, level);
                    }
                }
            }
        }
    }
}
