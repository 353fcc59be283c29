//! How many records count under the weights that a result holds.

use uplift_result::{ResultFile, StoredConsistency};

use crate::error::UniformRiskError;

/// Fewest effective records at a level within the rates compared `[site]`; NaN where there is no repair, none before
/// one.
///
/// # Errors
/// A `file` that is damaged, or of another kind.
pub fn least_effective(file: &ResultFile, of: &StoredConsistency) -> Result<Option<Vec<f64>>, UniformRiskError> {
    let Some(records) = &of.effective_records else { return Ok(None) };
    let levels = file.levels()?.into_iter().find(|(measure, _)| *measure == of.scaled_to);
    let levels = levels.map_or_else(Vec::new, |(_, levels)| levels);
    let extrapolation = file.stored_study()?.risk.extrapolate;
    let of_site = |(site, name): (usize, &String)| {
        let Some(curve) = file.mean_curve(name, of.scaled_to)? else { return Ok(f64::NAN) };
        let [high, .., low] = of.rate_per_year.block([site]) else { return Ok(f64::NAN) };
        let is_compared = |level: f64| {
            let rate = curve.rate_at_extrapolated(level, extrapolation);
            rate.is_ok_and(|rate| *low <= rate && rate <= *high)
        };
        let compared = levels.iter().zip(records.block([site])).filter(|(level, _)| is_compared(**level));
        // the least of none, and of numbers that are none, is none
        Ok(compared.map(|(_, records)| *records).fold(f64::NAN, f64::min))
    };
    file.axes()?.sites.iter().enumerate().map(of_site).collect::<Result<_, _>>().map(Some)
}
