//! The oscillators of a structure, and those of structures a little weaker and stronger.

use uplift_ida::System;
use uplift_oscillator::{Oscillator, OscillatorError, PostUplift};
use uplift_spectra::{NoiseSweep, nudges};
use uplift_structure::EquivalentSystem;
use uplift_study::{Structure, UniformRiskStudy};

use super::opening::restitution;
use crate::error::DesignError;

/// Half the width of the sweep around the strength, relative to it.
const NOISE_RELATIVE: f64 = 0.01;
/// Strengths in that sweep, with the structure's own in the middle.
const NOISE_POINTS: usize = 11;

/// Position of the study's ZSBE oscillator at the structure's strength.
pub(super) const OF_STUDY: usize = 0;
/// Position of the structure's own ZSBE oscillator, with its uplift displacement and restitution.
pub(super) const ZERO_STIFFNESS: usize = 1;
/// Position of the structure's own oscillator.
pub(super) const OWN: usize = 2;

/// The oscillators of a structure and of its neighbours.
#[derive(Debug, Clone)]
pub(super) struct Sweep {
    /// All of them.
    pub(super) oscillators: Vec<Oscillator>,
    /// Positions of the ZSBE oscillator and of the own one at each strength, ascending.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Positions of the first three of all once more, a few roundings weaker or stronger.
    pub(super) rounded: Vec<[usize; 3]>,
}

impl Sweep {
    /// Of `structure`, for a spectrum of `study`.
    pub(super) fn from_structure(structure: &Structure, study: &UniformRiskStudy) -> Result<Self, DesignError> {
        Self::from_system(&structure.system, study, restitution(structure, study))
            .map_err(|error| uplift_job::in_file(error, &structure.file))
    }

    fn from_system(system: &EquivalentSystem, study: &UniformRiskStudy, restitution: f64) -> Result<Self, DesignError> {
        let of_study = Oscillator::new(
            system.spectral_strength_at(study.gravity_m_s2),
            study.gravity_m_s2,
            study.oscillator.uplift_displacement_m,
            study.oscillator.restitution,
            PostUplift::Zero,
        );
        let uplift_m = system.conditions().uplift_displacement_m();
        let zero_stiffness = system.with_static_analysis(system.uplift_force_n(), uplift_m, f64::INFINITY)?;
        let mut oscillators =
            [of_study, zero_stiffness.spectral_oscillator(restitution), system.spectral_oscillator(restitution)]
                .into_iter()
                .collect::<Result<Vec<_>, _>>()?;
        let sweep = NoiseSweep::new(NOISE_RELATIVE, NOISE_POINTS)?;
        // the middle of the sweep is the structure itself
        let mut pairs = Vec::new();
        for (point, change) in sweep.factors().into_iter().enumerate() {
            if point == NOISE_POINTS / 2 {
                pairs.push([ZERO_STIFFNESS, OWN]);
                continue;
            }
            pairs.push([oscillators.len(), oscillators.len() + 1]);
            for own in [ZERO_STIFFNESS, OWN] {
                let stronger = strengthened(&oscillators[own], change)?;
                oscillators.push(stronger);
            }
        }
        let mut rounded = Vec::new();
        for nudge in nudges() {
            rounded.push([OF_STUDY, ZERO_STIFFNESS, OWN].map(|own| oscillators.len() + own));
            for own in [OF_STUDY, ZERO_STIFFNESS, OWN] {
                let nudged = strengthened(&oscillators[own], nudge)?;
                oscillators.push(nudged);
            }
        }
        Ok(Self { oscillators, pairs, rounded })
    }

    /// All of them, to be shaken.
    pub(super) fn systems(&self) -> Vec<System> {
        self.oscillators.iter().cloned().map(System::Oscillator).collect()
    }
}

/// The oscillator with its strength times `change`.
fn strengthened(oscillator: &Oscillator, change: f64) -> Result<Oscillator, OscillatorError> {
    let strength = oscillator.strength();
    Oscillator::new(
        change * strength,
        oscillator.uplift_acceleration_m_s2() / strength,
        oscillator.uplift_displacement_m(),
        oscillator.restitution(),
        oscillator.post_uplift(),
    )
}
