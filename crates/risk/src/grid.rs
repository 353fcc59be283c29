//! The grid of displacement thresholds on which the dissertation reads its contours.

use crate::RiskError;

/// Displacement thresholds, m: finite, strictly increasing from 0.
#[derive(Debug, Clone, PartialEq)]
pub struct ThresholdGrid {
    thresholds_m: Vec<f64>,
}

impl Default for ThresholdGrid {
    /// The 3002 thresholds of Section 4.3.3: 0 to 3 m in steps of 0.001 m, and the uplift displacement 0.0005 m.
    fn default() -> Self {
        // Divided, not multiplied: every threshold is the double nearest to its decimal.
        let millimetres = (1..=3000).map(|i| f64::from(i) / 1000.0);
        Self { thresholds_m: [0.0, 0.0005].into_iter().chain(millimetres).collect() }
    }
}

impl ThresholdGrid {
    /// From thresholds in m.
    ///
    /// # Errors
    /// Fewer than two thresholds, a first one other than 0, one that is not finite or not above the one before.
    pub fn new(thresholds_m: Vec<f64>) -> Result<Self, RiskError> {
        let mut floor = f64::NEG_INFINITY;
        for (index, &value) in thresholds_m.iter().enumerate() {
            if !value.is_finite() || value <= floor || (index == 0 && value != 0.0) {
                return Err(RiskError::Grid { index, value });
            }
            floor = value;
        }
        if thresholds_m.len() < 2 {
            return Err(RiskError::Grid { index: thresholds_m.len(), value: f64::NAN });
        }
        Ok(Self { thresholds_m })
    }

    /// The thresholds, m.
    pub fn thresholds_m(&self) -> &[f64] {
        &self.thresholds_m
    }
}

/// Where a line of ln λ over displacement between `left` and `right`, each (m, 1/yr), meets the rate `target`.
///
/// λ falls from above the target to at most the target. Where it falls to 0 there is no logarithm, and the answer is
/// the right end: the first threshold whose rate meets the target.
pub(crate) fn interpolate_log_rate(left: (f64, f64), right: (f64, f64), target: f64) -> f64 {
    if right.1 <= 0.0 {
        return right.0;
    }
    let fraction = (left.1 / target).ln() / (left.1 / right.1).ln();
    (left.0 + fraction * (right.0 - left.0)).clamp(left.0, right.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_of_the_dissertation() {
        let grid = ThresholdGrid::default();
        let thresholds = grid.thresholds_m();
        assert_eq!(thresholds.len(), 3002);
        assert_eq!(thresholds[..4], [0.0, 0.0005, 0.001, 0.002]);
        assert_eq!((thresholds[10], thresholds[2001], thresholds[3001]), (0.009, 2.0, 3.0));
        assert_eq!(ThresholdGrid::new(thresholds.to_vec()).unwrap(), grid);
    }

    #[test]
    fn refuses_what_does_not_rise_from_zero() {
        for (thresholds, index) in [
            (vec![], 0),
            (vec![0.0], 1),
            (vec![0.1, 0.2], 0),
            (vec![0.0, 0.0], 1),
            (vec![0.0, f64::INFINITY], 1),
            (vec![0.0, f64::NAN], 1),
        ] {
            assert!(matches!(ThresholdGrid::new(thresholds), Err(RiskError::Grid { index: at, .. }) if at == index));
        }
    }

    #[test]
    fn a_decade_is_halved_at_its_geometric_middle() {
        let half = interpolate_log_rate((0.2, 1e-2), (0.4, 1e-4), 1e-3);
        assert!((half - 0.3).abs() < 1e-15);
        assert_eq!(interpolate_log_rate((0.2, 1e-2), (0.4, 1e-3), 1e-3), 0.4);
        assert_eq!(interpolate_log_rate((0.2, 1e-2), (0.4, 0.0), 1e-3), 0.4);
    }
}
