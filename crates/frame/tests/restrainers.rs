//! Restrainers in motion: kinks are steps' ends, stoppers yield once, events are reported.

use uplift_frame::{
    ColumnShape, FrameState, GroundMotion, Model, Options, PulseShape, RockingFrame, Start, Until, respond,
    respond_with_history,
};
use uplift_statics::{EventKind, Parts, Restrainer, Spring, Stopper, Tendon, TendonPath};

use crate::{pulse, stack, table_frame};

fn with(parts: Parts, path: TendonPath) -> RockingFrame {
    table_frame(ColumnShape::Rectangle).with_restrainer(Restrainer::new(parts).unwrap(), path).unwrap()
}

fn strong() -> GroundMotion<'static> {
    GroundMotion { x: pulse(PulseShape::Ricker, 8.6, 0.8, 0.0), ..GroundMotion::default() }
}

const STOPPER: Stopper = Stopper { gap_m: 0.015, stiffness_n_m: 20e6, yield_n: Some(6e3) };

/// What yielded stoppers dissipate is force times plastic part: the energy lost between two states of free motion.
#[test]
fn a_yielding_stopper_takes_its_energy_once() {
    let parts = Parts { stopper: Some(STOPPER), ..Parts::discs(stack(10), 13_318e3) };
    let frame = with(parts, TendonPath::Column);
    let start = FrameState { rotation_rad: 0.17, velocity_rad_s: 0.15, ..FrameState::default() };
    let until = |time| Options {
        start: Start::Tilted(start),
        until: Until::Time(time),
        restitution: Some(1.0),
        ..Options::default()
    };
    let found = respond(&frame, &GroundMotion::default(), Model::Planar, &until(6.0)).unwrap();
    let spring_m = found.spring_m.unwrap();
    let plastic_m = spring_m - STOPPER.yields_at_m().unwrap();
    assert!(plastic_m > 1e-4 && found.impacts >= 2, "{plastic_m} {}", found.impacts);
    let count = |kind| found.events.iter().filter(|event| event.event == kind).count();
    assert_eq!((count(EventKind::StopperEngages), count(EventKind::StopperYields)), (1, 1));
    // at the end, below the stoppers' gap, the energy is what it was less the plastic work of a stopper per column
    let at_end = frame.columns().at_rotation(found.end.rotation_rad.abs()).unwrap();
    assert!(at_end.spring_m.unwrap() < STOPPER.gap_m, "{}", found.end.rotation_rad);
    let energy = |of: FrameState| frame.energy_j(of.rotation_rad.abs(), of.velocity_rad_s, 0.0);
    let lost = energy(start) - energy(found.end);
    let plastic_j = 6e3 * plastic_m;
    assert!((lost / plastic_j - 1.0).abs() < 1e-9, "{lost} {plastic_j}");
}

/// Slack: the same as no restrainer until it is taken up.
#[test]
fn a_loose_tendon_does_nothing_until_it_is_taut() {
    let linear = |slack_m| Parts { slack_m, ..Parts::linear(1720e3) };
    let ground = GroundMotion { x: pulse(PulseShape::Sine, 2.0, 0.55, 0.1), ..GroundMotion::default() };
    let peak = |frame: &RockingFrame| respond(frame, &ground, Model::Planar, &Options::default()).unwrap();
    let free = peak(&table_frame(ColumnShape::Rectangle));
    let loose = peak(&with(linear(0.05), TendonPath::Column));
    assert_eq!(free.displacement, loose.displacement);
    assert_eq!(loose.tendon_n, Some(0.0));
    let taut = peak(&with(linear(0.0), TendonPath::Column));
    let between = peak(&with(linear(0.001), TendonPath::Column));
    assert!(taut.displacement.value < between.displacement.value);
    assert!(between.displacement.value < free.displacement.value);
    assert_eq!(between.events.iter().filter(|event| event.event == EventKind::SlackTaken).count(), 1);
}

/// A spring and a tendon in series are one spring, whether the law is reported as one or as two.
#[test]
fn a_linear_spring_behind_a_tendon() {
    let tendon = Tendon { stiffness_n_m: 13e6, yield_n: Some(10e3), failure_n: None };
    let two = Parts { tendon: Some(tendon), ..Parts::from_spring(Spring::Linear { stiffness_n_m: 2e6 }) };
    let one = Parts::linear(2e6 * 13e6 / 15e6);
    let ground = GroundMotion { x: pulse(PulseShape::Sine, 2.7, 0.55, 0.1), ..GroundMotion::default() };
    let peak = |parts| respond(&with(parts, TendonPath::Column), &ground, Model::Planar, &Options::default()).unwrap();
    let (one, two) = (peak(one), peak(two));
    assert!(!one.overturned && two.tendon_n.unwrap() > 10e3);
    assert!((one.displacement.value / two.displacement.value - 1.0).abs() < 1e-12);
    assert!((two.spring_m.unwrap() / (two.tendon_n.unwrap() / 2e6) - 1.0).abs() < 1e-12);
    assert_eq!(two.events.len(), 1 + usize::from(two.events.iter().any(|event| event.event == EventKind::Neutral)));
    assert_eq!(two.events[0].event, EventKind::TendonYields);
}

/// The history passes through the law of the restrainer at every row, and events lie at their rotations.
#[test]
fn rows_lie_on_the_law() {
    let parts = Parts { stopper: Some(Stopper { yield_n: None, ..STOPPER }), ..Parts::discs(stack(10), 13_318e3) };
    let path = TendonPath::Shifted { duct_gap_m: 0.0087, tendon_length_m: 2.134 };
    let frame = with(parts, path);
    let (found, history) = respond_with_history(&frame, &strong(), Model::Planar, &Options::default()).unwrap();
    assert!(!found.overturned);
    for row in &history.rows {
        let state = frame.columns().at_rotation(row.rotation_rad.abs()).unwrap();
        assert_eq!(row.tendon_n, state.tendon_n);
        assert_eq!(row.rise_m, state.rise_m);
    }
    let touch = found.events.iter().find(|event| event.event == EventKind::TendonTouches).unwrap();
    let at = Options { until: Until::Time(touch.time_s), ..Options::default() };
    let then = respond(&frame, &strong(), Model::Planar, &at).unwrap().end.rotation_rad.abs();
    let expected = path.touch_rotation_rad(frame.geometry()).unwrap();
    assert!((then / expected - 1.0).abs() < 1e-9, "{then} {expected}");
}
