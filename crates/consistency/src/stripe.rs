//! What the shares of the records make of the set at one stripe.

use uplift_fragility::weighted_quantile;

use crate::{RecordSet, SetRecord};

/// The set at one stripe, under the shares of its records there.
#[derive(Debug, Clone, PartialEq)]
pub struct StripeStatistics {
    /// Mean of ln q, with q = y/x in the units of the curves.
    pub mean_ln_ratio: f64,
    /// Standard deviation of ln q.
    pub sd_ln_ratio: f64,
    /// Effective records 1/Σ p², the shares of both components of a pair added first.
    pub effective_records: f64,
    /// Effective earthquakes, 1/Σ over the events of their squared shares; none unless the event of every record of the
    /// stripe is known.
    pub effective_events: Option<f64>,
    /// The largest share of a pair.
    pub largest_record_share: f64,
    /// The first record of that pair, counted from 0.
    pub largest_record: usize,
    /// The largest share of a known event, and its number as the caller gave it.
    pub largest_event: Option<(usize, f64)>,
}

impl StripeStatistics {
    /// Of the stripe at `level` with the shares p of the records, `[record]`.
    pub(crate) fn from_shares(set: &RecordSet, level: usize, shares: &[f64]) -> Self {
        let ln_ratios = || set.ratios_at(level).iter().map(|ratio| ratio.ln()).zip(shares);
        let mean_ln_ratio: f64 = ln_ratios().map(|(ln_ratio, share)| share * ln_ratio).sum();
        let variance: f64 = ln_ratios().map(|(ln_ratio, share)| share * (ln_ratio - mean_ln_ratio).powi(2)).sum();
        let (pairs, events) = (set.by_pair(shares), set.by_event(shares));
        let (pair, largest_record_share) = largest(&pairs).unwrap_or((0, 0.0));
        Self {
            mean_ln_ratio,
            sd_ln_ratio: variance.sqrt(),
            effective_records: effective(&pairs),
            effective_events: set.knows_events_at(level).then(|| effective(&events)),
            largest_record_share,
            largest_record: set.record_of_pair(pair),
            largest_event: largest(&events).map(|(event, share)| (set.event_number(event), share)),
        }
    }
}

/// 1/Σ p².
fn effective(shares: &[f64]) -> f64 {
    1.0 / shares.iter().map(|share| share * share).sum::<f64>()
}

/// The first of the largest shares.
fn largest(shares: &[f64]) -> Option<(usize, f64)> {
    let all = shares.iter().copied().enumerate();
    all.reduce(|largest, next| if next.1 > largest.1 { next } else { largest })
}

/// By what the records are multiplied to reach a level, under their shares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScaleFactors {
    /// 5, 50 and 95 % of the level over the x of each pair.
    pub percentiles: [f64; 3],
    /// Share of the factors outside the limits that were asked for.
    pub outside_limits: f64,
    /// Share of the factors outside 1/10 to 10.
    pub outside_tenfold: f64,
}

impl ScaleFactors {
    /// To `level`, with the shares p of the records at the nearest `stripe`; `limits` are the lower and the upper one.
    pub(crate) fn from_shares(
        set: &RecordSet,
        (level, stripe): (f64, usize),
        shares: &[f64],
        limits: [f64; 2],
    ) -> Self {
        let factor = |record| set.scale_factor(level, stripe, record);
        let mut factors: Vec<(f64, f64)> =
            shares.iter().enumerate().map(|(record, &share)| (factor(record), share)).collect();
        factors.sort_by(|a, b| a.0.total_cmp(&b.0));
        let outside = |[lower, upper]: [f64; 2]| {
            let shares = factors.iter().filter(|(factor, _)| !(lower..=upper).contains(factor)).map(|(_, share)| share);
            // the sum of none is -0
            0.0 + shares.sum::<f64>()
        };
        Self {
            percentiles: [0.05, 0.5, 0.95].map(|probability| weighted_quantile(&factors, probability)),
            outside_limits: outside(limits),
            outside_tenfold: outside([0.1, 10.0]),
        }
    }
}

