//! A structure checked against a uniform risk spectrum, and the check itself put to the test (Sections 3.3.2 and 3.4.5).
//!
//! The rules take the demand on a structure from that on the ZSBE oscillator of the same strength. Under one set of records scaled to one
//! intensity their error is known (Tables 3.2 to 3.7); here it is that of the ordinate of a given risk, over all intensities of a site: the
//! structure's own oscillator is put through the records and the hazard that the spectrum was made from.

use uplift_ida::Watch;
use uplift_oscillator::{Oscillator, PostUplift};
use uplift_risk::{Ordinate, RiskCurve};
use uplift_structure::{Check, EquivalentSystem, Rule, StructureError};

use super::structure::{EventRisk, OVERTURNING_M, demand_of, risk_of_exceeding, stripes_of};
use crate::error::UpliftError;
use crate::inputs::RecordSet;
use crate::study::{MeasurePlan, ResolvedStudy};

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
    /// Nonlinear time histories.
    pub analyses: u64,
}

/// The demand on `system` of the rate `target_per_year` at the site of `weights`, exactly as spectra are made.
///
/// # Errors
/// [`UpliftError::Interrupted`] if `watch` says so; a system that has no oscillator.
pub fn exact_demand(
    study: &ResolvedStudy,
    (measure, weights): (&MeasurePlan, &uplift_risk::StripeWeights),
    set: &RecordSet,
    (system, restitution): (&EquivalentSystem, f64),
    target_per_year: f64,
    watch: &dyn Watch,
) -> Result<ExactDemand, UpliftError> {
    let fail = |error: &dyn std::fmt::Display| UpliftError::input(error.to_string());
    let of_study = Oscillator::new(
        system.spectral_strength(),
        study.gravity_m_s2,
        study.oscillator.uplift_displacement_m,
        study.oscillator.restitution,
        PostUplift::Zero,
    );
    let uplift_m = system.conditions().uplift_displacement_m();
    let zero_stiffness =
        system.with_static_analysis(system.uplift_force_n(), uplift_m, f64::INFINITY).map_err(|error| fail(&error))?;
    let oscillators =
        [of_study, zero_stiffness.spectral_oscillator(restitution), system.spectral_oscillator(restitution)]
            .into_iter()
            .collect::<Result<Vec<_>, _>>()
            .map_err(|error| fail(&error))?;
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
    let beyond_capacity = match oscillators[2].post_uplift() {
        PostUplift::Negative { capacity_m } => Some(risk_of_exceeding(&own, weights, capacity_m, years)?),
        PostUplift::Zero | PostUplift::Positive { .. } => None,
    };
    Ok(ExactDemand {
        of_spectrum_m: ordinate(0)?.displacement_m,
        zero_stiffness_m: ordinate(1)?.displacement_m,
        structure: ordinate(2)?,
        beyond_capacity,
        overturning: risk_of_exceeding(&own, weights, OVERTURNING_M, years)?,
        analyses: stripes.analyses,
    })
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
    Ok([outcome(Rule::EqualDisplacement)?, outcome(Rule::EqualEnergy)?])
}

/// Error of a demand (m) against the exact one: `(u − u_exact)/u_exact`, negative where it is on the unsafe side. `−1` where only the
/// exact one is infinite, `+∞` where only the other is, 0 where both are; none where the exact one is 0.
pub fn relative_error(demand_m: f64, exact_m: f64) -> Option<f64> {
    match (demand_m.is_infinite(), exact_m.is_infinite()) {
        (true, true) => Some(0.0),
        (false, true) => Some(-1.0),
        _ if exact_m == 0.0 => None,
        _ => Some((demand_m - exact_m) / exact_m),
    }
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
