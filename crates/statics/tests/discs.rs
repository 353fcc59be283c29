//! Disc springs against what is known of the formula by hand.
#![allow(clippy::unwrap_used)]

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

/// DIN 2093 prints 0.75 h0 loads; for 50/25.4/3 (series A, h0 1.1 mm) it is 12.0 kN, and 20/10.2/1.1 (h0 0.45 mm)
/// 1.53 kN: printed to three digits.
#[test]
fn two_loads_of_the_standard() {
    for (spring, load_n) in
        [(disc(0.05, 0.0254, 0.003, 0.0011), 12_000.0), (disc(0.02, 0.0102, 0.0011, 0.00045), 1_530.0)]
    {
        let found_n = spring.force_n(0.75 * spring.flat_deflection_m());
        assert!((found_n / load_n - 1.0).abs() < 0.01, "{found_n} {load_n}");
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
