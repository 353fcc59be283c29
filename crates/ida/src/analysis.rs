//! The plan carried out on all cores.

use std::collections::HashMap;

use rayon::prelude::*;
use uplift_block::{BlockResponse, FreeRocking, RockingBlock, respond_at_scales};
use uplift_frame::{FrameDemand, FrameError, Model, Options, RockingFrame, Until, demands};
use uplift_motion::{Accelerogram, MotionError};
use uplift_oscillator::{GroundMotion, Oscillator, Peak, Sweep};

use crate::cells::{AnalysisRow, Cells};
use crate::error::IdaError;
use crate::peaks::Peaks;
use crate::plan::{Ground, Plan};
use crate::shard::Shard;
use crate::system::{ShakenFrame, System};
use crate::watch::Watch;

/// Carry out `plan` on the threads of the current rayon pool.
///
/// Memory: 13 bytes an analysis, and a row's worth of scratch a thread; of frames up to 32 scaled copies of a motion.
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
/// so that a few long rows keep all threads busy too. `watch` is asked before every row, and before every 8 to 32 runs
/// of a system that is not swept.
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
    let together = scales_together(axes.rows() * axes.scales);
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
            let (motion, system) = axes.motion_and_system(row);
            let (of_motion, shaken) = (&plan.motions()[motion], plan.system(motion, system));
            let missing: Vec<usize> = (0..axes.scales).filter(|scale| !known[*scale]).collect();
            if missing.is_empty() {
                watch.finished(plan.histories_of(motion) as u64);
                return Ok(());
            }
            let scales: Vec<f64> = missing.iter().map(|scale| of_motion.scales[*scale]).collect();
            let grounds: Vec<Ground<'_>> = plan.grounds_of(motion).collect();
            // of every azimuth the peak at every scale
            let peaks: Vec<Vec<Peak>> = match (shaken, ground_motions.shaking(motion)) {
                (System::Oscillator(oscillator), Some(percentile_peak)) => {
                    let from = |ground| swept(oscillator, ground, plan.with_free_peak(), &scales);
                    percentile_peak.iter().map(from).collect()
                }
                (other, _) => {
                    let run = |ground: &Ground<'_>, scales: &[f64]| {
                        if watch.cancelled() {
                            return Err(IdaError::Cancelled);
                        }
                        let peaks = several(other, ground, scales, plan.with_free_peak())?;
                        watch.finished(scales.len() as u64);
                        Ok(peaks)
                    };
                    let from = |ground| {
                        let parts = scales.par_chunks(together).map(|scales| run(ground, scales));
                        Ok(parts.collect::<Result<Vec<_>, _>>()?.concat())
                    };
                    grounds.par_iter().map(from).collect::<Result<_, _>>()?
                }
            };
            for (place, scale) in missing.iter().enumerate() {
                let from_all: Vec<Peak> = peaks.iter().map(|of_azimuth| of_azimuth[place]).collect();
                for peak in &from_all {
                    check_number(shaken, (of_motion.id, of_motion.scales[*scale]), peak)?;
                }
                let peak = match plan.other_azimuths_of(motion) {
                    Some((_, percentile)) => percentile_peak(from_all, percentile),
                    None => from_all[0],
                };
                displacement_m[*scale] = peak.displacement_m;
                impacts[*scale] = peak.impacts;
            }
            known.fill(true);
            keep(&AnalysisRow { motion, system, displacement_m, impacts });
            // what is not swept was reported on the way
            let told = if shaken.is_swept() { 0 } else { missing.len() * grounds.len() };
            watch.finished((plan.histories_of(motion) - told) as u64);
            Ok(())
        },
    )?;
    Ok(cells)
}

/// Scale factors at which a thread follows a system that is not swept before it looks for other work, or is told to
/// stop: as many as go side by side at least, and not so many that a thread of the pool would wait for others.
fn scales_together(analyses: usize) -> usize {
    let share = analyses / (4 * rayon::current_num_threads());
    share.next_multiple_of(8).clamp(8, 32)
}

/// The smallest of `peaks`, one an azimuth, that `percentile` per cent of them do not exceed; what overturned is the
/// largest.
fn percentile_peak(mut peaks: Vec<Peak>, percentile: u8) -> Peak {
    peaks.sort_by(|one, other| one.displacement_m.total_cmp(&other.displacement_m));
    let at_most = (peaks.len() * usize::from(percentile)).div_ceil(100);
    peaks[at_most.saturating_sub(1)]
}

