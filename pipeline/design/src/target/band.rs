//! How sure a found value is: the search repeated for resampled records, and for the structures that it may be, on the
//! stripes that were analysed.

use serde::{Serialize, Serializer};
use uplift_bootstrap::{BootstrapError, ResamplingPlan, Unit, weighted_quantile};
use uplift_fragility::quantile;
use uplift_risk::RecordSample;
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::consistency::Question;

use super::candidate::Attempt;
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::uncertain::{Around, QuantityReport};

/// What other records would have given, drawn from these with replacement (Section 4.5), or other structures.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TargetBand {
    /// Share of the replicates between the limits.
    pub confidence: f64,
    /// How many replicates there are; of resamples with each hazard curve their pairs.
    pub replicates: usize,
    /// What was drawn: `record`, `pair` or `event`; `hazard and record`, where every draw goes with each of the
    /// weighted hazard curves; `structure`, of those that it may be, `structure and record`, or `structure, hazard and
    /// record`.
    #[serde(rename = "unit")]
    pub drawn: Drawn,
    /// Lower limit, median and upper limit of the value, in its unit; infinite beyond the values searched.
    pub value: [f64; 3],
    /// The same of the frequency at the value that was found, 1/yr.
    pub per_year: [f64; 3],
    /// Share of the replicates whose value lies below all that were analysed, so that it is counted as the smallest.
    pub below_share: f64,
    /// Share of the replicates that miss the target at the largest value.
    pub beyond_share: f64,
}

/// What a band is drawn from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Drawn {
    /// The structures that it may be.
    pub structures: bool,
    /// The weighted hazard curves of the site.
    pub hazard: bool,
    /// Records, by this unit.
    pub records: Option<Unit>,
}

impl Drawn {
    /// `record`, `hazard and record`, `structure, hazard and record`, ….
    pub fn key(self) -> String {
        let names =
            [self.structures.then_some("structure"), self.hazard.then_some("hazard"), self.records.map(Unit::key)];
        listed(names)
    }

    /// `resampled records`, `records and hazard`, `structure, earthquakes and hazard`, ….
    pub fn words(self) -> String {
        let records = self.records.map(|unit| if unit == Unit::Event { "earthquakes" } else { "records" });
        match (self.structures, self.hazard, records) {
            (false, false, Some(records)) => format!("resampled {records}"),
            (structures, hazard, records) => {
                listed([structures.then_some("structure"), records, hazard.then_some("hazard")])
            }
        }
    }
}

/// The names that there are, with commas and an "and".
fn listed(names: [Option<&str>; 3]) -> String {
    let names: Vec<&str> = names.into_iter().flatten().collect();
    match names.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, before)) => format!("{} and {last}", before.join(", ")),
        None => String::new(),
    }
}

impl Serialize for Drawn {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.key())
    }
}

/// The structures that every value of a search may be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetUncertainty {
    /// `epistemic`, branches, of which the mean risk meets the target; or `aleatory`, structures of each record with
    /// one risk.
    pub kind: &'static str,
    /// `sobol` or `latin-hypercube`.
    pub sampling: &'static str,
    /// Where the random numbers began.
    pub seed: u64,
    /// Structures that shake under a record at every value.
    pub structures: usize,
    /// What is not known exactly, of the structure as described; at every other value it differs by the same factors.
    pub quantities: Vec<QuantityReport>,
    /// The value that each branch by itself would need; none where there are no branches.
    pub by_structure: Option<TargetBand>,
    /// The same with records drawn again.
    pub by_all: Option<TargetBand>,
}

impl TargetUncertainty {
    /// Of the structures `around` every value, with the `bands` of branches by themselves and with the records.
    pub(super) fn from_bands(around: &Around<'_>, bands: Option<[TargetBand; 2]>) -> Self {
        let (kind, sampling, seed) = around.sampled();
        let [by_structure, by_all] = bands.map_or([None, None], |bands| bands.map(Some));
        let (structures, quantities) = (around.per_record(), around.quantities());
        Self { kind, sampling, seed, structures, quantities, by_structure, by_all }
    }
}

