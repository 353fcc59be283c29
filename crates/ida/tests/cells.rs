//! Going on from what is known, and shards of a plan: the bits are those of an undisturbed analysis.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use proptest::prelude::*;
use uplift_block::RockingBlock;
use uplift_ida::{
    AnalysisRow, Cells, IdaError, NUMERICS, Plan, Shard, StripeRecord, System, Unwatched, Watch, analyse, complete,
    estimate,
};
use uplift_motion::Accelerogram;
use uplift_oscillator::{Oscillator, PostUplift};

use crate::bits;

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
    systems: Vec<System>,
}

impl Case {
    fn new() -> Self {
        Self {
            accelerograms: (1..=3).map(noise).collect(),
            systems: [0.05, 0.2, 0.4, 0.8]
                .map(|strength| System::Oscillator(Oscillator::zsbe(strength).unwrap()))
                .into(),
        }
    }

    /// Oscillators and blocks in one plan.
    fn with_blocks() -> Self {
        let mut case = Self::new();
        for (place, slenderness) in [(1, 0.2), (3, 0.1)] {
            case.systems[place] = System::Block(RockingBlock::new(1.0, slenderness).unwrap());
        }
        case
    }

    fn plan(&self) -> Plan<'_> {
        let record = |accelerogram| StripeRecord { id: "noise", accelerogram, intensity: 1.0 };
        Plan::stripes(self.accelerograms.iter().map(record).collect(), &self.systems, &LEVELS, true).unwrap()
    }
}

/// A finished row that outlives the analysis.
type Kept = (usize, usize, Vec<f64>, Vec<u32>);

fn kept(row: &AnalysisRow<'_>) -> Kept {
    (row.motion, row.system, row.displacement_m.to_vec(), row.impacts.to_vec())
}

#[test]
fn known_cells_are_not_computed_again() {
    for case in [Case::new(), Case::with_blocks()] {
        let plan = case.plan();
        let whole = analyse(&plan, &Unwatched).unwrap();
        proptest!(ProptestConfig::with_cases(24), |(known in prop::collection::vec(any::<bool>(), 60))| {
            let mut cells = Cells::unknown(&plan);
            for (index, _) in known.iter().enumerate().filter(|(_, known)| **known) {
                let cell = [index / 20, index / 5 % 4, index % 5];
                cells.set(cell, whole.displacement_m()[index], whole.impacts()[index]);
            }
            let count = known.iter().filter(|known| **known).count() as u64;
            prop_assert_eq!(cells.count(), count);
            let rows = Mutex::new(Vec::new());
            let done = complete(&plan, cells, Shard::WHOLE, &Unwatched, &|row| rows.lock().unwrap().push(kept(row)));
            prop_assert_eq!(bits(&done.unwrap().complete().unwrap()), bits(&whole));
            // exactly the rows that lacked something
            let mut rows: Vec<(usize, usize)> = rows.into_inner().unwrap().into_iter().map(|(motion, system, m, _)| {
                assert_eq!(m, whole.row_m(motion, system));
                (motion, system)
            }).collect();
            rows.sort_unstable();
            let lacking = (0..12).filter(|row| known[row * 5..row * 5 + 5].iter().any(|known| !known));
            prop_assert_eq!(rows, lacking.map(|row| (row / 4, row % 4)).collect::<Vec<_>>());
        });
    }
}

/// Any division into shards, each with any rows of its own known from before, on any number of threads.
#[test]
fn any_division_and_any_known_rows_give_the_same_bits() {
    let case = Case::with_blocks();
    let plan = case.plan();
    let whole = analyse(&plan, &Unwatched).unwrap();
    assert!(whole.displacement_m().iter().any(|value| value.is_infinite()));
    assert!((0..4).all(|system| whole.system_m(system).iter().any(|&value| value > 0.0 && value.is_finite())));
    let split = (1_u64..21, prop::collection::vec(any::<bool>(), 12), 1_usize..4);
    proptest!(ProptestConfig::with_cases(32), |((count, known, threads) in split)| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut joined = Cells::unknown(&plan);
        for index in 0..count {
            let mut cells = Cells::unknown(&plan);
            for row in (0..12).filter(|row| known[*row]) {
                let at = row * 5..row * 5 + 5;
                let (displacement_m, impacts) = (&whole.displacement_m()[at.clone()], &whole.impacts()[at]);
                let (motion, system) = plan.axes().motion_and_system(row);
                let fits = cells.set_row(&AnalysisRow { motion, system, displacement_m, impacts });
                prop_assert!(fits);
            }
            let rows = Mutex::new(Vec::new());
            let shard = Shard { index, count };
            let keep = |row: &AnalysisRow<'_>| rows.lock().unwrap().push(kept(row));
            let cells = pool.install(|| complete(&plan, cells, shard, &Unwatched, &keep)).unwrap();
            for (motion, system, displacement_m, impacts) in rows.into_inner().unwrap() {
                prop_assert!(cells.is_row_known(motion, system) && !joined.is_row_known(motion, system));
                joined.set_row(&AnalysisRow { motion, system, displacement_m: &displacement_m, impacts: &impacts });
            }
        }
        prop_assert_eq!(joined.count(), 5 * known.iter().filter(|known| !**known).count() as u64);
        let rest = complete(&plan, joined, Shard::WHOLE, &Unwatched, &|_| {}).unwrap();
        prop_assert_eq!(bits(&rest.complete().unwrap()), bits(&whole));
    });
}

