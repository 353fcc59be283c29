//! Keys: everything that a number depends on, in a hash.

use sha2::{Digest, Sha256};
use uplift_ida::{Axes, NUMERICS, Plan};
use uplift_job::checksum::motion_key;
use uplift_labelled::hexadecimal;
use uplift_study::UniformRiskStudy;

/// Key of an analysis row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RowKey(pub [u8; 16]);

/// SHA-256 of the oscillator of a study but for its strength, and of the version of the solver's numbers, as
/// hexadecimal digits: what a result says of its stripes, so that those of the same oscillator can be taken over cell
/// by cell.
pub fn oscillator_key(study: &UniformRiskStudy) -> String {
    let oscillator = &study.oscillator;
    let (kind, parameter) = oscillator.post_uplift.identity();
    let mut hash = Sha256::new();
    hash.update(NUMERICS.to_le_bytes());
    hash.update(kind.to_le_bytes());
    hash.update(u32::from(oscillator.free_vibration).to_le_bytes());
    for value in [study.gravity_m_s2, oscillator.uplift_displacement_m, oscillator.restitution, parameter] {
        hash.update(value.to_le_bytes());
    }
    hexadecimal(&hash.finalize())
}

/// The keys of the rows of a plan.
#[derive(Debug, Clone)]
pub struct RowKeys {
    axes: Axes,
    /// As the rows of the plan.
    keys: Vec<RowKey>,
}

impl RowKeys {
    /// The keys of the rows of `plan`, whose motions have the keys `motions` (see [`motion_key`]).
    ///
    /// # Panics
    /// If there are not as many keys as motions, which is a bug of the caller.
    pub fn from_plan(plan: &Plan<'_>, motions: &[String]) -> Self {
        let axes = plan.axes();
        assert_eq!(motions.len(), axes.motions, "keys of motions");
        let mut keys = Vec::with_capacity(axes.rows());
        for (index, (motion, key)) in plan.motions().iter().zip(motions).enumerate() {
            let mut of_motion = Sha256::new();
            of_motion.update(NUMERICS.to_le_bytes());
            of_motion.update(u32::from(plan.with_free_peak()).to_le_bytes());
            of_motion.update(key);
            of_motion.update(bytes(&motion.scales));
            if let Some((others, percentile)) = plan.other_azimuths_of(index).filter(|(others, _)| !others.is_empty()) {
                of_motion.update([percentile]);
                for other in others {
                    of_motion.update(motion_key(other));
                }
            }
            if let Some(vertical) = plan.upwards_of(index) {
                of_motion.update(b"vertical");
                of_motion.update(motion_key(vertical));
            }
            for system in 0..axes.systems {
                let mut hash = of_motion.clone();
                hash.update(bytes(&plan.system(index, system).identity()));
                let mut key = [0; 16];
                key.copy_from_slice(&hash.finalize()[..16]);
                keys.push(RowKey(key));
            }
        }
        Self { axes, keys }
    }

    /// The key of one row.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn at(&self, motion: usize, system: usize) -> RowKey {
        self.keys[self.axes.row(motion, system)]
    }

    /// The keys in the order of the rows.
    pub fn as_slice(&self) -> &[RowKey] {
        &self.keys
    }

    /// Lengths of the axes of the plan.
    pub fn axes(&self) -> Axes {
        self.axes
    }
}

/// So many numbers, and these: lists that follow each other are not taken for others.
fn bytes(values: &[f64]) -> Vec<u8> {
    (values.len() as u64).to_le_bytes().into_iter().chain(values.iter().flat_map(|value| value.to_le_bytes())).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use uplift_block::RockingBlock;
    use uplift_ida::{ScaledMotion, System};
    use uplift_oscillator::Oscillator;

    use uplift_motion::Accelerogram;

    use super::*;

    /// Whatever a number depends on changes the key of its row, and nothing else does.
    #[test]
    fn a_key_is_all_that_its_row_depends_on() {
        let [one, other] = [[1.0, 2.0], [1.0, 3.0]].map(|samples| Accelerogram::new(0.1, samples.to_vec()).unwrap());
        let systems = [
            System::Oscillator(Oscillator::zsbe(0.1).unwrap()),
            System::Oscillator(Oscillator::zsbe(0.2).unwrap()),
            System::Block(RockingBlock::new(1.0, 0.1).unwrap()),
        ];
        let keys = |motion: &Accelerogram, scales: &[f64], systems: &[System], free: bool| {
            let motions = vec![ScaledMotion { id: "any", accelerogram: motion, scales: scales.to_vec() }];
            RowKeys::from_plan(&Plan::scaled(motions, systems, free).unwrap(), &[motion_key(motion)]).keys
        };
        let mut seen: HashSet<RowKey> = keys(&one, &[1.0, 2.0], &systems, true).into_iter().collect();
        seen.extend(keys(&other, &[1.0, 2.0], &systems, true));
        seen.extend(keys(&one, &[1.0], &systems, true));
        seen.extend(keys(&one, &[2.0, 1.0], &systems, true));
        seen.extend(keys(&one, &[1.0, 2.0], &systems, false));
        // and the other azimuths, their percentile, what shakes it upwards
        let plan = || {
            let motions = vec![ScaledMotion { id: "any", accelerogram: &one, scales: vec![1.0, 2.0] }];
            Plan::scaled(motions, &systems, true).unwrap()
        };
        let seen_from = |others: &[Accelerogram], percentile: u8| {
            RowKeys::from_plan(&plan().from_azimuths(vec![others], percentile).unwrap(), &[motion_key(&one)]).keys
        };
        let others = [other.clone()];
        seen.extend(seen_from(&others, 50));
        seen.extend(seen_from(&others, 100));
        seen.extend(seen_from(std::slice::from_ref(&one), 100));
        seen.extend(RowKeys::from_plan(&plan().upwards(vec![&other]).unwrap(), &[motion_key(&one)]).keys);
        assert_eq!(seen.len(), 9 * systems.len());
        // one azimuth is no percentile
        assert_eq!(seen_from(&[], 100), keys(&one, &[1.0, 2.0], &systems, true));
        // the same row among others
        assert_eq!(keys(&one, &[1.0, 2.0], &systems[2..], true)[0], keys(&one, &[1.0, 2.0], &systems, true)[2]);
    }
}
