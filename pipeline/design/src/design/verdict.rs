//! What a design says of a structure: whether it is good enough, by rules, measures, its own demand and itself.

use uplift_ida::OSCILLATOR;
use uplift_job::text::{spectrum_words, to_the_centimetre, two_digits};

use super::DesignReport;
use crate::certainty::DemandBands;
use crate::limit::FrameLimit;
use crate::own_structure::OwnModel;
use crate::rules::{OwnCheck, RuleOutcome, verdict_word, verdicts_in_words};

impl DesignReport {
    /// The models of the structure itself, the one that decides first; none where it is not analysed.
    pub fn own_models(&self) -> impl Iterator<Item = &OwnModel> {
        self.own.iter().flat_map(|own| &own.models)
    }

    /// How many times as far as its proxy, the equivalent oscillator, the structure itself goes; none where it is not
    /// analysed, or where either overturns more often than the target.
    pub fn own_over_proxy(&self) -> Option<f64> {
        let ratio = self.own.as_ref()?.decisive().demand_m / self.exact.as_ref()?.demand_m;
        Some(ratio).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
    }

    /// Whether the verdict on the structure itself is another than that of a rule on its proxy; none without a verdict
    /// on each.
    pub fn verdicts_differ(&self) -> Option<bool> {
        let own = self.own.as_ref()?.decisive().check?;
        let mut checks = self.rules.iter().filter_map(RuleOutcome::check).peekable();
        checks.peek()?;
        Some(checks.any(|check| check.satisfied != own.satisfied))
    }

    /// Whether the structure satisfies both rules and its own demand, by each measure where they differ:
    /// `satisfied by PGV, NOT satisfied by PGA; safety factor 2.5 (Eq. 3.15)`.
    pub fn verdict(&self) -> String {
        let words = |im: &str| spectrum_words(im, self.repaired);
        let own = checks_in_short(&self.rules, self.own_check).map(|verdict| self.qualified(verdict));
        let others = self.by_other_measures.iter().map(|of| (words(of.im), checks_in_short(&of.rules, None)));
        let by_measure: Vec<(String, String)> = std::iter::once((self.spectrum_words(), own))
            .chain(others)
            .filter_map(|(measure, verdict)| Some((measure, verdict?)))
            .collect();
        let Some((_, first)) = by_measure.first() else { return "no rule applies".to_owned() };
        let verdict = if by_measure.iter().all(|(_, verdict)| verdict == first) {
            first.clone()
        } else {
            let each = by_measure.iter().map(|(measure, verdict)| format!("{verdict} by {measure}"));
            each.collect::<Vec<_>>().join("; ")
        };
        format!("{verdict}; safety factor {} (Eq. 3.15)", self.required_safety_factor)
    }

    /// `capacity 1.21 m, tendon yield 1.08 m`; none of a structure without a capacity.
    pub fn capacity_words(&self) -> Option<String> {
        let capacity_m = self.structure.capacity_m?;
        let yields = self.structure.tendon_limit.filter(|limit| limit.displacement_m < capacity_m);
        let yields = yields.map_or_else(String::new, |limit| {
            format!(", {} {} m", limit.event.noun(), to_the_centimetre(limit.displacement_m))
        });
        Some(format!("capacity {capacity_m:.2} m{yields}"))
    }

    /// The verdict of a check of a demand: `satisfied, not at the upper limit, beyond tendon yield`.
    pub fn verdict_of(&self, check: OwnCheck) -> String {
        let limit = self.limit_before(check).filter(|_| check.satisfied);
        check.verdict() + &limit.map_or_else(String::new, |limit| format!(", beyond {}", limit.event.noun()))
    }

    /// The limit of the tendons, where it comes before the capacity that a check requires.
    fn limit_before(&self, check: OwnCheck) -> Option<FrameLimit> {
        self.structure.tendon_limit.filter(|limit| check.required_capacity_m > limit.displacement_m)
    }

    /// A verdict on the oscillator that is satisfied, in the words of the check of its demand.
    fn qualified(&self, verdict: String) -> String {
        let own = self.own_check.filter(|_| verdict == verdict_word(true));
        own.map_or(verdict, |own| self.verdict_of(own))
    }

    /// The verdict on the proxy: `satisfied`; none where no rule applies.
    pub fn verdict_on_proxy(&self) -> Option<String> {
        Some(self.qualified(verdict_of_rules(&self.rules, self.own_check)?))
    }

    /// The verdicts by the spectrum's measure: `by PGV: satisfied by equal displacement (requires 0.48 m); NOT
    /// satisfied by equal energy (requires 0.62 m), 2.5 times its own demand (0.60 m)`; none where no rule applies.
    pub fn verdicts(&self) -> Option<String> {
        let own = self.own_check.map(|own| (own, self.required_safety_factor));
        let verdicts = verdicts_in_words(&self.rules, own)?;
        Some(format!("by {}: {verdicts}", self.spectrum_words()))
    }

