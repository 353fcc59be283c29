//! Many runs, a record at a time, so that the page can show how far they are and stop them.

use serde_json::{Value, json};
use uplift_block::RockingBlock;
use uplift_bootstrap::{inferred_rate, truth_limits};
use uplift_fragility::Stripes as Stripe;
use uplift_ida::{Plan, StripeRecord, System, Unwatched, analyse};
use uplift_motion::IntensityMeasure;
use uplift_oscillator::Oscillator;
use uplift_risk::{EventRisk, PooledDemand, RiskCurve, StripeWeights, at_most_per_year};
use uplift_structure::{Check, Rule};
use uplift_study::{Structure, UniformRiskStudy};

use crate::calculator::{Answer, At, refused};
use crate::motions::{Motion, Motions};
use crate::reading::{CONFIDENCE, per_cent};
use crate::stripes::{Measure, Stripes};
use crate::structure::parse;

/// A threshold that nothing but overturning exceeds.
const OVERTURNING_M: f64 = f64::MAX;

/// What was begun.
pub(crate) struct Analysis {
    systems: Vec<System>,
    measures: Vec<(IntensityMeasure, Vec<f64>)>,
    /// `[measure][record, system, level]`, m.
    peaks_m: Vec<Vec<f64>>,
    gravity_m_s2: f64,
    free_vibration: bool,
    /// Records that are finished, and all of them.
    pub(crate) done: usize,
    pub(crate) records: usize,
    purpose: Purpose,
}

enum Purpose {
    /// Stripes of the dropped records.
    Records,
    /// The demand on a structure with a safety factor, and how often it overturns.
    Structure(Box<Structure>, At, f64),
}

impl Analysis {
    /// Of the dropped records, at all strengths and by all measures of `stripes`.
    pub(crate) fn from_records(stripes: &Stripes, motions: &Motions) -> Answer<Self> {
        let study = &stripes.study;
        let own = |&strength: &f64| oscillator(study, strength);
        let systems = study.strengths.iter().map(own).collect::<Answer<_>>()?;
        let measures = stripes.measures.iter().map(|of| (of.measure, of.levels.clone())).collect();
        let records = motions.dropped().len();
        if records == 0 {
            return Err("no record was dropped".to_owned());
        }
        Ok(Self::new(study, (systems, measures), (records, study.oscillator.free_vibration), Purpose::Records))
    }

    /// Of a structure, by the measure of `at`: its equivalent oscillator, and where it is asked for and there is one,
    /// the block that rotates as it does.
    pub(crate) fn from_structure(
        stripes: &Stripes,
        motions: &mut Motions,
        (text, with_block, safety_factor): (&str, bool, f64),
        at: &At,
    ) -> Answer<Self> {
        let structure = parse(text)?;
        let of = stripes.place(at)?.of;
        let restitution = structure.description.restitution.unwrap_or(stripes.study.oscillator.restitution);
        let oscillator = structure.system.spectral_oscillator(restitution).map_err(refused)?;
        let mut systems = vec![System::Oscillator(oscillator)];
        if with_block && let Some(of) = structure.block {
            let block = RockingBlock::new(of.size_m, of.slenderness_rad)
                .and_then(|block| block.with_gravity(structure.system.conditions().gravity_m_s2()))
                .and_then(|block| block.with_restitution(structure.description.restitution.unwrap_or(of.restitution)));
            systems.push(System::Block(block.map_err(refused)?));
        }
        let measures = vec![(of.measure, of.levels.clone())];
        let records = motions.all()?.len();
        let purpose = Purpose::Structure(Box::new(structure), at.clone(), safety_factor);
        // what is lost when a record ends has overturned
        Ok(Self::new(&stripes.study, (systems, measures), (records, true), purpose))
    }

    fn new(
        study: &UniformRiskStudy,
        (systems, measures): (Vec<System>, Vec<(IntensityMeasure, Vec<f64>)>),
        (records, free_vibration): (usize, bool),
        purpose: Purpose,
    ) -> Self {
        let peaks_m = vec![Vec::new(); measures.len()];
        let gravity_m_s2 = study.gravity_m_s2;
        Self { systems, measures, peaks_m, gravity_m_s2, free_vibration, done: 0, records, purpose }
    }

