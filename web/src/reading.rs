//! Spectra and ordinates read off the stripes: the same calls, in the same order, as `uplift spectrum` makes.

use serde_json::{Value, json};
use uplift_bootstrap::truth_limits;
use uplift_hazard::HazardCurve;
use uplift_motion::IntensityMeasure;
use uplift_risk::{
    BEYOND_LIMIT, COMPARED_FROM_M, DECISIVE_SHARE, MEASURES_APART, MEASURES_APART_DECISIVE, Ordinate, PooledDemand,
    RiskCurve, StrengthPlace, StripeWeights, TAIL_SHARE_LIMIT,
};

use crate::calculator::{Answer, At, Risk, refused};
use crate::stripes::{Measure, Stripes};

pub(crate) use uplift_bootstrap::QUOTED_CONFIDENCE as CONFIDENCE;

/// Stripes and hazard of one measure at a site.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) of: &'a Measure,
    pub(crate) curve: &'a HazardCurve,
    pub(crate) weights: &'a StripeWeights,
    alarms: &'a Value,
}

/// An ordinate with its band, m; NaN of a single record.
#[derive(Clone, Copy)]
struct Banded {
    ordinate: Ordinate,
    band_m: [f64; 2],
}

impl Stripes {
    /// Where `at` is.
    pub(crate) fn place(&self, at: &At) -> Answer<Place<'_>> {
        let site = self.site(&at.site)?;
        let measure: IntensityMeasure = at.measure.parse().map_err(refused)?;
        let found = site.curves.iter().find(|curve| curve.measure == measure);
        let found = found.ok_or_else(|| format!("{} has no hazard curve of {}", site.name, measure.label()))?;
        let of = self.measure(measure)?;
        Ok(Place { of, curve: &found.curve, weights: &found.weights, alarms: &found.alarms })
    }

    /// The spectrum, its band, and the hazard curve with the level of the same rarity.
    pub(crate) fn spectrum(&self, at: &At) -> Answer<Value> {
        let (place, risk) = (self.place(at)?, self.risk(at)?);
        let row = |demand: &PooledDemand| place.ordinate(demand, risk.per_year);
        let all = place.of.demands.iter().map(row).collect::<Answer<Vec<_>>>()?;
        let of = |value: fn(&Banded) -> f64| all.iter().map(value).collect::<Vec<f64>>();
        Ok(json!({
            "risk": rarity(risk),
            "strengths": self.study.strengths.to_vec(),
            "u_m": of(|own| own.ordinate.displacement_m),
            "lower_m": of(|own| own.band_m[0]),
            "upper_m": of(|own| own.band_m[1]),
            "flag": all.iter().map(|own| own.ordinate.flag.word()).collect::<Vec<_>>(),
            "lower_tail_share": of(|own| own.ordinate.lower_tail_share),
            "upper_tail_share": of(|own| own.ordinate.upper_tail_share),
            "band_of": place.of.band_of,
            "confidence": CONFIDENCE,
            "hazard": {
                "levels": place.curve.im(),
                "maf_per_year": place.curve.maf(),
                "level": place.curve.im_at_rate(risk.per_year).ok(),
            },
            "alarms": place.alarms,
        }))
    }

    /// The ordinate at a strength, linear between those of the stripes, with its band, and the share of the records
    /// that exceed it at each level; the stripes are those of the nearest strength.
    pub(crate) fn point(&self, at: &At, strength: f64) -> Answer<Value> {
        let (place, risk) = (self.place(at)?, self.risk(at)?);
        let (read, between, tail_shares) = self.ordinate_at(place, risk, strength)?;
        let apart = |at: usize| (self.study.strengths[at] - strength).abs();
        let nearest = if apart(between.right) < apart(between.left) { between.right } else { between.left };
        let curve = RiskCurve::new(&place.of.demands[nearest], place.weights).map_err(refused)?;
        let fragility = if read[0].is_finite() { curve.exceedance_probabilities(read[0]).ok() } else { None };
        let mut alarms = place.alarms_of(risk, tail_shares);
        alarms.extend(self.apart(at, risk, between)?);
        Ok(json!({
            "risk": rarity(risk),
            "strength": strength,
            "u_m": read[0],
            "band_m": [read[1], read[2]],
            "levels": place.of.levels,
            "fragility": fragility,
            "fragility_of_strength": self.study.strengths[nearest],
            "alarms": alarms,
        }))
    }

    /// Other measures whose spectrum is so far from this one, at the strengths that an ordinate is read between, that
    /// the program raises it.
    fn apart(&self, at: &At, risk: Risk, between: StrengthPlace) -> Answer<Vec<Value>> {
        let here = self.place(at)?;
        let mut alarms = Vec::new();
        for other in self.site(&at.site)?.curves.iter().filter(|own| own.measure != here.of.measure) {
            let mut at = at.clone();
            other.measure.key().clone_into(&mut at.measure);
            let there = self.place(&at)?;
            let mut widest = (1.0_f64, 1.0, 0.0);
            for strength in [between.left, between.right] {
                let u_m = |place: Place<'_>| place.ordinate(&place.of.demands[strength], risk.per_year);
                let [here_m, there_m] = [u_m(here)?, u_m(there)?].map(|own| own.ordinate.displacement_m);
                let times = (there_m / here_m).max(here_m / there_m);
                if here_m.max(there_m) > COMPARED_FROM_M && times.is_finite() && times > widest.0 {
                    widest = (times, there_m / here_m, self.study.strengths[strength]);
                }
            }
            let (times, ratio, strength) = widest;
            if times > MEASURES_APART {
                let severity = if times > MEASURES_APART_DECISIVE { "caution" } else { "note" };
                let labels = [other.measure.label(), here.of.measure.label()];
                let [larger, smaller] = if ratio > 1.0 { labels } else { [labels[1], labels[0]] };
                let what = format!("the {larger} spectrum is {times:.1} times {smaller}'s at strength {strength}");
                alarms.push(json!({ "severity": severity, "subject": "Here", "also": [], "what": what }));
            }
        }
        Ok(alarms)
    }

    /// The ordinate at a strength and the limits of its band, m, between which strengths they are read, and the larger
    /// shares of their risk that come from below and above the levels.
    pub(crate) fn ordinate_at(
        &self,
        place: Place<'_>,
        risk: Risk,
        strength: f64,
    ) -> Answer<([f64; 3], StrengthPlace, [f64; 2])> {
        let strengths = &self.study.strengths;
        let between = StrengthPlace::among(strengths, strength).ok_or_else(|| {
            let [first, last] = [strengths.first(), strengths.last()].map(|value| value.copied().unwrap_or(f64::NAN));
            format!("strength {strength:.4}: the spectrum has strengths from {first} to {last}")
        })?;
        let [left, right] =
            [between.left, between.right].map(|at| place.ordinate(&place.of.demands[at], risk.per_year));
        let (left, right) = (left?, right?);
        let read = |value: fn(&Banded) -> f64| between.between(value(&left), value(&right));
        let ordinates = [read(|own| own.ordinate.displacement_m), read(|own| own.band_m[0]), read(|own| own.band_m[1])];
        let most = |share: fn(&Ordinate) -> f64| share(&left.ordinate).max(share(&right.ordinate));
        Ok((ordinates, between, [most(|own| own.lower_tail_share), most(|own| own.upper_tail_share)]))
    }
}

