//! What holds for every block and every record.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use uplift_block::{
    BlockError, BlockResponse, FreeRocking, Moment, Overturning, RickerPulse, RickerShape, RockingBlock, respond,
    respond_with_history,
};
use uplift_motion::Accelerogram;

fn peak(block: &RockingBlock, record: &Accelerogram) -> BlockResponse {
    respond(block, record, FreeRocking::FirstPeak).unwrap()
}

fn record(samples: &[f64]) -> Accelerogram {
    Accelerogram::new(0.02, samples.to_vec()).unwrap()
}

/// The same motion with twice the samples.
fn refined(samples: &[f64]) -> Accelerogram {
    let mut fine = vec![samples[0]];
    for ends in samples.windows(2) {
        fine.extend([0.5 * (ends[0] + ends[1]), ends[1]]);
    }
    Accelerogram::new(0.01, fine).unwrap()
}

prop_compose! {
    fn blocks()(
        size in 0.3..50.0_f64, alpha in 0.05..0.6_f64, given in prop::option::of(0.3..1.0_f64),
    ) -> RockingBlock {
        let block = RockingBlock::new(size, alpha).unwrap();
        given.map_or(block, |r| block.with_restitution(r).unwrap())
    }
}

fn shakings() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-12.0..12.0_f64, 2..150)
}

/// Asserts that `other` is the response `one` of `block` to `motion` up to rounding, as the motion amplifies it: by how
/// much a change of 1e-10 of the record changes the peak.
fn nearly(block: &RockingBlock, motion: &Accelerogram, one: &BlockResponse, other: &BlockResponse) -> TestCaseResult {
    prop_assert_eq!(one.overturning, other.overturning);
    if one.is_overturned() || one.rotation_rad == 0.0 {
        prop_assert_eq!(one.rotation_rad, other.rotation_rad);
        return Ok(());
    }
    let change = |other: &BlockResponse| (other.rotation_rad / one.rotation_rad - 1.0).abs();
    let amplification = change(&peak(block, &motion.scaled(1.0 + 1e-10).unwrap())) / 1e-10;
    prop_assert!(change(other) <= 1e-11 + 1e-13 * amplification, "{one:?} {other:?}, amplification {amplification:e}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn mirrored_motions_have_the_same_response_to_the_bit(block in blocks(), samples in shakings()) {
        let motion = record(&samples);
        prop_assert_eq!(peak(&block, &motion), peak(&block, &motion.scaled(-1.0).unwrap()));
    }

    #[test]
    fn what_does_not_exceed_g_tan_alpha_moves_nothing(block in blocks(), samples in shakings(), part in 0.0..1.0_f64) {
        let largest = samples.iter().fold(1e-9_f64, |peak, a| peak.max(a.abs()));
        let still = record(&samples).scaled(part * block.uplift_acceleration_m_s2() / largest).unwrap();
        let response = peak(&block, &still);
        prop_assert_eq!((response.rotation_rad, response.displacement_m, response.impacts), (0.0, 0.0, 0));
        prop_assert_eq!((response.uplift_s, response.overturning), (None, Overturning::None));
    }

    #[test]
    fn what_exceeds_it_by_a_little_moves_the_block_a_little(block in blocks(), samples in shakings()) {
        let largest = samples.iter().fold(1e-9_f64, |peak, a| peak.max(a.abs()));
        let strong = record(&samples).scaled(1.000_1 * block.uplift_acceleration_m_s2() / largest).unwrap();
        let response = peak(&block, &strong);
        prop_assert!(response.rotation_rad > 0.0);
        // to the first intersection of the record's straight lines with the threshold
        let (a, threshold) = (strong.acceleration_m_s2(), block.uplift_acceleration_m_s2());
        let last = a.iter().position(|a| a.abs() > threshold).unwrap();
        let Some(first) = last.checked_sub(1) else { return Ok(()) };
        let (level, rise) = (threshold.copysign(a[last]), a[last] - a[first]);
        let time = strong.dt_s() * (first as f64 + (level - a[first]) / rise);
        let rounding = 1e-14 + 1e-15 * strong.dt_s() * (threshold / rise).abs();
        prop_assert!((response.uplift_s.unwrap() - time).abs() < rounding, "{:?} {time}", response.uplift_s);
    }

    #[test]
    fn splitting_every_interval_changes_nothing(block in blocks(), samples in shakings()) {
        let motion = record(&samples);
        nearly(&block, &motion, &peak(&block, &motion), &peak(&block, &refined(&samples)))?;
    }

    #[test]
    fn leading_quiet_shifts_the_response(block in blocks(), samples in shakings()) {
        let mut later = vec![0.0; 50];
        later.extend(&samples);
        let first: Vec<f64> = std::iter::once(0.0).chain(samples).collect();
        let motion = record(&first);
        let (now, later) = (peak(&block, &motion), peak(&block, &record(&later)));
        nearly(&block, &motion, &now, &later)?;
        if let (Some(now), Some(later)) = (now.uplift_s, later.uplift_s) {
            prop_assert!((later - now - 49.0 * 0.02).abs() < 1e-12);
        }
    }

    /// θ depends on α, r and the shaking in units of g and 1/p alone (Eq. 2.4 and 2.6).
    #[test]
    fn similar_blocks_respond_alike(
        block in blocks(), samples in shakings(), size in 0.1..10.0_f64, gravity in 0.1..10.0_f64,
    ) {
        let other = RockingBlock::new(size * block.size_m(), block.slenderness_rad()).unwrap();
        let other = other.with_restitution(block.restitution()).unwrap();
        let other = other.with_gravity(gravity * block.gravity_m_s2()).unwrap();
        let dt = 0.02 * block.frequency_parameter_rad_s() / other.frequency_parameter_rad_s();
        let motion = Accelerogram::new(dt, samples.iter().map(|a| gravity * a).collect()).unwrap();
        let own = record(&samples);
        nearly(&block, &own, &peak(&block, &own), &peak(&other, &motion))?;
    }

    #[test]
    fn a_history_holds_its_peak_and_no_gap(block in blocks(), samples in shakings()) {
        let motion = record(&samples);
        let free = FreeRocking::Lasting { duration_s: 1.0 };
        let (response, history) = respond_with_history(&block, &motion, free).unwrap();
        let rows = &history.rows;
        prop_assert!(rows.windows(2).all(|rows| rows[0].time_s <= rows[1].time_s));
        prop_assert!(rows.iter().all(|row| row.rotation_rad.abs() <= response.rotation_rad * (1.0 + 1e-12)));
        let impacts = rows.iter().filter(|row| row.moment == Moment::AfterImpact).count() as u64;
        prop_assert_eq!(impacts, response.impacts);
        // continuous: no step is longer than the mean of the velocities at its ends allows, and
        // the largest acceleration
        let p2 = block.frequency_parameter_rad_s().powi(2);
        for rows in rows.windows(2).filter(|rows| rows[1].moment != Moment::Rest) {
            let dt = rows[1].time_s - rows[0].time_s;
            let mean = 0.5 * (rows[0].velocity_rad_s + rows[1].velocity_rad_s);
            let bound = 0.5 * dt * dt * p2 * (1.0 + 12.0 / 9.8) + 1e-12;
            if rows[1].moment != Moment::AfterImpact {
                prop_assert!((rows[1].rotation_rad - rows[0].rotation_rad - dt * mean).abs() <= bound);
            }
        }
    }

    #[test]
    fn no_shaking_makes_it_hang_or_lose_its_number(
        samples in prop::collection::vec(prop_oneof![-1e6..1e6_f64, Just(0.0), Just(-1e6), -1e-300..1e-300_f64], 2..40),
        size in prop_oneof![Just(1e-6_f64), Just(1e9), 0.1..10.0_f64],
        alpha in prop_oneof![Just(1e-6_f64), Just(0.955), 0.1..0.5_f64],
        restitution in prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64],
        dt in prop_oneof![Just(1e-9), Just(1.0), 0.001..0.1_f64],
    ) {
        let block = RockingBlock::new(size, alpha).unwrap().with_restitution(restitution).unwrap();
        match respond(&block, &Accelerogram::new(dt, samples).unwrap(), FreeRocking::FirstPeak) {
            Ok(response) => {
                prop_assert!(response.rotation_rad >= 0.0 && !response.displacement_m.is_nan());
                prop_assert_eq!(response.is_overturned(), response.rotation_rad == f64::INFINITY);
            }
            Err(error) => prop_assert!(matches!(error, BlockError::TooLong { .. }), "{}", error),
        }
    }
}

