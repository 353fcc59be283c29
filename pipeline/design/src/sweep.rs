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

/// The three oscillators of a structure, and those of its neighbours.
#[derive(Debug, Clone)]
pub(super) struct Sweep {
    /// All of them.
    pub(super) oscillators: Vec<Oscillator>,
    /// Where its neighbours are; none where they are not asked for.
    pub(super) neighbours: Option<Neighbours>,
}

/// Positions of the oscillators of neighbours.
#[derive(Debug, Clone)]
pub(super) struct Neighbours {
    /// Of the ZSBE oscillator and of the own one at each strength, ascending.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Of the first three of all once more, a few roundings weaker or stronger.
    pub(super) rounded: Vec<[usize; 3]>,
}

impl Sweep {
    /// Of `structure`, for a spectrum of `study`.
    pub(super) fn from_structure(
        structure: &Structure,
        study: &UniformRiskStudy,
        with_neighbours: bool,
    ) -> Result<Self, DesignError> {
        let of_system = || {
            let mut oscillators = own_oscillators(&structure.system, study, restitution(structure, study))?;
            let neighbours = with_neighbours.then(|| Neighbours::add_to(&mut oscillators)).transpose()?;
            Ok(Self { oscillators, neighbours })
        };
        of_system().map_err(|error: DesignError| uplift_job::in_file(error, &structure.file))
    }

    /// All of them, to be shaken.
    pub(super) fn systems(&self) -> Vec<System> {
        self.oscillators.iter().cloned().map(System::Oscillator).collect()
    }
}

/// The first three.
fn own_oscillators(
    system: &EquivalentSystem,
    study: &UniformRiskStudy,
    restitution: f64,
) -> Result<Vec<Oscillator>, DesignError> {
    let of_study = Oscillator::new(
        system.spectral_strength_at(study.gravity_m_s2),
        study.gravity_m_s2,
        study.oscillator.uplift_displacement_m,
        study.oscillator.restitution,
        PostUplift::Zero,
    );
    let uplift_m = system.conditions().uplift_displacement_m();
    let zero_stiffness = system.with_static_analysis(system.uplift_force_n(), uplift_m, f64::INFINITY)?;
    let own = [zero_stiffness.spectral_oscillator(restitution), system.spectral_oscillator(restitution)];
    Ok([of_study].into_iter().chain(own).collect::<Result<_, _>>()?)
}

impl Neighbours {
    /// Puts those of the first three `oscillators` behind them.
    fn add_to(oscillators: &mut Vec<Oscillator>) -> Result<Self, DesignError> {
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
                oscillators.push(strengthened(&oscillators[own], change)?);
            }
        }
        let mut rounded = Vec::new();
        for nudge in nudges() {
            rounded.push([OF_STUDY, ZERO_STIFFNESS, OWN].map(|own| oscillators.len() + own));
            for own in [OF_STUDY, ZERO_STIFFNESS, OWN] {
                oscillators.push(strengthened(&oscillators[own], nudge)?);
            }
        }
        Ok(Self { pairs, rounded })
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
