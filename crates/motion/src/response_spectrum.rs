//! Spectral acceleration: the peak of a linear oscillator of 5 % damping.
//!
//! The ground acceleration is linear between samples, and the oscillator's motion under it is integrated exactly, step
//! by step: its power series in the time since the last step, to the last digit. A peak between two steps counts.
//!
//! # Source
//!
//! N. C. Nigam and P. C. Jennings, "Calculation of response spectra from strong-motion earthquake records", Bull.
//! Seism. Soc. Am. 59 (1969) 909–922: the recurrence, whose coefficients are taken from the series here.

use std::convert::Infallible;
use std::f64::consts::TAU;

use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::pair::RecordPair;
use crate::rotation::{common_time_step_s, directions};

/// Share of critical damping of every spectral ordinate.
const DAMPING: f64 = 0.05;

/// Number of the periods of an average spectral acceleration, both ends included.
pub const AVERAGED_PERIODS: usize = 10;

/// Steps of an oscillator are at most this share of its period, so that there is at most one peak in a step, and the
/// series below is exact to rounding.
const LONGEST_STEP: f64 = 1.0 / 20.0;

/// Terms of the power series: the last one is below 1e-19 for a step of a twentieth of the period.
const TERMS: usize = 16;

/// Periods of Housner's spectrum intensity: 0.1 to 2.5 s in steps of 0.05 s \[s\].
const INTENSITY_STEP_S: f64 = 0.05;
const INTENSITY_FIRST: u32 = 2;
const INTENSITY_LAST: u32 = 50;

impl Accelerogram {
    /// Pseudo-spectral acceleration \[m/s²\], ω² max |u|, of the oscillator u″ + 2 ζ ω u′ + ω² u = −a with ζ = 0.05
    /// and the natural period `period_s` \[s\], 2π/ω, from rest; its free motion after the record counts.
    pub fn spectral_acceleration_m_s2(&self, period_s: f64) -> f64 {
        let stepper = Stepper::new(self.dt_s(), period_s);
        let mut state = State::default();
        let mut peak = 0.0_f64;
        for (from, to) in with_free_motion(self.acceleration_m_s2(), stepper.free_samples) {
            for part in 0..stepper.parts {
                let (a0, a1) = stepper.part(from, to, part);
                let next = stepper.next(state, a0, a1);
                peak = peak.max(next.displacement.abs());
                if stepper.may_exceed(state, next, peak) {
                    peak = peak.max(stepper.extreme((state, a0, a1), next));
                }
                state = next;
            }
        }
        peak
    }

    /// Geometric mean of the spectral acceleration \[m/s²\] at [`AVERAGED_PERIODS`] periods at equal steps from
    /// `from_s` to `to_s` \[s\].
    pub fn average_spectral_acceleration_m_s2(&self, from_s: f64, to_s: f64) -> f64 {
        let ordinate = |period_s| Ok::<_, Infallible>(self.spectral_acceleration_m_s2(period_s));
        let Ok(average_m_s2) = average([from_s, to_s], ordinate);
        average_m_s2
    }

    /// Housner's spectrum intensity \[m\]: the integral of the pseudo-velocity SA T/2π over the periods from 0.1 to
    /// 2.5 s, by the trapezoidal rule in steps of 0.05 s.
    ///
    /// # Source
    ///
    /// G. W. Housner, "Spectrum intensities of strong-motion earthquakes", Proc. Symp. on Earthquake and Blast Effects
    /// on Structures, Los Angeles, 1952; here with a damping of 5 %.
    pub fn spectrum_intensity_m(&self) -> f64 {
        let ordinate = |period_s| Ok::<_, Infallible>(self.spectral_acceleration_m_s2(period_s));
        let Ok(intensity_m) = spectrum_intensity_m(ordinate);
        intensity_m
    }
}

/// Geometric mean of the `ordinates` at [`AVERAGED_PERIODS`] periods from the one end to the other, in their unit.
pub(crate) fn average<E>([from_s, to_s]: [f64; 2], ordinate: impl Fn(f64) -> Result<f64, E>) -> Result<f64, E> {
    let last = (AVERAGED_PERIODS - 1) as f64;
    let period_s = |index: usize| from_s + (to_s - from_s) * index as f64 / last;
    let logarithms = (0..AVERAGED_PERIODS).map(|index| ordinate(period_s(index)).map(f64::ln));
    Ok((logarithms.sum::<Result<f64, E>>()? / AVERAGED_PERIODS as f64).exp())
}

/// Spectrum intensity \[m\] of spectral accelerations \[m/s²\] by their period \[s\].
pub(crate) fn spectrum_intensity_m<E>(ordinate_m_s2: impl Fn(f64) -> Result<f64, E>) -> Result<f64, E> {
    let weighed = |number: u32| {
        let period_s = INTENSITY_STEP_S * f64::from(number);
        let is_end = number == INTENSITY_FIRST || number == INTENSITY_LAST;
        let pseudo_velocity_m_s = ordinate_m_s2(period_s)? * period_s / TAU;
        Ok(pseudo_velocity_m_s * if is_end { 0.5 } else { 1.0 })
    };
    Ok(INTENSITY_STEP_S * (INTENSITY_FIRST..=INTENSITY_LAST).map(weighed).sum::<Result<f64, E>>()?)
}

