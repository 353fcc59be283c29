//! The block under noise, with many impacts, against an independent integration: classical Runge-Kutta of fourth order
//! with a hundred steps a sample, impacts found by bisection of the step.
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

use uplift_block::{FreeRocking, RockingBlock, respond};
use uplift_motion::Accelerogram;

const STEPS: usize = 100;

struct RungeKutta<'a> {
    block: &'a RockingBlock,
    record: &'a Accelerogram,
}

impl RungeKutta<'_> {
    fn ground(&self, t: f64) -> f64 {
        let a = self.record.acceleration_m_s2();
        let i = ((t / self.record.dt_s()) as usize).min(a.len() - 2);
        a[i] + (a[i + 1] - a[i]) * (t / self.record.dt_s() - i as f64)
    }

    /// Eq. 2.1 as printed, with the sign of α that of the corner.
    fn acceleration(&self, t: f64, theta: f64, side: f64) -> f64 {
        let angle = side * self.block.slenderness_rad() - theta;
        let a = self.ground(t) / self.block.gravity_m_s2();
        -self.block.frequency_parameter_rad_s().powi(2) * (angle.sin() + a * angle.cos())
    }

    fn step(&self, t: f64, [x, v]: [f64; 2], h: f64, side: f64) -> [f64; 2] {
        let f = |t, x, v| [v, self.acceleration(t, x, side)];
        let a = f(t, x, v);
        let b = f(t + 0.5 * h, x + 0.5 * h * a[0], v + 0.5 * h * a[1]);
        let c = f(t + 0.5 * h, x + 0.5 * h * b[0], v + 0.5 * h * b[1]);
        let d = f(t + h, x + h * c[0], v + h * c[1]);
        [0, 1].map(|i| [x, v][i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
    }

    /// Largest rotation during the record, and impacts.
    fn peak(&self) -> (f64, u64) {
        let threshold = self.block.uplift_acceleration_m_s2();
        let h = self.record.dt_s() / STEPS as f64;
        let (mut state, mut side, mut peak, mut impacts) = ([0.0, 0.0], 0.0, 0.0_f64, 0);
        for i in 0..STEPS * (self.record.len() - 1) {
            let (mut t, mut left) = (i as f64 * h, h);
            for _ in 0..10_000 {
                if side == 0.0 {
                    let (now, then) = (self.ground(t), self.ground(t + left));
                    if then.abs() <= threshold {
                        break;
                    }
                    // within one sample interval the ground is linear
                    let part = ((threshold - now.abs()) / (then.abs() - now.abs())).clamp(0.0, 1.0);
                    (t, left, side) = (t + part * left, left * (1.0 - part), -then.signum());
                    state = [0.0, 0.0];
                }
                let next = self.step(t, state, left, side);
                if state[1] * next[1] < 0.0 {
                    let top = next[0].abs() + 0.5 * next[1].powi(2) / self.acceleration(t + left, next[0], side).abs();
                    peak = peak.max(top);
                }
                peak = peak.max(next[0].abs());
                if next[0] * side > 0.0 {
                    state = next;
                    break;
                }
                let (mut lo, mut hi) = (0.0, left);
                for _ in 0..60 {
                    let middle = 0.5 * (lo + hi);
                    if self.step(t, state, middle, side)[0] * side > 0.0 { lo = middle } else { hi = middle }
                }
                let v = self.block.restitution() * self.step(t, state, hi, side)[1];
                impacts += 1;
                (state, t, left) = ([0.0, v], t + hi, left - hi);
                side = if v.abs() < 1e-9 { 0.0 } else { v.signum() };
                if left <= 0.0 {
                    break;
                }
            }
        }
        (peak, impacts)
    }
}

fn noise(seed: u64) -> Accelerogram {
    let (mut state, mut slow) = (seed, 0.0);
    let samples = (0..800_u32).map(|i| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        slow = 0.8 * slow + 2.4 * ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0);
        if i < 600 { slow } else { 0.0 }
    });
    Accelerogram::new(0.01, samples.collect()).unwrap()
}

#[test]
fn a_runge_kutta_method_finds_the_same() {
    let (mut impacts, mut largest) = (0, 0.0_f64);
    for seed in 1..9 {
        let record = noise(seed);
        let block = RockingBlock::new(4.0 + seed as f64, 0.15 + 0.02 * seed as f64).unwrap();
        let expected = RungeKutta { block: &block, record: &record }.peak();
        let found = respond(&block, &record, FreeRocking::Lasting { duration_s: 0.0 }).unwrap();
        assert!(!found.is_overturned());
        let deviation = (found.rotation_rad / expected.0 - 1.0).abs();
        println!("seed {seed}: peak {:.4e}, deviation {deviation:.1e}, {} impacts", found.rotation_rad, found.impacts);
        assert!(deviation < 1e-8, "seed {seed}: {} {}", found.rotation_rad, expected.0);
        impacts += found.impacts;
        largest = largest.max(deviation);
    }
    assert!(impacts > 100, "{impacts}");
    println!("largest deviation {largest:.1e}");
}
