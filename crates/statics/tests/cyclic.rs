//! Loading protocols, columns under them, and measured loops.

use std::f64::consts::PI;

use uplift_statics::{
    LoadingProtocol, MeasuredLoop, Parts, RestrainedColumns, Restrainer, Spring, Stopper, TendonPath,
};

use crate::hand_solutions::{column, stack};

/// Figure 5.11: 18 amplitudes from 0.36 % by 1.25; the 17th is 12.8 %, the last 15.99 % (the text rounds it to 15 %,
/// its summary to 16 %); two cycles each at 1.38e-4/s are 12.6 h.
#[test]
fn the_protocol_of_figure_5_11() {
    let protocol = LoadingProtocol::new(0.0036, 1.25, 18, 2, 1.38e-4).unwrap();
    assert_eq!(protocol, LoadingProtocol::default());
    let amplitudes = protocol.amplitudes();
    assert_eq!(amplitudes.len(), 18);
    assert!((amplitudes[16] - 0.128).abs() < 5e-4 && (amplitudes[17] - 0.1599).abs() < 5e-5, "{amplitudes:?}");
    assert!((protocol.duration_s() / 3600.0 - 12.6).abs() < 0.05, "{}", protocol.duration_s());
    // the sum of a geometric series: 4 · 2 · a (r^18 − 1)/(r − 1)
    let by_hand_s = 8.0 * 0.0036 * (1.25_f64.powi(18) - 1.0) / 0.25 / 1.38e-4;
    assert!((protocol.duration_s() / by_hand_s - 1.0).abs() < 1e-13);
    let history = protocol.history(10).unwrap();
    assert_eq!(history.len(), 1 + 18 * 2 * 4 * 10);
    let last = history.last().unwrap();
    assert!((last.time_s - by_hand_s).abs() < 1e-6 && last.drift == 0.0 && (last.set, last.cycle) == (18, 2));
    for pair in history.windows(2) {
        let rate = (pair[1].drift - pair[0].drift).abs() / (pair[1].time_s - pair[0].time_s);
        assert!((rate / 1.38e-4 - 1.0).abs() < 1e-6, "{pair:?}");
    }
    for (first, ratio, sets, cycles, rate) in
        [(0.0, 1.25, 1, 1, 1.0), (0.1, 1e300, 9, 1, 1.0), (0.1, 1.0, 0, 1, 1.0), (0.1, 1.0, 1, u32::MAX, 1.0)]
    {
        assert!(LoadingProtocol::new(first, ratio, sets, cycles, rate).is_err());
    }
    assert!(protocol.history(u32::MAX).is_err());
}

/// Without stoppers the loop encloses nothing; a stopper that yields dissipates its force times its plastic way, once.
#[test]
fn stoppers_dissipate_once() {
    let stopper = Some(Stopper { gap_m: 0.005, stiffness_n_m: 4e7, yield_n: Some(4e3) });
    let work_j = |stopper| {
        let law =
            Restrainer::new(Parts { stopper, ..Parts::from_spring(Spring::Linear { stiffness_n_m: 1e6 }) }).unwrap();
        let columns =
            RestrainedColumns::new(column(), 2, 30e3, 2e3).unwrap().with_restrainer(law, TendonPath::Column).unwrap();
        let history = LoadingProtocol::new(0.15, 1.0, 1, 3, 1e-3).unwrap().history(4000).unwrap();
        let states = columns.under(&history).unwrap();
        let energy: f64 = states
            .windows(2)
            // the step through zero does no work but that of the uplift force, which cancels
            .filter(|pair| pair[0].force_n.is_some() && pair[1].force_n.is_some())
            .map(|pair| {
                let way = pair[1].displacement_m - pair[0].displacement_m;
                0.5 * (pair[0].force_n.unwrap() + pair[1].force_n.unwrap()) * way
            })
            .sum();
        let largest_m = states.iter().filter_map(|state| state.spring_m).fold(0.0, f64::max);
        (energy, states.last().unwrap().dissipated_j, largest_m)
    };
    let (elastic_j, none_j, _) = work_j(None);
    let (yielding_j, told_j, largest_m) = work_j(stopper);
    assert!(elastic_j.abs() < 1.0, "{elastic_j}");
    assert_eq!(none_j, 0.0);
    let plastic_m = largest_m - 0.005 - 4e3 / 4e7;
    let by_hand_j = 2.0 * 4e3 * plastic_m;
    assert!(plastic_m > 0.005 && (yielding_j / by_hand_j - 1.0).abs() < 0.01, "{yielding_j} {by_hand_j}");
    assert!((told_j / by_hand_j - 1.0).abs() < 1e-12, "{told_j} {by_hand_j}");
    // one that never yields, and one that never engages
    let never = |gap_m, yield_n| work_j(Some(Stopper { gap_m, stiffness_n_m: 4e7, yield_n })).1;
    assert_eq!([never(0.005, None), never(0.5, Some(4e3))], [0.0, 0.0]);
}

