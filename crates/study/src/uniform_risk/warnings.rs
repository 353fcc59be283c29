//! What a study may say, but probably does not mean.

use super::UniformRiskStudy;
use crate::sections::top::warning_of_gravity;

/// The warnings of a resolved study; they depend on nothing but its contents.
pub(super) fn of(study: &UniformRiskStudy) -> Vec<String> {
    let mut warnings = Vec::new();
    warnings.extend(warning_of_gravity(study.gravity_m_s2));
    if study.sites.is_empty() && study.site_table.is_none() {
        warnings.push("no [[sites]]: the responses are computed, but no uniform risk spectrum".to_owned());
    }
    let above = study.regression.strength_above;
    let fitted = study.strengths.iter().filter(|&&strength| strength > above);
    let fitted = fitted.count();
    if fitted < 4 {
        warnings.push(format!(
            "regression.strength_above = {above} leaves {fitted} of the strengths for a fit of \
             3 coefficients: there will be none"
        ));
    }
    warnings
}
