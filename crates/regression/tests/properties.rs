//! What holds for every data set: optimality, invariance, no panic.
#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use uplift_regression::{Exponential, ExponentialFit, RegressionError, fit};

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs())
}

/// Irregular strengths in (0.05, 1), and a falling curve with a bounded disturbance; c2 < 0 in about half of the cases.
fn noisy() -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
    (
        prop::collection::vec((0.05..1.0_f64, -1.0..1.0_f64), 8..60),
        (0.05..1.0_f64, 2.0..40.0_f64, -0.05..0.05_f64),
        0.001..0.1_f64,
    )
        .prop_map(|(points, (c0, decay, c2), noise)| {
            let curve = Exponential { c0, c1: -decay, c2: c2 * c0 };
            points.iter().map(|&(eta, e)| (eta, curve.at(eta) + noise * c0 * e)).unzip()
        })
}

fn sse(eta: &[f64], u: &[f64], curve: Exponential) -> f64 {
    eta.iter().zip(u).map(|(&eta, u)| (u - curve.at(eta)).powi(2)).sum()
}

/// Best error for a given c1 by the normal equations in their textbook form, an independent way to the same number.
fn best_for(eta: &[f64], u: &[f64], c1: f64) -> f64 {
    let end = eta.iter().map(|&eta| c1 * eta).fold(f64::NEG_INFINITY, f64::max);
    let phi: Vec<f64> = eta.iter().map(|eta| (c1 * eta - end).exp()).collect();
    let n = eta.len() as f64;
    let (p, pp) = (phi.iter().sum::<f64>(), phi.iter().map(|p| p * p).sum::<f64>());
    let (y, py) = (u.iter().sum::<f64>(), phi.iter().zip(u).map(|(p, u)| p * u).sum::<f64>());
    let determinant = n * pp - p * p;
    let (mut a, mut b) = ((n * py - p * y) / determinant, (pp * y - p * py) / determinant);
    if b < 0.0 {
        (a, b) = (py / pp, 0.0);
    }
    phi.iter().zip(u).map(|(p, u)| (u - a * p - b).powi(2)).sum()
}

/// The smallest error over a dense grid of c1 of both signs.
fn brute_force(eta: &[f64], u: &[f64]) -> f64 {
    (0..4000)
        .map(|i| 10.0_f64.powf(-1.0 + f64::from(i) / 4000.0 * 4.0))
        .flat_map(|c1| [best_for(eta, u, c1), best_for(eta, u, -c1)])
        .fold(f64::INFINITY, f64::min)
}

fn total(fit: &ExponentialFit) -> f64 {
    fit.rmse_plain.powi(2) * fit.points as f64
}

