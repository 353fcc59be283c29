//! The records, as far as consistency asks: how the two measures of each relate.

use std::collections::BTreeMap;

use crate::{ConsistencyError, LevelSets};

/// What is known of the earthquake and the place of a record.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Seismology {
    /// Moment magnitude M.
    pub magnitude: Option<f64>,
    /// Distance R, km.
    pub distance_km: Option<f64>,
    /// Mean shear-wave velocity of the upper 30 m, m/s.
    pub vs30_m_s: Option<f64>,
}

/// One analysed record: with both components of a pair there are two of the same intensities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SetRecord {
    /// x of the unscaled pair: the measure that the set is scaled to, in the unit of its curve.
    pub scaled_to: f64,
    /// y of the unscaled pair: the other measure, in the unit of its curve.
    pub other: f64,
    /// Any number that tells the pairs apart: shares of one pair are added before they are looked at.
    pub pair: usize,
    /// Any number that tells the earthquakes apart; none where it is not known.
    pub event: Option<usize>,
    /// What else is known.
    pub seismology: Seismology,
}

/// The powers of the scale factor with which x and y grow: 1 for velocities and accelerations, 2 for the Arias
/// intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Powers {
    /// That of x.
    pub scaled_to: f64,
    /// That of y.
    pub other: f64,
}

impl Default for Powers {
    fn default() -> Self {
        Self { scaled_to: 1.0, other: 1.0 }
    }
}

impl Powers {
    /// What x is raised to where it stands for y.
    fn ratio(self) -> f64 {
        self.other / self.scaled_to
    }
}

/// x to a power; x itself where this is 1.
fn raised(x: f64, power: f64) -> f64 {
    if power == 1.0 { x } else { x.powf(power) }
}

/// A set of records: the same for every site.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordSet {
    records: Vec<SetRecord>,
    powers: Powers,
    /// q = y/x, `[record]`.
    ratios: Vec<f64>,
    /// Records by falling q.
    order: Vec<usize>,
    /// Position of each record's pair among the pairs, in the order of their first records.
    pairs: Vec<usize>,
    /// Position of each record's event among the events; none where it is not known.
    events: Vec<Option<usize>>,
    pair_count: usize,
    event_count: usize,
    /// None where the records are the same at every level.
    at_level: Option<AtLevel>,
}

/// The records of each level, where these are its own.
#[derive(Debug, Clone, PartialEq)]
struct AtLevel {
    sets: LevelSets,
    /// q as it comes out with the factors of the level, `[level, record]`.
    ratios: Vec<f64>,
    /// The records of each level by falling q.
    orders: Vec<Vec<usize>>,
}

impl RecordSet {
    /// Checks the records, of measures that grow as the scale factor does.
    ///
    /// # Errors
    /// As [`with_powers`](Self::with_powers).
    pub fn new(records: Vec<SetRecord>) -> Result<Self, ConsistencyError> {
        Self::with_powers(records, Powers::default())
    }

    /// Checks the records, of measures that grow with these `powers` of the scale factor.
    ///
    /// # Errors
    /// No record; an intensity that is not finite and above 0.
    pub fn with_powers(records: Vec<SetRecord>, powers: Powers) -> Result<Self, ConsistencyError> {
        if records.is_empty() {
            return Err(ConsistencyError::NoRecords);
        }
        let mut ratios = Vec::with_capacity(records.len());
        for (record, row) in records.iter().enumerate() {
            let ratio = row.other / raised(row.scaled_to, powers.ratio());
            let parts = [("intensity scaled to", row.scaled_to), ("other intensity", row.other), ("ratio", ratio)];
            for (what, value) in parts {
                if !(value.is_finite() && value > 0.0) {
                    return Err(ConsistencyError::Intensity { record, what, value });
                }
            }
            ratios.push(ratio);
        }
        let mut order: Vec<usize> = (0..records.len()).collect();
        order.sort_by(|&a, &b| ratios[b].total_cmp(&ratios[a]));
        let (mut known_pairs, mut known_events) = (BTreeMap::new(), BTreeMap::new());
        let position = |known: &mut BTreeMap<usize, usize>, name: usize| {
            let next = known.len();
            *known.entry(name).or_insert(next)
        };
        let pairs = records.iter().map(|record| position(&mut known_pairs, record.pair)).collect();
        let mut events = Vec::with_capacity(records.len());
        for record in &records {
            events.push(record.event.map(|event| position(&mut known_events, event)));
        }
        let (pair_count, event_count) = (known_pairs.len(), known_events.len());
        Ok(Self { records, powers, ratios, order, pairs, events, pair_count, event_count, at_level: None })
    }