/// Whether a peak is one: NaN never is, and `+∞` only of a system that can overturn.
fn check_number(system: &System, (motion, scale): (&str, f64), peak: &Peak) -> Result<(), IdaError> {
    let displacement_m = peak.displacement_m;
    if displacement_m.is_finite() || (displacement_m == f64::INFINITY && system.can_overturn()) {
        return Ok(());
    }
    Err(IdaError::NotFinite { motion: motion.to_owned(), scale, system: system.to_string(), displacement_m })
}

/// What oscillators share under each motion, one an azimuth: made ready once for motions of the same samples.
struct GroundMotions<'a> {
    ready: Vec<Option<Vec<GroundMotion<'a>>>>,
    /// Where that of each motion is, `[motion]`.
    place: Vec<usize>,
}

impl<'a> GroundMotions<'a> {
    fn shaking(&self, motion: usize) -> Option<&Vec<GroundMotion<'a>>> {
        self.ready[self.place[motion]].as_ref()
    }
}

/// What oscillators share under each motion, made ready only where a row of one is missing.
fn ground_motions<'a>(plan: &Plan<'a>, cells: &Cells, shard: Shard) -> Result<GroundMotions<'a>, IdaError> {
    let axes = plan.axes();
    let (mut known, mut place, mut sharing) = (HashMap::new(), Vec::new(), Vec::<Vec<usize>>::new());
    for motion in 0..axes.motions {
        let samples: Vec<(usize, u64)> = plan
            .grounds_of(motion)
            .map(|ground| (ground.along.acceleration_m_s2().as_ptr() as usize, ground.along.dt_s().to_bits()))
            .collect();
        let index = *known.entry(samples).or_insert_with(|| {
            sharing.push(Vec::new());
            sharing.len() - 1
        });
        sharing[index].push(motion);
        place.push(index);
    }
    let of_motions = |motions: &Vec<usize>| {
        let is_missing = |motion: usize, system: usize| {
            let is_swept = plan.system(motion, system).is_swept();
            is_swept && shard.contains(axes.row(motion, system)) && !cells.is_row_known(motion, system)
        };
        let missing = |motion: &usize| (0..axes.systems).any(|system| is_missing(*motion, system));
        let ready = |ground: Ground<'a>| ground.excitation().map(GroundMotion::new);
        motions.iter().any(missing).then(|| plan.grounds_of(motions[0]).map(ready).collect()).transpose()
    };
    Ok(GroundMotions { ready: sharing.par_iter().map(of_motions).collect::<Result<_, _>>()?, place })
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

/// Peaks of any system at `scales`, those of a system that is not swept side by side.
pub(crate) fn several(
    system: &System,
    ground: &Ground<'_>,
    scales: &[f64],
    with_free_peak: bool,
) -> Result<Vec<Peak>, IdaError> {
    match system {
        System::Oscillator(oscillator) => {
            let ground_motion = GroundMotion::new(ground.excitation()?);
            Ok(swept(oscillator, &ground_motion, with_free_peak, scales))
        }
        System::Block(block) if ground.upwards.is_some() => {
            // the block is the frame of one column without a deck, and the frame's solver knows the vertical motion
            let (size_m, slenderness_rad) = (block.size_m(), block.slenderness_rad());
            let frame = RockingFrame::block(size_m, slenderness_rad, block.gravity_m_s2()).map_err(|source| {
                IdaError::Frame {
                    motion: ground.id.to_owned(),
                    scale: scales.first().copied().unwrap_or(f64::NAN),
                    source: source.into(),
                }
            })?;
            let restitution = block.restitution();
            let shaken = ShakenFrame { frame, model: Model::Planar, restitution, rest_amplitude_rad: None };
            wobbled(&shaken, ground, scales, with_free_peak)
        }
        System::Block(block) => rocked(block, ground, scales, with_free_peak),
        System::Frame(shaken) => wobbled(shaken, ground, scales, with_free_peak),
    }
}

