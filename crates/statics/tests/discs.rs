//! Disc springs against what is known of the formula by hand.

use proptest::prelude::*;
use uplift_statics::{DiscDimensions, DiscSpring, DiscStack};

fn disc(outer: f64, inner: f64, thickness: f64, cone: f64) -> DiscSpring {
    DiscSpring::new(DiscDimensions {
        outer_diameter_m: outer,
        inner_diameter_m: inner,
        thickness_m: thickness,
        cone_height_m: cone,
        reduced_thickness_m: None,
    })
    .unwrap()
}

/// Flat, the bracket is 1: `F = 4E/(1 − ν²) t³ h0/(K1 De²)`. For De = 2 Di, `K1 = (1/4)/(π (3 − 2/ln 2))`, so that
/// by hand K1 = 0.694 for 1/2, and 100/50/5/2 has 4·206e9/0.91 · 125e-9·2e-3/(0.6940·0.01) N.
#[test]
fn the_flat_load_by_hand() {
    let k1 = 0.25 / (std::f64::consts::PI * (3.0 - 2.0 / 2.0_f64.ln()));
    assert!((k1 - 0.694).abs() < 1e-3, "{k1}");
    let by_hand_n = 4.0 * 206e9 / 0.91 * 0.005_f64.powi(3) * 0.002 / (k1 * 0.01);
    let found_n = disc(0.1, 0.05, 0.005, 0.002).flat_force_n();
    assert!((found_n / by_hand_n - 1.0).abs() < 1e-13, "{found_n} {by_hand_n}");
}

/// DIN 2093 has the load at 0.75 h0 of every size, to three digits: series A and B, the last four with contact flats.
/// Its nominal reduced thickness is that which keeps the load of the plain disc.
#[test]
fn loads_of_the_standard() {
    for ([outer, inner, thickness, cone], reduced, load_n) in [
        ([20.0, 10.2, 1.1, 0.45], None, 1_530.0),
        ([50.0, 25.4, 3.0, 1.1], None, 12_000.0),
        ([63.0, 31.0, 3.5, 1.4], None, 15_000.0),
        ([100.0, 51.0, 6.0, 2.2], None, 48_000.0),
        ([50.0, 25.4, 2.0, 1.4], None, 4_760.0),
        ([80.0, 41.0, 3.0, 2.3], None, 10_500.0),
        ([100.0, 51.0, 3.5, 2.8], None, 13_100.0),
        ([125.0, 64.0, 8.0, 2.6], Some(7.5), 85_900.0),
        ([160.0, 82.0, 10.0, 3.5], Some(9.4), 138_000.0),
        ([200.0, 102.0, 12.0, 4.2], Some(11.25), 183_000.0),
        ([200.0, 102.0, 8.0, 5.6], Some(7.5), 76_400.0),
    ] {
        let plain = disc(1e-3 * outer, 1e-3 * inner, 1e-3 * thickness, 1e-3 * cone);
        let reduced_thickness_m = reduced.map(|reduced: f64| 1e-3 * reduced);
        let ground = DiscSpring::new(DiscDimensions { reduced_thickness_m, ..plain.dimensions() }).unwrap();
        let at_m = 0.75e-3 * cone;
        assert!((ground.force_n(at_m) / load_n - 1.0).abs() < 0.007, "{outer}: {} {load_n}", ground.force_n(at_m));
        assert!((ground.force_n(at_m) / plain.force_n(at_m) - 1.0).abs() < 0.001, "{outer}");
    }
}

/// With a thickness that is hardly reduced the contact flats change nothing: `K4 → 1`.
#[test]
fn contact_flats_of_no_width_change_nothing() {
    let plain = disc(0.2, 0.092, 0.01, 0.0056);
    let dimensions = DiscDimensions { reduced_thickness_m: Some(0.01 * (1.0 - 1e-9)), ..plain.dimensions() };
    let flat = DiscSpring::new(dimensions).unwrap();
    assert!((flat.flats_factor() - 1.0).abs() < 1e-8, "{}", flat.flats_factor());
    assert!((flat.force_n(0.004) / plain.force_n(0.004) - 1.0).abs() < 1e-7);
}

/// With a thickness reduced as the standard does, the load at 0.75 h0 is that of the plain disc within some per cent:
/// this is what it is reduced for.
#[test]
fn the_reduced_thickness_keeps_the_load() {
    let plain = disc(0.2, 0.092, 0.01, 0.0056);
    let dimensions = DiscDimensions { reduced_thickness_m: Some(0.0095), ..plain.dimensions() };
    let ground = DiscSpring::new(dimensions).unwrap();
    let change = ground.force_n(0.75 * 0.0056) / plain.force_n(0.75 * 0.0056) - 1.0;
    assert!(change.abs() < 0.02, "{change}");
}

proptest! {
    /// Below √2 the force rises from 0 to flat; above, it falls somewhere. The stiffness is least at `s = h0`.
    #[test]
    fn the_force_rises_below_the_square_root_of_two(ratio in 0.05_f64..2.0, share in 0.0_f64..1.0) {
        let spring = disc(0.1, 0.05, 0.004, 0.004 * ratio);
        let stiffness = |share: f64| spring.law().stiffness_n_m(share * spring.flat_deflection_m());
        prop_assert!(stiffness(share) >= stiffness(1.0) * (1.0 - 1e-12));
        prop_assert_eq!(stiffness(1.0) <= 1e-9 * stiffness(0.0), spring.snaps_through());
        prop_assert!(spring.law().energy_j(share * spring.flat_deflection_m()) >= 0.0);
    }

    /// `i F1(d/n)`, energies too: a stack of n in series stores n times what one does at a share of the deformation.
    #[test]
    fn a_stack_is_its_discs(n in 1_u32..40, i in 1_u32..5, share in 0.0_f64..1.0) {
        let spring = disc(0.125, 0.061, 0.006, 0.0036);
        let stack = DiscStack::new(spring, n, i).unwrap();
        let s = share * spring.flat_deflection_m();
        let d = share * stack.flat_deformation_m();
        let (n, i) = (f64::from(n), f64::from(i));
        let close = |ours: f64, expected: f64| (ours - expected).abs() <= 1e-12 * expected.abs();
        prop_assert!(close(stack.law().force_n(d), i * spring.force_n(s)));
        prop_assert!(close(stack.law().energy_j(d), n * i * spring.law().energy_j(s)));
        prop_assert!(close(stack.law().stiffness_n_m(d), i / n * spring.law().stiffness_n_m(s)));
    }
}
