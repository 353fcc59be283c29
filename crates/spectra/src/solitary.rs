//! The design example of Section 2.4.3: a slenderness from the size-independent spectrum, checked with a block of its
//! own size (Tables 2.1–2.3).

use uplift_block::RockingBlock;
use uplift_ida::System;

use crate::demand::Case;
use crate::error::SpectraError;
use crate::noise::{NoiseSweep, Noisy, errors};

/// What is designed, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolitaryDesign {
    /// Height 2H of the block, or of the one that a frame is equivalent to \[m\]: 10 in the text.
    pub height_m: f64,
    /// Height that stands for an endless one \[m\]: 1000 in the text.
    pub endless_height_m: f64,
    /// Acceleration of gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// Coefficient of restitution \[-\]; Housner's (Eq. 2.3) if none.
    pub restitution: Option<f64>,
    /// What the slenderness `tan α_k` is multiplied by, 2.5 in the text.
    pub safety_factor: f64,
    /// Percentile of the displacements that counts, 50 in the text.
    pub percent: f64,
    /// Slendernesses `tan α` between which the intersection is looked for, from the highest down.
    pub search: [f64; 2],
    /// Ratio of neighbouring slendernesses in that search, above 1: a range narrower than that in which the block does
    /// not stand may be missed.
    pub search_ratio: f64,
}

/// One column of a table, with the noise of each of its values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolitaryExample {
    /// Design slenderness `tan α_D`; its noise is that of the demands around the intersection, each put on the capacity
    /// line: the search itself is not repeated.
    pub design_tangent: Noisy,
    /// Displacement of the endless block at the design slenderness, m: what the size-independent spectrum predicts.
    pub endless_m: Noisy,
    /// Displacement of the block of its own height, m.
    pub block_m: Noisy,
    /// Width of the designed block `2b = 2H tan α_D`, m: its capacity.
    pub capacity_m: f64,
    /// Error of the prediction, `(endless − block)/block` \[-\].
    pub error: Noisy,
}

/// How closely the intersection is found, relative.
const INTERSECTION_WIDTH: f64 = 1e-4;

impl SolitaryDesign {
    /// Design for a set at a scaling: the largest `tan α_k` at which the demand of the endless block meets the capacity
    /// line `2H tan α`, times the safety factor; then both blocks at that slenderness.
    ///
    /// # Errors
    /// [`SpectraError::NoIntersection`]; what the block refuses; what carrying out ends with.
    ///
    /// # Source
    /// Reggiani Manzo, Section 2.4.3.
    pub fn example(&self, case: Case<'_>, noise: NoiseSweep) -> Result<SolitaryExample, SpectraError> {
        let demand_m = |height_m: f64, tangents: &[f64]| self.demand_m(case, height_m, tangents);
        let critical = self.intersection(case, &|tangent| Ok(demand_m(self.endless_height_m, &[tangent])?[0]))?;
        let around = |tangent: f64| -> Vec<f64> { noise.factors().iter().map(|factor| factor * tangent).collect() };
        // where the capacity line would meet each of the demands around the intersection
        let demands_m = demand_m(self.endless_height_m, &around(critical))?;
        let met = demands_m.iter().map(|demand_m| self.safety_factor * demand_m / self.height_m);
        let design = self.safety_factor * critical;
        let endless_m = demand_m(self.endless_height_m, &around(design))?;
        let block_m = demand_m(self.height_m, &around(design))?;
        let error = errors(&endless_m, &block_m);
        Ok(SolitaryExample {
            design_tangent: Noisy::around(design, met),
            endless_m: Noisy::from_sweep(&endless_m),
            block_m: Noisy::from_sweep(&block_m),
            capacity_m: self.height_m * design,
            error: Noisy::from_sweep(&error),
        })
    }

    /// How far rounding alone moves the values of `example`, which [`example`](Self::example) gave for this case: its
    /// displacements, and the demand at the intersection put on the capacity line, with all scale factors some
    /// roundings smaller and larger ([`nudges`](crate::nudges)). The intersection is not looked for again.
    ///
    /// # Errors
    /// What the block refuses; what carrying out ends with.
    pub fn rounding(&self, case: Case<'_>, example: &SolitaryExample) -> Result<SolitaryExample, SpectraError> {
        let design = example.design_tangent.value;
        let at =
            |case: Case<'_>, height_m, tangent| Ok::<_, SpectraError>(self.demand_m(case, height_m, &[tangent])?[0]);
        let critical = design / self.safety_factor;
        let met_m = at(case, self.endless_height_m, critical)?;
        let (mut tangents, mut endless_m, mut block_m) = (Vec::new(), Vec::new(), Vec::new());
        for nudged in case.nudged() {
            tangents.push(design * at(nudged, self.endless_height_m, critical)? / met_m);
            endless_m.push(at(nudged, self.endless_height_m, design)?);
            block_m.push(at(nudged, self.height_m, design)?);
        }
        let error = errors(&endless_m, &block_m);
        Ok(SolitaryExample {
            design_tangent: Noisy::around(design, tangents),
            endless_m: Noisy::around(example.endless_m.value, endless_m),
            block_m: Noisy::around(example.block_m.value, block_m),
            capacity_m: example.capacity_m,
            error: Noisy::around(example.error.value, error),
        })
    }

    /// Percentile of the displacements of blocks of one height, m, one a slenderness.
    fn demand_m(&self, case: Case<'_>, height_m: f64, tangents: &[f64]) -> Result<Vec<f64>, SpectraError> {
        let blocks = tangents
            .iter()
            .map(|tangent| {
                let block = RockingBlock::from_height(height_m, tangent.atan())?.with_gravity(self.gravity_m_s2)?;
                let block = self.restitution.map_or(Ok(block), |restitution| block.with_restitution(restitution))?;
                Ok(System::Block(block))
            })
            .collect::<Result<Vec<_>, SpectraError>>()?;
        case.demands_m(&blocks, true, self.percent)
    }

    /// The largest `tan α` in the range at which `demand_m` reaches the capacity line: down from the highest until it
    /// lies above, then by halving.
    fn intersection(
        &self,
        case: Case<'_>,
        demand_m: &dyn Fn(f64) -> Result<f64, SpectraError>,
    ) -> Result<f64, SpectraError> {
        let [lowest, highest] = self.search;
        let stands = |tangent: f64| Ok::<_, SpectraError>(demand_m(tangent)? <= self.height_m * tangent);
        let nowhere = || SpectraError::NoIntersection {
            set: case.set.name().to_owned(),
            scaling: case.scaling.to_string(),
            lowest,
            highest,
        };
        let mut above = highest;
        if !stands(above)? {
            return Err(nowhere());
        }
        let mut below = above / self.search_ratio;
        while stands(below)? {
            (above, below) = (below, below / self.search_ratio);
            if below < lowest {
                return Err(nowhere());
            }
        }
        while above - below > INTERSECTION_WIDTH * above {
            let middle = 0.5 * (below + above);
            *(if stands(middle)? { &mut above } else { &mut below }) = middle;
        }
        Ok(above)
    }
}
