//! How long a plan will take on this very machine: a spread of its pieces, timed.

use std::time::{Duration, Instant};

use uplift_oscillator::{GroundMotion, Sweep};

use crate::plan::{Plan, excitation};

/// A prediction of the time that a plan takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Seconds on one thread.
    pub seconds_one_thread: f64,
    /// Pieces (a record and a strength each) that were timed.
    pub pieces_timed: usize,
}

/// Pieces timed at least, however small the budget.
const LEAST_PIECES: usize = 16;

/// Time pieces of `plan` spread over records and strengths until `budget` is spent, and extrapolate.
///
/// The pieces are visited in steps of the golden ratio, which leaves no region out however early the visit ends.
pub fn estimate(plan: &Plan<'_>, budget: Duration) -> Estimate {
    let strengths = plan.oscillators.len();
    let pieces = plan.records.len() * strengths;
    let start = Instant::now();
    let mut preparation = Duration::ZERO;
    let mut timed = 0;
    while timed < pieces && (timed < LEAST_PIECES || start.elapsed() < budget) {
        let piece = spread(timed, pieces);
        let record = &plan.records[piece / strengths];
        let begin = Instant::now();
        let Ok(ground) = excitation(record).map(GroundMotion::new) else { break };
        // done once a record, not once a piece
        preparation += begin.elapsed();
        let sweep = Sweep::new(&plan.oscillators[piece % strengths], &ground, plan.with_free_peak);
        let scales: Vec<f64> = plan.levels.iter().map(|level| level / record.intensity).collect();
        std::hint::black_box(sweep.peaks(&scales));
        timed += 1;
    }
    let per_piece = (start.elapsed().saturating_sub(preparation)).as_secs_f64() / timed.max(1) as f64;
    Estimate { seconds_one_thread: per_piece * pieces as f64, pieces_timed: timed }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a fraction of a count")]
fn spread(index: usize, count: usize) -> usize {
    let golden = 0.618_033_988_749_894_9;
    (((index as f64 + 0.5) * golden).fract() * count as f64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_visit_reaches_every_region() {
        let mut seen = [false; 10];
        for index in 0..20 {
            seen[spread(index, 10)] = true;
        }
        assert!(seen.iter().all(|&seen| seen));
        assert!((0..1000).all(|index| spread(index, 7) < 7));
    }
}
