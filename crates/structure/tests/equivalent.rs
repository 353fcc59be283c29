//! A block and its equivalent oscillator under the same motion.

use uplift_block::{FreeRocking, RickerPulse, RickerShape, RockingBlock};
use uplift_motion::Accelerogram;
use uplift_oscillator::{Excitation, FreeVibration, respond};
use uplift_structure::{Block, Conditions, Geometry, Reference};

// The models under one pulse: what linearisation and the small displacement before uplift leave goes with α², and Γ is
// 3/2.
#[test]
fn oscillator_and_block_agree_where_both_are_exact() {
    let difference = |alpha: f64| {
        let geometry = Geometry::from_slenderness_and_size(alpha, 5.0).unwrap();
        let conditions = Conditions::new(9.806_65, 1e-6 * geometry.width_m()).unwrap();
        let system = Block::new(geometry, 1.0).unwrap().equivalent(Reference::Top, conditions).unwrap();
        assert_eq!(system.participation(), 1.5);
        let block = RockingBlock::new(5.0, alpha).unwrap().with_restitution(0.9).unwrap();
        let (amplitude_m_s2, dt_s) = (2.0 * block.uplift_acceleration_m_s2(), 1e-3);
        let pulse = RickerPulse::new(RickerShape::Symmetric, amplitude_m_s2, 0.8).unwrap();
        let start_s = uplift_block::Excitation::from(pulse).start_s();
        let samples = (0..6000).map(|sample| pulse.acceleration_m_s2(start_s + dt_s * f64::from(sample))).collect();
        let record = Accelerogram::new(dt_s, samples).unwrap();
        let rocked = uplift_block::respond(&block, &record, FreeRocking::FirstPeak).unwrap();
        let excitation = Excitation::new(dt_s, record.acceleration_m_s2()).unwrap();
        let swayed = respond(&system.spectral_oscillator(0.9).unwrap(), &excitation, FreeVibration::FirstPeak);
        assert!(rocked.impacts > 0 && !rocked.is_overturned());
        (1.5 * swayed.peak_displacement_m / rocked.displacement_m - 1.0).abs()
    };
    let [stocky, slender, needle] = [0.3, 0.1, 0.01].map(difference);
    assert!(needle < 2e-3, "{needle}");
    assert!(needle < slender && slender < stocky, "{needle} {slender} {stocky}");
}