    /// Runs the next record; whether there was one.
    pub(crate) fn step(&mut self, motions: &Motions) -> Answer<bool> {
        let all = match self.purpose {
            Purpose::Records => motions.dropped(),
            Purpose::Structure(..) => motions.known(),
        };
        if self.done == self.records {
            return Ok(false);
        }
        let motion = all.get(self.done).filter(|_| all.len() == self.records);
        let motion = motion.ok_or("the records changed while they were analysed: begin again")?;
        for ((measure, levels), peaks_m) in self.measures.iter().zip(&mut self.peaks_m) {
            let intensity = measure.amplitude(motion.intensity(*measure, self.gravity_m_s2));
            let record = StripeRecord { id: motion.id(), accelerogram: motion.accelerogram(), intensity };
            let levels: Vec<f64> = levels.iter().map(|&level| measure.amplitude(level)).collect();
            let plan = Plan::stripes(vec![record], &self.systems, &levels, self.free_vibration).map_err(refused)?;
            peaks_m.extend_from_slice(analyse(&plan, &Unwatched).map_err(refused)?.displacement_m());
        }
        self.done += 1;
        Ok(true)
    }

    /// What comes of it.
    pub(crate) fn finish(self, stripes: &mut Stripes, motions: &Motions) -> Answer<Value> {
        match &self.purpose {
            Purpose::Records => {
                let records: Vec<String> = motions.dropped().iter().map(|own: &Motion| own.id().to_owned()).collect();
                let manifest = motions.dropped().iter().map(Motion::row).collect();
                let units: Vec<Vec<usize>> = (0..records.len()).map(|record| vec![record]).collect();
                let measure = |(plan, peaks_m): (&(IntensityMeasure, Vec<f64>), &Vec<f64>)| {
                    let peaks = (records.len(), self.systems.len(), &peaks_m[..]);
                    Measure::new(plan.clone(), ("records".to_owned(), units.clone()), peaks)
                };
                let measures = self.measures.iter().zip(&self.peaks_m).map(measure).collect::<Answer<Vec<_>>>()?;
                stripes.replace(records, manifest, measures);
                Ok(stripes.about())
            }
            Purpose::Structure(structure, at, safety_factor) => {
                self.answer_structure((structure, *safety_factor), stripes, at)
            }
        }
    }

    fn answer_structure(
        &self,
        (structure, safety_factor): (&Structure, f64),
        stripes: &Stripes,
        at: &At,
    ) -> Answer<Value> {
        let (place, risk) = (stripes.place(at)?, stripes.risk(at)?);
        let (weights, years, factor) = (place.weights, risk.years, structure.system.participation());
        let units: Vec<Vec<usize>> = if self.records == stripes.records.len() {
            place.of.units.clone()
        } else {
            (0..self.records).map(|record| vec![record]).collect()
        };
        let levels = &self.measures[0].1;
        let demand = |system: usize| {
            let stride = self.systems.len() * levels.len();
            let peaks_m = &self.peaks_m[0][system * levels.len()..];
            let stripe = Stripe::strided(levels, peaks_m, self.records, stride).map_err(refused)?;
            PooledDemand::new(&stripe).map_err(refused)
        };
        let own = demand(0)?;
        let capacity_m = structure.system.capacity_m();
        let ordinate = RiskCurve::new(&own, weights).and_then(|curve| curve.exact_ordinate(risk.per_year));
        let ordinate = ordinate.map_err(refused)?;
        let band_m = truth_limits(&own, weights, &units, &[risk.per_year], CONFIDENCE).map_err(refused)?[0];
        let beyond = match &self.systems[0] {
            System::Oscillator(own) => Some(own.capacity_m()).filter(|capacity_m| capacity_m.is_finite()),
            System::Block(_) | System::Frame(_) => None,
        };
        let ends = (levels[0], levels[levels.len() - 1], place.of.measure.unit());
        let event = |demand: &PooledDemand, threshold_m: f64, may_happen: bool| {
            event(demand, (weights, &units), (threshold_m, years), ends, may_happen)
        };
        let beyond = beyond.map(|threshold_m| event(&own, threshold_m, true)).transpose()?;
        let mut overturning = Vec::new();
        for (index, system) in self.systems.iter().enumerate() {
            let may = system.can_overturn() && (index > 0 || capacity_m.is_some());
            let mut found = event(&demand(index)?, OVERTURNING_M, may)?;
            found["model"] = system.kind().into();
            overturning.push(found);
        }
        let demand_m = factor * ordinate.displacement_m;
        Ok(json!({
            "check": own_check(structure, safety_factor, demand_m)?,
            "upper_check": own_check(structure, safety_factor, factor * band_m[1])?,
            "analyses": self.records * self.systems.len() * levels.len(),
            "records": self.records,
            "demand_m": demand_m,
            "overturns": ordinate.displacement_m.is_infinite(),
            "demand_band_m": band_m.map(|limit_m| factor * limit_m),
            "capacity_m": capacity_m,
            "beyond_capacity": beyond,
            "overturning": overturning,
        }))
    }
}

