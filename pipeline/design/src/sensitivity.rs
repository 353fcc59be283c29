//! What a small change of the strength and rounding make of the demand on a structure.

use serde::Serialize;
use uplift_spectra::Noisy;
use uplift_structure::{Rule, relative_error};

use super::risk::OVERTURNING_M;
use super::shaken::Shaken;
use super::sweep::{Neighbours, OF_STUDY, OWN, ZERO_STIFFNESS};
use crate::error::DesignError;

/// How far the numbers of a structure are those of its neighbours too.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sensitivity {
    /// Of neighbours within one per cent of the strength.
    #[serde(rename = "within_one_percent_of_strength")]
    pub noise: DemandNoise,
    /// Of neighbours that differ by rounding.
    pub rounding: DemandRounding,
}

/// Numbers for strengths that differ by rounding, some 1e-15 of them: a value whose digits change by that hangs on
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

/// Numbers for structures whose strength is up to one per cent lower or higher: what is left of a number in the noise
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
    /// What `of` says of each.
    fn from_rules(of: impl Fn(Rule) -> Result<Noisy, DesignError>) -> Result<Self, DesignError> {
        Ok(Self { equal_displacement: of(Rule::EqualDisplacement)?, equal_energy: of(Rule::EqualEnergy)? })
    }

    /// That of `rule`.
    pub fn by_rule(&self, rule: Rule) -> Noisy {
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

/// What `neighbours` make of the numbers of the structure `shaken`, whose oscillator exceeds its capacity at
/// `capacity_m`.
pub(super) fn sensitivity(
    shaken: &Shaken<'_>,
    neighbours: &Neighbours,
    capacity_m: Option<f64>,
) -> Result<Sensitivity, DesignError> {
    Ok(Sensitivity {
        noise: noise(shaken, &neighbours.pairs, capacity_m)?,
        rounding: rounding(shaken, &neighbours.rounded, capacity_m)?,
    })
}

fn noise(shaken: &Shaken<'_>, pairs: &[[usize; 2]], capacity_m: Option<f64>) -> Result<DemandNoise, DesignError> {
    let own = || pairs.iter().map(|&[_, own]| own);
    let of_sweep = |values: Result<Vec<f64>, DesignError>| Ok::<_, DesignError>(Noisy::from_sweep(&values?));
    let rates = |threshold_m: f64| of_sweep(own().map(|own| shaken.per_year(own, threshold_m)).collect());
    let errors = |rule: Rule| of_sweep(pairs.iter().map(|&pair| Ok(shaken.by_rule(rule, pair)?[1])).collect());
    Ok(DemandNoise {
        demand_m: Noisy::from_sweep(&own().map(|own| shaken.displacement_m(own)).collect::<Vec<_>>()),
        rule_errors: capacity_m.map(|_| RuleRanges::from_rules(errors)).transpose()?,
        beyond_capacity_per_year: capacity_m.map(rates).transpose()?,
        overturning_per_year: rates(OVERTURNING_M)?,
    })
}

fn rounding(
    shaken: &Shaken<'_>,
    rounded: &[[usize; 3]],
    capacity_m: Option<f64>,
) -> Result<DemandRounding, DesignError> {
    let around = |value: &dyn Fn([usize; 3]) -> Result<f64, DesignError>| {
        let others = rounded.iter().map(|&nudged| value(nudged)).collect::<Result<Vec<_>, _>>()?;
        Ok::<_, DesignError>(Noisy::around(value([OF_STUDY, ZERO_STIFFNESS, OWN])?, others))
    };
    let displacement_m = |place: usize| around(&|own| Ok(shaken.displacement_m(own[place])));
    let rate = |threshold_m: f64| around(&|own| shaken.per_year(own[OWN], threshold_m));
    // of a rule: its demand from that on the ZSBE oscillator, or the error of that against the structure's
    let by_rules = |which: usize| {
        let of = |rule: Rule| around(&|[_, zero, own]| Ok(shaken.by_rule(rule, [zero, own])?[which]));
        capacity_m.map(|_| RuleRanges::from_rules(of)).transpose()
    };
    Ok(DemandRounding {
        zero_stiffness_demand_of_spectrum_m: displacement_m(OF_STUDY)?,
        zero_stiffness_demand_m: displacement_m(ZERO_STIFFNESS)?,
        demand_m: displacement_m(OWN)?,
        rule_demands_m: by_rules(0)?,
        rule_errors: by_rules(1)?,
        beyond_capacity_per_year: capacity_m.map(rate).transpose()?,
        overturning_per_year: rate(OVERTURNING_M)?,
    })
}
