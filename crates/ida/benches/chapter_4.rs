//! Analyses a second on the thinned grid of Chapter 4, with records of the embedded synthetic set, and one of them on
//! its own.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use uplift_ida::{Plan, StripeRecord, System, Unwatched, analyse};
use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{IntensityMeasure, RecordPair};
use uplift_oscillator::{Excitation, FreeVibration, GroundMotion, Oscillator, Sweep, respond};

const G: f64 = 9.806_65;

fn pairs() -> Vec<RecordPair> {
    generate(&SyntheticSetOptions { pairs: 8, ..SyntheticSetOptions::default() }).unwrap()
}

/// Every fifth of the 75 PGV levels, cm/s.
fn levels() -> Vec<f64> {
    let fine = (0..39).map(|i| 1.0 + 0.5 * f64::from(i));
    fine.chain((0..36).map(|i| 25.0 + 5.0 * f64::from(i))).step_by(5).collect()
}

fn one_record(criterion: &mut Criterion) {
    let pair = &pairs()[0];
    let excitation = Excitation::new(pair.h1.dt_s(), pair.h1.acceleration_m_s2()).unwrap();
    let ground = GroundMotion::new(excitation);
    let pgv = IntensityMeasure::Pgv.pair_value(pair, G);
    let mut group = criterion.benchmark_group("one record, 15 levels");
    group.throughput(Throughput::Elements((15 * pair.h1.len()) as u64));
    for strength in [0.05, 0.3, 1.0] {
        let oscillator = Oscillator::zsbe(strength).unwrap();
        group.bench_function(format!("reference, strength {strength}"), |bencher| {
            bencher.iter(|| {
                for level in levels() {
                    black_box(respond(&oscillator, &excitation.scaled(level / pgv).unwrap(), FreeVibration::FirstPeak));
                }
            });
        });
        group.bench_function(format!("sweep, strength {strength}"), |bencher| {
            bencher.iter(|| {
                let sweep = Sweep::new(&oscillator, &ground, true);
                let scales: Vec<f64> = levels().into_iter().map(|level| level / pgv).collect();
                black_box(sweep.peaks(&scales))
            });
        });
    }
    group.finish();
}

fn thinned_grid(criterion: &mut Criterion) {
    let pairs = pairs();
    let systems: Vec<System> =
        (0..=10).map(|i| System::Oscillator(Oscillator::zsbe(f64::from(i) / 10.0).unwrap())).collect();
    let levels = levels();
    let records = pairs
        .iter()
        .map(|pair| StripeRecord {
            id: &pair.id,
            accelerogram: &pair.h1,
            intensity: IntensityMeasure::Pgv.pair_value(pair, G),
        })
        .collect();
    let plan = Plan::stripes(records, &systems, &levels, true).unwrap();
    let mut group = criterion.benchmark_group("thinned grid, analyses");
    group.throughput(Throughput::Elements(plan.analyses()));
    group.sample_size(10);
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        group.bench_function(format!("{threads} threads"), |bencher| {
            bencher.iter(|| pool.install(|| analyse(black_box(&plan), &Unwatched)).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, one_record, thinned_grid);
criterion_main!(benches);
