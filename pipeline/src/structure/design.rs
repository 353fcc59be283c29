//! A structure checked against a uniform risk spectrum, and the check itself put to the test (Sections 3.3.2 and 3.4.5).
//!
//! The rules take the demand on a structure from that on the ZSBE oscillator of the same strength. Under one set of records scaled to one
//! intensity their error is known (Tables 3.2 to 3.7); here it is that of the ordinate of a given risk, over all intensities of a site: the
//! structure's own oscillator is put through the records and the hazard that the spectrum was made from.

use uplift_ida::Watch;
use uplift_oscillator::{Oscillator, OscillatorError, PostUplift};
use uplift_risk::{Ordinate, RiskCurve};
use uplift_spectra::{NoiseSweep, Noisy};
use uplift_structure::{Check, EquivalentSystem, Rule, StructureError, relative_error};

use super::risk::{EventRisk, OVERTURNING_M, demand_of, risk_of_exceeding, stripes_of};
use crate::displacement::RULES;
use crate::error::UpliftError;
use crate::inputs::RecordSet;
use uplift_study::{MeasurePlan, UniformRiskStudy};

/// Where a spectrum was read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumReading {
    /// The strengths between which it was read, those of two ordinates that exist.
    pub between: (f64, f64),
    /// The ordinate, m.
    pub ordinate_m: f64,
}

/// Reads a spectrum at `strength`, linear between its strengths; none outside them, and beside an ordinate that is censored.
///
/// * `strengths` — ascending
/// * `u_m` — the ordinates, m
pub fn read_spectrum(strengths: &[f64], u_m: &[f64], strength: f64) -> Option<SpectrumReading> {
    let right = strengths.iter().position(|&value| value >= strength)?;
    let left = if strengths[right] == strength { right } else { right.checked_sub(1)? };
    let (a, b) = (strengths[left], strengths[right]);
    let share = if b > a { (strength - a) / (b - a) } else { 0.0 };
    let ordinate_m = u_m[left] + share * (u_m[right] - u_m[left]);
    ordinate_m.is_finite().then_some(SpectrumReading { between: (a, b), ordinate_m })
}

/// Half the width of the sweep around the strength, relative to it.
const NOISE_RELATIVE: f64 = 0.01;
/// Strengths in that sweep, with the structure's own in the middle.
const NOISE_POINTS: usize = 11;
/// Oscillators behind an [`ExactDemand`].
pub const OSCILLATORS: usize = 1 + 2 * NOISE_POINTS;

/// The same for structures whose strength is up to one percent lower or higher: what is left of a number in the noise of a chaotic system.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DemandNoise {
    /// Demand on the structure, m.
    pub structure_m: Noisy,
    /// Error of the rules against it, from the exact demand on the ZSBE oscillator of the same strength; none for a structure without capacity.
    pub rule_errors: Option<[Noisy; 2]>,
    /// Frequency of exceeding the capacity, 1/yr; none for a structure without one.
    pub beyond_capacity_per_year: Option<Noisy>,
    /// Frequency of overturning, 1/yr.
    pub overturning_per_year: Noisy,
}

/// What the structure's own stripes say, in its own displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactDemand {
    /// Demand on the study's ZSBE oscillator at the structure's strength, m: what the spectrum has there, without interpolation.
    pub of_spectrum_m: f64,
    /// Demand on the structure's own ZSBE oscillator, with its uplift displacement and restitution, m: what the rules start from.
    pub zero_stiffness_m: f64,
    /// Demand on the structure; infinite where it overturns more often than the target rate.
    pub structure: Ordinate,
    /// The displacement capacity is exceeded; none for a structure without one.
    pub beyond_capacity: Option<EventRisk>,
    /// It overturns.
    pub overturning: EventRisk,
    /// What a small change of the strength makes of it.
    pub noise: DemandNoise,
    /// Nonlinear time histories.
    pub analyses: u64,
}

