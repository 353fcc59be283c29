//! The stripes against single runs, and against themselves on other numbers of threads.
#![allow(clippy::unwrap_used)]

use std::sync::atomic::{AtomicU64, Ordering};

use uplift_ida::{IdaError, Plan, StripeRecord, Unwatched, Watch, analyse};
use uplift_motion::Accelerogram;
use uplift_oscillator::problems::shaped_noise;
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, respond};

fn records() -> Vec<Accelerogram> {
    (0..5).map(|i| Accelerogram::new(0.01, shaped_noise(6.0, 637 + 37 * i, i as u64 + 1)).unwrap()).collect()
}

fn plan<'a>(accelerograms: &'a [Accelerogram], oscillators: &'a [Oscillator], levels: &'a [f64]) -> Plan<'a> {
    let records = accelerograms
        .iter()
        .enumerate()
        .map(|(i, accelerogram)| StripeRecord { id: "noise", accelerogram, intensity: 0.3 + 0.1 * i as f64 })
        .collect();
    Plan::new(records, oscillators, levels, true).unwrap()
}

fn oscillators() -> Vec<Oscillator> {
    [0.0, 0.05, 0.2, 0.7].iter().map(|&strength| Oscillator::zsbe(strength).unwrap()).collect()
}

const LEVELS: [f64; 6] = [0.05, 0.1, 0.3, 0.5, 1.0, 2.0];

#[test]
fn each_element_is_the_single_run_it_stands_for() {
    let (accelerograms, oscillators) = (records(), oscillators());
    let edp = analyse(&plan(&accelerograms, &oscillators, &LEVELS), &Unwatched).unwrap();
    assert_eq!(edp.shape(), [5, 4, 6]);
    for (i, accelerogram) in accelerograms.iter().enumerate() {
        for (j, oscillator) in oscillators.iter().enumerate() {
            for (k, level) in LEVELS.iter().enumerate() {
                let excitation = Excitation::new(accelerogram.dt_s(), accelerogram.acceleration_m_s2()).unwrap();
                let scaled = excitation.scaled(level / (0.3 + 0.1 * i as f64)).unwrap();
                let single = respond(oscillator, &scaled, FreeVibration::FirstPeak);
                let (found, exact) = (edp.of_strength(j)[i * 6 + k], single.peak_displacement_m);
                assert!((found - exact).abs() <= 1e-6 * exact, "record {i} strength {j} level {k}: {found} {exact}");
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (accelerograms, oscillators) = (records(), oscillators());
    let plan = plan(&accelerograms, &oscillators, &LEVELS);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| analyse(&plan, &Unwatched)).unwrap()
    };
    let one = on(1);
    assert!(one.impacts().iter().any(|&n| n > 0));
    for threads in [2, 5] {
        let other = on(threads);
        assert_eq!(one.impacts(), other.impacts());
        let same = one.edp_m().iter().zip(other.edp_m()).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same, "{threads} threads");
    }
}

#[derive(Default)]
struct Counter {
    analyses: AtomicU64,
    stop: bool,
}

impl Watch for Counter {
    fn finished(&self, analyses: u64) {
        self.analyses.fetch_add(analyses, Ordering::Relaxed);
    }
    fn cancelled(&self) -> bool {
        self.stop
    }
}

#[test]
fn every_analysis_is_counted_and_a_stop_is_heard() {
    let (accelerograms, oscillators) = (records(), oscillators());
    let plan = plan(&accelerograms, &oscillators, &LEVELS);
    let counter = Counter::default();
    analyse(&plan, &counter).unwrap();
    assert_eq!(counter.analyses.into_inner(), plan.analyses());
    assert_eq!(analyse(&plan, &Counter { stop: true, ..Counter::default() }), Err(IdaError::Cancelled));
}

#[test]
fn mistakes_of_a_plan_are_named() {
    let (accelerograms, oscillators) = (records(), oscillators());
    let record = |intensity| StripeRecord { id: "quiet", accelerogram: &accelerograms[0], intensity };
    let plan = |records, levels| Plan::new(records, &oscillators, levels, false).map(|_| ());
    assert_eq!(plan(vec![], &LEVELS), Err(IdaError::Empty { what: "records" }));
    assert_eq!(plan(vec![record(0.0)], &LEVELS), Err(IdaError::Unscalable { record: "quiet".into(), value: 0.0 }));
    assert_eq!(plan(vec![record(1.0)], &[1.0, 1.0]), Err(IdaError::Levels { index: 1, value: 1.0, before: 1.0 }));
}