/// The capacity of a structure held against its own demand, m, which no rule estimates: the safety factor times the
/// demand is required, as `uplift design` has it. None where the force does not fall after uplift.
fn own_check(structure: &Structure, safety_factor: f64, demand_m: f64) -> Answer<Value> {
    if structure.system.capacity_m().is_none() || demand_m.is_nan() {
        return Ok(Value::Null);
    }
    if demand_m.is_infinite() {
        return Ok(json!({ "required_capacity_m": null, "safety_factor": 0.0, "satisfied": false }));
    }
    let check =
        Check::from_system(&structure.system, Rule::EqualDisplacement, safety_factor, demand_m).map_err(refused)?;
    Ok(json!({
        "required_capacity_m": check.required_capacity_m,
        "safety_factor": check.capacity_m / demand_m,
        "satisfied": check.is_satisfied(),
    }))
}

/// The oscillator of a study at a strength.
fn oscillator(study: &UniformRiskStudy, strength: f64) -> Answer<System> {
    let of = &study.oscillator;
    let oscillator =
        Oscillator::new(strength, study.gravity_m_s2, of.uplift_displacement_m, of.restitution, of.post_uplift);
    oscillator.map(System::Oscillator).map_err(refused)
}

/// How often `threshold_m` is exceeded, with its band, as `uplift overturning` has it, and what of that lies outside
/// the levels, of which the first, the last and the unit are given.
fn event(
    demand: &PooledDemand,
    (weights, units): (&StripeWeights, &[Vec<usize>]),
    (threshold_m, years): (f64, f64),
    (first, last, unit): (f64, f64, &str),
    may_happen: bool,
) -> Answer<Value> {
    let curve = RiskCurve::new(demand, weights).map_err(refused)?;
    let per_year = curve.mean_annual_frequency(threshold_m).map_err(refused)?;
    let parts = curve.disaggregation(threshold_m).map_err(refused)?;
    let tails = [parts.lower_tail_per_year, parts.upper_tail_per_year];
    let mut risk = EventRisk::new(per_year, tails, years).map_err(refused)?;
    if may_happen && per_year == 0.0 {
        risk.at_most_per_year = Some(at_most_per_year(weights, units.len() as f64));
    }
    let band = inferred_rate(demand, weights, units, (threshold_m, CONFIDENCE)).map_err(refused)?;
    let alarm = risk.outside_levels((first, last), unit, weights.upper_tail_per_year(), per_cent).map(|(_, told)| told);
    let mut told = serde_json::to_value(risk).map_err(refused)?;
    told["alarm"] = json!(alarm);
    told["may_happen"] = may_happen.into();
    // NaN of a single record, and 0 where no run exceeds it
    told["band_per_year"] = if band[1] > 0.0 { json!(band) } else { Value::Null };
    Ok(told)
}
