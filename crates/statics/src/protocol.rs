//! Cyclic loading protocols (Section 5.4, Figure 5.11), and what columns do under them.
//!
//! Sets of equal cycles whose amplitude grows from set to set, `a_i = a_1 r^(i − 1)`, at a constant rate of drift.

use crate::columns::RestrainedColumns;
use crate::error::{StaticsError, positive, require};
use crate::restrainer::Restrainer;

/// Most points of a history: a slip of a step, beyond.
const MOST_POINTS: u64 = 1_000_000;

/// Sets of cycles by amplitude, as drift ratios.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadingProtocol {
    first_drift: f64,
    ratio: f64,
    sets: u32,
    cycles: u32,
    rate_per_s: f64,
}

/// A point of a protocol.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ProtocolPoint {
    /// Time, s.
    pub time_s: f64,
    /// Drift ratio.
    pub drift: f64,
    /// Set, from 1.
    pub set: u32,
    /// Cycle within the set, from 1.
    pub cycle: u32,
}

/// Columns at a point of a protocol.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct CyclicState {
    /// The point.
    #[serde(flatten)]
    pub point: ProtocolPoint,
    /// Travel of the deck, m, with its sign.
    pub displacement_m: f64,
    /// Force on the deck, N, with its sign; none at rest, where it is anything up to the force at uplift.
    pub force_n: Option<f64>,
    /// Force of a restrainer, N.
    pub tendon_n: f64,
    /// Deformation of its springs, m.
    pub spring_m: Option<f64>,
    /// Energy that yielding stoppers of all restrainers have dissipated so far, J: what they yield at, times how far
    /// they have stretched plastically.
    pub dissipated_j: f64,
}

impl Default for LoadingProtocol {
    /// That of Figure 5.11: 18 sets of two cycles from 0.36 %, each 1.25 times the one before, at 1.38e-4/s.
    fn default() -> Self {
        Self { first_drift: 0.0036, ratio: 1.25, sets: 18, cycles: 2, rate_per_s: 1.38e-4 }
    }
}

impl LoadingProtocol {
    /// From the first amplitude and the factor from set to set, the number of sets and of cycles in each, and the rate
    /// of drift (1/s).
    ///
    /// # Errors
    /// Amplitude, factor and rate must be finite and positive, the last amplitude at most 1; there must be a set and a
    /// cycle, and at most a million points of history.
    pub fn new(first_drift: f64, ratio: f64, sets: u32, cycles: u32, rate_per_s: f64) -> Result<Self, StaticsError> {
        positive("first", first_drift, "")?;
        positive("ratio", ratio, "")?;
        positive("rate", rate_per_s, "1/s")?;
        require(sets >= 1, "sets", f64::from(sets), "", "at least 1")?;
        require(cycles >= 1, "cycles", f64::from(cycles), "", "at least 1")?;
        let turns = u64::from(sets) * u64::from(cycles) * 4;
        require(
            turns <= MOST_POINTS,
            "cycles",
            f64::from(cycles),
            "",
            "fewer cycles: the protocol would have a million turns",
        )?;
        let protocol = Self { first_drift, ratio, sets, cycles, rate_per_s };
        // a ratio of 1 is a column that lies at 45 degrees
        let last = protocol.amplitude(sets);
        require(
            last <= 1.0,
            "last amplitude",
            last,
            "",
            "at most 1: take a smaller first amplitude (a drift ratio, not per cent), a smaller ratio or fewer sets",
        )?;
        Ok(protocol)
    }

    /// Amplitude of a set, from 1, as a drift ratio.
    pub fn amplitude(&self, set: u32) -> f64 {
        self.first_drift * self.ratio.powi(i32::try_from(set - 1).unwrap_or(i32::MAX))
    }

    /// Amplitudes of all sets.
    pub fn amplitudes(&self) -> Vec<f64> {
        (1..=self.sets).map(|set| self.amplitude(set)).collect()
    }

    /// Duration, s: four amplitudes a cycle at the rate.
    pub fn duration_s(&self) -> f64 {
        let way: f64 = self.amplitudes().iter().map(|amplitude| 4.0 * f64::from(self.cycles) * amplitude).sum();
        way / self.rate_per_s
    }

    /// The history: each quarter of a cycle in `parts` equal steps, from rest to rest.
    ///
    /// # Errors
    /// There must be a part, and at most a million points.
    pub fn history(&self, parts: u32) -> Result<Vec<ProtocolPoint>, StaticsError> {
        require(parts >= 1, "parts", f64::from(parts), "", "at least 1")?;
        let points = u64::from(self.sets) * u64::from(self.cycles) * 4 * u64::from(parts);
        require(points <= MOST_POINTS, "parts", f64::from(parts), "", "fewer: the history has a million points")?;
        let mut history = vec![ProtocolPoint { time_s: 0.0, drift: 0.0, set: 1, cycle: 1 }];
        let mut begun_s = 0.0;
        for set in 1..=self.sets {
            let amplitude = self.amplitude(set);
            let quarter_s = amplitude / self.rate_per_s;
            for cycle in 1..=self.cycles {
                for (quarter, [from, to]) in [[0.0, 1.0], [1.0, 0.0], [0.0, -1.0], [-1.0, 0.0]].iter().enumerate() {
                    for part in 1..=parts {
                        let share = f64::from(part) / f64::from(parts);
                        history.push(ProtocolPoint {
                            time_s: begun_s + (quarter as f64 + share) * quarter_s,
                            drift: amplitude * (from + (to - from) * share),
                            set,
                            cycle,
                        });
                    }
                }
                begun_s += 4.0 * quarter_s;
            }
        }
        Ok(history)
    }
}

impl RestrainedColumns {
    /// The columns under a history of drift: the same law on both sides, and stoppers that engage later once they have
    /// yielded.
    ///
    /// # Errors
    /// A drift beyond the column's reach, or at which the springs stop it.
    pub fn under(&self, history: &[ProtocolPoint]) -> Result<Vec<CyclicState>, StaticsError> {
        let mut columns = self.clone();
        let mut largest_m = 0.0_f64;
        let mut dissipated_j = 0.0;
        let stoppers = self.restrainer().and_then(|held| held.parts().stopper);
        let mut states = Vec::with_capacity(history.len());
        for point in history {
            let displacement_m = point.drift * self.geometry().height_m();
            let mut state = columns.at_displacement(displacement_m.abs())?;
            let yields_m =
                columns.restrainer().and_then(|held| held.parts().stopper).and_then(|rods| rods.yields_at_m());
            if let (Some(spring_m), Some(yields_m)) = (state.spring_m, yields_m)
                && spring_m > yields_m.max(largest_m)
            {
                largest_m = spring_m;
                dissipated_j = f64::from(self.restrained()) * stoppers.map_or(0.0, |rods| rods.dissipated_j(largest_m));
                // the law is that of the first loading up to here, and that of the stretched rods from here on
                let held = self.restrainer().map(|held: &Restrainer| held.after_yielding(largest_m)).transpose()?;
                if let Some(held) = held {
                    columns = columns.with_law(held);
                    state = columns.at_displacement(displacement_m.abs())?;
                }
            }
            let sign = if point.drift < 0.0 { -1.0 } else { 1.0 };
            states.push(CyclicState {
                point: *point,
                displacement_m,
                force_n: (displacement_m != 0.0).then_some(sign * state.force_n),
                tendon_n: state.tendon_n,
                spring_m: state.spring_m,
                dissipated_j,
            });
        }
        Ok(states)
    }
}
