//! How well so many records know a spectrum: whether they are enough, in a line.
//!
//! Bands of the truth at a few strengths, small enough for every run; `uplift bootstrap` gives those of all.

use rayon::prelude::*;
use serde::Serialize;
use uplift_bootstrap::{QUOTED_CONFIDENCE, truth_limits, units};
use uplift_fragility::quantile;
use uplift_job::text::{nearest, per_cent, risk_in_words};
use uplift_motion::IntensityMeasure;
use uplift_risk::{PooledDemand, RiskCurve, RiskError, StripeWeights};
use uplift_study::UniformRiskStudy;

use crate::consistency::Question;
use crate::error::UniformRiskError;

/// The strengths that are shown where none are asked for, or the nearest that a result has.
pub(crate) const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];
/// Bands shrink as one over the root of the records (Section 4.5.1): half as wide takes so many times as many.
const TIMES_FOR_HALF: usize = 4;

/// How well the records know the spectra by one measure, of the rarest probability of the study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Precision {
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Probability of exceedance.
    pub poe: f64,
    /// Years that it refers to.
    pub years: f64,
    /// Records in the set.
    pub records: usize,
    /// Their earthquakes, a pair whose earthquake is not known being one of its own; none where no two pairs are known
    /// to share one.
    pub events: Option<usize>,
    /// To how many earthquakes of equally many records these amount: 1/Σ (share of the records)².
    pub effective_events: Option<f64>,
    /// Half of the 90 % band of the truth over the ordinate, as the records tell it, one by one: the middle one, the
    /// least and the most, of the sites and the strengths 0.1, 0.2 and 0.4 at which the band has an upper limit.
    pub half_width: [f64; 3],
    /// The middle one of the same bands as their earthquakes tell it; infinite where half of them or more have no upper
    /// limit.
    pub half_width_by_event: Option<f64>,
    /// Records of the same kind that would halve it.
    pub records_for_half: usize,
}

/// The precision of the spectra by `measure`; none without sites, for a single record, and where no ordinate is finite
/// and above 0 with an upper limit.
///
/// - `demand`: all demands of a strength, by its position.
/// - `sites`: what the stripes weigh at each site.
/// - `question`: knows the earthquakes of the records.
///
/// # Errors
/// Numbers that do not fit together, which the checks of study and inputs rule out.
pub fn precision(
    study: &UniformRiskStudy,
    measure: IntensityMeasure,
    demand: impl Fn(usize) -> Result<PooledDemand, UniformRiskError>,
    sites: &[&StripeWeights],
    question: &Question,
) -> Result<Option<Precision>, UniformRiskError> {
    let event_of = question.event_of();
    // two components of a pair are not independent
    let [pairs, earthquakes] = [units(&question.pair_of()), units(&event_of)];
    let records = event_of.len();
    // the azimuths or structures of a pair tell no more of other records than the pair does
    let counted = if study.keeps_pairs_together() { pairs.len() } else { records };
    let Some(&poe) = study.risk.poe.iter().min_by(|a, b| a.total_cmp(b)) else { return Ok(None) };
    let target = uplift_hazard::rate_from_probability(poe, study.risk.years)?;
    let shown = nearest(&study.strengths, &SHOWN_STRENGTHS);
    let demands: Vec<PooledDemand> = shown.into_iter().map(demand).collect::<Result<_, _>>()?;
    // by strength and site
    let widths = |units: &[Vec<usize>]| -> Result<Vec<Option<f64>>, UniformRiskError> {
        let of_site = |demand: &PooledDemand, weights: &StripeWeights| -> Result<Option<f64>, RiskError> {
            let ordinate = RiskCurve::new(demand, weights)?.exact_ordinate(target)?;
            let limits_m = truth_limits(demand, weights, units, &[target], QUOTED_CONFIDENCE)?;
            Ok(limits_m.first().and_then(|limits_m| half_width(ordinate.displacement_m, *limits_m)))
        };
        let mut all = Vec::new();
        for demand in &demands {
            let of_sites: Result<Vec<Option<f64>>, RiskError> =
                sites.par_iter().map(|weights| of_site(demand, weights)).collect();
            all.extend(of_sites?);
        }
        Ok(all)
    };
    let by_record = widths(&pairs)?;
    let is_shared = question.shares_earthquakes();
    let by_event = if is_shared { widths(&earthquakes)? } else { vec![None; by_record.len()] };
    let [by_record, by_event] = where_records_tell(&by_record, &by_event);
    let [Some(&least), Some(&most)] = [by_record.first(), by_record.last()] else { return Ok(None) };
    let squares: f64 = earthquakes.iter().map(|of_event| (of_event.len() as f64 / records as f64).powi(2)).sum();
    Ok(Some(Precision {
        im: measure.label(),
        poe,
        years: study.risk.years,
        records: counted,
        events: is_shared.then_some(earthquakes.len()),
        effective_events: is_shared.then_some(1.0 / squares),
        half_width: [quantile(&by_record, 0.5), least, most],
        half_width_by_event: (!by_event.is_empty()).then(|| quantile(&by_event, 0.5)),
        records_for_half: TIMES_FOR_HALF * counted,
    }))
}

