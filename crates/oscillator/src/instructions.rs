//! Runs compiled for the processor's instructions.

use uplift_instructions::{Instructions, Vectors, Work};

use crate::side_by_side::{self, PendingRun};
use crate::sweep::{Peak, Sweep};

struct Following<'a, const RUNS: usize, const STIFFNESS: bool> {
    sweep: &'a Sweep<'a>,
    pending: &'a [PendingRun],
    peaks: &'a mut [Peak],
}

impl<const RUNS: usize, const STIFFNESS: bool> Work for Following<'_, RUNS, STIFFNESS> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) {
        side_by_side::follow::<V, RUNS, STIFFNESS>(vectors, self.sweep, self.pending, self.peaks);
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
    instructions.run(Following::<RUNS, STIFFNESS> { sweep, pending, peaks });
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use uplift_instructions::InstructionSet;

    use super::*;
    use crate::problems::shaped_noise;
    use crate::{Excitation, GroundMotion, Oscillator, PostUplift};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        // Long enough for all widths of runs side by side, with every slope after uplift.
        #[test]
        fn every_set_gives_the_bits_of_the_portable_one(
            seed in 0_u64..1_000_000,
            samples in 20_usize..600,
            strength in 0.0_f64..1.2,
            dt_s in 0.001_f64..0.05,
            restitution in 0.0_f64..=1.0,
            slope in 0_u8..3,
            size in 0.001_f64..2.0,
            scales in prop::collection::vec(0.1_f64..20.0, 1..20),
            with_free_peak: bool,
        ) {
            let record = shaped_noise(4.0, samples, seed);
            let ground = GroundMotion::new(Excitation::new(dt_s, &record).unwrap());
            let post_uplift = match slope {
                0 => PostUplift::Zero,
                1 => PostUplift::Negative { capacity_m: size },
                _ => PostUplift::Positive { stiffness_per_s2: 10.0 / size },
            };
            let oscillator = Oscillator::new(strength, 9.81, 0.0005, restitution, post_uplift).unwrap();
            let sweep = Sweep::new(&oscillator, &ground, with_free_peak);
            let bits = |instructions: Instructions| -> Vec<(u64, u32)> {
                let peaks = sweep.peaks_with(instructions, &scales);
                peaks.iter().map(|peak| (peak.displacement_m.to_bits(), peak.impacts)).collect()
            };
            let portable = bits(Instructions::from_set(InstructionSet::Portable).unwrap());
            for instructions in Instructions::available() {
                prop_assert_eq!(&bits(instructions), &portable, "{:?}", instructions);
            }
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
                        for instructions in Instructions::available() {
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
