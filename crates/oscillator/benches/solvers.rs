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
        }
        // eight runs about the one of the reference, a sample of each counted
        group.throughput(Throughput::Elements(8 * samples as u64));
        let scales = [0.65, 0.75, 0.85, 0.95, 1.05, 1.15, 1.25, 1.35];
        for (name, strength, post_uplift) in [
            ("strength 0.05", 0.05, PostUplift::Zero),
            ("strength 0.3", 0.3, PostUplift::Zero),
            ("strength 0.3, negative stiffness", 0.3, PostUplift::Negative { capacity_m: 1.0 }),
            ("strength 0.3, positive stiffness", 0.3, PostUplift::Positive { stiffness_per_s2: 2.0 }),
        ] {
            let oscillator = Oscillator::new(strength, 9.806_65, 0.0005, 0.95, post_uplift).unwrap();
            let sweep = Sweep::new(&oscillator, &ground, true);
            group.bench_function(format!("sweep, {name}"), |bencher| bencher.iter(|| sweep.peaks(black_box(&scales))));
        }
        group.throughput(Throughput::Elements(samples as u64));
        group.bench_function("preparation of a sweep, strength 0.3", |bencher| {
            let oscillator = Oscillator::zsbe(0.3).unwrap();
            bencher.iter(|| Sweep::new(black_box(&oscillator), &ground, true));
        });
        group.finish();
    }
}

criterion_group!(benches, noise);
criterion_main!(benches);
