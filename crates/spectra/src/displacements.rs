//! Peak displacements of many systems under every motion of a set.

use rayon::prelude::*;
use uplift_block::{FreeRocking, RockingBlock, respond};
use uplift_ida::Watch;
use uplift_oscillator::{Excitation, GroundMotion, Oscillator, Sweep};

use crate::error::SpectraError;
use crate::motion_set::{Motion, MotionSet};
use crate::scaling::Scaling;

/// What is shaken.
#[derive(Debug, Clone, PartialEq)]
pub enum System {
    /// An uplifting oscillator (Eq. 3.1–3.3).
    Oscillator(Oscillator),
    /// A rigid rocking block (Eq. 2.1–2.3); its displacement is that of its top (Eq. 2.10).
    Block(RockingBlock),
}

/// Peak displacements [scaling, system, motion].
#[derive(Debug, Clone, PartialEq)]
pub struct Displacements {
    systems: usize,
    motions: usize,
    displacement_m: Vec<f64>,
}

impl Displacements {
    /// All of them, m, the motion running fastest: `+∞` where the system overturned.
    pub fn all_m(&self) -> &[f64] {
        &self.displacement_m
    }

    /// Those of a system at a scaling, by their places in the plan, one a motion, m.
    ///
    /// # Panics
    /// If there is no such place.
    pub fn of_m(&self, scaling: usize, system: usize) -> &[f64] {
        let first = (scaling * self.systems + system) * self.motions;
        &self.displacement_m[first..first + self.motions]
    }
}

/// Shake every one of `systems` by every motion of `set`, scaled in each of the ways of `scalings`, on the threads of the current
/// rayon pool. A number depends on its own system, motion and scaling alone: it is the same for any number of threads.
///
/// * `with_free_vibration` — whether the first peak after the end of a record counts; a block is always followed to it
/// * `watch` — is told of finished analyses, and may stop the work
///
/// Memory: 16 bytes an analysis.
///
/// # Errors
/// [`SpectraError::Cancelled`]; what the solvers refuse.
pub fn displacements(
    set: &MotionSet<'_>,
    scalings: &[Scaling],
    systems: &[System],
    with_free_vibration: bool,
    watch: &dyn Watch,
) -> Result<Displacements, SpectraError> {
    let motions = set.motions();
    let factors: Vec<Vec<f64>> = scalings.iter().map(|scaling| set.factors(*scaling)).collect();
    // a piece of work is a motion under one system in all scalings: they share what is prepared for the two
    let shaken = motions
        .par_iter()
        .enumerate()
        .map(|(motion, shaking)| {
            let scales: Vec<f64> = factors.iter().map(|of_scaling| of_scaling[motion]).collect();
            let ground_motion = GroundMotion::new(excitation(shaking)?);
            let under = |system: &System| {
                if watch.cancelled() {
                    return Err(SpectraError::Cancelled);
                }
                let peaks_m = match system {
                    System::Oscillator(oscillator) => {
                        let sweep = Sweep::new(oscillator, &ground_motion, with_free_vibration);
                        sweep.peaks(&scales).iter().map(|peak| peak.displacement_m).collect()
                    }
                    System::Block(block) => scales
                        .iter()
                        .map(|scale| block_displacement_m(block, shaking, *scale))
                        .collect::<Result<Vec<_>, _>>()?,
                };
                watch.finished(peaks_m.len() as u64);
                Ok(peaks_m)
            };
            systems.par_iter().map(under).collect::<Result<Vec<_>, _>>()
        })
        .collect::<Result<Vec<_>, _>>()?;
    let mut displacement_m = vec![0.0; scalings.len() * systems.len() * motions.len()];
    for (motion, of_motion) in shaken.iter().enumerate() {
        for (system, peaks_m) in of_motion.iter().enumerate() {
            for (scaling, peak_m) in peaks_m.iter().enumerate() {
                displacement_m[(scaling * systems.len() + system) * motions.len() + motion] = *peak_m;
            }
        }
    }
    Ok(Displacements { systems: systems.len(), motions: motions.len(), displacement_m })
}

fn excitation<'a>(motion: &Motion<'a>) -> Result<Excitation<'a>, SpectraError> {
    Excitation::new(motion.accelerogram.dt_s(), motion.accelerogram.acceleration_m_s2())
        .map_err(|source| SpectraError::Oscillator { motion: motion.id.clone(), source })
}

fn block_displacement_m(block: &RockingBlock, motion: &Motion<'_>, scale: f64) -> Result<f64, SpectraError> {
    let scaled = motion
        .accelerogram
        .scaled(scale)
        .map_err(|source| SpectraError::Motion { motion: motion.id.clone(), source })?;
    Ok(respond(block, &scaled, FreeRocking::FirstPeak)?.displacement_m)
}
