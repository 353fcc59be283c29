//! A run while the system is uplifted without stiffness: a flight, followed over the integrals of the record.

use crate::ahead::{AHEAD, Lanes, ahead, larger, largest, smaller};
use crate::ground_motion::GroundMotion;
use crate::passages::State;
use crate::run::{At, Phase, Run, Sought, Stretch};
use crate::stumpff::Stumpff;

/// Stumpff functions of a branch without stiffness.
const PARABOLIC: Stumpff = Stumpff { c0: 1.0, c1: 1.0, c2: 0.5, c3: 1.0 / 6.0 };

impl Run<'_> {
    /// Uplifted without stiffness.
    #[inline(always)]
    pub(crate) fn flight(&mut self, side: f64, start: At) -> Phase {
        if start.interval == self.sweep.ground.intervals() {
            return Phase::RecordEnd(side, start.u, start.v);
        }
        self.flight_from(side, &self.rest_of_interval_in_flight(start))
    }

    /// The rest of the interval in which a flight begins.
    #[inline(always)]
    pub(crate) fn rest_of_interval_in_flight(&self, at: At) -> Stretch {
        let motion = self.motion(&at, 0.0);
        let h = self.sweep.dt_s - at.offset_s;
        let (u, v) = motion.state_with(h, &PARABOLIC);
        let w = -at.force - self.ground_end(at.interval).0;
        Stretch { at, motion, h, end: State { u, v, w } }
    }

    /// In flight from the start of a stretch on.
    #[inline(always)]
    pub(crate) fn flight_from(&mut self, side: f64, stretch: &Stretch) -> Phase {
        let mut stretch = *stretch;
        loop {
            if let Some(passage) = self.uplifted_interval(side, &stretch) {
                return self.impact(passage, side, &stretch.at);
            }
            match self.seek_landing(side, stretch.at.interval + 1, &stretch.end) {
                Sought::Stretch(further) => stretch = further,
                Sought::RecordEnd(u, v) => return Phase::RecordEnd(side, u, v),
            }
        }
    }

    /// The first interval from the sample `j` on in which the flight may come down, or turn back beyond the peak; the peak is raised on
    /// the way.
    #[inline(always)]
    pub(crate) fn seek_landing(&mut self, side: f64, mut j: usize, start: &State) -> Sought {
        let (n, dt_s) = (self.sweep.ground.intervals(), self.sweep.dt_s);
        let flight = Flight::new(self, side, j, (start.u, start.v));
        let (mut y0, mut w0) = (side * start.u, flight.acceleration(j));
        while j < n {
            let count = AHEAD.min(n - j);
            let (y, w) = flight.ahead(j);
            // nothing in all of them, or else one by one
            let (lowest, highest) = (smaller(-largest(y.map(|y| -y)), y0), larger(largest(y), y0));
            let (least, greatest) = (smaller(-largest(w.map(|w| -w)), w0), larger(largest(w), w0));
            let eighth = 0.125 * dt_s * dt_s;
            let stays_up = lowest - eighth * larger(greatest, 0.0) >= self.sweep.boundary_m;
            let no_new_peak = highest - eighth * smaller(least, 0.0) <= self.peak_m;
            let first = match (stays_up, no_new_peak) {
                (true, true) => count,
                // falls freely: comes down where it is down at a sample
                (false, true) if greatest <= 0.0 => {
                    y[..count].iter().position(|y| *y < self.sweep.boundary_m).unwrap_or(count)
                }
                _ => 0,
            };
            if first > 0 {
                (y0, w0) = (y[first - 1], w[first - 1]);
            }
            for m in first..count {
                if self.may_land_or_peak((y0, w0), (y[m], w[m])) {
                    let interval = j + m;
                    let (rate0, rate1) = (flight.rate(interval), flight.rate(interval + 1));
                    let at = At { interval, offset_s: 0.0, u: side * y0, v: side * rate0, force: side * flight.weight };
                    let end = State { u: side * y[m], v: side * rate1, w: side * w[m] };
                    return Sought::Stretch(Stretch { at, motion: self.motion(&at, 0.0), h: dt_s, end });
                }
                self.peak_m = larger(y[m], self.peak_m);
                (y0, w0) = (y[m], w[m]);
            }
            (y0, w0) = (y[count - 1], w[count - 1]);
            j += count;
        }
        Sought::RecordEnd(side * y0, side * flight.rate(n))
    }

    /// Whether a flight may come down, or turn back beyond the peak, between two samples, from distance and acceleration there; see
    /// [`may_uplift`](Self::may_uplift).
    #[inline(always)]
    fn may_land_or_peak(&self, (y0, w0): (f64, f64), (y1, w1): (f64, f64)) -> bool {
        let eighth = 0.125 * self.sweep.dt_s * self.sweep.dt_s;
        let quarter = 0.25 * (y1 - y0).abs();
        let dip = larger(eighth * larger(w0, w1) - quarter, 0.0);
        let rise = larger(-eighth * smaller(w0, w1) - quarter, 0.0);
        let stays_up = smaller(y0, y1) - dip >= self.sweep.boundary_m;
        let no_new_peak = larger(y0, y1) + rise <= self.peak_m || rise == 0.0;
        !(stays_up && no_new_peak)
    }
}

/// A flight without stiffness, told by the integrals of the record: with the time `T` since its base, the distance on its side is
/// `y = y0 + T (p − η g T/2) − c (D(t) − D0)`.
struct Flight<'a> {
    ground: &'a GroundMotion<'a>,
    dt_s: f64,
    /// `c`: the scale, with the sign of the side.
    scale: f64,
    /// `η g`, m/s².
    weight: f64,
    base: usize,
    y0: f64,
    p: f64,
    d0: f64,
}

impl<'a> Flight<'a> {
    /// The flight on `side` from the displacement and velocity `from` at the sample `base` on.
    #[inline(always)]
    fn new(run: &Run<'a>, side: f64, base: usize, from: (f64, f64)) -> Self {
        let (ground, scale, weight) = (run.sweep.ground, side * run.scale, run.sweep.at_boundary_m_s2);
        Self {
            ground,
            dt_s: run.sweep.dt_s,
            scale,
            weight,
            base,
            y0: side * from.0,
            p: side * from.1 + scale * ground.velocity_m_s[base],
            d0: ground.displacement_m[base],
        }
    }

    /// Rate of `y` at the sample `j`.
    #[inline(always)]
    fn rate(&self, j: usize) -> f64 {
        self.p - self.weight * ((j - self.base) as f64 * self.dt_s) - self.scale * self.ground.velocity_m_s[j]
    }

    /// Acceleration of `y` at the sample `j`.
    #[inline(always)]
    fn acceleration(&self, j: usize) -> f64 {
        -self.weight - self.scale * self.ground.acceleration_m_s2[j]
    }

    /// Distance and acceleration at the samples after `j`.
    #[inline(always)]
    fn ahead(&self, j: usize) -> (Lanes, Lanes) {
        let displacement = ahead(&self.ground.displacement_m, j + 1);
        let acceleration = ahead(&self.ground.acceleration_m_s2, j + 1);
        let passed = (j + 1 - self.base) as f64;
        let (mut y, mut w) = ([0.0; AHEAD], [0.0; AHEAD]);
        for m in 0..AHEAD {
            let t = (passed + m as f64) * self.dt_s;
            y[m] = self.y0 + t * (self.p - 0.5 * self.weight * t) - self.scale * (displacement[m] - self.d0);
            w[m] = -self.weight - self.scale * acceleration[m];
        }
        (y, w)
    }
}