/// Spectral acceleration \[m/s²\] at the period `period_s` \[s\] in every horizontal direction: the peak of
/// u₁ cos θ + u₂ sin θ, for the oscillator is linear.
///
/// # Errors
///
/// [`MotionError::UnequalTimeSteps`].
pub(crate) fn rotated_spectral_accelerations(pair: &RecordPair, period_s: f64) -> Result<Vec<f64>, MotionError> {
    let stepper = Stepper::new(common_time_step_s(pair)?, period_s);
    let samples = pair.h1.len().max(pair.h2.len());
    let [first, second] = [&pair.h1, &pair.h2].map(|component| {
        let mut acceleration_m_s2 = component.acceleration_m_s2().to_vec();
        acceleration_m_s2.resize(samples, 0.0);
        stepper.history(&acceleration_m_s2)
    });
    let steps: Vec<[Step; 2]> = first.into_iter().zip(second).map(|(one, two)| [one, two]).collect();
    let candidates = stepper.far_steps(&steps);
    let peak = |direction: [f64; 2]| {
        let mut peak = 0.0_f64;
        for &index in &candidates {
            let (state, a0, a1) = turned(steps[index], direction);
            let next = stepper.next(state, a0, a1);
            peak = peak.max(state.displacement.abs()).max(next.displacement.abs());
            if stepper.may_exceed(state, next, peak) {
                peak = peak.max(stepper.extreme((state, a0, a1), next));
            }
        }
        peak
    };
    Ok(directions().map(peak).collect())
}

/// A step of both components, turned into one direction.
fn turned([one, two]: [Step; 2], [cos, sin]: [f64; 2]) -> Step {
    let mixed = |a: f64, b: f64| a * cos + b * sin;
    let state = State {
        displacement: mixed(one.0.displacement, two.0.displacement),
        velocity: mixed(one.0.velocity, two.0.velocity),
    };
    (state, mixed(one.1, two.1), mixed(one.2, two.2))
}

/// Relative displacement times ω², and relative velocity times ω: both \[m/s²\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct State {
    displacement: f64,
    velocity: f64,
}

/// State at the beginning of a step, and the ground acceleration at both of its ends.
type Step = (State, f64, f64);

/// Exact steps of one oscillator; time is measured in ωt, displacement and velocity as [`State`] says.
struct Stepper {
    /// Steps into which the interval between two samples is divided.
    parts: u32,
    /// Samples without acceleration after a record: more than one period.
    free_samples: usize,
    /// ω times the length of a step.
    length: f64,
    /// What displacement, velocity and the acceleration at both ends of a step make of displacement and velocity.
    displacement: [f64; 4],
    velocity: [f64; 4],
}

impl Stepper {
    fn new(dt_s: f64, period_s: f64) -> Self {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a ratio above zero")]
        let ceiling = |ratio: f64| ratio.ceil().max(1.0) as u32;
        let parts = ceiling(dt_s / (LONGEST_STEP * period_s));
        let length = TAU / period_s * dt_s / f64::from(parts);
        let rest = State::default();
        let ends = [
            end(State { displacement: 1.0, ..rest }, 0.0, 0.0, length),
            end(State { velocity: 1.0, ..rest }, 0.0, 0.0, length),
            end(rest, 1.0, 0.0, length),
            end(rest, 0.0, 1.0, length),
        ];
        Self {
            parts,
            free_samples: ceiling(period_s / dt_s) as usize + 1,
            length,
            displacement: ends.map(|state| state.displacement),
            velocity: ends.map(|state| state.velocity),
        }
    }

    /// The acceleration at both ends of a part of the interval between two samples.
    fn part(&self, from: f64, to: f64, part: u32) -> (f64, f64) {
        if self.parts == 1 {
            return (from, to);
        }
        let at = |number: u32| from + (to - from) * f64::from(number) / f64::from(self.parts);
        (at(part), at(part + 1))
    }

    /// The state one step later.
    fn next(&self, State { displacement, velocity }: State, a0: f64, a1: f64) -> State {
        let sum =
            |[by_u, by_v, by_a0, by_a1]: [f64; 4]| by_u * displacement + by_v * velocity + by_a0 * a0 + by_a1 * a1;
        State { displacement: sum(self.displacement), velocity: sum(self.velocity) }
    }

    /// Whether a displacement in a step can be larger than `peak`: twice the step at the faster end is more than
    /// enough.
    fn may_exceed(&self, state: State, next: State, peak: f64) -> bool {
        let fastest = state.velocity.abs().max(next.velocity.abs());
        state.displacement.abs().max(next.displacement.abs()) + 2.0 * fastest * self.length > peak
    }

