//! Columns and restrainers whose answer can be written down.

use proptest::prelude::*;
use uplift_statics::{
    DiscDimensions, DiscSpring, DiscStack, EventKind, Parts, RestrainedColumns, Restrainer, Spring, Stopper, Tendon,
    TendonPath, Threshold, WhenFlat, tilt,
};
use uplift_structure::Geometry;

pub(crate) fn column() -> Geometry {
    Geometry::from_width_and_height(0.2, 1.6).unwrap()
}

pub(crate) fn stack() -> DiscStack {
    let disc = DiscSpring::new(DiscDimensions {
        outer_diameter_m: 0.125,
        inner_diameter_m: 0.061,
        thickness_m: 0.006,
        cone_height_m: 0.0036,
        reduced_thickness_m: None,
    });
    DiscStack::new(disc.unwrap(), 10, 1).unwrap()
}

fn held(parts: Parts, path: TendonPath) -> RestrainedColumns {
    RestrainedColumns::new(column(), 4, 30e3, 2e3)
        .unwrap()
        .with_restrainer(Restrainer::new(parts).unwrap(), path)
        .unwrap()
}

/// A column without restrainer is neutral at `θ = α`, `u = 2b`, and uplifts at `N W b/h`.
#[test]
fn a_free_column() {
    let free = RestrainedColumns::new(column(), 3, 10e3, 2e3).unwrap();
    let capacity = free.capacity().unwrap();
    assert!((capacity.displacement_m - 0.2).abs() < 1e-15, "{capacity:?}");
    assert!((capacity.rotation_rad - (0.125_f64).atan()).abs() < 1e-15);
    assert!((free.uplift_force_n() - 3.0 * 11e3 / 8.0).abs() < 1e-9);
    assert_eq!(capacity.secant_n_m, None);
}

/// Eq. 5.1 in its printed form.
#[test]
fn a_linear_restrainer_at_the_column_is_equation_5_1() {
    let k_n_m = 1.5e6;
    let columns = held(Parts::linear(k_n_m), TendonPath::Column);
    let (r, alpha) = (column().size_m(), column().slenderness_rad());
    for theta in [1e-6_f64, 0.01, 0.1, 0.3] {
        let printed_n = 4.0
            * (31e3 * (alpha - theta).tan()
                + 0.5 * k_n_m * r * alpha.sin().powi(2) * theta.sin() / (alpha - theta).cos());
        let found_n = columns.at_rotation(theta).unwrap().force_n;
        assert!((found_n / printed_n - 1.0).abs() < 1e-12, "{theta}: {found_n} {printed_n}");
    }
}

/// Two linear springs in series, slack, prestress and a stopper that yields: all by hand.
#[test]
fn series_slack_prestress_and_stopper_by_hand() {
    let tendon = Some(Tendon { stiffness_n_m: 3e6, yield_n: Some(30e3), failure_n: None });
    let spring = Parts { tendon, ..Parts::from_spring(Spring::Linear { stiffness_n_m: 1e6 }) };
    // 1/(1/1e6 + 1/3e6) = 750 kN/m
    let state = Restrainer::new(spring).unwrap().at(0.01).unwrap();
    assert!((state.force_n - 7500.0).abs() < 1e-9 && (state.stiffness_n_m - 750e3).abs() < 1e-6, "{state:?}");
    assert!((state.deformation_m.unwrap() - 0.0075).abs() < 1e-15);
    assert!((state.energy_j - 37.5).abs() < 1e-10);

    let slack = Restrainer::new(Parts { slack_m: 0.002, ..spring }).unwrap();
    assert_eq!(slack.at(0.0015).unwrap().force_n, 0.0);
    assert!((slack.at(0.01).unwrap().force_n - 6000.0).abs() < 1e-9);
    assert!((slack.elongation_at_m(Threshold::Taut).unwrap() - 0.002).abs() < 1e-18);

    let prestressed = Restrainer::new(Parts { prestress_n: 1500.0, ..spring }).unwrap();
    let state = prestressed.at(0.01).unwrap();
    assert!((state.force_n - 9000.0).abs() < 1e-9, "{state:?}");
    // T0 Δ + k Δ²/2
    assert!((state.energy_j - (15.0 + 37.5)).abs() < 1e-10, "{state:?}");
    // pushed back it is loose at −T0/k, and its energy there is −T0²/(2k)
    assert!((prestressed.elongation_at_m(Threshold::Taut).unwrap() + 0.002).abs() < 1e-15);
    assert!((prestressed.at(-1.0).unwrap().energy_j + 1.5).abs() < 1e-12);

    // engages at d = 5 mm (T = 5 kN, Δ = 5 mm + 5/3 mm), yields at d = 6 mm (T = 6 + 4 kN, Δ = 6 + 10/3 mm)
    let stopper = Some(Stopper { gap_m: 0.005, stiffness_n_m: 4e6, yield_n: Some(4e3) });
    let stopped = Restrainer::new(Parts { stopper, ..spring }).unwrap();
    let near = |ours: Option<f64>, expected: f64| assert!((ours.unwrap() - expected).abs() < 1e-14, "{ours:?}");
    near(stopped.elongation_at_m(Threshold::StopperEngages), 0.005 + 0.005 / 3.0);
    near(stopped.elongation_at_m(Threshold::StopperYields), 0.006 + 0.01 / 3.0);
    // the tendon's 30 kN: d = 26 mm, Δ = 26 + 10 mm
    near(stopped.elongation_at_force_m(30e3), 0.036);
    // energy there: springs 26²/2 N m, stopper 4 kN·(0.5 + 20) mm, tendon 30²/6 N m
    let state = stopped.at(0.036).unwrap();
    assert!((state.energy_j - (338.0 + 82.0 + 150.0)).abs() < 1e-9, "{state:?}");
    assert_eq!(stopped.elongation_at_force_m(0.0), None);
}

