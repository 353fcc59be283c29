//! The motion itself: rest, uplift, rocking or wobbling, impacts or passages by the apex, segment by segment of the
//! shaking.

use std::ops::ControlFlow;

use uplift_statics::{EventKind, RestrainedColumns};
use uplift_taylor::Rebound;

mod follow;
mod segment;
mod step;

pub(crate) use segment::{Asked, LONGEST_STEP, Segment};

use crate::branch::{Branch, branches};
use crate::error::FrameError;
use crate::escape::Free;
use crate::frame::RockingFrame;
use crate::ground::length;
use crate::history::{Moment, Observer};
use crate::peaks::Peaks;
use crate::rolling::Rolling;
use crate::series::{Begin, Constants, Expansion, Shaken, Turning};

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
    /// `2R`, m.
    diagonal_m: f64,
    /// `κ = √(c/M)`, `J → c θ²`.
    kappa: f64,
    rolling: Rolling,
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
        let kappa = ((inertia.deck * cos * cos + inertia.diameter) / inertia.tilt).sqrt();
        let rolling = Rolling::new(kappa, rules.restitution);
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
            drag: 2.0 * rolling.loss,
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
            diagonal_m: 2.0 * geometry.size_m(),
            kappa,
            rolling,
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

    pub(crate) fn constants(&self) -> &Constants {
        &self.constants
    }

    /// `p`, rad/s.
    pub(crate) fn frequency_parameter_rad_s(&self) -> f64 {
        self.p
    }

    pub(crate) fn gravity_m_s2(&self) -> f64 {
        self.frame.gravity_m_s2()
    }

    /// Whether a frame at rest stays so while horizontal acceleration is no larger, and vertical no more downwards,
    /// than these bounds in units of g.
    pub(crate) fn stays_at_rest(&self, horizontal: f64, downwards: f64) -> bool {
        downwards < 1.0 && horizontal < self.tangent * (1.0 - downwards) + self.prestress
    }

    fn momentum(&self) -> f64 {
        match self.lean {
            Lean::Plane { .. } => 0.0,
            Lean::Space(turning) => turning.momentum,
        }
    }

    /// Whether free motion is known to go beyond the last rotation from which it comes back. The energy that a turning
    /// frame still loses may yet hold it: then the motion itself tells.
    pub(crate) fn is_lost(&self) -> bool {
        let loses = matches!(self.lean, Lean::Space(_)) && self.constants.drag > 0.0;
        !loses && self.largest_rotation_to_come().is_none()
    }

    /// The largest rotation of free motion from now on, rad; none if the frame overturns.
    fn largest_rotation_to_come(&self) -> Option<f64> {
        let (momentum, restitution) = (self.momentum(), self.rules.restitution);
        self.frame.largest_rotation_to_come(Free { rotation: self.x, velocity: self.v, momentum, restitution })
    }

    fn turning_inertia(&self) -> f64 {
        let half = (0.5 * self.x).sin();
        let (sine, versine) = (self.x.sin(), 2.0 * half * half);
        let [j1, j2, j3] = self.constants.turning;
        versine * (j1 + j2 * sine + j3 * versine)
    }

    /// The law of the restrainers that holds now.
    fn held(&self) -> Option<(&Branch, &RestrainedColumns)> {
        self.branches.get(self.branch).map(|branch| (branch, self.frame.columns()))
    }

    /// A step from the present state, if it can be expanded together with others.
    pub(crate) fn begin<const WOBBLES: bool>(&self, shaken: &Shaken, asked: &Asked) -> Option<Begin> {
        let turning = match self.lean {
            Lean::Space(turning) if WOBBLES => Some(turning),
            Lean::Plane { .. } if !WOBBLES && !asked.at_threshold => None,
            _ => return None,
        };
        let pull = self.held().map_or(Some([0.0; 2]), |(branch, _)| branch.multiples())?;
        Begin::new((self.x, self.v), turning, shaken, pull, asked.step_s)
    }

    /// Expands a step from the present state, as far as its coefficients are numbers.
    pub(crate) fn expand(&self, expansion: &mut Expansion, shaken: &Shaken, step_s: f64, balanced: bool) {
        let turning = match self.lean {
            Lean::Plane { .. } => None,
            Lean::Space(turning) => Some(turning),
        };
        let held = self.held();
        let balanced = balanced && turning.is_none();
        let mut expand = |shaken: &Shaken, step_s: f64| {
            expansion.expand(&self.constants, (self.x, self.v), turning, shaken, held, step_s, balanced);
            expansion.step().is_finite()
        };
        let mut ratio = 1.0;
        let mut is_finite = expand(shaken, step_s);
        while !is_finite && ratio > 1e-12 {
            ratio *= 1e-3;
            is_finite = expand(&shaken.stretched(ratio), ratio * step_s);
        }
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
            return length([x, y]) <= self.tangent * (1.0 + lift) + self.prestress
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
}
