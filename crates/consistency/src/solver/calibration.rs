//! What the exponents hold at the site's hazard.

use super::{Care, FIT_RATES, Solver};
use crate::ConsistencyError;
use crate::exponent::{Exponents, KNOTS};
use crate::scratch::Scratch;

impl Solver<'_> {
    /// How each record moves the combinations of the implied rates that the fit holds at those of the site,
    /// `Σ_n ∂ln λ̂_n/∂b_k ln(λ̂_n/ρ_n)`: as many as there are exponents, `[combination][record]`. Drawn once more, it
    /// moves the rate n by `Σ_i w_i p_ij (1[y_ij > y_n] − F_in)`, with F the share of the stripe above `y_n`.
    ///
    /// - `multiplicities`: how often each record counts, `[record]`; a record that is not drawn moves nothing.
    /// - `exponents`, `shares`: those of the fit, `[level, record]`.
    ///
    /// # Errors
    /// As [`shares`](Self::shares).
    pub fn calibration(
        &self,
        multiplicities: &[u32],
        exponents: &Exponents,
        scratch: &mut Scratch,
        shares: &[f64],
    ) -> Result<Vec<Vec<f64>>, ConsistencyError> {
        scratch.draw(self.analysis.set(), multiplicities)?;
        let residuals = self.residuals(exponents, scratch, Care::All);
        let implied: [f64; FIT_RATES] = std::array::from_fn(|n| self.rates[n] * residuals.values[n].exp());
        let (set, records) = (self.analysis.set(), self.analysis.set().len());
        let mut calibration = vec![vec![0.0; records]; KNOTS];
        let levels = self.stripe_weights.iter().zip(&self.above).zip(shares.chunks_exact(records.max(1)));
        for (level, ((weight, above), shares)) in levels.enumerate() {
            let order = set.order(level);
            let exceeded = above.map(|above| order[..above].iter().map(|&record| shares[record]).sum::<f64>());
            for (rank, &record) in order.iter().enumerate().filter(|(_, record)| multiplicities[**record] > 0) {
                let once = weight * shares[record] / f64::from(multiplicities[record]);
                for n in 0..FIT_RATES {
                    let exceeds = if rank < above[n] { 1.0 } else { 0.0 };
                    let deviation = once * (exceeds - exceeded[n]) / implied[n];
                    for (combination, slope) in calibration.iter_mut().zip(&residuals.by_exponent[n]) {
                        combination[record] += slope * deviation;
                    }
                }
            }
        }
        Ok(calibration)
    }
}
