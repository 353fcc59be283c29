//! How often bands hold what they are bands of: sets drawn from the records of a result, which stand for the world.

use rayon::prelude::*;
use uplift::result::{StoredMeasure, StoredStripes};
use uplift_bootstrap::{Interval, Replicates, ResamplingPlan, inferred_limits, without_each};
use uplift_fragility::Stripes;
use uplift_risk::PooledDemand;

/// Records in a set.
pub const SIZES: [u32; 3] = [20, 40, 105];
/// The bands that are looked at, in order.
pub const BANDS: [&str; 4] = ["percentile", "bca", "truth", "prediction"];
const CONFIDENCE: f64 = 0.9;

/// How many bands lie wholly below or above what they are to hold, and how many there are.
#[derive(Debug, Default, Clone, Copy)]
pub struct Counts {
    below: u32,
    above: u32,
    bands: u32,
}

impl Counts {
    fn see(&mut self, [lower_m, upper_m]: [f64; 2], value_m: f64) {
        self.bands += 1;
        self.above += u32::from(value_m < lower_m);
        self.below += u32::from(value_m > upper_m);
    }

    /// Shares of the bands that hold it, lie below it and lie above it, per cent.
    pub fn per_cent(self) -> [f64; 3] {
        [self.bands - self.below - self.above, self.below, self.above]
            .map(|count| 100.0 * f64::from(count) / f64::from(self.bands))
    }
}

/// The bands of one drawn set at one ordinate, m, in the order of [`BANDS`].
struct OfSet {
    bands_m: [[f64; 2]; BANDS.len()],
    ordinate_m: f64,
}

/// Counts `[size][band]` of all ordinates of a result above zero, at all of its sites and by all of its measures.
///
/// - `drawn`: sets of each size, drawn with replacement, so that the population is endless.
/// - `replicates`: resamples of each set, for the percentile and BCa.
///
/// # Errors
/// Numbers that do not fit together, in a file that was changed.
pub fn coverage(
    stored: &StoredStripes,
    drawn: usize,
    replicates: usize,
) -> Result<Vec<[Counts; BANDS.len()]>, Box<dyn std::error::Error + Send + Sync>> {
    let all = stored.records.len();
    let sets = ResamplingPlan::draw(all, &SIZES, drawn, 1)?;
    let mut counts = vec![[Counts::default(); BANDS.len()]; SIZES.len()];
    for measure in &stored.measures {
        for strength in 0..stored.strengths.len() {
            for (position, &size) in SIZES.iter().enumerate() {
                // [set][site, poe]
                let found: Vec<Vec<OfSet>> = sets.samples()[position * drawn..(position + 1) * drawn]
                    .par_iter()
                    .enumerate()
                    .map(|(set, sample)| {
                        let resamples = ResamplingPlan::draw(size as usize, &[size], replicates, 2 + set as u64)?;
                        of_set((stored, measure, strength), sample.multiplicities(), &resamples)
                    })
                    .collect::<Result<_, Box<dyn std::error::Error + Send + Sync>>>()?;
                for place in 0..stored.sites.len() * stored.poes.len() {
                    let (site, poe) = (place / stored.poes.len(), place % stored.poes.len());
                    let true_m = measure.exact_m[[site, poe, strength]];
                    if true_m == 0.0 {
                        continue;
                    }
                    for (set, of_set) in found.iter().enumerate() {
                        let another_m = found[(set + 1) % drawn][place].ordinate_m;
                        for (band, counts) in counts[position].iter_mut().enumerate() {
                            let value_m = if BANDS[band] == "prediction" { another_m } else { true_m };
                            counts.see(of_set[place].bands_m[band], value_m);
                        }
                    }
                }
            }
        }
    }
    Ok(counts)
}

/// The bands of the records that `multiplicities` draw, `[site, poe]`.
fn of_set(
    (stored, measure, strength): (&StoredStripes, &StoredMeasure, usize),
    multiplicities: &[u32],
    resamples: &ResamplingPlan,
) -> Result<Vec<OfSet>, Box<dyn std::error::Error + Send + Sync>> {
    let rows = multiplicities.iter().enumerate().flat_map(|(record, &times)| {
        let row = measure.edp_m.block([record, strength]);
        (0..times).flat_map(move |_| row.iter().copied())
    });
    let demand = PooledDemand::new(&Stripes::new(&measure.levels, &rows.collect::<Vec<_>>())?)?;
    let targets = &stored.targets_per_year;
    let sites: Vec<_> = measure.weights.iter().collect();
    let replicates = Replicates::from_plan(&demand, &sites, targets, resamples)?;
    let (units, left_out) = (resamples.units(), resamples.left_out()?);
    let mut found = Vec::new();
    for (site, weights) in sites.into_iter().enumerate() {
        let inferred = inferred_limits(&demand, weights, &units, targets, (&[units.len()], CONFIDENCE))?;
        let ordinates = uplift_risk::RiskCurve::new(&demand, weights)?.exact_ordinates(targets)?;
        let without_each = without_each(&demand, weights, targets, &left_out)?;
        for (poe, (inferred, ordinate)) in inferred.iter().zip(&ordinates).enumerate() {
            let ordinate_m = ordinate.displacement_m;
            let of_sample = (without_each[poe].as_slice(), u32::try_from(units.len())?);
            let [percentile, bca] = Interval::ALL.map(|interval| {
                let band = interval.band(replicates.ordinates_m(site, poe, 0), CONFIDENCE, ordinate_m, of_sample);
                [band.lower_m, band.upper_m]
            });
            found.push(OfSet { bands_m: [percentile, bca, inferred.truth_m, inferred.prediction_m], ordinate_m });
        }
    }
    Ok(found)
}
