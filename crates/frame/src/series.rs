//! A step of the motion as Taylor series, whose coefficients follow from a recurrence.
//!
//! In units of `μ R²` (see [`crate::frame`]), with `ψ = α − θ`, the ground's acceleration in units of g, `A` along the
//! lean and `Z` upwards, and `p² = g/(R M)`,
//!
//! `ω̇ = −p² [(1 + Z) sin ψ + A cos ψ] − T Δ'/(μ R² M) + ½ J' φ̇²/M`
//!
//! (Eq. 6.3 and, with the corrections of `docs/errata.md`, Eq. 6.6). A wobbling frame has besides `φ̇ = L/J` and
//! `L̇ = (g/R) U_s (A_x sin φ − A_y cos φ) − 2λ |φ̇| L`, `A = A_x cos φ + A_y sin φ`: with the momentum `L` in place of
//! `φ̇` the term `J' ω φ̇` of Eq. 6.7 needs not be carried, and the invariant of free motion is not lost to rounding.
//! The last term is the loss of [`crate::rolling`]. It bends where `L` is zero, and a step ends there.
//!
//! Sine and versine of `θ`, sine and cosine of `θ/2` and of `φ` come from their derivatives, quotients and the spring's
//! deformation from implicit recurrences: all are products of series. The series goes on until two terms running of
//! every unknown are below half a rounding of its largest, or, at the highest order, the step is shortened until they
//! are. Near the apex a step is limited beforehand, since there the coefficients would exceed what a number holds.
//!
//! # Source
//! E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, Section I.8 (recursive Taylor
//! coefficients).

use uplift_instructions::{Instructions, Vectors, Work, larger};
use uplift_statics::RestrainedColumns;
use uplift_taylor::{
    DEGREE, Factors, Forcing, LEAST_ORDER, ORDER, TRUNCATION, first_zero, leading_sign, product, stretch, value,
};

mod side_by_side;
mod strands;
mod wobble;

pub(crate) use side_by_side::{Begin, Begins, LANES, SeriesOfAll};
use strands::Strands;
use wobble::Wobble;

use crate::branch::Branch;

/// Coefficients of one function.
pub(crate) type Coefficients = [f64; DEGREE + 1];

/// What the recurrence needs of the frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Constants {
    pub(crate) sin_alpha: f64,
    pub(crate) cos_alpha: f64,
    /// `p²`, 1/s².
    pub(crate) p_squared: f64,
    /// `g/R`, 1/s².
    pub(crate) fall: f64,
    /// `M`.
    pub(crate) tilt_inertia: f64,
    /// Restrained columns over all columns over `μ R²`, 1/(kg m²).
    pub(crate) held: f64,
    /// `J = j₁ (1 − cos θ) + j₂ sin θ (1 − cos θ) + j₃ (1 − cos θ)²`.
    pub(crate) turning: [f64; 3],
    /// `J' = k₀ sin θ + k₁ (1 − cos θ) + k₂ sin θ (1 − cos θ) + k₃ (1 − cos θ)²`.
    pub(crate) turning_slope: [f64; 4],
    /// `2λ`: part of the momentum that a radian of turning takes.
    pub(crate) drag: f64,
}

/// Shaking on a step, in units of g.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shaken {
    /// Horizontal: along and across the lean in a plane, x and y otherwise.
    pub(crate) horizontal: [Forcing; 2],
    pub(crate) vertical: Forcing,
}

impl Shaken {
    /// No shaking.
    pub(crate) fn none() -> Self {
        Self { horizontal: [Forcing::none(); 2], vertical: Forcing::none() }
    }

    /// Stretches it to a step `ratio` times as long.
    pub(crate) fn stretch(&mut self, ratio: f64) {
        self.horizontal[0].stretch(ratio);
        self.horizontal[1].stretch(ratio);
        self.vertical.stretch(ratio);
    }

    /// The same on a step `ratio` times as long.
    pub(crate) fn stretched(&self, ratio: f64) -> Self {
        Self { horizontal: self.horizontal.map(|c| c.stretched(ratio)), vertical: self.vertical.stretched(ratio) }
    }
}

/// Turning of the lean at the begin of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turning {
    /// `φ`, rad.
    pub(crate) direction: f64,
    /// `L = J φ̇`, 1/s.
    pub(crate) momentum: f64,
}

/// The motion on a step, in powers of s from 0 to 1.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    /// Length of the step, at most what was asked, s.
    pub(crate) length_s: f64,
    order: usize,
    x: Coefficients,
    v: Coefficients,
    sine: Coefficients,
    versine: Coefficients,
    direction: Coefficients,
    momentum: Coefficients,
    turning: Coefficients,
    sin_direction: Coefficients,
    cos_direction: Coefficients,
    /// Whether the lean turned: in a plane momentum and turning are zero.
    wobbled: bool,
}