/// The demand on `system` of the rate `target_per_year` at the site of `weights`, exactly as spectra are made.
///
/// # Errors
/// [`UpliftError::Interrupted`] if `watch` says so; a system that has no oscillator.
pub fn exact_demand(
    study: &UniformRiskStudy,
    (measure, weights): (&MeasurePlan, &uplift_risk::StripeWeights),
    set: &RecordSet,
    (system, restitution): (&EquivalentSystem, f64),
    target_per_year: f64,
    watch: &dyn Watch,
) -> Result<ExactDemand, UpliftError> {
    let fail = |error: &dyn std::fmt::Display| UpliftError::input(error.to_string());
    let of_study = Oscillator::new(
        system.spectral_strength_at(study.gravity_m_s2),
        study.gravity_m_s2,
        study.oscillator.uplift_displacement_m,
        study.oscillator.restitution,
        PostUplift::Zero,
    );
    let uplift_m = system.conditions().uplift_displacement_m();
    let zero_stiffness =
        system.with_static_analysis(system.uplift_force_n(), uplift_m, f64::INFINITY).map_err(|error| fail(&error))?;
    let mut oscillators =
        [of_study, zero_stiffness.spectral_oscillator(restitution), system.spectral_oscillator(restitution)]
            .into_iter()
            .collect::<Result<Vec<_>, _>>()
            .map_err(|error| fail(&error))?;
    let sweep = NoiseSweep::new(NOISE_RELATIVE, NOISE_POINTS).map_err(|error| fail(&error))?;
    // the middle of the sweep is the structure itself
    let mut pairs = Vec::new();
    for (point, change) in sweep.factors().into_iter().enumerate() {
        if point == NOISE_POINTS / 2 {
            pairs.push([1, 2]);
            continue;
        }
        pairs.push([oscillators.len(), oscillators.len() + 1]);
        for own in [1, 2] {
            let stronger = strengthened(&oscillators[own], change).map_err(|error| fail(&error))?;
            oscillators.push(stronger);
        }
    }
    let stripes = stripes_of(study, measure, set, &oscillators, watch)?;
    let factor = system.participation();
    let ordinate = |oscillator: usize| -> Result<Ordinate, UpliftError> {
        let demand = demand_of(&stripes, oscillator)?;
        let ordinate = RiskCurve::new(&demand, weights).and_then(|curve| curve.exact_ordinate(target_per_year));
        let ordinate = ordinate.map_err(|error| fail(&error))?;
        Ok(Ordinate { displacement_m: factor * ordinate.displacement_m, ..ordinate })
    };
    let own = demand_of(&stripes, 2)?;
    let years = study.risk.years;
    // all of it is scaled by the same factor: the oscillator exceeds capacity/factor where the structure exceeds its capacity
    let capacity_m = match oscillators[2].post_uplift() {
        PostUplift::Negative { capacity_m } => Some(capacity_m),
        PostUplift::Zero | PostUplift::Positive { .. } => None,
    };
    let beyond_capacity =
        capacity_m.map(|capacity_m| risk_of_exceeding(&own, weights, capacity_m, years)).transpose()?;
    let (mut demands_m, mut beyond, mut overturned, mut errors) = (vec![], vec![], vec![], [vec![], vec![]]);
    for [zero, own] in pairs {
        let (zero_m, own_m) = (ordinate(zero)?.displacement_m, ordinate(own)?.displacement_m);
        let pool = demand_of(&stripes, own)?;
        demands_m.push(own_m);
        overturned.push(risk_of_exceeding(&pool, weights, OVERTURNING_M, years)?.per_year);
        if let Some(capacity_m) = capacity_m {
            beyond.push(risk_of_exceeding(&pool, weights, capacity_m, years)?.per_year);
            for (rule, errors) in RULES.into_iter().zip(&mut errors) {
                let demand = system.capacity().and_then(|capacity| rule.demand(&capacity, zero_m));
                let demand_m = demand.map_err(|error| fail(&error))?.displacement_m();
                errors.push(relative_error(demand_m, own_m).unwrap_or(f64::NAN));
            }
        }
    }
    let noise = DemandNoise {
        structure_m: Noisy::of(&demands_m),
        rule_errors: capacity_m.map(|_| errors.map(|errors| Noisy::of(&errors))),
        beyond_capacity_per_year: capacity_m.map(|_| Noisy::of(&beyond)),
        overturning_per_year: Noisy::of(&overturned),
    };
    Ok(ExactDemand {
        of_spectrum_m: ordinate(0)?.displacement_m,
        zero_stiffness_m: ordinate(1)?.displacement_m,
        structure: ordinate(2)?,
        beyond_capacity,
        overturning: risk_of_exceeding(&own, weights, OVERTURNING_M, years)?,
        noise,
        analyses: stripes.analyses,
    })
}

/// The oscillator with its strength times `change`.
fn strengthened(oscillator: &Oscillator, change: f64) -> Result<Oscillator, OscillatorError> {
    let strength = oscillator.strength();
    Oscillator::new(
        change * strength,
        oscillator.uplift_acceleration_m_s2() / strength,
        oscillator.uplift_displacement_m(),
        oscillator.restitution(),
        oscillator.post_uplift(),
    )
}

/// A rule applied to the ordinate of a spectrum, and to the exact ZSBE demand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RuleOutcome {
    /// The rule.
    pub rule: Rule,
    /// From the spectrum as an engineer reads it.
    pub from_spectrum: Option<Check>,
    /// From the exact demand on the structure's ZSBE oscillator: what is wrong with it is the rule's own error.
    pub from_exact: Option<Check>,
}

impl RuleOutcome {
    /// The check that counts: from the spectrum, or where that cannot be read from the exact demand.
    pub fn check(&self) -> Option<&Check> {
        self.from_spectrum.as_ref().or(self.from_exact.as_ref())
    }
}

/// Both rules of Section 3.3.2.
///
/// * `from_spectrum_m`, `zero_stiffness_m` — demand on the ZSBE system, in the structure's displacement, m; the latter exact
///
/// # Errors
/// Positive post-uplift stiffness, a safety factor below 1, a demand that is not finite.
pub fn check_rules(
    system: &EquivalentSystem,
    safety_factor: f64,
    from_spectrum_m: Option<f64>,
    zero_stiffness_m: Option<f64>,
) -> Result<[RuleOutcome; 2], StructureError> {
    let check = |rule: Rule, demand_m: Option<f64>| {
        demand_m.map(|demand_m| Check::of(system, rule, safety_factor, demand_m)).transpose()
    };
    let outcome = |rule: Rule| -> Result<RuleOutcome, StructureError> {
        Ok(RuleOutcome {
            rule,
            from_spectrum: check(rule, from_spectrum_m)?,
            from_exact: check(rule, zero_stiffness_m)?,
        })
    };
    let [displacement, energy] = RULES;
    Ok([outcome(displacement)?, outcome(energy)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spectrum_is_read_between_its_strengths_only() {
        let (strengths, u_m) = ([0.1, 0.2, 0.4], [1.0, 0.5, f64::INFINITY]);
        let read = |strength: f64| read_spectrum(&strengths, &u_m, strength).map(|reading| reading.ordinate_m);
        assert_eq!(read(0.1), Some(1.0));
        assert_eq!(read(0.2), Some(0.5));
        assert_eq!(read(0.125), Some(0.875));
        assert_eq!([read(0.09), read(0.3), read(0.4), read(0.5)], [None; 4]);
        assert_eq!(read_spectrum(&strengths, &u_m, 0.15).map(|reading| reading.between), Some((0.1, 0.2)));
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