/// Bands of a found value.
pub(super) struct TargetBands {
    /// By records.
    pub(super) records: TargetBand,
    /// By records and the weighted hazard curves of the site; none where it has but one.
    pub(super) with_hazard: Option<TargetBand>,
    /// By the structures that it may be, one a branch; by structures, records and hazard. None without branches.
    pub(super) structures: Option<[TargetBand; 2]>,
}

/// The bands of the value from which on `tried`, ascending, meet `target_per_year`; `found` is its position.
///
/// # Errors
/// Draws of the study that cannot be.
pub(super) fn band(
    (tried, found): (&[(f64, Attempt)], usize),
    (target_per_year, hazard): (f64, &Hazard<'_>),
    study: &UniformRiskStudy,
    motions: &Question,
) -> Result<TargetBands, DesignError> {
    let (settings, pair_of, event_of) = (&study.bootstrap, motions.pair_of(), motions.event_of());
    let replicates = usize::try_from(settings.replicates).unwrap_or(usize::MAX);
    let size = u32::try_from(event_of.len()).unwrap_or(u32::MAX);
    let draw = |unit| match unit {
        Unit::Record => ResamplingPlan::draw(event_of.len(), &[size], replicates, study.seed),
        Unit::Pair => ResamplingPlan::draw_pairs(&pair_of, &[size], replicates, study.seed),
        Unit::Event => ResamplingPlan::draw_events(&event_of, &[size], replicates, study.seed),
    };
    // each motion shakes the structure once, whatever structures of the study
    let once = UniformRiskStudy { uncertainty: None, ..study.clone() };
    let plan = match draw(once.drawn_unit(None)) {
        // a single earthquake or pair: nothing else can be drawn than its records
        Err(BootstrapError::OneEvent | BootstrapError::OnePair) => draw(Unit::Record)?,
        plan => plan?,
    };
    let samples = plan.samples();
    let of_records = |sample: &RecordSample, place: usize| resampled_per_year(&tried[place].1.record_per_year, sample);
    let search = Search { tried, found, target_per_year, confidence: settings.confidence };
    let of_unit = Drawn { structures: false, hazard: false, records: Some(plan.unit()) };
    let records = search.band(samples.len(), of_unit, &|replicate, place| of_records(&samples[replicate], place));
    let with_hazard = (!hazard.branches.is_empty()).then(|| search.band_with_hazard(samples, hazard, plan.unit()));
    let branches = tried[found].1.structures.len();
    if branches == 1 {
        return Ok(TargetBands { records, with_hazard, structures: None });
    }
    let alone = search.band(branches, Drawn { structures: true, hazard: false, records: None }, &|branch, place| {
        tried[place].1.structures[branch].risk.per_year
    });
    let drawn = Drawn { structures: true, hazard: with_hazard.is_some(), ..of_unit };
    // in turn: every structure as often as the others, but for one time
    let all = search.band(samples.len(), drawn, &|replicate, place| {
        let structure = &tried[place].1.structures[replicate % branches];
        let record_per_year = structure.with_hazard.as_ref().unwrap_or(&structure.record_per_year);
        resampled_per_year(record_per_year, &samples[replicate])
    });
    Ok(TargetBands { records, with_hazard, structures: Some([alone, all]) })
}

/// What was tried, ascending, and what was found there.
struct Search<'a> {
    tried: &'a [(f64, Attempt)],
    found: usize,
    target_per_year: f64,
    confidence: f64,
}

