//! What a result knows of its records.

use super::Covariate;
use crate::error::UpliftError;
use crate::result::{StoredStripes, open_result};

/// Key, array, what it is, and the form in which it enters a line.
type Form = (&'static str, &'static str, &'static str, fn(f64) -> f64);

/// What a result knows of its records, in the form in which a demand may depend on it: magnitude, the logarithm of the
/// distance, the logarithm of the significant duration. What is known of fewer than three records is left out.
///
/// # Errors
/// A file that is damaged.
pub fn covariates(stored: &StoredStripes) -> Result<Vec<Covariate>, UpliftError> {
    let reader = open_result(&stored.path)?;
    let mut found = Vec::new();
    let forms: [Form; 3] = [
        ("magnitude", "magnitude", "moment magnitude", |value| value),
        ("ln_rrup", "rrup_km", "logarithm of the distance in km", f64::ln),
        ("ln_duration", "duration_5_95_s", "logarithm of the significant duration D5-95 in s", f64::ln),
    ];
    for (key, array, long_name, form) in forms {
        let path = format!("/records/{array}");
        if !reader.exists(&path) {
            continue;
        }
        let values: Vec<f64> = reader.array_f64(&path)?.values.into_iter().map(form).collect();
        if values.iter().filter(|value| value.is_finite()).count() >= 3 {
            found.push(Covariate { key, long_name, values });
        }
    }
    Ok(found)
}
