//! The records, as far as consistency asks: how the two measures of each relate.

use std::collections::BTreeMap;

use crate::ConsistencyError;

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
        Ok(Self { records, powers, ratios, order, pairs, events, pair_count, event_count })
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

    /// By what a record is multiplied to reach the level x.
    pub(crate) fn scale_factor(&self, level: f64, record: &SetRecord) -> f64 {
        raised(level / record.scaled_to, 1.0 / self.powers.scaled_to)
    }

    /// q = y/x of each record, `[record]`: y over x to the power that makes it grow as y does.
    pub fn ratios(&self) -> &[f64] {
        &self.ratios
    }

    /// Every record once: the multiplicities of the set itself, `[record]`.
    pub fn once(&self) -> Vec<u32> {
        vec![1; self.len()]
    }

    /// Records by falling q.
    pub(crate) fn order(&self) -> &[usize] {
        &self.order
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

    /// Whether the event of every record is known.
    pub fn knows_all_events(&self) -> bool {
        self.events.iter().all(Option::is_some)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn record(scaled_to: f64, other: f64, pair: usize, event: Option<usize>) -> SetRecord {
        SetRecord { scaled_to, other, pair, event, seismology: Seismology::default() }
    }

    #[test]
    fn shares_are_added_by_pair_and_event() {
        let rows = vec![record(1.0, 2.0, 7, Some(40)), record(1.0, 2.0, 7, Some(40)), record(2.0, 8.0, 3, Some(9))];
        let set = RecordSet::new(rows).unwrap();
        assert_eq!(set.ratios(), [2.0, 2.0, 4.0]);
        assert_eq!(set.order(), [2, 0, 1]);
        assert_eq!(set.by_pair(&[0.25, 0.25, 0.5]), [0.5, 0.5]);
        assert_eq!(set.by_event(&[0.25, 0.25, 0.5]), [0.5, 0.5]);
        assert_eq!((set.record_of_pair(1), set.event_number(1)), (2, 9));
        assert!(set.knows_all_events());
        assert!(!RecordSet::new(vec![record(1.0, 1.0, 0, None)]).unwrap().knows_all_events());
    }

    // Three times the amplitude: nine times the Arias intensity, and a third of the way back.
    #[test]
    fn measures_grow_with_their_powers() {
        let rows = || vec![record(2.0, 5.0, 0, None)];
        let squared = RecordSet::with_powers(rows(), Powers { scaled_to: 1.0, other: 2.0 }).unwrap();
        assert_eq!(squared.brought(6.0, squared.ratios()[0]), 45.0);
        assert_eq!(squared.scale_factor(6.0, &squared.records()[0]), 3.0);
        let root = RecordSet::with_powers(rows(), Powers { scaled_to: 2.0, other: 1.0 }).unwrap();
        assert!((root.brought(18.0, root.ratios()[0]) - 15.0).abs() < 1e-14);
        assert_eq!(root.scale_factor(18.0, &root.records()[0]), 3.0);
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
