//! A block under a record-like noise, and a point of a pulse spectrum.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use uplift_block::{FreeRocking, PulseSpectrumPlan, RickerShape, RockingBlock, SizeMeasure, pulse_spectrum, respond};
use uplift_motion::synthetic::{SyntheticSetOptions, generate};

/// A synthetic record, scaled to 0.4 g, per block; printed beside: its duration and how often the
/// block hits the ground.
fn record(criterion: &mut Criterion) {
    let pair = generate(&SyntheticSetOptions { pairs: 1, ..SyntheticSetOptions::default() }).unwrap().remove(0);
    let largest = pair.h1.acceleration_m_s2().iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
    let record = pair.h1.scaled(4.0 / largest).unwrap();
    let mut group = criterion.benchmark_group("record");
    for (height_m, slenderness) in [(10.0, 0.1), (10.0, 0.25), (1000.0, 0.05)] {
        let block = RockingBlock::from_height(height_m, slenderness).unwrap();
        let impacts = respond(&block, &record, FreeRocking::FirstPeak).unwrap().impacts;
        let (duration_s, dt_s) = (record.duration_s(), record.dt_s());
        let name = format!("2H {height_m} m, alpha {slenderness}: {duration_s:.1} s at dt {dt_s}, {impacts} impacts");
        group.bench_function(name, |bencher| {
            bencher.iter(|| respond(black_box(&block), &record, FreeRocking::FirstPeak).unwrap());
        });
    }
    group.finish();
}

fn spectrum_point(criterion: &mut Criterion) {
    for shape in [RickerShape::Symmetric, RickerShape::Antisymmetric] {
        let plan = PulseSpectrumPlan {
            shape,
            slenderness_rad: 0.1,
            restitution: None,
            size_measure: SizeMeasure::Frequency,
            sizes: vec![6.0],
            accelerations: vec![4.0],
        };
        criterion.bench_function(&format!("spectrum point, {shape:?}"), |bencher| {
            bencher.iter(|| pulse_spectrum(black_box(&plan)).unwrap());
        });
    }
}

criterion_group!(benches, record, spectrum_point);
criterion_main!(benches);