    /// The indices of those `steps` in which the displacement may be largest in some direction: not those that stay
    /// nearer to the origin than what a few reach in every direction.
    fn far_steps(&self, steps: &[[Step; 2]]) -> Vec<usize> {
        let reach = |step: [Step; 2], direction| turned(step, direction).0.displacement.abs();
        let farthest = |direction| {
            let farther = |a, b| if reach(b, direction) > reach(a, direction) { b } else { a };
            steps.iter().copied().reduce(farther)
        };
        let few: Vec<[Step; 2]> = directions().step_by(30).filter_map(farthest).collect();
        let reached = |direction| few.iter().fold(0.0_f64, |most, step| most.max(reach(*step, direction)));
        let least = directions().map(reached).fold(f64::INFINITY, f64::min);
        let size = |[x, y]: [f64; 2]| x.hypot(y);
        let is_far = |index: &usize| {
            let next = (index + 1).min(steps.len() - 1);
            let [here, there] = [*index, next].map(|index| {
                let [one, two] = steps[index];
                (size([one.0.displacement, two.0.displacement]), size([one.0.velocity, two.0.velocity]))
            });
            here.0.max(there.0) + 2.0 * here.1.max(there.1) * self.length >= least
        };
        (0..steps.len()).filter(is_far).collect()
    }

    /// The largest |displacement| where the velocity vanishes within a step that ends in the state `next`; zero where
    /// it does not. Where the acceleration changes its sign the velocity may vanish before and after.
    fn extreme(&self, (state, a0, a1): Step, next: State) -> f64 {
        let at = |time: f64| end_within(state, a0, a1, self.length, time);
        let acceleration = |state: State, a: f64| -2.0 * DAMPING * state.velocity - state.displacement - a;
        let (first, last) = (acceleration(state, a0), acceleration(next, a1));
        if first * last >= 0.0 {
            return vanishing([0.0, self.length], [state.velocity, next.velocity], at);
        }
        // nearly a straight line within a step
        let turn = self.length * first / (first - last);
        let between = at(turn).velocity;
        let before = vanishing([0.0, turn], [state.velocity, between], at);
        before.max(vanishing([turn, self.length], [between, next.velocity], at))
    }

    /// Every step of a component, and of the free motion after it.
    fn history(&self, acceleration_m_s2: &[f64]) -> Vec<Step> {
        let mut state = State::default();
        let mut steps = Vec::new();
        for (from, to) in with_free_motion(acceleration_m_s2, self.free_samples) {
            for part in 0..self.parts {
                let (a0, a1) = self.part(from, to, part);
                steps.push((state, a0, a1));
                state = self.next(state, a0, a1);
            }
        }
        steps
    }
}

/// |displacement| where the velocity vanishes between two times, with the velocities there; zero where these have one
/// sign. By secants that keep off the ends of the bracket, along which they may creep.
fn vanishing([mut low, mut high]: [f64; 2], velocities: [f64; 2], at: impl Fn(f64) -> State) -> f64 {
    let [mut low_velocity, mut high_velocity] = velocities;
    if low_velocity * high_velocity >= 0.0 {
        return 0.0;
    }
    let (mut largest, nearby) = (0.0_f64, 1e-8 * (high - low));
    while high - low > nearby {
        let margin = 0.1 * (high - low);
        let secant = low - low_velocity * (high - low) / (high_velocity - low_velocity);
        let time = secant.clamp(low + margin, high - margin);
        let found = at(time);
        largest = largest.max(found.displacement.abs());
        if (found.velocity < 0.0) == (low_velocity < 0.0) {
            (low, low_velocity) = (time, found.velocity);
        } else {
            (high, high_velocity) = (time, found.velocity);
        }
    }
    largest
}

/// Values at both ends of the intervals of a record, and of `free` intervals without acceleration after it.
fn with_free_motion(acceleration_m_s2: &[f64], free: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
    let forced = acceleration_m_s2.windows(2).map(|ends| (ends[0], ends[1]));
    forced.chain(std::iter::repeat_n((0.0, 0.0), free))
}

/// The state after a whole step of the length `length`.
fn end(state: State, a0: f64, a1: f64, length: f64) -> State {
    end_within(state, a0, a1, length, length)
}

/// The state at `time` within a step of the length `length`, both times ω: by the power series of the solution of
/// x″ = −2 ζ x′ − x − a, whose coefficients follow from each other.
fn end_within(state: State, a0: f64, a1: f64, length: f64, time: f64) -> State {
    let mut series = [0.0; TERMS];
    (series[0], series[1]) = (state.displacement, state.velocity);
    let forcing = [a0, (a1 - a0) / length];
    for n in 0..TERMS - 2 {
        let order = n as f64;
        let forced = forcing.get(n).copied().unwrap_or(0.0);
        let second = -2.0 * DAMPING * (order + 1.0) * series[n + 1] - series[n] - forced;
        series[n + 2] = second / ((order + 1.0) * (order + 2.0));
    }
    let (mut displacement, mut velocity) = (0.0, 0.0);
    for n in (0..TERMS).rev() {
        displacement = displacement * time + series[n];
        if n > 0 {
            velocity = velocity * time + n as f64 * series[n];
        }
    }
    State { displacement, velocity }
}

#[cfg(test)]
mod tests;
