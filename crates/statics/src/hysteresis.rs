//! Measured loops of force over displacement: what they enclose, and how they soften.
//!
//! A cycle runs from one crossing of zero displacement upwards to the next. It encloses `∮F du`, the energy that it
//! dissipates; over `2π` times the product of the largest displacement and the force of the secant through the extremes
//! that is the equivalent viscous damping ratio, `ζ = ∮F du/(4π E_s)` with `E_s = ½ k_s u²`,
//! `k_s = (F⁺ − F⁻)/(u⁺ − u⁻)` and `u = (u⁺ − u⁻)/2`.

use std::f64::consts::PI;

use crate::error::{StaticsError, require};

/// A cycle of a measured loop.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct LoopCycle {
    /// Largest displacement, m.
    pub largest_m: f64,
    /// Least displacement, m.
    pub least_m: f64,
    /// Force at the largest displacement, N.
    pub force_at_largest_n: f64,
    /// Force at the least displacement, N.
    pub force_at_least_n: f64,
    /// Energy that the cycle dissipates, `∮F du`, J.
    pub dissipated_j: f64,
    /// Equivalent viscous damping ratio; none where the secant through the extremes does not rise.
    pub equivalent_damping: Option<f64>,
}

/// A measured loop.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct MeasuredLoop {
    /// Displacement and force, m and N.
    #[serde(skip)]
    pub points: Vec<(f64, f64)>,
    /// Whole cycles, in their order.
    pub cycles: Vec<LoopCycle>,
    /// Largest force, N, and the displacement where it was measured, m.
    pub peak: (f64, f64),
    /// Least force, N, and the displacement where it was measured, m.
    pub trough: (f64, f64),
    /// Energy of all that was measured, `∫F du`, J.
    pub work_j: f64,
}

impl MeasuredLoop {
    /// From displacements (m) and forces (N) in the order of their measurement.
    ///
    /// # Errors
    /// There must be three points or more, and all must be finite.
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, StaticsError> {
        let count = points.len() as f64;
        require(points.len() >= 3, "points", count, "", "at least 3")?;
        for (displacement_m, force_n) in &points {
            require(displacement_m.is_finite(), "displacement_m", *displacement_m, "m", "finite")?;
            require(force_n.is_finite(), "force_n", *force_n, "N", "finite")?;
        }
        let extreme = |better: fn(f64, f64) -> bool| {
            points.iter().fold(points[0], |best, point| if better(point.1, best.1) { *point } else { best })
        };
        let (peak, trough) = (extreme(|a, b| a > b), extreme(|a, b| a < b));
        let upward: Vec<usize> =
            (1..points.len()).filter(|&index| points[index - 1].0 < 0.0 && points[index].0 >= 0.0).collect();
        // the first cycle may begin at rest rather than at a crossing
        let starts_at_rest =
            points[0].0 == 0.0 && points.iter().find(|point| point.0 != 0.0).is_some_and(|p| p.0 > 0.0);
        let mut ends = if starts_at_rest { vec![0] } else { Vec::new() };
        ends.extend(upward);
        let last = points.len() - 1;
        if ends.last().is_some_and(|&end| end < last) && points[last].0 == 0.0 && points[last - 1].0 < 0.0 {
            ends.push(last);
        }
        let cycles = ends.windows(2).map(|ends| cycle(&points[ends[0]..=ends[1]])).collect();
        let work_j = work_j(&points);
        Ok(Self { peak: (peak.1, peak.0), trough: (trough.1, trough.0), cycles, work_j, points })
    }

    /// Slope of the secant of the loading branch of the largest cycle between two displacements (m) of the same sign,
    /// N/m: the first passage of each on the way to the extreme on that side. None where it does not reach them.
    pub fn loading_slope_n_m(&self, from_m: f64, to_m: f64) -> Option<f64> {
        let side = if to_m < 0.0 { -1.0 } else { 1.0 };
        let (top, _) =
            self.points.iter().enumerate().max_by(|left, right| (side * left.1.0).total_cmp(&(side * right.1.0)))?;
        // backwards from the extreme to where the branch began
        let branch: Vec<(f64, f64)> = self.points[..=top].iter().rev().copied().collect();
        let force_at = |at_m: f64| {
            branch.windows(2).find_map(|ends| {
                let [(far_m, far_n), (near_m, near_n)] = [ends[0], ends[1]];
                let within = side * far_m >= side * at_m && side * near_m < side * at_m;
                within.then(|| near_n + (far_n - near_n) * (at_m - near_m) / (far_m - near_m))
            })
        };
        Some((force_at(to_m)? - force_at(from_m)?) / (to_m - from_m))
    }
}

/// `∫F du` by the trapezoidal rule.
fn work_j(points: &[(f64, f64)]) -> f64 {
    points.windows(2).map(|ends| 0.5 * (ends[0].1 + ends[1].1) * (ends[1].0 - ends[0].0)).sum()
}

fn cycle(points: &[(f64, f64)]) -> LoopCycle {
    let furthest = |side: f64| {
        points.iter().fold(points[0], |best, point| if side * point.0 > side * best.0 { *point } else { best })
    };
    let ((largest_m, force_at_largest_n), (least_m, force_at_least_n)) = (furthest(1.0), furthest(-1.0));
    let (first, last) = (points[0], points[points.len() - 1]);
    // closed, so that a loop cut a little beyond zero does not count that little
    let dissipated_j = work_j(points) + 0.5 * (first.1 + last.1) * (first.0 - last.0);
    let range_m = largest_m - least_m;
    let secant_n_m = (force_at_largest_n - force_at_least_n) / range_m;
    let stored_j = 0.5 * secant_n_m * (0.5 * range_m).powi(2);
    LoopCycle {
        largest_m,
        least_m,
        force_at_largest_n,
        force_at_least_n,
        dissipated_j,
        equivalent_damping: (stored_j > 0.0).then(|| dissipated_j / (4.0 * PI * stored_j)),
    }
}
