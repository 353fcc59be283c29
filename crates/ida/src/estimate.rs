//! How long a plan will take on this very machine: a spread of its rows, timed.

use std::time::{Duration, Instant};

use uplift_oscillator::GroundMotion;

use crate::analysis::{single, swept};
use crate::plan::Plan;
use crate::system::System;

/// A prediction of the time that a plan takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Seconds on one thread.
    pub seconds_one_thread: f64,
    /// Analysis rows that were timed, of systems that are not swept by one of their runs.
    pub rows_timed: usize,
}

/// Rows timed at least, however small the budget.
const LEAST_ROWS: usize = 16;
/// Steps that leave no region out however early a visit ends: the golden ratio for the rows, √2 for the scale factors,
/// so that the two go their own ways.
const STEPS: [f64; 2] = [0.618_033_988_749_894_9, std::f64::consts::SQRT_2 - 1.0];

/// Time rows of `plan` spread over motions and systems until `budget` is spent, and extrapolate.
///
/// Of a system that is not swept together a single run stands for its row: a row of an expensive one would take the
/// budget many times over.
pub fn estimate(plan: &Plan<'_>, budget: Duration) -> Estimate {
    let axes = plan.axes();
    let start = Instant::now();
    let mut spent = Duration::ZERO;
    let mut timed = 0;
    while timed < axes.rows() && (timed < LEAST_ROWS || start.elapsed() < budget) {
        let (motion, system) = axes.of_row(spread(timed, axes.rows(), STEPS[0]));
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
            one_by_one @ (System::Block(_) | System::Frame(_)) => {
                let begin = Instant::now();
                let scale = scales[spread(timed, scales.len(), STEPS[1])];
                if std::hint::black_box(single(one_by_one, &ground, scale, plan.with_free_peak())).is_err() {
                    break;
                }
                spent += begin.elapsed() * azimuths * u32::try_from(scales.len()).unwrap_or(u32::MAX);
            }
        }
        timed += 1;
    }
    let per_row = spent.as_secs_f64() / timed.max(1) as f64;
    Estimate { seconds_one_thread: per_row * axes.rows() as f64, rows_timed: timed }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a fraction of a count")]
fn spread(index: usize, count: usize, step: f64) -> usize {
    (((index as f64 + 0.5) * step).fract() * count as f64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_visit_reaches_every_region() {
        for step in STEPS {
            let mut seen = [false; 10];
            for index in 0..20 {
                seen[spread(index, 10, step)] = true;
            }
            assert!(seen.iter().all(|&seen| seen), "{step}");
            assert!((0..1000).all(|index| spread(index, 7, step) < 7));
        }
    }
}
