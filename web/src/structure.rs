//! A structure: what the rules of design make of the spectrum, and how it moves.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use serde_json::{Value, json};
use uplift_frame::{GroundMotion, HistoryRow, Model, Options, RockingFrame};
use uplift_motion::Accelerogram;
use uplift_structure::{Check, PostUpliftForce, Rule};
use uplift_study::Structure;

use crate::calculator::{Answer, At, refused};
use crate::motions::Motions;
use crate::reading::rarity;
use crate::stripes::Stripes;

/// Most rows of a motion that the page draws.
const MOST_ROWS: usize = 6000;

/// A structure file.
pub(crate) fn parse(text: &str) -> Answer<Structure> {
    let with_help = |own: &uplift_study::StudyMistake| match &own.help {
        Some(help) => format!("{own}: {help}"),
        None => own.to_string(),
    };
    let told = |error: uplift_study::StudyError| match error.mistakes() {
        [] => error.to_string(),
        mistakes => mistakes.iter().map(with_help).collect::<Vec<_>>().join("\n"),
    };
    Structure::parse(Path::new("structure.toml"), text.to_owned()).map_err(told)
}

/// The structure, and where a spectrum is given what it asks of it: as `uplift design --spectrum-only`.
pub(crate) fn design(stripes: Option<&mut Stripes>, text: &str, at: Option<&At>, safety_factor: f64) -> Answer<Value> {
    let structure = parse(text)?;
    let system = &structure.system;
    let mut told = json!({
        "kind": structure.description.kind.name(),
        "mass_kg": system.mass_kg(),
        "uplift_force_n": system.uplift_force_n(),
        "strength": system.strength(),
        "participation": system.participation(),
        "spectral_strength": system.spectral_strength(),
        "uplift_displacement_m": system.conditions().uplift_displacement_m(),
        "capacity_m": system.capacity_m(),
        "post_uplift_stiffness_n_m": system.post_uplift_stiffness_n_m(),
        "warnings": system.warnings().iter().map(ToString::to_string)
            .chain(structure.warnings.iter().map(ToString::to_string)).collect::<Vec<_>>(),
    });
    let (Some(stripes), Some(at)) = (stripes, at) else { return Ok(told) };
    let (place, risk) = (stripes.place(at)?, stripes.risk(at)?);
    told["risk"] = rarity(risk);
    let strength = system.spectral_strength_at(stripes.study.gravity_m_s2);
    told["read_at_strength"] = strength.into();
    let spectrum_m = stripes.study.oscillator.uplift_displacement_m;
    if !system.is_of_uplift_displacement(spectrum_m) {
        told["uplift_mm"] = json!([1e3 * spectrum_m, 1e3 * system.spectral_uplift_displacement_m()]);
    }
    let ordinates = match stripes.ordinate_at(place, risk, strength) {
        Ok((ordinates, ..)) => ordinates,
        Err(reason) => {
            told["without_demand"] = reason.into();
            return Ok(told);
        }
    };
    told["ordinate_m"] = json!(ordinates[0]);
    told["ordinate_band_m"] = json!(&ordinates[1..]);
    if !ordinates[0].is_finite() {
        told["without_demand"] = "the spectrum has no finite ordinate there".into();
        return Ok(told);
    }
    if matches!(system.post_uplift(), PostUpliftForce::Positive { .. }) {
        told["without_demand"] = "the force rises after uplift: the rules do not apply".into();
        return Ok(told);
    }
    let (mut rules, mut required_m) = (Vec::new(), Vec::new());
    for rule in [Rule::EqualDisplacement, Rule::EqualEnergy] {
        let check = |ordinate_m: f64| -> Answer<Check> {
            let demand_m = system.zero_stiffness_demand_m(ordinate_m).map_err(refused)?;
            Check::from_system(system, rule, safety_factor, demand_m).map_err(refused)
        };
        let own = check(ordinates[0])?;
        let limits: Vec<Option<Check>> = ordinates[1..].iter().map(|&limit_m| check(limit_m).ok()).collect();
        // a single record has no band
        let is_banded = !ordinates.iter().any(|limit_m| limit_m.is_nan());
        let of_limits = |value: fn(&Check) -> f64| -> Option<Vec<Option<f64>>> {
            is_banded.then(|| limits.iter().map(|check| check.as_ref().map(value)).collect())
        };
        let demand_m = own.demand.displacement_m();
        rules.push(json!({
            "rule": rule,
            "zero_stiffness_demand_m": own.zero_stiffness_demand_m,
            "demand_m": demand_m,
            "demand_band_m": of_limits(|check| check.demand.displacement_m()),
            "overturns": demand_m.is_infinite(),
            "required_capacity_m": own.required_capacity_m,
            "required_capacity_band_m": of_limits(|check| check.required_capacity_m),
            "margin_m": own.margin_m(),
            "safety_factor": own.safety_factor(),
            "satisfied": own.is_satisfied(),
            "upper_satisfied": is_banded.then(|| limits[1].as_ref().is_some_and(Check::is_satisfied)),
        }));
        required_m.push(own.required_capacity_m);
    }
    told["governing"] = (0..rules.len()).max_by(|&a, &b| required_m[a].total_cmp(&required_m[b])).into();
    told["rules"] = rules.into();
    Ok(told)
}

