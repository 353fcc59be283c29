//! Indices of analytic functions.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use uplift_uncertainty::{Sampling, SobolIndices, sobol_indices, unit_cube};

/// The indices of `function` of independent uniform numbers, from so many rows.
fn indices(
    function: impl Fn(&[f64]) -> f64,
    (rows, factors): (usize, usize),
    (sampling, seed): (Sampling, u64),
) -> Vec<SobolIndices> {
    let points = unit_cube(sampling, (rows, 2 * factors), seed).unwrap();
    let halves = |half: usize| -> Vec<Vec<f64>> {
        points.chunks_exact(2 * factors).map(|row| row[half * factors..(half + 1) * factors].to_vec()).collect()
    };
    let (a, b) = (halves(0), halves(1));
    let of = |points: &[Vec<f64>]| -> Vec<f64> { points.iter().map(|point| function(point)).collect() };
    let mixed: Vec<Vec<f64>> = (0..factors)
        .map(|factor| {
            let with = |(a, b): (&Vec<f64>, &Vec<f64>)| {
                let mut point = a.clone();
                point[factor] = b[factor];
                point
            };
            of(&a.iter().zip(&b).map(with).collect::<Vec<_>>())
        })
        .collect();
    sobol_indices(&of(&a), &of(&b), &mixed, (200, 1)).unwrap().unwrap()
}

/// Sine, squared sine, and an interaction: `sin x + 7 sin² y + 0.1 z⁴ sin x` over −π to π.
///
/// # Source
/// T. Ishigami, T. Homma, ISUMA '90, IEEE 1990, 398–403.
fn ishigami(point: &[f64]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|place| PI * (2.0 * point[place] - 1.0));
    x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin()
}

/// Variances by integration: of x alone ½ (1 + π⁴/50)², of y 49/8, of x and z together 8 π⁸/22500.
fn ishigami_indices() -> [[f64; 2]; 3] {
    let (x, y, xz) = (0.5 * (1.0 + PI.powi(4) / 50.0).powi(2), 49.0 / 8.0, 8.0 * PI.powi(8) / 22_500.0);
    let all = x + y + xz;
    [[x / all, (x + xz) / all], [y / all, y / all], [0.0, xz / all]]
}

#[test]
fn of_ishigamis_function() {
    for sampling in Sampling::ALL {
        let found = indices(ishigami, (8192, 3), (sampling, 1));
        for (found, [first, total]) in found.iter().zip(ishigami_indices()) {
            let tolerance = if sampling == Sampling::Sobol { 0.01 } else { 0.04 };
            assert!((found.first_order.value - first).abs() < tolerance, "{sampling:?}: {found:?} {first}");
            assert!((found.total.value - total).abs() < tolerance, "{sampling:?}: {found:?} {total}");
        }
    }
}

/// `Π (|4 x_i − 2| + a_i)/(1 + a_i)`: a factor matters the less the larger its a;
/// `V_i = 1/(3 (1 + a_i)²)`.
///
/// # Source
/// I. M. Sobol', Math. Model. Comput. Exp. 1 (1993), 407–414.
#[test]
fn of_the_g_function() {
    let weights = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0];
    let function = |point: &[f64]| -> f64 {
        point.iter().zip(&weights).map(|(x, a)| ((4.0 * x - 2.0).abs() + a) / (1.0 + a)).product()
    };
    let alone = weights.map(|a: f64| 1.0 / (3.0 * (1.0 + a).powi(2)));
    let all = alone.iter().map(|variance| 1.0 + variance).product::<f64>() - 1.0;
    let found = indices(function, (8192, 6), (Sampling::Sobol, 2));
    for (found, variance) in found.iter().zip(alone) {
        let total = variance * (1.0 + all) / (1.0 + variance) / all;
        assert!((found.first_order.value - variance / all).abs() < 0.01, "{found:?} {}", variance / all);
        assert!((found.total.value - total).abs() < 0.01, "{found:?} {total}");
    }
}

/// The error of an index covers the truth: of 100 Latin hypercubes of 64 rows the estimates lie within two of their
/// errors in some 95 %.
#[test]
fn errors_are_those_of_the_estimates() {
    let truth = ishigami_indices();
    let mut within = [0; 2];
    for seed in 0..100 {
        let found = indices(ishigami, (64, 3), (Sampling::LatinHypercube, seed));
        for (found, truth) in found.iter().zip(truth) {
            for (which, estimate) in [found.first_order, found.total].into_iter().enumerate() {
                within[which] += usize::from((estimate.value - truth[which]).abs() < 2.0 * estimate.standard_error);
            }
        }
    }
    assert!(within.iter().all(|within| (270..=300).contains(within)), "{within:?} of 300");
}
