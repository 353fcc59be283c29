//! The response of a frame to the ground's motion.

use uplift_instructions::Instructions;
use uplift_statics::EventKind;
use uplift_statics::tilt::travel_m;

use crate::course::Course;
use crate::error::{FrameError, within};
use crate::escape::LYING_RAD;
use crate::frame::{ColumnShape, RockingFrame};
use crate::ground::GroundMotion;
use crate::history::{History, Moment, Observer, Unobserved};
use crate::motion::{Ending, Lean, Motion, Rules};
use crate::peaks::Peak;
use crate::rolling::LEAST_RESTITUTION;
use crate::series::{Expansion, Turning};

/// Longest motion computed, in units of 1/p.
const LONGEST_MOTION: f64 = 1e7;

/// Amplitude of rest of the wobbling model that is used where none is given, rad: 0.015 mm of the frame on the table.
const REST_AMPLITUDE_RAD: f64 = 1e-5;

/// Which model of the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Rocking in the plane of x, under the component x and the vertical one (Eq. 6.3, 6.5).
    Planar,
    /// Wobbling in any direction, under all components (Eq. 6.6, 6.7).
    Wobbling,
}

/// State from which a motion begins, at time zero.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Start {
    /// Rest.
    #[default]
    Rest,
    /// Tilted, and let go.
    Tilted(FrameState),
}

/// A state of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct FrameState {
    /// Rotation `θ`, rad; in a plane with a sign.
    pub rotation_rad: f64,
    /// Direction `φ` of the lean, rad; of the planar model 0.
    pub direction_rad: f64,
    /// `θ̇`, rad/s.
    pub velocity_rad_s: f64,
    /// `φ̇`, rad/s.
    pub turning_rad_s: f64,
}

/// How long a motion is followed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Until {
    /// Through the shaking and, after it, to the first peak of free motion, beyond which none is larger; whether the
    /// frame survives is then a root of its energy.
    #[default]
    FirstFreePeak,
    /// To a time (s), whether the ground still moves or not.
    Time(f64),
}

/// What is asked of a response beside frame, ground and model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Where it begins.
    pub start: Start,
    /// How long it is followed.
    pub until: Until,
    /// Ratio of velocities after to before an impact; of the wobbling model, of those far from the upright after and
    /// before a passage close by it ([`crate::rolling`]). If none, by the balance of momentum in the planar model
    /// ([`RockingFrame::momentum_restitution`]), and 1 in the wobbling one, which then loses nothing.
    pub restitution: Option<f64>,
    /// A frame whose energy is below that of this rotation rests if the ground does not lift it, rad. If none, 1e-5 in
    /// the wobbling model, 0 in the planar one: there rest is proved.
    pub rest_amplitude_rad: Option<f64>,
    /// Tilt with which a wobbling frame leaves the ground, rad: the result converges as it goes to zero.
    pub start_rotation_rad: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            start: Start::Rest,
            until: Until::FirstFreePeak,
            restitution: None,
            rest_amplitude_rad: None,
            start_rotation_rad: 1e-12,
        }
    }
}

/// Something that happens to the restrainers on the way.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct FrameEvent {
    /// What.
    pub event: EventKind,
    /// When first, s.
    pub time_s: f64,
}

