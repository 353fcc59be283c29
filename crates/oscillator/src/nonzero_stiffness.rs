//! The motion of a system that is uplifted with a stiffness: a response to the record times the
//! scale, plus a free motion.

use uplift_instructions::Vectors;

use crate::ahead::{AHEAD, Lanes, ahead, larger, largest, smaller};
use crate::branch::Branch;
use crate::crossings::State;
use crate::ground_motion::GroundMotion;
use crate::particular::ParticularResponse;
use crate::run::Run;
use crate::stumpff::Stumpff;
use crate::sweep::growth;
use crate::uplifted::UpliftedMotion;

/// Largest ratio of the response to the uplift displacement: it leaves 12 digits of the latter.
const LARGEST_RATIO: f64 = 1e4;

/// An uplifted branch with a stiffness, prepared for the runs of a sweep.
#[derive(Debug)]
pub(crate) struct NonzeroStiffnessBranch {
    branch: Branch,
    response: ParticularResponse,
    /// Largest displacement of the response, m.
    largest_m: f64,
    /// `c0`, `t c1` and `t² c2` at the times `t` of `1, 2, …` samples.
    c0: Lanes,
    t_c1: Lanes,
    tt_c2: Lanes,
    /// See [`growth`]; one where the stiffness is negative, since accelerations are then largest at an end.
    growth: f64,
}

impl NonzeroStiffnessBranch {
    /// `None` for a branch without stiffness, and for one on which motions grow too fast, or turn too
    /// often between samples.
    pub(crate) fn new(branch: Branch, ground: &GroundMotion<'_>) -> Option<Self> {
        let (k, dt_s) = (branch.stiffness_per_s2, ground.excitation.dt_s());
        if k == 0.0 {
            return None;
        }
        let growth = if k > 0.0 { growth(k.sqrt() * dt_s) } else { 1.0 };
        if growth.is_nan() {
            return None;
        }
        let response = ParticularResponse::new(k, ground)?;
        let largest_m = response.largest_m();
        let (mut c0, mut t_c1, mut tt_c2) = ([0.0; AHEAD], [0.0; AHEAD], [0.0; AHEAD]);
        for m in 0..AHEAD {
            let t = (m + 1) as f64 * dt_s;
            let stumpff = Stumpff::at(k * t * t);
            (c0[m], t_c1[m], tt_c2[m]) = (stumpff.c0, t * stumpff.c1, t * t * stumpff.c2);
        }
        Some(Self { branch, response, largest_m, c0, t_c1, tt_c2, growth })
    }
}

impl NonzeroStiffnessBranch {
    /// Whether the rounding of the response times `scale` is small beside the uplift displacement.
    #[inline(always)]
    pub(crate) fn keeps_digits(&self, scale: f64, uplift_displacement_m: f64) -> bool {
        scale.abs() * self.largest_m <= LARGEST_RATIO * uplift_displacement_m
    }
}

/// With the time `t` since the sample `base`, the distance on its side is `y = c p + y0 + v0 t c1 − f0 t² c2`, where
/// `p` is the response to the record, `c` the scale and the rest the free motion.
pub(crate) struct NonzeroStiffnessMotion<'a> {
    stiffness: &'a NonzeroStiffnessBranch,
    ground: &'a GroundMotion<'a>,
    /// `c`: the scale, with the sign of the side.
    scale: f64,
    base: usize,
    /// The response at the base and after it.
    displacement_m: &'a [f64],
    velocity_m_s: &'a [f64],
    y0: f64,
    v0: f64,
    /// `f0`: the restoring force per mass at `y0`, m/s².
    f0: f64,
}

impl<'a> NonzeroStiffnessMotion<'a> {
    /// The motion on `side` from the state at the sample `base` on.
    #[inline(always)]
    pub(crate) fn new<const STIFFNESS: bool>(
        run: &Run<'a, STIFFNESS>,
        stiffness: &'a NonzeroStiffnessBranch,
        side: f64,
        base: usize,
        from: &State,
    ) -> Self {
        Self::at(stiffness, run.sweep.ground, side * run.scale, base, (side * from.u, side * from.v))
    }

    #[inline(always)]
    fn at(
        stiffness: &'a NonzeroStiffnessBranch,
        ground: &'a GroundMotion<'a>,
        scale: f64,
        base: usize,
        (y, rate): (f64, f64),
    ) -> Self {
        let (displacement_m, velocity_m_s) = stiffness.response.from(base);
        let (y0, v0) = (y - scale * displacement_m[0], rate - scale * velocity_m_s[0]);
        let f0 = stiffness.branch.restoring(1.0, y0);
        Self { stiffness, ground, scale, base, displacement_m, velocity_m_s, y0, v0, f0 }
    }
}

impl UpliftedMotion for NonzeroStiffnessMotion<'_> {
    #[inline(always)]
    fn ahead<V: Vectors>(&self, vectors: V, j: usize) -> V::F64s {
        let stiffness = self.stiffness;
        let response = ahead(self.displacement_m, j + 1 - self.base);
        let free = vectors.sub(
            vectors.mul(vectors.splat(self.v0), vectors.load(&stiffness.t_c1)),
            vectors.mul(vectors.splat(self.f0), vectors.load(&stiffness.tt_c2)),
        );
        let free = vectors.add(vectors.splat(self.y0), free);
        vectors.add(vectors.mul(vectors.splat(self.scale), vectors.load(response)), free)
    }

    #[inline(always)]
    fn acceleration(&self, j: usize, y: f64) -> f64 {
        -self.force(y) - self.scale * self.ground.acceleration_m_s2[j]
    }

    #[inline(always)]
    fn bounds_ahead(&self, j: usize, w0: f64, y: &Lanes) -> (f64, f64) {
        let acceleration = ahead(&self.ground.acceleration_m_s2, j + 1);
        let mut w = [0.0; AHEAD];
        for m in 0..AHEAD {
            w[m] = -self.force(y[m]) - self.scale * acceleration[m];
        }
        let (least, greatest) = (smaller(-largest(w.map(|w| -w)), w0), larger(largest(w), w0));
        (self.outward_bound(least, greatest), self.outward_bound(-greatest, -least))
    }

    #[inline(always)]
    fn rate(&self, j: usize) -> f64 {
        let samples = j - self.base;
        let free = match samples {
            0 => self.v0,
            _ => self.v0 * self.stiffness.c0[samples - 1] - self.f0 * self.stiffness.t_c1[samples - 1],
        };
        self.scale * self.velocity_m_s[samples] + free
    }

    #[inline(always)]
    fn force(&self, y: f64) -> f64 {
        self.stiffness.branch.restoring(1.0, y)
    }

    #[inline(always)]
    fn outward_bound(&self, least: f64, greatest: f64) -> f64 {
        if greatest <= 0.0 {
            0.0
        } else if self.stiffness.branch.stiffness_per_s2 < 0.0 {
            greatest
        } else {
            self.stiffness.growth * larger(greatest, -least)
        }
    }

    #[inline(always)]
    fn restart_at(&mut self, j: usize, y: f64) {
        *self = Self::at(self.stiffness, self.ground, self.scale, j, (y, self.rate(j)));
    }
}
