//! A block under a record-like noise, and a point of a pulse spectrum.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use uplift_block::{
    FreeRocking, PulseSpectrumPlan, RickerShape, RockingBlock, SizeMeasure, pulse_spectrum, respond, respond_at_scales,
};
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
        let scales: Vec<f64> = (0..32).map(|i| 0.9 + 0.01 * f64::from(i)).collect();
        group.bench_function(format!("2H {height_m} m, alpha {slenderness}: 32 scales, 0.9 to 1.21"), |bencher| {
            bencher.iter(|| respond_at_scales(black_box(&block), &record, &scales, FreeRocking::FirstPeak).unwrap());
        });
    }
    group.finish();
}

/// Blocks of 1 to 10 m and 0.1 to 0.3 rad under ten motions at 20 levels of PGA/(g tan α), from rest to overturning:
/// a library of rocking response.
fn library(criterion: &mut Criterion) {
    let pairs = generate(&SyntheticSetOptions { pairs: 5, ..SyntheticSetOptions::default() }).unwrap();
    let motions: Vec<_> = pairs.iter().flat_map(|pair| [&pair.h1, &pair.h2]).collect();
    let blocks: Vec<RockingBlock> = [1.0, 2.5, 5.0, 10.0]
        .into_iter()
        .flat_map(|size_m| [0.1, 0.2, 0.3].map(|slenderness| RockingBlock::new(size_m, slenderness).unwrap()))
        .collect();
    let levels: Vec<f64> = (1..=20).map(|i| 0.5 * f64::from(i)).collect();
    let mut group = criterion.benchmark_group("library");
    group.sample_size(10).throughput(Throughput::Elements((blocks.len() * motions.len() * levels.len()) as u64));
    group.bench_function("analyses", |bencher| {
        bencher.iter(|| {
            for block in &blocks {
                for motion in &motions {
                    let peak = motion.acceleration_m_s2().iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
                    let scales = levels.iter().map(|level| level * block.uplift_acceleration_m_s2() / peak);
                    let scales: Vec<f64> = scales.collect();
                    respond_at_scales(black_box(block), motion, &scales, FreeRocking::FirstPeak).unwrap();
                }
            }
        });
    });
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

criterion_group!(benches, record, library, spectrum_point);
criterion_main!(benches);
