//! What a frame must not pass before it overturns. A tendon that is taken as elastic pulls a frame back from far beyond
//! its capacity, so that the frame seldom overturns; how often it fails is then how often it passes this limit.

use serde::Serialize;
use uplift_job::text::to_the_centimetre;
use uplift_risk::{PooledDemand, RunWeights, SiteWeights};
use uplift_statics::{EventKind, RestrainedColumns};
use uplift_study::Structure;
use uplift_uniform_risk::EventRisk;

use super::certainty::{Bands, Scatter, rate_bands};
use super::hazard::Hazard;
use super::risk::{bounded, risk_of_exceeding};
use crate::error::DesignError;

/// From how many times the rate of overturning on passing the limit governs: below, both are within each other's bands.
const GOVERNS: f64 = 1.25;

/// What a frame passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LimitEvent {
    /// Its displacement capacity.
    Capacity,
    /// The yield of its tendons.
    TendonYields,
    /// Their failure.
    TendonFails,
}

impl LimitEvent {
    /// What it is.
    pub fn noun(self) -> &'static str {
        match self {
            Self::Capacity => "capacity",
            Self::TendonYields => "tendon yield",
            Self::TendonFails => "tendon failure",
        }
    }

    /// What the frame does, beside `overturns`.
    pub fn words(self) -> &'static str {
        match self {
            Self::Capacity => "passes capacity",
            Self::TendonYields => EventKind::TendonYields.words(),
            Self::TendonFails => EventKind::TendonFails.words(),
        }
    }
}

/// The first that a frame passes of its displacement capacity and the yield and failure of its tendons.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FrameLimit {
    /// Which it is.
    pub event: LimitEvent,
    /// The displacement of the deck there, m.
    pub displacement_m: f64,
}

impl FrameLimit {
    /// Of a structure with these columns; none of one that has neither.
    pub(super) fn from_structure(structure: &Structure, columns: Option<&RestrainedColumns>) -> Option<Self> {
        let capacity_m = structure.system.capacity_m();
        let capacity = capacity_m.map(|displacement_m| Self { event: LimitEvent::Capacity, displacement_m });
        let of_tendons = columns.and_then(Self::from_tendons);
        capacity.into_iter().chain(of_tendons).min_by(|a, b| a.displacement_m.total_cmp(&b.displacement_m))
    }

    /// Of the tendons of `columns` alone; none of columns whose tendons neither yield nor fail.
    pub(super) fn from_tendons(columns: &RestrainedColumns) -> Option<Self> {
        let limit_of = |kind| match kind {
            EventKind::TendonYields => Some(LimitEvent::TendonYields),
            EventKind::TendonFails => Some(LimitEvent::TendonFails),
            _ => None,
        };
        let all = columns.events().into_iter().filter_map(|found| {
            Some(Self { event: limit_of(found.event)?, displacement_m: found.state.displacement_m })
        });
        all.min_by(|a, b| a.displacement_m.total_cmp(&b.displacement_m))
    }

    /// What the frame does, with the displacement where it is not the capacity, which is told beside it.
    pub fn in_heading(&self) -> String {
        match self.event {
            LimitEvent::Capacity => self.event.words().to_owned(),
            _ => format!("{} at {} m", self.event.words(), to_the_centimetre(self.displacement_m)),
        }
    }

    /// `capacity 0.53 m`.
    pub fn in_words(&self) -> String {
        let at = if self.event == LimitEvent::Capacity { "" } else { "at " };
        format!("{} {at}{} m", self.event.noun(), to_the_centimetre(self.displacement_m))
    }
}

/// How often the limit of a structure is passed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LimitRisk {
    /// How often.
    #[serde(flatten)]
    pub risk: EventRisk,
    /// Its confidence band by the records; none where no run shows it, and of a single record.
    pub bands: Option<Bands>,
}

impl LimitRisk {
    /// Of a model whose peaks exceed `threshold_m` where the frame passes its limit.
    pub(super) fn new(
        demand: &PooledDemand,
        (hazard, repaired): (&Hazard<'_>, Option<&RunWeights>),
        scatter: &Scatter,
        (threshold_m, years): (f64, f64),
    ) -> Result<Self, DesignError> {
        let weights = SiteWeights::new(hazard.mean, repaired);
        let risk = risk_of_exceeding(demand, &weights, threshold_m, years)?;
        Ok(Self {
            risk: bounded(risk, &weights, &scatter.pairs),
            bands: rate_bands(demand, (hazard, repaired), scatter, threshold_m)?,
        })
    }

    /// Whether it, and not `overturning`, tells how often the frame fails.
    pub fn governs(&self, overturning: &EventRisk) -> bool {
        self.risk.per_year > GOVERNS * overturning.per_year
    }
}