/// Without the free motion after the record, what is lost when it ends stands.
fn wobbled(
    shaken: &ShakenFrame,
    ground: &Ground<'_>,
    scales: &[f64],
    with_free_peak: bool,
) -> Result<Vec<Peak>, IdaError> {
    let named = |source: MotionError| IdaError::Motion { motion: ground.id.to_owned(), source: source.into() };
    let across = ground.across.filter(|_| shaken.model == Model::Wobbling);
    let scaled = |component: Option<&Accelerogram>, scale| component.map(|own| own.scaled(scale)).transpose();
    let components = [Some(ground.along), across, ground.upwards];
    let at_scale = |scale: &f64| {
        let [x, y, z] = components.map(|component| scaled(component, *scale));
        Ok([x?, y?, z?])
    };
    let motions = scales.iter().map(at_scale).collect::<Result<Vec<_>, _>>().map_err(named)?;
    let shaking: Vec<_> = motions.iter().map(together).collect();
    let duration_s = shaking.first().map_or(0.0, uplift_frame::GroundMotion::duration_s);
    let until = if with_free_peak { Until::FirstFreePeak } else { Until::Time(duration_s) };
    let ShakenFrame { restitution, rest_amplitude_rad, .. } = *shaken;
    let options = Options { until, restitution: Some(restitution), rest_amplitude_rad, ..Options::default() };
    let peak = |(demand, &scale): (Result<FrameDemand, FrameError>, &f64)| {
        let demand =
            demand.map_err(|source| IdaError::Frame { motion: ground.id.to_owned(), scale, source: source.into() })?;
        let impacts = u32::try_from(demand.impacts).unwrap_or(u32::MAX);
        Ok(Peak { displacement_m: demand.displacement_m, impacts })
    };
    demands(&shaken.frame, &shaking, shaken.model, &options).into_iter().zip(scales).map(peak).collect()
}

fn together([x, y, z]: &[Option<Accelerogram>; 3]) -> uplift_frame::GroundMotion<'_> {
    let [x, y, z] = [x, y, z].map(|component| component.as_ref().map(uplift_frame::Shaking::Record));
    uplift_frame::GroundMotion { x, y, z }
}

/// Peaks of a block at `scales`, together.
fn rocked(
    block: &RockingBlock,
    ground: &Ground<'_>,
    scales: &[f64],
    with_free_peak: bool,
) -> Result<Vec<Peak>, IdaError> {
    let free = if with_free_peak { FreeRocking::FirstPeak } else { FreeRocking::Lasting { duration_s: 0.0 } };
    let responses = respond_at_scales(block, ground.along, scales, free)
        .map_err(|source| IdaError::Block { motion: ground.id.to_owned(), source: source.into() })?;
    let peak = |response: BlockResponse| {
        let impacts = u32::try_from(response.impacts).unwrap_or(u32::MAX);
        Peak { displacement_m: response.displacement_m, impacts }
    };
    Ok(responses.into_iter().map(peak).collect())
}

#[cfg(test)]
mod tests {
    use uplift_oscillator::PostUplift;

    use super::*;

    #[test]
    fn a_nan_peak_is_an_error_and_an_overturning_is_a_result() {
        let system = |post_uplift| System::Oscillator(Oscillator::new(0.3, 9.81, 0.0005, 0.95, post_uplift).unwrap());
        let [constant, falls] = [PostUplift::Zero, PostUplift::Negative { capacity_m: 0.4 }].map(system);
        let check = |system: &System, displacement_m: f64| {
            check_number(system, ("RSN1 h1", 2.5), &Peak { displacement_m, impacts: 0 })
        };
        assert!(check(&constant, 0.1).is_ok() && check(&falls, f64::INFINITY).is_ok());
        for (system, displacement_m) in
            [(&constant, f64::INFINITY), (&constant, f64::NAN), (&falls, f64::NAN), (&falls, f64::NEG_INFINITY)]
        {
            let error = check(system, displacement_m).unwrap_err().to_string();
            assert!(error.contains("RSN1 h1") && error.contains("2.5") && error.contains("strength 0.3"), "{error}");
        }
    }

    #[test]
    fn a_percentile_is_a_peak_that_was_computed_and_what_overturns_is_the_largest() {
        let peaks = |values: &[f64]| values.iter().map(|&displacement_m| Peak { displacement_m, impacts: 0 }).collect();
        let of = |values: &[f64], percentile| percentile_peak(peaks(values), percentile).displacement_m;
        let four = [0.3, f64::INFINITY, 0.1, 0.2];
        assert_eq!(
            [0, 25, 26, 50, 75, 76, 100].map(|percentile| of(&four, percentile)),
            [0.1, 0.1, 0.2, 0.2, 0.3, f64::INFINITY, f64::INFINITY]
        );
        assert_eq!([0, 50, 100].map(|percentile| of(&[0.7], percentile)), [0.7; 3]);
    }
}