/// The half-widths, ascending, where that by record is known and finite: elsewhere the two have nothing to compare.
fn where_records_tell(by_record: &[Option<f64>], by_event: &[Option<f64>]) -> [Vec<f64>; 2] {
    let is_told = |own: &Option<f64>| own.is_some_and(f64::is_finite);
    [by_record, by_event].map(|of| {
        let mut told: Vec<f64> =
            of.iter().zip(by_record).filter(|(_, own)| is_told(own)).filter_map(|(width, _)| *width).collect();
        told.sort_by(f64::total_cmp);
        told
    })
}

/// Half of the band over the ordinate, infinite of a band without an upper limit; none where the ordinate is 0 or
/// censored, and of a single unit.
fn half_width(ordinate_m: f64, [lower_m, upper_m]: [f64; 2]) -> Option<f64> {
    let width = 0.5 * (upper_m - lower_m) / ordinate_m;
    (ordinate_m > 0.0 && ordinate_m.is_finite() && !width.is_nan()).then_some(width)
}

impl Precision {
    /// How wide the band is, in a sentence.
    pub fn words(&self) -> String {
        let percent = |width: f64| format!("{:.0}", 100.0 * width);
        let [middle, least, most] = self.half_width.map(percent);
        let events = self.events.zip(self.effective_events).map_or_else(String::new, |(events, effective)| {
            format!(" of {events} earthquakes (effective {effective:.0})")
        });
        let by_event = match self.half_width_by_event {
            Some(width) if width.is_finite() => format!("; ±{} % by earthquake", percent(width)),
            Some(_) => "; no upper limit by earthquake".to_owned(),
            None => String::new(),
        };
        format!(
            "{} records{events}: half-width of the {} band, {} by {}, ±{middle} % ({least} to {most} by site and \
             strength){by_event}; {} records would halve it",
            self.records,
            per_cent(QUOTED_CONFIDENCE),
            risk_in_words(self.poe, self.years),
            self.im,
            self.records_for_half
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_widths_are_compared_where_records_tell_one() {
        let (open, none) = (Some(f64::INFINITY), None);
        let told = where_records_tell(&[open, Some(0.4), none, Some(0.2)], &[open, open, Some(0.1), Some(0.3)]);
        assert_eq!(told, [vec![0.2, 0.4], vec![0.3, f64::INFINITY]]);
        assert_eq!(where_records_tell(&[Some(0.4), open], &[none, none]), [vec![0.4], vec![]]);
    }

    #[test]
    fn half_widths_by_hand() {
        assert_eq!(half_width(0.2, [0.15, 0.3]), Some(0.5 * 0.15 / 0.2));
        assert_eq!(half_width(0.2, [0.15, f64::INFINITY]), Some(f64::INFINITY));
        assert_eq!(half_width(f64::INFINITY, [0.15, f64::INFINITY]), None);
        assert_eq!(half_width(0.0, [0.0, 0.1]), None);
        assert_eq!(half_width(0.2, [f64::NAN; 2]), None);
    }

    #[test]
    fn the_sentence_has_every_known_number() {
        let mut precision = Precision {
            im: "PGV",
            poe: 0.02,
            years: 50.0,
            records: 105,
            events: Some(22),
            effective_events: Some(9.9),
            half_width: [0.161, 0.12, 0.253],
            half_width_by_event: Some(0.24),
            records_for_half: 420,
        };
        assert_eq!(
            precision.words(),
            "105 records of 22 earthquakes (effective 10): half-width of the 90 % band, 2 % in 50 years by PGV, ±16 % \
             (12 to 25 by site and strength); ±24 % by earthquake; 420 records would halve it"
        );
        precision.half_width_by_event = Some(f64::INFINITY);
        assert!(precision.words().contains("strength); no upper limit by earthquake; 420"), "{}", precision.words());
        (precision.events, precision.effective_events, precision.half_width_by_event) = (None, None, None);
        assert!(precision.words().starts_with("105 records: half-width of the 90 % band"));
    }
}