/// The ellipse of a viscous damper of force `c` beside a spring `k`: area `π u c`, damping `c/(2 k u)`.
#[test]
fn an_ellipse_has_its_viscous_damping() {
    let (k, u, viscous) = (2e5, 0.1, 3e3);
    let points: Vec<(f64, f64)> = (0..=4000)
        .map(|step| f64::from(step) / 1000.0 * 2.0 * PI)
        .map(|phase| (u * phase.sin(), k * u * phase.sin() + viscous * phase.cos()))
        .collect();
    let measured = MeasuredLoop::new(points).unwrap();
    assert!(measured.cycles.len() >= 3, "{}", measured.cycles.len());
    for cycle in &measured.cycles {
        assert!((cycle.dissipated_j / (PI * u * viscous) - 1.0).abs() < 1e-3, "{cycle:?}");
        let damping = cycle.equivalent_damping.unwrap();
        assert!((damping / (viscous / (2.0 * k * u)) - 1.0).abs() < 1e-3, "{damping}");
    }
    assert!((measured.peak.0 / (k * u).hypot(viscous) - 1.0).abs() < 1e-4);
}

/// A computed pushover, read back as if measured: its slope between two drifts is that of the columns.
#[test]
fn the_slope_of_a_loading_branch() {
    let law = Restrainer::new(Parts::discs(stack(), 13e6)).unwrap();
    let columns =
        RestrainedColumns::new(column(), 2, 30e3, 2e3).unwrap().with_restrainer(law, TendonPath::Column).unwrap();
    let way: Vec<f64> = (0..=2000).map(|step| 0.16 * f64::from(step) / 1000.0).collect();
    let force = |u: f64| columns.at_displacement(u).unwrap().force_n;
    // up to 0.16 m, back with 1 kN less, then to −0.16 m
    let points = way.iter().map(|&s| match s {
        s if s <= 0.16 => (s, force(s)),
        s => (0.32 - s, force(0.32 - s) - 1e3),
    });
    let negative = way.iter().filter(|&&s| s <= 0.16).map(|&s| (-s, -force(s)));
    let measured = MeasuredLoop::new(points.chain(negative).collect()).unwrap();
    let exact = columns.slope_between_drifts_n_m(0.03, 0.09).unwrap();
    for side in [1.0, -1.0] {
        let slope = measured.loading_slope_n_m(side * 0.03 * 1.6, side * 0.09 * 1.6).unwrap();
        assert!((slope / exact - 1.0).abs() < 1e-4, "{slope} {exact}");
    }
    assert_eq!(measured.loading_slope_n_m(0.05, 0.2), None);
    assert!(MeasuredLoop::new(vec![(0.0, 0.0), (1.0, f64::NAN), (2.0, 0.0)]).is_err());
    assert!(MeasuredLoop::new(vec![(0.0, 0.0), (1.0, 1.0)]).is_err());
}
