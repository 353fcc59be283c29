//! What a result knows of its records, as trends are looked for.

use uplift_result::StoredRecords;

use super::Covariate;

/// What a result knows of its records, in the form in which a demand may depend on it: magnitude, the logarithm of the
/// distance, the logarithm of the significant duration. What is known of fewer than three records is left out.
pub fn covariates(records: &StoredRecords) -> Vec<Covariate> {
    let ln = |values: &[f64]| values.iter().map(|value| value.ln()).collect();
    let all = [
        Covariate { key: "magnitude", long_name: "moment magnitude", values: records.magnitude.clone() },
        Covariate { key: "ln_rrup", long_name: "logarithm of the distance in km", values: ln(&records.rrup_km) },
        Covariate {
            key: "ln_duration",
            long_name: "logarithm of the significant duration D5-95 in s",
            values: ln(&records.duration_5_95_s),
        },
    ];
    let is_known = |covariate: &Covariate| covariate.values.iter().filter(|value| value.is_finite()).count() >= 3;
    all.into_iter().filter(is_known).collect()
}