// A value put in by hand is believed: what is known is not looked at.
#[test]
fn known_cells_keep_their_values() {
    let case = Case::new();
    let plan = case.plan();
    let mut cells = Cells::unknown(&plan);
    cells.set([1, 2, 3], 123.0, 45);
    assert!(!cells.set_row(&AnalysisRow { motion: 0, system: 0, displacement_m: &[1.0], impacts: &[1] }));
    let done = complete(&plan, cells, Shard::WHOLE, &Unwatched, &|_| {}).unwrap().complete().unwrap();
    let index = (4 + 2) * 5 + 3;
    assert_eq!((done.at_m([1, 2, 3]), done.displacement_m()[index], done.impacts()[index]), (123.0, 123.0, 45));
}

// What has no run is not computed, and does not touch what has: not one after the other, not in shards, not resumed.
#[test]
fn a_motion_is_run_where_it_has_a_factor() {
    let case = Case::with_blocks();
    let plan = case.plan();
    let whole = analyse(&plan, &Unwatched).unwrap();
    let mut motions = plan.motions().to_vec();
    let is_run = |motion: usize, scale: usize| !(motion + scale).is_multiple_of(3);
    for (motion, scaled) in motions.iter_mut().enumerate() {
        for (scale, factor) in scaled.scales.iter_mut().enumerate().filter(|(scale, _)| !is_run(motion, *scale)) {
            *factor = if scale.is_multiple_of(2) { f64::NAN } else { -f64::NAN };
        }
    }
    assert!(Plan::scaled(motions.clone(), plan.systems(), plan.with_free_peak()).is_err());
    let gaps = Plan::selected(motions.clone(), plan.systems(), plan.with_free_peak()).unwrap();
    let axes = gaps.axes();
    let cells = (0..axes.motions).flat_map(|motion| (0..axes.scales).map(move |scale| (motion, scale)));
    let runs = cells.clone().filter(|(motion, scale)| is_run(*motion, *scale)).count() * axes.systems;
    assert_eq!(gaps.analyses(), runs as u64);
    let unknown = Cells::unknown(&gaps);
    assert_eq!((unknown.count(), unknown.known_in_row(0, 0), unknown.is_row_known(0, 0)), (0, 0, false));

    let finished = AtomicU64::new(0);
    let found = complete(&gaps, unknown, Shard::WHOLE, &Counting(&finished), &|_| {}).unwrap();
    assert_eq!((finished.into_inner(), found.count()), (runs as u64, runs as u64));
    let found = found.complete().unwrap();
    for ((motion, scale), system) in cells.flat_map(|cell| (0..axes.systems).map(move |system| (cell, system))) {
        let cell = axes.cell([motion, system, scale]);
        let (peak, impacts) = (found.displacement_m()[cell], found.impacts()[cell]);
        if is_run(motion, scale) {
            assert_eq!(peak.to_bits(), whole.displacement_m()[cell].to_bits());
            assert_eq!(impacts, whole.impacts()[cell]);
        } else {
            assert!(peak.is_nan() && impacts == 0);
        }
    }
    assert!(estimate(&gaps, std::time::Duration::ZERO).seconds_one_thread > 0.0);
    motions[0].scales.fill(f64::NAN);
    let error = Plan::selected(motions, plan.systems(), true).unwrap_err();
    assert!(matches!(error, IdaError::NoRun { .. }), "{error}");
}

