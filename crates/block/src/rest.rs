//! When a chattering block comes to rest: by proof, and, to compare with, below a velocity.

use uplift_taylor::{Forcing, Rebound};

/// The ground does not move up and down.
static STILL: Forcing = Forcing::none();

/// How it is decided that the block rests.
#[derive(Debug, Clone, Copy)]
pub(crate) enum RestRule {
    /// By proof.
    Proven,
    /// Below a velocity \[rad/s\]: to compare with.
    #[cfg(test)]
    Below(f64),
}

impl RestRule {
    /// Whether the block surely comes to rest on a step of `step_s`, under `forcing` in units of g, without a new peak.
    pub(crate) fn comes_to_rest(self, block: &Rebound, forcing: &Forcing, step_s: f64) -> bool {
        match self {
            Self::Proven => block.is_over_within(step_s, forcing, &STILL),
            #[cfg(test)]
            Self::Below(velocity) => block.velocity < velocity && forcing.value(0.0).abs() < block.tangent,
        }
    }
}

#[cfg(test)]
mod tests {
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
}
