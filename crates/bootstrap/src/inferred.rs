//! What a set of records says of the spectrum of all records there could be, and of that of another set.

use uplift_risk::{PooledDemand, RiskError, RunWeights, StripeWeights};

use crate::shared_rates::SharedRates;
use crate::skewed_mean::{AboveInterval, SkewedMean, StudentQuantiles, of_side};
use crate::unit_rates::UnitRates;

/// Where the deviate of a target is less, that of a larger target is below −1, whatever rounding leaves of either.
pub(crate) const SURELY_BELOW: f64 = -1.0 - 1e-9;

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
/// (Woodruff, 1952). The band runs from the largest such displacement down to where λ(c) first differs too much: λ(c)
/// rises as c falls, and what single motions at frequent levels add to its scatter further down brings nothing back. No
/// resampling takes part, and no transformation of the displacement changes the band.
///
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
pub fn inferred_limits(
    demand: &PooledDemand,
    weights: &StripeWeights,
    units: &[Vec<usize>],
    targets_per_year: &[f64],
    (sizes, confidence): (&[usize], f64),
) -> Result<Vec<InferredLimits>, RiskError> {
    check(demand, weights, units)?;
    limits(demand, weights, (Rates::from_demand(demand, units), units), targets_per_year, (sizes, confidence))
}

/// The same of records that count as `weights` say, repaired: the weights are taken as they are.
///
/// # Errors
/// As [`inferred_limits`].
pub fn repaired_limits(
    demand: &PooledDemand,
    weights: &RunWeights,
    units: &[Vec<usize>],
    targets_per_year: &[f64],
    (sizes, confidence): (&[usize], f64),
) -> Result<Vec<InferredLimits>, RiskError> {
    check(demand, weights.stripes(), units)?;
    let rates = Rates::weighted(weights, units);
    limits(demand, weights.stripes(), (rates, units), targets_per_year, (sizes, confidence))
}

fn limits(
    demand: &PooledDemand,
    weights: &StripeWeights,
    rates: (Rates, &[Vec<usize>]),
    targets_per_year: &[f64],
    asked: (&[usize], f64),
) -> Result<Vec<InferredLimits>, RiskError> {
    let of = |[truth, prediction]: [Search; 2]| InferredLimits {
        truth_m: truth.limits_m(),
        prediction_m: prediction.limits_m(),
    };
    Ok(searches(demand, weights, rates, targets_per_year, asked)?.into_iter().map(of).collect())
}

/// The bands of each target and size, `[target, size]`: that of the truth, and that of another set.
fn searches(
    demand: &PooledDemand,
    weights: &StripeWeights,
    (mut rates, units): (Rates, &[Vec<usize>]),
    targets_per_year: &[f64],
    (sizes, confidence): (&[usize], f64),
) -> Result<Vec<[Search; 2]>, RiskError> {
    targets_per_year.iter().try_for_each(|target| check_target(*target))?;
    if units.len() < 2 {
        return Ok(vec![[Search::NONE; 2]; targets_per_year.len() * sizes.len()]);
    }
    let most = sizes.iter().copied().max().unwrap_or(1).max(units.len());
    let quantiles = StudentQuantiles::new(confidence, most);
    let mut searches = vec![[Search::default(); 2]; targets_per_year.len() * sizes.len()];
    let per_year = weights.per_year();
    let all = units.len();
    let root = |units: usize| (units as f64).sqrt();
    let root_of_all = root(all);
    // its own scatter is added to that of the set
    let of_sizes: Vec<(usize, f64, f64)> =
        sizes.iter().map(|&size| (size, root(size), (1.0 + all as f64 / size as f64).sqrt())).collect();
    let rising = rising(targets_per_year);
    let mut look = |rates: &Rates, from_m: f64, to_m: f64| {
        let mean = rates.mean();
        let of_units = |units: usize, root| (mean.deviates(root), mean.quantiles(&quantiles, units).map(f64::recip));
        let (of_set, per_quantile_of_set) = of_units(all, root_of_all);
        let mut is_open = false;
        for (place, &(size, root, wider)) in of_sizes.iter().enumerate() {
            let of_another = (of_set, per_quantile_of_set.map(|per| per / wider));
            for (kind, (deviates, per_quantile)) in [of_units(size, root), of_another].into_iter().enumerate() {
                for &(target, row) in &rising {
                    let search = &mut searches[row * sizes.len() + place][kind];
                    if search.was_beyond {
                        continue;
                    }
                    let deviate = deviates.of(target);
                    let deviate = deviate * of_side(per_quantile, deviate);
                    search.see(deviate, from_m, to_m);
                    is_open |= !search.was_beyond;
                    if deviate < SURELY_BELOW {
                        break;
                    }
                }
            }
        }
        is_open
    };
    fall(demand, |step| match step {
        Step::Between(from_m, to_m) => look(&rates, from_m, to_m),
        Step::Run { record, level } => {
            rates.add(record, level, per_year[level]);
            true
        }
    });
    Ok(searches)
}