    /// The same by other measures, and of a structure that is analysed itself, which may tell another story, the
    /// verdict of the rules: `rules by PGA: NOT satisfied`. A measure by which every rule is satisfied is
    /// left out where every rule is satisfied here, too, and there is the oscillator alone.
    pub fn verdicts_by_other_measures(&self) -> Vec<(&'static str, String)> {
        let is_satisfied = |rules: &[RuleOutcome]| rules.iter().filter_map(RuleOutcome::check).all(|of| of.satisfied);
        let told = self.by_other_measures.iter().filter_map(|of| {
            let by = spectrum_words(of.im, self.repaired);
            if self.own.is_some() {
                return Some((of.im, format!("rules by {by}: {}", verdict_of_rules(&of.rules, None)?)));
            }
            let verdicts = verdicts_in_words(&of.rules, None)?;
            let is_silent = is_satisfied(&of.rules) && is_satisfied(&self.rules);
            (!is_silent).then(|| (of.im, format!("by {by}: {verdicts}")))
        });
        told.collect()
    }

    /// Whose demand is satisfied, and is not at the upper limit of its band, with `not satisfied at the upper limit of
    /// the demand's band, 0.50 m (requires 1.25 m)`.
    pub fn unsafe_upper_limits(&self) -> Vec<(&'static str, String)> {
        let itself = self.own_models();
        let all = itself
            .map(|of| (of.model, of.check, of.bands.as_ref()))
            .chain(self.exact.iter().map(|exact| (self.of_oscillator(), self.own_check, exact.bands.as_ref())));
        all.filter_map(|(whose, check, bands)| Some((whose, self.unsafe_upper_limit(check?, bands?)?))).collect()
    }

    /// By what the oscillator's demand goes in verdicts: its name beside the structure itself.
    fn of_oscillator(&self) -> &'static str {
        if self.own.is_some() { OSCILLATOR } else { "own demand" }
    }

    /// What of the verdict, on the structure itself where it is analysed, lies beyond the yield of the tendons: the
    /// upper limit of the demand, `the demand's band reaches 0.50 m, beyond the tendon yield at 0.42 m`, or else the
    /// required capacity. None where the demand is not satisfied anyway.
    pub fn beyond_tendon(&self) -> Option<String> {
        let limit = self.structure.tendon_limit?;
        let (check, bands) = match &self.own {
            Some(own) => (own.decisive().check, own.decisive().bands.as_ref()),
            None => (self.own_check, self.exact.as_ref()?.bands.as_ref()),
        };
        if check.is_some_and(|check| !check.satisfied) {
            return None;
        }
        let metres = |value_m: f64| {
            if value_m.is_finite() { format!("{} m", two_digits(value_m)) } else { "overturning".to_owned() }
        };
        let upper_m = bands.map(|bands| bands.demand_m.quoted()[1]);
        if let Some(upper_m) = upper_m.filter(|&upper_m| upper_m > limit.displacement_m) {
            return Some(format!("the demand's band reaches {}, beyond the {}", metres(upper_m), limit.in_words()));
        }
        let check = check?;
        self.limit_before(check).map(|limit| {
            format!(
                "the required {} are beyond the {}: the capacity takes tendons as elastic",
                metres(check.required_capacity_m),
                limit.in_words()
            )
        })
    }

    fn unsafe_upper_limit(&self, check: OwnCheck, bands: &DemandBands) -> Option<String> {
        let [_, upper_m] = bands.demand_m.quoted();
        let required_m = self.required_safety_factor * upper_m;
        check.is_unsafe_at_upper_limit().then(|| {
            if required_m.is_finite() {
                let upper = two_digits(upper_m);
                format!("not satisfied at the upper limit of the demand's band, {upper} m (requires {required_m:.2} m)")
            } else {
                "not satisfied at the upper limit of the demand's band, where it overturns".to_owned()
            }
        })
    }

    /// By which spectrum, in words: `PGV`, or `PGV, repaired`.
    pub fn spectrum_words(&self) -> String {
        spectrum_words(self.im, self.repaired)
    }
}

/// Whether the rules and the structure's own demand are satisfied, and where they differ how many are; none where none
/// applies.
fn checks_in_short(rules: &[RuleOutcome], own: Option<OwnCheck>) -> Option<String> {
    let rules = rules.iter().filter_map(|outcome| Some(outcome.check()?.satisfied));
    let all: Vec<bool> = rules.chain(own.map(|own| own.satisfied)).collect();
    let met = all.iter().filter(|satisfied| **satisfied).count();
    match all.len() - met {
        _ if all.is_empty() => None,
        0 => Some(verdict_word(true).to_owned()),
        missed if met > 0 => Some(format!("{} by {missed} of {} checks", verdict_word(false), all.len())),
        _ => Some(verdict_word(false).to_owned()),
    }
}

/// What the rules, and the structure's own demand, say together: where they differ, `partly satisfied (by equal
/// displacement, NOT by equal energy)`; none where none applies.
fn verdict_of_rules(rules: &[RuleOutcome], own: Option<OwnCheck>) -> Option<String> {
    let checks = rules.iter().filter_map(|outcome| Some((outcome.check()?.satisfied, outcome.rule.words())));
    let (met, missed): (Vec<_>, Vec<_>) =
        checks.chain(own.map(|own| (own.satisfied, "its own demand"))).partition(|(satisfied, _)| *satisfied);
    let names = |of: &[(bool, &str)]| of.iter().map(|(_, name)| *name).collect::<Vec<_>>().join(" and ");
    match [met.is_empty(), missed.is_empty()] {
        [true, true] => None,
        [false, false] => Some(format!("partly satisfied (by {}, NOT by {})", names(&met), names(&missed))),
        [_, satisfied] => Some(verdict_word(satisfied).to_owned()),
    }
}
