//! The two-sample test of Anderson and Darling: squared distances weighted by `1/H(1 − H)` of the pooled distribution.
//!
//! Standardised, `(A² − 1)/σ` with the variance of `A²` under equal distributions.
//!
//! # Source
//! F. W. Scholz and M. A. Stephens (1987), "K-sample Anderson–Darling tests", Eq. 3, 4, 6 and 7 with k = 2.

use crate::sample::{Sample, distinct};

/// Standardised statistics.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct AndersonDarling {
    /// With midranks for ties.
    pub midrank: f64,
    /// With right-continuous empirical distributions.
    pub right: f64,
}

impl AndersonDarling {
    /// Of two samples.
    ///
    /// The statistics are NaN-free: with all values equal, or fewer than four together, they are 0.
    pub fn from_samples(one: &Sample, other: &Sample) -> Self {
        let (n, m) = (one.len() as f64, other.len() as f64);
        let total = n + m;
        let values = distinct(one, other);
        if values.len() < 2 || total < 4.0 {
            return Self { midrank: 0.0, right: 0.0 };
        }
        let (mut midrank, mut right) = ([0.0; 2], [0.0; 2]);
        let (mut below, mut below_each) = (0.0, [0.0; 2]);
        for (index, (_, of_one, of_other)) in values.iter().enumerate() {
            let each = [*of_one as f64, *of_other as f64];
            let tied = each[0] + each[1];
            let middle = below + 0.5 * tied;
            let up_to = below + tied;
            for sample in 0..2 {
                let size = [n, m][sample];
                let at_middle = below_each[sample] + 0.5 * each[sample];
                let weight = middle * (total - middle) - 0.25 * total * tied;
                midrank[sample] += tied / total * (total * at_middle - middle * size).powi(2) / weight;
                if index + 1 < values.len() {
                    let up_to_each = below_each[sample] + each[sample];
                    right[sample] +=
                        tied / total * (total * up_to_each - up_to * size).powi(2) / (up_to * (total - up_to));
                }
            }
            below = up_to;
            below_each = [below_each[0] + each[0], below_each[1] + each[1]];
        }
        let deviation = variance(one.len(), other.len()).sqrt();
        let midrank = (total - 1.0) / total * (midrank[0] / n + midrank[1] / m);
        let right = right[0] / n + right[1] / m;
        Self { midrank: (midrank - 1.0) / deviation, right: (right - 1.0) / deviation }
    }
}

/// Variance of `A²` for two samples.
fn variance(n: usize, m: usize) -> f64 {
    let (k, count) = (2.0, n + m);
    let total = count as f64;
    let reciprocals = 1.0 / n as f64 + 1.0 / m as f64;
    let h: f64 = (1..count).map(|i| 1.0 / i as f64).sum();
    // Σ_{i=1}^{N−2} Σ_{j=i+1}^{N−1} 1/((N − i) j)
    let mut tail = 0.0;
    let mut g = 0.0;
    for i in (1..count - 1).rev() {
        tail += 1.0 / (i + 1) as f64;
        g += tail / (count - i) as f64;
    }
    let a = (4.0 * g - 6.0) * (k - 1.0) + (10.0 - 6.0 * g) * reciprocals;
    let b = (2.0 * g - 4.0) * k * k + 8.0 * h * k + (2.0 * g - 14.0 * h - 4.0) * reciprocals - 8.0 * h + 4.0 * g - 6.0;
    let c = (6.0 * h + 2.0 * g - 2.0) * k * k + (4.0 * h - 4.0 * g + 6.0) * k + (2.0 * h - 6.0) * reciprocals + 4.0 * h;
    let d = (2.0 * h + 6.0) * k * k - 4.0 * h * k;
    (a * total.powi(3) + b * total.powi(2) + c * total + d) / ((total - 1.0) * (total - 2.0) * (total - 3.0))
}
