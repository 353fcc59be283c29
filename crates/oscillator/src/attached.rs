//! A run while the system is attached: the scaled elastic response plus a free vibration of constant amplitude.

use crate::ahead::{AHEAD, ahead, larger, largest};
use crate::passages::{State, stays_inside, uplift_within};
use crate::run::{At, Phase, Run, Stretch};

impl<const STIFF: bool> Run<'_, STIFF> {
    #[inline(always)]
    pub(crate) fn attached(&self, start: At) -> Phase {
        let sweep = self.sweep;
        let k = sweep.attached.stiffness_per_s2;
        if start.interval == sweep.ground.intervals() {
            return Phase::RecordEnd(0.0, start.u, start.v);
        }
        // the rest of the interval of the impact
        let motion = self.motion(&start, k);
        let h = sweep.dt_s - start.offset_s;
        let (u, v) = self.end_of_interval(&motion, &start, &sweep.whole_attached);
        let end = State { u, v, w: -k * u - self.ground_end(start.interval) };
        self.attached_from(&Stretch { at: start, motion, h, end })
    }

    /// Attached from the start of a stretch on.
    #[inline(always)]
    pub(crate) fn attached_from(&self, stretch: &Stretch) -> Phase {
        let sweep = self.sweep;
        let mut stretch = *stretch;
        loop {
            if let Some(passage) = uplift_within(&stretch.motion, stretch.h, &stretch.end, sweep.boundary_m) {
                return self.uplift(passage, &stretch.at);
            }
            if sweep.attached.stiffness_per_s2 == 0.0 {
                // without stiffness there is no elastic response to lean on
                let (u, v) = (stretch.end.u, stretch.end.v);
                return Phase::Attached(At { interval: stretch.at.interval + 1, offset_s: 0.0, u, v, force: 0.0 });
            }
            match self.seek_uplift(stretch.at.interval + 1, &stretch.end) {
                Ok(further) => stretch = further,
                Err(over) => return over,
            }
        }
    }

    /// The first interval from the sample `j` on of which it is not seen at once that the system stays attached, or how the run ends before.
    #[inline(always)]
    pub(crate) fn seek_uplift(&self, mut j: usize, start: &State) -> Result<Stretch, Phase> {
        let (sweep, scale) = (self.sweep, self.scale);
        let (n, k, boundary) = (sweep.ground.intervals(), sweep.attached.stiffness_per_s2, sweep.boundary_m);
        let (elastic, cos, sin) = (&sweep.elastic, &sweep.turns.cos, &sweep.turns.sin);
        let (mut u0, mut w0) = (start.u, start.w);
        // the free vibration as (displacement, velocity/ω), a vector that turns
        let mut free =
            (start.u - scale * elastic.displacement_m[j], (start.v - scale * elastic.velocity_m_s[j]) / sweep.omega);
        let turned =
            |free: (f64, f64), m: usize| (cos[m] * free.0 + sin[m] * free.1, cos[m] * free.1 - sin[m] * free.0);
        while j < n {
            let count = AHEAD.min(n - j);
            let unit = ahead(&elastic.displacement_m, j + 1);
            let ground = ahead(&sweep.ground.acceleration_m_s2, j + 1);
            let (mut u, mut w) = ([0.0; AHEAD], [0.0; AHEAD]);
            for m in 0..AHEAD {
                u[m] = scale * unit[m] + (cos[m] * free.0 + sin[m] * free.1);
                w[m] = -k * u[m] - scale * ground[m];
            }
            // nothing in all of them, or else one by one
            let highest = larger(largest(u.map(f64::abs)), u0.abs());
            let largest_w = larger(largest(w.map(f64::abs)), w0.abs());
            let quiet = highest + sweep.sag_factor * largest_w <= boundary;
            for m in 0..if quiet { 0 } else { count } {
                if self.may_uplift((u0, w0), (u[m], w[m])) {
                    let interval = j + m;
                    let velocity = |j: usize, free: (f64, f64)| scale * elastic.velocity_m_s[j] + sweep.omega * free.1;
                    let free0 = if m == 0 { free } else { turned(free, m - 1) };
                    let at = At { interval, offset_s: 0.0, u: u0, v: velocity(interval, free0), force: k * u0 };
                    let end = State { u: u[m], v: velocity(interval + 1, turned(free, m)), w: w[m] };
                    let motion = self.motion(&at, k);
                    if !stays_inside(&motion, sweep.dt_s, &end, boundary) {
                        return Ok(Stretch { at, motion, h: sweep.dt_s, end });
                    }
                }
                (u0, w0) = (u[m], w[m]);
            }
            (u0, w0, free) = (u[count - 1], w[count - 1], turned(free, count - 1));
            j += count;
        }
        Err(Phase::RecordEnd(0.0, u0, scale * elastic.velocity_m_s[n] + sweep.omega * free.1))
    }

    /// Whether the displacement may exceed the boundary between two samples, from displacement and acceleration there.
    ///
    /// Where the acceleration is at most `W` and the ends differ by `Δ`, nothing between them lies higher than the higher one by more
    /// than `S (1 − Δ/4S)² ≤ S − Δ/4` with `S = W h²/8`, and nothing does if that is negative.
    #[inline(always)]
    fn may_uplift(&self, (u0, w0): (f64, f64), (u1, w1): (f64, f64)) -> bool {
        let sag = self.sweep.sag_factor * larger(w0.abs(), w1.abs()) - 0.25 * (u1 - u0).abs();
        let highest = larger(u0.abs(), u1.abs()) + if sag < 0.0 { 0.0 } else { sag };
        !(highest <= self.sweep.boundary_m)
    }
}
