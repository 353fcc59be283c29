//! The bands of a result at risks that it is asked for after its bootstrap: from the draws that it keeps.

use uplift_bootstrap::{ResamplingPlan, Unit};
use uplift_job::events::Events;
use uplift_result::{BandMethod, ResultFile, StoredBands, StoredDraws};
use uplift_uniform_risk::consistency::{Question, Reweighing};
use uplift_uniform_risk::{QuotedUnits, StoredStripes};

use super::bands::BandSettings;
use super::compute::compute;
use super::source::Source;
use crate::error::QuestionsError;

/// The result `file` with bands at the risks that it is read at
/// ([`at_target_risks`](uplift_uniform_risk::at_target_risks)), made of the draws of its bootstrap, to the bit as a
/// bootstrap of these risks makes them. Without a bootstrap there are none.
///
/// # Errors
/// A file that is damaged; [`JobError::Interrupted`](uplift_job::JobError::Interrupted) where `events` say so.
pub fn resampled(file: ResultFile, events: &dyn Events) -> Result<ResultFile, QuestionsError> {
    if !file.is_at_target_risks() {
        return Ok(file);
    }
    let Some(plan) = resampling_plan(&file)? else { return Ok(file) };
    let BandMethod { confidence, interval, strength_above } = file.band_method()?;
    let settings = BandSettings { confidence, interval, simultaneous: false, strength_above };
    let stored = StoredStripes::read(&file)?;
    // where the bootstrap made bands of repaired spectra as well
    let reweighing = if file.has_repaired_bands() { Reweighing::from_result(&file)? } else { None };
    let quoted = QuotedUnits::from_file(&file)?;
    let source =
        Source { stored: &stored, reweighing: reweighing.as_ref(), plan: &plan, quoted: &quoted, settings: &settings };
    let measures = compute(&source, None, events)?;
    let (sizes, unit) = (plan.sizes().to_vec(), plan.unit());
    Ok(file.with_bands(StoredBands { sizes, unit, confidence, measures }))
}

/// The draws that the bands of `file` were made of; none before its bootstrap.
///
/// # Errors
/// A file that is damaged.
pub fn resampling_plan(file: &ResultFile) -> Result<Option<ResamplingPlan>, QuestionsError> {
    let Some(StoredDraws { records, sizes, replicates, multiplicities, unit }) = file.draws()? else {
        return Ok(None);
    };
    let group_of = match unit {
        Unit::Record => None,
        Unit::Pair => Some(Question::from_result(file)?.pair_of()),
        Unit::Event => Some(Question::from_result(file)?.event_of()),
    };
    let group_of = group_of.as_deref().map(|group_of| (unit, group_of));
    ResamplingPlan::from_multiplicities(records, &sizes, replicates, &multiplicities, group_of)
        .map(Some)
        .map_err(|error| file.fail(error).into())
}
