//! The systems of a library, and by what the intensities that shake them are normalised.

use serde::Serialize;
use uplift_block::RockingBlock;
use uplift_ida::System;
use uplift_oscillator::{Oscillator, PostUplift};
use uplift_study::{BlockGrid, LibraryStudy, OscillatorFamily};

use crate::error::LaboratoryError;

/// An intensity over what uplifts a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Normalised {
    /// Peak ground acceleration over that at uplift: PGA/(g tan α) of a block, PGA/(η g) of an oscillator.
    Pga,
    /// p PGV over the same acceleration.
    Pgv,
}

impl Normalised {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Pga, Self::Pgv];

    /// Its word in tables: `pga`.
    pub fn key(self) -> &'static str {
        match self {
            Self::Pga => "pga",
            Self::Pgv => "pgv",
        }
    }

    /// As a formula, of a block.
    pub fn label(self) -> &'static str {
        match self {
            Self::Pga => "PGA/(g tan α)",
            Self::Pgv => "p PGV/(g tan α)",
        }
    }
}

/// A system, and how its response and what shakes it are normalised.
pub(super) struct LibrarySystem {
    pub(super) system: System,
    /// Whether the first peak of the free motion after a record counts.
    pub(super) with_free_peak: bool,
    /// Ground acceleration at uplift, m/s²: g tan α or η g.
    pub(super) uplift_m_s2: f64,
    /// Rate p at which a small distance from the point of no return grows, rad/s; none where the force stays constant.
    pub(super) p_rad_s: Option<f64>,
    /// Displacement up to which nothing has lifted, m.
    pub(super) uplift_m: f64,
}

impl LibrarySystem {
    fn from_block(block: RockingBlock) -> Self {
        Self {
            with_free_peak: true,
            uplift_m_s2: block.uplift_acceleration_m_s2(),
            p_rad_s: Some(block.frequency_parameter_rad_s()),
            uplift_m: 0.0,
            system: System::Block(block),
        }
    }

    fn from_oscillator(oscillator: Oscillator, with_free_peak: bool) -> Self {
        let (uplift_m_s2, uplift_m) = (oscillator.uplift_acceleration_m_s2(), oscillator.uplift_displacement_m());
        let rate = |capacity_m: f64| (uplift_m_s2 / (capacity_m - uplift_m)).sqrt();
        Self {
            with_free_peak,
            uplift_m_s2,
            p_rad_s: Some(oscillator.capacity_m()).filter(|capacity_m| capacity_m.is_finite()).map(rate),
            uplift_m,
            system: System::Oscillator(oscillator),
        }
    }

    /// A displacement, m, as the library reports it.
    pub(super) fn response(&self, displacement_m: f64) -> f64 {
        match &self.system {
            System::Block(block) => block.rotation_rad(displacement_m) / block.slenderness_rad(),
            System::Oscillator(oscillator) if self.p_rad_s.is_some() => displacement_m / oscillator.capacity_m(),
            System::Oscillator(_) | System::Frame(_) => displacement_m,
        }
    }

    /// What [`response`](Self::response) is.
    pub(super) fn response_is(&self) -> &'static str {
        match (&self.system, self.p_rad_s) {
            (System::Block(_), _) => "theta/alpha",
            (_, Some(_)) => "u/u_cap",
            (_, None) => "u_m",
        }
    }
}

/// All of a library: blocks by size, slenderness and restitution, then oscillators by uplift displacement, capacity and
/// strength.
pub(super) fn systems(study: &LibraryStudy) -> Result<Vec<LibrarySystem>, LaboratoryError> {
    let mut systems = Vec::new();
    if let Some(blocks) = &study.blocks {
        add_blocks(blocks, study.gravity_m_s2, &mut systems)?;
    }
    if let Some(family) = &study.oscillators {
        add_oscillators(family, study.gravity_m_s2, &mut systems)?;
    }
    Ok(systems)
}

fn add_blocks(grid: &BlockGrid, gravity_m_s2: f64, systems: &mut Vec<LibrarySystem>) -> Result<(), LaboratoryError> {
    let restitutions: Vec<Option<f64>> = match &grid.restitution {
        Some(restitutions) => restitutions.iter().copied().map(Some).collect(),
        None => vec![None],
    };
    for &size_m in grid.size_m.iter() {
        for &slenderness_rad in grid.slenderness_rad.iter() {
            let block = RockingBlock::new(size_m, slenderness_rad)?.with_gravity(gravity_m_s2)?;
            for restitution in &restitutions {
                let block = restitution.map_or(Ok(block), |restitution| block.with_restitution(restitution))?;
                systems.push(LibrarySystem::from_block(block));
            }
        }
    }
    Ok(())
}

fn add_oscillators(
    family: &OscillatorFamily,
    gravity_m_s2: f64,
    systems: &mut Vec<LibrarySystem>,
) -> Result<(), LaboratoryError> {
    for &uplift_m in family.uplift_displacement_m.iter() {
        for &capacity_m in &family.capacity_m {
            let post_uplift =
                if capacity_m.is_finite() { PostUplift::Negative { capacity_m } } else { PostUplift::Zero };
            for &strength in family.strengths.iter() {
                let oscillator = Oscillator::new(strength, gravity_m_s2, uplift_m, family.restitution, post_uplift)?;
                systems.push(LibrarySystem::from_oscillator(oscillator, family.free_vibration));
            }
        }
    }
    Ok(())
}
