//! The records of a sample, in the order in which a solve goes through them.

use uplift_risk::RiskError;

use crate::{ConsistencyError, RecordSet};

/// Room for the numbers of one solve, used again by the next: one a thread.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    /// `[order]`: one for all stripes, or for each its own.
    drawn: Vec<Drawn>,
    /// Exponents, then exponentials, of one stripe, in the order of its drawn records.
    values: Vec<f64>,
}

/// The drawn records in one order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drawn {
    /// Rank, record and how much it counts, by falling q.
    pub(crate) records: Vec<(usize, usize, f64)>,
    /// How many of them have a lower rank, `[rank + 1]`.
    pub(crate) before: Vec<usize>,
}

impl Scratch {
    /// Puts the drawn records side by side, by falling q.
    ///
    /// # Errors
    /// Another number of multiplicities than of records; no record drawn, of all or of a level.
    pub(crate) fn draw(&mut self, set: &RecordSet, multiplicities: &[u32]) -> Result<(), ConsistencyError> {
        check(set, multiplicities)?;
        self.drawn.resize_with(set.order_count(), Drawn::default);
        for (level, Drawn { records, before }) in self.drawn.iter_mut().enumerate() {
            records.clear();
            before.clear();
            let shares = set.shares().map(|shares| &shares[level * set.len()..][..set.len()]);
            for (rank, &record) in set.order(level).iter().enumerate() {
                before.push(records.len());
                if multiplicities[record] > 0 {
                    let count = f64::from(multiplicities[record]);
                    records.push((rank, record, shares.map_or(count, |shares| count * shares[record])));
                }
            }
            before.push(records.len());
            if records.is_empty() {
                return Err(RiskError::EmptyLevel { level }.into());
            }
        }
        Ok(())
    }

    /// The drawn records of a stripe, and room for a value of each.
    pub(crate) fn at_level(&mut self, set: &RecordSet, level: usize) -> (&Drawn, &mut Vec<f64>) {
        (&self.drawn[set.order_of(level)], &mut self.values)
    }
}

/// Refuses multiplicities that are not those of a sample of the set.
pub(crate) fn check(set: &RecordSet, multiplicities: &[u32]) -> Result<(), ConsistencyError> {
    let (found, expected) = (multiplicities.len(), set.len());
    if found != expected {
        return Err(ConsistencyError::Count { what: "multiplicities", found, expected });
    }
    if multiplicities.iter().all(|&count| count == 0) {
        return Err(ConsistencyError::NothingDrawn);
    }
    Ok(())
}
