//! How far rounding alone moves the ordinates that are printed: their runs once more, at neighbouring scale factors.
//!
//! All motions are repeated, not only those that a percentile lies between: a run that rounding throws from one side of
//! a percentile to the other moves it as well.

use uplift_ida::{IdaError, Peaks, Plan, System};
use uplift_job::text::nearest;
use uplift_result::SetSpectra;
use uplift_spectra::{MotionSet, NUDGES, Noisy, nudges, percentile};
use uplift_study::DisplacementStudy;

use super::spectra::with_free_vibration;

/// Strengths or slendernesses at which a run prints its spectra, or those nearest to them.
const PRINTED: [f64; 3] = [0.1, 0.2, 0.4];

/// Positions of the printed ordinates among the `abscissae` of a study.
pub fn printed(abscissae: &[f64]) -> Vec<usize> {
    nearest(abscissae, &PRINTED)
}

/// Of the `structures` of a study, over `[line, abscissa]`, those whose ordinates are printed.
pub(super) fn printed_structures(study: &DisplacementStudy, structures: &[System]) -> Vec<System> {
    let abscissae = study.structures.abscissa();
    let printed = printed(abscissae);
    structures.chunks(abscissae.len()).flat_map(|line| printed.iter().map(|&at| line[at].clone())).collect()
}

/// Those structures under every motion of `set` at the neighbours of its scale factors: over `[motion, structure, nudge
/// and way of scaling that differs]`.
pub(super) fn rounding_plan<'a>(
    study: &DisplacementStudy,
    set: &'a MotionSet<'_>,
    structures: &'a [System],
) -> Result<Plan<'a>, IdaError> {
    set.plan(&study.scaling.ways().0, structures, with_free_vibration(study))?.multiplied(&nudges())
}

/// The printed ordinates of `spectra` with their range over the neighbours, over `[way, line, percentile, printed
/// abscissa]`, m.
///
/// * `peaks` — of the plan of these structures
pub(super) fn rounding(study: &DisplacementStudy, spectra: &SetSpectra, peaks: &Peaks) -> Vec<Noisy> {
    let (ways, places) = study.scaling.ways();
    let (lines, abscissae) = (study.structures.lines(), study.structures.abscissa());
    let printed = printed(abscissae);
    let mut rounding = Vec::new();
    for (way, &place) in places.iter().enumerate() {
        for line in 0..lines {
            let samples: Vec<Vec<Vec<f64>>> = (0..printed.len())
                .map(|at| {
                    let sample = |nudge| peaks.over_motions_m(line * printed.len() + at, nudge * ways.len() + place);
                    (0..NUDGES).map(sample).collect()
                })
                .collect();
            for (position, &percent) in study.percentiles.iter().enumerate() {
                let row = ((way * lines + line) * study.percentiles.len() + position) * abscissae.len();
                rounding.extend(printed.iter().zip(&samples).map(|(&at, samples)| {
                    let nudged = samples.iter().map(|sample| percentile(sample, percent));
                    Noisy::around(spectra.percentile_m[row + at], nudged)
                }));
            }
        }
    }
    rounding
}
