//! Where block, negative and zero stiffness must meet. Impacts that take most of the velocity keep the runs from being
//! chaotic.

use uplift_block::RockingBlock;
use uplift_ida::{System, Unwatched, analyse};
use uplift_motion::{Accelerogram, STANDARD_GRAVITY_M_S2 as G};
use uplift_oscillator::{Oscillator, PostUplift};
use uplift_spectra::{MotionSet, RecordOfSet, Scaling};

/// Six seconds of ground that ends where it began, at rest: the second derivative of `A sin⁴(πt/6) sin(ωt)`, m/s².
fn ground(amplitude_m: f64, omega: f64) -> Accelerogram {
    let envelope = std::f64::consts::PI / 6.0;
    let at = |i: u32| {
        let t = 0.005 * f64::from(i);
        let (s, c) = (envelope * t).sin_cos();
        let (e, e1) = (s.powi(4), 4.0 * envelope * s.powi(3) * c);
        let e2 = 4.0 * envelope * envelope * (3.0 * s * s * c * c - s.powi(4));
        let (sin, cos) = (omega * t).sin_cos();
        amplitude_m * (e2 * sin + 2.0 * e1 * omega * cos - e * omega * omega * sin)
    };
    Accelerogram::new(0.005, (0..=1200).map(at).collect()).unwrap()
}

/// Peak displacements, m: a row a system, a column a ground.
fn peaks_m(grounds: &[Accelerogram], systems: &[System]) -> Vec<Vec<f64>> {
    let records = grounds.iter().map(|ground| RecordOfSet { id: "ground", components: [ground, ground] });
    let set = MotionSet::new("grounds", records, G).unwrap();
    let all = analyse(&set.plan(&[Scaling::Unscaled], systems, true).unwrap(), &Unwatched).unwrap();
    // both components are the same
    (0..systems.len()).map(|system| all.over_motions_m(system, 0).into_iter().step_by(2).collect()).collect()
}

fn grounds() -> Vec<Accelerogram> {
    [3.0, 4.5, 6.0, 8.0].map(|omega| ground(0.1, omega)).to_vec()
}

/// Section 2.5: as α → 0, with a height that keeps the base wide, `u_max` → 3/2 PGD.
#[test]
fn the_slender_block_moves_three_halves_of_the_ground() {
    let deviations = [1e-4, 1e-5].map(|alpha| {
        let block = System::Block(RockingBlock::from_height(100.0 / alpha, alpha).unwrap());
        let peaks = &peaks_m(&grounds(), &[block])[0];
        let deviation =
            peaks.iter().zip(grounds()).map(|(peak_m, ground)| (peak_m / (1.5 * ground.pgd_m()) - 1.0).abs());
        deviation.fold(0.0, f64::max)
    });
    assert!(deviations[1] < 0.002 && deviations[1] < 0.2 * deviations[0], "{deviations:?}");
}

/// Eq. 2.19 is Table 3.1's row 4: a slender block is the oscillator of strength α and capacity 2b/Γ, times Γ = 3/2.
#[test]
fn a_slender_block_is_a_negative_stiffness_oscillator() {
    let mut compared = 0;
    for (alpha, height_m) in [(0.02, 60.0), (0.02, 100.0), (0.03, 100.0), (0.01, 200.0)] {
        let block = RockingBlock::from_height(height_m, alpha).unwrap().with_restitution(0.2).unwrap();
        let capacity_m = 2.0 * block.half_width_m() / 1.5;
        let oscillator = Oscillator::new(alpha, G, 1e-7, 0.2, PostUplift::Negative { capacity_m }).unwrap();
        let peaks = peaks_m(&grounds(), &[System::Block(block), System::Oscillator(oscillator)]);
        for (block_m, oscillator_m) in peaks[0].iter().zip(&peaks[1]) {
            assert_eq!(block_m.is_finite(), oscillator_m.is_finite());
            if block_m.is_finite() {
                // the linearisation leaves out terms of the order of α
                assert!((1.5 * oscillator_m / block_m - 1.0).abs() < 3.0 * alpha, "{alpha} {block_m} {oscillator_m}");
                compared += 1;
            }
        }
    }
    assert!(compared > 8, "{compared}");
}

/// Section 2.4.2: blocks of one slenderness move alike, whatever their size, away from overturning.
#[test]
fn size_does_not_matter_away_from_overturning() {
    let blocks = [200.0, 400.0, 4000.0].map(|height_m| {
        System::Block(RockingBlock::from_height(height_m, 0.05).unwrap().with_restitution(0.2).unwrap())
    });
    let peaks = peaks_m(&grounds(), &blocks);
    for ((small, large), endless) in peaks[0].iter().zip(&peaks[1]).zip(&peaks[2]) {
        let share = small / (0.05 * 200.0);
        assert!(*small > 0.01 && share < 0.1, "{small}");
        // the smaller the block the larger its share of the base, and the more it differs
        assert!((small / endless - 1.0).abs() < 3.0 * share, "{small} {endless} {share}");
        assert!((large / endless - 1.0).abs() <= (small / endless - 1.0).abs() + 1e-6, "{small} {large} {endless}");
    }
}