impl Search<'_> {
    /// The band of so many `replicates`, whose frequencies at every place are `rate`, 1/yr.
    fn band(&self, replicates: usize, drawn: Drawn, rate: &dyn Fn(usize, usize) -> f64) -> TargetBand {
        let found: Vec<(Needed, f64)> =
            (0..replicates).map(|replicate| (self.needed(&|place| rate(replicate, place)), 1.0)).collect();
        let quantile_of = |sorted: &[(f64, f64)], level| {
            let values: Vec<f64> = sorted.iter().map(|(value, _)| *value).collect();
            quantile(&values, level)
        };
        self.told(&found, (replicates, drawn), &quantile_of)
    }

    /// The band of all pairs of the `samples`, drawn by `unit`, and a curve of the `hazard`: a pair weighs as the curve
    /// does.
    fn band_with_hazard(&self, samples: &[RecordSample], hazard: &Hazard<'_>, unit: Unit) -> TargetBand {
        let mut found: Vec<(Needed, f64)> = Vec::with_capacity(samples.len() * hazard.branches.len());
        for (weight, stripes) in &hazard.branches {
            let per_year = stripes.per_year();
            let contributed: Vec<Vec<f64>> =
                self.tried.iter().map(|(_, attempt)| attempt.record_per_year_by(&per_year)).collect();
            let of_sample = |sample| self.needed(&|place: usize| resampled_per_year(&contributed[place], sample));
            found.extend(samples.iter().map(|sample| (of_sample(sample), *weight)));
        }
        self.told(
            &found,
            (found.len(), Drawn { structures: false, hazard: true, records: Some(unit) }),
            &weighted_quantile,
        )
    }

    /// The band of what is `found`, each with its weight.
    fn told(
        &self,
        found: &[(Needed, f64)],
        (replicates, drawn): (usize, Drawn),
        quantile_of: &QuantileOf,
    ) -> TargetBand {
        let tail = 0.5 * (1.0 - self.confidence);
        let limits = |of: fn(&Needed) -> f64| {
            let mut all: Vec<(f64, f64)> = found.iter().map(|(needed, weight)| (of(needed), *weight)).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            [tail, 0.5, 1.0 - tail].map(|level| quantile_of(&all, level))
        };
        let total: f64 = found.iter().map(|(_, weight)| weight).sum();
        let share = |of: fn(&Needed) -> bool| {
            let those = found.iter().filter(|(needed, _)| of(needed));
            if total > 0.0 { those.map(|(_, weight)| weight).sum::<f64>() / total } else { 0.0 }
        };
        TargetBand {
            confidence: self.confidence,
            replicates,
            drawn,
            value: limits(|needed| needed.value),
            per_year: limits(|needed| needed.per_year),
            below_share: share(|needed| needed.is_below),
            beyond_share: share(|needed| needed.value.is_infinite()),
        }
    }

    /// What is needed where the frequencies at every place are `rate`, 1/yr.
    fn needed(&self, rate: &dyn Fn(usize) -> f64) -> Needed {
        let Self { tried, found, target_per_year, .. } = *self;
        let missed = (0..tried.len()).rev().find(|&place| rate(place) > target_per_year);
        let value = match missed {
            None => tried[0].0,
            Some(last) if last + 1 == tried.len() => f64::INFINITY,
            Some(missed) => {
                let (from, to) = (tried[missed].0, tried[missed + 1].0);
                let [high, low] = [rate(missed), rate(missed + 1)];
                // straight in logarithms; where nothing is left of the frequency, the value that was analysed
                let share = if low > 0.0 { (high / target_per_year).ln() / (high / low).ln() } else { 1.0 };
                from * (to / from).powf(share)
            }
        };
        Needed { value, per_year: rate(found), is_below: missed.is_none() }
    }
}

/// A quantile of values with their weights, sorted by value.
type QuantileOf = dyn Fn(&[(f64, f64)], f64) -> f64;

/// What a replicate needs.
struct Needed {
    /// The value from which on it meets the target: the smallest that was analysed where all do, infinite where none
    /// does.
    value: f64,
    /// Its frequency at the value that was found, 1/yr.
    per_year: f64,
    /// Whether all that was analysed meets the target.
    is_below: bool,
}

/// The frequency for a sample of the records, from what each contributes, 1/yr.
fn resampled_per_year(record_per_year: &[f64], sample: &RecordSample) -> f64 {
    let drawn = sample.multiplicities().iter().zip(record_per_year);
    drawn.map(|(&times, per_year)| f64::from(times) * per_year).sum::<f64>() / f64::from(sample.size())
}
