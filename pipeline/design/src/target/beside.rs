//! What stands beside a value that was found: levels of given return periods, and what a generic fragility asks for.

use serde::Serialize;
use uplift_hazard::HazardCurve;
use uplift_risk::risk_targeted_level;

use super::TargetOptions;
use crate::error::DesignError;

/// How often it happens given the level of a return period.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LevelShare {
    /// The return period, years.
    pub return_period_years: f64,
    /// Its level by the site's hazard curve, in the unit of the measure.
    pub level: f64,
    /// Records, each scaled to the level.
    pub records: usize,
    /// Runs: every record with every structure that it may shake.
    pub runs: usize,
    /// Those of them in which it happens.
    pub count: usize,
    /// Their share, 0 to 1.
    pub probability: f64,
}

/// The level to design for by a generic lognormal fragility (Luco et al. 2007): risk-targeted, beside that of a return
/// period.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GenericTarget {
    /// Dispersion of the fragility.
    pub dispersion: f64,
    /// Its probability at the level to design for.
    pub probability: f64,
    /// That level, with which the fragility has the target risk, in the unit of the measure.
    pub level: f64,
    /// Median of the fragility, in the unit of the measure.
    pub median: f64,
    /// Share of the risk from above the hazard curve.
    pub upper_tail_share: f64,
    /// The longest return period that was asked for, years.
    pub return_period_years: f64,
    /// Its level; none outside the hazard curve.
    pub uniform_hazard_level: Option<f64>,
    /// Risk-targeted over uniform-hazard level; none without the latter.
    pub risk_coefficient: Option<f64>,
}

/// What the generic fragility that was asked for makes of `curve`; none where none was.
///
/// # Errors
/// A target that no fragility has on this curve.
pub(super) fn generic_target(
    curve: &HazardCurve,
    target_per_year: f64,
    options: &TargetOptions,
) -> Result<Option<GenericTarget>, DesignError> {
    let Some((dispersion, probability)) = options.generic else { return Ok(None) };
    let found = risk_targeted_level(curve, target_per_year, probability, dispersion)?;
    let return_period_years = options.return_periods.iter().copied().fold(0.0, f64::max);
    let uniform_hazard_level = curve.im_at_rate(1.0 / return_period_years).ok();
    Ok(Some(GenericTarget {
        dispersion,
        probability,
        level: found.level,
        median: found.fragility.median(),
        upper_tail_share: found.risk.upper_tail_per_year / found.risk.per_year,
        return_period_years,
        uniform_hazard_level,
        risk_coefficient: uniform_hazard_level.map(|level| found.level / level),
    }))
}
