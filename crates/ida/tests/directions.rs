//! Motions seen from several azimuths, and vertical motion, against single runs.

use proptest::prelude::*;
use uplift_block::RockingBlock;
use uplift_frame::{ColumnShape, GroundMotion, Model, Options, RockingFrame, Shaking, respond};
use uplift_ida::{
    Cells, IdaError, Peaks, Plan, ScaledMotion, ShakenFrame, Shard, System, Unwatched, analyse, complete,
};
use uplift_motion::Accelerogram;
use uplift_oscillator::problems::shaped_noise;
use uplift_oscillator::{Oscillator, PostUplift};
use uplift_structure::Geometry;

const SCALES: [f64; 3] = [0.3, 1.0, 4.0];

fn noise(peak_m_s2: f64, seed: u64) -> Accelerogram {
    Accelerogram::new(0.01, shaped_noise(peak_m_s2, 500, seed)).unwrap()
}

fn frame() -> RockingFrame {
    let column = Geometry::from_width_and_height(0.3, 2.4).unwrap();
    RockingFrame::new(column, 3, 300.0, 9000.0, ColumnShape::Cylinder, 9.81).unwrap()
}

fn systems() -> Vec<System> {
    let falls = PostUplift::Negative { capacity_m: 0.3 };
    vec![
        System::Oscillator(Oscillator::zsbe(0.1).unwrap()),
        System::Oscillator(Oscillator::new(0.1, 9.81, 0.0005, 0.95, falls).unwrap()),
        System::Block(RockingBlock::new(1.2, 0.12).unwrap()),
        System::Frame(Box::new(ShakenFrame {
            frame: frame(),
            model: Model::Planar,
            restitution: 0.95,
            rest_amplitude_rad: None,
        })),
    ]
}

fn plan<'a>(motions: &'a [Accelerogram], systems: &'a [System]) -> Plan<'a> {
    let scaled = |accelerogram| ScaledMotion { id: "noise", accelerogram, scales: SCALES.to_vec() };
    Plan::scaled(motions.iter().map(scaled).collect(), systems, true).unwrap()
}

fn peaks(plan: &Plan<'_>) -> Peaks {
    analyse(plan, &Unwatched).unwrap()
}

/// Each percentile is that of the single runs, and the worst azimuth exceeds every one.
#[test]
fn a_percentile_over_azimuths_is_that_of_the_single_runs() {
    let systems = systems();
    // three motions, each from four azimuths
    let seen: Vec<Vec<Accelerogram>> =
        (0..3).map(|motion| (0..4).map(|azimuth| noise(3.0, 10 * motion + azimuth)).collect()).collect();
    let first: Vec<Accelerogram> = seen.iter().map(|of_motion| of_motion[0].clone()).collect();
    let others: Vec<&[Accelerogram]> = seen.iter().map(|of_motion| &of_motion[1..]).collect();
    let alone: Vec<Peaks> = (0..4)
        .map(|azimuth| peaks(&plan(&seen.iter().map(|of| of[azimuth].clone()).collect::<Vec<_>>(), &systems)))
        .collect();
    let mut overturned = 0;
    for (percentile, rank) in [(0, 0), (25, 0), (50, 1), (51, 2), (75, 2), (100, 3)] {
        let asked = plan(&first, &systems).from_azimuths(others.clone(), percentile).unwrap();
        assert_eq!((asked.histories_per_peak(), asked.analyses()), (4, 4 * 3 * 4 * 3));
        let found = peaks(&asked);
        for (motion, system, scale) in (0..3).flat_map(|m| (0..4).flat_map(move |s| (0..3).map(move |k| (m, s, k)))) {
            let cell = [motion, system, scale];
            let mut ranked: Vec<f64> = alone.iter().map(|of_azimuth| of_azimuth.at_m(cell)).collect();
            ranked.sort_by(f64::total_cmp);
            assert_eq!(found.at_m(cell).to_bits(), ranked[rank].to_bits(), "{percentile} {cell:?}");
            overturned += usize::from(ranked[rank].is_infinite());
        }
    }
    assert!(overturned > 0, "nothing overturned, so that its rank was not seen");
}

/// With no other azimuth any percentile is the plain analysis.
#[test]
fn one_azimuth_has_one_percentile() {
    let (motions, systems) = ([noise(3.0, 1), noise(2.0, 2)], systems());
    let plain = peaks(&plan(&motions, &systems));
    for percentile in [0, 50, 100] {
        assert_eq!(peaks(&plan(&motions, &systems).from_azimuths(vec![&[], &[]], percentile).unwrap()), plain);
    }
}

#[test]
fn threads_shards_and_what_is_known_change_no_bit() {
    let (motions, systems) = ([noise(3.0, 1), noise(2.0, 2)], systems());
    let others: Vec<Accelerogram> = (3..6).map(|seed| noise(3.0, seed)).collect();
    let vertical = [noise(1.0, 7), noise(1.0, 8)];
    let asked = || {
        let plan = plan(&motions, &systems).from_azimuths(vec![&others, &others], 75).unwrap();
        plan.upwards(vertical.iter().collect()).unwrap()
    };
    let all = peaks(&asked());
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| peaks(&asked())), all);
    }
    let shared = asked();
    let mut cells = Cells::unknown(&shared);
    for index in 0..2 {
        cells = complete(&shared, cells, Shard { index, count: 2 }, &Unwatched, &|_| {}).unwrap();
    }
    assert_eq!(cells.count(), shared.analyses());
    assert_eq!(cells.complete().unwrap(), all);
}

