//! Where a risk comes from.

/// The terms of the risk integral (Eq. 4.4) at one displacement, 1/yr: which intensities contribute how much.
#[derive(Debug, Clone, PartialEq)]
pub struct Disaggregation {
    /// From below the first stripe, ½ P₁ (λ₀ − λ₁), 1/yr.
    pub lower_tail_per_year: f64,
    /// From between stripes i and i + 1, ½ (Pᵢ + Pᵢ₊₁)(λᵢ − λᵢ₊₁), 1/yr, `[level − 1]`.
    pub intervals_per_year: Vec<f64>,
    /// From above the last stripe, Pₘ λₘ, 1/yr.
    pub upper_tail_per_year: f64,
}

impl Disaggregation {
    /// The sum of all terms, 1/yr: the mean annual frequency. Added from the upper tail, the smallest rates, downwards.
    pub fn total_per_year(&self) -> f64 {
        let intervals = self.intervals_per_year.iter().rev();
        intervals.fold(self.upper_tail_per_year, |sum, term| sum + term) + self.lower_tail_per_year
    }
}