/// Targets with their positions, the least first: where the band of one has not been reached, those of larger ones have
/// not.
pub(crate) fn rising(targets_per_year: &[f64]) -> Vec<(f64, usize)> {
    let mut rising: Vec<(f64, usize)> = targets_per_year.iter().copied().zip(0..).collect();
    rising.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    rising
}

/// Limits of the rate at which `threshold_m` is exceeded, 1/yr, by all records there could be: the interval that
/// [`inferred_limits`] inverts. NaN of a single unit; both 0 where no run exceeds it, which says nothing of others.
///
/// # Errors
/// As [`inferred_limits`].
pub fn inferred_rate(
    demand: &PooledDemand,
    weights: &StripeWeights,
    units: &[Vec<usize>],
    (threshold_m, confidence): (f64, f64),
) -> Result<[f64; 2], RiskError> {
    check(demand, weights, units)?;
    Ok(interval(demand, weights, (Rates::from_demand(demand, units), units), (threshold_m, confidence)))
}

/// The same of records that count as `weights` say, repaired: the interval that [`repaired_limits`] inverts.
///
/// # Errors
/// As [`inferred_limits`].
pub fn repaired_rate(
    demand: &PooledDemand,
    weights: &RunWeights,
    units: &[Vec<usize>],
    (threshold_m, confidence): (f64, f64),
) -> Result<[f64; 2], RiskError> {
    check(demand, weights.stripes(), units)?;
    Ok(interval(demand, weights.stripes(), (Rates::weighted(weights, units), units), (threshold_m, confidence)))
}

fn interval(
    demand: &PooledDemand,
    weights: &StripeWeights,
    (mut rates, units): (Rates, &[Vec<usize>]),
    (threshold_m, confidence): (f64, f64),
) -> [f64; 2] {
    let per_year = weights.per_year();
    for (_, record, level) in demand.falling_runs().take_while(|run| run.0 > threshold_m) {
        rates.add(record, level, per_year[level]);
    }
    rates.mean().interval(&StudentQuantiles::new(confidence, units.len()))
}

/// Limits of the rate of all records there could be, 1/yr, where each record at hand contributes so much and the mean
/// of them is the rate: what [`inferred_rate`] tells of single runs. NaN of a single unit; both the rate where no
/// record differs from another.
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