/// Response of a frame. Of one that overturns, rotations, displacements, forces and deformations of restrainers are +∞;
/// accelerations and base shear are the largest up to then.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct FrameResponse {
    /// Whether it overturns.
    pub overturned: bool,
    /// Largest rotation `θ`, rad.
    pub rotation: Peak,
    /// Largest travel `U` of the deck, m.
    pub displacement: Peak,
    /// Largest `|U_x|`, m: until the shaking ends and `U` has passed its first peak after it.
    pub displacement_x: Peak,
    /// Largest `|U_y|`, m.
    pub displacement_y: Peak,
    /// Direction of the lean at the largest rotation, rad.
    pub direction_at_peak_rad: f64,
    /// Largest force of a restrainer, N; none without.
    pub tendon_n: Option<f64>,
    /// Largest deformation of its springs, m; none without springs of their own.
    pub spring_m: Option<f64>,
    /// Largest total acceleration of the deck, m/s²: of the beginnings and middles of all steps.
    pub deck_acceleration: Peak,
    /// Largest base shear `m_b |a|` of the deck alone (Eq. 6.10), N.
    pub base_shear_n: f64,
    /// Largest horizontal reaction, N: the columns' inertia counted too.
    pub base_reaction_n: f64,
    /// When the frame first uplifts, s; none if it never does, or was let go from a tilt.
    pub uplift_s: Option<f64>,
    /// Impacts of the planar model; exact passages through the apex of the wobbling one.
    pub impacts: u64,
    /// How often it came to rest.
    pub rests: u64,
    /// Least rotation between two peaks, rad: how close a wobbling frame came to upright.
    pub least_rotation_rad: Option<f64>,
    /// What happened to the restrainers, in the order of time.
    pub events: Vec<FrameEvent>,
    /// The last state that was computed.
    pub end: FrameState,
    /// Whether a frame that bounced 100,000 times between two samples was put to rest.
    pub chatter_was_cut: bool,
}

/// Response of `frame`, to `ground` (m/s²), by `model`.
///
/// The frame overturns if its columns lie while the ground moves, `θ = π/2`, or if with the ground at rest its energy
/// says that it will not come back.
///
/// # Errors
/// [`FrameError::RectangleWobbles`]; [`FrameError::Airborne`] where the ground falls as fast as gravity;
/// [`FrameError::SpringsStop`] where flat springs stop the columns; [`FrameError::Rattles`] where a frame that loses
/// nothing does not come to an end; numbers out of range.
///
/// # Source
/// Reggiani Manzo, Section 6.2, Eq. 6.3, 6.5–6.8, 6.10.
pub fn respond(
    frame: &RockingFrame,
    ground: &GroundMotion<'_>,
    model: Model,
    options: &Options,
) -> Result<FrameResponse, FrameError> {
    run(frame, ground, model, options, Unobserved::<true>).map(|(response, _)| response)
}

/// What a fragility needs of a response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameDemand {
    /// Largest travel `U` of the deck, m; +∞ of a frame that overturns.
    pub displacement_m: f64,
    /// Impacts of the planar model; exact passages through the apex of the wobbling one.
    pub impacts: u64,
}

/// The demand of a motion that has ended.
pub(crate) fn demand_of<O: Observer>(frame: &RockingFrame, motion: &Motion<O>, ending: Option<Ending>) -> FrameDemand {
    let overturned = ending == Some(Ending::Overturned);
    let travel_m = travel_m(frame.geometry(), motion.peaks.rotation.value);
    FrameDemand { displacement_m: if overturned { f64::INFINITY } else { travel_m }, impacts: motion.impacts }
}

/// The same, with the motion in time: a row at every sample (sixteenth of a pulse's period, 0.5/p of free motion),
/// uplift, impact and rest.
///
/// # Errors
/// As [`respond`].
pub fn respond_with_history(
    frame: &RockingFrame,
    ground: &GroundMotion<'_>,
    model: Model,
    options: &Options,
) -> Result<(FrameResponse, History), FrameError> {
    run(frame, ground, model, options, History::default())
}

fn run<O: Observer>(
    frame: &RockingFrame,
    ground: &GroundMotion<'_>,
    model: Model,
    options: &Options,
    observer: O,
) -> Result<(FrameResponse, O), FrameError> {
    let mut course = course(frame, ground, model, options, observer)?;
    let ending = course.run(&mut Expansion::new(Instructions::chosen()))?;
    Ok(report(frame, course.motion, ending))
}

