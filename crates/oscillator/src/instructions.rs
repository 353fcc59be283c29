//! The same runs, compiled for more of the processor's instructions.
//!
//! Longer vectors, operations with three operands and more registers save a tenth of the time on real records. The
//! arithmetic is the same, operation by operation, and so are the bits: nothing is fused.

#![allow(unsafe_code)]

use std::fmt;
use std::sync::OnceLock;

use crate::error::OscillatorError;
use crate::side_by_side::{self, PendingRun};
use crate::sweep::{Peak, Sweep};

/// The variable of the environment that names the set to be used, in place of the best one.
pub const INSTRUCTIONS_VARIABLE: &str = "UPLIFT_INSTRUCTIONS";

/// A set of instructions that the runs are compiled for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InstructionSet {
    /// What every processor of the architecture has.
    Portable,
    /// AVX2 of x86-64.
    Avx2,
    /// AVX-512 F, VL and DQ of x86-64.
    Avx512,
}

impl InstructionSet {
    /// Every set, the shorter vectors first.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// Its word in [`INSTRUCTIONS_VARIABLE`].
    pub fn key(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// The sets of this processor, the best last.
    pub fn available() -> Vec<Self> {
        Self::ALL.into_iter().filter(|set| Instructions::from_set(*set).is_some()).collect()
    }

    /// The set that runs are followed with: that of [`INSTRUCTIONS_VARIABLE`] if it is set, else the best of this
    /// processor. The variable is looked at once in the life of the program.
    ///
    /// # Errors
    /// [`OscillatorError::Instructions`] where the variable holds another word, or a set that this processor lacks;
    /// runs are followed with the best one then.
    pub fn chosen() -> Result<Self, OscillatorError> {
        chosen().clone()
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.key())
    }
}

fn chosen() -> &'static Result<InstructionSet, OscillatorError> {
    static CHOSEN: OnceLock<Result<InstructionSet, OscillatorError>> = OnceLock::new();
    CHOSEN.get_or_init(|| match std::env::var_os(INSTRUCTIONS_VARIABLE) {
        None => Ok(Instructions::best().0),
        Some(word) => named(&word.to_string_lossy()),
    })
}

/// The set of this processor that `word` names.
fn named(word: &str) -> Result<InstructionSet, OscillatorError> {
    let available = InstructionSet::available();
    available.iter().find(|set| set.key() == word).copied().ok_or_else(|| OscillatorError::Instructions {
        variable: INSTRUCTIONS_VARIABLE,
        wanted: word.to_owned(),
        available: available.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
    })
}

/// A set that this processor is known to have: only [`of`](Self::of) says so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Instructions(InstructionSet);

impl Instructions {
    /// `set`, if this processor has it.
    pub(crate) fn from_set(set: InstructionSet) -> Option<Self> {
        #[cfg(target_arch = "x86_64")]
        let has = match set {
            InstructionSet::Portable => true,
            InstructionSet::Avx2 => is_x86_feature_detected!("avx2"),
            InstructionSet::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512dq")
            }
        };
        #[cfg(not(target_arch = "x86_64"))]
        let has = set == InstructionSet::Portable;
        has.then_some(Self(set))
    }

    /// The best that this processor has.
    fn best() -> Self {
        let best = InstructionSet::ALL.into_iter().rev().find_map(Self::from_set);
        best.unwrap_or(Self(InstructionSet::Portable))
    }

    /// What runs are followed with; see [`InstructionSet::chosen`].
    pub(crate) fn chosen() -> Self {
        chosen().as_ref().ok().and_then(|set| Self::from_set(*set)).unwrap_or_else(Self::best)
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
        // SAFETY: the processor has what the functions are compiled for, since no other value is made.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { follow_with_avx2::<RUNS, STIFFNESS>(sweep, pending, peaks) },
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { follow_with_avx512::<RUNS, STIFFNESS>(sweep, pending, peaks) },
        _ => side_by_side::follow::<RUNS, STIFFNESS>(sweep, pending, peaks),
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
    use proptest::prelude::*;

    use super::*;
    use crate::problems::shaped_noise;
    use crate::{Excitation, GroundMotion, Oscillator, PostUplift};

    fn available() -> Vec<Instructions> {
        InstructionSet::available().into_iter().map(|set| Instructions::from_set(set).unwrap()).collect()
    }

    #[test]
    fn a_word_is_a_set_of_this_processor_or_an_error() {
        for set in InstructionSet::ALL {
            let available = InstructionSet::available().contains(&set);
            assert_eq!(named(set.key()).ok(), available.then_some(set));
        }
        for word in ["", "AVX2", "avx-512", "sse", "best"] {
            let error = named(word).unwrap_err().to_string();
            assert!(error.contains("UPLIFT_INSTRUCTIONS") && error.contains(&format!("\"{word}\"")), "{error}");
            assert!(error.contains("portable"), "{error}");
        }
        assert_eq!(InstructionSet::available()[0], InstructionSet::Portable);
    }

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
            let portable = bits(Instructions(InstructionSet::Portable));
            for instructions in available() {
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
