//! What a displacement of the deck means for the restrainers: thresholds of displacement, since by symmetry the
//! elongation of a tendon depends on the rotation alone, whichever way the columns lean.

use serde::Serialize;
use uplift_fragility::Stripes as Stripe;
use uplift_frame::RockingFrame;
use uplift_risk::{PooledDemand, RunWeights, StripeWeights};
use uplift_statics::{EventKind, Spring};
use uplift_uniform_risk::EventRisk;

use super::super::risk::{bounded, risk_of_exceeding};
use super::super::weights::SiteWeights;
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
    pub(super) fn of(frame: &RockingFrame, displacement_m: f64) -> Option<Self> {
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
