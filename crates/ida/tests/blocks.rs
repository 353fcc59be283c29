//! Block stripes against single runs, and stopped.

use std::sync::atomic::{AtomicU64, Ordering};

use uplift_block::{FreeRocking, RockingBlock, respond};
use uplift_ida::{
    AnalysisRow, Axes, Cells, IdaError, Plan, Shard, StripeRecord, System, Unwatched, Watch, analyse, complete,
};
use uplift_motion::Accelerogram;
use uplift_oscillator::problems::shaped_noise;

const LEVELS: [f64; 5] = [0.05, 0.3, 1.0, 3.0, 30.0];

fn records() -> Vec<Accelerogram> {
    (0..4).map(|i| Accelerogram::new(0.01, shaped_noise(6.0, 500 + 37 * i, i as u64 + 1)).unwrap()).collect()
}

fn blocks() -> Vec<RockingBlock> {
    [(0.5, 0.3), (2.0, 0.2), (20.0, 0.1)].iter().map(|&(size, alpha)| RockingBlock::new(size, alpha).unwrap()).collect()
}

fn plan<'a>(records: &'a [Accelerogram], systems: &'a [System], with_free_peak: bool) -> Plan<'a> {
    plan_at(&LEVELS, records, systems, with_free_peak)
}

fn plan_at<'a>(levels: &[f64], records: &'a [Accelerogram], systems: &'a [System], with_free_peak: bool) -> Plan<'a> {
    let records = records
        .iter()
        .enumerate()
        .map(|(i, accelerogram)| StripeRecord { id: "noise", accelerogram, intensity: 0.3 + 0.1 * i as f64 })
        .collect();
    Plan::stripes(records, systems, levels, with_free_peak).unwrap()
}

fn systems() -> Vec<System> {
    blocks().into_iter().map(System::Block).collect()
}

#[test]
fn each_element_is_the_single_run_it_stands_for() {
    let (records, systems) = (records(), systems());
    for (with_free_peak, free) in [(true, FreeRocking::FirstPeak), (false, FreeRocking::Lasting { duration_s: 0.0 })] {
        let peaks = analyse(&plan(&records, &systems, with_free_peak), &Unwatched).unwrap();
        assert_eq!(peaks.axes(), Axes { motions: 4, systems: 3, scales: 5 });
        let (mut rested, mut rocked, mut overturned) = (0, 0, 0);
        for (i, record) in records.iter().enumerate() {
            for (j, block) in blocks().iter().enumerate() {
                for (k, level) in LEVELS.iter().enumerate() {
                    let single = respond(block, &record.scaled(level / (0.3 + 0.1 * i as f64)).unwrap(), free).unwrap();
                    let found = peaks.at_m([i, j, k]);
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

struct Counting(AtomicU64, u64);

impl Watch for Counting {
    fn finished(&self, analyses: u64) {
        self.0.fetch_add(analyses, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) >= self.1
    }
}

#[test]
fn it_counts_its_runs_and_can_be_stopped() {
    let (records, systems) = (records(), systems());
    let plan = plan(&records, &systems, true);
    let patient = Counting(AtomicU64::new(0), u64::MAX);
    analyse(&plan, &patient).unwrap();
    assert_eq!(patient.0.into_inner(), plan.analyses());
    assert!(matches!(analyse(&plan, &Counting(AtomicU64::new(0), 7)), Err(IdaError::Cancelled)));
}

/// A row of a block may take long: a stop is heard after 32 runs of it, and what was not finished is not handed over.
#[test]
fn a_stop_is_heard_within_a_row() {
    let (records, systems) = (records(), systems());
    let levels: Vec<f64> = (1..=40).map(|i| 0.1 * f64::from(i)).collect();
    let plan = plan_at(&levels, &records, &systems, true);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let watch = Counting(AtomicU64::new(0), 41);
    let kept = AtomicU64::new(0);
    let keep = |_: &AnalysisRow<'_>| {
        kept.fetch_add(1, Ordering::Relaxed);
    };
    let stopped = pool.install(|| complete(&plan, Cells::unknown(&plan), Shard::WHOLE, &watch, &keep));
    assert!(matches!(stopped, Err(IdaError::Cancelled)));
    assert_eq!((watch.0.into_inner(), kept.into_inner()), (40 + 32, 1));
}

#[test]
fn refuses_what_is_not_computed() {
    let (records, systems) = (records(), systems());
    let stripe = |intensity| vec![StripeRecord { id: "noise", accelerogram: &records[0], intensity }];
    assert!(matches!(Plan::stripes(stripe(1.0), &[], &LEVELS, true).unwrap_err(), IdaError::Empty { what: "systems" }));
    // a motion that no ground has is refused with the record's name, by the plan or by what a block can follow
    let by_plan = Plan::stripes(stripe(1e-9), &systems, &LEVELS, true).unwrap_err();
    assert!(matches!(by_plan, IdaError::Implausible { index: 0, .. }), "{by_plan}");
    let plan = Plan::stripes(stripe(1e-5), &systems, &LEVELS, true).unwrap();
    for message in [by_plan.to_string(), analyse(&plan, &Unwatched).unwrap_err().to_string()] {
        assert!(message.contains("record noise") && message.contains("m/s2"), "{message}");
    }
}
