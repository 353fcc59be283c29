//! The plan carried out on all cores.

use rayon::prelude::*;
use uplift_block::{FreeRocking, RockingBlock, respond};
use uplift_frame::{Model, Options, Until};
use uplift_motion::{Accelerogram, MotionError};
use uplift_oscillator::{GroundMotion, Oscillator, Peak, Sweep};

use crate::cells::{AnalysisRow, Cells};
use crate::error::IdaError;
use crate::peaks::Peaks;
use crate::plan::{Plan, ScaledMotion};
use crate::shard::Shard;
use crate::system::{ShakenFrame, System};
use crate::watch::Watch;

/// Carry out `plan` on the threads of the current rayon pool.
///
/// Memory: 13 bytes an analysis, and a row's worth of scratch a thread.
///
/// # Errors
/// [`IdaError::Cancelled`] if `watch` says so; [`IdaError::Block`] and [`IdaError::Motion`] for what is not computed,
/// [`IdaError::NotFinite`] for what comes out as no number.
pub fn analyse(plan: &Plan<'_>, watch: &dyn Watch) -> Result<Peaks, IdaError> {
    let cells = complete(plan, Cells::unknown(plan), Shard::WHOLE, watch, &|_| {})?;
    Ok(cells.peaks)
}

/// Carry out what `cells` lacks of one `shard` of `plan`, and hand every row to `keep` when it is finished, from any
/// thread.
///
/// A cell depends on its motion, system and scale factor alone: whatever was known before, the numbers are those of an
/// undisturbed [`analyse`], to the bit. A row of which everything is known is not handed over again.
///
/// Rows are shared out among the threads; the scale factors of a system that is not [swept](System::is_swept) as well,
/// so that a few long rows keep all threads busy too. `watch` is asked before every row, and before every run of a
/// system that is not swept.
///
/// # Errors
/// As [`analyse`]; what `keep` was given is finished all the same.
pub fn complete(
    plan: &Plan<'_>,
    mut cells: Cells,
    shard: Shard,
    watch: &dyn Watch,
    keep: &(dyn Fn(&AnalysisRow<'_>) + Sync),
) -> Result<Cells, IdaError> {
    let axes = plan.axes();
    let ground_motions = ground_motions(plan, &cells, shard)?;
    let displacement_m = cells.peaks.displacement_m.par_chunks_mut(axes.scales);
    let impacts = cells.peaks.impacts.par_chunks_mut(axes.scales);
    displacement_m.zip(impacts).zip(cells.known.par_chunks_mut(axes.scales)).enumerate().try_for_each(
        |(row, ((displacement_m, impacts), known))| {
            if watch.cancelled() {
                return Err(IdaError::Cancelled);
            }
            if !shard.contains(row) {
                return Ok(());
            }
            let (motion, system) = axes.of_row(row);
            let missing: Vec<usize> = (0..axes.scales).filter(|scale| !known[*scale]).collect();
            if missing.is_empty() {
                watch.finished(axes.scales as u64);
                return Ok(());
            }
            let of_motion = &plan.motions()[motion];
            let scales: Vec<f64> = missing.iter().map(|scale| of_motion.scales[*scale]).collect();
            let peaks = match (&plan.systems()[system], &ground_motions[motion]) {
                (System::Oscillator(oscillator), Some(ground_motion)) => {
                    swept(oscillator, ground_motion, plan.with_free_peak(), &scales)
                }
                (one_by_one, _) => {
                    let run = |scale: &f64| {
                        if watch.cancelled() {
                            return Err(IdaError::Cancelled);
                        }
                        let peak =
                            single(one_by_one, (of_motion, plan.across_of(motion)), *scale, plan.with_free_peak())?;
                        watch.finished(1);
                        Ok(peak)
                    };
                    scales.par_iter().map(run).collect::<Result<Vec<_>, _>>()?
                }
            };
            for (scale, peak) in missing.iter().zip(&peaks) {
                check_number(&plan.systems()[system], of_motion, of_motion.scales[*scale], peak)?;
                displacement_m[*scale] = peak.displacement_m;
                impacts[*scale] = peak.impacts;
            }
            known.fill(true);
            keep(&AnalysisRow { motion, system, displacement_m, impacts });
            // what is run one by one is told one by one
            let told = if plan.systems()[system].is_swept() { 0 } else { missing.len() };
            watch.finished((axes.scales - told) as u64);
            Ok(())
        },
    )?;
    Ok(cells)
}

/// Whether a peak is one: NaN never is, and `+∞` only of a system that can overturn.
fn check_number(system: &System, motion: &ScaledMotion<'_>, scale: f64, peak: &Peak) -> Result<(), IdaError> {
    let displacement_m = peak.displacement_m;
    if displacement_m.is_finite() || (displacement_m == f64::INFINITY && system.can_overturn()) {
        return Ok(());
    }
    Err(IdaError::NotFinite { motion: motion.id.to_owned(), scale, system: system.to_string(), displacement_m })
}

/// What oscillators share under each motion, made ready only where a row of one is missing.
fn ground_motions<'a>(plan: &Plan<'a>, cells: &Cells, shard: Shard) -> Result<Vec<Option<GroundMotion<'a>>>, IdaError> {
    let axes = plan.axes();
    let of_motion = |(motion, scaled): (usize, &ScaledMotion<'a>)| {
        let missing = |(system, shaken): (usize, &System)| {
            shaken.is_swept() && shard.contains(axes.row(motion, system)) && !cells.is_row_known(motion, system)
        };
        plan.systems().iter().enumerate().any(missing).then(|| scaled.excitation().map(GroundMotion::new)).transpose()
    };
    plan.motions().par_iter().enumerate().map(of_motion).collect()
}

