//! When the ground moves a frame at rest.

use std::ops::ControlFlow;

use uplift_taylor::{Forcing, first_sign_change, leading_sign, sign_changes};

/// An uplift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Uplift {
    /// When, as a part of the step.
    pub(crate) s: f64,
    /// Direction of the lean, against the ground's acceleration: of its unit vector in a plane only the sign, else any
    /// length.
    pub(crate) towards: [f64; 2],
}

/// First s in [0, 1) at which `|along|` rises above `threshold`, all in units of g.
pub(crate) fn uplift_in_plane(along: &Forcing, threshold: &Forcing) -> Option<Uplift> {
    let least = threshold.value(0.0) - (threshold.bound() - threshold.value(0.0).abs());
    if along.bound() <= least {
        return None;
    }
    let first = |side: f64| {
        let excess = along.times(-side).plus(&threshold.times(-1.0));
        let c = excess.coefficients();
        let s = if leading_sign(c.iter()) > 0.0 { Some(0.0) } else { first_sign_change(c) };
        s.map(|s| Uplift { s, towards: [side, 0.0] })
    };
    match (first(1.0), first(-1.0)) {
        (Some(one), Some(other)) => Some(if other.s < one.s { other } else { one }),
        (one, other) => one.or(other),
    }
}

/// First s in [0, 1) at which `a_x² + a_y²` rises above `threshold²`, all in units of g.
pub(crate) fn uplift_in_space([x, y]: [&Forcing; 2], threshold: &Forcing) -> Option<Uplift> {
    let least = threshold.value(0.0) - (threshold.bound() - threshold.value(0.0).abs());
    if x.bound().hypot(y.bound()) <= least {
        return None;
    }
    let excess = x.product(x).plus(&y.product(y)).plus(&threshold.product(threshold).times(-1.0));
    let c = excess.coefficients();
    let s = if leading_sign(c.iter()) > 0.0 {
        0.0
    } else {
        let mut first = None;
        let _ = sign_changes(c, &mut |s| {
            first = Some(s);
            ControlFlow::Break(())
        });
        first?
    };
    Some(Uplift { s, towards: [-x.value(s), -y.value(s)] })
}
