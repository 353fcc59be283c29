//! The motion itself: rest, uplift, rocking or wobbling, impacts or passages by the apex, segment by segment of the
//! shaking.

use std::ops::ControlFlow;

use uplift_statics::EventKind;
use uplift_taylor::{DEGREE, Forcing, Rebound, first_zero, leading_sign, sign_changes, value};

use crate::branch::{Branch, branches};
use crate::error::FrameError;
use crate::escape::{Free, LYING_RAD};
use crate::frame::RockingFrame;
use crate::history::{HistoryRow, Moment, Observer};
use crate::peaks::Peaks;
use crate::series::{Constants, Shaken, Step, Turning};
use crate::uplift::{Uplift, uplift_in_plane, uplift_in_space};

/// Impacts in one segment after which a frame that cannot be shown to come to rest is taken to be.
const MOST_IMPACTS: u32 = 100_000;

/// Steps in one segment after which a wobbling frame is given up.
const MOST_STEPS: u64 = 2_000_000;

/// Longest step in units of 1/p.
pub(crate) const LONGEST_STEP: f64 = 0.5;

/// Longest step towards the apex as a part of the radius of convergence there: order 20 or so.
const APEX_STEP: f64 = 0.15;

/// Rotation below which a passage by the apex is a straight line in the developed cone, rad, ...
const APEX_RAD: f64 = 1e-10;

/// ... if gravity deflects it by less than this, rad.
const APEX_DEFLECTION: f64 = 1e-12;

/// Why the motion ends before the shaking, or before the time asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The frame does not come back.
    Overturned,
    /// The largest rotation of free motion is known.
    PeakPassed,
}

/// How the columns lean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Lean {
    /// In a plane of the direction given, to one side (1) or the other (−1) of it.
    Plane { direction: [f64; 2], side: f64 },
    /// In any direction.
    Space(Turning),
}

/// What decides about rest and impacts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rules {
    pub(crate) restitution: f64,
    pub(crate) rest_amplitude_rad: f64,
    pub(crate) start_rotation_rad: f64,
}

/// A result of a step, or the end of the motion.
type Flow<T> = Result<ControlFlow<Ending, T>, FrameError>;

/// State of a frame in motion.
#[derive(Debug)]
pub(crate) struct Motion<O> {
    /// The frame with the law that its restrainers have by now.
    frame: RockingFrame,
    constants: Constants,
    p: f64,
    tangent: f64,
    prestress: f64,
    /// `κ = √(c/M)`, `J → c θ²`.
    kappa: f64,
    rules: Rules,
    branches: Vec<Branch>,
    branch: usize,
    stop_rad: f64,
    pub(crate) lean: Lean,
    pub(crate) x: f64,
    pub(crate) v: f64,
    pub(crate) resting: bool,
    pub(crate) peaks: Peaks,
    pub(crate) uplift_s: Option<f64>,
    pub(crate) impacts: u64,
    pub(crate) rests: u64,
    pub(crate) was_cut: bool,
    /// Events to come, the next last, with their rotations.
    watched: Vec<(f64, EventKind)>,
    pub(crate) events: Vec<(EventKind, f64)>,
    pub(crate) observer: O,
}

