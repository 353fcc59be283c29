//! Exponents and shares anew for resamples of 105 records at 75 levels, from the set's own exponents.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use uplift_consistency::{KNOTS, RecordSet, ScaledAnalysis, Scratch, Seismology, SetRecord, Solver};
use uplift_hazard::{Extrapolation, HazardCurve};

const RECORDS: usize = 105;
const LEVELS: usize = 75;
const TARGETS: [f64; 3] = [4.04e-4, 2.1e-3, 0.0139];

fn benchmarks(criterion: &mut Criterion) {
    // ln(y/x) scatters by half a unit, three standard deviations up and down
    let record = |pair: usize| {
        let probit = 3.0 * ((((pair * 37) % RECORDS) as f64 + 0.5) / RECORDS as f64 - 0.5);
        let other = 0.012 * (0.5 * probit * (1.0 + 0.2 * probit * probit)).exp();
        SetRecord { scaled_to: 1.0, other, pair, event: None, seismology: Seismology::default() }
    };
    let set = RecordSet::new((0..RECORDS).map(record).collect()).unwrap();
    let im: Vec<f64> = (0..30).map(|i| 0.5 * 1.3_f64.powi(i)).collect();
    let rates: Vec<f64> = im.iter().map(|im| 0.5 * im.powf(-1.7)).collect();
    let pgv = HazardCurve::new("PGV", "cm/s", "power law", im.clone(), rates.clone()).unwrap();
    let pga = HazardCurve::new("PGA", "g", "power law", im.iter().map(|im| 0.01 * im).collect(), rates).unwrap();
    let levels: Vec<f64> = (0..LEVELS).map(|i| 1.0 + 2.7 * i as f64).collect();
    let analysis = ScaledAnalysis::new(&set, &levels, &pgv, &pga, &TARGETS, Extrapolation::Refuse).unwrap();
    let solver = Solver::new(&analysis, 0.05).unwrap();
    let mut scratch = Scratch::default();
    let of_set = solver.solve(&set.once(), &[0.0; KNOTS], &mut scratch).unwrap();
    let mut shares = analysis.own_shares();

    let mut group = criterion.benchmark_group("repair");
    group.throughput(Throughput::Elements(100));
    for size in [20, 105] {
        let samples: Vec<Vec<u32>> = (0..100)
            .map(|sample| {
                let mut multiplicities = vec![0; RECORDS];
                // a plain congruential generator: which records does not matter
                let mut state = 12_345 + 7919 * sample;
                for _ in 0..size {
                    state = (state * 1_103_515_245 + 12_345) % (1_usize << 31);
                    multiplicities[(state >> 8) % RECORDS] += 1;
                }
                multiplicities
            })
            .collect();
        group.bench_function(format!("100 samples of {size}"), |bencher| {
            bencher.iter(|| {
                for multiplicities in &samples {
                    let fit = solver.solve_sample(multiplicities, &of_set.exponents, &mut scratch).unwrap();
                    solver.shares(multiplicities, &fit.exponents, &mut scratch, &mut shares).unwrap();
                    black_box(&shares);
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, benchmarks);
criterion_main!(benches);
