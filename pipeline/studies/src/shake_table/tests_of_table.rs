//! Every test: a record in the scale of the model at a level, and the frame under it.

use uplift_frame::{GroundMotion, Model, Options, Shaking, TableLevel as Level, respond, srss};
use uplift_inputs::SetRecord;
use uplift_job::JobError;
use uplift_job::events::{Events, each};
use uplift_result::{Excitation, ShakeTable, TableLevel, TableTest};
use uplift_study::{LevelPlan, ShakeTableStudy};

use super::Inputs;
use crate::error::StudiesError;

/// Carries out every test.
///
/// # Errors
/// Every test that cannot be computed; [`JobError::Interrupted`] where `events` say so.
pub fn carry_out(study: &ShakeTableStudy, inputs: &Inputs, events: &dyn Events) -> Result<ShakeTable, StudiesError> {
    let played = inputs.played();
    let jobs: Vec<(&LevelPlan, &(Excitation, &SetRecord))> =
        study.levels.iter().flat_map(|level| played.iter().map(move |played| (level, played))).collect();
    let found = each(events, ("tests", "tests"), jobs, |(level, (excitation, record))| {
        test(study, inputs, level, record)
            .map_err(|reason| format!("excitation {} ({}): {reason}", excitation.exc_id, excitation.record))
    })?;
    let (mut tests, mut mistakes) = (Vec::new(), Vec::new());
    for test in found {
        match test {
            Ok(test) => tests.push(test),
            Err(mistake) => mistakes.push(mistake),
        }
    }
    if !mistakes.is_empty() {
        return Err(JobError::Inputs(mistakes).into());
    }
    Ok(ShakeTable {
        records: inputs.records.description.clone(),
        synthetic: inputs.records.synthetic,
        structure: study.structure.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        length_scale: study.length_scale,
        levels: study
            .levels
            .iter()
            .map(|level| TableLevel { name: level.name.clone(), pgv_srss_m_s: level.pgv_srss_m_s })
            .collect(),
        excitations: played.into_iter().map(|(excitation, _)| excitation).collect(),
        tests,
        spectra: None,
    })
}

fn test(study: &ShakeTableStudy, inputs: &Inputs, level: &LevelPlan, record: &SetRecord) -> Result<TableTest, String> {
    let pair = [&record.pair.h1, &record.pair.h2];
    let level = Level::new(study.length_scale, level.pgv_srss_m_s).map_err(|error| error.to_string())?;
    let Some(([x, y], factor)) = level.pair(pair).map_err(|error| error.to_string())? else {
        return Err("its components do not move, so that it cannot be scaled".to_owned());
    };
    let options = Options {
        restitution: inputs.restitution,
        rest_amplitude_rad: Some(study.model.rest_amplitude_rad),
        start_rotation_rad: study.model.start_rotation_rad,
        ..Options::default()
    };
    let vertical = record.vertical.as_ref().map(|vertical| level.component(&vertical.accelerogram, factor));
    let z = vertical.transpose().map_err(|error| error.to_string())?;
    let ground = GroundMotion { z: z.as_ref().map(Shaking::Record), ..GroundMotion::pair(&x, &y) };
    let found = respond(&inputs.frame, &ground, Model::Wobbling, &options).map_err(|error| error.to_string())?;
    let u_m = found.displacement.value;
    Ok(TableTest {
        factor,
        pga_srss_m_s2: srss(x.pga_m_s2(), y.pga_m_s2()),
        u_m,
        u_x_m: found.displacement_x.value,
        u_y_m: found.displacement_y.value,
        drift: u_m / inputs.frame.geometry().height_m(),
        tendon_n: found.tendon_n.unwrap_or(f64::NAN),
        spring_m: found.spring_m.unwrap_or(f64::NAN),
        base_shear_n: found.base_shear_n,
        base_reaction_n: found.base_reaction_n,
        deck_acceleration_m_s2: found.deck_acceleration.value,
    })
}