/// What a step is expanded in, kept from step to step: to clear and to move it would cost as much as to fill it.
#[derive(Debug)]
pub(crate) struct Expansion {
    instructions: Instructions,
    step: Step,
    sin_psi: Coefficients,
    cos_psi: Coefficients,
    /// Factors of the products with the velocity.
    swept: Factors<4>,
    wobble: Wobble,
    strands: Strands,
}

impl Expansion {
    pub(crate) fn new(instructions: Instructions) -> Self {
        let zero = [0.0; DEGREE + 1];
        Self {
            instructions,
            step: Step::NONE,
            sin_psi: zero,
            cos_psi: zero,
            swept: Factors::default(),
            wobble: Wobble::default(),
            strands: Strands::new(),
        }
    }

    /// The step that was expanded last.
    pub(crate) fn step(&self) -> &Step {
        &self.step
    }

    /// The motion from the rotation `x` and velocity `v`, of a frame that wobbles with `turning` or rocks in a plane,
    /// on a branch of its restrainers. With `balanced` the moments at the begin cancel: it uplifts there.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn expand(
        &mut self,
        constants: &Constants,
        (x, v): (f64, f64),
        turning: Option<Turning>,
        shaken: &Shaken,
        held: Option<(&Branch, &RestrainedColumns)>,
        step_s: f64,
        balanced: bool,
    ) {
        let step = &mut self.step;
        step.length_s = step_s;
        (step.x[0], step.v[0]) = (x, v);
        let (half_sin, half_cos) = (0.5 * x).sin_cos();
        (step.sine[0], step.versine[0]) = (2.0 * half_sin * half_cos, 2.0 * half_sin * half_sin);
        if let Some((branch, columns)) = held {
            self.strands.begin(branch, columns, x, [half_sin, half_cos]);
        }
        let multiples = held.map_or(Some([0.0, 0.0]), |(branch, _)| branch.multiples());
        let instructions = self.instructions;
        if let Some(turning) = turning {
            (step.direction[0], step.momentum[0]) = (turning.direction, turning.momentum);
            (step.sin_direction[0], step.cos_direction[0]) = turning.direction.sin_cos();
            step.wobbled = true;
            instructions.run(Expanding::<true> { expansion: self, constants, shaken, multiples, balanced });
        } else {
            if std::mem::take(&mut step.wobbled) {
                (step.momentum, step.turning) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
            }
            instructions.run(Expanding::<false> { expansion: self, constants, shaken, multiples, balanced });
        }
    }
}

/// The terms of a step of a frame that wobbles or not, after the first ones.
struct Expanding<'a, const WOBBLES: bool> {
    expansion: &'a mut Expansion,
    constants: &'a Constants,
    shaken: &'a Shaken,
    /// [`Branch::multiples`].
    multiples: Option<[f64; 2]>,
    balanced: bool,
}