// Systems of its own under every motion: each peak is that of the same motion and system among all of them.
#[test]
fn every_motion_shakes_its_own_systems() {
    let case = Case::with_blocks();
    let plan = case.plan();
    let whole = analyse(&plan, &Unwatched).unwrap();
    let of_all = plan.axes();
    // two systems a motion, by their positions among all
    let own = |motion: usize, place: usize| (3 * motion + 2 * place) % of_all.systems;
    let places = (0..of_all.motions).flat_map(|motion| [own(motion, 0), own(motion, 1)]);
    let systems: Vec<System> = places.map(|system| plan.systems()[system].clone()).collect();
    let apart = || Plan::scaled(plan.motions().to_vec(), &systems, plan.with_free_peak()).unwrap();
    let apart_plan = apart().with_own_systems().unwrap();
    let axes = apart_plan.axes();
    assert_eq!((axes.motions, axes.systems), (of_all.motions, 2));
    assert_eq!(apart_plan.analyses(), (2 * of_all.motions * of_all.scales) as u64);
    let found = analyse(&apart_plan, &Unwatched).unwrap();
    for (motion, place) in (0..axes.motions).flat_map(|motion| [(motion, 0), (motion, 1)]) {
        assert_eq!(apart_plan.system(motion, place), &plan.systems()[own(motion, place)]);
        assert_eq!(found.row_m(motion, place), whole.row_m(motion, own(motion, place)));
    }
    assert!(estimate(&apart_plan, std::time::Duration::ZERO).seconds_one_thread > 0.0);
    let twice = apart().multiplied(&[1.0, 1.0]).unwrap().with_own_systems().unwrap();
    assert_eq!(twice.multiplied(&[1.0]).unwrap().axes().systems, 2);
    let odd = Plan::scaled(plan.motions().to_vec(), &systems[1..], true).unwrap().with_own_systems();
    assert!(matches!(odd.unwrap_err(), IdaError::OwnSystems { .. }));
}

struct Counting<'a>(&'a AtomicU64);

impl Watch for Counting<'_> {
    fn finished(&self, analyses: u64) {
        self.0.fetch_add(analyses, Ordering::Relaxed);
    }
}

#[test]
fn systems_of_one_identity_are_the_same() {
    let oscillator = |strength, gravity| {
        System::Oscillator(Oscillator::new(strength, gravity, 0.0005, 0.95, PostUplift::Zero).unwrap())
    };
    let block = |slenderness| System::Block(RockingBlock::new(1.0, slenderness).unwrap());
    let systems = [
        oscillator(0.1, 9.8),
        oscillator(0.1, 9.81),
        oscillator(0.2, 9.8),
        block(0.1),
        block(0.2),
        System::Oscillator(Oscillator::new(0.1, 9.8, 0.0005, 0.95, PostUplift::Negative { capacity_m: 1.0 }).unwrap()),
    ];
    for (i, one) in systems.iter().enumerate() {
        for (j, other) in systems.iter().enumerate() {
            assert_eq!(one.identity() == other.identity(), i == j, "{one:?} {other:?}");
        }
    }
    assert_eq!((systems[0].kind(), systems[3].kind()), ("oscillator", "block"));
}

#[test]
fn the_time_of_any_plan_can_be_estimated() {
    let case = Case::with_blocks();
    let found = estimate(&case.plan(), std::time::Duration::from_secs(600));
    assert!(found.rows_timed == 12 && found.seconds_one_thread > 0.0, "{found:?}");
    // without a budget a few of the expensive ones will do
    let found = estimate(&case.plan(), std::time::Duration::ZERO);
    assert!((4..12).contains(&found.rows_timed) && found.seconds_one_thread > 0.0, "{found:?}");
}

// Whoever changes these bits raises NUMERICS: results kept by an earlier version are then not mixed with new ones.
#[test]
#[cfg(target_arch = "x86_64")]
fn the_version_of_the_numbers_goes_with_their_bits() {
    let case = Case::new();
    let whole = analyse(&case.plan(), &Unwatched).unwrap();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let (displacements, impacts): (Vec<u64>, Vec<u32>) = bits(&whole).into_iter().unzip();
    for word in displacements.into_iter().chain(impacts.into_iter().map(u64::from)) {
        hash = (hash ^ word).wrapping_mul(0x100_0000_01b3);
    }
    assert_eq!((NUMERICS, format!("{hash:016x}").as_str()), (3, "542a6417ac2eb4cd"));
}
