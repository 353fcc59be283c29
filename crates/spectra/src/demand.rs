//! What a set scaled in one way asks of systems: a percentile of their peak displacements.

use uplift_ida::{IdaError, Peaks, Plan, System};

use crate::error::SpectraError;
use crate::motion_set::MotionSet;
use crate::noise::nudges;
use crate::scaling::Scaling;
use crate::statistics::percentile;

/// How the plans of a design are carried out: by [`analyse`](uplift_ida::analyse), or by someone who knows some of
/// their rows from before.
pub type CarryOut<'a> = dyn Fn(&Plan<'_>) -> Result<Peaks, IdaError> + 'a;

/// A set scaled in one way, and how its plans are carried out.
#[derive(Clone, Copy)]
pub struct Case<'a> {
    /// The motions.
    pub set: &'a MotionSet<'a>,
    /// What they are multiplied by.
    pub scaling: Scaling,
    /// What their factors are multiplied by besides: 1, or a little more or less to see what rounding does.
    pub nudge: f64,
    /// How plans are carried out.
    pub carry_out: &'a CarryOut<'a>,
}

impl Case<'_> {
    /// The case with all factors some roundings smaller and larger: [`nudges`].
    pub(crate) fn nudged(&self) -> impl Iterator<Item = Self> {
        nudges().into_iter().map(|nudge| Self { nudge: self.nudge * nudge, ..*self })
    }

    /// The percentile at `percent` of the peak displacements of each of `systems`, m; infinite where it falls on one
    /// that overturned.
    ///
    /// # Errors
    /// What the solvers refuse, and what carrying out ends with.
    pub(crate) fn demands_m(
        &self,
        systems: &[System],
        with_free_peak: bool,
        percent: f64,
    ) -> Result<Vec<f64>, SpectraError> {
        let plan = self.set.plan(&[self.scaling], systems, with_free_peak)?.multiplied(&[self.nudge])?;
        let peaks = (self.carry_out)(&plan)?;
        Ok((0..systems.len()).map(|system| percentile(&peaks.over_motions_m(system, 0), percent)).collect())
    }
}