impl<const WOBBLES: bool> Work for Expanding<'_, WOBBLES> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vectors>(self, _: V) {
        let Self { expansion, constants, shaken, multiples, balanced } = self;
        let Expansion { step, sin_psi, cos_psi, swept, wobble, strands, .. } = expansion;
        let (h, v) = (step.length_s, step.v[0]);
        let vertical = shaken.vertical.coefficients();
        let is_level = shaken.vertical.is_zero();
        let along = shaken.horizontal[0].coefficients();
        let by_tilt_inertia = 1.0 / constants.tilt_inertia;
        let mut sense = if WOBBLES { leading_sign(step.momentum[..1].iter()) } else { 0.0 };
        let (mut rotation, mut turning) = (Convergence::from([v]), Convergence::from([step.momentum[0], 0.0]));
        let mut is_converged = false;
        for k in 0..ORDER {
            let factor = h / (k + 1) as f64;
            let [half_sine, half_cosine] = strands.half(k);
            let tilt = [step.sine[k], step.versine[k], half_sine, half_cosine];
            let [sine_v, versine_v, half_sine_v, half_cosine_v] = swept.products(tilt, [step.v[k]; 4], k);
            let whole = f64::from(u8::from(k == 0)) - step.versine[k];
            sin_psi[k] = constants.sin_alpha * whole - constants.cos_alpha * step.sine[k];
            cos_psi[k] = constants.cos_alpha * whole + constants.sin_alpha * step.sine[k];
            let mut moment = sin_psi[k];
            if !is_level {
                moment += short_product(vertical, sin_psi, k);
            }
            let mut outward = 0.0;
            if WOBBLES {
                let change = wobble.order(constants, step, shaken, cos_psi[k], k);
                moment += change.push;
                outward = 0.5 * change.centrifugal;
                step.momentum[k + 1] = factor * constants.fall * change.across;
                if constants.drag > 0.0 {
                    // from zero on the momentum has the sign of what moves it, and until then nothing is lost
                    step.momentum[k + 1] -= factor * constants.drag * sense * product(&step.momentum, &step.turning, k);
                    sense = if sense == 0.0 { leading_sign(step.momentum[k + 1..k + 2].iter()) } else { sense };
                }
                step.direction[k + 1] = factor * step.turning[k];
                step.sin_direction[k + 1] = factor * change.sin;
                step.cos_direction[k + 1] = -factor * change.cos;
            } else {
                moment += short_product(along, cos_psi, k);
            }
            let pull = match multiples {
                // where the half angle is not needed, its products may be no numbers
                Some([of_sine, 0.0]) => of_sine * step.sine[k],
                Some([of_sine, of_half_cosine]) => of_sine * step.sine[k] + of_half_cosine * half_cosine,
                None => strands.moment(&step.sine, &step.versine, k),
            };
            let inward = (pull * constants.held - outward) * by_tilt_inertia;
            step.v[k + 1] = if balanced && k == 0 { 0.0 } else { -factor * (constants.p_squared * moment + inward) };
            step.versine[k + 1] = factor * sine_v;
            step.sine[k + 1] = factor * (step.v[k] - versine_v);
            strands.extend([half_sine_v, half_cosine_v], factor, k);
            step.x[k + 1] = factor * step.v[k];
            step.order = k + 1;
            is_converged = rotation.take([step.v[k + 1]]);
            if WOBBLES {
                is_converged &= turning.take([step.momentum[k + 1], step.turning[k]]);
            }
            is_converged &= step.order >= LEAST_ORDER;
            if is_converged {
                break;
            }
        }
        step.x[step.order + 1] = h / (step.order + 1) as f64 * step.v[step.order];
        if !is_converged {
            while let Some(ratio) = step.excess() {
                step.shorten(ratio);
            }
        }
    }
}

/// Whether the last two terms of series are negligible beside the largest.
struct Convergence<const N: usize> {
    largest: [f64; N],
    last: [f64; N],
}

impl<const N: usize> Convergence<N> {
    /// Of series that begin so.
    fn from(first: [f64; N]) -> Self {
        let first = first.map(f64::abs);
        Self { largest: first, last: first }
    }

    /// With one term more of each.
    #[inline(always)]
    fn take(&mut self, terms: [f64; N]) -> bool {
        let mut is_converged = true;
        for (i, term) in terms.into_iter().enumerate() {
            let term = term.abs();
            self.largest[i] = larger(term, self.largest[i]);
            // infinite ones are told by `Step::is_finite`
            let negligible = TRUNCATION * self.largest[i];
            is_converged &= term <= negligible && self.last[i] <= negligible;
            self.last[i] = term;
        }
        is_converged
    }
}

impl Step {
    pub(crate) const NONE: Self = Self {
        length_s: 0.0,
        order: 0,
        x: [0.0; DEGREE + 1],
        v: [0.0; DEGREE + 1],
        sine: [0.0; DEGREE + 1],
        versine: [0.0; DEGREE + 1],
        direction: [0.0; DEGREE + 1],
        momentum: [0.0; DEGREE + 1],
        turning: [0.0; DEGREE + 1],
        sin_direction: [0.0; DEGREE + 1],
        cos_direction: [0.0; DEGREE + 1],
        wobbled: false,
    };

    /// The largest of the last two terms of velocity, momentum and turning.
    fn tails(&self) -> [f64; 3] {
        let n = self.order;
        let last = |c: &Coefficients, n: usize| c[n].abs().max(c[n - 1].abs());
        [last(&self.v, n), last(&self.momentum, n), last(&self.turning, n - 1)]
    }

    /// By what to shorten the step if the last two terms are not negligible beside the largest.
    fn excess(&self) -> Option<f64> {
        let size = |c: &Coefficients| c[..=self.order].iter().fold(0.0_f64, |largest, c| largest.max(c.abs()));
        let sizes = [size(&self.v), size(&self.momentum), size(&self.turning)];
        let ratio = |(tail, size): (f64, f64)| {
            let allowed = TRUNCATION * size;
            if tail > allowed { 0.9 * (allowed / tail).powf(1.0 / self.order as f64) } else { 1.0 }
        };
        let least = self.tails().into_iter().zip(sizes).map(ratio).fold(1.0, f64::min);
        (least < 1.0).then_some(least)
    }