/// A motion at its begin.
pub(crate) fn course<'a, O: Observer>(
    frame: &RockingFrame,
    ground: &GroundMotion<'a>,
    model: Model,
    options: &Options,
    observer: O,
) -> Result<Course<'a, O>, FrameError> {
    if model == Model::Wobbling && frame.shape() == ColumnShape::Rectangle {
        return Err(FrameError::RectangleWobbles);
    }
    ground.check()?;
    let rules = rules(frame, model, options)?;
    let asked_s = match options.until {
        Until::FirstFreePeak => ground.duration_s(),
        Until::Time(time_s) => within("duration", time_s, "s", 0.0..=f64::MAX, "finite and not negative")?,
    };
    let p = frame.frequency_parameter_rad_s();
    let ratio = asked_s * p;
    if !(ratio <= LONGEST_MOTION) {
        return Err(FrameError::TooLong { duration_s: asked_s, time_s: 1.0 / p, ratio, most: LONGEST_MOTION });
    }
    // the planar model does not know the second component
    let seen = match model {
        Model::Planar => GroundMotion { y: None, ..*ground },
        Model::Wobbling => *ground,
    };
    let (lean, rotation, velocity) = begin(frame, &seen, model, options.start)?;
    let mut motion = Motion::new(frame, lean, rules, observer);
    if let Start::Tilted(_) = options.start {
        motion.release(rotation, velocity);
    }
    Ok(Course::new(motion, seen, options.until))
}

fn rules(frame: &RockingFrame, model: Model, options: &Options) -> Result<Rules, FrameError> {
    let (restitution, rest_amplitude_rad) = match model {
        Model::Planar => (frame.momentum_restitution(), 0.0),
        Model::Wobbling => (1.0, REST_AMPLITUDE_RAD),
    };
    let restitution = options.restitution.unwrap_or(restitution);
    let (least, accepted) = match model {
        Model::Planar => (0.0, "between 0 and 1"),
        Model::Wobbling => (LEAST_RESTITUTION, "between 0.1 and 1"),
    };
    let rest = options.rest_amplitude_rad.unwrap_or(rest_amplitude_rad);
    Ok(Rules {
        restitution: within("restitution", restitution, "(pure number)", least..=1.0, accepted)?,
        rest_amplitude_rad: within("amplitude of rest", rest, "rad", 0.0..=0.1, "between 0 and 0.1 rad")?,
        start_rotation_rad: within(
            "tilt at uplift",
            options.start_rotation_rad,
            "rad",
            1e-16..=1e-3,
            "between 1e-16 and 1e-3 rad",
        )?,
    })
}

/// How the frame leans at first, with the size of its rotation and the velocity of that.
fn begin(
    frame: &RockingFrame,
    ground: &GroundMotion<'_>,
    model: Model,
    start: Start,
) -> Result<(Lean, f64, f64), FrameError> {
    let upright = Lean::Space(Turning { direction: 0.0, momentum: 0.0 });
    let Start::Tilted(state) = start else {
        let line = match model {
            Model::Planar => Some([1.0, 0.0]),
            Model::Wobbling => ground.line(),
        };
        let lean = line.map_or(upright, |direction| Lean::Plane { direction, side: 1.0 });
        return Ok((lean, 0.0, 0.0));
    };
    let FrameState { rotation_rad, direction_rad, velocity_rad_s, turning_rad_s } = state;
    within("rotation at the start", rotation_rad, "rad", -LYING_RAD..=LYING_RAD, "between -pi/2 and pi/2 rad")?;
    for (name, value, unit) in [
        ("direction at the start", direction_rad, "rad"),
        ("velocity at the start", velocity_rad_s, "rad/s"),
        ("turning at the start", turning_rad_s, "rad/s"),
    ] {
        within(name, value, unit, -1e6..=1e6, "between -1e6 and 1e6")?;
    }
    let in_plane = |direction: [f64; 2], rotation: f64, velocity: f64| {
        let side = if rotation == 0.0 { 1.0_f64.copysign(velocity) } else { 1.0_f64.copysign(rotation) };
        (Lean::Plane { direction, side }, rotation.abs(), side * velocity)
    };
    if model == Model::Planar {
        return Ok(in_plane([1.0, 0.0], rotation_rad, velocity_rad_s));
    }
    let (sin, cos) = direction_rad.sin_cos();
    let along = ground.line().unwrap_or([cos, sin]);
    let is_aligned = (along[0] * sin - along[1] * cos).abs() <= 4.0 * f64::EPSILON;
    let is_shaken_across = ground.line().is_none() && (ground.x.is_some() || ground.y.is_some());
    if (turning_rad_s == 0.0 || rotation_rad == 0.0) && is_aligned && !is_shaken_across {
        return Ok(in_plane([cos, sin], rotation_rad, velocity_rad_s));
    }
    within(
        "rotation at the start",
        rotation_rad,
        "rad",
        f64::MIN_POSITIVE..=LYING_RAD,
        "above 0 and at most pi/2 rad",
    )?;
    let momentum = frame.turning_inertia(rotation_rad) * turning_rad_s;
    Ok((Lean::Space(Turning { direction: direction_rad, momentum }), rotation_rad, velocity_rad_s))
}