/// An elastic block, lifted for a moment only, would rebound 1e12 times in a second: that is cut, and said.
#[test]
fn endless_chatter_is_cut_and_said() {
    let elastic = RockingBlock::new(1.0, 0.2).unwrap().with_restitution(1.0).unwrap();
    let most = elastic.uplift_acceleration_m_s2();
    let motion = Accelerogram::new(1.0, vec![0.0, most * (1.0 + 1e-6), 0.0, 0.0, -1.05 * most, 0.0]).unwrap();
    let response = peak(&elastic, &motion);
    assert!(response.chatter_was_cut && response.impacts > 100_000);
    let housner = RockingBlock::new(1.0, 0.2).unwrap();
    let other = peak(&housner, &motion);
    assert!(!other.chatter_was_cut && other.impacts < 5_000, "{}", other.impacts);
    // what was cut is nothing beside the later motion
    assert!(other.rotation_rad > 1e-4 && other.rotation_rad.is_finite(), "{}", other.rotation_rad);
    assert!((response.rotation_rad / other.rotation_rad - 1.0).abs() < 1e-9, "{response:?} {other:?}");
}

#[test]
fn refuses_what_no_ground_does() {
    let block = RockingBlock::new(1.0, 0.1).unwrap();
    let error = respond(&block, &record(&[0.0, 1e7, 0.0]), FreeRocking::FirstPeak).unwrap_err();
    assert_eq!(error.to_string(), "ground acceleration is 10000000 m/s2: it must be between -1e6 and 1e6 m/s2");
    let long = RickerPulse::new(RickerShape::Symmetric, 1.0, 1e6).unwrap();
    let small = RockingBlock::new(1e-6, 0.1).unwrap();
    assert!(matches!(respond(&small, long, FreeRocking::FirstPeak), Err(BlockError::TooLong { .. })));
    for bad in [f64::NAN, -1.0, f64::INFINITY] {
        assert!(respond(&block, &record(&[0.0; 3]), FreeRocking::Lasting { duration_s: bad }).is_err());
    }
}
