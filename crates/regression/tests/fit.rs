//! Fits whose answer is known: exact curves, the dissertation's coefficients, hand-solved bounds, and what is refused.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::path::Path;

use uplift_regression::{Exponential, RegressionError, fit};

/// The strengths of Section 4.3.4 above 0.05: i/300.
fn strengths() -> Vec<f64> {
    (16..=300).map(|i| f64::from(i) / 300.0).collect()
}

fn displacements(curve: Exponential, strengths: &[f64]) -> Vec<f64> {
    strengths.iter().map(|&eta| curve.at(eta)).collect()
}

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * b.abs()
}

#[test]
fn exact_curves_are_recovered() {
    for (c0, c1, c2) in [
        (0.5651, -5.2976, 0.0),
        (0.0191, -46.114, 0.0003),
        (0.1, -0.3, 0.002),
        (1e6, -300.0, 0.01),
        (0.2, 3.0, 0.1),
        (-0.1, -4.0, 0.3),
        (-0.001, 5.0, 0.2),
    ] {
        let u = displacements(Exponential { c0, c1, c2 }, &strengths());
        let found = fit(&strengths(), &u).unwrap();
        assert!(close(found.c1, c1, 1e-9), "{c1}: {found:?}");
        assert!(close(found.c0, c0, 1e-9), "{c0}: {found:?}");
        assert!((found.c2 - c2).abs() < 1e-11, "{c2}: {found:?}");
        assert!(found.rmse < 1e-14 && found.max_abs_residual < 1e-14, "{found:?}");
        assert!(!found.at_search_limit);
        assert_eq!(found.points, 285);
    }
}

/// Points made from every row of the dissertation's Table 4.2 give its coefficients back.
#[test]
fn the_curves_of_table_4_2_are_recovered() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference/table_4_2.csv");
    let text = std::fs::read_to_string(&file).unwrap();
    let rows: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| !line.starts_with('#') && !line.starts_with("site"))
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(rows.len(), 18);
    for row in rows {
        let [c0, c1, c2] = [2, 3, 4].map(|column: usize| row[column].parse::<f64>().unwrap());
        let found = fit(&strengths(), &displacements(Exponential { c0, c1, c2 }, &strengths())).unwrap();
        assert!(close(found.c0, c0, 1e-8) && close(found.c1, c1, 1e-8), "{row:?}: {found:?}");
        assert!((found.c2 - c2).abs() < 1e-8 * c0, "{row:?}: {found:?}");
    }
}

/// Four points solved by hand: at η = 0 the values 4 and 6, at η = 1 and 2 the values 3 and 2. The best curve passes
/// through the mean 5 and the two others: 4 q^η + 1 with q = 1/2.
#[test]
fn four_points_by_hand() {
    let found = fit(&[0.0, 0.0, 1.0, 2.0], &[4.0, 6.0, 3.0, 2.0]).unwrap();
    assert!(close(found.c0, 4.0, 1e-12) && close(found.c2, 1.0, 1e-12), "{found:?}");
    assert!(close(found.c1, -std::f64::consts::LN_2, 1e-12));
    // Residuals −1, 1, 0, 0 with one degree of freedom.
    assert!(close(found.rmse, 2.0_f64.sqrt(), 1e-12));
    assert!(close(found.rmse_plain, 0.5_f64.sqrt(), 1e-12));
    assert!(close(found.max_abs_residual, 1.0, 1e-12));
    assert_eq!(found.max_abs_residual_strength, 0.0);
    assert!(!found.bound_active);
}

/// The same with 2 and 0.5 at η = 1 and 2: the free curve through 5, 2 and 0.5 is 6 q^η − 1 with q = 1/2.
#[test]
fn the_bound_holds_where_the_free_curve_goes_negative() {
    let (eta, u) = ([0.0, 0.0, 1.0, 2.0], [4.0, 6.0, 2.0, 0.5]);
    let found = fit(&eta, &u).unwrap();
    assert!(found.bound_active && found.c2 == 0.0, "{found:?}");
    // On the bound u = c0 q^η with two normal equations; q is the root of their combination, by bisection.
    let stationarity = |q: f64| {
        let (product, square) = (10.0 + 2.0 * q + 0.5 * q * q, 2.0 + q * q + q.powi(4));
        let c0 = product / square;
        (2.0 - c0 * q) + 2.0 * q * (0.5 - c0 * q * q)
    };
    let (mut low, mut high) = (0.1, 0.9);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if stationarity(middle) > 0.0 { low = middle } else { high = middle }
    }
    assert!(close(found.c1, low.ln(), 1e-12), "{} {}", found.c1, low.ln());
}

