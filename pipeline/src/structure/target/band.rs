//! How sure a found value is: the search repeated for resampled records, and for the structures that it may be, on the
//! stripes that were analysed.

use serde::Serialize;
use uplift_bootstrap::{BootstrapError, ResamplingPlan, Unit};
use uplift_fragility::quantile;
use uplift_risk::RecordSample;
use uplift_study::UniformRiskStudy;

use super::candidate::Attempt;
use crate::consistency::Question;
use crate::error::UpliftError;

/// What other records would have given, drawn from these with replacement (Section 4.5), or other structures.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TargetBand {
    /// Share of the replicates between the limits.
    pub confidence: f64,
    /// How many replicates there are.
    pub replicates: usize,
    /// What was drawn: `record`, `pair` or `event`; `structure`, of those that it may be, or `structure and record`.
    pub unit: &'static str,
    /// Lower limit, median and upper limit of the value, in its unit; infinite beyond the values searched.
    pub value: [f64; 3],
    /// The same of the frequency at the value that was found, 1/yr.
    pub per_year: [f64; 3],
    /// Share of the replicates whose value lies below all that were analysed, so that it is counted as the smallest.
    pub below_share: f64,
    /// Share of the replicates that miss the target at the largest value.
    pub beyond_share: f64,
}

/// Bands of a found value.
pub(super) struct Bands {
    /// By records.
    pub(super) records: TargetBand,
    /// By the structures that it may be, one a branch; by structures and records. None without branches.
    pub(super) structures: Option<[TargetBand; 2]>,
}

/// The bands of the value from which on `tried`, ascending, meet `target_per_year`; `found` is its position.
///
/// # Errors
/// Draws of the study that cannot be.
pub(super) fn band(
    tried: &[(f64, Attempt)],
    (found, target_per_year): (usize, f64),
    study: &UniformRiskStudy,
    motions: &Question,
) -> Result<Bands, UpliftError> {
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
    let records =
        search.band(samples.len(), plan.unit().key(), &|replicate, place| of_records(&samples[replicate], place));
    let branches = tried[found].1.structures.len();
    if branches == 1 {
        return Ok(Bands { records, structures: None });
    }
    let alone = search.band(branches, "structure", &|branch, place| tried[place].1.structures[branch].risk.per_year);
    // in turn: every structure as often as the others, but for one time
    let all = search.band(samples.len(), with_structures(plan.unit()), &|replicate, place| {
        resampled_per_year(&tried[place].1.structures[replicate % branches].record_per_year, &samples[replicate])
    });
    Ok(Bands { records, structures: Some([alone, all]) })
}

/// What is drawn where structures are drawn too.
fn with_structures(unit: Unit) -> &'static str {
    match unit {
        Unit::Record => "structure and record",
        Unit::Pair => "structure and pair",
        Unit::Event => "structure and event",
    }
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
    fn band(&self, replicates: usize, unit: &'static str, rate: &dyn Fn(usize, usize) -> f64) -> TargetBand {
        let Self { tried, found, target_per_year, confidence } = *self;
        let (mut values, mut rates) = (Vec::with_capacity(replicates), Vec::with_capacity(replicates));
        let (mut below, mut beyond) = (0, 0);
        for replicate in 0..replicates {
            let rate = |place: usize| rate(replicate, place);
            let value = match (0..tried.len()).rev().find(|&place| rate(place) > target_per_year) {
                None => {
                    below += 1;
                    tried[0].0
                }
                Some(last) if last + 1 == tried.len() => {
                    beyond += 1;
                    f64::INFINITY
                }
                Some(missed) => {
                    let (from, to) = (tried[missed].0, tried[missed + 1].0);
                    let [high, low] = [rate(missed), rate(missed + 1)];
                    // straight in logarithms; where nothing is left of the frequency, the value that was analysed
                    let share = if low > 0.0 { (high / target_per_year).ln() / (high / low).ln() } else { 1.0 };
                    from * (to / from).powf(share)
                }
            };
            values.push(value);
            rates.push(rate(found));
        }
        let count = values.len().max(1) as f64;
        let tail = 0.5 * (1.0 - confidence);
        let limits = |mut all: Vec<f64>| {
            all.sort_by(f64::total_cmp);
            [tail, 0.5, 1.0 - tail].map(|level| quantile(&all, level))
        };
        TargetBand {
            confidence,
            replicates,
            unit,
            value: limits(values),
            per_year: limits(rates),
            below_share: f64::from(below) / count,
            beyond_share: f64::from(beyond) / count,
        }
    }
}

/// The frequency for a sample of the records, from what each contributes, 1/yr.
fn resampled_per_year(record_per_year: &[f64], sample: &RecordSample) -> f64 {
    let drawn = sample.multiplicities().iter().zip(record_per_year);
    drawn.map(|(&times, per_year)| f64::from(times) * per_year).sum::<f64>() / f64::from(sample.size())
}
