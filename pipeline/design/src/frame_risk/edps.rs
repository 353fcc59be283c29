//! What the peaks of a frame mean: for its restrainers, in thresholds of displacement, since by symmetry the elongation
//! of a tendon depends on the rotation alone, whichever way the columns lean; and what the second component does to
//! them.

use serde::Serialize;
use uplift_fragility::{Stripes as Stripe, quantile};
use uplift_frame::RockingFrame;
use uplift_risk::{PooledDemand, RunWeights, SiteWeights, StripeWeights};
use uplift_statics::{EventKind, Spring};
use uplift_uniform_risk::EventRisk;

use super::super::risk::{bounded, risk_of_exceeding};
use crate::error::DesignError;

/// How often something happens to the frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EventReport {
    /// What.
    pub event: EventKind,
    /// The displacement of the deck beyond which it happens, m.
    pub displacement_m: f64,
    /// How often.
    #[serde(flatten)]
    pub risk: EventRisk,
    /// The same of records weighted so that they bring the site's hazard; none where the result has no repair.
    pub repaired: Option<EventRisk>,
}

/// Columns and restrainers at the demand of the target rate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StateAtDemand {
    /// Displacement of the deck, m.
    pub displacement_m: f64,
    /// The same over the height of the columns.
    pub drift: f64,
    /// Rotation of the columns, rad.
    pub rotation_rad: f64,
    /// Force of a tendon, N; none without restrainers.
    pub tendon_n: Option<f64>,
    /// The same over the force at which it yields; none where that is not given.
    pub tendon_over_yield: Option<f64>,
    /// Deformation of the springs, m; none without springs of their own.
    pub spring_m: Option<f64>,
    /// The same over the deformation at which they are flat; none for springs that never are.
    pub spring_over_flat: Option<f64>,
    /// Moment at the top of a restrained column as statics has it, N m.
    pub top_moment_n_m: f64,
}

impl StateAtDemand {
    /// At a displacement of the deck, m; none where the frame overturns, or beyond the law of its restrainers.
    pub(super) fn at_displacement(frame: &RockingFrame, displacement_m: f64) -> Option<Self> {
        let columns = frame.columns();
        let state = columns.at_displacement(displacement_m).ok()?;
        let parts = columns.restrainer().map(uplift_statics::Restrainer::parts);
        let yield_n = parts.and_then(|parts| parts.tendon?.yield_n);
        let flat_m = parts.and_then(|parts| match parts.spring {
            Spring::Discs(stack) => Some(stack.flat_deformation_m()),
            Spring::Rigid | Spring::Linear { .. } => None,
        });
        Some(Self {
            displacement_m,
            drift: state.drift,
            rotation_rad: state.rotation_rad,
            tendon_n: parts.map(|_| state.tendon_n),
            tendon_over_yield: yield_n.map(|yield_n| state.tendon_n / yield_n),
            spring_m: state.spring_m,
            spring_over_flat: state.spring_m.zip(flat_m).map(|(spring_m, flat_m)| spring_m / flat_m),
            top_moment_n_m: state.sections.top_moment_n_m,
        })
    }
}

/// How often each event of the frame happens: its peaks are `runs_m` over `[run, level]`, and `records_m` over
/// `[record, level]`, which the weights of a repair are of; `pairs` has the positions of each pair's records.
pub(super) fn events(
    frame: &RockingFrame,
    levels: &[f64],
    (weights, runs_m): (&StripeWeights, &[f64]),
    (repaired, records_m): (Option<&RunWeights>, &[f64]),
    pairs: &[Vec<usize>],
    years: f64,
) -> Result<Vec<EventReport>, DesignError> {
    let pooled = |peaks_m| Ok::<_, DesignError>(PooledDemand::new(&Stripe::new(levels, peaks_m)?)?);
    let (runs, records) = (pooled(runs_m)?, pooled(records_m)?);
    let risk = |weights: SiteWeights<'_>, threshold_m: f64| {
        let pool = if matches!(weights, SiteWeights::Repaired(_)) { &records } else { &runs };
        Ok::<_, DesignError>(bounded(risk_of_exceeding(pool, &weights, threshold_m, years)?, &weights, pairs))
    };
    let of = |event: &uplift_statics::Event| {
        let displacement_m = event.state.displacement_m;
        let repaired = repaired.map(|runs| risk(SiteWeights::Repaired(runs), displacement_m)).transpose()?;
        let risk = risk(SiteWeights::Alike(weights), displacement_m)?;
        Ok(EventReport { event: event.event, displacement_m, risk, repaired })
    };
    frame.columns().events().iter().map(of).collect()
}

/// What the second component does: the wobbling peak over the larger of the planar ones (Section 6.2).
///
/// `U` wobbling over the larger `u` in the plane of each component, of all pairs and levels at which the frame rocks.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DirectionEffect {
    /// Pairs and levels that are counted: all but those at which nothing uplifts, or both models overturn.
    pub runs: usize,
    /// The ratio at 16, 50 and 84 %: infinite where the wobbling frame alone overturns, 0 where it alone stands.
    pub ratio: [f64; 3],
    /// Pairs and levels at which both models overturn.
    pub both_overturn: usize,
    /// Those at which the wobbling frame alone does.
    pub wobbling_overturns: usize,
    /// Those at which the planar one alone does.
    pub planar_overturns: usize,
}

impl DirectionEffect {
    /// From the wobbling peak and the larger planar one of every pair and level, m.
    pub(super) fn from_peaks(directions_m: &[[f64; 2]]) -> Self {
        let mut ratios: Vec<f64> = directions_m
            .iter()
            .filter(|[wobbling, planar]| wobbling.max(*planar) > 0.0 && wobbling.min(*planar).is_finite())
            .map(|[wobbling, planar]| wobbling / planar)
            .collect();
        ratios.sort_by(f64::total_cmp);
        let count = |of: fn(bool, bool) -> bool| {
            directions_m.iter().filter(|[wobbling, planar]| of(wobbling.is_infinite(), planar.is_infinite())).count()
        };
        Self {
            runs: ratios.len(),
            ratio: [0.16, 0.5, 0.84].map(|probability| quantile(&ratios, probability)),
            both_overturn: count(|wobbling, planar| wobbling && planar),
            wobbling_overturns: count(|wobbling, planar| wobbling && !planar),
            planar_overturns: count(|wobbling, planar| !wobbling && planar),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_overturns_is_counted_and_never_dropped() {
        let inf = f64::INFINITY;
        let found =
            DirectionEffect::from_peaks(&[[0.0, 0.0], [0.2, 0.1], [inf, 0.3], [inf, inf], [0.4, inf], [0.1, 0.1]]);
        assert_eq!((found.runs, found.both_overturn, found.wobbling_overturns, found.planar_overturns), (4, 1, 1, 1));
        // of 0, 1, 2 and infinite
        assert_eq!(found.ratio[1], 1.5);
        assert_eq!(found.ratio[2], inf);
    }
}
