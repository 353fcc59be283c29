//! How long a plan will take on this very machine: a spread of its rows, timed.

use std::time::{Duration, Instant};

use uplift_oscillator::GroundMotion;

use crate::analysis::{several, swept};
use crate::plan::Plan;
use crate::system::System;

/// A prediction of the time that a plan takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Seconds on one thread.
    pub seconds_one_thread: f64,
    /// Analysis rows that were timed, of systems that are not swept by some of their runs.
    pub rows_timed: usize,
}

/// Rows timed at least, however small the budget; one of a system that is not swept counts for four.
const LEAST_ROWS: usize = 16;
/// Scale factors that stand for all of a row of a system that is not swept: a row of an expensive one would take the
/// budget many times over.
const SCALES_TIMED: usize = 8;
/// A step that leaves no row out of sight however early a visit ends: the golden ratio.
const STEP: f64 = 0.618_033_988_749_894_9;

/// Time rows of `plan` spread over motions and systems until `budget` is spent, and extrapolate.
pub fn estimate(plan: &Plan<'_>, budget: Duration) -> Estimate {
    let axes = plan.axes();
    let start = Instant::now();
    let mut spent = Duration::ZERO;
    let (mut timed, mut seen) = (0, 0);
    while timed < axes.rows() && (seen < LEAST_ROWS || start.elapsed() < budget) {
        let (motion, system) = axes.motion_and_system(spread(timed, axes.rows()));
        // one azimuth stands for all
        let Some(ground) = plan.grounds_of(motion).next() else { break };
        let azimuths = u32::try_from(plan.histories_per_peak()).unwrap_or(u32::MAX);
        let scales: Vec<f64> = plan.motions()[motion].scales.iter().copied().filter(|scale| !scale.is_nan()).collect();
        match plan.system(motion, system) {
            System::Oscillator(oscillator) => {
                // made ready once a motion, not once a row
                let Ok(ground) = ground.excitation().map(GroundMotion::new) else { break };
                let begin = Instant::now();
                std::hint::black_box(swept(oscillator, &ground, plan.with_free_peak(), &scales));
                spent += begin.elapsed() * azimuths;
            }
            other @ (System::Block(_) | System::Frame(_)) => {
                let each = scales.len().div_ceil(SCALES_TIMED).max(1);
                let some: Vec<f64> = scales.iter().copied().skip(timed % each).step_by(each).collect();
                let begin = Instant::now();
                if std::hint::black_box(several(other, &ground, &some, plan.with_free_peak())).is_err() {
                    break;
                }
                let share = some.len().max(1) as f64 / scales.len().max(1) as f64;
                spent += begin.elapsed().div_f64(share) * azimuths;
                seen += 3;
            }
        }
        timed += 1;
        seen += 1;
    }
    let per_row = spent.as_secs_f64() / timed.max(1) as f64;
    Estimate { seconds_one_thread: per_row * axes.rows() as f64, rows_timed: timed }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a fraction of a count")]
fn spread(index: usize, count: usize) -> usize {
    (((index as f64 + 0.5) * STEP).fract() * count as f64) as usize
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
