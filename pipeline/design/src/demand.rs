//! The demand on a structure itself: its own oscillator put through the records and the hazard that a spectrum was made
//! from.

use serde::Serialize;
use uplift_result::RULES;
use uplift_risk::Ordinate;
use uplift_spectra::Noisy;
use uplift_structure::{EquivalentSystem, Rule, relative_error};
use uplift_uniform_risk::{EventRisk, Stripes};

use super::certainty::{DemandBands, Scatter, demand_bands};
use super::hazard::Hazard;
use super::risk::{OVERTURNING_M, bounded, demand_of, oscillator_capacity_m, risk_of_exceeding};
use super::sweep::{OF_STUDY, OWN, Sweep, ZERO_STIFFNESS};
use super::weights::SiteWeights;
use crate::error::DesignError;

/// What the structure's own stripes say, in its own displacement; infinite where it overturns more often than the
/// target.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ExactDemand {
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Demand on the study's ZSBE oscillator at the structure's strength, m: what the spectrum has there, without
    /// interpolation.
    pub zero_stiffness_demand_of_spectrum_m: f64,
    /// Demand on the structure's own ZSBE oscillator, with its uplift displacement and restitution, m: what the rules
    /// start from.
    pub zero_stiffness_demand_m: f64,
    /// Demand on the structure, m.
    pub demand_m: f64,
    /// Displacement capacity less the demand on the structure, m; none for a structure without one.
    pub capacity_less_demand_m: Option<f64>,
    /// Whether it overturns more often than the target rate.
    pub overturns: bool,
    /// Share of the risk at the demand that comes from below the first stripe, 0 to 1.
    pub lower_tail_share: f64,
    /// Share of the risk at the demand that comes from above the last stripe, 0 to 1.
    pub upper_tail_share: f64,
    /// The displacement capacity is exceeded; none for a structure without one.
    pub beyond_capacity: Option<EventRisk>,
    /// It overturns.
    pub overturning: EventRisk,
    /// Confidence bands of these by the records; none of a single record.
    pub bands: Option<DemandBands>,
    /// What a small change of the strength makes of it.
    #[serde(rename = "within_one_percent_of_strength")]
    pub noise: DemandNoise,
    /// What rounding makes of it.
    pub rounding: DemandRounding,
}

/// The same for strengths that differ by rounding, some 1e-15 of them: a value whose digits change by that hangs on
/// runs beyond double precision (docs/method.md, section 1.5).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DemandRounding {
    /// Demand on the study's ZSBE oscillator, m.
    pub zero_stiffness_demand_of_spectrum_m: Noisy,
    /// Demand on the structure's own ZSBE oscillator, m.
    pub zero_stiffness_demand_m: Noisy,
    /// Demand on the structure, m.
    pub demand_m: Noisy,
    /// Demand by the rules, from the exact demand on its ZSBE oscillator, m; none for a structure without capacity.
    pub rule_demands_m: Option<RuleRanges>,
    /// Their error against the demand on the structure; none for one without capacity.
    pub rule_errors: Option<RuleRanges>,
    /// Frequency of exceeding the capacity, 1/yr; none for a structure without one.
    pub beyond_capacity_per_year: Option<Noisy>,
    /// Frequency of overturning, 1/yr.
    pub overturning_per_year: Noisy,
}

/// The same for structures whose strength is up to one percent lower or higher: what is left of a number in the noise
/// of a chaotic system.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DemandNoise {
    /// Demand on the structure, m.
    pub demand_m: Noisy,
    /// Error of the rules against it, from the exact demand on the ZSBE oscillator of the same strength; none for a
    /// structure without capacity.
    pub rule_errors: Option<RuleRanges>,
    /// Frequency of exceeding the capacity, 1/yr; none for a structure without one.
    pub beyond_capacity_per_year: Option<Noisy>,
    /// Frequency of overturning, 1/yr.
    pub overturning_per_year: Noisy,
}

/// A number of each of the two rules, with its range.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub struct RuleRanges {
    /// Of equal displacement.
    pub equal_displacement: Noisy,
    /// Of equal energy.
    pub equal_energy: Noisy,
}

impl RuleRanges {
    /// That of `rule`.
    pub fn of(&self, rule: Rule) -> Noisy {
        match rule {
            Rule::EqualDisplacement => self.equal_displacement,
            Rule::EqualEnergy => self.equal_energy,
        }
    }
}

impl DemandRounding {
    /// Relative error of a demand, m, against that on the structure, with its range; NaN where there is none to refer
    /// to.
    pub fn error_of(&self, demand_m: f64) -> Noisy {
        let error = |own_m: f64| relative_error(demand_m, own_m).unwrap_or(f64::NAN);
        Noisy::around(error(self.demand_m.value), [self.demand_m.lowest, self.demand_m.highest].map(error))
    }
}