/// Peaks of an oscillator at all `scales` together.
pub(crate) fn swept(
    oscillator: &Oscillator,
    ground_motion: &GroundMotion<'_>,
    with_free_peak: bool,
    scales: &[f64],
) -> Vec<Peak> {
    Sweep::new(oscillator, ground_motion, with_free_peak).peaks(scales)
}

/// The peak of any system at one scale factor.
pub(crate) fn single(
    system: &System,
    (motion, across): (&ScaledMotion<'_>, Option<&Accelerogram>),
    scale: f64,
    with_free_peak: bool,
) -> Result<Peak, IdaError> {
    match system {
        System::Oscillator(oscillator) => {
            let ground_motion = GroundMotion::new(motion.excitation()?);
            Ok(Sweep::new(oscillator, &ground_motion, with_free_peak).peak(scale))
        }
        System::Block(block) => rocked(block, motion, scale, with_free_peak),
        System::Frame(shaken) => wobbled(shaken, (motion, across), scale, with_free_peak),
    }
}

/// Without the free motion after the record, what is lost when it ends stands.
fn wobbled(
    shaken: &ShakenFrame,
    (motion, across): (&ScaledMotion<'_>, Option<&Accelerogram>),
    scale: f64,
    with_free_peak: bool,
) -> Result<Peak, IdaError> {
    let scaled = |component: &Accelerogram| {
        let named = |source: MotionError| IdaError::Motion { motion: motion.id.to_owned(), source: source.into() };
        component.scaled(scale).map_err(named)
    };
    let x = scaled(motion.accelerogram)?;
    let y = across.filter(|_| shaken.model == Model::Wobbling).map(scaled).transpose()?;
    let component = uplift_frame::Shaking::Record;
    let ground = uplift_frame::GroundMotion { x: Some(component(&x)), y: y.as_ref().map(component), z: None };
    let until = if with_free_peak { Until::FirstFreePeak } else { Until::Time(ground.duration_s()) };
    let options = Options { until, restitution: Some(shaken.restitution), ..Options::default() };
    let response = uplift_frame::respond(&shaken.frame, &ground, shaken.model, &options)
        .map_err(|source| IdaError::Frame { motion: motion.id.to_owned(), scale, source: source.into() })?;
    let impacts = u32::try_from(response.impacts).unwrap_or(u32::MAX);
    Ok(Peak { displacement_m: response.displacement.value, impacts })
}

fn rocked(block: &RockingBlock, motion: &ScaledMotion<'_>, scale: f64, with_free_peak: bool) -> Result<Peak, IdaError> {
    let free = if with_free_peak { FreeRocking::FirstPeak } else { FreeRocking::Lasting { duration_s: 0.0 } };
    let named = || motion.id.to_owned();
    let ground = motion
        .accelerogram
        .scaled(scale)
        .map_err(|source| IdaError::Motion { motion: named(), source: source.into() })?;
    let response =
        respond(block, &ground, free).map_err(|source| IdaError::Block { motion: named(), source: source.into() })?;
    Ok(Peak { displacement_m: response.displacement_m, impacts: u32::try_from(response.impacts).unwrap_or(u32::MAX) })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use uplift_motion::Accelerogram;
    use uplift_oscillator::PostUplift;

    use super::*;

    #[test]
    fn a_peak_that_is_no_number_is_an_error_and_an_overturning_is_an_answer() {
        let accelerogram = Accelerogram::new(0.01, vec![0.0, 1.0]).unwrap();
        let motion = ScaledMotion { id: "RSN1 h1", accelerogram: &accelerogram, scales: vec![2.5] };
        let system = |post_uplift| System::Oscillator(Oscillator::new(0.3, 9.81, 0.0005, 0.95, post_uplift).unwrap());
        let [constant, falls] = [PostUplift::Zero, PostUplift::Negative { capacity_m: 0.4 }].map(system);
        let check = |system: &System, displacement_m: f64| {
            check_number(system, &motion, 2.5, &Peak { displacement_m, impacts: 0 })
        };
        assert!(check(&constant, 0.1).is_ok() && check(&falls, f64::INFINITY).is_ok());
        for (system, displacement_m) in
            [(&constant, f64::INFINITY), (&constant, f64::NAN), (&falls, f64::NAN), (&falls, f64::NEG_INFINITY)]
        {
            let error = check(system, displacement_m).unwrap_err().to_string();
            assert!(error.contains("RSN1 h1") && error.contains("2.5") && error.contains("strength 0.3"), "{error}");
        }
    }
}
