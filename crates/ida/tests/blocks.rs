//! Block stripes against single runs, on other numbers of threads, and stopped.
#![allow(clippy::unwrap_used)]

use std::sync::atomic::{AtomicU64, Ordering};

use uplift_block::{FreeRocking, RockingBlock, respond};
use uplift_ida::{BlockPlan, EdpArray, IdaError, StripeRecord, Unwatched, Watch, analyse_blocks};
use uplift_motion::Accelerogram;
use uplift_oscillator::problems::shaped_noise;

const LEVELS: [f64; 5] = [0.05, 0.3, 1.0, 3.0, 30.0];

fn records() -> Vec<Accelerogram> {
    (0..4).map(|i| Accelerogram::new(0.01, shaped_noise(6.0, 500 + 37 * i, i as u64 + 1)).unwrap()).collect()
}

fn blocks() -> Vec<RockingBlock> {
    [(0.5, 0.3), (2.0, 0.2), (20.0, 0.1)].iter().map(|&(size, alpha)| RockingBlock::new(size, alpha).unwrap()).collect()
}

fn plan<'a>(records: &'a [Accelerogram], blocks: &'a [RockingBlock], with_free_peak: bool) -> BlockPlan<'a> {
    let records = records
        .iter()
        .enumerate()
        .map(|(i, accelerogram)| StripeRecord { id: "noise", accelerogram, intensity: 0.3 + 0.1 * i as f64 })
        .collect();
    BlockPlan::new(records, blocks, &LEVELS, with_free_peak).unwrap()
}

fn bits(edp: &EdpArray) -> Vec<(u64, u32)> {
    edp.edp_m().iter().map(|value| value.to_bits()).zip(edp.impacts().iter().copied()).collect()
}

#[test]
fn each_element_is_the_single_run_it_stands_for() {
    let (records, blocks) = (records(), blocks());
    for (with_free_peak, free) in [(true, FreeRocking::FirstPeak), (false, FreeRocking::Lasting { duration_s: 0.0 })] {
        let edp = analyse_blocks(&plan(&records, &blocks, with_free_peak), &Unwatched).unwrap();
        assert_eq!(edp.shape(), [4, 3, 5]);
        let (mut rested, mut rocked, mut overturned) = (0, 0, 0);
        for (i, record) in records.iter().enumerate() {
            for (j, block) in blocks.iter().enumerate() {
                for (k, level) in LEVELS.iter().enumerate() {
                    let single = respond(block, &record.scaled(level / (0.3 + 0.1 * i as f64)).unwrap(), free).unwrap();
                    let found = edp.of_strength(j)[i * 5 + k];
                    assert_eq!(found.to_bits(), single.displacement_m.to_bits(), "{i} {j} {k}");
                    assert_eq!(single.is_overturned(), found == f64::INFINITY);
                    *(if found == 0.0 {
                        &mut rested
                    } else if found.is_finite() {
                        &mut rocked
                    } else {
                        &mut overturned
                    }) += 1;
                }
            }
        }
        assert!(rested > 0 && rocked > 0 && overturned > 0, "{rested} {rocked} {overturned}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (records, blocks) = (records(), blocks());
    let plan = plan(&records, &blocks, true);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        bits(&pool.install(|| analyse_blocks(&plan, &Unwatched)).unwrap())
    };
    assert_eq!(on(1), on(2));
    assert_eq!(on(1), on(5));
}

#[test]
fn it_counts_its_runs_and_stops_when_told() {
    struct Counting(AtomicU64, u64);
    impl Watch for Counting {
        fn finished(&self, analyses: u64) {
            self.0.fetch_add(analyses, Ordering::Relaxed);
        }
        fn cancelled(&self) -> bool {
            self.0.load(Ordering::Relaxed) >= self.1
        }
    }
    let (records, blocks) = (records(), blocks());
    let plan = plan(&records, &blocks, true);
    let patient = Counting(AtomicU64::new(0), u64::MAX);
    analyse_blocks(&plan, &patient).unwrap();
    assert_eq!(patient.0.into_inner(), plan.analyses());
    assert_eq!(analyse_blocks(&plan, &Counting(AtomicU64::new(0), 7)), Err(IdaError::Cancelled));
}

#[test]
fn refuses_what_is_no_plan() {
    let (records, blocks) = (records(), blocks());
    let stripe = |intensity| vec![StripeRecord { id: "noise", accelerogram: &records[0], intensity }];
    let refused = |records, blocks, levels| BlockPlan::new(records, blocks, levels, true).unwrap_err();
    assert_eq!(refused(stripe(1.0), &[], &LEVELS), IdaError::Empty { what: "blocks" });
    assert_eq!(refused(Vec::new(), &blocks, &LEVELS), IdaError::Empty { what: "records" });
    assert_eq!(refused(stripe(1.0), &blocks, &[]), IdaError::Empty { what: "levels" });
    assert!(matches!(refused(stripe(1.0), &blocks, &[2.0, 1.0]), IdaError::Levels { index: 1, .. }));
    assert!(matches!(refused(stripe(0.0), &blocks, &LEVELS), IdaError::Unscalable { .. }));
    // a motion that no ground has is refused with the record's name
    let plan = BlockPlan::new(stripe(1e-9), &blocks, &LEVELS, true).unwrap();
    let message = analyse_blocks(&plan, &Unwatched).unwrap_err().to_string();
    assert!(message.contains("record noise") && message.contains("m/s2"), "{message}");
}
