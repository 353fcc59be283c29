//! When a chattering block comes to rest.
//!
//! A block that loses velocity at every impact makes infinitely many of them in a finite time, then rests. The motion
//! is cut short only where this is certain, so that no threshold enters the result: [`RestRule::comes_to_rest`]
//! proves that from the present impact on all rebounds are over before the ground could move the block again, and
//! that none is as high as the peak so far. Nothing but the number of impacts, which is infinite, depends on the
//! moment at which that is proved.
//!
//! The proof. On the window w let |A| ≤ a < tan α and |dA/dt| ≤ a', and m = sin α − a cos α > 0. The block leaves the
//! ground with velocity v.
//! 1. While x ≤ x̂ = v²/(p² m), it is drawn back with at least p² (m − (1 + a) x̂), which is d = p² m/2 or more if
//!    v² (1 + a) ≤ p² m²/2. Then it indeed rises by no more than v²/(2d) = x̂, and is back within 2v/d.
//! 2. Rising and falling through the same x, it is drawn by forces that differ by p² a' (2v/d) at most. So it lands
//!    with v √(1 + ε) at most, ε = 2 p² a' v/d², and leaves with ϱ v, ϱ = r √(1 + ε).
//! 3. If ϱ < 1 all of this holds for the next rebound, with ϱ v for v: the velocities are bounded by a geometric
//!    series, and so are the durations, whose sum is at most 2v/(d (1 − ϱ)).
//!
//! If that is no longer than w, the block is at rest by then, and stays so within w, as |A| < tan α.

use crate::series::Forcing;

/// How it is decided that the block rests.
#[derive(Debug, Clone, Copy)]
pub(crate) enum RestRule {
    /// By proof.
    Proven,
    /// Below a velocity \[rad/s\]: to compare with.
    #[cfg(test)]
    Below(f64),
}

/// What the proof needs of the block.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rebound {
    /// p² \[1/s²\].
    pub(crate) p_squared: f64,
    /// tan α.
    pub(crate) tangent: f64,
    /// cos α.
    pub(crate) cosine: f64,
    /// Coefficient of restitution r.
    pub(crate) restitution: f64,
    /// Velocity v with which the block leaves the ground \[rad/s\].
    pub(crate) velocity: f64,
    /// Largest rotation so far \[rad\].
    pub(crate) peak: f64,
}

impl RestRule {
    /// Whether the block surely comes to rest on a step of `step_s`, under `forcing` in units of g, without a new peak.
    pub(crate) fn comes_to_rest(self, block: &Rebound, forcing: &Forcing, step_s: f64) -> bool {
        match self {
            Self::Proven => is_proven(block, forcing, step_s),
            #[cfg(test)]
            Self::Below(velocity) => block.velocity < velocity && forcing.value(0.0).abs() < block.tangent,
        }
    }
}