/// What rocks, and with which restitution.
fn rocking(text: &str) -> Answer<(RockingFrame, Options)> {
    let structure = parse(text)?;
    let frame = structure.rocking_frame().ok_or("only columns with flat ends and blocks have a motion here")?;
    let options = Options { restitution: structure.description.restitution, ..Options::default() };
    Ok((frame.map_err(refused)?, options))
}

/// The largest displacements of a structure under all records scaled to a level, found a record at a time, so that the
/// page answers other questions in between.
pub(crate) struct Peaks {
    text: String,
    measure: String,
    level: f64,
    found_m: Vec<f64>,
}

impl Peaks {
    /// Those of `before` where they are of the same, else none yet.
    pub(crate) fn new(before: Option<Self>, text: String, measure: String, level: f64) -> Self {
        let is_same = |own: &Self| own.text == text && own.measure == measure && own.level == level;
        before.filter(is_same).unwrap_or(Self { text, measure, level, found_m: Vec::new() })
    }

    /// Runs the next record. When there is none, how many of the peaks exceed the demand, m, and which record's comes
    /// nearest to it.
    pub(crate) fn step(&mut self, motions: &mut Motions, demand_m: f64) -> Answer<Value> {
        let (done, records) = (self.found_m.len(), motions.all()?.len());
        if done < records {
            let (frame, options) = rocking(&self.text)?;
            let ground = motions.scaled(done, &self.measure, self.level)?;
            let shaking = GroundMotion::along_x(&ground);
            let response = uplift_frame::respond(&frame, &shaking, Model::Planar, &options).map_err(refused)?;
            self.found_m.push(if response.overturned { f64::INFINITY } else { response.displacement.value.abs() });
            return Ok(json!({ "done": done + 1, "of": records }));
        }
        let apart = |place: &usize| (self.found_m[*place] - demand_m).abs();
        Ok(json!({
            "records": records,
            "exceeding": self.found_m.iter().filter(|peak_m| **peak_m > demand_m).count(),
            "nearest": (0..records).min_by(|a, b| apart(a).total_cmp(&apart(b))),
        }))
    }
}

/// The motion of a structure under a record, in its plane: as `uplift response --structure`.
pub(crate) fn motion(text: &str, ground: &Accelerogram) -> Answer<Value> {
    let (frame, options) = rocking(text)?;
    let shaking = GroundMotion::along_x(ground);
    let (response, history) =
        uplift_frame::respond_with_history(&frame, &shaking, Model::Planar, &options).map_err(refused)?;
    let rows = &history.rows;
    // what lies on its side moves no more
    let standing = rows.iter().position(|row| row.rotation_rad.abs() > FRAC_PI_2).unwrap_or(rows.len());
    let rows = &rows[..standing];
    let every = rows.len().div_ceil(MOST_ROWS).max(1);
    let of = |value: fn(&HistoryRow) -> f64| rows.iter().step_by(every).map(value).collect::<Vec<_>>();
    let samples = ground.acceleration_m_s2();
    let thin = samples.len().div_ceil(MOST_ROWS).max(1);
    Ok(json!({
        "time_s": of(|row| row.time_s),
        "rotation_rad": of(|row| row.rotation_rad),
        "displacement_m": of(|row| row.displacement_x_m),
        "peak_m": response.displacement.value,
        "overturned": response.overturned,
        "ground_m_s2": samples.iter().step_by(thin).collect::<Vec<_>>(),
        "ground_step_s": ground.dt_s() * thin as f64,
    }))
}
