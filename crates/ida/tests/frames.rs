//! Stripes of frames against single runs, on other numbers of threads, and by what sets them apart.

use uplift_frame::{ColumnShape, GroundMotion, Model, Options, RockingFrame, Until, respond};
use uplift_ida::{IdaError, Plan, ShakenFrame, StripeRecord, System, Unwatched, analyse};
use uplift_motion::Accelerogram;
use uplift_oscillator::problems::shaped_noise;
use uplift_statics::{Parts, Restrainer, Stopper, TendonPath};
use uplift_structure::Geometry;

use crate::bits;

const LEVELS: [f64; 4] = [0.05, 0.5, 1.5, 6.0];

fn noise(seed: u64) -> Accelerogram {
    Accelerogram::new(0.01, shaped_noise(6.0, 400, seed)).unwrap()
}

/// Pairs of components, the second not as long as the first.
fn pairs() -> Vec<[Accelerogram; 2]> {
    (1..4).map(|i| [noise(i), Accelerogram::new(0.01, shaped_noise(4.0, 350, 10 + i)).unwrap()]).collect()
}

fn frame(parts: Option<Parts>, path: TendonPath) -> RockingFrame {
    let column = Geometry::from_width_and_height(0.3, 2.4).unwrap();
    let free = RockingFrame::new(column, 3, 300.0, 9000.0, ColumnShape::Cylinder, 9.81).unwrap();
    parts.map_or_else(|| free.clone(), |of| free.clone().with_restrainer(Restrainer::new(of).unwrap(), path).unwrap())
}

fn system(frame: &RockingFrame, model: Model, restitution: f64) -> System {
    System::Frame(Box::new(ShakenFrame { frame: frame.clone(), model, restitution, rest_amplitude_rad: None }))
}

fn plan<'a>(pairs: &'a [[Accelerogram; 2]], systems: &'a [System], with_free_peak: bool) -> Plan<'a> {
    let of = |(i, [first, _]): (usize, &'a [Accelerogram; 2])| StripeRecord {
        id: "noise",
        accelerogram: first,
        intensity: 0.3 + 0.1 * i as f64,
    };
    let records = pairs.iter().enumerate().map(of).collect();
    let plan = Plan::stripes(records, systems, &LEVELS, with_free_peak).unwrap();
    plan.across(pairs.iter().map(|[_, second]| second).collect()).unwrap()
}

/// Both components take the factor; the planar model feels the first alone.
#[test]
fn each_element_is_the_single_run_it_stands_for() {
    let (pairs, frame) = (pairs(), frame(Some(Parts::linear(4e5)), TendonPath::Column));
    let systems = [system(&frame, Model::Wobbling, 1.0), system(&frame, Model::Planar, 0.9)];
    for with_free_peak in [true, false] {
        let peaks = analyse(&plan(&pairs, &systems, with_free_peak), &Unwatched).unwrap();
        let (mut rocked, mut overturned) = (0, 0);
        for (i, [first, second]) in pairs.iter().enumerate() {
            for (k, level) in LEVELS.iter().enumerate() {
                let scale = level / (0.3 + 0.1 * i as f64);
                let [x, y] = [first, second].map(|component| component.scaled(scale).unwrap());
                for (j, (ground, model, restitution)) in [
                    (GroundMotion::pair(&x, &y), Model::Wobbling, 1.0),
                    (GroundMotion::along_x(&x), Model::Planar, 0.9),
                ]
                .into_iter()
                .enumerate()
                {
                    let until = if with_free_peak { Until::FirstFreePeak } else { Until::Time(ground.duration_s()) };
                    let options = Options { until, restitution: Some(restitution), ..Options::default() };
                    let single = respond(&frame, &ground, model, &options).unwrap();
                    let found = peaks.at_m([i, j, k]);
                    assert_eq!(found.to_bits(), single.displacement.value.to_bits(), "{i} {j} {k}");
                    assert_eq!(single.overturned, found == f64::INFINITY);
                    rocked += usize::from(found > 0.0 && found.is_finite());
                    overturned += usize::from(single.overturned);
                }
            }
        }
        assert!(rocked > 3 && overturned > 3, "{rocked} {overturned}");
    }
}

