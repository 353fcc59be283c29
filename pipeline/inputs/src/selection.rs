//! The records of a set that satisfy what a study asks for.

use rayon::prelude::*;
use uplift_job::JobError;
use uplift_motion::{Combination, RecordPair, classify_pulse, geometric_mean, may_be_pulse_like};
use uplift_study::RecordSelection;

use super::pairs::CheckedPair;
use crate::error::InputsError;

/// The pairs that pass `selection`, their peaks combined as `intensity` says and in multiples of `gravity_m_s2`; and
/// notes about those of which something is not known.
///
/// # Errors
/// Where none passes, or a measure cannot be had.
pub fn select(
    pairs: Vec<CheckedPair>,
    selection: &RecordSelection,
    intensity: Combination,
    gravity_m_s2: f64,
) -> Result<(Vec<CheckedPair>, Vec<String>), InputsError> {
    if selection.is_empty() {
        return Ok((pairs, Vec::new()));
    }
    let count = pairs.len();
    let judged: Vec<(CheckedPair, Result<Verdict, String>)> = pairs
        .into_par_iter()
        .map(|pair| {
            let verdict = judge(&pair.0, selection, intensity, gravity_m_s2);
            (pair, verdict)
        })
        .collect();
    let mut chosen = Vec::new();
    let mut mistakes = Vec::new();
    let mut unknown: Vec<(&'static str, usize)> = Vec::new();
    for (pair, verdict) in judged {
        match verdict {
            Ok(Verdict::Passes) => chosen.push(pair),
            Ok(Verdict::Fails) => {}
            Ok(Verdict::Unknown(key)) => match unknown.iter_mut().find(|(known, _)| *known == key) {
                Some((_, count)) => *count += 1,
                None => unknown.push((key, 1)),
            },
            Err(reason) => mistakes.push(reason),
        }
    }
    if !mistakes.is_empty() {
        return Err(JobError::Inputs(mistakes).into());
    }
    let lacking: Vec<String> = unknown
        .iter()
        .map(|(key, lacking)| format!("{lacking} of {count} records have no {key} in the manifest and are left out"))
        .collect();
    if chosen.is_empty() {
        let because = if lacking.is_empty() { String::new() } else { format!(" ({})", lacking.join("; ")) };
        return Err(JobError::input(format!(
            "none of {count} records satisfies {selection}{because}; widen the selection"
        ))
        .into());
    }
    Ok((chosen, lacking))
}

enum Verdict {
    Passes,
    Fails,
    /// The manifest does not say what a criterion asks for.
    Unknown(&'static str),
}

fn judge(
    pair: &RecordPair,
    selection: &RecordSelection,
    intensity: Combination,
    gravity_m_s2: f64,
) -> Result<Verdict, String> {
    let peaks = intensity.peaks_of(pair).map_err(|error| format!("record {}: {error}", pair.id))?;
    let duration = |from: f64, to: f64| {
        geometric_mean(pair.h1.significant_duration_s(from, to), pair.h2.significant_duration_s(from, to))
    };
    for (criterion, range) in &selection.ranges {
        let value = match criterion.key {
            "pga_g" => peaks.pga_g(gravity_m_s2),
            "pgv_cm_s" => peaks.pgv_cm_s(),
            "d5_75_s" => duration(0.05, 0.75),
            "d5_95_s" => duration(0.05, 0.95),
            key => match pair.metadata.get(key).and_then(|text| text.parse().ok()) {
                Some(value) => value,
                None => return Ok(Verdict::Unknown(criterion.key)),
            },
        };
        if !range.contains(value) {
            return Ok(Verdict::Fails);
        }
    }
    if let Some(wanted) = selection.pulse_like {
        let pulse_like = may_be_pulse_like(&pair.h1, &pair.h2)
            && classify_pulse(&pair.h1, &pair.h2)
                .map_err(|error| format!("record {}: {error}", pair.id))?
                .is_pulse_like;
        if pulse_like != wanted {
            return Ok(Verdict::Fails);
        }
    }
    Ok(Verdict::Passes)
}
