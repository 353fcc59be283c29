//! The series of several motions, side by side in vectors.

use uplift_taylor::{Forcing, LEAST_ORDER, ORDER};

mod lanes;
mod turn;

pub(crate) use lanes::LANES;
use lanes::{Convergence, Lanes, Series, ZERO, lanes, line, products};
use turn::Turn;

use super::{Constants, Shaken, Step, Turning};

/// What a step begins with, and what acts on it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Begin {
    length_s: f64,
    x: f64,
    v: f64,
    turning: Turning,
    /// Straight lines: begin and change.
    horizontal: [[f64; 2]; 2],
    vertical: [f64; 2],
    is_level: bool,
    /// [`Branch::multiples`](crate::branch::Branch::multiples).
    pull: [f64; 2],
}

impl Begin {
    /// Of a step of a frame that wobbles with `turning` or rocks in a plane; none where what shakes it is not straight.
    pub(crate) fn new(
        (x, v): (f64, f64),
        turning: Option<Turning>,
        shaken: &Shaken,
        pull: [f64; 2],
        length_s: f64,
    ) -> Option<Self> {
        let straight = |forcing: &Forcing| <[f64; 2]>::try_from(forcing.coefficients()).ok();
        let [along, across] = &shaken.horizontal;
        let across = if turning.is_some() { straight(across)? } else { [0.0; 2] };
        let is_level = shaken.vertical.is_zero();
        let vertical = if is_level { [0.0; 2] } else { straight(&shaken.vertical)? };
        let turning = turning.unwrap_or(Turning { direction: 0.0, momentum: 0.0 });
        let horizontal = [straight(along)?, across];
        Some(Self { length_s, x, v, turning, horizontal, vertical, is_level, pull })
    }
}

/// The same of several steps.
#[derive(Debug)]
pub(crate) struct Begins {
    /// 1 of a lane with a step, 0 of others.
    waits: Lanes,
    length_s: Lanes,
    x: Lanes,
    v: Lanes,
    half_sine: Lanes,
    half_cosine: Lanes,
    direction: Lanes,
    momentum: Lanes,
    sin_direction: Lanes,
    cos_direction: Lanes,
    horizontal: [[Lanes; 2]; 2],
    vertical: [Lanes; 2],
    /// 1 of those that the ground shakes upwards, 0 of others.
    is_lifted: Lanes,
    pull: [Lanes; 2],
}

impl Begins {
    pub(crate) const NONE: Self = Self {
        waits: ZERO,
        length_s: ZERO,
        x: ZERO,
        v: ZERO,
        half_sine: ZERO,
        half_cosine: ZERO,
        direction: ZERO,
        momentum: ZERO,
        sin_direction: ZERO,
        cos_direction: ZERO,
        horizontal: [[ZERO; 2]; 2],
        vertical: [ZERO; 2],
        is_lifted: ZERO,
        pull: [ZERO; 2],
    };

    /// Empties all lanes.
    pub(crate) fn clear(&mut self) {
        self.waits = ZERO;
    }

    pub(crate) fn put(&mut self, lane: usize, begin: &Begin) {
        let Begin { length_s, x, v, turning: Turning { direction, momentum }, .. } = *begin;
        self.waits[lane] = 1.0;
        (self.length_s[lane], self.x[lane], self.v[lane]) = (length_s, x, v);
        (self.half_sine[lane], self.half_cosine[lane]) = (0.5 * x).sin_cos();
        (self.direction[lane], self.momentum[lane]) = (direction, momentum);
        (self.sin_direction[lane], self.cos_direction[lane]) = direction.sin_cos();
        for power in 0..2 {
            self.horizontal[0][power][lane] = begin.horizontal[0][power];
            self.horizontal[1][power][lane] = begin.horizontal[1][power];
            self.vertical[power][lane] = begin.vertical[power];
            self.pull[power][lane] = begin.pull[power];
        }
        self.is_lifted[lane] = f64::from(u8::from(!begin.is_level));
    }
}

/// The series of steps, as [`Expansion`](super::Expansion) has that of one.
#[derive(Debug)]
pub(crate) struct SeriesOfAll<const WOBBLES: bool> {
    x: Series,
    v: Series,
    sine: Series,
    versine: Series,
    half_sine: Series,
    half_cosine: Series,
    sin_psi: Series,
    cos_psi: Series,
    turn: Turn,
    /// At which two terms running are negligible; 0 where none is.
    order: Lanes,
}

impl<const WOBBLES: bool> SeriesOfAll<WOBBLES> {
    pub(crate) const NONE: Self = Self {
        x: [ZERO; ORDER + 1],
        v: [ZERO; ORDER + 1],
        sine: [ZERO; ORDER + 1],
        versine: [ZERO; ORDER + 1],
        half_sine: [ZERO; ORDER + 1],
        half_cosine: [ZERO; ORDER + 1],
        sin_psi: [ZERO; ORDER + 1],
        cos_psi: [ZERO; ORDER + 1],
        turn: Turn::NONE,
        order: ZERO,
    };

