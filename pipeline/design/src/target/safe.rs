//! The value that is safe by the band of its own runs, too.

use std::slice::from_ref;

use super::band::Frequencies;
use super::candidate::Attempt;
use super::search::{MOST_VALUES, NEAR, digits, extend, least, next_value, rounded_up};
use crate::certainty::upper_per_year;
use crate::error::DesignError;

/// The least value `from` one on at which, and at all larger ones tried, the upper limit of the frequency by runs of
/// that value alone meets the target; infinite beyond the range. That limit is the one of `overturning` where the
/// structure is known exactly. The value is the least to [`NEAR`], by few more values.
///
/// # Errors
/// What `attempt` and `frequencies` end with.
pub(super) fn safe_alone(
    tried: &mut Vec<(f64, Attempt)>,
    from: f64,
    (target_per_year, tolerance): (f64, f64),
    attempt: &mut impl FnMut(&[f64]) -> Result<Vec<Attempt>, DesignError>,
    frequencies: impl Fn(&[(f64, Attempt)]) -> Result<Frequencies, DesignError>,
) -> Result<f64, DesignError> {
    let meets = |upper: &f64| *upper <= target_per_year;
    let Some(most) = tried.last().map(|(value, _)| *value).filter(|_| from.is_finite()) else { return Ok(from) };
    extend(tried, vec![from], attempt)?;
    // those of a structure that is not known exactly as of all that was tried, but for this value
    let upper = |tried: &(f64, Attempt)| {
        let (value, Attempt { risk, bands, .. }) = tried;
        let is_known = bands.is_some() || risk.at_most_per_year.is_some();
        let upper =
            if is_known { upper_per_year(risk, *bands) } else { frequencies(from_ref(tried))?.first_upper_per_year() };
        Ok((*value, upper))
    };
    let mut rounds = 0..MOST_VALUES;
    let uppers = loop {
        let above = tried.iter().filter(|(value, _)| *value >= from);
        let uppers: Vec<(f64, f64)> = above.map(upper).collect::<Result<_, DesignError>>()?;
        let is_found = least(&uppers, meets) == Some(0) || rounds.next().is_none();
        let next = next_value(&uppers, target_per_year, tolerance.max(NEAR)).filter(|_| !is_found);
        let next = next.map(|next| vec![rounded_up(next, digits(tolerance), most)]);
        if !extend(tried, next.unwrap_or_default(), attempt)? {
            break uppers;
        }
    };
    Ok(least(&uppers, meets).map_or(f64::INFINITY, |at| uppers[at].0))
}
