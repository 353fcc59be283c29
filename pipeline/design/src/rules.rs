//! The rules of Section 3.3.2 applied to a structure, and the capacity that they ask for (Eq. 3.15).

use serde::Serialize;
use uplift_job::text::{per_cent, to_the_centimetre};
use uplift_result::RULES;
use uplift_structure::{Check, Demand, PostUpliftForce, Rule, StructureError, relative_error};
use uplift_study::Structure;

use super::spectrum::SpectrumDemand;

/// A rule applied to the ordinate of a spectrum, and to the exact ZSBE demand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RuleOutcome {
    /// The rule.
    pub rule: Rule,
    /// From the spectrum as an engineer reads it; none where it cannot be read.
    pub from_spectrum: Option<RuleCheck>,
    /// From the exact demand on the structure's ZSBE oscillator: what is wrong with it is the rule's own error. None
    /// where there is no such demand.
    pub from_exact: Option<RuleCheck>,
}

/// What a rule says of a structure; infinite where it overturns, and for a structure whose capacity is infinite.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RuleCheck {
    /// Demand that the rule starts from, on the ZSBE system, m.
    pub zero_stiffness_demand_m: f64,
    /// Demand on the structure, m.
    pub demand_m: f64,
    /// Whether the rule says that it overturns.
    pub overturns: bool,
    /// Relative error against the exact demand on the structure; none without one, and where both are zero.
    pub error: Option<f64>,
    /// Capacity that the safety factor asks for (Eq. 3.15), m.
    pub required_capacity_m: f64,
    /// Stiffness of each tendon that would give that capacity, N/m; none for a structure without tendons.
    pub required_tendon_stiffness_n_m: Option<f64>,
    /// Capacity less required capacity, m.
    pub margin_m: f64,
    /// Factor of safety that the structure has.
    pub safety_factor: f64,
    /// Whether its capacity is at least the required one.
    pub satisfied: bool,
    /// Capacity of the structure, m.
    #[serde(skip)]
    pub capacity_m: f64,
    /// Where the rule says that it overturns: the largest demand on the ZSBE system with which it would stand, m.
    #[serde(skip)]
    pub largest_zero_stiffness_demand_m: Option<f64>,
}

/// The capacity of a structure held against its own demand, or that of its frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OwnCheck {
    /// Safety factor times demand, m; infinite where it overturns more often than the target.
    pub required_capacity_m: f64,
    /// Capacity over demand.
    pub safety_factor: f64,
    /// Whether the capacity is at least the required one.
    pub satisfied: bool,
    /// Whether it is at the upper limit of the demand's quoted band; none without a band.
    pub satisfied_at_upper_limit: Option<bool>,
}

impl OwnCheck {
    pub(super) fn new(capacity_m: f64, (demand_m, upper_m): (f64, Option<f64>), safety_factor: f64) -> Self {
        let required_capacity_m = safety_factor * demand_m;
        let is_enough = |demand_m: f64| capacity_m >= safety_factor * demand_m;
        Self {
            required_capacity_m,
            safety_factor: capacity_m / demand_m,
            satisfied: is_enough(demand_m),
            satisfied_at_upper_limit: upper_m.map(is_enough),
        }
    }

    /// `satisfied, not at the upper limit`.
    pub fn verdict(&self) -> String {
        let word = verdict_word(self.satisfied);
        if self.is_unsafe_at_upper_limit() { format!("{word}, not at the upper limit") } else { word.to_owned() }
    }

    /// Whether it is satisfied by the estimate of the demand, and not by its upper limit.
    pub(super) fn is_unsafe_at_upper_limit(&self) -> bool {
        self.satisfied && self.satisfied_at_upper_limit == Some(false)
    }

    /// `2.5 times its own demand (0.77 m)`: of the structure as it is, where a rule knows that another capacity would
    /// change the demand.
    pub fn in_words(&self, safety_factor: f64) -> String {
        if self.required_capacity_m.is_finite() {
            format!("{safety_factor} times its own demand ({} m)", to_the_centimetre(self.required_capacity_m))
        } else {
            "its own demand (overturns)".to_owned()
        }
    }
}