    /// Expands all steps.
    #[inline(always)]
    pub(crate) fn expand(&mut self, constants: &Constants, begins: &Begins) {
        let &Constants { sin_alpha, cos_alpha, p_squared, held, .. } = constants;
        let Self { x, v, sine, versine, half_sine, half_cosine, sin_psi, cos_psi, turn, order } = self;
        (x[0], v[0]) = (begins.x, begins.v);
        (half_sine[0], half_cosine[0]) = (begins.half_sine, begins.half_cosine);
        sine[0] = lanes(|i| 2.0 * half_sine[0][i] * half_cosine[0][i]);
        versine[0] = lanes(|i| 2.0 * half_sine[0][i] * half_sine[0][i]);
        turn.begin(begins);
        let by_tilt_inertia = 1.0 / constants.tilt_inertia;
        let mut rotation = Convergence::from(v[0]);
        let mut of_momentum = Convergence::from(begins.momentum);
        let mut of_turning = Convergence::from(ZERO);
        let bears_half_angle = begins.pull[1].iter().any(|of_half_cosine| *of_half_cosine != 0.0);
        let mut open = begins.waits;
        *order = ZERO;
        for k in 0..ORDER {
            let factor: Lanes = lanes(|i| begins.length_s[i] / (k + 1) as f64);
            let [sine_v, versine_v] = products([(&*sine, &*v), (&*versine, &*v)], k);
            let one = f64::from(u8::from(k == 0));
            sin_psi[k] = lanes(|i| sin_alpha * (one - versine[k][i]) - cos_alpha * sine[k][i]);
            cos_psi[k] = lanes(|i| cos_alpha * (one - versine[k][i]) + sin_alpha * sine[k][i]);
            let lift = line(&begins.vertical, sin_psi, k);
            let mut moment: Lanes =
                lanes(|i| if begins.is_lifted[i] == 0.0 { sin_psi[k][i] } else { sin_psi[k][i] + lift[i] });
            let mut outward = ZERO;
            if WOBBLES {
                let [push, centrifugal] = turn.order(constants, begins, [&*sine, &*versine, &*cos_psi], &factor, k);
                moment = lanes(|i| moment[i] + push[i]);
                outward = lanes(|i| 0.5 * centrifugal[i]);
            } else {
                let push = line(&begins.horizontal[0], cos_psi, k);
                moment = lanes(|i| moment[i] + push[i]);
            }
            let [of_sine, of_half_cosine] = &begins.pull;
            let pull: Lanes = lanes(|i| {
                let own = of_sine[i] * sine[k][i];
                if of_half_cosine[i] == 0.0 { own } else { own + of_half_cosine[i] * half_cosine[k][i] }
            });
            let inward: Lanes = lanes(|i| (pull[i] * held - outward[i]) * by_tilt_inertia);
            v[k + 1] = lanes(|i| -factor[i] * (p_squared * moment[i] + inward[i]));
            versine[k + 1] = lanes(|i| factor[i] * sine_v[i]);
            sine[k + 1] = lanes(|i| factor[i] * (v[k][i] - versine_v[i]));
            if bears_half_angle {
                let [half_sine_v, half_cosine_v] = products([(&*half_sine, &*v), (&*half_cosine, &*v)], k);
                half_sine[k + 1] = lanes(|i| 0.5 * factor[i] * half_cosine_v[i]);
                half_cosine[k + 1] = lanes(|i| -0.5 * factor[i] * half_sine_v[i]);
            }
            x[k + 1] = lanes(|i| factor[i] * v[k][i]);
            let mut negligible = rotation.take(&v[k + 1]);
            if WOBBLES {
                let (momentum, turning) = (of_momentum.take(&turn.momentum[k + 1]), of_turning.take(&turn.turning[k]));
                negligible = lanes(|i| negligible[i] * momentum[i] * turning[i]);
            }
            if k + 1 >= LEAST_ORDER {
                *order = lanes(|i| if open[i] * negligible[i] == 0.0 { order[i] } else { (k + 1) as f64 });
                open = lanes(|i| if negligible[i] == 0.0 { open[i] } else { 0.0 });
                if open.iter().sum::<f64>() == 0.0 {
                    break;
                }
            }
        }
    }

    /// Writes the series of a lane into `step`, without the terms that only accelerations need; false if it has not
    /// converged.
    pub(crate) fn write(&self, lane: usize, begins: &Begins, step: &mut Step) -> bool {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small whole number
        let n = self.order[lane] as usize;
        if n == 0 {
            return false;
        }
        let last = [self.v[n][lane], self.turn.momentum[n][lane], self.turn.turning[n - 1][lane]];
        if !last.iter().all(|last| last.is_finite()) {
            return false;
        }
        (step.length_s, step.order) = (begins.length_s[lane], n);
        for k in 0..=n {
            (step.x[k], step.v[k]) = (self.x[k][lane], self.v[k][lane]);
        }
        if WOBBLES {
            for k in 0..=n {
                (step.direction[k], step.momentum[k]) = (self.turn.direction[k][lane], self.turn.momentum[k][lane]);
            }
        }
        step.x[n + 1] = step.length_s / (n + 1) as f64 * step.v[n];
        true
    }
}
