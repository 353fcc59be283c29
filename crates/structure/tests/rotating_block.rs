//! Structures and the solitary blocks that rotate as they do.

use proptest::prelude::*;
use uplift_structure::{
    Block, Body, Conditions, EquivalentSystem, Frame, Geometry, PointMass, Reference, RotatingBlock,
};

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * a.abs().max(b.abs())
}

/// What the rotation of a linearised system depends on: the acceleration that lifts it, over g, and the rate of
/// its divergence, 1/s².
fn rotation(system: &EquivalentSystem) -> [f64; 2] {
    let capacity_m = system.capacity().unwrap().capacity_m();
    [system.spectral_strength(), system.strength() * system.conditions().gravity_m_s2() / capacity_m]
}

fn as_block(block: RotatingBlock) -> EquivalentSystem {
    let geometry = Geometry::from_slenderness_and_size(block.slenderness_rad, block.size_m).unwrap();
    Block::new(geometry, 1000.0).unwrap().equivalent(Reference::Top, Conditions::new(9.81, 0.0).unwrap()).unwrap()
}

proptest! {
    /// Table 3.1 was derived structure by structure: each row must be that of its block.
    #[test]
    fn the_equivalent_oscillator_of_the_block_is_that_of_the_structure(
        alpha in 0.02..0.5_f64, size in 0.2..30.0_f64, ratio in 1.0..3.0_f64, deck in 0.0..20.0_f64,
        columns in 1..9_u32,
    ) {
        let geometry = Geometry::from_slenderness_and_size(alpha, size).unwrap();
        let conditions = Conditions::new(9.81, 0.0).unwrap();
        let point = PointMass::new(geometry, 700.0).unwrap();
        let body = Body::new(geometry, 700.0, ratio * 700.0 * size * size * (1.0 + 1e-12)).unwrap();
        let frame = Frame::new(geometry, columns, 700.0, deck * 700.0).unwrap();
        for (system, block) in [
            (point.equivalent(conditions), point.rotating_block()),
            (body.equivalent(conditions), body.rotating_block()),
            (frame.equivalent(conditions), frame.rotating_block()),
        ] {
            // the rows are linearised in the width as well: b = R sin α stands for R α
            let [strength, rate] = rotation(&system.unwrap());
            let [of_block, rate_of_block] = rotation(&as_block(block));
            prop_assert!(close(strength, of_block), "{} {}", strength, of_block);
            prop_assert!(close(rate, rate_of_block), "{} {}", rate, rate_of_block);
            prop_assert!((0.0..1.0).contains(&block.restitution));
        }
    }

    /// Angular momentum about the next pivot, written out for a column that carries its share of the deck at a corner.
    #[test]
    fn an_impact_conserves_the_angular_momentum_about_the_next_pivot(
        alpha in 0.02..0.6_f64, size in 0.2..30.0_f64, deck in 0.0..20.0_f64, columns in 1..9_u32,
    ) {
        let geometry = Geometry::from_slenderness_and_size(alpha, size).unwrap();
        let (b, h, m) = (geometry.half_width_m(), geometry.half_height_m(), 700.0);
        let frame = Frame::new(geometry, columns, m, f64::from(columns) * deck * m).unwrap();
        let r = frame.rotating_block().restitution;
        // unit rate before: the centre moves by h to the side and b down, the deck by 2h and 2b; afterwards all turn
        // about the other corner
        let spin = m * (b * b + h * h) / 3.0;
        let column_before = spin + m * (h * h - b * b);
        let column_after = r * (spin + m * (h * h + b * b));
        // impulse of the deck on its new corner, (−2b, 2h) from the next pivot
        let impulse = [-deck * m * 2.0 * h * (r - 1.0), -deck * m * 2.0 * b * (r + 1.0)];
        let moment = 2.0 * h * impulse[0] + 2.0 * b * impulse[1];
        prop_assert!((column_after - column_before - moment).abs() < 1e-9 * spin.max(moment.abs()));
    }
}

#[test]
fn special_cases_are_each_other() {
    let geometry = Geometry::from_slenderness_and_size(0.2, 5.0).unwrap();
    let block = Block::new(geometry, 900.0).unwrap().rotating_block();
    assert_eq!(
        block,
        RotatingBlock { size_m: 5.0, slenderness_rad: 0.2, restitution: 1.0 - 1.5 * 0.2_f64.sin().powi(2) }
    );
    // a frame without a deck, and a body of a block's inertia, are blocks
    let columns = Frame::new(geometry, 3, 900.0, 0.0).unwrap().rotating_block();
    let body = Body::new(geometry, 900.0, 4.0 / 3.0 * 900.0 * 25.0).unwrap().rotating_block();
    for other in [columns, body] {
        assert!(close(other.size_m, 5.0) && close(other.restitution, block.restitution), "{other:?}");
    }
    // massless columns: the deck moves with the tops, twice as far as a mass at the centre; cos 2α at the impact
    // (Makris and Vassiliou 2013)
    let deck = Frame::new(geometry, 3, 0.0, 900.0).unwrap().rotating_block();
    let point = PointMass::new(geometry, 900.0).unwrap().rotating_block();
    assert!(close(deck.size_m, 7.5) && close(deck.restitution, 0.4_f64.cos()), "{deck:?}");
    assert!(close(point.size_m, 3.75) && close(point.restitution, 0.4_f64.cos()), "{point:?}");
    // Section 2.4.3: columns of 6.7 m under a heavy deck rotate as a block of 10 m
    let columns = Geometry::from_slenderness_and_height(0.2, 6.7).unwrap();
    let bridge = Frame::new(columns, 4, 1.0, 1e9).unwrap().rotating_block();
    assert!((2.0 * bridge.size_m * 0.2_f64.cos() - 10.05).abs() < 1e-6);
}
