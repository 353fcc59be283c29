//! The design example of Section 3.4.5: a restrained bridge by both rules, and by time histories (Tables 3.2–3.7).

use uplift_ida::System;
use uplift_oscillator::{Oscillator, PostUplift};
use uplift_structure::{Capacity, Rule, design};

use crate::demand::Case;
use crate::error::SpectraError;
use crate::noise::{NoiseSweep, Noisy, errors};

/// What is designed, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestrainedDesign {
    /// Strength η = `f_up`/(m g) \[-\].
    pub strength: f64,
    /// Uplift displacement `u_up` \[m\].
    pub uplift_displacement_m: f64,
    /// Coefficient of restitution \[-\].
    pub restitution: f64,
    /// Acceleration of gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// Capacity without any restraint \[m\], 2b in the text: the designed one is not below it.
    pub least_capacity_m: f64,
    /// Safety factor FS of Eq. 3.15 \[-\].
    pub safety_factor: f64,
    /// Percentile of the displacements that counts, 50 in the text.
    pub percent: f64,
    /// Whether the first peak after the end of a record counts.
    pub with_free_vibration: bool,
}

/// One column of a table, with the noise of each of its values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestrainedExample {
    /// Demand on the zero-stiffness system `u_dem,ZS`, m.
    pub zero_stiffness_m: Noisy,
    /// Designed capacity `u_cap`, m (Eq. 3.15).
    pub capacity_m: Noisy,
    /// Demand on the designed system from time histories `u_dem,TH`, m.
    pub time_history_m: Noisy,
    /// Demand by the rule, `γ u_dem,ZS`, m.
    pub rule_m: Noisy,
    /// The rule's error, `(rule − time history)/time history` \[-\]: −1 where only the time histories overturn.
    pub error: Noisy,
}

impl RestrainedDesign {
    /// Design by `rule` for a set at a scaling, and check the design by time histories; the whole procedure at every
    /// strength of the sweep.
    ///
    /// # Errors
    /// What the oscillator, the rule and the solver refuse; what carrying out ends with.
    ///
    /// # Source
    /// Reggiani Manzo, Section 3.4.5.
    pub fn example(&self, case: Case<'_>, rule: Rule, noise: NoiseSweep) -> Result<RestrainedExample, SpectraError> {
        let strengths: Vec<f64> = noise.factors().iter().map(|factor| factor * self.strength).collect();
        let demands_m = |post_uplift: &[PostUplift]| -> Result<Vec<f64>, SpectraError> {
            let systems = strengths
                .iter()
                .zip(post_uplift)
                .map(|(strength, post_uplift)| self.oscillator(*strength, *post_uplift).map(System::Oscillator))
                .collect::<Result<Vec<_>, _>>()?;
            case.demands_m(&systems, self.with_free_vibration, self.percent)
        };
        let zero_stiffness_m = demands_m(&vec![PostUplift::Zero; strengths.len()])?;
        let own = Capacity::new(self.uplift_displacement_m, self.least_capacity_m)?;
        let checks = zero_stiffness_m
            .iter()
            .map(|zero_m| design(&own, rule, self.safety_factor, *zero_m))
            .collect::<Result<Vec<_>, _>>()?;
        let capacity_m: Vec<f64> = checks.iter().map(|check| check.capacity_m).collect();
        let negative: Vec<_> =
            capacity_m.iter().map(|capacity_m| PostUplift::Negative { capacity_m: *capacity_m }).collect();
        let time_history_m = demands_m(&negative)?;
        let rule_m: Vec<f64> = checks.iter().map(|check| check.demand.displacement_m()).collect();
        let error = errors(&rule_m, &time_history_m);
        Ok(RestrainedExample {
            zero_stiffness_m: Noisy::from_sweep(&zero_stiffness_m),
            capacity_m: Noisy::from_sweep(&capacity_m),
            time_history_m: Noisy::from_sweep(&time_history_m),
            rule_m: Noisy::from_sweep(&rule_m),
            error: Noisy::from_sweep(&error),
        })
    }

    /// How far rounding alone moves the values of `example`, which [`example`](Self::example) gave for this case: the
    /// procedure at its strength with all scale factors some roundings smaller and larger ([`nudges`](crate::nudges)).
    ///
    /// # Errors
    /// As [`example`](Self::example).
    pub fn rounding(
        &self,
        case: Case<'_>,
        rule: Rule,
        example: &RestrainedExample,
    ) -> Result<RestrainedExample, SpectraError> {
        let repeated = |nudged| self.example(nudged, rule, NoiseSweep::POINT);
        let nudged = case.nudged().map(repeated).collect::<Result<Vec<_>, _>>()?;
        let around = |value: fn(&RestrainedExample) -> Noisy| {
            Noisy::around(value(example).value, nudged.iter().map(|nudged| value(nudged).value))
        };
        Ok(RestrainedExample {
            zero_stiffness_m: around(|example| example.zero_stiffness_m),
            capacity_m: around(|example| example.capacity_m),
            time_history_m: around(|example| example.time_history_m),
            rule_m: around(|example| example.rule_m),
            error: around(|example| example.error),
        })
    }

    fn oscillator(&self, strength: f64, post_uplift: PostUplift) -> Result<Oscillator, SpectraError> {
        let Self { gravity_m_s2, uplift_displacement_m, restitution, .. } = *self;
        Ok(Oscillator::new(strength, gravity_m_s2, uplift_displacement_m, restitution, post_uplift)?)
    }
}