proptest! {
    #[test]
    fn no_grid_point_is_better((eta, u) in noisy()) {
        if let Ok(found) = fit(&eta, &u) {
            let grid = brute_force(&eta, &u);
            prop_assert!(total(&found) <= grid * (1.0 + 1e-9) + 1e-24, "{} {} {:?}", total(&found), grid, found);
        }
    }

    /// Data that are not an exponential at all: the search is still global.
    #[test]
    fn no_grid_point_is_better_for_pure_noise(points in prop::collection::vec((0.0..1.0_f64, -1.0..1.0_f64), 5..30)) {
        let (eta, u): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        if let Ok(found) = fit(&eta, &u) {
            let grid = brute_force(&eta, &u);
            prop_assert!(total(&found) <= grid * (1.0 + 1e-9), "{} {} {:?}", total(&found), grid, found);
        }
    }

    /// Karush–Kuhn–Tucker: stationary in c0 and c1, and in c2 or on the bound with the error rising inwards.
    #[test]
    fn optimality_conditions((eta, u) in noisy()) {
        let Ok(found) = fit(&eta, &u) else { return Ok(()) };
        if found.at_search_limit || found.c1 > 0.0 {
            return Ok(());
        }
        let (mut r0, mut r1, mut r2, mut size) = (0.0, 0.0, 0.0, 0.0);
        for (&eta, u) in eta.iter().zip(&u) {
            let r = u - found.curve().at(eta);
            // Relative to the first strength, as the amplitude at η = 0 may be large.
            let phi = (found.c1 * (eta - 0.05)).exp();
            (r0, r1, r2, size) = (r0 + r * phi, r1 + r * phi * (eta - 0.05), r2 + r, size + r.abs());
        }
        prop_assert!(r0.abs() < 1e-9 * size && r1.abs() < 1e-9 * size, "{} {} {}", r0, r1, size);
        prop_assert!(found.c2 >= 0.0);
        if found.bound_active {
            prop_assert!(found.c2 == 0.0 && r2 <= 1e-9 * size);
        } else {
            prop_assert!(r2.abs() < 1e-9 * size);
        }
    }

    #[test]
    fn reported_errors_are_those_of_the_curve((eta, u) in noisy()) {
        let Ok(found) = fit(&eta, &u) else { return Ok(()) };
        if found.at_search_limit {
            return Ok(());
        }
        prop_assert!(close(sse(&eta, &u, found.curve()), total(&found), 1e-7));
        let n = eta.len() as f64;
        prop_assert!(close(found.rmse * ((n - 3.0) / n).sqrt(), found.rmse_plain, 1e-14));
        let largest = eta.iter().zip(&u).map(|(&eta, u)| (u - found.curve().at(eta)).abs()).fold(0.0, f64::max);
        prop_assert!(close(largest, found.max_abs_residual, 1e-8));
    }

    #[test]
    fn exact_curves_are_recovered(c0 in 0.01..1.0_f64, decay in 1.0..60.0_f64, share in 0.0..0.1_f64) {
        let curve = Exponential { c0, c1: -decay, c2: share * c0 };
        let eta: Vec<f64> = (16..=300).map(|i| f64::from(i) / 300.0).collect();
        let u: Vec<f64> = eta.iter().map(|&eta| curve.at(eta)).collect();
        let found = fit(&eta, &u)?;
        prop_assert!(close(found.c1, curve.c1, 1e-9) && close(found.c0, c0, 1e-9), "{:?}", found);
        prop_assert!((found.c2 - curve.c2).abs() < 1e-10 * c0, "{:?}", found);
    }

    /// Scaling by a power of two changes no digit; any other factor none that matter.
    #[test]
    fn scaling_displacements((eta, u) in noisy(), k in 1e-3..1e3_f64, power in -40..40_i32) {
        let Ok(plain) = fit(&eta, &u) else { return Ok(()) };
        // A steep rising curve has an amplitude at η = 0 near the smallest numbers, which no scale
        // may take further down.
        if plain.c0.abs() < 1e-250 {
            return Ok(());
        }
        let two = 2.0_f64.powi(power);
        let exact = fit(&eta, &u.iter().map(|u| u * two).collect::<Vec<_>>())?;
        prop_assert_eq!((exact.c0, exact.c1, exact.c2), (plain.c0 * two, plain.c1, plain.c2 * two));
        prop_assert_eq!(exact.rmse, plain.rmse * two);
        if plain.at_search_limit {
            return Ok(());
        }
        let scaled = fit(&eta, &u.iter().map(|u| u * k).collect::<Vec<_>>())?;
        prop_assert!(close(scaled.rmse, plain.rmse * k, 1e-9));
        let size = u.iter().fold(0.0_f64, |size, u| size.max(u.abs()));
        for &eta in &eta {
            prop_assert!((scaled.curve().at(eta) - plain.curve().at(eta) * k).abs() < 1e-6 * size * k);
        }
    }

    /// η → qη + d gives c1/q and the same curve at the moved points.
    #[test]
    fn moving_and_stretching_strengths((eta, u) in noisy(), q in 0.2..5.0_f64, d in -1.0..1.0_f64) {
        let Ok(plain) = fit(&eta, &u) else { return Ok(()) };
        if plain.at_search_limit {
            return Ok(());
        }
        let moved = match fit(&eta.iter().map(|eta| q * eta + d).collect::<Vec<_>>(), &u) {
            // A steep curve moved away from η = 0 may have an amplitude there that overflows.
            Err(RegressionError::Overflow { c1, .. }) => {
                prop_assert!(c1.abs() > 100.0);
                return Ok(());
            }
            other => other?,
        };
        prop_assert!(close(moved.rmse, plain.rmse, 1e-9));
        let size = u.iter().fold(0.0_f64, |size, u| size.max(u.abs()));
        for &eta in &eta {
            let (a, b) = (moved.curve().at(q * eta + d), plain.curve().at(eta));
            prop_assert!((a - b).abs() < 1e-6 * size, "{} {} {:?} {:?}", a, b, plain, moved);
        }
    }

    #[test]
    fn any_numbers_never_panic(points in prop::collection::vec((prop::num::f64::ANY, prop::num::f64::ANY), 0..12)) {
        let (eta, u): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        let _ = fit(&eta, &u);
    }

    #[test]
    fn finite_numbers_of_any_size_never_panic(
        points in prop::collection::vec((prop::num::f64::NORMAL, prop::num::f64::NORMAL), 4..12),
        power in -300..0_i32,
    ) {
        let (eta, u): (Vec<f64>, Vec<f64>) = points.into_iter().map(|(eta, u)| (eta * 10.0_f64.powi(power), u)).unzip();
        if let Ok(found) = fit(&eta, &u) {
            prop_assert!(found.c0.is_finite() && found.c2 >= 0.0 && found.rmse.is_finite(), "{:?}", found);
        }
    }
}
