//! Ordinates of resampled spectra at one site: 105 records at 75 levels, three probabilities.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use uplift_bootstrap::{
    BootstrapError, Replicates, ResamplingPlan, inferred_limits, truth_limits, weighted_replicates,
};
use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_risk::{PooledDemand, RiskCurve, RunWeights, StripeWeights};

const RECORDS: usize = 105;
const LEVELS: usize = 75;
const TARGETS: [f64; 3] = [4.04e-4, 2.1e-3, 0.0139];

fn benchmarks(criterion: &mut Criterion) {
    let levels: Vec<f64> = (0..LEVELS).map(|i| 1.0 + 2.7 * i as f64).collect();
    // demands that grow with the level and scatter by record, a factor of e up and down
    let edp_m: Vec<f64> = (0..RECORDS)
        .flat_map(|record| {
            let scatter = (((record * 37) % RECORDS) as f64 / 52.0 - 1.0).exp();
            levels.iter().enumerate().map(move |(level, im)| {
                1e-4 * scatter * im * im.sqrt() * (1.0 + 0.1 * ((record * 7 + level * 3) % 11) as f64)
            })
        })
        .collect();
    let demand = PooledDemand::new(&Stripes::new(&levels, &edp_m).unwrap()).unwrap();
    let im: Vec<f64> = (0..24).map(|i| 0.5 * 1.4_f64.powi(i)).collect();
    let maf = im.iter().map(|im| 0.5 * im.powf(-1.7)).collect();
    let hazard = HazardCurve::new("PGV", "cm/s", "power law", im, maf).unwrap();
    let weights = StripeWeights::from_hazard(&hazard, &levels, Extrapolation::Refuse).unwrap();

    let mut group = criterion.benchmark_group("resamples");
    for size in [20, 105] {
        let plan = ResamplingPlan::draw(RECORDS, &[size], 1000, 1).unwrap();
        group.throughput(Throughput::Elements(1000));
        group.bench_function(format!("split by record, samples of {size}"), |bencher| {
            bencher.iter(|| Replicates::from_plan(&demand, &[&weights], black_box(&TARGETS), &plan).unwrap());
        });
    }
    let plan = ResamplingPlan::draw(RECORDS, &[105], 100, 1).unwrap();
    group.throughput(Throughput::Elements(100));
    group.bench_function("sweep over the pool, samples of 105", |bencher| {
        bencher.iter(|| {
            for sample in plan.samples() {
                let curve = RiskCurve::resampled(&demand, &weights, sample).unwrap();
                black_box(curve.exact_ordinates(black_box(&TARGETS)).unwrap());
            }
        });
    });
    group.finish();

    // 40 strengths of 200 resamples, each weighed by itself: weighing is measured elsewhere
    let strengths: Vec<PooledDemand> = (0..40_u8)
        .map(|strength| {
            // a little stronger than the one before
            let factor = |i: usize| {
                0.97_f64.powi(i32::from(strength)) * (1.0 + 0.01 * ((i * (usize::from(strength) + 3)) % 7) as f64)
            };
            let edp_m: Vec<f64> = edp_m.iter().enumerate().map(|(i, edp_m)| edp_m * factor(i)).collect();
            PooledDemand::new(&Stripes::new(&levels, &edp_m).unwrap()).unwrap()
        })
        .collect();
    let plan = ResamplingPlan::draw(RECORDS, &[105], 200, 1).unwrap();
    let mut group = criterion.benchmark_group("weighted resamples");
    group.throughput(Throughput::Elements(40 * 200));
    group.sample_size(20);
    group.bench_function("40 strengths", |bencher| {
        bencher.iter(|| {
            weighted_replicates(&strengths, &weights, black_box(&TARGETS), plan.samples(), |sample, shares| {
                for row in shares.chunks_exact_mut(RECORDS) {
                    for (share, &count) in row.iter_mut().zip(sample.multiplicities()) {
                        *share = f64::from(count) / 105.0;
                    }
                }
                Ok::<(), BootstrapError>(())
            })
            .unwrap()
        });
    });
    group.finish();

    let units: Vec<Vec<usize>> = (0..RECORDS).map(|record| vec![record]).collect();
    let alike = RunWeights::new(&weights, &vec![1.0 / RECORDS as f64; LEVELS * RECORDS]).unwrap();
    let asked = (&[20, 40, 60, 80, RECORDS][..], 0.9);
    let mut group = criterion.benchmark_group("bands of the truth");
    group.sample_size(20);
    group.bench_function("records that count alike", |bencher| {
        bencher.iter(|| inferred_limits(&demand, &weights, &units, black_box(&TARGETS), asked).unwrap());
    });
    group.bench_function("records that count alike, of the truth alone", |bencher| {
        bencher.iter(|| truth_limits(&demand, &weights, &units, black_box(&TARGETS[1..2]), 0.9).unwrap());
    });
    // 28 of 1 to 10 records
    let event_of: Vec<usize> = (0..RECORDS).map(|record| record * 2 % 7 * 4 + record % 4 * (record % 3) / 2).collect();
    let earthquakes = uplift_bootstrap::units(&event_of);
    group.bench_function("earthquakes of different numbers of records", |bencher| {
        bencher.iter(|| inferred_limits(&demand, &weights, &earthquakes, black_box(&TARGETS), asked).unwrap());
    });
    group.bench_function("weighted records", |bencher| {
        bencher.iter(|| inferred_limits(&demand, &alike, &units, black_box(&TARGETS), asked).unwrap());
    });
    group.finish();
}

criterion_group!(benches, benchmarks);
criterion_main!(benches);
