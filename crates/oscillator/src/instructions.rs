//! The same runs, compiled for more of the processor's instructions.
//!
//! Longer vectors, operations with three operands and more registers save a tenth of the time on real records. The
//! arithmetic is the same, operation by operation, and so are the bits: nothing is fused.

#![allow(unsafe_code)]

use crate::side_by_side::{self, PendingRun};
use crate::sweep::{Peak, Sweep};

/// What this processor is known to have: only [`best`](Self::best) says so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Instructions(Set);

#[derive(Debug, Clone, Copy, PartialEq)]
enum Set {
    Any,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Instructions {
    /// The best that this processor has.
    #[inline]
    pub(crate) fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq");
            if avx512 {
                return Self(Set::Avx512);
            }
            if is_x86_feature_detected!("avx2") {
                return Self(Set::Avx2);
            }
        }
        Self(Set::Any)
    }
}

/// Follow all of `pending` to their ends; see [`follow`](side_by_side::follow).
#[inline]
pub(crate) fn follow<const RUNS: usize, const STIFFNESS: bool>(
    instructions: Instructions,
    sweep: &Sweep<'_>,
    pending: &[PendingRun],
    peaks: &mut [Peak],
) {
    match instructions.0 {
        Set::Any => side_by_side::follow::<RUNS, STIFFNESS>(sweep, pending, peaks),
        // SAFETY: the processor has what the functions are compiled for, since no other value is made.
        #[cfg(target_arch = "x86_64")]
        Set::Avx2 => unsafe { follow_with_avx2::<RUNS, STIFFNESS>(sweep, pending, peaks) },
        #[cfg(target_arch = "x86_64")]
        Set::Avx512 => unsafe { follow_with_avx512::<RUNS, STIFFNESS>(sweep, pending, peaks) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn follow_with_avx2<const RUNS: usize, const STIFFNESS: bool>(
    sweep: &Sweep<'_>,
    pending: &[PendingRun],
    peaks: &mut [Peak],
) {
    side_by_side::follow::<RUNS, STIFFNESS>(sweep, pending, peaks);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq")]
fn follow_with_avx512<const RUNS: usize, const STIFFNESS: bool>(
    sweep: &Sweep<'_>,
    pending: &[PendingRun],
    peaks: &mut [Peak],
) {
    side_by_side::follow::<RUNS, STIFFNESS>(sweep, pending, peaks);
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::problems::shaped_noise;
    use crate::{Excitation, GroundMotion, Oscillator, PostUplift};

    fn available() -> Vec<Instructions> {
        match Instructions::best().0 {
            Set::Any => vec![Instructions(Set::Any)],
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => [Set::Any, Set::Avx2].map(Instructions).to_vec(),
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => [Set::Any, Set::Avx2, Set::Avx512].map(Instructions).to_vec(),
        }
    }

    // Impacts multiply any difference: one operation done otherwise would show.
    #[test]
    fn the_bits_are_the_same_on_any_processor_and_beside_any_other_runs() {
        let scales = [0.6, 1.0, 1.3, 1.7, 2.0, 2.5, 3.0, 4.0, 5.0, 8.0, 10.0];
        let mut impacts = 0;
        for seed in 0..6 {
            let record = shaped_noise(4.0, 2000, seed);
            for (strength, dt_s, post_uplift) in [
                (0.03, 0.01, PostUplift::Zero),
                (0.1, 0.005, PostUplift::Zero),
                (0.3, 0.01, PostUplift::Zero),
                (0.7, 0.02, PostUplift::Zero),
                (0.7, 0.03, PostUplift::Zero),
                (0.3, 0.01, PostUplift::Negative { capacity_m: 0.4 }),
                (0.3, 0.01, PostUplift::Positive { stiffness_per_s2: 2.0 }),
                (0.3, 0.03, PostUplift::Positive { stiffness_per_s2: 20_000.0 }),
                (0.3, 0.02, PostUplift::Negative { capacity_m: 0.01 }),
            ] {
                let ground = GroundMotion::new(Excitation::new(dt_s, &record).unwrap());
                let oscillator = Oscillator::new(strength, 9.81, 0.0005, 0.95, post_uplift).unwrap();
                let sweep = Sweep::new(&oscillator, &ground, true);
                let together = sweep.peaks(&scales);
                for (scale, together) in scales.iter().zip(together) {
                    let few = sweep.peaks(&[2.2, *scale, 0.9])[1];
                    let mut others = vec![sweep.peak(*scale), few];
                    if let Some(interval) = sweep.elastic.first_interval_above(sweep.boundary_m / scale) {
                        let pending = [PendingRun { index: 0, scale: *scale, interval }];
                        for instructions in available() {
                            let mut peak = [Peak { displacement_m: f64::NAN, impacts: 0 }];
                            match post_uplift {
                                PostUplift::Zero => follow::<8, false>(instructions, &sweep, &pending, &mut peak),
                                _ => follow::<8, true>(instructions, &sweep, &pending, &mut peak),
                            }
                            others.extend(peak);
                        }
                    }
                    for other in others {
                        assert_eq!(together.displacement_m.to_bits(), other.displacement_m.to_bits());
                        assert_eq!(together.impacts, other.impacts);
                    }
                    impacts += together.impacts;
                }
            }
        }
        assert!(impacts > 10_000, "{impacts}");
    }
}