/// The demand on `system`, whose oscillators are `sweep` with the `stripes` over `[record, oscillator, level]`, of the
/// rate `target_per_year` at the site of `weights`, exactly as spectra are made; `hazard` is that of the site.
pub(super) fn exact_demand(
    (stripes, weights, hazard): (&Stripes, &SiteWeights<'_>, &Hazard<'_>),
    (system, sweep): (&EquivalentSystem, &Sweep),
    (target_per_year, years): (f64, f64),
    scatter: &Scatter,
) -> Result<ExactDemand, DesignError> {
    let factor = system.participation();
    let ordinate = |oscillator: usize| -> Result<Ordinate, DesignError> {
        let demand = demand_of(stripes, oscillator)?;
        let ordinate = weights.curve(&demand)?.exact_ordinate(target_per_year)?;
        Ok(Ordinate { displacement_m: factor * ordinate.displacement_m, ..ordinate })
    };
    let own = demand_of(stripes, OWN)?;
    // all of it is scaled by the same factor: the oscillator exceeds capacity/factor where the structure exceeds its
    // capacity
    let capacity_m = oscillator_capacity_m(&sweep.oscillators[OWN]);
    let may_happen = |risk: EventRisk| bounded(risk, weights, &scatter.pairs);
    let beyond_capacity =
        capacity_m.map(|capacity_m| risk_of_exceeding(&own, weights, capacity_m, years).map(may_happen)).transpose()?;
    let overturning = risk_of_exceeding(&own, weights, OVERTURNING_M, years)?;
    let by_rule_m = |rule: Rule, zero_m: f64| -> Result<f64, DesignError> {
        Ok(system.capacity().and_then(|capacity| rule.demand(&capacity, zero_m))?.displacement_m())
    };
    let (mut demands_m, mut beyond, mut overturned, mut errors) = (vec![], vec![], vec![], [vec![], vec![]]);
    for &[zero, own] in &sweep.pairs {
        let (zero_m, own_m) = (ordinate(zero)?.displacement_m, ordinate(own)?.displacement_m);
        let pool = demand_of(stripes, own)?;
        demands_m.push(own_m);
        overturned.push(risk_of_exceeding(&pool, weights, OVERTURNING_M, years)?.per_year);
        if let Some(capacity_m) = capacity_m {
            beyond.push(risk_of_exceeding(&pool, weights, capacity_m, years)?.per_year);
            for (rule, errors) in RULES.into_iter().zip(&mut errors) {
                errors.push(relative_error(by_rule_m(rule, zero_m)?, own_m).unwrap_or(f64::NAN));
            }
        }
    }
    let displacement_m = |oscillator: usize| -> Result<f64, DesignError> { Ok(ordinate(oscillator)?.displacement_m) };
    let rounded_m = |own: usize| -> Result<Noisy, DesignError> {
        let nudged = sweep.rounded.iter().map(|nudged| displacement_m(nudged[own])).collect::<Result<Vec<_>, _>>()?;
        Ok(Noisy::around(displacement_m(own)?, nudged))
    };
    let rounded_rate = |threshold_m: f64| -> Result<Noisy, DesignError> {
        let rate = |oscillator: usize| -> Result<f64, DesignError> {
            Ok(risk_of_exceeding(&demand_of(stripes, oscillator)?, weights, threshold_m, years)?.per_year)
        };
        let nudged = sweep.rounded.iter().map(|nudged| rate(nudged[OWN])).collect::<Result<Vec<_>, _>>()?;
        Ok(Noisy::around(rate(OWN)?, nudged))
    };
    let [equal_displacement, equal_energy] = errors.map(|errors| Noisy::from_sweep(&errors));
    // of every rule: its demand from that on the ZSBE oscillator, and the error of that against the structure's
    let mut by_rules = Vec::new();
    for &[_, zero, own] in [[OF_STUDY, ZERO_STIFFNESS, OWN]].iter().chain(&sweep.rounded) {
        if capacity_m.is_none() {
            break;
        }
        let (zero_m, own_m) = (displacement_m(zero)?, displacement_m(own)?);
        let of = |rule: Rule| -> Result<[f64; 2], DesignError> {
            let demand_m = by_rule_m(rule, zero_m)?;
            Ok([demand_m, relative_error(demand_m, own_m).unwrap_or(f64::NAN)])
        };
        by_rules.push([of(Rule::EqualDisplacement)?, of(Rule::EqualEnergy)?]);
    }
    let rounded_rules = |which: usize| {
        let (own, nudged) = by_rules.split_first()?;
        let [equal_displacement, equal_energy] =
            [0, 1].map(|rule| Noisy::around(own[rule][which], nudged.iter().map(|of| of[rule][which])));
        Some(RuleRanges { equal_displacement, equal_energy })
    };
    let demand = ordinate(OWN)?;
    let repaired = match weights {
        SiteWeights::Alike(_) => None,
        SiteWeights::Repaired(weights) => Some(*weights),
    };
    let bands = demand_bands(&own, (hazard, repaired), scatter, (target_per_year, factor, capacity_m))?;
    Ok(ExactDemand {
        bands,
        analyses: stripes.analyses,
        zero_stiffness_demand_of_spectrum_m: ordinate(OF_STUDY)?.displacement_m,
        zero_stiffness_demand_m: ordinate(ZERO_STIFFNESS)?.displacement_m,
        demand_m: demand.displacement_m,
        capacity_less_demand_m: capacity_m.map(|capacity_m| factor * capacity_m - demand.displacement_m),
        overturns: demand.displacement_m.is_infinite(),
        lower_tail_share: demand.lower_tail_share,
        upper_tail_share: demand.upper_tail_share,
        beyond_capacity,
        // what has no capacity cannot overturn
        overturning: if capacity_m.is_some() { may_happen(overturning) } else { overturning },
        noise: DemandNoise {
            demand_m: Noisy::from_sweep(&demands_m),
            rule_errors: capacity_m.map(|_| RuleRanges { equal_displacement, equal_energy }),
            beyond_capacity_per_year: capacity_m.map(|_| Noisy::from_sweep(&beyond)),
            overturning_per_year: Noisy::from_sweep(&overturned),
        },
        rounding: DemandRounding {
            zero_stiffness_demand_of_spectrum_m: rounded_m(OF_STUDY)?,
            zero_stiffness_demand_m: rounded_m(ZERO_STIFFNESS)?,
            demand_m: rounded_m(OWN)?,
            rule_demands_m: rounded_rules(0),
            rule_errors: rounded_rules(1),
            beyond_capacity_per_year: capacity_m.map(rounded_rate).transpose()?,
            overturning_per_year: rounded_rate(OVERTURNING_M)?,
        },
    })
}
