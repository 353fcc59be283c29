//! The stripes against single runs, and against themselves on other numbers of threads.

use std::sync::atomic::{AtomicU64, Ordering};

use uplift_ida::{Axes, IdaError, Plan, ScaledMotion, StripeRecord, System, Unwatched, Watch, analyse};
use uplift_motion::Accelerogram;
use uplift_oscillator::problems::shaped_noise;
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, respond};

fn records() -> Vec<Accelerogram> {
    (0..5).map(|i| Accelerogram::new(0.01, shaped_noise(6.0, 637 + 37 * i, i as u64 + 1)).unwrap()).collect()
}

fn plan<'a>(accelerograms: &'a [Accelerogram], systems: &'a [System], levels: &[f64]) -> Plan<'a> {
    let records = accelerograms
        .iter()
        .enumerate()
        .map(|(i, accelerogram)| StripeRecord { id: "noise", accelerogram, intensity: 0.3 + 0.1 * i as f64 })
        .collect();
    Plan::stripes(records, systems, levels, true).unwrap()
}

fn oscillators() -> Vec<Oscillator> {
    [0.0, 0.05, 0.2, 0.7].iter().map(|&strength| Oscillator::zsbe(strength).unwrap()).collect()
}

fn systems() -> Vec<System> {
    oscillators().into_iter().map(System::Oscillator).collect()
}

const LEVELS: [f64; 6] = [0.05, 0.1, 0.3, 0.5, 1.0, 2.0];

#[test]
fn each_element_is_the_single_run_it_stands_for() {
    let (accelerograms, systems) = (records(), systems());
    let peaks = analyse(&plan(&accelerograms, &systems, &LEVELS), &Unwatched).unwrap();
    assert_eq!(peaks.axes(), Axes { motions: 5, systems: 4, scales: 6 });
    for (i, accelerogram) in accelerograms.iter().enumerate() {
        for (j, oscillator) in oscillators().iter().enumerate() {
            for (k, level) in LEVELS.iter().enumerate() {
                let excitation = Excitation::new(accelerogram.dt_s(), accelerogram.acceleration_m_s2()).unwrap();
                let scaled = excitation.scaled(level / (0.3 + 0.1 * i as f64)).unwrap();
                let single = respond(oscillator, &scaled, FreeVibration::FirstPeak);
                let (found, exact) = (peaks.system_m(j)[i * 6 + k], single.peak_displacement_m);
                assert!((found - exact).abs() <= 1e-6 * exact, "record {i} strength {j} level {k}: {found} {exact}");
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (accelerograms, systems) = (records(), systems());
    let plan = plan(&accelerograms, &systems, &LEVELS);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| analyse(&plan, &Unwatched)).unwrap()
    };
    let one = on(1);
    assert!(one.impacts().iter().any(|&n| n > 0));
    for threads in [2, 5] {
        let other = on(threads);
        assert_eq!(one.impacts(), other.impacts());
        let same = one.displacement_m().iter().zip(other.displacement_m()).all(|(a, b)| a.to_bits() == b.to_bits());
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
    let (accelerograms, systems) = (records(), systems());
    let plan = plan(&accelerograms, &systems, &LEVELS);
    let counter = Counter::default();
    analyse(&plan, &counter).unwrap();
    assert_eq!(counter.analyses.into_inner(), plan.analyses());
    let stopped = analyse(&plan, &Counter { stop: true, ..Counter::default() });
    assert!(matches!(stopped, Err(IdaError::Cancelled)));
}

#[test]
fn mistakes_of_a_plan_are_named() {
    let (accelerograms, systems) = (records(), systems());
    let record = |intensity| StripeRecord { id: "quiet", accelerogram: &accelerograms[0], intensity };
    let refused = |records, levels: &[f64]| Plan::stripes(records, &systems, levels, false).map(|_| ()).unwrap_err();
    assert!(matches!(refused(vec![], &LEVELS), IdaError::Empty { what: "records" }));
    assert!(matches!(refused(vec![record(1.0)], &[]), IdaError::Empty { what: "levels" }));
    let silent = refused(vec![record(0.0)], &LEVELS);
    assert!(matches!(&silent, IdaError::Unscalable { record, value: 0.0 } if record == "quiet"), "{silent}");
    let level = refused(vec![record(1.0)], &[1.0, 1.0]);
    assert!(matches!(level, IdaError::Levels { index: 1, value: 1.0, before: 1.0 }), "{level}");
}

#[test]
fn mistakes_of_given_factors_are_named() {
    let (accelerograms, systems) = (records(), systems());
    let motion =
        |scales: &[f64]| ScaledMotion { id: "waves", accelerogram: &accelerograms[0], scales: scales.to_vec() };
    let refused = |motions| Plan::scaled(motions, &systems, true).map(|_| ()).unwrap_err().to_string();
    assert!(refused(vec![]).contains("no motions"));
    assert!(refused(vec![motion(&[])]).contains("no scale factors"));
    let uneven = refused(vec![motion(&[1.0, 2.0]), motion(&[1.0])]);
    assert!(uneven.contains("waves: 1 scale factors, and 2"), "{uneven}");
    assert!(refused(vec![motion(&[1.0, f64::NAN])]).contains("scale factor 1 is NaN"));
    assert!(Plan::scaled(vec![motion(&[1.0])], &[], true).unwrap_err().to_string().contains("no systems"));
}

/// Stripes are motions with the factors level over intensity, to the bit.
#[test]
fn stripes_are_scaled_motions() {
    let (accelerograms, systems) = (records(), systems());
    let stripes = analyse(&plan(&accelerograms, &systems, &LEVELS), &Unwatched).unwrap();
    let scaled = |(i, accelerogram)| {
        let intensity = 0.3 + 0.1 * i as f64;
        ScaledMotion { id: "noise", accelerogram, scales: LEVELS.iter().map(|level| level / intensity).collect() }
    };
    let motions = accelerograms.iter().enumerate().map(scaled).collect();
    let given = analyse(&Plan::scaled(motions, &systems, true).unwrap(), &Unwatched).unwrap();
    assert_eq!(stripes, given);
    assert_eq!(stripes.over_motions_m(1, 4)[3].to_bits(), stripes.row_m(3, 1)[4].to_bits());
}