    /// The same records where each level has its own of them, with factors and shares of their own.
    ///
    /// With f the factor over level/intensity, a record brings y as one with the ratio q f^power does.
    ///
    /// # Errors
    /// Sets of another number of records; a ratio that is not finite and above 0 with a factor.
    pub fn at_level(mut self, sets: LevelSets) -> Result<Self, ConsistencyError> {
        let (found, expected) = (sets.record_count(), self.len());
        if found != expected {
            return Err(ConsistencyError::Count { what: "records of levels", found, expected });
        }
        let mut ratios = Vec::with_capacity(sets.level_count() * self.len());
        let mut orders = Vec::with_capacity(sets.level_count());
        for level in 0..sets.level_count() {
            for (record, ratio) in self.ratios.iter().enumerate() {
                let value = ratio * raised(sets.relative_factor(level, record), self.powers.other);
                if !(value.is_finite() && value > 0.0) {
                    return Err(ConsistencyError::Intensity {
                        record,
                        what: "ratio with the factor of a level",
                        value,
                    });
                }
                ratios.push(value);
            }
            let own = &ratios[level * self.len()..];
            let mut order: Vec<usize> = (0..self.len()).filter(|&record| sets.belongs(level, record)).collect();
            order.sort_by(|&a, &b| own[b].total_cmp(&own[a]));
            orders.push(order);
        }
        self.at_level = Some(AtLevel { sets, ratios, orders });
        Ok(self)
    }

    /// Number of records N.
    #[expect(clippy::len_without_is_empty, reason = "a set is never empty")]
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// The records.
    pub fn records(&self) -> &[SetRecord] {
        &self.records
    }

    /// y of a record with the ratio q, scaled to the level x: x q.
    pub(crate) fn brought(&self, level: f64, ratio: f64) -> f64 {
        raised(level, self.powers.ratio()) * ratio
    }

    /// By what a record is multiplied to reach the level x from the stripe at `stripe`: that to reach it by its own
    /// intensity, times what the factor at the stripe is over that.
    pub(crate) fn scale_factor(&self, level: f64, stripe: usize, record: usize) -> f64 {
        let own = raised(level / self.records[record].scaled_to, 1.0 / self.powers.scaled_to);
        self.at_level.as_ref().map_or(own, |of| own * of.sets.relative_factor(stripe, record))
    }

    /// q = y/x of each unscaled record, `[record]`: y over x to the power that makes it grow as y does.
    pub fn ratios(&self) -> &[f64] {
        &self.ratios
    }

    /// q of each record as it is scaled at the stripe at `level`, `[record]`.
    pub(crate) fn ratios_at(&self, level: usize) -> &[f64] {
        self.at_level.as_ref().map_or(&self.ratios, |of| &of.ratios[level * self.len()..][..self.len()])
    }

    /// Each level's own records; none where they are the same at every level.
    pub fn level_sets(&self) -> Option<&LevelSets> {
        self.at_level.as_ref().map(|of| &of.sets)
    }

    /// How much each record counts before it is weighed, `[level, record]`; none where all count alike.
    pub(crate) fn shares(&self) -> Option<&[f64]> {
        self.level_sets()?.shares()
    }

    /// Whether a record is of the stripe at `level`.
    pub(crate) fn belongs(&self, level: usize, record: usize) -> bool {
        self.level_sets().is_none_or(|sets| sets.belongs(level, record))
    }

    /// Every record once: the multiplicities of the set itself, `[record]`.
    pub fn once(&self) -> Vec<u32> {
        vec![1; self.len()]
    }

    /// The orders of the records: one for all stripes, or one for each.
    pub(crate) fn order_count(&self) -> usize {
        self.at_level.as_ref().map_or(1, |of| of.orders.len())
    }

    /// Which of the orders is that of the stripe at `level`.
    pub(crate) fn order_of(&self, level: usize) -> usize {
        if self.at_level.is_some() { level } else { 0 }
    }

    /// Records of the stripe at `level` by falling q.
    pub(crate) fn order(&self, level: usize) -> &[usize] {
        self.at_level.as_ref().map_or(&self.order, |of| &of.orders[level])
    }

    /// The first record of the pair at `position`.
    pub(crate) fn record_of_pair(&self, position: usize) -> usize {
        self.pairs.iter().position(|&pair| pair == position).unwrap_or(0)
    }

    /// The caller's number of the event at `position`.
    pub(crate) fn event_number(&self, position: usize) -> usize {
        let found = self.events.iter().position(|&event| event == Some(position));
        found.and_then(|record| self.records[record].event).unwrap_or(0)
    }

