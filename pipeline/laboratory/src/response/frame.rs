//! A pair of records through a rocking frame: in the plane of each component, or wobbling under both (Chapter 6).

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_frame::{FrameEvent, FrameResponse, GroundMotion, Model, Options, RockingFrame, Until};
use uplift_inputs::{TORSION, model_of, rocking_frame};
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_motion::Accelerogram;
use uplift_plausible::{RESTITUTION, USUAL_RESTITUTION};
use uplift_statics::EventKind;
use uplift_study::Structure;

use super::{FrameHistory, ResponseOptions, ShakingRecord, frame_history};
use crate::error::LaboratoryError;

/// A component, as it shakes the frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShakenComponent {
    /// `h1`, `h2` or `v`.
    pub component: &'static str,
    /// The record.
    #[serde(flatten)]
    pub shaken_by: ShakingRecord,
}

/// What became of the frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameResponseReport {
    /// Name for people.
    #[serde(skip)]
    pub name: String,
    /// The structure file.
    pub structure: PathBuf,
    /// Kind of structure.
    pub kind: &'static str,
    /// The model.
    pub model: Model,
    /// What shook it.
    pub components: Vec<ShakenComponent>,
    /// Number of columns.
    pub columns: u32,
    /// Height 2h of a column, m.
    pub height_m: f64,
    /// Slenderness α, rad.
    pub slenderness_rad: f64,
    /// Mass of the deck, kg.
    pub deck_mass_kg: f64,
    /// Ground acceleration beyond which the frame uplifts, g.
    pub uplift_acceleration_g: f64,
    /// Velocity after over before an impact: of the planar model the option's, else the structure file's, else that of
    /// momentum (Eq. 6.5). Of the wobbling model the option's, else 1, at exact returns to the upright alone: it has
    /// no loss of its own.
    pub restitution: f64,
    /// Where that comes from.
    pub restitution_from: &'static str,
    /// One under each horizontal component in the plane, one under all wobbling.
    pub runs: Vec<FrameRun>,
    /// What the model leaves out, and what is assumed.
    pub notes: Vec<String>,
    /// What to know before using the numbers.
    pub alarms: Vec<Alarm>,
    /// The file that the time history was written to.
    #[serde(skip)]
    pub history_file: Option<PathBuf>,
}

/// The response under one or two horizontal components. Rotations, displacements, forces and deformations of
/// restrainers are infinite, as JSON null, where the frame overturned.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameRun {
    /// `h1`, `h2` or `h1 and h2`.
    pub under: &'static str,
    /// Whether the frame overturned.
    pub overturned: bool,
    /// When it did, or was certain to, s.
    pub time_of_overturning_s: Option<f64>,
    /// Largest rotation θ of the columns, rad.
    pub peak_rotation_rad: f64,
    /// Largest travel U of the deck, m.
    pub peak_displacement_m: f64,
    /// The same over the height of the columns.
    pub peak_drift: f64,
    /// When, s; none where the frame overturned or never uplifted.
    pub time_of_peak_s: Option<f64>,
    /// Direction of the lean then, from h1 towards h2, rad; in a plane from the component.
    pub direction_at_peak_rad: f64,
    /// Largest travel along h1, in a plane along its component, m.
    pub peak_displacement_x_m: f64,
    /// Largest travel along h2, m; 0 in a plane.
    pub peak_displacement_y_m: f64,
    /// Largest force of a restrainer, N; none without.
    pub peak_tendon_n: Option<f64>,
    /// Largest deformation of its springs, m; none without springs of their own.
    pub peak_spring_m: Option<f64>,
    /// Largest total acceleration of the deck, m/s².
    pub peak_deck_acceleration_m_s2: f64,
    /// Largest base shear of the deck alone, N (Eq. 6.10).
    pub peak_base_shear_n: f64,
    /// Largest horizontal reaction with the inertia of the columns, N.
    pub peak_base_reaction_n: f64,
    /// When the frame first uplifts, s; none if it never does.
    pub time_of_uplift_s: Option<f64>,
    /// Impacts in a plane; of a wobbling frame, which hardly ever returns to the upright, exact passages through it.
    pub impacts: u64,
    /// How often it came to rest.
    pub rests: u64,
    /// Least rotation between two peaks, rad: how close a wobbling frame came to the upright.
    pub least_rotation_rad: Option<f64>,
    /// What happened to the restrainers, in the order of time.
    pub events: Vec<FrameEvent>,
    /// Whether a frame that bounced 100,000 times between two samples was put to rest.
    pub chatter_was_cut: bool,
    /// The time history, where it was asked for.
    #[serde(skip)]
    pub history: Option<FrameHistory>,
}

impl FrameResponseReport {
    /// The frame and what shook it, in a line.
    fn line(&self) -> String {
        let records: Vec<String> =
            (self.components.iter()).map(|of| format!("{} {}", of.component, of.shaken_by.record.display())).collect();
        let scale = self.components.first().map_or(1.0, |of| of.shaken_by.scale);
        format!(
            "{}; structure {}, {} model, restitution {}; {}, scale {scale}",
            uplift_job::outputs::mark(),
            self.structure.display(),
            model_word(self.model),
            self.restitution,
            records.join(", ")
        )
    }
}

