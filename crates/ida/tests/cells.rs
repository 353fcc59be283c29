//! Going on from what is known, and parts of a plan: the bits are those of an undisturbed analysis.
#![allow(clippy::unwrap_used)]

use std::sync::Mutex;

use proptest::prelude::*;
use uplift_ida::{Cells, EdpArray, NUMERICS, Part, Plan, StripeRecord, Unwatched, analyse, complete};
use uplift_motion::Accelerogram;
use uplift_oscillator::Oscillator;

const LEVELS: [f64; 5] = [0.1, 0.3, 0.7, 1.5, 4.0];

/// Noise from integers alone, so that it is the same on every machine.
fn noise(seed: u32) -> Accelerogram {
    let mut state = seed;
    let values = (0..900).map(|i: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let swell = f64::from(i.min(900 - i)) / 450.0;
        (f64::from(state >> 8) / f64::from(1_u32 << 23) - 1.0) * 6.0 * swell
    });
    Accelerogram::new(0.01, values.collect()).unwrap()
}

struct Case {
    accelerograms: Vec<Accelerogram>,
    oscillators: Vec<Oscillator>,
}

impl Case {
    fn new() -> Self {
        Self {
            accelerograms: (1..=3).map(noise).collect(),
            oscillators: [0.05, 0.2, 0.4, 0.8].map(|strength| Oscillator::zsbe(strength).unwrap()).to_vec(),
        }
    }

    fn plan(&self) -> Plan<'_> {
        let record = |accelerogram| StripeRecord { id: "noise", accelerogram, intensity: 1.0 };
        Plan::new(self.accelerograms.iter().map(record).collect(), &self.oscillators, &LEVELS, true).unwrap()
    }
}

fn same_bits(one: &EdpArray, other: &EdpArray) -> bool {
    let bits = |array: &EdpArray| array.edp_m().iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    bits(one) == bits(other) && one.impacts() == other.impacts() && one.shape() == other.shape()
}

#[test]
fn what_is_known_is_not_computed_again() {
    let case = Case::new();
    let plan = case.plan();
    let whole = analyse(&plan, &Unwatched).unwrap();
    proptest!(ProptestConfig::with_cases(24), |(known in prop::collection::vec(any::<bool>(), 60))| {
        let mut cells = Cells::unknown(&plan);
        for (index, _) in known.iter().enumerate().filter(|(_, known)| **known) {
            cells.set([index / 20, index / 5 % 4, index % 5], whole.edp_m()[index], whole.impacts()[index]);
        }
        let count = known.iter().filter(|known| **known).count() as u64;
        prop_assert_eq!(cells.count(), count);
        let kept = Mutex::new(Vec::new());
        let done = complete(&plan, cells, Part::WHOLE, &Unwatched, &|piece| {
            kept.lock().unwrap().push((piece.record, piece.strength, piece.edp_m.to_vec()));
        });
        prop_assert!(same_bits(&done.unwrap().complete().unwrap(), &whole));
        // exactly the rows that lacked something
        let mut rows: Vec<(usize, usize)> = kept.lock().unwrap().iter().map(|(record, strength, edp_m)| {
            let start = (record * 4 + strength) * 5;
            assert_eq!(edp_m, &whole.edp_m()[start..start + 5]);
            (*record, *strength)
        }).collect();
        rows.sort_unstable();
        let lacking = (0..12).filter(|row| known[row * 5..row * 5 + 5].iter().any(|known| !known));
        prop_assert_eq!(rows, lacking.map(|row| (row / 4, row % 4)).collect::<Vec<_>>());
    });
}

// A value put in by hand is believed: what is known is not looked at.
#[test]
fn what_is_known_is_taken_as_it_is() {
    let case = Case::new();
    let plan = case.plan();
    let mut cells = Cells::unknown(&plan);
    cells.set([1, 2, 3], 123.0, 45);
    let done = complete(&plan, cells, Part::WHOLE, &Unwatched, &|_| {}).unwrap().complete().unwrap();
    let index = (4 + 2) * 5 + 3;
    assert_eq!((done.edp_m()[index], done.impacts()[index]), (123.0, 45));
}

#[test]
fn parts_make_the_whole() {
    let case = Case::new();
    let plan = case.plan();
    let whole = analyse(&plan, &Unwatched).unwrap();
    for count in [1, 2, 5, 12, 20] {
        let mut joined = Cells::unknown(&plan);
        for index in 0..count {
            let part = Part { index, count };
            let rows = Mutex::new(Vec::new());
            let cells = complete(&plan, Cells::unknown(&plan), part, &Unwatched, &|piece| {
                rows.lock().unwrap().push((piece.record, piece.strength, piece.edp_m.to_vec(), piece.impacts.to_vec()));
            });
            let rows = rows.into_inner().unwrap();
            assert_eq!(cells.unwrap().count(), 5 * rows.len() as u64);
            for (record, strength, edp_m, impacts) in rows {
                assert!(!joined.is_row_known(record, strength), "two parts have the same piece");
                for level in 0..5 {
                    joined.set([record, strength, level], edp_m[level], impacts[level]);
                }
            }
        }
        assert!(same_bits(&joined.complete().unwrap(), &whole), "{count} parts");
    }
}

// Whoever changes these bits raises NUMERICS: results kept by an earlier version are then not mixed with new ones.
#[test]
#[cfg(target_arch = "x86_64")]
fn the_version_of_the_numbers_goes_with_their_bits() {
    let case = Case::new();
    let whole = analyse(&case.plan(), &Unwatched).unwrap();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for word in whole.edp_m().iter().map(|value| value.to_bits()).chain(whole.impacts().iter().map(|&n| u64::from(n))) {
        hash = (hash ^ word).wrapping_mul(0x100_0000_01b3);
    }
    assert_eq!((NUMERICS, format!("{hash:016x}").as_str()), (3, "542a6417ac2eb4cd"));
}