impl RuleOutcome {
    /// The check that counts: from the spectrum, or where that cannot be read from the exact demand.
    pub fn check(&self) -> Option<&RuleCheck> {
        self.from_spectrum.as_ref().or(self.from_exact.as_ref())
    }
}

/// `satisfied by equal displacement (requires 0.48 m); NOT satisfied by equal energy (requires 0.62 m)`; none without a
/// check.
pub(super) fn verdicts_in_words(rules: &[RuleOutcome], own: Option<(OwnCheck, f64)>) -> Option<String> {
    let by_rules = rules.iter().filter_map(|outcome| {
        let check = outcome.check()?;
        let required_m = check.required_capacity_m;
        let required = if required_m.is_finite() {
            format!("requires {} m", to_the_centimetre(required_m))
        } else {
            "no capacity suffices".to_owned()
        };
        Some((check.satisfied, format!("{} ({required})", outcome.rule.words())))
    });
    let own = own.map(|(own, safety_factor)| (own.satisfied, own.in_words(safety_factor)));
    let verdicts: Vec<(bool, String)> = by_rules.chain(own).collect();
    let told = [true, false].map(|wanted| {
        let of: Vec<&str> =
            verdicts.iter().filter(|(satisfied, _)| *satisfied == wanted).map(|(_, words)| words.as_str()).collect();
        (!of.is_empty()).then(|| format!("{} by {}", verdict_word(wanted), of.join(", ")))
    });
    let told: Vec<String> = told.into_iter().flatten().collect();
    (!told.is_empty()).then(|| told.join("; "))
}

/// `satisfied` or `NOT satisfied`.
pub fn verdict_word(satisfied: bool) -> &'static str {
    if satisfied { "satisfied" } else { "NOT satisfied" }
}

/// What the rules say by the spectrum of another measure than the one that a design is by.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureVerdict {
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Both rules, from its spectrum.
    pub rules: Vec<RuleOutcome>,
}

/// Demands that the rules start from and are measured by, in the structure's displacement, m.
#[derive(Debug, Clone, Copy)]
#[expect(clippy::struct_field_names, reason = "the unit of each")]
pub(super) struct RuleDemands {
    /// On the ZSBE system, by the spectrum.
    pub(super) of_spectrum_m: Option<f64>,
    /// On the ZSBE system, exact.
    pub(super) exact_m: Option<f64>,
    /// On the structure, exact.
    pub(super) of_structure_m: Option<f64>,
}

/// Both rules; none where they do not apply, to positive post-uplift stiffness.
///
/// # Errors
/// A safety factor below 1, a demand that is not finite.
pub(super) fn apply_rules(
    structure: &Structure,
    safety_factor: f64,
    demands: RuleDemands,
) -> Result<Vec<RuleOutcome>, StructureError> {
    match structure.system.post_uplift() {
        PostUpliftForce::Positive { .. } => return Ok(Vec::new()),
        PostUpliftForce::Negative { .. } | PostUpliftForce::Zero => {}
    }
    let check = |rule: Rule, demand_m: Option<f64>| -> Result<Option<RuleCheck>, StructureError> {
        let Some(demand_m) = demand_m else { return Ok(None) };
        let check = Check::from_system(&structure.system, rule, safety_factor, demand_m)?;
        Ok(Some(rule_check(structure, &check, demands.of_structure_m)))
    };
    let outcome = |rule: Rule| -> Result<RuleOutcome, StructureError> {
        Ok(RuleOutcome {
            rule,
            from_spectrum: check(rule, demands.of_spectrum_m)?,
            from_exact: check(rule, demands.exact_m)?,
        })
    };
    RULES.into_iter().map(outcome).collect()
}

