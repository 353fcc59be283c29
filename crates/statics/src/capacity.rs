//! Where the columns are in neutral equilibrium: the displacement capacity.

use crate::columns::RestrainedColumns;
use crate::restrainer::{Restrainer, Threshold};
use crate::root::{bisect, minimum};
use crate::tilt::travel_m;

/// Parts that each smooth piece is searched in: between two of them the force has one extreme at most.
const PARTS: u32 = 400;

/// A rotation at which no force holds the columns.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Capacity {
    /// Rotation, rad.
    pub rotation_rad: f64,
    /// Displacement capacity `u_cap`, m.
    pub displacement_m: f64,
    /// Secant stiffness `(T − T0)/Δ` of a restrainer there, N/m; none without one.
    pub secant_n_m: Option<f64>,
    /// Deformation of its springs there, m.
    pub spring_m: Option<f64>,
}

impl RestrainedColumns {
    /// The displacement capacity: the first zero of the force before the springs are flat and within four times the
    /// slenderness; none where the force stays above zero.
    pub fn capacity(&self) -> Option<Capacity> {
        let rotation_rad = self.neutral_rotations_rad(self.last_searched_rad()).into_iter().next()?;
        let state = self.at_rotation(rotation_rad).ok()?;
        let secant_n_m =
            self.restrainer().map(|restrainer| (state.tendon_n - restrainer.parts().prestress_n) / state.elongation_m);
        Some(Capacity {
            rotation_rad,
            displacement_m: travel_m(self.geometry(), rotation_rad),
            secant_n_m,
            spring_m: state.spring_m,
        })
    }

    /// The last rotation at which a displacement capacity is sought: where the springs are flat, at most four times the
    /// slenderness, rad.
    pub(crate) fn last_searched_rad(&self) -> f64 {
        let flat_m = self.restrainer().and_then(|restrainer| restrainer.elongation_at_m(Threshold::SpringsFlat));
        let flat_rad = flat_m.and_then(|flat_m| self.rotation_at_elongation_rad(flat_m)).unwrap_or(f64::INFINITY);
        (4.0 * self.geometry().slenderness_rad()).min(flat_rad).min(self.last_rotation_rad())
    }

    /// Every rotation up to `last_rad` (rad) at which the force changes its sign, by rising rotation, rad.
    ///
    /// The force is smooth between thresholds of restrainer and path. Each such piece is searched in parts, and a part
    /// in which the force is least but not yet negative is searched for its least value, so that two zeros close to
    /// each other are found too.
    pub fn neutral_rotations_rad(&self, last_rad: f64) -> Vec<f64> {
        let mut knots = self.threshold_rotations_rad();
        knots.retain(|rad| *rad > 0.0 && *rad < last_rad);
        knots.insert(0, 0.0);
        knots.push(last_rad);
        // dV/dθ has the sign of the force, and is finite where the force is not
        let moment = |rotation: f64| self.moment_n_m(rotation.min(last_rad));
        let mut zeros: Vec<f64> = Vec::new();
        for ends in knots.windows(2) {
            let step = (ends[1] - ends[0]) / f64::from(PARTS);
            let place = |part: u32| if part == PARTS { ends[1] } else { ends[0] + f64::from(part) * step };
            let values: Vec<f64> = (0..=PARTS).map(|part| moment(place(part))).collect();
            let mut add = |low: f64, high: f64| {
                if (moment(low) <= 0.0) != (moment(high) <= 0.0) {
                    zeros.push(bisect(low, high, moment));
                }
            };
            for part in 0..PARTS {
                let (left, right) = (values[part as usize], values[part as usize + 1]);
                let before = part.checked_sub(1).map_or(f64::INFINITY, |before| values[before as usize]);
                if (left <= 0.0) != (right <= 0.0) {
                    add(place(part), place(part + 1));
                } else if left > 0.0 && left <= before && left <= right && part > 0 {
                    let least = minimum(place(part - 1), place(part + 1), moment);
                    if moment(least) < 0.0 {
                        add(place(part - 1), least);
                        add(least, place(part + 1));
                    }
                }
            }
        }
        zeros.sort_by(f64::total_cmp);
        zeros
    }

    /// Rotations at which the law changes, by rising rotation, rad: thresholds of the restrainer and the touch of a
    /// shifted tendon.
    pub fn threshold_rotations_rad(&self) -> Vec<f64> {
        let elongations = self.restrainer().map(Restrainer::pieces).unwrap_or_default();
        let mut rotations: Vec<f64> = elongations
            .iter()
            .filter(|piece| piece.from_elongation_m > 0.0)
            .filter_map(|piece| self.rotation_at_elongation_rad(piece.from_elongation_m))
            .chain(self.restrainer().and_then(|_| self.path().touch_rotation_rad(self.geometry())))
            .collect();
        rotations.sort_by(f64::total_cmp);
        rotations
    }

    /// `dV/dθ = N W 2R sin(α − θ) + T Δ'` of all columns, N m; the law's last value beyond its end.
    pub fn moment_n_m(&self, rotation_rad: f64) -> f64 {
        let geometry = self.geometry();
        let elongation = self.elongation(rotation_rad);
        let limit_m = self.restrainer().and_then(Restrainer::limit_m).unwrap_or(f64::INFINITY);
        let held = self.restrainer().and_then(|restrainer| restrainer.at(elongation.elongation_m.min(limit_m)).ok());
        let lever_m = 2.0 * geometry.size_m() * (geometry.slenderness_rad() - rotation_rad).sin();
        f64::from(self.columns()) * self.weight_n() * lever_m
            + f64::from(self.restrained()) * held.map_or(0.0, |state| state.force_n * elongation.rate_m)
    }

    /// Slope of the secant of the force between two drift ratios `u/2h`, N/m.
    ///
    /// # Errors
    /// Both must be within the column's reach and before the springs stop it.
    pub fn slope_between_drifts_n_m(&self, from: f64, to: f64) -> Result<f64, crate::StaticsError> {
        let height_m = self.geometry().height_m();
        let force_n = |drift: f64| self.at_displacement(drift * height_m).map(|state| state.force_n);
        Ok((force_n(to)? - force_n(from)?) / ((to - from) * height_m))
    }
}