    /// Adds the shares of each pair, `[pair]`.
    pub(crate) fn by_pair(&self, shares: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.pair_count];
        for (&pair, share) in self.pairs.iter().zip(shares) {
            sums[pair] += share;
        }
        sums
    }

    /// Adds the shares of each known event, `[event]`.
    pub(crate) fn by_event(&self, shares: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.event_count];
        for (event, share) in self.events.iter().zip(shares) {
            if let Some(event) = *event {
                sums[event] += share;
            }
        }
        sums
    }

    /// Whether the event of every record of the stripe at `level` is known.
    pub(crate) fn knows_events_at(&self, level: usize) -> bool {
        self.events.iter().enumerate().all(|(record, event)| event.is_some() || !self.belongs(level, record))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(scaled_to: f64, other: f64, pair: usize, event: Option<usize>) -> SetRecord {
        SetRecord { scaled_to, other, pair, event, seismology: Seismology::default() }
    }

    #[test]
    fn shares_are_added_by_pair_and_event() {
        let rows = vec![record(1.0, 2.0, 7, Some(40)), record(1.0, 2.0, 7, Some(40)), record(2.0, 8.0, 3, Some(9))];
        let set = RecordSet::new(rows).unwrap();
        assert_eq!(set.ratios(), [2.0, 2.0, 4.0]);
        assert_eq!(set.order(0), [2, 0, 1]);
        assert_eq!(set.by_pair(&[0.25, 0.25, 0.5]), [0.5, 0.5]);
        assert_eq!(set.by_event(&[0.25, 0.25, 0.5]), [0.5, 0.5]);
        assert_eq!((set.record_of_pair(1), set.event_number(1)), (2, 9));
        assert!(set.knows_events_at(0));
        assert!(!RecordSet::new(vec![record(1.0, 1.0, 0, None)]).unwrap().knows_events_at(0));
    }

    // Three times the amplitude: nine times the Arias intensity, and a third of the way back.
    #[test]
    fn measures_grow_with_their_powers() {
        let rows = || vec![record(2.0, 5.0, 0, None)];
        let squared = RecordSet::with_powers(rows(), Powers { scaled_to: 1.0, other: 2.0 }).unwrap();
        assert_eq!(squared.brought(6.0, squared.ratios()[0]), 45.0);
        assert_eq!(squared.scale_factor(6.0, 0, 0), 3.0);
        let root = RecordSet::with_powers(rows(), Powers { scaled_to: 2.0, other: 1.0 }).unwrap();
        assert!((root.brought(18.0, root.ratios()[0]) - 15.0).abs() < 1e-14);
        assert_eq!(root.scale_factor(18.0, 0, 0), 3.0);
    }

    // The second level has the last two records, the last one by half as much again as its intensity asks for.
    #[test]
    fn each_level_has_its_own_records_and_factors() {
        let rows = || vec![record(2.0, 2.0, 0, None), record(2.0, 4.0, 1, Some(3)), record(2.0, 6.0, 2, Some(3))];
        let sets = |factors: Vec<f64>, shares| LevelSets::new(3, factors, Some(shares)).unwrap();
        let of_levels = sets(vec![1.0, 1.0, 1.0, f64::NAN, 2.0, 0.5], vec![0.5, 0.25, 0.25, 0.0, 0.5, 0.5]);
        let squared = RecordSet::with_powers(rows(), Powers { scaled_to: 1.0, other: 2.0 }).unwrap();
        // y/x² of the records: 0.5, 1, 1.5; with the factors of the second level squared 4 and 1/4 times that
        let set = squared.at_level(of_levels).unwrap();
        assert_eq!((set.ratios_at(0), set.ratios_at(1)), (&[0.5, 1.0, 1.5][..], &[0.5, 4.0, 0.375][..]));
        assert_eq!((set.order(0), set.order(1)), (&[2, 1, 0][..], &[1, 2][..]));
        assert_eq!(
            [set.scale_factor(6.0, 0, 1), set.scale_factor(6.0, 1, 1), set.scale_factor(6.0, 1, 0)],
            [3.0, 6.0, 3.0]
        );
        assert!(!set.knows_events_at(0) && set.knows_events_at(1));
        let other = LevelSets::new(2, vec![1.0; 2], None).unwrap();
        assert!(RecordSet::new(rows()).unwrap().at_level(other).is_err());
        let beyond = sets(vec![1.0, 1e308, 1.0], vec![0.5, 0.25, 0.25]);
        let error = RecordSet::new(rows()).unwrap().at_level(beyond).unwrap_err();
        assert!(matches!(error, ConsistencyError::Intensity { record: 1, .. }), "{error}");
    }

    #[test]
    fn refuses_what_cannot_be_scaled() {
        assert_eq!(RecordSet::new(vec![]).unwrap_err(), ConsistencyError::NoRecords);
        for (x, y) in [(0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY), (1e-300, 1e300)] {
            let error = RecordSet::new(vec![record(1.0, 1.0, 0, None), record(x, y, 1, None)]).unwrap_err();
            assert!(matches!(error, ConsistencyError::Intensity { record: 1, .. }), "{error}");
        }
    }
}
