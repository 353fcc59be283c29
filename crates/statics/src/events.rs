//! What happens to the columns on the way, and where.

use std::f64::consts::FRAC_PI_2;

use crate::columns::{PushoverState, RestrainedColumns};
use crate::restrainer::Threshold;

/// What happens at a displacement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum EventKind {
    /// The columns begin to tilt.
    Uplift,
    /// A loose tendon is taut.
    SlackTaken,
    /// A shifted tendon touches its duct.
    TendonTouches,
    /// The stoppers engage.
    StopperEngages,
    /// The stoppers yield.
    StopperYields,
    /// The springs are flat.
    SpringsFlat,
    /// The tendon yields.
    TendonYields,
    /// The tendon, or its socket, fails.
    TendonFails,
    /// The force vanishes: neutral equilibrium.
    Neutral,
}

impl EventKind {
    /// The event in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Uplift => "uplift",
            Self::SlackTaken => "slack is taken up",
            Self::TendonTouches => "tendon touches the duct",
            Self::StopperEngages => "stopper engages",
            Self::StopperYields => "stopper yields",
            Self::SpringsFlat => "springs are flat",
            Self::TendonYields => "tendon yields",
            Self::TendonFails => "tendon fails",
            Self::Neutral => "neutral equilibrium",
        }
    }
}

/// An event with everything at the displacement where it happens.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Event {
    /// What happens.
    pub event: EventKind,
    /// Columns and restrainers there; at uplift just before it, at no rotation.
    #[serde(flatten)]
    pub state: PushoverState,
}

impl RestrainedColumns {
    /// Everything that happens up to a quarter turn of the columns, or to where the springs stop them, by rising
    /// displacement. Beyond a tendon's yield or failure the law is that of an elastic tendon.
    pub fn events(&self) -> Vec<Event> {
        let last_rad = self.last_rotation_rad();
        let mut found = vec![(EventKind::Uplift, 0.0)];
        if let Some(restrainer) = self.restrainer() {
            let kinds = [
                (Threshold::Taut, EventKind::SlackTaken),
                (Threshold::StopperEngages, EventKind::StopperEngages),
                (Threshold::StopperYields, EventKind::StopperYields),
                (Threshold::SpringsFlat, EventKind::SpringsFlat),
            ];
            let mut elongations: Vec<(EventKind, f64)> = kinds
                .iter()
                .filter_map(|(threshold, kind)| Some((*kind, restrainer.elongation_at_m(*threshold)?)))
                .filter(|(kind, elongation_m)| *kind != EventKind::SlackTaken || *elongation_m > 0.0)
                .collect();
            let tendon = restrainer.parts().tendon;
            for (kind, force_n) in [
                (EventKind::TendonYields, tendon.and_then(|tendon| tendon.yield_n)),
                (EventKind::TendonFails, tendon.and_then(|tendon| tendon.failure_n)),
            ] {
                let elongation_m = force_n.and_then(|force_n| restrainer.elongation_at_force_m(force_n));
                elongations.extend(elongation_m.map(|elongation_m| (kind, elongation_m)));
            }
            found.extend(elongations.iter().filter_map(|(kind, elongation_m)| {
                self.rotation_at_elongation_rad(*elongation_m).map(|rotation_rad| (*kind, rotation_rad))
            }));
            let touch = self.path().touch_rotation_rad(self.geometry());
            found.extend(touch.map(|rotation_rad| (EventKind::TendonTouches, rotation_rad)));
        }
        let neutral = self.neutral_rotations_rad(last_rad.min(FRAC_PI_2));
        found.extend(neutral.into_iter().map(|rotation_rad| (EventKind::Neutral, rotation_rad)));
        // the rotation of the last threshold is that of the limit itself, but for its rounding
        found.retain(|(_, rotation_rad)| *rotation_rad <= last_rad * (1.0 + 1e-12));
        found.sort_by(|left, right| left.1.total_cmp(&right.1));
        found
            .into_iter()
            .filter_map(|(event, rotation_rad)| {
                let state = self.at_rotation(rotation_rad.min(last_rad)).ok()?;
                Some(Event { event, state })
            })
            .collect()
    }

    /// The first event of a kind.
    pub fn first(&self, kind: EventKind) -> Option<Event> {
        self.events().into_iter().find(|event| event.event == kind)
    }
}