/// Rods that were stretched beyond their yield unload along their stiffness and engage later.
#[test]
fn a_yielded_stopper_unloads_along_its_stiffness() {
    let stopper = Some(Stopper { gap_m: 0.005, stiffness_n_m: 4e6, yield_n: Some(4e3) });
    let law = Restrainer::new(Parts { stopper, ..Parts::from_spring(Spring::Linear { stiffness_n_m: 1e6 }) }).unwrap();
    let after = law.after_yielding(0.016).unwrap();
    // plastic part 10 mm: engages at 15 mm
    for (d, unloading_n) in [(0.016, 16e3 + 4e3), (0.0155, 15.5e3 + 2e3), (0.015, 15e3), (0.01, 10e3), (0.02, 24e3)] {
        let force_n = after.at(d).unwrap().force_n;
        assert!((force_n - unloading_n).abs() < 1e-8, "{d}: {force_n}");
    }
    assert_eq!(law.after_yielding(0.006).unwrap(), law);
}

/// Flat springs: the tendon stretches on with its own stiffness, or the law ends.
#[test]
fn flat_springs() {
    let on = Restrainer::new(Parts::discs(stack(), 13e6)).unwrap();
    let flat_m = on.elongation_at_m(Threshold::SpringsFlat).unwrap();
    let flat_n = stack().flat_force_n();
    assert!((flat_m - (0.036 + flat_n / 13e6)).abs() < 1e-15);
    let state = on.at(flat_m + 0.001).unwrap();
    assert!((state.force_n - flat_n - 13e3).abs() < 1e-7 && state.deformation_m == Some(0.036), "{state:?}");
    let stop = Restrainer::new(Parts { when_flat: WhenFlat::Stop, ..Parts::discs(stack(), 13e6) }).unwrap();
    assert!((stop.limit_m().unwrap() - flat_m).abs() < 1e-15);
    let message = stop.at(flat_m + 0.001).unwrap_err().to_string();
    assert!(message.contains("beyond the 0.04") && message.contains("springs are flat"), "{message}");
    assert_eq!(stop.at(0.5 * flat_m).unwrap(), on.at(0.5 * flat_m).unwrap());
}