/// The mean of what each record contributes, 1/yr, with the scatter of its units.
pub(crate) fn mean_of(contributions_per_year: &[f64], units: &[Vec<usize>]) -> Result<SkewedMean, RiskError> {
    fits("records of the units", units.iter().map(Vec::len).sum(), contributions_per_year.len())?;
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

/// A step of a displacement that falls through all runs.
pub(crate) enum Step {
    /// No run lies between these displacements, m, the lower one first.
    Between(f64, f64),
    /// A run is exceeded from here on.
    Run { record: usize, level: usize },
}

/// Lets a displacement fall from above all runs to zero, as long as `take` wants to go on.
pub(crate) fn fall(demand: &PooledDemand, mut take: impl FnMut(Step) -> bool) {
    let mut above_m = f64::INFINITY;
    let mut runs = demand.falling_runs().peekable();
    while let Some(&(edp_m, ..)) = runs.peek() {
        if !take(Step::Between(edp_m, above_m)) {
            return;
        }
        while let Some((_, record, level)) = runs.next_if(|run| run.0 == edp_m) {
            take(Step::Run { record, level });
        }
        above_m = edp_m;
    }
    take(Step::Between(0.0, above_m));
}

/// The rate of the runs gone through, with the scatter of its units.
pub(crate) enum Rates {
    /// Of records that are all run at every level.
    Alike(UnitRates),
    /// Of levels with records of their own, of units that are not of equally many records, and of weights.
    Shared(SharedRates),
}

impl Rates {
    pub(crate) fn from_demand(demand: &PooledDemand, units: &[Vec<usize>]) -> Self {
        let is_alike = units.windows(2).all(|two| two[0].len() == two[1].len());
        match demand.shares() {
            None if is_alike => Self::Alike(UnitRates::new(units)),
            Some(shares) if is_alike => Self::Shared(SharedRates::new(units, shares)),
            Some(shares) => Self::Shared(SharedRates::new(units, shares).with_leverage()),
            None => {
                let runs = demand.record_count() * demand.level_count();
                let shares = vec![1.0 / demand.record_count() as f64; runs];
                Self::Shared(SharedRates::new(units, &shares).with_leverage())
            }
        }
    }

    pub(crate) fn weighted(weights: &RunWeights, units: &[Vec<usize>]) -> Self {
        Self::Shared(SharedRates::new(units, weights.shares()).with_effective_units())
    }

    pub(crate) fn add(&mut self, record: usize, level: usize, per_year: f64) {
        match self {
            Self::Alike(rates) => rates.add(record, per_year),
            Self::Shared(rates) => rates.add(record, level, per_year),
        }
    }

    pub(crate) fn mean(&self) -> SkewedMean {
        match self {
            Self::Alike(rates) => rates.mean(),
            Self::Shared(rates) => rates.mean(),
        }
    }

    /// The mean alone.
    pub(crate) fn per_year(&self) -> f64 {
        match self {
            Self::Alike(rates) => rates.per_year(),
            Self::Shared(rates) => rates.per_year,
        }
    }

    /// Whether `target` is surely above the interval of the `mean`: told where that takes less time than the
    /// [`mean`](Self::mean) itself.
    pub(crate) fn is_below(&self, target: f64, mean: f64, above: &AboveInterval) -> bool {
        match self {
            Self::Alike(rates) => rates.is_below(target, mean, above),
            Self::Shared(_) => false,
        }
    }
}

/// Whether it is a target.
pub(crate) fn check_target(rate: f64) -> Result<(), RiskError> {
    if rate.is_finite() && rate > 0.0 { Ok(()) } else { Err(RiskError::Target { rate }) }
}

/// Whether these belong together.
pub(crate) fn check(demand: &PooledDemand, weights: &StripeWeights, units: &[Vec<usize>]) -> Result<(), RiskError> {
    fits("records of the units", units.iter().map(Vec::len).sum(), demand.record_count())?;
    fits("stripe weights", weights.level_count(), demand.level_count())
}

fn fits(what: &'static str, found: usize, expected: usize) -> Result<(), RiskError> {
    if found == expected { Ok(()) } else { Err(RiskError::Count { what, found, expected }) }
}

/// The displacements of a band, while they are gone through from above.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Search {
    /// Least and largest displacement that belong to it, m.
    pub(crate) found_m: Option<[f64; 2]>,
    /// Where the deviate leaves the band, or leaps over the whole of it.
    leap_m: f64,
    /// Whether it has left: nothing more comes to it.
    pub(crate) was_beyond: bool,
}

impl Search {
    /// Of a single unit, which has no band.
    const NONE: Self = Self { found_m: Some([f64::NAN; 2]), leap_m: f64::NAN, was_beyond: true };

    /// All displacements from `from_m` to `to_m` have this `deviate`, over its quantile.
    pub(crate) fn see(&mut self, deviate: f64, from_m: f64, to_m: f64) {
        if self.was_beyond {
            return;
        }
        if deviate.abs() <= 1.0 {
            let upper_m = self.found_m.map_or(to_m, |found| found[1]);
            self.found_m = Some([from_m, upper_m]);
        } else if deviate > 1.0 {
            (self.leap_m, self.was_beyond) = (to_m, true);
        }
    }

    pub(crate) fn limits_m(&self) -> [f64; 2] {
        self.found_m.unwrap_or([self.leap_m; 2])
    }
}
