//! What is kept of the motion: events, peaks, the deck's acceleration, the rows of a history.

use std::ops::ControlFlow;

use uplift_instructions::Instructions;
use uplift_taylor::{DEGREE, leading_sign, sign_changes, value};

use super::step::first_reach;
use super::{Lean, Motion};
use crate::ground::length;
use crate::history::{HistoryRow, Moment, Observer};
use crate::series::{Constants, Expansion, Shaken, Step};

impl<O: Observer> Motion<O> {
    /// Tells of the events that the step passes for the first time.
    pub(super) fn watch(&mut self, step: &Step, reach: f64, end: f64, time_s: impl Fn(f64) -> f64) {
        while let Some(&(rad, event)) = self.watched.last() {
            let Some(s) = (reach >= rad).then(|| first_reach(step.x(), rad)).flatten() else { break };
            // a step that ends at a threshold reaches it there, to rounding
            if s > end * (1.0 + 1e-9) {
                break;
            }
            self.events.push((event, time_s(s)));
            self.watched.pop();
        }
    }

    /// Peaks inside a step: roots of velocities, not samples.
    pub(super) fn follow_peaks(
        &mut self,
        step: &Step,
        (reach, spread): (f64, f64),
        end: f64,
        time_s: impl Fn(f64) -> f64,
    ) {
        let v = step.v();
        let wobbles = matches!(self.lean, Lean::Space(_));
        let may_turn = v[0].abs() <= v[1..].iter().map(|v| v.abs()).sum();
        if reach > self.peaks.rotation.value || (O::FOLLOWS_ALL && wobbles && may_turn) {
            let mut sign = leading_sign(v.iter());
            let _ = sign_changes(v, &mut |s| {
                if s > end {
                    return ControlFlow::Break(());
                }
                let x = value(step.x(), s);
                let is_least = sign < 0.0;
                sign = -sign;
                if is_least {
                    self.peaks.least = Some(self.peaks.least.map_or(x, |least| least.min(x)));
                } else if x > self.peaks.rotation.value {
                    self.peaks.rotation.raise(x, time_s(s));
                    self.peaks.direction_rad = self.direction_at(Some(step), s);
                }
                ControlFlow::Continue(())
            });
        }
        if !O::FOLLOWS_ALL {
            return;
        }
        // u/2R is less than the rotation
        let lowest = self.peaks.travel[0].value.min(self.peaks.travel[1].value);
        if !wobbles || step.x()[0] + spread <= lowest {
            return;
        }
        let terms = step.terms();
        for (travel, peak) in step.travel(&self.constants).iter().zip(&mut self.peaks.travel) {
            let travel = &travel[..terms];
            if travel.iter().map(|c| c.abs()).sum::<f64>() <= peak.value {
                continue;
            }
            let mut slope = [0.0; DEGREE];
            for (k, slope) in slope.iter_mut().enumerate().take(terms - 1) {
                *slope = (k + 1) as f64 * travel[k + 1];
            }
            let _ = sign_changes(&slope[..terms - 1], &mut |s| {
                if s > end {
                    return ControlFlow::Break(());
                }
                peak.raise(value(travel, s).abs(), time_s(s));
                ControlFlow::Continue(())
            });
        }
    }

    /// `u/2R` at a rotation.
    fn travel_at(&self, x: f64) -> f64 {
        let half = (0.5 * x).sin();
        x.sin() * self.constants.cos_alpha + 2.0 * half * half * self.constants.sin_alpha
    }

    pub(super) fn direction_at(&self, step: Option<&Step>, s: f64) -> f64 {
        match (self.lean, step) {
            (Lean::Plane { direction, side }, _) => (side * direction[1]).atan2(side * direction[0]),
            (Lean::Space(_), Some(step)) => step.turning_at(s).direction,
            (Lean::Space(turning), None) => turning.direction,
        }
    }

    pub(super) fn raise_peaks(&mut self, x: f64, time_s: f64, s: f64, step: Option<&Step>) {
        if x > self.peaks.rotation.value {
            self.peaks.rotation.raise(x, time_s);
            self.peaks.direction_rad = self.direction_at(step, s);
        }
        if O::FOLLOWS_ALL && matches!(self.lean, Lean::Space(_)) {
            let travel = self.travel_at(x);
            let (sin, cos) = self.direction_at(step, s).sin_cos();
            self.peaks.travel[0].raise((travel * cos).abs(), time_s);
            self.peaks.travel[1].raise((travel * sin).abs(), time_s);
        }
    }

    /// Total acceleration of deck and base shear at s of a step.
    pub(super) fn follow_deck(&mut self, step: &Step, shaken: &Shaken, s: f64, time_s: f64) {
        if !O::FOLLOWS_ALL {
            return;
        }
        let own = self.deck_acceleration(step, s);
        let ground = self.ground(shaken, s);
        self.raise_deck(own, ground, time_s);
    }