fn is_proven(block: &Rebound, forcing: &Forcing, step_s: f64) -> bool {
    let &Rebound { p_squared, tangent, cosine, restitution, velocity: v, peak } = block;
    let slack = cosine * (tangent - forcing.value(0.0).abs());
    if slack <= 0.0 || restitution >= 1.0 {
        return false;
    }
    // the time that it takes under constant shaking, with a margin for the bounds to be wider
    let window = step_s.min(8.0 * v / (p_squared * slack * (1.0 - restitution)));
    let forcing = forcing.stretched(window / step_s);
    let bound = forcing.bound();
    let m = cosine * (tangent - bound);
    if m <= 0.0 || v * v * (1.0 + bound) > 0.5 * p_squared * m * m {
        return false;
    }
    let d = 0.5 * p_squared * m;
    let gain = 2.0 * p_squared * (forcing.slope_bound() / window) * v / (d * d);
    let ratio = restitution * (1.0 + gain).sqrt();
    ratio < 1.0 && 2.0 * v <= window * d * (1.0 - ratio) && v * v <= 2.0 * d * peak
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::print_stdout)]
    use super::*;
    use crate::block::RockingBlock;
    use crate::excitation::Excitation;
    use crate::observer::Unobserved;
    use crate::response::{BlockResponse, FreeRocking, run};
    use uplift_motion::Accelerogram;

    /// Bursts of noise, each stronger than the one before, with quiet in between, m/s²: the block rocks, chatters,
    /// rests, and has its peak in the last.
    fn bursts(seed: u64) -> Accelerogram {
        let mut state = seed;
        let samples = (0..3000_u32).map(|i| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let noise = (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
            let strength = if (i / 150) % 5 == 0 { 6.0 + 3.0 * f64::from(i / 750) } else { 0.3 };
            strength * noise
        });
        Accelerogram::new(0.01, samples.collect()).unwrap()
    }

    fn response(block: &RockingBlock, record: &Accelerogram, rule: RestRule) -> BlockResponse {
        let excitation = Some(Excitation::from(record));
        run(block, excitation, 0.0, FreeRocking::FirstPeak, rule, Unobserved).unwrap().0
    }

    #[test]
    fn the_rule_does_not_enter_the_result() {
        let (mut largest, mut cut_short, mut coarse) = (0.0_f64, 0, 0.0_f64);
        for seed in 0..12 {
            let record = bursts(seed);
            for alpha in [0.2, 0.3, 0.4] {
                let block = RockingBlock::new(1.0 + seed as f64, alpha).unwrap();
                let proven = response(&block, &record, RestRule::Proven);
                assert!(proven.rotation_rad > 0.0 && !proven.chatter_was_cut);
                let deviation = |rule| {
                    let below = response(&block, &record, rule);
                    ((below.rotation_rad / proven.rotation_rad - 1.0).abs(), below.impacts > proven.impacts)
                };
                for velocity in [1e-12, 1e-15] {
                    let (deviation, is_longer) = deviation(RestRule::Below(velocity));
                    largest = largest.max(deviation);
                    cut_short += usize::from(is_longer);
                }
                // a careless threshold does enter it
                coarse = coarse.max(deviation(RestRule::Below(1e-3)).0);
            }
        }
        println!("deviation {largest:.1e}, with a threshold of 1e-3 rad/s {coarse:.1e}; {cut_short} of 72 cut short");
        assert!(largest < 1e-11 && coarse > 1e-5 && cut_short > 36, "{largest:e} {coarse:e} {cut_short}");
    }

    fn rebound(velocity: f64) -> Rebound {
        Rebound {
            p_squared: 4.0,
            tangent: 0.2_f64.tan(),
            cosine: 0.2_f64.cos(),
            restitution: 0.94,
            velocity,
            peak: 0.01,
        }
    }

    fn linear(begin: f64, change: f64) -> Forcing {
        let mut forcing = Forcing::default();
        forcing.push(begin);
        forcing.push(change);
        forcing
    }

    #[test]
    fn nothing_is_proven_that_is_not_so() {
        let proven = |v: f64, begin: f64, change: f64| is_proven(&rebound(v), &linear(begin, change), 0.01);
        assert!(proven(1e-6, 0.05, 0.01));
        assert!(!proven(0.05, 0.05, 0.01)); // too fast to be over in the interval
        assert!(!proven(1e-6, 0.25, 0.0)); // the ground moves it
        assert!(!proven(1e-6, 0.2027, 0.0)); // next to nothing draws it down
        assert!(proven(1e-9, 0.05, 0.9)); // long over when the ground will move it
        assert!(!proven(1e-4, 0.05, 0.9));
        let elastic = Rebound { restitution: 1.0, ..rebound(1e-9) };
        assert!(!is_proven(&elastic, &linear(0.0, 0.0), 0.01));
        let first = Rebound { peak: 1e-20, ..rebound(1e-6) };
        assert!(!is_proven(&first, &linear(0.0, 0.0), 0.01)); // the rebound is the peak
    }
}