fn rule_check(structure: &Structure, check: &Check, of_structure_m: Option<f64>) -> RuleCheck {
    let demand_m = check.demand.displacement_m();
    let tendons = structure.description.tendon_stiffness_for_capacity_n_m(check.required_capacity_m);
    RuleCheck {
        zero_stiffness_demand_m: check.zero_stiffness_demand_m,
        demand_m,
        overturns: demand_m.is_infinite(),
        error: of_structure_m.and_then(|exact_m| relative_error(demand_m, exact_m)),
        required_capacity_m: check.required_capacity_m,
        required_tendon_stiffness_n_m: tendons.ok().flatten(),
        margin_m: check.margin_m(),
        safety_factor: check.safety_factor(),
        satisfied: check.is_satisfied(),
        capacity_m: check.capacity_m,
        largest_zero_stiffness_demand_m: match check.demand {
            Demand::Overturns { largest_zero_stiffness_demand_m } => Some(largest_zero_stiffness_demand_m),
            Demand::Stands { .. } => None,
        },
    }
}

/// Which verdicts hang on the hazard curve, of those that may hold: `by_curve` has the weight of each, of 1, with the
/// demand by its spectrum; none where that cannot be read.
pub(super) fn verdicts_by_curve(
    structure: &Structure,
    safety_factor: f64,
    by_curve: impl Iterator<Item = (f64, Option<SpectrumDemand>)>,
) -> Result<Vec<String>, StructureError> {
    // of each rule the weight of the curves by which it is satisfied, and the margins
    let mut found: Vec<(Rule, f64, [f64; 2])> = Vec::new();
    for (weight, demand) in by_curve {
        // where there is no demand to tell, nothing is enough
        let of_spectrum_m = demand.map(|demand| demand.zero_stiffness_demand_m);
        let demands = RuleDemands { of_spectrum_m, exact_m: None, of_structure_m: None };
        for outcome in apply_rules(structure, safety_factor, demands)? {
            let (satisfied, margin_m) =
                outcome.check().map_or((false, f64::NEG_INFINITY), |check| (check.satisfied, check.margin_m));
            let place = found.iter().position(|(rule, ..)| *rule == outcome.rule).unwrap_or_else(|| {
                found.push((outcome.rule, 0.0, [f64::INFINITY, f64::NEG_INFINITY]));
                found.len() - 1
            });
            let (_, share, [least_m, most_m]) = &mut found[place];
            *share += if satisfied { weight } else { 0.0 };
            (*least_m, *most_m) = (least_m.min(margin_m), most_m.max(margin_m));
        }
    }
    let hangs = |(_, _, [least_m, most_m]): &&(Rule, f64, [f64; 2])| *least_m < 0.0 && *most_m >= 0.0;
    let told = found.iter().filter(hangs).map(|(rule, share, [least_m, most_m])| {
        format!(
            "the verdict by {} depends on the hazard curve: satisfied by curves of {} of the weight, with margins \
             from {} to {most_m:+.4} m",
            rule.words(),
            per_cent(*share),
            if least_m.is_finite() { format!("{least_m:+.4}") } else { "none".to_owned() }
        )
    });
    Ok(told.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_capacity_is_held_against_the_demand() {
        let check = OwnCheck::new(1.2, (0.4, Some(0.5)), 2.5);
        assert_eq!((check.satisfied, check.required_capacity_m), (true, 1.0));
        assert!(!OwnCheck::new(1.2, (0.5, None), 2.5).satisfied);
        let overturns = OwnCheck::new(1.2, (f64::INFINITY, None), 2.5);
        assert!(!overturns.satisfied);
        let told = |own| verdicts_in_words(&[], own);
        assert_eq!(told(Some((check, 2.5))).as_deref(), Some("satisfied by 2.5 times its own demand (1.00 m)"));
        assert_eq!(told(Some((overturns, 2.5))).as_deref(), Some("NOT satisfied by its own demand (overturns)"));
        assert_eq!(told(None), None);
    }

    #[test]
    fn errors_have_the_sign_of_their_danger() {
        let inf = f64::INFINITY;
        assert_eq!(relative_error(0.9, 1.0), Some(0.9 - 1.0));
        assert_eq!(relative_error(2.0, inf), Some(-1.0));
        assert_eq!(relative_error(inf, 2.0), Some(inf));
        assert_eq!(relative_error(inf, inf), Some(0.0));
        assert_eq!(relative_error(0.0, 0.0), None);
    }
}
