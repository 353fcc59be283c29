//! What a set of records says of the spectrum of all records there could be, and of that of another set.

use uplift_risk::{PooledDemand, RiskError, RunWeights, SiteWeights, check_count, check_target};

use crate::inversion::Inversion;
use crate::rates::Rates;
use crate::shared_rates::SharedRates;
use crate::skewed_mean::{SampleQuantiles, SkewedMean, StudentQuantiles};

/// How often a band that is quoted is to hold the number of all records there could be.
pub const QUOTED_CONFIDENCE: f64 = 0.9;

/// Limits of an ordinate beyond the set that it was computed with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InferredLimits {
    /// Lower and upper limit of the ordinate of all records there could be, m.
    pub truth_m: [f64; 2],
    /// Lower and upper limit of the ordinate of another set of as many units, m.
    pub prediction_m: [f64; 2],
}

/// Limits of exact ordinates at one site, `[target, size]`; NaN of a single unit.
///
/// A displacement c belongs to the band of a target rate λ* where λ(c), a mean over the units, does not differ from λ*
/// by more than chance allows ([`SkewedMean`]): the interval of a quantile by inverting that of its probability
/// (Woodruff, 1952). The band runs from the ordinate down to where λ(c) is first too large, and up to where it is first
/// too small, and from there that of demands that spread about those at hand. No resampling takes part.
///
/// - `weights`: those of a repair are taken as they are.
/// - `units`: the records of each unit, `[unit]`, by their positions; each record in one of them.
/// - `targets_per_year`: target rates λ*, 1/yr.
/// - `sizes`: units in a sample. For as many as the set has, the first band is that of the truth; for others it is
///   about what it would be with so many units like these. The second one is of another set of so many units.
/// - `confidence`: how often the band is to hold what it is of, between 0 and 1.
///
/// # Errors
/// Demand and weights with different numbers of levels or units of other records; a target that is not positive and
/// finite.
///
/// # Source
/// R. S. Woodruff, J. Am. Stat. Assoc. 47 (1952), 635–646.
pub fn inferred_limits<'a>(
    demand: &PooledDemand,
    weights: impl Into<SiteWeights<'a>>,
    units: &[Vec<usize>],
    targets_per_year: &[f64],
    (sizes, confidence): (&[usize], f64),
) -> Result<Vec<InferredLimits>, RiskError> {
    let of_size = |&size: &usize| {
        // its own scatter is added to that of the set
        let wider = (1.0 + units.len() as f64 / size as f64).sqrt();
        [Sample { units: size, wider: 1.0, size }, Sample { units: units.len(), wider, size }]
    };
    let samples: Vec<Sample> = sizes.iter().flat_map(of_size).collect();
    let limits_m = bands(demand, weights.into(), units, targets_per_year, (&samples, confidence))?;
    let of = |both: &[[f64; 2]]| InferredLimits { truth_m: both[0], prediction_m: both[1] };
    Ok(limits_m.chunks_exact(2).map(of).collect())
}

/// The limits of the truth alone, m, `[target]`: those of [`inferred_limits`] for as many units as the set has.
///
/// # Errors
/// As [`inferred_limits`].
pub fn truth_limits<'a>(
    demand: &PooledDemand,
    weights: impl Into<SiteWeights<'a>>,
    units: &[Vec<usize>],
    targets_per_year: &[f64],
    confidence: f64,
) -> Result<Vec<[f64; 2]>, RiskError> {
    let samples = [Sample { units: units.len(), wider: 1.0, size: units.len() }];
    bands(demand, weights.into(), units, targets_per_year, (&samples, confidence))
}

/// What a band is said by: so many units, within quantiles that are so much wider, with demands that spread as those of
/// a set of the size.
#[derive(Debug, Clone, Copy)]
struct Sample {
    units: usize,
    wider: f64,
    size: usize,
}

/// The limits of the ordinates of target rates, m, `[target, sample]`.
fn bands(
    demand: &PooledDemand,
    weights: SiteWeights<'_>,
    units: &[Vec<usize>],
    targets_per_year: &[f64],
    (samples, confidence): (&[Sample], f64),
) -> Result<Vec<[f64; 2]>, RiskError> {
    let rates = Rates::new(demand, weights, units)?;
    targets_per_year.iter().try_for_each(|target| check_target(*target))?;
    if units.len() < 2 {
        return Ok(vec![[f64::NAN; 2]; targets_per_year.len() * samples.len()]);
    }
    let most = samples.iter().map(|sample| sample.units).fold(1, usize::max);
    let quantiles = StudentQuantiles::new(confidence, most);
    let of_samples: Vec<SampleQuantiles> =
        samples.iter().map(|sample| SampleQuantiles::new(sample.units, sample.wider, &quantiles)).collect();
    let sizes: Vec<f64> = samples.iter().map(|sample| sample.size as f64 / units.len() as f64).collect();
    let mut inversion = Inversion::new(demand, vec![rates]);
    let of_target = |&target: &f64| {
        let place = |sample: usize, means: &[SkewedMean]| means[0].place(target, &of_samples[sample]);
        // by the one curve
        let ordinate_m = inversion.ordinates_m(target)[0];
        inversion.limits_m(ordinate_m, &sizes, place)
    };
    Ok(targets_per_year.iter().flat_map(of_target).collect())
}

