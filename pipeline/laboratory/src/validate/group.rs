//! Every statistic of one group of peaks.

use serde::Serialize;
use uplift_validation::{
    AndersonDarling, BandRule, Bands, CramerVonMises, Evidence, KolmogorovSmirnov, MOST_DRAWN, MannWhitney, Pairs,
    Quantiles, Resampling, Sample, ValidationError, bands, detectable_factor, energy_distance, median_ratio_band,
    permutation_p, wasserstein_distance,
};

use super::join::Peers;
use super::options::{PRule, ValidateOptions};
use super::peaks::PeakValue;

/// Replicates of the power: its standard error is then below 1 %.
const POWER_REPLICATES: u32 = 2000;

/// Memory of the statistics of a group of at most so many peaks of either kind, bytes: the draws of its power, and some
/// twenty numbers a peak.
pub(super) fn memory_of_group(peaks: usize) -> usize {
    2 * 8 * (POWER_REPLICATES as usize * peaks.min(MOST_DRAWN) + 20 * peaks)
}

/// Peaks of which only a limit is known.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Censored {
    /// Measured ones.
    pub measured: usize,
    /// Computed ones.
    pub computed: usize,
    /// Distance of the distributions if each were at its limit: with that of the statistics, which have them above all
    /// values, the ends between which it lies for most.
    pub ks_distance_at_limits: f64,
}

/// A group of peaks, measured beside computed. None stands for what is not defined, above all a mean with collapses; an
/// infinite median is none too.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroupReport {
    /// The value of each column that is grouped by; none for all of them.
    pub of: Vec<Option<String>>,
    /// Measured peaks.
    pub measured: usize,
    /// Computed peaks.
    pub computed: usize,
    /// Replicates of bands, and of swaps: fewer than asked for of very many peaks.
    pub replicates: u32,
    /// Distance of the distributions, p by three rules.
    pub kolmogorov_smirnov: KolmogorovSmirnov,
    /// The p of the rule that was asked for.
    pub p: f64,
    /// What it says, by Table 6.1.
    pub evidence: Evidence,
    /// That p adjusted for all groups (Holm).
    pub p_holm: f64,
    /// p by swaps within pairs; none unless asked for.
    pub p_permutation: Option<f64>,
    /// Factor between the medians that the test would find with 80 % at the significance asked for, for samples of
    /// these sizes and this dispersion; none where it would find none up to 100, or the peaks do not vary.
    pub detectable_factor: Option<f64>,
    /// Dispersion that this is for: standard deviation of the logarithms of finite peaks about the mean of their kind.
    pub dispersion: Option<f64>,
    /// Weighted squared distance, standardised.
    pub anderson_darling: AndersonDarling,
    /// Squared distance.
    pub cramer_von_mises: CramerVonMises,
    /// Whether one kind tends to be larger.
    pub mann_whitney: MannWhitney,
    /// Mean distance of the distributions, in the unit of the peaks.
    pub wasserstein: Option<f64>,
    /// Energy distance, in the square root of that unit.
    pub energy: Option<f64>,
    /// Median of the measured peaks; none where it is infinite, or peaks above a limit leave it open.
    pub median_measured: Option<f64>,
    /// What it is at least, where they leave it open: the median with these peaks at their limits.
    pub median_measured_above: Option<f64>,
    /// Median of the computed peaks, as that of the measured ones.
    pub median_computed: Option<f64>,
    /// What it is at least, where peaks above a limit leave it open.
    pub median_computed_above: Option<f64>,
    /// Error of the median as Table 6.2 prints it, without its sign.
    pub e50: Option<f64>,
    /// The same with its sign, `u50,computed/u50,measured − 1`.
    pub median_error: Option<f64>,
    /// Its band over resampled motions.
    pub median_error_band: Option<Quantiles>,
    /// Motion by motion: bias, dispersion, correlation, collapses; none where there are no pairs.
    pub pairs: Option<Pairs>,
    /// Bands of bias and dispersion; none where there are no pairs.
    pub pair_bands: Option<Bands>,
    /// Collapses among the measured peaks.
    pub measured_collapses: usize,
    /// Collapses among the computed peaks.
    pub computed_collapses: usize,
    /// Peaks above a limit; none without such.
    pub censored: Option<Censored>,
    /// Both distributions.
    #[serde(skip)]
    pub samples: [Sample; 2],
    /// Measured and computed peak of each motion; empty where there are no pairs.
    #[serde(skip)]
    pub values: Vec<(f64, f64)>,
    /// Band of the measured distribution at each of its values: value, lower, upper.
    #[serde(skip)]
    pub band: Vec<(f64, f64, f64)>,
}