#[test]
fn threads_change_no_bit() {
    let (pairs, frame) = (pairs(), frame(None, TendonPath::Column));
    let systems = [system(&frame, Model::Wobbling, 1.0)];
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bits(&analyse(&plan(&pairs, &systems, true), &Unwatched).unwrap()))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn a_second_component_is_one_of_each_motion() {
    let (pairs, frame) = (pairs(), frame(None, TendonPath::Column));
    let systems = [system(&frame, Model::Wobbling, 1.0)];
    let lacking = plan(&pairs, &systems, true).across(vec![&pairs[0][1]]).unwrap_err();
    assert!(matches!(lacking, IdaError::Beside { count: 1, expected: 3, .. }), "{lacking}");
    let huge = Accelerogram::new(0.01, vec![0.0, 1e7, 0.0]).unwrap();
    let implausible = plan(&pairs, &systems, true).across(vec![&huge; 3]).unwrap_err();
    assert!(matches!(implausible, IdaError::Implausible { .. }), "{implausible}");
    // it stays with the plan whose factors are multiplied
    let one = analyse(&plan(&pairs, &systems, true).multiplied(&[1.0]).unwrap(), &Unwatched).unwrap();
    assert_eq!(bits(&one), bits(&analyse(&plan(&pairs, &systems, true), &Unwatched).unwrap()));
}

/// Whatever the motion depends on sets a system apart; what only tells of events does not.
#[test]
fn frames_of_one_identity_are_the_same() {
    let linear = |stiffness_n_m| Some(Parts::linear(stiffness_n_m));
    let stopper = Some(Stopper { gap_m: 0.01, stiffness_n_m: 1e7, yield_n: None });
    let yielding = Some(Stopper { gap_m: 0.01, stiffness_n_m: 1e7, yield_n: Some(1e4) });
    let parts = |change: fn(&mut Parts)| {
        let mut of = Parts::linear(4e5);
        change(&mut of);
        Some(of)
    };
    let shifted = |duct_gap_m| TendonPath::Shifted { duct_gap_m, tendon_length_m: 3.5 };
    let frames = [
        frame(None, TendonPath::Column),
        frame(linear(4e5), TendonPath::Column),
        frame(linear(5e5), TendonPath::Column),
        frame(linear(4e5), TendonPath::Foundation),
        frame(linear(4e5), shifted(0.01)),
        frame(linear(4e5), shifted(0.02)),
        frame(parts(|of| of.slack_m = 0.001), TendonPath::Column),
        frame(parts(|of| of.prestress_n = 100.0), TendonPath::Column),
        frame(Some(Parts { stopper, ..Parts::linear(4e5) }), TendonPath::Column),
        frame(Some(Parts { stopper: yielding, ..Parts::linear(4e5) }), TendonPath::Column),
        frame(linear(4e5), TendonPath::Column).with_restrained(2).unwrap(),
    ];
    let mut systems: Vec<System> = frames.iter().map(|frame| system(frame, Model::Wobbling, 1.0)).collect();
    systems.push(system(&frames[0], Model::Planar, 1.0));
    systems.push(system(&frames[0], Model::Planar, 0.9));
    for (i, one) in systems.iter().enumerate() {
        for (j, other) in systems.iter().enumerate() {
            assert_eq!(one.identity() == other.identity(), i == j, "{i} {j}: {:?}", one.identity());
        }
    }
    assert_eq!((systems[0].kind(), systems[11].kind()), ("wobbling frame", "planar frame"));
    assert!(systems[0].to_string().contains("3 columns"), "{}", systems[0]);
}