    fn shorten(&mut self, ratio: f64) {
        self.length_s *= ratio;
        for c in [
            &mut self.x,
            &mut self.v,
            &mut self.sine,
            &mut self.versine,
            &mut self.direction,
            &mut self.momentum,
            &mut self.turning,
            &mut self.sin_direction,
            &mut self.cos_direction,
        ] {
            stretch(c, ratio);
        }
    }

    /// Whether its coefficients are numbers: on far too long a step they grow beyond all.
    pub(crate) fn is_finite(&self) -> bool {
        let last = [self.v[self.order], self.momentum[self.order], self.turning[self.order - 1]];
        self.length_s > 0.0 && last.iter().all(|c| c.is_finite())
    }

    /// Coefficients of the rotation.
    pub(crate) fn x(&self) -> &[f64] {
        &self.x[..self.order + 2]
    }

    /// Coefficients of the velocity.
    pub(crate) fn v(&self) -> &[f64] {
        &self.v[..=self.order]
    }

    /// Rotation and velocity at s.
    pub(crate) fn at(&self, s: f64) -> (f64, f64) {
        (value_at(self.x(), s), value_at(self.v(), s))
    }

    /// Velocity at s, rad/s.
    pub(crate) fn velocity(&self, s: f64) -> f64 {
        value_at(self.v(), s)
    }

    /// Acceleration at s, rad/s².
    pub(crate) fn acceleration(&self, s: f64) -> f64 {
        slope(self.v(), s) / self.length_s
    }

    /// `sin θ` and `1 − cos θ` at s.
    pub(crate) fn tilt_at(&self, s: f64) -> (f64, f64) {
        (value_at(&self.sine[..=self.order], s), value_at(&self.versine[..=self.order], s))
    }

    /// `cos φ` and `sin φ` at s.
    pub(crate) fn direction_vector(&self, s: f64) -> [f64; 2] {
        [value_at(&self.cos_direction[..=self.order], s), value_at(&self.sin_direction[..=self.order], s)]
    }

    /// Direction of the lean and its momentum at s.
    pub(crate) fn turning_at(&self, s: f64) -> Turning {
        Turning {
            direction: value(&self.direction[..=self.order], s),
            momentum: value(&self.momentum[..=self.order], s),
        }
    }

    /// First s in (0, 1) at which the lean stops turning, and may turn to the other side.
    pub(crate) fn stops_turning(&self) -> Option<f64> {
        let sense = leading_sign(self.momentum[..=self.order].iter());
        first_zero(&self.momentum.map(|c| sense * c)[..=self.order])
    }

    /// `φ̇` and `φ̈` at s, rad/s and rad/s².
    pub(crate) fn turning_rate(&self, s: f64) -> (f64, f64) {
        let c = &self.turning[..self.order];
        (value_at(c, s), slope(c, s) / self.length_s)
    }

    /// Coefficients of `U_x/2R` and `U_y/2R`.
    pub(crate) fn travel(&self, constants: &Constants) -> [Coefficients; 2] {
        let mut radial = [0.0; DEGREE + 1];
        for (k, radial) in radial.iter_mut().enumerate().take(self.order + 1) {
            *radial = constants.cos_alpha * self.sine[k] + constants.sin_alpha * self.versine[k];
        }
        [&self.cos_direction, &self.sin_direction].map(|direction| {
            let mut travel = [0.0; DEGREE + 1];
            for (k, travel) in travel.iter_mut().enumerate().take(self.order + 1) {
                *travel = product(&radial, direction, k);
            }
            travel
        })
    }

    /// Terms of [`travel`](Self::travel).
    pub(crate) fn terms(&self) -> usize {
        self.order + 1
    }
}

/// A series at s, at whose begin there is nothing to sum: every step is looked at there.
fn value_at(c: &[f64], s: f64) -> f64 {
    if s == 0.0 { c[0] } else { value(c, s) }
}

/// Derivative of a series by s.
fn slope(c: &[f64], s: f64) -> f64 {
    if s == 0.0 {
        return c[1];
    }
    c.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c)| sum * s + k as f64 * c)
}

/// `Σ aⱼ bₖ₋ⱼ` where `a` may be short: on a record it is a straight line.
#[inline(always)]
fn short_product(a: &[f64], b: &Coefficients, k: usize) -> f64 {
    match a {
        [begin, change] if k > 0 => begin * b[k] + change * b[k - 1],
        _ => any_product(a, b, k),
    }
}

/// Kept apart: its loops would cost the step that needs none of them.
#[inline(never)]
fn any_product(a: &[f64], b: &Coefficients, k: usize) -> f64 {
    a.iter().zip(b[..=k].iter().rev()).map(|(a, b)| a * b).sum()
}