impl GroupReport {
    /// Of peers; Holm's p is that of one group.
    pub(super) fn from_peaks(
        of: Vec<Option<String>>,
        peers: &Peers,
        are_pairs: bool,
        options: &ValidateOptions,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Self, ValidationError> {
        let values = [&peers.measured, &peers.computed]
            .map(|peaks| peaks.iter().map(|peak| peak.ranked()).collect::<Vec<f64>>());
        let [measured, computed] = [Sample::new(values[0].clone())?, Sample::new(values[1].clone())?];
        let resampling = Resampling { replicates: options.replicates, seed: options.seed, stop };
        let test = KolmogorovSmirnov::from_samples(&measured, &computed);
        let p = match options.p_rule {
            PRule::Exact => test.p_exact,
            PRule::Kolmogorov => test.p_kolmogorov,
            PRule::Kstest2 => test.p_kstest2,
        };
        let dispersion = dispersion(&values);
        let power = Resampling { replicates: POWER_REPLICATES, seed: options.seed, stop };
        let detectable = dispersion
            .map(|wide| detectable_factor((measured.len(), computed.len()), wide, options.significance, power))
            .transpose()?
            .flatten();
        let pair_bands = are_pairs.then(|| bands(&values[0], &values[1], resampling)).transpose()?;
        let median_error_band = match pair_bands {
            Some(bands) => bands.median_ratio,
            None => median_ratio_band(&measured, &computed, resampling)?,
        };
        let pairs = are_pairs.then(|| pairs(peers, &values)).transpose()?;
        // of what is not defined there is no band
        let pair_bands = pair_bands.zip(pairs).map(|(bands, pairs)| Bands {
            log_bias: pairs.log_bias.and(bands.log_bias),
            log_dispersion: pairs.log_dispersion.and(bands.log_dispersion),
            ..bands
        });
        let swaps = options.permutation && are_pairs;
        let p_permutation = swaps.then(|| permutation_p(&values[0], &values[1], resampling)).transpose()?;
        let [of_measured, of_computed] = [Median::from_peaks(&peers.measured)?, Median::from_peaks(&peers.computed)?];
        let median_error = of_measured.known.zip(of_computed.known).and_then(|(m, c)| finite(c / m - 1.0));
        let collapses = |peaks: &[PeakValue]| peaks.iter().filter(|peak| matches!(peak, PeakValue::Overturned)).count();
        let at = distinct_finite(&measured);
        Ok(Self {
            of,
            replicates: resampling.replicates_for(measured.len().max(computed.len())),
            measured: measured.len(),
            computed: computed.len(),
            p,
            evidence: Evidence::from_p(p),
            p_holm: p,
            p_permutation,
            detectable_factor: detectable,
            dispersion,
            anderson_darling: AndersonDarling::from_samples(&measured, &computed),
            cramer_von_mises: CramerVonMises::from_samples(&measured, &computed),
            mann_whitney: MannWhitney::from_samples(&measured, &computed),
            wasserstein: wasserstein_distance(&measured, &computed),
            energy: energy_distance(&measured, &computed),
            median_measured: of_measured.known,
            median_measured_above: of_measured.above,
            median_computed: of_computed.known,
            median_computed_above: of_computed.above,
            e50: median_error.map(f64::abs),
            median_error,
            median_error_band: median_error.and(median_error_band),
            pairs,
            pair_bands,
            measured_collapses: collapses(&peers.measured),
            computed_collapses: collapses(&peers.computed),
            censored: censored(peers)?,
            band: band(&measured, &at, options.band),
            kolmogorov_smirnov: test,
            values: if are_pairs { values[0].iter().copied().zip(values[1].iter().copied()).collect() } else { vec![] },
            samples: [measured, computed],
        })
    }
}

/// A median, where it is known, or what it is at least.
struct Median {
    known: Option<f64>,
    above: Option<f64>,
}

impl Median {
    /// Of peaks of which some may be above a limit only: each is at least its limit, and the median lies between those
    /// with all of them there and with all of them above every value. Where these agree it is known.
    fn from_peaks(peaks: &[PeakValue]) -> Result<Self, ValidationError> {
        let median =
            |place: fn(PeakValue) -> f64| Ok(Sample::new(peaks.iter().map(|peak| place(*peak)).collect())?.median());
        let (least, most): (f64, f64) = (median(PeakValue::at_limit)?, median(PeakValue::ranked)?);
        Ok(if least.to_bits() == most.to_bits() {
            Self { known: finite(least), above: None }
        } else {
            Self { known: None, above: finite(least) }
        })
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Statistics of pairs. A peak above a limit is no collapse, and agrees with none whatever the other is.
fn pairs(peers: &Peers, values: &[Vec<f64>; 2]) -> Result<Pairs, ValidationError> {
    let ranked = Pairs::from_peaks(&values[0], &values[1])?;
    let limits =
        [&peers.measured, &peers.computed].map(|peaks| peaks.iter().map(|peak| peak.at_limit()).collect::<Vec<f64>>());
    let collapses = Pairs::from_peaks(&limits[0], &limits[1])?.collapses;
    let both_infinite = values[0].iter().zip(&values[1]).filter(|(m, c)| m.is_infinite() && c.is_infinite()).count();
    let taken_for_agreeing = (both_infinite - collapses.both) as f64 / values[0].len() as f64;
    Ok(Pairs {
        within_1_5: ranked.within_1_5 - taken_for_agreeing,
        within_2: ranked.within_2 - taken_for_agreeing,
        collapses,
        ..ranked
    })
}

fn censored(peers: &Peers) -> Result<Option<Censored>, ValidationError> {
    let count = |peaks: &[PeakValue]| peaks.iter().filter(|peak| matches!(peak, PeakValue::Above(_))).count();
    let (measured, computed) = (count(&peers.measured), count(&peers.computed));
    if measured + computed == 0 {
        return Ok(None);
    }
    let at_limits = |peaks: &[PeakValue]| Sample::new(peaks.iter().map(|peak| peak.at_limit()).collect());
    let distance = KolmogorovSmirnov::distance_of(&at_limits(&peers.measured)?, &at_limits(&peers.computed)?);
    Ok(Some(Censored { measured, computed, ks_distance_at_limits: distance }))
}

/// Standard deviation of the logarithms about the mean of their kind; none of fewer than two degrees of freedom, or
/// where nothing varies.
fn dispersion(values: &[Vec<f64>; 2]) -> Option<f64> {
    let logarithms = values.each_ref().map(|kind| {
        kind.iter().filter(|value| value.is_finite() && **value > 0.0).map(|value| value.ln()).collect::<Vec<f64>>()
    });
    let squares = |kind: &Vec<f64>| {
        let mean = kind.iter().sum::<f64>() / kind.len() as f64;
        kind.iter().map(|value| (value - mean).powi(2)).sum::<f64>()
    };
    let used = logarithms.iter().filter(|kind| !kind.is_empty());
    let freedom = used.clone().map(|kind| kind.len() - 1).sum::<usize>();
    let total: f64 = used.map(squares).sum();
    (freedom >= 2 && total > 0.0).then(|| (total / freedom as f64).sqrt())
}

fn distinct_finite(sample: &Sample) -> Vec<f64> {
    let mut values: Vec<f64> = sample.sorted().iter().copied().filter(|value| value.is_finite()).collect();
    values.dedup();
    values
}

fn band(measured: &Sample, at: &[f64], rule: BandRule) -> Vec<(f64, f64, f64)> {
    at.iter()
        .map(|&x| {
            let [low, high] = rule.at(measured, x);
            (x, low, high)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A peak above a limit is at least there: a median that it may move is a bound, and one that it cannot is known.
    #[test]
    fn a_median_among_limits_is_a_bound() {
        use PeakValue::{Above, Finite, Overturned};
        let of = |peaks: &[PeakValue]| {
            let found = Median::from_peaks(peaks).unwrap();
            (found.known, found.above)
        };
        // the limit lies above the middle
        assert_eq!(of(&[Finite(0.1), Finite(0.2), Above(0.3)]), (Some(0.2), None));
        // it is the middle, or below it
        assert_eq!(of(&[Finite(0.1), Above(0.3), Overturned]), (None, Some(0.3)));
        assert_eq!(of(&[Finite(0.6), Above(0.5), Finite(0.8)]), (None, Some(0.6)));
        assert_eq!(of(&[Above(0.05), Finite(0.2), Finite(0.4)]), (None, Some(0.2)));
        // of an even number, the mean of two
        assert_eq!(of(&[Finite(0.1), Finite(0.3), Above(0.5), Overturned]), (None, Some(0.4)));
        assert_eq!(of(&[Finite(0.1), Overturned, Overturned]), (None, None));
        assert_eq!(of(&[Above(0.1), Overturned, Overturned]), (None, None));
    }

    #[test]
    fn a_limit_is_no_collapse() {
        use PeakValue::{Above, Finite, Overturned};
        let peers = Peers {
            measured: vec![Finite(0.1), Above(0.3), Overturned, Above(0.3)],
            computed: vec![Finite(0.12), Overturned, Overturned, Finite(0.31)],
        };
        let report = GroupReport::from_peaks(Vec::new(), &peers, true, &ValidateOptions::default(), &|| false).unwrap();
        let pairs = report.pairs.unwrap();
        assert_eq!((pairs.collapses.both, pairs.collapses.computed_only, pairs.collapses.none), (1, 1, 2));
        assert_eq!((report.measured_collapses, report.computed_collapses), (1, 2));
        // 0.12 beside 0.1, and the collapse of both
        assert!((pairs.within_1_5 - 0.5).abs() < 1e-15, "{}", pairs.within_1_5);
        assert_eq!((pairs.finite, report.wasserstein, report.median_measured), (1, None, None));
        // 0.1, 0.3, 0.3 and a collapse: the middle two are limits
        assert_eq!(
            (report.median_measured_above, report.median_error, report.median_error_band),
            (Some(0.3), None, None)
        );
        // of one finite pair there is no dispersion, however often it is drawn
        let bands = report.pair_bands.unwrap();
        assert!(bands.log_bias.is_some() && pairs.log_dispersion.is_none() && bands.log_dispersion.is_none());
        let censored = report.censored.unwrap();
        assert_eq!((censored.measured, censored.computed), (2, 0));
        // at the limits: F(0.3) = 3/4 beside G(0.3) = 1/4; above all values: F(0.31) = 1/4 beside 2/4
        assert_eq!((censored.ks_distance_at_limits, report.kolmogorov_smirnov.distance), (0.5, 0.25));
    }
}