/// Section 5.2: a bare tendon of yield strain 0.009 in a column of 9.6 × 1.6 m, as long as the column, yields where
/// `2b sin(θ/2) = 0.009·2h`: by hand θ = 2 asin(0.054), a drift of 10.9 %; in the foundation it is half of it.
#[test]
fn a_bare_tendon_yields_at_eleven_per_cent() {
    let column = Geometry::from_width_and_height(1.6, 9.6).unwrap();
    let (stiffness_n_m, yield_n) = (1e8, 0.009 * 9.6 * 1e8);
    let tendon = Some(Tendon { stiffness_n_m, yield_n: Some(yield_n), failure_n: None });
    let restrainer = Restrainer::new(Parts { tendon, ..Parts::from_spring(Spring::Rigid) }).unwrap();
    let drift = |path| {
        let free = RestrainedColumns::new(column, 1, 2e6, 482_500.0).unwrap();
        let columns = free.with_restrainer(restrainer.clone(), path).unwrap();
        columns.first(EventKind::TendonYields).unwrap().state.drift
    };
    let by_hand = |share: f64| tilt::travel_m(&column, 2.0 * share.asin()) / 9.6;
    for (path, share, printed) in [(TendonPath::Column, 0.054, 0.1088), (TendonPath::Foundation, 0.027, 0.0542)] {
        let found = drift(path);
        assert!((found / by_hand(share) - 1.0).abs() < 1e-13, "{found}");
        assert!((found - printed).abs() < 5e-5, "{found}");
    }
}

/// Half of the restrainers give half of the tendons' part of the force, and a lost tendon is one in four.
#[test]
fn the_loss_of_a_tendon() {
    let all = held(Parts::linear(1.5e6), TendonPath::Column);
    let one_lost = all.clone().with_restrained(3).unwrap();
    let none = all.clone().with_restrained(0).unwrap();
    let force_n = |columns: &RestrainedColumns| columns.at_displacement(0.1).unwrap().force_n;
    let lost_n = force_n(&all) - force_n(&one_lost);
    assert!((lost_n / (0.25 * (force_n(&all) - force_n(&none))) - 1.0).abs() < 1e-12);
    assert!(one_lost.capacity().unwrap().displacement_m < all.capacity().unwrap().displacement_m);
    assert_eq!(none.capacity().unwrap().secant_n_m, None);
    assert!(all.with_restrained(5).is_err());
}

/// A shifted tendon without a gap, as long as the column, is one that is held at the column's foot.
#[test]
fn a_shifted_tendon_without_a_gap() {
    let shifted = TendonPath::Shifted { duct_gap_m: 0.0, tendon_length_m: 1.6 };
    for theta in [0.0, 1e-9, 1e-3, 0.1, 0.4] {
        let (ours, centred) = (shifted.at(&column(), theta), TendonPath::Column.at(&column(), theta));
        assert!((ours.elongation_m - centred.elongation_m).abs() <= 1e-14 * centred.elongation_m.max(1e-3));
        assert!((ours.rate_m - centred.rate_m).abs() < 1e-13, "{theta}: {ours:?} {centred:?}");
    }
}

proptest! {
    /// `Δ' = dΔ/dθ`, by a central difference, before and after the touch; continuous in value and slope where the
    /// tendon touches.
    #[test]
    fn the_rate_is_the_slope_of_the_elongation(
        gap in 0.0005_f64..0.05,
        above in 0.01_f64..2.0,
        theta in 0.001_f64..0.5,
    ) {
        let path = TendonPath::Shifted { duct_gap_m: gap, tendon_length_m: 1.6 + above };
        let step = 1e-6;
        let touch = path.touch_rotation_rad(&column()).unwrap();
        prop_assume!((theta - touch).abs() > 2.0 * step);
        let at = |theta: f64| path.at(&column(), theta);
        let slope = (at(theta + step).elongation_m - at(theta - step).elongation_m) / (2.0 * step);
        prop_assert!((slope - at(theta).rate_m).abs() < 1e-8, "{} {}", slope, at(theta).rate_m);
        let (before, after) = (at(touch * (1.0 - 1e-13)), at(touch * (1.0 + 1e-13)));
        prop_assert!((before.elongation_m - after.elongation_m).abs() < 1e-12);
        prop_assert!((before.rate_m - after.rate_m).abs() < 1e-11, "{before:?} {after:?}");
        // at the touch the tendon is the gap off the axis
        let (sin, cos) = touch.sin_cos();
        let offset = 1.6 * (0.1 * (1.0 - cos) + above * sin) / (1.6 + 0.1 * sin + above * cos);
        prop_assert!((offset - gap).abs() < 1e-12);
    }

    /// Travel and rotation are inverse to each other, to the last digits also where both are tiny.
    #[test]
    fn travel_and_rotation_are_inverse(exponent in -12.0_f64..0.0) {
        let theta = 1.2 * 10.0_f64.powf(exponent);
        let travel = tilt::travel_m(&column(), theta);
        let back = tilt::rotation_rad(&column(), travel).unwrap();
        prop_assert!((back / theta - 1.0).abs() < 1e-14, "{back} {theta}");
    }
}