/// Limits of the rate at which `threshold_m` is exceeded, 1/yr, by all records there could be: the interval that
/// [`inferred_limits`] inverts. NaN of a single unit; both 0 where no run exceeds it, which says nothing of others.
///
/// # Errors
/// As [`inferred_limits`].
pub fn inferred_rate<'a>(
    demand: &PooledDemand,
    weights: impl Into<SiteWeights<'a>>,
    units: &[Vec<usize>],
    (threshold_m, confidence): (f64, f64),
) -> Result<[f64; 2], RiskError> {
    let rates = Rates::new(demand, weights.into(), units)?;
    let quantiles = StudentQuantiles::new(confidence, units.len());
    Ok(Inversion::new(demand, vec![rates]).rate_limits(threshold_m, |means| means[0].interval(&quantiles)))
}

/// Limits of the rate of all records there could be, 1/yr, where each record at hand contributes so much and the mean
/// of them is the rate: what [`inferred_rate`] tells of demands that do not spread. NaN of a single unit; both the rate
/// where no record differs from another.
///
/// - `contributions_per_year`: of each record, 1/yr, `[record]`.
/// - `units`: the records of each unit, `[unit]`, by their positions; each record in one of them.
///
/// # Errors
/// Units of other records.
pub fn inferred_mean(
    contributions_per_year: &[f64],
    units: &[Vec<usize>],
    confidence: f64,
) -> Result<[f64; 2], RiskError> {
    let mean = mean_of(contributions_per_year, units)?;
    Ok(mean.interval(&StudentQuantiles::new(confidence, units.len())))
}

/// The rate of what happens in some runs, 1/yr, by the weights of a repair, and limits of that of all records there
/// could be: what [`inferred_mean`] tells of records that count alike. A run may count in part; demands do not spread.
/// NaN limits of a single unit.
///
/// - `happens`: in which share of a run it happens, 0 to 1, `[record, level]`.
/// - `weights`: taken as they are.
/// - `units`: the records of each unit, `[unit]`, by their positions; each record in one of them.
///
/// # Errors
/// Runs or units of other records.
pub fn inferred_weighted_rate(
    happens: &[f64],
    weights: &RunWeights,
    units: &[Vec<usize>],
    confidence: f64,
) -> Result<(f64, [f64; 2]), RiskError> {
    let (records, per_year) = (weights.record_count(), weights.stripes().per_year());
    check_count("records of the units", units.iter().map(Vec::len).sum(), records)?;
    check_count("runs", happens.len(), records * per_year.len())?;
    let mut rates = SharedRates::of_weights(units, weights);
    let run = |(run, share): (usize, &f64)| {
        let (record, level) = (run / per_year.len(), run % per_year.len());
        (record, level, share * per_year[level])
    };
    rates.start(happens.iter().enumerate().filter(|(_, share)| **share > 0.0).map(run));
    let mean = rates.mean();
    Ok((mean.mean, mean.interval(&StudentQuantiles::new(confidence, units.len()))))
}

/// The mean of what each record contributes, 1/yr, with the scatter of its units.
pub(crate) fn mean_of(contributions_per_year: &[f64], units: &[Vec<usize>]) -> Result<SkewedMean, RiskError> {
    check_count("records of the units", units.iter().map(Vec::len).sum(), contributions_per_year.len())?;
    let (count, records) = (units.len() as f64, contributions_per_year.len() as f64);
    let mean = contributions_per_year.iter().sum::<f64>() / records;
    // a unit deviates by the linearised ratio of the cluster bootstrap
    let deviation = |unit: &Vec<usize>| {
        unit.iter().map(|&record| contributions_per_year[record] - mean).sum::<f64>() * count / records
    };
    let deviations: Vec<f64> = units.iter().map(deviation).collect();
    let moment = |power: i32| deviations.iter().map(|own| own.powi(power)).sum::<f64>() / count;
    Ok(SkewedMean::new(mean, [2, 3, 4].map(moment), units.len()))
}