/// Blocks and frames feel the vertical motion with the factor of the others, oscillators do not.
#[test]
fn vertical_motion_takes_the_factor_and_shakes_blocks_and_frames_alone() {
    let (motions, systems, vertical) = ([noise(3.0, 1)], systems(), noise(2.0, 9));
    let plain = peaks(&plan(&motions, &systems));
    let shaken = peaks(&plan(&motions, &systems).upwards(vec![&vertical]).unwrap());
    let block = RockingFrame::block(1.2, 0.12, uplift_motion::STANDARD_GRAVITY_M_S2).unwrap();
    let restitution = uplift_block::housner_restitution(0.12);
    for (place, scale) in SCALES.into_iter().enumerate() {
        for oscillator in [0, 1] {
            assert_eq!(shaken.at_m([0, oscillator, place]).to_bits(), plain.at_m([0, oscillator, place]).to_bits());
        }
        let [x, z] = [&motions[0], &vertical].map(|component| component.scaled(scale).unwrap());
        let ground = GroundMotion { x: Some(Shaking::Record(&x)), y: None, z: Some(Shaking::Record(&z)) };
        for (system, frame, restitution) in [(2, &block, restitution), (3, &frame(), 0.95)] {
            let options = Options { restitution: Some(restitution), ..Options::default() };
            let single = respond(frame, &ground, Model::Planar, &options).unwrap().displacement.value;
            assert_eq!(shaken.at_m([0, system, place]).to_bits(), single.to_bits(), "{system} {scale}");
        }
    }
    assert!((2..4).any(|system| shaken.at_m([0, system, 1]) != plain.at_m([0, system, 1])));
}

/// Ground that falls with gravity is refused, with every record, a pair once, and the first factor at which it does.
#[test]
fn ground_that_falls_away_is_refused_at_once() {
    let (motions, systems, vertical) = ([noise(3.0, 1), noise(3.0, 2)], systems(), noise(2.6, 9));
    let named = ["pair", "pair", "other"].into_iter().zip([&motions[0], &motions[1], &motions[0]]);
    let scaled = |(id, accelerogram)| ScaledMotion { id, accelerogram, scales: SCALES.to_vec() };
    let of_pair = Plan::scaled(named.map(scaled).collect(), &systems, true).unwrap();
    let error = of_pair.upwards(vec![&vertical; 3]).unwrap_err();
    let IdaError::Falls { falling } = &error else { panic!("{error}") };
    assert_eq!(falling, &["pair by 4.0000 (scale factor 2)", "other by 4.0000 (scale factor 2)"]);
    // nothing that feels it is shaken
    assert!(plan(&motions, &systems[..2]).upwards(vec![&vertical, &vertical]).is_ok());
    let error = plan(&motions, &systems).from_azimuths(vec![&motions, &[]], 50).unwrap_err();
    assert!(matches!(error, IdaError::Azimuths { percentile: 50 }));
    assert!(plan(&motions, &systems).from_azimuths(vec![&[], &[]], 101).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// A constant vertical acceleration is another gravity.
    #[test]
    fn a_constant_vertical_acceleration_is_gravity(
        seed in 1..1000_u64, slenderness in 0.08..0.25_f64, share in -0.5..0.5_f64,
    ) {
        const G: f64 = uplift_motion::STANDARD_GRAVITY_M_S2;
        let motion = Accelerogram::new(0.01, shaped_noise(5.0, 100, seed)).unwrap();
        // it stays until the free motion is over too, of which the record has none: so only the record is followed
        let vertical = Accelerogram::new(0.01, vec![share * G; 100]).unwrap();
        let peak = |block: RockingBlock, factor: f64, vertical: Option<&Accelerogram>| {
            let systems = [System::Block(block)];
            let motions = vec![ScaledMotion { id: "noise", accelerogram: &motion, scales: vec![factor] }];
            let plan = Plan::scaled(motions, &systems, false).unwrap();
            let plan = match vertical {
                Some(vertical) => plan.upwards(vec![vertical]).unwrap(),
                None => plan,
            };
            peaks(&plan).at_m([0, 0, 0])
        };
        let block = RockingBlock::new(2.0, slenderness).unwrap();
        let heavy = block.with_gravity(G * (1.0 + share)).unwrap();
        let (shaken, heavier) = (peak(block, 1.0, Some(&vertical)), peak(heavy, 1.0, None));
        // what is lost at the end of a record counts as overturned, by the gravity after it
        if shaken.is_finite() && heavier.is_finite() {
            // Impacts amplify the last bits, by 1e10 in some of these motions: as much as bits of the motion may.
            let factors = (1..=8).flat_map(|bits| [1.0, -1.0].map(|side| 1.0 + side * f64::from(bits) * f64::EPSILON));
            let peaks = factors.map(|factor| peak(heavy, factor, None)).filter(|peak| peak.is_finite());
            let moved = peaks.map(|peak| (peak - heavier).abs()).fold(0.0, f64::max);
            prop_assert!((shaken - heavier).abs() <= 1e-12 * heavier + 10.0 * moved, "{shaken} {heavier} {moved}");
        }
    }
}