/// Shakes the frame of the structure file `file`.
pub(super) fn frame_response(file: &Path, options: &ResponseOptions) -> Result<FrameResponseReport, LaboratoryError> {
    if let Some(record) = &options.record {
        let mend = if options.frame.h1.is_some() { "leave out" } else { "write --h1" };
        return Err(JobError::Usage(format!(
            "a structure takes its records by --h1, --h2 and --v: {mend} {}",
            record.display()
        ))
        .into());
    }
    let structure = &Structure::load(file)?;
    let (channels, given) = (options.channel.len(), options.components().count());
    if !(channels == 0 || channels == given) {
        return Err(JobError::Usage(format!(
            "--channel has {channels} numbers, and {given} components are given: one for each"
        ))
        .into());
    }
    let frame = rocking_frame(structure)?;
    let model = model_of(&frame, options.frame.model);
    // gravity is the frame's, and rest of the planar model is proved
    let options = &mut ResponseOptions { gravity_m_s2: frame.gravity_m_s2(), ..options.clone() };
    let own = structure.rest_amplitude_rad.filter(|_| model == Model::Wobbling);
    options.frame.rest_amplitude_rad = options.frame.rest_amplitude_rad.or(own);
    let options = &*options;
    if options.frame.h1.is_none() && options.frame.h2.is_none() {
        return Err(JobError::Usage(
            "nothing shakes the frame: give --h1 or --h2 or both, the horizontal components".to_owned(),
        )
        .into());
    }
    options.check_history(FrameHistory::COLUMN)?;
    options.check(&[(RESTITUTION, "restitution", options.restitution)])?;
    let mut alarms = options.alarms(&[(USUAL_RESTITUTION, "--restitution", options.restitution)]);
    let (mut components, mut motions, mut formats) = (Vec::new(), [None, None, None], Vec::new());
    for (component, record, channel) in options.components() {
        let (motion, format) = options.read_told(record, channel)?;
        formats.push((record, format));
        let shaken_by = options.told(record, &motion);
        alarms.extend(shaken_by.alarms());
        components.push(ShakenComponent { component, shaken_by });
        let place = ["h1", "h2", "v"].iter().position(|name| *name == component).unwrap_or_default();
        motions[place] = Some(motion.scaled(options.scale)?);
    }
    options.refuse_unused(&formats)?;
    let (restitution, restitution_from) = restitution(structure, &frame, model, options);
    let [h1, h2, vertical] = &motions;
    let mut runs = Vec::new();
    let grounds = match model {
        Model::Planar => {
            vec![("h1", [h1.as_ref(), None]), ("h2", [h2.as_ref(), None])]
        }
        Model::Wobbling => {
            let under = if h1.is_none() {
                "h2"
            } else if h2.is_none() {
                "h1"
            } else {
                "h1 and h2"
            };
            vec![(under, [h1.as_ref(), h2.as_ref()])]
        }
    };
    for (under, [x, y]) in grounds.into_iter().filter(|(_, pair)| pair.iter().any(Option::is_some)) {
        let shaken = [x, y, vertical.as_ref()];
        runs.push(FrameRun::new(&frame, under, shaken, model, (restitution, options))?);
    }
    let report = FrameResponseReport {
        name: structure.name(),
        kind: structure.description.kind.name(),
        structure: structure.file.clone(),
        model,
        columns: frame.columns().columns(),
        height_m: frame.geometry().height_m(),
        slenderness_rad: frame.geometry().slenderness_rad(),
        deck_mass_kg: frame.deck_mass_kg(),
        uplift_acceleration_g: frame.uplift_acceleration_m_s2() / frame.gravity_m_s2(),
        restitution,
        restitution_from,
        notes: notes((model, restitution), &components, (&motions, &runs)),
        components,
        runs,
        alarms,
        history_file: options.history_file.clone(),
    };
    if let Some(file) = &report.history_file {
        let runs = report.runs.iter().filter_map(|run| Some((run.under, run.history.as_ref()?)));
        frame_history::write(file, &report.line(), runs)?;
    }
    Ok(report)
}

fn restitution(
    structure: &Structure,
    frame: &RockingFrame,
    model: Model,
    options: &ResponseOptions,
) -> (f64, &'static str) {
    match (options.restitution, structure.description.restitution, model) {
        (Some(given), ..) => (given, "--restitution"),
        (None, Some(own), Model::Planar) => (own, "the structure file"),
        (None, None, Model::Planar) => (frame.momentum_restitution(), "momentum"),
        (None, _, Model::Wobbling) => {
            structure.wobbling_restitution.map_or((1.0, "the model"), |own| (own, "the structure file"))
        }
    }
}

/// Share of the largest rotation below which a passage is close by the upright.
const CLOSE_BY: f64 = 0.01;