    fn raise_deck(&mut self, own: [f64; 2], ground: [f64; 2], time_s: f64) {
        self.peaks.deck.raise(length([own[0] + ground[0], own[1] + ground[1]]), time_s);
        let deck_kg = self.frame.deck_mass_kg();
        let columns_kg = f64::from(self.frame.columns().columns()) * self.frame.column_mass_kg();
        // the middle of a column travels half as far as the deck
        let force = [0, 1].map(|i| deck_kg * (own[i] + ground[i]) + columns_kg * (0.5 * own[i] + ground[i]));
        self.peaks.reaction.raise(length(force), time_s);
    }

    /// Acceleration of the deck relative to the ground in x and y at s of a step, m/s².
    fn deck_acceleration(&self, step: &Step, s: f64) -> [f64; 2] {
        let Constants { sin_alpha, cos_alpha, .. } = self.constants;
        let diagonal_m = self.diagonal_m;
        let (sine, versine) = step.tilt_at(s);
        let (v, a) = (step.velocity(s), step.acceleration(s));
        // U, dU/dθ and d²U/dθ²
        let travel = diagonal_m * (cos_alpha * sine + sin_alpha * versine);
        let slope = diagonal_m * (cos_alpha * (1.0 - versine) + sin_alpha * sine);
        let curvature = diagonal_m * (sin_alpha * (1.0 - versine) - cos_alpha * sine);
        let radial = curvature * v * v + slope * a;
        match self.lean {
            Lean::Plane { direction, side } => direction.map(|component| side * radial * component),
            Lean::Space(_) => {
                let (turning, change) = step.turning_rate(s);
                let radial = radial - travel * turning * turning;
                let across = travel * change + 2.0 * slope * v * turning;
                let [cos, sin] = step.direction_vector(s);
                [radial * cos - across * sin, radial * sin + across * cos]
            }
        }
    }

    /// Upward acceleration of the deck relative to the ground at the beginning of a step, m/s².
    fn rise_acceleration(&self, step: &Step) -> f64 {
        let angle = self.frame.geometry().slenderness_rad() - self.x;
        self.diagonal_m * (angle.sin() * step.acceleration(0.0) - angle.cos() * self.v * self.v)
    }

    /// Ground acceleration in x and y at s, m/s².
    fn ground(&self, shaken: &Shaken, s: f64) -> [f64; 2] {
        let gravity = self.frame.gravity_m_s2();
        let [first, second] = [&shaken.horizontal[0], &shaken.horizontal[1]].map(|forcing| gravity * forcing.value(s));
        match self.lean {
            Lean::Plane { direction, side } => direction.map(|component| side * first * component),
            Lean::Space(_) => [first, second],
        }
    }

    /// A frame at rest moves with the ground, whose acceleration is given in units of g, as long as that does not lift
    /// it.
    pub(crate) fn follow_ground(&mut self, [x, y, z]: [f64; 3], time_s: f64) {
        if !O::FOLLOWS_ALL || length([x, y]) > self.tangent * (1.0 + z) + self.prestress {
            return;
        }
        let ground = [x, y].map(|component| self.frame.gravity_m_s2() * component);
        self.raise_deck([0.0; 2], ground, time_s);
    }

    /// Tells the observer of the present state under shaking of components x, y and z.
    pub(crate) fn observe_sample(&mut self, time_s: f64, mut shaken: Shaken) {
        self.lean_into(&mut shaken);
        self.observe(time_s, Moment::Sample, &shaken);
    }

    pub(super) fn observe(&mut self, time_s: f64, moment: Moment, shaken: &Shaken) {
        if !O::KEEPS {
            return;
        }
        let direction = self.direction_at(None, 0.0);
        let ground = self.ground(shaken, 0.0);
        let (mut own, mut rising) = ([0.0; 2], 0.0);
        if !self.resting && self.x > 0.0 {
            let still = shaken.stretched(0.0);
            let mut expansion = Expansion::new(Instructions::chosen());
            self.expand(&mut expansion, &still, 1e-9 / self.p, false);
            own = self.deck_acceleration(expansion.step(), 0.0);
            rising = self.rise_acceleration(expansion.step());
        }
        let columns = self.frame.columns();
        let held = columns.restrainer().and_then(|law| law.at(columns.elongation(self.x).elongation_m).ok());
        let geometry = columns.geometry();
        let travel_m = uplift_statics::tilt::travel_m(geometry, self.x);
        let (sin, cos) = direction.sin_cos();
        let side = if let Lean::Plane { side, .. } = self.lean { side } else { 1.0 };
        self.observer.observe(HistoryRow {
            time_s,
            rotation_rad: side * self.x,
            direction_rad: direction,
            velocity_rad_s: side * self.v,
            turning_rad_s: self.turning_rad_s(),
            displacement_x_m: travel_m * cos,
            displacement_y_m: travel_m * sin,
            rise_m: uplift_statics::tilt::rise_m(geometry, self.x),
            tendon_n: held.map_or(0.0, |held| held.force_n),
            spring_m: held.and_then(|held| held.deformation_m).unwrap_or(0.0),
            deck_acceleration_x_m_s2: own[0] + ground[0],
            deck_acceleration_y_m_s2: own[1] + ground[1],
            deck_acceleration_z_m_s2: rising + self.frame.gravity_m_s2() * shaken.vertical.value(0.0),
            moment,
        });
    }
}
