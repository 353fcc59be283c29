//! Displacement spectra of a record set: every structure under every motion, and percentiles over the motions.

use uplift_block::RockingBlock;
use uplift_ida::{Peaks, System};
use uplift_oscillator::{Oscillator, PostUplift};
use uplift_result::SetSpectra;
use uplift_spectra::{MotionSet, SpectraError, critical, percentile};
use uplift_study::{BlockFamily, DisplacementStudy, OscillatorFamily, Structures};

use crate::error::StudiesError;

/// The structures of a study over `[line, abscissa]`.
///
/// # Errors
/// A parameter that the study file's check let through: none is known.
pub fn structures(study: &DisplacementStudy) -> Result<Vec<System>, StudiesError> {
    Ok(match &study.structures {
        Structures::Oscillators(family) => oscillators(family, study.gravity_m_s2)?,
        Structures::Blocks(family) => blocks(family, study.gravity_m_s2)?,
    })
}

fn oscillators(family: &OscillatorFamily, gravity_m_s2: f64) -> Result<Vec<System>, SpectraError> {
    let mut systems = Vec::new();
    for &uplift_m in family.uplift_displacement_m.iter() {
        for &capacity_m in &family.capacity_m {
            let post_uplift = match capacity_m {
                f64::INFINITY => PostUplift::Zero,
                capacity_m => PostUplift::Negative { capacity_m },
            };
            for &strength in family.strengths.iter() {
                let oscillator = Oscillator::new(strength, gravity_m_s2, uplift_m, family.restitution, post_uplift)?;
                systems.push(System::Oscillator(oscillator));
            }
        }
    }
    Ok(systems)
}

fn blocks(family: &BlockFamily, gravity_m_s2: f64) -> Result<Vec<System>, SpectraError> {
    let mut systems = Vec::new();
    for &height_m in family.height_m.iter() {
        for &tangent in family.slendernesses.iter() {
            let block = RockingBlock::from_height(height_m, tangent.atan())?.with_gravity(gravity_m_s2)?;
            let block = family.restitution.map_or(Ok(block), |restitution| block.with_restitution(restitution))?;
            systems.push(System::Block(block));
        }
    }
    Ok(systems)
}

/// Whether the first peak of the free motion after a record counts; a block is always followed to it.
pub(super) fn with_free_vibration(study: &DisplacementStudy) -> bool {
    match &study.structures {
        Structures::Oscillators(family) => family.free_vibration,
        Structures::Blocks(_) => true,
    }
}

/// What `set` asks of the structures of `study`.
///
/// * `peaks` — over `[motion, structure, way of scaling that differs]`
pub(crate) fn set_spectra(study: &DisplacementStudy, set: &MotionSet<'_>, peaks: &Peaks) -> SetSpectra {
    let (ways, places) = study.scaling.ways();
    let (abscissae, motions) = (study.structures.abscissa(), set.motions().len());
    let mut spectra = SetSpectra {
        displacement_m: Vec::with_capacity(places.len() * peaks.axes().systems * motions),
        factors: places.iter().flat_map(|&place| set.factors(ways[place])).collect(),
        percentile_m: Vec::new(),
        overturned: Vec::new(),
        critical: Vec::new(),
    };
    for &place in &places {
        for line in 0..study.structures.lines() {
            let of_line = |at: usize| peaks.over_motions_m(line * abscissae.len() + at, place);
            let samples: Vec<Vec<f64>> = (0..abscissae.len()).map(of_line).collect();
            for sample in &samples {
                spectra.displacement_m.extend_from_slice(sample);
                let overturned = sample.iter().filter(|displacement_m| displacement_m.is_infinite()).count();
                spectra.overturned.push(overturned as f64 / motions as f64);
            }
            for &percent in study.percentiles.iter() {
                let ordinates: Vec<f64> = samples.iter().map(|sample| percentile(sample, percent)).collect();
                spectra.critical.push(critical(abscissae, &ordinates).unwrap_or(f64::NAN));
                spectra.percentile_m.extend(ordinates);
            }
        }
    }
    spectra
}