impl Place<'_> {
    /// What is to be raised about an ordinate, whatever the study asked for: how much of it rests on motions that were
    /// not analysed, by the limits of `uplift warnings`.
    fn alarms_of(&self, risk: Risk, [lower, upper]: [f64; 2]) -> Vec<Value> {
        let levels = &self.of.levels;
        let ends = [levels[0], levels[levels.len() - 1]];
        let unit = self.of.measure.unit();
        // what is known of the hazard ends with the curve, though levels go on
        let end = self.curve.last();
        let (known_to, per_year) = if end.im < ends[1] {
            (format!("the curve's end, {}", end.im), end.maf)
        } else {
            (format!("the last level, {}", ends[1]), self.weights.upper_tail_per_year())
        };
        let beyond = per_year / risk.per_year;
        let cases = [
            (
                upper,
                TAIL_SHARE_LIMIT,
                format!("{} of the risk lies above {} {unit}: it may be too small", per_cent(upper), ends[1]),
            ),
            (
                lower,
                TAIL_SHARE_LIMIT,
                format!("{} of the risk lies below {} {unit}: it is too large", per_cent(lower), ends[0]),
            ),
            (
                beyond,
                BEYOND_LIMIT,
                format!(
                    "{known_to} {unit}, is exceeded at {} the target rate: the displacement may be too small",
                    if beyond > 1.0 { format!("{beyond:.1} times") } else { format!("{} of", per_cent(beyond)) }
                ),
            ),
        ];
        let raised = cases.into_iter().filter(|(share, limit, _)| share > limit);
        let alarm = |(share, _, what)| {
            let severity = if share > DECISIVE_SHARE { "caution" } else { "note" };
            json!({ "severity": severity, "subject": "This displacement", "also": [], "what": what })
        };
        raised.map(alarm).collect()
    }

    fn ordinate(&self, demand: &PooledDemand, per_year: f64) -> Answer<Banded> {
        let ordinate = RiskCurve::new(demand, self.weights).and_then(|curve| curve.exact_ordinate(per_year));
        let band_m = truth_limits(demand, self.weights, &self.of.units, &[per_year], CONFIDENCE).map_err(refused)?[0];
        Ok(Banded { ordinate: ordinate.map_err(refused)?, band_m })
    }
}

/// `7.8 %`.
pub(crate) fn per_cent(share: f64) -> String {
    format!("{} %", (1e3 * share).round() / 10.0)
}

/// How rare, for the page.
pub(crate) fn rarity(risk: Risk) -> Value {
    json!({ "poe": risk.poe, "years": risk.years, "return_period_years": 1.0 / risk.per_year })
}