/// Medians of what is known of the records, under their shares; none where it is known of none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Medians {
    /// Moment magnitude M.
    pub magnitude: Option<f64>,
    /// Distance R, km.
    pub distance_km: Option<f64>,
    /// Mean shear-wave velocity of the upper 30 m, m/s.
    pub vs30_m_s: Option<f64>,
}

impl Medians {
    /// Of the shares p of the records, `[record]`.
    pub(crate) fn from_shares(set: &RecordSet, shares: &[f64]) -> Self {
        let median = |value: fn(&SetRecord) -> Option<f64>| {
            let known = set.records().iter().zip(shares);
            let mut known: Vec<(f64, f64)> =
                known.filter_map(|(record, &share)| value(record).map(|value| (value, share))).collect();
            known.sort_by(|a, b| a.0.total_cmp(&b.0));
            Some(weighted_quantile(&known, 0.5)).filter(|median| median.is_finite())
        };
        Self {
            magnitude: median(|record| record.seismology.magnitude),
            distance_km: median(|record| record.seismology.distance_km),
            vs30_m_s: median(|record| record.seismology.vs30_m_s),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Seismology;

    fn set() -> RecordSet {
        let record = |x: f64, ratio: f64, pair, event, magnitude| SetRecord {
            scaled_to: x,
            other: x * ratio,
            pair,
            event,
            seismology: Seismology { magnitude, ..Seismology::default() },
        };
        let e = std::f64::consts::E;
        RecordSet::new(vec![
            record(2.0, 1.0, 0, Some(5), Some(6.0)),
            record(2.0, 1.0, 0, Some(5), Some(6.0)),
            record(4.0, e, 1, Some(5), None),
            record(40.0, e, 2, Some(8), Some(7.0)),
        ])
        .unwrap()
    }

    #[test]
    fn statistics_by_hand() {
        let statistics = StripeStatistics::from_shares(&set(), 0, &[0.25, 0.25, 0.25, 0.25]);
        assert!((statistics.mean_ln_ratio - 0.5).abs() < 1e-15 && (statistics.sd_ln_ratio - 0.5).abs() < 1e-15);
        // pairs ½, ¼, ¼; events ¾, ¼
        assert!((statistics.effective_records - 1.0 / 0.375).abs() < 1e-14);
        assert!((statistics.effective_events.unwrap() - 1.0 / 0.625).abs() < 1e-14);
        assert_eq!((statistics.largest_record, statistics.largest_record_share), (0, 0.5));
        assert_eq!(statistics.largest_event, Some((5, 0.75)));
        let alone = StripeStatistics::from_shares(&set(), 0, &[0.0, 0.0, 0.0, 1.0]);
        assert_eq!((alone.effective_records, alone.largest_record, alone.largest_event), (1.0, 3, Some((8, 1.0))));
    }

    #[test]
    fn scale_factors_and_medians_by_hand() {
        let shares = [0.25, 0.25, 0.25, 0.25];
        // 4/40, 4/4, 4/2 twice: positions 0.15, 1.5 and 2.85
        let factors = ScaleFactors::from_shares(&set(), (4.0, 0), &shares, [0.5, 1.5]);
        for (found, expected) in factors.percentiles.into_iter().zip([0.235, 1.5, 2.0]) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
        assert_eq!((factors.outside_limits, factors.outside_tenfold), (0.75, 0.0));
        assert!(factors.outside_tenfold.is_sign_positive(), "printed as -0");
        let medians = Medians::from_shares(&set(), &shares);
        assert_eq!((medians.magnitude, medians.distance_km), (Some(6.0), None));
        assert_eq!(Medians::from_shares(&set(), &[0.0, 0.0, 0.5, 0.5]).magnitude, Some(7.0));
    }
}
