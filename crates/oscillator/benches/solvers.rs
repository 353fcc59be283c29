//! Nanoseconds a record sample of both solvers under event-rich noise: 30 s at dt = 0.01 and 0.005 s.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use uplift_oscillator::problems::shaped_noise;
use uplift_oscillator::{Excitation, FreeVibration, GroundMotion, Oscillator, PostUplift, Sweep, respond};

fn noise(criterion: &mut Criterion) {
    for (dt_s, samples) in [(0.01, 3000), (0.005, 6000)] {
        let record = shaped_noise(4.0, samples, 1);
        let excitation = Excitation::new(dt_s, &record).unwrap();
        let ground = GroundMotion::new(excitation);
        let mut group = criterion.benchmark_group(format!("noise, dt = {dt_s} s"));
        group.throughput(Throughput::Elements(samples as u64));
        for strength in [0.05, 0.3] {
            let oscillator = Oscillator::zsbe(strength).unwrap();
            group.bench_function(format!("reference, strength {strength}"), |bencher| {
                bencher.iter(|| respond(black_box(&oscillator), &excitation, FreeVibration::FirstPeak));
            });
            let sweep = Sweep::new(&oscillator, &ground, true);
            group.bench_function(format!("sweep, strength {strength}"), |bencher| {
                bencher.iter(|| sweep.peak(black_box(1.0)));
            });
        }
        let post_uplift = PostUplift::Negative { capacity_m: 1.0 };
        let nsbe = Oscillator::new(0.3, 9.806_65, 0.0005, 0.95, post_uplift).unwrap();
        let sweep = Sweep::new(&nsbe, &ground, true);
        group.bench_function("sweep, negative stiffness, strength 0.3", |bencher| {
            bencher.iter(|| sweep.peak(black_box(1.0)));
        });
        group.bench_function("preparation of a sweep, strength 0.3", |bencher| {
            let oscillator = Oscillator::zsbe(0.3).unwrap();
            bencher.iter(|| Sweep::new(black_box(&oscillator), &ground, true));
        });
        group.finish();
    }
}

criterion_group!(benches, noise);
criterion_main!(benches);