fn report<O: Observer>(frame: &RockingFrame, motion: Motion<O>, ending: Option<Ending>) -> (FrameResponse, O) {
    let overturned = ending == Some(Ending::Overturned);
    let geometry = frame.geometry();
    let peaks = motion.peaks;
    let rotation = peaks.rotation;
    let scaled = |peak: Peak, factor: f64| Peak { value: factor * peak.value, ..peak };
    let everywhere = |value: f64| Peak { value, ..rotation };
    let displacement = everywhere(demand_of(frame, &motion, ending).displacement_m);
    let [displacement_x, displacement_y] = match motion.lean {
        _ if overturned => [displacement; 2],
        Lean::Plane { direction, .. } => direction.map(|component| scaled(displacement, component.abs())),
        Lean::Space(_) => peaks.travel.map(|peak| scaled(peak, 2.0 * geometry.size_m())),
    };
    let columns = frame.columns();
    let held = columns.restrainer().map(|restrainer| {
        if overturned {
            let has_spring = restrainer.at(0.0).is_ok_and(|state| state.deformation_m.is_some());
            return (f64::INFINITY, has_spring.then_some(f64::INFINITY));
        }
        let elongation_m = columns.elongation(rotation.value).elongation_m;
        // a rotation computed at the very end of the law may be beyond it by a rounding
        let elongation_m = restrainer.limit_m().map_or(elongation_m, |limit_m| elongation_m.min(limit_m));
        restrainer.at(elongation_m).map_or((0.0, None), |state| (state.force_n, state.deformation_m))
    });
    let (side, direction_rad) = match motion.lean {
        Lean::Plane { direction, side } => (side, direction[1].atan2(direction[0])),
        Lean::Space(turning) => (1.0, turning.direction),
    };
    let response = FrameResponse {
        overturned,
        rotation,
        displacement,
        displacement_x,
        displacement_y,
        direction_at_peak_rad: peaks.direction_rad,
        tendon_n: held.map(|held| held.0),
        spring_m: held.and_then(|held| held.1),
        deck_acceleration: peaks.deck,
        base_shear_n: frame.deck_mass_kg() * peaks.deck.value,
        base_reaction_n: peaks.reaction.value,
        uplift_s: motion.uplift_s,
        impacts: motion.impacts,
        rests: motion.rests,
        least_rotation_rad: peaks.least,
        events: motion.events.iter().map(|&(event, time_s)| FrameEvent { event, time_s }).collect(),
        end: FrameState {
            rotation_rad: side * motion.x,
            direction_rad,
            velocity_rad_s: side * motion.v,
            turning_rad_s: motion.turning_rad_s(),
        },
        chatter_was_cut: motion.was_cut,
    };
    (response, motion.observer)
}

impl History {
    /// When the frame rests, uplifts, hits the ground or overturns, s, with what.
    pub fn moments(&self) -> impl Iterator<Item = (f64, Moment)> + '_ {
        self.rows.iter().filter(|row| row.moment != Moment::Sample).map(|row| (row.time_s, row.moment))
    }
}