#[test]
fn a_curve_with_a_negative_offset_is_held_at_the_bound() {
    let eta = strengths();
    let u = displacements(Exponential { c0: 0.5, c1: -4.0, c2: -0.02 }, &eta);
    let found = fit(&eta, &u).unwrap();
    assert!(found.bound_active && found.c2 == 0.0 && !found.at_search_limit);
    // Release would pay: the residuals sum to less than zero.
    let sum: f64 = eta.iter().zip(&u).map(|(&eta, u)| u - found.curve().at(eta)).sum();
    assert!(sum < 0.0);
}

#[test]
fn lines_and_steps_are_said_to_be_no_exponentials() {
    let eta = strengths();
    let line: Vec<f64> = eta.iter().map(|eta| 2.0 - eta).collect();
    let found = fit(&eta, &line).unwrap();
    assert!(found.at_search_limit);
    assert!(found.max_abs_residual < 2e-4, "the curve is near the line all the same: {found:?}");
    let mut step = vec![0.1; eta.len()];
    step[0] = 0.3;
    let found = fit(&eta, &step).unwrap();
    assert!(found.at_search_limit && found.rmse < 1e-15, "{found:?}");
}

#[test]
fn order_and_repetition_of_points_do_not_matter() {
    let eta = strengths();
    let u: Vec<f64> = eta.iter().map(|eta| 0.3 * (-9.0 * eta).exp() + 0.001 * (40.0 * eta).sin().abs()).collect();
    let plain = fit(&eta, &u).unwrap();
    let reverse = |values: &[f64]| values.iter().rev().copied().collect::<Vec<_>>();
    let reversed = fit(&reverse(&eta), &reverse(&u)).unwrap();
    let twice = fit(&[eta.clone(), eta].concat(), &[u.clone(), u].concat()).unwrap();
    for other in [reversed, twice] {
        assert!(
            close(other.c1, plain.c1, 1e-10) && close(other.c0, plain.c0, 1e-10) && close(other.c2, plain.c2, 1e-9)
        );
        assert!(close(other.rmse_plain, plain.rmse_plain, 1e-12));
    }
}

#[test]
fn extreme_scales() {
    let eta = strengths();
    let curve = Exponential { c0: 0.3, c1: -8.0, c2: 0.01 };
    for scale in [1e-290, 1e-12, 1e12, 1e300] {
        let u: Vec<f64> = displacements(curve, &eta).iter().map(|u| u * scale).collect();
        let found = fit(&eta, &u).unwrap();
        assert!(close(found.c1, -8.0, 1e-9) && close(found.c0, 0.3 * scale, 1e-9), "{scale}: {found:?}");
    }
}

#[test]
fn what_cannot_be_fitted_is_refused_with_its_reason() {
    let message = |eta: &[f64], u: &[f64]| fit(eta, u).unwrap_err().to_string();
    assert_eq!(
        message(&[0.1, 0.2, 0.3], &[3.0, 2.0, 1.0]),
        "3 points; three coefficients and an error estimate need at least 4"
    );
    assert!(matches!(fit(&[], &[]), Err(RegressionError::TooFewPoints { points: 0 })));
    assert_eq!(message(&[0.1, 0.2], &[1.0]), "2 strengths but 1 displacements; give one displacement per strength");
    assert_eq!(
        message(&[0.1, 0.2, 0.3, 0.4], &[3.0, 2.0, f64::NAN, 1.0]),
        "displacement at index 2 is NaN; leave censored or missing ordinates out of the fit"
    );
    assert!(message(&[0.1, f64::INFINITY, 0.3, 0.4], &[3.0, 2.0, 1.0, 1.0]).starts_with("strength at index 1 is inf"));
    assert_eq!(
        message(&[0.1, 0.1, 0.3, 0.3], &[3.0, 2.0, 1.0, 0.0]),
        "2 different strengths; three coefficients need at least 3"
    );
    assert!(message(&[0.1; 4], &[3.0, 2.0, 1.0, 0.0]).starts_with("1 different strengths"));
    assert_eq!(
        message(&[0.1, 0.2, 0.3, 0.4], &[0.5; 4]),
        "all 4 displacements equal 0.5: a constant does not determine c0 and c1"
    );
    assert!(message(&[0.1, 0.2, 0.3, 0.4], &[0.0; 4]).starts_with("all 4 displacements equal 0:"));
    // An exponential far from η = 0 has an amplitude there that overflows.
    let far: Vec<f64> = (0..20).map(|i| 1000.0 + f64::from(i) * 0.05).collect();
    let u: Vec<f64> = far.iter().map(|eta| (-5.0 * (eta - 1000.0)).exp() + 0.01).collect();
    assert!(matches!(fit(&far, &u), Err(RegressionError::Overflow { what: "c0", .. })));
    assert!(matches!(fit(&[-1e308, 0.0, 1.0, 1e308], &[4.0, 3.0, 2.0, 1.0]), Err(RegressionError::Overflow { .. })));
}