/// What the model leaves out, and what is assumed of the records.
fn notes(
    (model, restitution): (Model, f64),
    components: &[ShakenComponent],
    (motions, runs): (&[Option<Accelerogram>; 3], &[FrameRun]),
) -> Vec<String> {
    let mut notes = Vec::new();
    let loses_nothing = restitution >= 1.0;
    for (one, other) in [(0, 1), (0, 2), (1, 2)] {
        if motions[one].is_some() && motions[one] == motions[other] {
            let [one, other] = [one, other].map(|place| ["h1", "h2", "v"][place]);
            notes.push(format!("{one} and {other} are the same motion: is one of them a mistake?"));
        }
    }
    let passes = |run: &FrameRun| {
        run.least_rotation_rad.is_some_and(|least_rad| run.overturned || least_rad < CLOSE_BY * run.peak_rotation_rad)
    };
    if model == Model::Wobbling && runs.iter().any(passes) {
        notes.push(
            "the frame passes close by the upright, where a rigid one turns its direction almost at once: the largest \
             deck acceleration, base shear and reaction are mostly of such moments, and elastic columns soften them"
                .to_owned(),
        );
    }
    if model == Model::Wobbling {
        notes.push(TORSION.to_owned());
    }
    if model == Model::Wobbling && loses_nothing {
        notes.push(
            "a wobbling column loses no energy in this model; it rests when its energy falls below that of the \
             amplitude of rest (docs/frames.md)"
                .to_owned(),
        );
    }
    if model == Model::Wobbling
        && loses_nothing
        && components.iter().filter(|component| component.component != "v").count() == 1
    {
        notes.push(
            "one horizontal component is given: the frame moves along one line and, in this model, without the loss \
             at impacts that --model planar has; give --h1 and --h2 for motion in plan"
                .to_owned(),
        );
    }
    let is_beyond = |event: &FrameEvent| matches!(event.event, EventKind::TendonYields | EventKind::TendonFails);
    let beyond = runs.iter().flat_map(|run| &run.events).filter(|event| is_beyond(event)).map(|event| event.time_s);
    if let Some(first_s) = beyond.reduce(f64::min) {
        notes.push(format!(
            "tendons stay elastic in this model: from {first_s:.4} s on they are beyond yield, and the response is not \
             reliable"
        ));
    }
    let of = |component: &ShakenComponent| (component.shaken_by.samples, component.shaken_by.dt_s.to_bits());
    if components.windows(2).any(|pair| of(&pair[0]) != of(&pair[1])) {
        notes.push("the components differ in length or time step: they are taken to begin together".to_owned());
    }
    notes
}

impl FrameRun {
    fn new(
        frame: &RockingFrame,
        under: &'static str,
        shaken: [Option<&Accelerogram>; 3],
        model: Model,
        (restitution, options): (f64, &ResponseOptions),
    ) -> Result<Self, LaboratoryError> {
        let [x, y, z] = shaken.map(|motion| motion.map(uplift_frame::Shaking::Record));
        let ground = GroundMotion { x, y, z };
        let free_s = options.free_vibration_s;
        let until = if free_s > 0.0 { Until::Time(ground.duration_s() + free_s) } else { Until::FirstFreePeak };
        let usual = Options::default();
        let asked = Options {
            until,
            restitution: Some(restitution),
            rest_amplitude_rad: options.frame.rest_amplitude_rad,
            start_rotation_rad: options.frame.start_rotation_rad.unwrap_or(usual.start_rotation_rad),
            ..usual
        };
        if options.wants_history() {
            let (response, history) = uplift_frame::respond_with_history(frame, &ground, model, &asked)?;
            let history = FrameHistory::from_history(frame, history, shaken);
            Ok(Self { history: Some(history), ..Self::told(frame, under, response) })
        } else {
            Ok(Self::told(frame, under, uplift_frame::respond(frame, &ground, model, &asked)?))
        }
    }

    fn told(frame: &RockingFrame, under: &'static str, response: FrameResponse) -> Self {
        let peak = response.displacement;
        let rocked = response.uplift_s.is_some() && !response.overturned;
        Self {
            under,
            overturned: response.overturned,
            time_of_overturning_s: response.overturned.then_some(peak.time_s),
            peak_rotation_rad: if response.overturned { f64::INFINITY } else { response.rotation.value },
            peak_displacement_m: peak.value,
            peak_drift: peak.value / frame.geometry().height_m(),
            time_of_peak_s: rocked.then_some(peak.time_s),
            direction_at_peak_rad: response.direction_at_peak_rad,
            peak_displacement_x_m: response.displacement_x.value,
            peak_displacement_y_m: response.displacement_y.value,
            peak_tendon_n: response.tendon_n,
            peak_spring_m: response.spring_m,
            peak_deck_acceleration_m_s2: response.deck_acceleration.value,
            peak_base_shear_n: response.base_shear_n,
            peak_base_reaction_n: response.base_reaction_n,
            time_of_uplift_s: response.uplift_s,
            impacts: response.impacts,
            rests: response.rests,
            least_rotation_rad: response.least_rotation_rad,
            events: response.events,
            chatter_was_cut: response.chatter_was_cut,
            history: None,
        }
    }
}

/// A model in a word.
fn model_word(model: uplift_frame::Model) -> &'static str {
    match model {
        uplift_frame::Model::Planar => "planar",
        uplift_frame::Model::Wobbling => "wobbling",
    }
}
