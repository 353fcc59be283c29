//! The set's own repair: solved, weighed and looked at as a whole.

use uplift_risk::RunWeights;

use crate::scratch::Scratch;
use crate::solver::{DEFAULT_SMOOTHNESS, Fit, Solver};
use crate::{ConsistencyError, Diagnosis, NoRepair, ScaledAnalysis, Warning};

/// Fewer effective records than this are no repair.
const TOO_FEW: f64 = 5.0;

/// What a repair may be reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RepairOptions {
    /// Weight of the second differences of the exponents in the fit.
    pub smoothness: f64,
    /// Fewer effective records than this at a stripe in the range are a warning.
    pub least_effective: f64,
    /// Scale factors outside these, lower and upper, are counted.
    pub scale_factor_limits: [f64; 2],
}

impl Default for RepairOptions {
    fn default() -> Self {
        Self { smoothness: DEFAULT_SMOOTHNESS, least_effective: 20.0, scale_factor_limits: [0.2, 5.0] }
    }
}

/// A set whose records weigh, at each level, so much that it brings the site's hazard of both measures.
#[derive(Debug, Clone, PartialEq)]
pub struct Repaired {
    /// The exponents, and how well they fit.
    pub fit: Fit,
    /// Levels y of the exponents' knots, rising, in the unit of the curve of y.
    pub knot_levels: [f64; crate::KNOTS],
    /// The weight of every run: what [`RiskCurve::weighted`](uplift_risk::RiskCurve::weighted) takes.
    pub weights: RunWeights,
    /// The analysis under these weights.
    pub diagnosis: Diagnosis,
    /// What deserves a look.
    pub warnings: Vec<Warning>,
}

impl ScaledAnalysis<'_> {
    /// Repairs the set by weights, or says why it cannot be.
    ///
    /// # Errors
    /// [`ConsistencyError::NoRepair`] with the reason; a smoothness that is negative or not finite.
    pub fn repair(&self, options: &RepairOptions) -> Result<Repaired, ConsistencyError> {
        let solver = Solver::new(self, options.smoothness)?;
        let none = |reason| Err(ConsistencyError::NoRepair(reason));
        let once = self.set().once();
        let reach = solver.reach(&once)?;
        if !reach.is_whole() {
            return none(NoRepair::OutOfReach { reach, nearest: solver.nearest_reach(&once)? });
        }
        let mut scratch = Scratch::default();
        let fit = solver.solve(&once, &[0.0; crate::KNOTS], &mut scratch)?;
        if fit.has_run_away() {
            return none(NoRepair::Runaway { exponents: fit.exponents, nearest: solver.nearest_of(&fit) });
        }
        if !fit.is_reached() {
            return none(NoRepair::NotReached { nearest: solver.nearest_of(&fit) });
        }
        let mut shares = self.own_shares();
        solver.shares(&once, &fit.exponents, &mut scratch, &mut shares)?;
        let calibration = solver.calibration(&once, &fit.exponents, &mut scratch, &shares)?;
        let weights = RunWeights::new(self.stripes(), &shares)?.with_calibration(calibration)?;
        let diagnosis = self.diagnose(Some(&weights), options.scale_factor_limits)?;
        if let Some(least) = diagnosis.least_effective
            && least.records < TOO_FEW
        {
            let mean_ratio = diagnosis.stripes[least.level].mean_ln_ratio.exp();
            let other_level = self.set().brought(self.levels()[least.level], mean_ratio);
            return none(NoRepair::TooFew { least, other_level });
        }
        let warnings = Warning::from_analysis(self, &diagnosis, options.least_effective);
        Ok(Repaired { fit, knot_levels: *solver.knot_levels(), weights, diagnosis, warnings })
    }
}