impl<O: Observer> Motion<O> {
    /// A frame at rest.
    pub(crate) fn new(frame: &RockingFrame, lean: Lean, rules: Rules, observer: O) -> Self {
        let geometry = frame.geometry();
        let (sin, cos) = geometry.slenderness_rad().sin_cos();
        let inertia = frame.inertia();
        let columns = frame.columns();
        let share = f64::from(columns.restrained()) / f64::from(columns.columns());
        let constants = Constants {
            sin_alpha: sin,
            cos_alpha: cos,
            p_squared: frame.frequency_parameter_rad_s().powi(2),
            fall: frame.gravity_m_s2() / geometry.size_m(),
            tilt_inertia: inertia.tilt,
            held: share / (frame.mass_kg() * geometry.size_m().powi(2)),
            turning: [
                2.0 * (inertia.deck * cos * cos + inertia.diameter),
                2.0 * inertia.deck * sin * cos,
                inertia.deck * (sin * sin - cos * cos) - inertia.diameter + inertia.axis,
            ],
            turning_slope: [
                2.0 * (inertia.deck * cos * cos + inertia.diameter),
                6.0 * inertia.deck * sin * cos,
                2.0 * (inertia.deck * (sin * sin - cos * cos) - inertia.diameter + inertia.axis),
                -4.0 * inertia.deck * sin * cos,
            ],
        };
        let mut watched: Vec<(f64, EventKind)> = columns
            .events()
            .into_iter()
            .filter(|event| !matches!(event.event, EventKind::Uplift))
            .map(|event| (event.state.rotation_rad, event.event))
            .collect();
        watched.reverse();
        let stops = columns.restrainer().is_some_and(|restrainer| restrainer.limit_m().is_some());
        Self {
            p: frame.frequency_parameter_rad_s(),
            tangent: sin / cos,
            prestress: frame.prestress_ratio(),
            kappa: ((inertia.deck * cos * cos + inertia.diameter) / inertia.tilt).sqrt(),
            rules,
            branches: branches(frame),
            branch: 0,
            stop_rad: if stops { columns.last_rotation_rad() } else { f64::INFINITY },
            frame: frame.clone(),
            constants,
            lean,
            x: 0.0,
            v: 0.0,
            resting: true,
            peaks: Peaks::default(),
            uplift_s: None,
            impacts: 0,
            rests: 0,
            was_cut: false,
            watched,
            events: Vec::new(),
            observer,
        }
    }

    /// Tilts the frame and lets it go with a velocity (rad/s).
    pub(crate) fn release(&mut self, rotation_rad: f64, velocity_rad_s: f64) {
        (self.x, self.v) = (rotation_rad, velocity_rad_s);
        self.resting = rotation_rad == 0.0 && velocity_rad_s == 0.0;
        self.branch = self.branch_at(rotation_rad, velocity_rad_s);
        self.raise_peaks(rotation_rad, 0.0, 0.0, None);
        while let Some((_, event)) = self.watched.pop_if(|(rad, _)| *rad <= rotation_rad) {
            self.events.push((event, 0.0));
        }
    }

    /// The branch that holds at a rotation, towards the velocity where one begins there.
    fn branch_at(&self, x: f64, v: f64) -> usize {
        let holds = |branch: &Branch| branch.from_rad < x || (branch.from_rad == x && (v > 0.0 || x == 0.0));
        self.branches.iter().rposition(holds).unwrap_or(0)
    }

    pub(crate) fn gravity_m_s2(&self) -> f64 {
        self.frame.gravity_m_s2()
    }

    fn momentum(&self) -> f64 {
        match self.lean {
            Lean::Plane { .. } => 0.0,
            Lean::Space(turning) => turning.momentum,
        }
    }

    /// The largest rotation of free motion from now on, rad; none if the frame overturns.
    pub(crate) fn largest_rotation_to_come(&self) -> Option<f64> {
        let (momentum, restitution) = (self.momentum(), self.rules.restitution);
        self.frame.largest_rotation_to_come(Free { rotation: self.x, velocity: self.v, momentum, restitution })
    }

