//! Confidence bands of the frequency by a lognormal fragility: what each record has in it.

use uplift_bootstrap::{contributions, inferred_mean, inferred_mean_over_alternatives};
use uplift_fragility::{
    FragilityError, LognormalFragility, Stripes as Stripe, fit_lognormal, fits_without_each, stripe_counts,
};
use uplift_risk::StripeWeights;

use crate::certainty::{Bands, CONFIDENCE, Scatter};
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::risk::OVERTURNING_M;

/// The bands of the frequencies by the lognormal fragility of the demands over `[record, level]`, m, at sites of these
/// hazards; none where a fragility has no fit, and of a single record.
pub(super) fn lognormal_bands(
    (levels, demands_m): (&[f64], &[f64]),
    hazards: &[Hazard<'_>],
    scatter: &Scatter,
) -> Result<Vec<Option<Bands>>, DesignError> {
    let Ok(found) = Fragilities::from_demands(levels, demands_m) else { return Ok(vec![None; hazards.len()]) };
    hazards.iter().map(|hazard| found.bands(hazard, scatter)).collect()
}

/// The lognormal fragilities of overturning of all records, and of all but each.
#[derive(Debug)]
struct Fragilities {
    levels: Vec<f64>,
    all: LognormalFragility,
    /// `[record]`
    without: Vec<LognormalFragility>,
}

impl Fragilities {
    /// Of the demands over `[record, level]`, m.
    ///
    /// # Errors
    /// Why one of them has no fit.
    fn from_demands(levels: &[f64], demands_m: &[f64]) -> Result<Self, FragilityError> {
        let stripes = Stripe::new(levels, demands_m)?;
        let all = fit_lognormal(&stripe_counts(&stripes, OVERTURNING_M)?)?.fragility;
        let each: Vec<Vec<usize>> = (0..stripes.record_count()).map(|record| vec![record]).collect();
        let without = fits_without_each(&stripes, OVERTURNING_M, &each)?;
        Ok(Self { levels: levels.to_vec(), all, without: without.iter().map(|fit| fit.fragility).collect() })
    }

    /// The bands of the frequency by the hazard of a site; none of a single record.
    ///
    /// The frequency is no mean over the records, but nearly: the one without a record says what the record has in it
    /// (jackknife). The bands are those of the mean of these.
    fn bands(&self, hazard: &Hazard<'_>, scatter: &Scatter) -> Result<Option<Bands>, DesignError> {
        let own = self.contributions(hazard.mean)?;
        let is_told = |band: &[f64; 2]| !band[1].is_nan();
        let of = |units: &Vec<Vec<usize>>| inferred_mean(&own, units, CONFIDENCE);
        let by_record = of(&scatter.pairs)?;
        let by_earthquake = scatter.earthquakes.as_ref().map(of).transpose()?.filter(is_told);
        let by_curve = |(weight, stripes): &(f64, StripeWeights)| Ok((*weight, self.contributions(stripes)?));
        let curves = hazard.branches.iter().map(by_curve).collect::<Result<Vec<_>, DesignError>>()?;
        // NaN of no curves too
        let with_hazard = inferred_mean_over_alternatives(&curves, scatter.coarsest(), CONFIDENCE)?;
        let with_hazard = Some(with_hazard).filter(is_told);
        Ok(is_told(&by_record).then_some(Bands { by_record, by_earthquake, with_hazard }))
    }

    /// What each record has in the frequency, 1/yr, `[record]`: their mean is the frequency.
    fn contributions(&self, weights: &StripeWeights) -> Result<Vec<f64>, DesignError> {
        let per_year = |of: &LognormalFragility| -> Result<f64, DesignError> {
            let probabilities: Vec<f64> = self.levels.iter().map(|&level| of.probability(level)).collect();
            Ok(weights.disaggregate(&probabilities)?.total_per_year())
        };
        let all = per_year(&self.all)?;
        let without = self.without.iter().map(per_year).collect::<Result<Vec<_>, _>>()?;
        Ok(contributions(all, &without))
    }
}

#[cfg(test)]
mod tests {
    use uplift_bootstrap::units;

    use super::*;

    /// Records that overturn from a level on, of ten levels whose rates fall.
    fn demands(firsts: &[usize]) -> Vec<f64> {
        let of =
            |first: &usize| (0..10).map(|level| if level < *first { 0.1 } else { f64::INFINITY }).collect::<Vec<_>>();
        firsts.iter().flat_map(of).collect()
    }

    const FIRSTS: [usize; 12] = [2, 3, 3, 4, 4, 4, 5, 5, 6, 6, 7, 8];

    #[test]
    fn the_band_is_that_of_what_each_record_has() {
        let levels: Vec<f64> = (1..=10).map(|level| 0.1 * f64::from(level)).collect();
        let rates: Vec<f64> = levels.iter().map(|level| 1e-4 * level.powf(-2.2)).collect();
        let weights = StripeWeights::new(&rates, None).unwrap();
        let own = Fragilities::from_demands(&levels, &demands(&FIRSTS)).unwrap();
        let contributions = own.contributions(&weights).unwrap();
        let probabilities: Vec<f64> = levels.iter().map(|&level| own.all.probability(level)).collect();
        let per_year = weights.disaggregate(&probabilities).unwrap().total_per_year();
        let mean = contributions.iter().sum::<f64>() / 12.0;
        assert!((mean / per_year - 1.0).abs() < 1e-12, "{mean} {per_year}");
        // what overturns at the weakest level has most in the frequency
        assert!(contributions.iter().all(|of| *of <= contributions[0]), "{contributions:?}");
        let scatter = Scatter { pairs: units(&(0..12).collect::<Vec<_>>()), earthquakes: None };
        let curves = vec![(0.5, weights.clone()), (0.5, weights.clone())];
        let bands = own.bands(&Hazard { mean: &weights, branches: curves }, &scatter).unwrap().unwrap();
        let [lower, upper] = bands.by_record;
        assert!(0.0 < lower && lower < per_year && per_year < upper && upper < 4.0 * per_year, "{bands:?}");
        let with_hazard = bands.with_hazard.unwrap();
        assert!([0, 1].iter().all(|&end| (with_hazard[end] / bands.by_record[end] - 1.0).abs() < 1e-3), "{bands:?}");
        // pairs of twins know as much as one of each
        let twins: Vec<usize> = FIRSTS.iter().flat_map(|&first| [first; 2]).collect();
        let pairs = Scatter { pairs: (0..12).map(|pair| vec![2 * pair, 2 * pair + 1]).collect(), earthquakes: None };
        let of_twins = Fragilities::from_demands(&levels, &demands(&twins)).unwrap();
        let twins = of_twins.bands(&Hazard { mean: &weights, branches: Vec::new() }, &pairs).unwrap().unwrap();
        assert!([0, 1].iter().all(|&end| (twins.by_record[end] / bands.by_record[end] - 1.0).abs() < 0.1), "{twins:?}");
    }

    #[test]
    fn a_fit_that_hangs_on_a_record_has_no_band() {
        let levels: Vec<f64> = (1..=10).map(f64::from).collect();
        // without the third nothing overlaps
        assert!(Fragilities::from_demands(&levels, &demands(&[4, 4, 5])).is_err());
    }
}
