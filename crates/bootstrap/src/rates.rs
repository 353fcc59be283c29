//! The rate at which a displacement is exceeded by the runs of a set, with the scatter of its units.

use uplift_risk::{PooledDemand, RiskError, SiteWeights, check_count};

use crate::SkewedMean;
use crate::shared_rates::SharedRates;
use crate::unit_rates::UnitRates;
use crate::walk::Run;

/// The rate of the runs that are exceeded, by one hazard curve.
#[derive(Debug, Clone)]
pub(crate) struct Rates {
    of_units: OfUnits,
    /// What each level weighs, 1/yr.
    per_year: Vec<f64>,
}

#[derive(Debug, Clone)]
enum OfUnits {
    /// Of records that are all run at every level.
    Alike(UnitRates),
    /// Of levels with records of their own, of units that are not of equally many records, and of weights.
    Shared(SharedRates),
}

impl OfUnits {
    /// Of records that count alike, or as the demand says.
    fn from_demand(demand: &PooledDemand, units: &[Vec<usize>]) -> Self {
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
}

impl Rates {
    /// Of units of records that count alike, as the `demand` says, or as a repair does.
    ///
    /// # Errors
    /// Demand and weights with different numbers of levels or records, or units of other records.
    pub(crate) fn new(
        demand: &PooledDemand,
        weights: SiteWeights<'_>,
        units: &[Vec<usize>],
    ) -> Result<Self, RiskError> {
        let records = demand.record_count();
        check_count("records of the units", units.iter().map(Vec::len).sum(), records)?;
        check_count("stripe weights", weights.stripes().level_count(), demand.level_count())?;
        let of_units = match weights {
            SiteWeights::Alike(_) => OfUnits::from_demand(demand, units),
            SiteWeights::Repaired(weights) => {
                check_count("records with shares", weights.record_count(), records)?;
                OfUnits::Shared(SharedRates::of_weights(units, weights))
            }
        };
        Ok(Self { of_units, per_year: weights.stripes().per_year() })
    }

    /// What a run adds to the rate, 1/yr.
    pub(crate) fn run_per_year(&self, record: usize, level: usize) -> f64 {
        let share = match &self.of_units {
            OfUnits::Alike(rates) => rates.share(),
            OfUnits::Shared(rates) => rates.share(record, level),
        };
        share * self.per_year[level]
    }

    /// Just these runs are exceeded.
    pub(crate) fn start(&mut self, runs: impl Iterator<Item = Run>) {
        let Self { of_units, per_year } = self;
        match of_units {
            OfUnits::Alike(rates) => rates.start(runs.map(|run| (run.record, run.share * per_year[run.level]))),
            OfUnits::Shared(rates) => {
                rates.start(runs.map(|run| (run.record, run.level, run.share * per_year[run.level])));
            }
        }
    }

    /// This run is exceeded too.
    pub(crate) fn add(&mut self, run: Run) {
        self.change(run, run.share);
    }

    /// This run is exceeded no more.
    pub(crate) fn take_away(&mut self, run: Run) {
        self.change(run, -run.share);
    }

    fn change(&mut self, Run { record, level, .. }: Run, share: f64) {
        let per_year = share * self.per_year[level];
        match &mut self.of_units {
            OfUnits::Alike(rates) => rates.add(record, per_year),
            OfUnits::Shared(rates) => rates.add(record, level, per_year),
        }
    }

    /// The rate of all records, 1/yr, with the scatter of the units.
    pub(crate) fn mean(&self) -> SkewedMean {
        match &self.of_units {
            OfUnits::Alike(rates) => rates.mean(),
            OfUnits::Shared(rates) => rates.mean(),
        }
    }

    /// To how many units that count alike they amount, all levels together.
    pub(crate) fn equivalent_units(&self) -> f64 {
        match &self.of_units {
            OfUnits::Alike(rates) => rates.units() as f64,
            OfUnits::Shared(rates) => rates.equivalent_units(),
        }
    }
}