    /// Moves through a segment of `length_s` that begins at `start_s`; `shaking` gives the components x, y, z in units of
    /// g from an offset in the segment on, in powers of (time − offset)/step. With `until_peak` it ends early, when `θ`
    /// has passed a maximum.
    pub(crate) fn advance(
        &mut self,
        start_s: f64,
        length_s: f64,
        until_peak: bool,
        shaking: impl Fn(f64, f64) -> [Forcing; 3],
    ) -> Flow<()> {
        self.check_weight(start_s, length_s, &shaking(0.0, length_s)[2])?;
        let impacts_before = self.impacts;
        let (mut offset, mut steps) = (0.0, 0_u64);
        let mut just_uplifted = false;
        while offset < length_s {
            let mut at_threshold = false;
            if self.resting {
                let remaining = length_s - offset;
                let Some(s) = self.find_uplift(&shaking(offset, remaining)) else { break };
                at_threshold = s > 0.0;
                offset += s * remaining;
                if offset >= length_s {
                    break; // at the very end: the next segment finds it
                }
                self.branch = 0;
                just_uplifted = true;
            }
            steps += 1;
            if steps > MOST_STEPS {
                return Err(FrameError::Rattles { time_s: start_s + offset, rotation_rad: self.x, steps });
            }

            let mut step_s = (length_s - offset).min(LONGEST_STEP / self.p).min(self.apex_step_s());
            let mut shaken = self.shaken(shaking(offset, step_s));
            if !just_uplifted && self.rests(&shaken, step_s) {
                self.come_to_rest(start_s + offset);
                continue;
            }
            if let Lean::Plane { .. } = self.lean
                && self.x == 0.0
                && self.v > 0.0
            {
                // a rebound is over in 2v over the acceleration that draws it down, if that stays
                let [along, lift] = [&shaken.horizontal[0], &shaken.vertical].map(|forcing| forcing.value(0.0));
                let down = self.p * self.p * self.constants.cos_alpha * (self.tangent * (1.0 + lift) + along);
                let rebound_s = 2.5 * self.v / down;
                if down > 0.0 && rebound_s < step_s {
                    shaken = shaken.stretched(rebound_s / step_s);
                    step_s = rebound_s;
                }
            }
            let step = self.expand(&shaken, step_s, at_threshold);
            if self.resting {
                if let Lean::Plane { .. } = self.lean
                    && leading_sign(step.x().iter()) <= 0.0
                {
                    // shaking above the threshold by a rounding only
                    offset += 1e-9 * length_s;
                    continue;
                }
                self.resting = false;
                self.uplift_s.get_or_insert(start_s + offset);
                self.observe(start_s + offset, Moment::Uplift, &shaken);
            } else if leading_sign(step.x().iter()) <= 0.0 {
                self.come_to_rest(start_s + offset);
                offset += 1e-9 * length_s;
                continue;
            }
            just_uplifted = false;

            let begin = offset;
            offset = if step.length_s >= length_s - begin { length_s } else { begin + step.length_s };
            let time_s = |s: f64| start_s + (begin + s * step.length_s);
            let cut = match self.step(&step, &shaken.stretched(step.length_s / step_s), time_s, until_peak)? {
                ControlFlow::Break(ending) => return Ok(ControlFlow::Break(ending)),
                ControlFlow::Continue(cut) => cut,
            };
            if let Some(s) = cut {
                offset = begin + s * step.length_s;
                if self.impacts - impacts_before >= u64::from(MOST_IMPACTS) && !self.resting {
                    self.was_cut = true;
                    self.come_to_rest(start_s + offset);
                    break;
                }
            }
            if let Some(passing_s) = self.pass_apex() {
                offset += passing_s;
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Refuses ground that falls away under the frame.
    fn check_weight(&self, start_s: f64, length_s: f64, vertical: &Forcing) -> Result<(), FrameError> {
        if vertical.bound() < 1.0 {
            return Ok(());
        }
        let weight = vertical.beginning_at(1.0 + vertical.value(0.0));
        let lifted = if weight.value(0.0) <= 0.0 { Some(0.0) } else { first_zero(weight.coefficients()) };
        let Some(s) = lifted else { return Ok(()) };
        let acceleration_m_s2 = self.frame.gravity_m_s2() * vertical.value(s);
        Err(FrameError::Airborne { time_s: start_s + s * length_s, acceleration_m_s2 })
    }

    /// First s in [0, 1) at which the frame uplifts: sets it upon its corners there.
    fn find_uplift(&mut self, [x, y, z]: &[Forcing; 3]) -> Option<f64> {
        let threshold = z.times(self.tangent).plus(&Forcing::none().beginning_at(self.tangent + self.prestress));
        (self.x, self.v) = (0.0, 0.0);
        match &mut self.lean {
            Lean::Plane { direction, side } => {
                let along = x.times(direction[0]).plus(&y.times(direction[1]));
                let Uplift { s, towards } = uplift_in_plane(&along, &threshold)?;
                *side = towards[0];
                Some(s)
            }
            Lean::Space(turning) => {
                let Uplift { s, towards } = uplift_in_space([x, y], &threshold)?;
                *turning = Turning { direction: towards[1].atan2(towards[0]), momentum: 0.0 };
                self.x = self.rules.start_rotation_rad;
                Some(s)
            }
        }
    }

    /// The shaking as the recurrence takes it.
    fn shaken(&self, [x, y, z]: [Forcing; 3]) -> Shaken {
        let horizontal = match self.lean {
            Lean::Plane { direction, side } => {
                [x.times(side * direction[0]).plus(&y.times(side * direction[1])), Forcing::none()]
            }
            Lean::Space(_) => [x, y],
        };
        Shaken { horizontal, vertical: z }
    }

    /// Part of the radius of convergence near the apex, s.
    fn apex_step_s(&self) -> f64 {
        match self.lean {
            Lean::Plane { .. } => f64::INFINITY,
            Lean::Space(turning) => {
                let across = self.kappa * self.x * turning.momentum / self.turning_inertia();
                APEX_STEP * self.x / self.v.hypot(across)
            }
        }
    }

    fn turning_inertia(&self) -> f64 {
        let half = (0.5 * self.x).sin();
        let (sine, versine) = (self.x.sin(), 2.0 * half * half);
        let [j1, j2, j3] = self.constants.turning;
        versine * (j1 + j2 * sine + j3 * versine)
    }

    fn expand(&self, shaken: &Shaken, step_s: f64, balanced: bool) -> Step {
        let turning = match self.lean {
            Lean::Plane { .. } => None,
            Lean::Space(turning) => Some(turning),
        };
        let held = self.branches.get(self.branch).map(|branch| (branch, self.frame.columns()));
        let balanced = balanced && turning.is_none();
        let expand = |shaken: &Shaken, step_s: f64| {
            Step::expand(&self.constants, (self.x, self.v), turning, shaken, held, step_s, balanced)
        };
        let mut step = expand(shaken, step_s);
        let mut ratio = 1.0;
        while !step.is_finite() && ratio > 1e-12 {
            ratio *= 1e-3;
            step = expand(&shaken.stretched(ratio), ratio * step_s);
        }
        step
    }

    /// Whether the frame rests from here on.
    fn rests(&self, shaken: &Shaken, step_s: f64) -> bool {
        let lift = shaken.vertical.value(0.0);
        if self.rules.rest_amplitude_rad > 0.0 {
            let amplitude = self.rules.rest_amplitude_rad;
            if self.x > 1.1 * amplitude {
                return false;
            }
            let [x, y] = [&shaken.horizontal[0], &shaken.horizontal[1]].map(|forcing| forcing.value(0.0));
            let turning = match self.momentum() {
                0.0 => 0.0,
                momentum => 0.5 * momentum * momentum / self.turning_inertia(),
            };
            let energy = 0.5 * self.constants.tilt_inertia * self.v * self.v + turning + self.frame.potential(self.x);
            return x.hypot(y) <= self.tangent * (1.0 + lift) + self.prestress
                && energy < self.constants.fall * self.constants.sin_alpha * amplitude;
        }
        let Lean::Plane { .. } = self.lean else { return false };
        let rebound = Rebound {
            p_squared: self.p * self.p,
            tangent: self.tangent,
            cosine: self.constants.cos_alpha,
            restitution: self.rules.restitution,
            velocity: self.v,
            peak: self.peaks.rotation.value,
        };
        self.x == 0.0 && self.v > 0.0 && rebound.is_over_within(step_s, &shaken.horizontal[0], &shaken.vertical)
    }

    /// Goes through one step, up to what cuts it if anything does: then the answer is where.
    fn step(
        &mut self,
        step: &Step,
        shaken: &Shaken,
        time_s: impl Fn(f64) -> f64,
        until_peak: bool,
    ) -> Flow<Option<f64>> {
        let was_rising = self.v >= 0.0;
        let x = step.x();
        let spread: f64 = x[1..].iter().map(|x| x.abs()).sum();
        let reach = x[0] + spread;
        let (mut end, mut cut) = (1.0, None);
        let mut earliest = |found: Option<f64>, kind: Cut| {
            if let Some(s) = found.filter(|s| *s < end || cut.is_none()) {
                (end, cut) = (s, Some(kind));
            }
        };
        let lower = self.branches.get(self.branch).map_or(0.0, |branch| branch.from_rad);
        let upper = self.branches.get(self.branch + 1).map_or(f64::INFINITY, |branch| branch.from_rad);
        if reach >= upper {
            earliest(first_reach(x, upper), Cut::Upper);
        }
        if lower > 0.0 && x[0] - spread <= lower {
            earliest(first_fall(x, lower), Cut::Lower);
        }
        if lower == 0.0 && matches!(self.lean, Lean::Plane { .. }) && x[0] <= spread {
            earliest(first_zero(x), Cut::Impact);
        }
        if reach >= LYING_RAD {
            earliest(first_reach(x, LYING_RAD), Cut::Lying);
        }
        if reach >= self.stop_rad {
            earliest(first_reach(x, self.stop_rad), Cut::Stop);
        }
        if self.v > 0.0 && self.branches.get(self.branch).is_some_and(|branch| branch.yields) {
            earliest(first_zero(step.v()), Cut::TurnsBack);
        }

        self.watch(step, reach, end, &time_s);
        self.follow_peaks(step, (reach, spread), end, &time_s);
        if !matches!(cut, Some(Cut::Impact)) {
            for s in [0.0, 0.5 * end] {
                self.follow_deck(step, shaken, s, time_s(s));
            }
        }

        let (x, v) = step.at(end);
        let is_upright = matches!(cut, Some(Cut::Impact)) || (x <= 0.0 && matches!(self.lean, Lean::Plane { .. }));
        if is_upright {
            if until_peak && was_rising {
                return Ok(ControlFlow::Break(Ending::PeakPassed));
            }
            self.impact(v, time_s(end), shaken);
            return Ok(ControlFlow::Continue(Some(end)));
        }
        (self.x, self.v) = (x, v);
        if let Lean::Space(turning) = &mut self.lean {
            *turning = step.turning_at(end);
        }
        match cut {
            Some(Cut::Upper) => (self.x, self.branch) = (upper, self.branch + 1),
            Some(Cut::Lower) => (self.x, self.branch) = (lower, self.branch - 1),
            Some(Cut::Lying) => {
                self.x = LYING_RAD;
                return Ok(ControlFlow::Break(self.overturn(time_s(end))));
            }
            Some(Cut::Stop) => {
                return Err(FrameError::SpringsStop { time_s: time_s(end), rotation_rad: self.stop_rad });
            }
            Some(Cut::TurnsBack) => {
                self.v = 0.0;
                self.turn_back_after_yielding()?;
            }
            Some(Cut::Impact) | None => {}
        }
        self.raise_peaks(self.x, time_s(end), end, Some(step));
        if until_peak && was_rising && self.v <= 0.0 {
            return Ok(ControlFlow::Break(Ending::PeakPassed));
        }
        Ok(ControlFlow::Continue(cut.map(|_| end)))
    }

    /// The stoppers have yielded and unload: from now on they engage later, by the plastic part.
    fn turn_back_after_yielding(&mut self) -> Result<(), FrameError> {
        let columns = self.frame.columns();
        let (path, restrained) = (columns.path(), columns.restrained());
        let elongation_m = columns.elongation(self.x).elongation_m;
        let Some(restrainer) = columns.restrainer() else { return Ok(()) };
        let Some(deformation_m) = restrainer.at(elongation_m)?.deformation_m else { return Ok(()) };
        let unloading = restrainer.after_yielding(deformation_m)?;
        self.frame = self.frame.clone().with_restrainer(unloading, path)?.with_restrained(restrained)?;
        self.branches = branches(&self.frame);
        // they stand at their new yield point, to rounding: below it
        if let Some(index) = self.branches.iter().position(|branch| branch.yields) {
            self.x = self.x.min(self.branches[index].from_rad);
            self.branch = index.saturating_sub(1);
        } else {
            self.branch = self.branch_at(self.x, -1.0);
        }
        Ok(())
    }

    /// Tells of the events that the step passes for the first time.
    fn watch(&mut self, step: &Step, reach: f64, end: f64, time_s: impl Fn(f64) -> f64) {
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
    fn follow_peaks(&mut self, step: &Step, (reach, spread): (f64, f64), end: f64, time_s: impl Fn(f64) -> f64) {
        let v = step.v();
        let wobbles = matches!(self.lean, Lean::Space(_));
        let may_turn = v[0].abs() <= v[1..].iter().map(|v| v.abs()).sum();
        if reach > self.peaks.rotation.value || (wobbles && may_turn) {
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

    fn direction_at(&self, step: Option<&Step>, s: f64) -> f64 {
        match (self.lean, step) {
            (Lean::Plane { direction, side }, _) => (side * direction[1]).atan2(side * direction[0]),
            (Lean::Space(_), Some(step)) => step.turning_at(s).direction,
            (Lean::Space(turning), None) => turning.direction,
        }
    }

    fn raise_peaks(&mut self, x: f64, time_s: f64, s: f64, step: Option<&Step>) {
        if x > self.peaks.rotation.value {
            self.peaks.rotation.raise(x, time_s);
            self.peaks.direction_rad = self.direction_at(step, s);
        }
        if matches!(self.lean, Lean::Space(_)) {
            let travel = self.travel_at(x);
            let (sin, cos) = self.direction_at(step, s).sin_cos();
            self.peaks.travel[0].raise((travel * cos).abs(), time_s);
            self.peaks.travel[1].raise((travel * sin).abs(), time_s);
        }
    }

    /// Total acceleration of deck and base shear at s of a step.
    fn follow_deck(&mut self, step: &Step, shaken: &Shaken, s: f64, time_s: f64) {
        let (x, v) = step.at(s);
        let (turning, change) = step.turning_rate(s);
        let direction = self.direction_at(Some(step), s);
        let own = self.deck_acceleration(x, v, step.acceleration(s), (turning, change), direction);
        let ground = self.ground(shaken, s);
        self.raise_deck(own, ground, time_s);
    }

    fn raise_deck(&mut self, own: [f64; 2], ground: [f64; 2], time_s: f64) {
        self.peaks.deck.raise((own[0] + ground[0]).hypot(own[1] + ground[1]), time_s);
        let deck_kg = self.frame.deck_mass_kg();
        let columns_kg = f64::from(self.frame.columns().columns()) * self.frame.column_mass_kg();
        // the middle of a column travels half as far as the deck
        let force = [0, 1].map(|i| deck_kg * (own[i] + ground[i]) + columns_kg * (0.5 * own[i] + ground[i]));
        self.peaks.reaction.raise(force[0].hypot(force[1]), time_s);
    }

    /// Acceleration of the deck relative to the ground in x and y, m/s².
    fn deck_acceleration(&self, x: f64, v: f64, a: f64, (turning, change): (f64, f64), direction: f64) -> [f64; 2] {
        let diagonal_m = 2.0 * self.frame.geometry().size_m();
        let (sin, cos) = (self.frame.geometry().slenderness_rad() - x).sin_cos();
        let (travel, slope, curvature) = (diagonal_m * self.travel_at(x), diagonal_m * cos, diagonal_m * sin);
        let radial = curvature * v * v + slope * a - travel * turning * turning;
        let across = travel * change + 2.0 * slope * v * turning;
        let (sin, cos) = direction.sin_cos();
        [radial * cos - across * sin, radial * sin + across * cos]
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

    /// A frame at rest moves with the ground, as long as that does not lift it.
    pub(crate) fn follow_ground(&mut self, components: &[Forcing; 3], s: f64, time_s: f64) {
        let ground = self.ground(&self.shaken(*components), s);
        let threshold = self.tangent * (1.0 + components[2].value(s)) + self.prestress;
        if ground[0].hypot(ground[1]) > threshold * self.frame.gravity_m_s2() {
            return;
        }
        self.raise_deck([0.0; 2], ground, time_s);
    }

    /// A frame in a plane hits the ground with the velocity `v` ≤ 0 and stands on its other corners (Eq. 6.5).
    fn impact(&mut self, v: f64, time_s: f64, shaken: &Shaken) {
        (self.x, self.v) = (0.0, v.min(0.0)); // above zero by a rounding at most
        if let Lean::Plane { side, .. } = &mut self.lean {
            *side = -*side;
        }
        self.v *= -self.rules.restitution;
        self.impacts += 1;
        self.branch = 0;
        self.observe(time_s, Moment::Impact, shaken);
        if self.v == 0.0 {
            self.come_to_rest(time_s);
        }
    }

    /// Passes the apex along a straight line in the developed cone; how long that takes, s.
    fn pass_apex(&mut self) -> Option<f64> {
        let Lean::Space(turning) = self.lean else { return None };
        let deflection = self.p * self.p * self.constants.sin_alpha * self.x;
        if self.x > APEX_RAD || self.v >= 0.0 || deflection > APEX_DEFLECTION * self.v * self.v {
            return None;
        }
        let across = if turning.momentum == 0.0 { 0.0 } else { self.x * turning.momentum / self.turning_inertia() };
        let speed = self.v.abs();
        let passing_s = 2.0 * self.x * speed / (speed * speed + (self.kappa * across).powi(2));
        let turn = if turning.momentum == 0.0 {
            self.v *= self.rules.restitution;
            std::f64::consts::PI
        } else {
            turning.momentum.signum() * 2.0 * speed.atan2(self.kappa * across.abs()) / self.kappa
        };
        self.v = -self.v;
        self.lean = Lean::Space(Turning { direction: turning.direction + turn, ..turning });
        self.impacts += 1;
        Some(passing_s)
    }

    pub(crate) fn overturn(&mut self, time_s: f64) -> Ending {
        self.peaks.rotation.raise(f64::INFINITY, time_s);
        self.observe(time_s, Moment::Overturned, &Shaken::none());
        Ending::Overturned
    }

    fn come_to_rest(&mut self, time_s: f64) {
        (self.x, self.v, self.resting) = (0.0, 0.0, true);
        if let Lean::Space(turning) = &mut self.lean {
            turning.momentum = 0.0;
        }
        self.rests += 1;
        self.observe(time_s, Moment::Rest, &Shaken::none());
    }

    /// `φ̇`, rad/s.
    pub(crate) fn turning_rad_s(&self) -> f64 {
        match self.momentum() {
            0.0 => 0.0,
            momentum => momentum / self.turning_inertia(),
        }
    }

    /// Tells the observer of the present state under the shaking `components`.
    pub(crate) fn observe_sample(&mut self, time_s: f64, components: &[Forcing; 3]) {
        if O::KEEPS {
            let shaken = self.shaken(*components);
            self.observe(time_s, Moment::Sample, &shaken);
        }
    }

    fn observe(&mut self, time_s: f64, moment: Moment, shaken: &Shaken) {
        if !O::KEEPS {
            return;
        }
        let direction = self.direction_at(None, 0.0);
        let ground = self.ground(shaken, 0.0);
        let mut own = [0.0; 2];
        if !self.resting && self.x > 0.0 {
            let still = shaken.stretched(0.0);
            let step = self.expand(&still, 1e-9 / self.p, false);
            let (a, rate) = (step.acceleration(0.0), step.turning_rate(0.0));
            own = self.deck_acceleration(self.x, self.v, a, rate, direction);
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
            moment,
        });
    }
}

/// What ends a step before its time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cut {
    Upper,
    Lower,
    Impact,
    Lying,
    Stop,
    TurnsBack,
}

/// First s in (0, 1) at which a rotation that begins at or below `level` rises to it.
fn first_reach(x: &[f64], level: f64) -> Option<f64> {
    let mut below = [0.0; DEGREE + 1];
    for (below, x) in below.iter_mut().zip(x) {
        *below = -x;
    }
    below[0] += level;
    let below = &below[..x.len()];
    if below[0] < 0.0 { Some(0.0) } else { first_zero_from_above(below) }
}

/// First s in (0, 1) at which a rotation that begins at or above `level` falls to it.
fn first_fall(x: &[f64], level: f64) -> Option<f64> {
    let mut above = [0.0; DEGREE + 1];
    above[..x.len()].copy_from_slice(x);
    above[0] -= level;
    first_zero_from_above(&above[..x.len()])
}

/// As [`first_zero`]; at once, if the function begins at zero and falls.
fn first_zero_from_above(c: &[f64]) -> Option<f64> {
    if leading_sign(c.iter()) < 0.0 { Some(0.0) } else { first_zero(c) }
}
