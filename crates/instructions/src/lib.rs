//! The same arithmetic, compiled for more of the processor's instructions.
//!
//! Longer vectors, operations with three operands and more registers save a quarter of the time of oscillators, and
//! most of that of blocks. Operation by operation nothing else is done, nothing is fused, and the bits are the same.

#![allow(unsafe_code)]

mod vectors;

use std::fmt;
use std::sync::OnceLock;

use thiserror::Error;

#[cfg(target_arch = "x86_64")]
use vectors::{Avx2, Avx512};
pub use vectors::{FEW, LANES, Numbers, Portable, Vectors};

/// The variable of the environment that names the set to be used, in place of the best one.
pub const INSTRUCTIONS_VARIABLE: &str = "UPLIFT_INSTRUCTIONS";

/// A set of instructions that is asked for by the environment, and is unknown or not of this processor.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "{INSTRUCTIONS_VARIABLE} is \"{wanted}\": this processor has {available}; take one of these, or leave the variable \
     unset"
)]
pub struct InstructionsError {
    /// The variable's value.
    pub wanted: String,
    /// The sets of this processor.
    pub available: String,
}

/// A set of instructions that work is compiled for.
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
        Instructions::available().into_iter().map(|instructions| instructions.0).collect()
    }

    /// The set that runs are followed with: that of [`INSTRUCTIONS_VARIABLE`] if it is set, else the best of this
    /// processor. The variable is looked at once in the life of the program.
    ///
    /// # Errors
    /// [`InstructionsError`] where the variable holds another word, or a set that this processor lacks;
    /// runs are followed with the best one then.
    pub fn chosen() -> Result<Self, InstructionsError> {
        chosen().clone()
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.key())
    }
}

fn chosen() -> &'static Result<InstructionSet, InstructionsError> {
    static CHOSEN: OnceLock<Result<InstructionSet, InstructionsError>> = OnceLock::new();
    CHOSEN.get_or_init(|| match std::env::var_os(INSTRUCTIONS_VARIABLE) {
        None => Ok(Instructions::best().0),
        Some(word) => named(&word.to_string_lossy()),
    })
}

/// The set of this processor that `word` names.
fn named(word: &str) -> Result<InstructionSet, InstructionsError> {
    let available = InstructionSet::available();
    available.iter().find(|set| set.key() == word).copied().ok_or_else(|| InstructionsError {
        wanted: word.to_owned(),
        available: available.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
    })
}

/// A set that this processor is known to have: only [`from_set`](Self::from_set) says so.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Instructions(InstructionSet);

/// What can be compiled for each set.
pub trait Work {
    /// What comes out.
    type Output;

    /// Does it; `vectors` are those of the set. Marked `#[inline(always)]`, as all that it calls in its inner loops:
    /// what is not inlined is compiled for the instructions that every processor has.
    fn run<V: Vectors>(self, vectors: V) -> Self::Output;
}

impl Instructions {
    /// `set`, if this processor has it.
    pub fn from_set(set: InstructionSet) -> Option<Self> {
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

    /// Every set that this processor has, the best last.
    pub fn available() -> Vec<Self> {
        InstructionSet::ALL.into_iter().filter_map(Self::from_set).collect()
    }

    /// The best that this processor has.
    fn best() -> Self {
        let best = InstructionSet::ALL.into_iter().rev().find_map(Self::from_set);
        best.unwrap_or(Self(InstructionSet::Portable))
    }

    /// What runs are followed with; see [`InstructionSet::chosen`].
    pub fn chosen() -> Self {
        chosen().as_ref().ok().and_then(|set| Self::from_set(*set)).unwrap_or_else(Self::best)
    }

    /// Does `work` with these instructions.
    #[inline]
    pub fn run<W: Work>(self, work: W) -> W::Output {
        match self.0 {
            // SAFETY: the processor has what the functions are compiled for, since no other value is made.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => unsafe { run_with_avx2(work) },
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => unsafe { run_with_avx512(work) },
            _ => work.run(Portable),
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_with_avx2<W: Work>(work: W) -> W::Output {
    // SAFETY: the caller has seen that the processor has the set
    work.run(unsafe { Avx2::new() })
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq")]
fn run_with_avx512<W: Work>(work: W) -> W::Output {
    // SAFETY: the caller has seen that the processor has the set
    work.run(unsafe { Avx512::new() })
}

/// `f64::max` without its care for NaN, which costs in the inner loops; a NaN in `a` gives `b`.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// `f64::min` likewise.
#[inline(always)]
pub fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// All numbers joined into one by halves, so that the operations do not wait for each other; their number is a power of
/// two.
#[inline(always)]
pub fn by_halves<const N: usize>(mut numbers: [f64; N], join: impl Fn(f64, f64) -> f64) -> f64 {
    let mut half = N / 2;
    while half > 0 {
        for place in 0..half {
            numbers[place] = join(numbers[place], numbers[place + half]);
        }
        half /= 2;
    }
    numbers[0]
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
