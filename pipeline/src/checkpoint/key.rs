//! Keys: everything that a number depends on, in a hash.

use sha2::{Digest, Sha256};
use uplift_ida::NUMERICS;
use uplift_labelled::hexadecimal;
use uplift_motion::Accelerogram;

use crate::inputs::RecordSet;
use uplift_study::{MeasurePlan, ResolvedStudy, Uplifted};

/// Key of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PieceKey(pub [u8; 16]);

/// SHA-256 of a motion's time step and samples, as hexadecimal digits.
pub fn motion_key(motion: &Accelerogram) -> String {
    let mut hash = Sha256::new();
    hash.update(motion.dt_s().to_le_bytes());
    for sample in motion.acceleration_m_s2() {
        hash.update(sample.to_le_bytes());
    }
    hexadecimal(&hash.finalize())
}

/// SHA-256 of the oscillator of a study but for its strength, and of the version of the solver's numbers, as hexadecimal digits.
pub fn oscillator_key(study: &ResolvedStudy) -> String {
    let oscillator = &study.oscillator;
    let (kind, parameter) = match oscillator.uplifted {
        Uplifted::ZeroStiffness => (0_u32, 0.0),
        Uplifted::NegativeStiffness { capacity_m } => (1, capacity_m),
        Uplifted::PositiveStiffness { stiffness_per_s2 } => (2, stiffness_per_s2),
    };
    let mut hash = Sha256::new();
    hash.update(NUMERICS.to_le_bytes());
    hash.update(kind.to_le_bytes());
    hash.update(u32::from(oscillator.free_vibration).to_le_bytes());
    for value in [study.gravity_m_s2, oscillator.uplift_displacement_m, oscillator.restitution, parameter] {
        hash.update(value.to_le_bytes());
    }
    hexadecimal(&hash.finalize())
}

/// The keys of the stripes of one measure.
#[derive(Debug, Clone)]
pub struct StripeKeys {
    /// `[record, strength]`.
    keys: Vec<PieceKey>,
    strengths: usize,
}

impl StripeKeys {
    /// The keys of the stripes that `study` asks for with `measure`; `motions` are the keys of the records' motions.
    pub fn of(study: &ResolvedStudy, measure: &MeasurePlan, set: &RecordSet, motions: &[String]) -> Self {
        let mut common = Sha256::new();
        common.update(oscillator_key(study));
        for level in measure.levels.iter() {
            common.update(level.to_le_bytes());
        }
        let mut keys = Vec::with_capacity(set.records.len() * study.strengths.len());
        for (record, motion) in set.records.iter().zip(motions) {
            let mut of_record = common.clone();
            of_record.update(motion);
            of_record.update(record.intensity(measure.measure).to_le_bytes());
            for strength in study.strengths.iter() {
                let mut hash = of_record.clone();
                hash.update(strength.to_le_bytes());
                let mut key = [0; 16];
                key.copy_from_slice(&hash.finalize()[..16]);
                keys.push(PieceKey(key));
            }
        }
        Self { keys, strengths: study.strengths.len() }
    }

    /// The key of one piece.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn at(&self, record: usize, strength: usize) -> PieceKey {
        self.keys[record * self.strengths + strength]
    }

    /// Every key with record and strength.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, PieceKey)> + '_ {
        self.keys.iter().enumerate().map(|(index, key)| (index / self.strengths, index % self.strengths, *key))
    }
}
