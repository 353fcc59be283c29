//! What a wobbling frame loses: the restitution of planar rocking, spread evenly over the turning of the lean.
//!
//! In a plane the point of contact jumps across the base, and a part of the velocity is lost at once (Eq. 6.5). A
//! wobbling column rolls the same way along its rim. Let a rim of many small corners keep the same part of the momentum
//! `L = J φ̇` at each: then a radian of turning takes a fixed part of it,
//!
//! `L̇ = … − 2λ |φ̇| L`,
//!
//! a moment that resists rolling as the square of its velocity. It takes the power `2λ |φ̇| L²/J`, never negative, and
//! free motion has `L e^{2λ|φ|}` for an invariant in place of `L`.
//!
//! Close by the upright, `J → c θ²`, this has a solution in closed form. With `κ² = c/M` and `ν² = κ² − λ²`,
//!
//! `1/θ = A e^{λφ} cos(νφ − β)`, `L = L₀ e^{−2λφ}`,
//!
//! a spiral in place of the straight line in the developed cone. Far before and far behind the upright the velocities
//! have the ratio `e^{−πλ/ν}`, which is the restitution `r`: so `λ = κ l/√(1 + l²)` with `l = −ln r/π`, and as `L → 0`
//! the motion is that of the planar model with this `r`.
//!
//! # Source
//! The resistance: Dynamics of a Spinning Disk, Journal of Applied Mechanics 83 (2016) 061003, finds in experiments a
//! rolling friction that grows with the square of the rolling velocity. The corners: T. Baranyai, P. L. Várkonyi,
//! Imperfections, impacts, and the singularity of Euler's disk, arXiv:1706.10205 (2017), follow a disk whose rim is a
//! polygon through its impacts. The restitution: G. W. Housner, The behavior of inverted pendulum structures
//! during earthquakes, Bulletin of the Seismological Society of America 53 (1963) 403–417. That both are one number is
//! a choice of this program.

/// The smallest restitution of a wobbling frame: with less its rim would drag it to a stop beside the upright.
pub const LEAST_RESTITUTION: f64 = 0.1;

/// The loss of a frame by rolling.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rolling {
    /// `λ`: half the part of the momentum that a radian of turning takes; 0 where nothing is lost.
    pub(crate) loss: f64,
    /// `ν`.
    frequency: f64,
}

/// A passage close by the upright, from a rotation inwards to where it is as far behind in phase.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Passage {
    pub(crate) rotation_rad: f64,
    /// Outwards.
    pub(crate) velocity_rad_s: f64,
    /// Turn of the lean, to the side of the momentum.
    pub(crate) turn_rad: f64,
    /// Part of the momentum.
    pub(crate) momentum_kept: f64,
    pub(crate) duration_s: f64,
}

impl Rolling {
    /// That of a frame of the cone `κ` with the restitution `r`, at least [`LEAST_RESTITUTION`].
    pub(crate) fn new(kappa: f64, restitution: f64) -> Self {
        let decrement = -restitution.max(LEAST_RESTITUTION).ln() / std::f64::consts::PI;
        let frequency = kappa / 1.0_f64.hypot(decrement);
        Self { loss: decrement * frequency, frequency }
    }

    /// The passage from the rotation `θ` with the speed `|ω|` inwards and `θ|φ̇|` across; none where the upright is not
    /// ahead.
    pub(crate) fn passage(&self, rotation_rad: f64, speed_rad_s: f64, across_rad_s: f64) -> Option<Passage> {
        let Self { loss, frequency } = *self;
        let ahead = speed_rad_s - loss * across_rad_s;
        if !(ahead > 0.0) {
            return None;
        }
        let beside = frequency * across_rad_s;
        let turn_rad = 2.0 * ahead.atan2(beside) / frequency;
        let kept = (-loss * turn_rad).exp();
        Some(Passage {
            rotation_rad: kept * rotation_rad,
            velocity_rad_s: kept * (ahead - loss * across_rad_s),
            turn_rad,
            momentum_kept: kept * kept,
            duration_s: 2.0 * rotation_rad * ahead / (ahead * ahead + beside * beside),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_passage_far_from_the_upright_keeps_the_restitution() {
        for restitution in [0.3, 0.9, 0.95, 0.999] {
            let rolling = Rolling::new(0.98, restitution);
            let passage = rolling.passage(1e-3, 0.2, 1e-12).unwrap();
            assert!((passage.velocity_rad_s / 0.2 / restitution - 1.0).abs() < 1e-10, "{restitution}: {passage:?}");
            // the momentum loses twice as much: the path ends closer to the upright by the other half
            assert!((passage.momentum_kept / restitution.powi(2) - 1.0).abs() < 1e-10);
        }
    }

    #[test]
    fn without_loss_the_passage_is_a_straight_line_in_the_developed_cone() {
        let (kappa, rotation, speed, across) = (0.98, 1e-3, 0.2, 0.05);
        let passage = Rolling::new(kappa, 1.0).passage(rotation, speed, across).unwrap();
        assert_eq!((passage.rotation_rad, passage.velocity_rad_s, passage.momentum_kept), (rotation, speed, 1.0));
        // half the angle at the apex of the cone: tan = |ω|/(κ θ|φ̇|)
        assert!((passage.turn_rad - 2.0 / kappa * (speed / (kappa * across)).atan()).abs() < 1e-15);
    }

    #[test]
    fn where_the_upright_is_not_ahead_there_is_no_passage() {
        let rolling = Rolling::new(0.98, 0.5);
        assert!(rolling.passage(1e-3, 1e-3, 1.0).is_none() && rolling.passage(1e-3, f64::NAN, 0.0).is_none());
    }
}
