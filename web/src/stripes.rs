//! The stripes of a result, as `uplift export --web` writes them, and the spectra read off them: the same calls, in the
//! same order, as `uplift spectrum` makes.

use serde::Deserialize;
use serde_json::{Value, json};
use uplift_bootstrap::truth_limits;
use uplift_fragility::Stripes as Stripe;
use uplift_hazard::{ComponentDefinition, Extrapolation, HazardCurve};
use uplift_motion::IntensityMeasure;
use uplift_risk::{
    BEYOND_LIMIT, COMPARED_FROM_M, DECISIVE_SHARE, FEW_RECORDS, MEASURES_APART, MEASURES_APART_DECISIVE, Ordinate,
    OrdinateFlag, PooledDemand, RiskCurve, StrengthPlace, StripeWeights, TAIL_SHARE_LIMIT,
};
use uplift_study::{AnyStudy, Study, UniformRiskStudy, definition_of};

use crate::calculator::{Answer, At, Risk, refused};

/// What `uplift export --web` calls its files.
const FORMAT: &str = "uplift-web-1";
/// How often a band is to hold the displacement of all records like those at hand, as `uplift spectrum` has it.
pub(crate) const CONFIDENCE: f64 = 0.9;

/// What a refused curve is told, and what the page offers for it.
const EXTRAPOLATION_KEY: &str = "choose log-log extrapolation (risk.extrapolate = \"loglog\")";
const EXTRAPOLATION_BOX: &str = "tick “Extrapolate curves that end too early”";

#[derive(Deserialize)]
struct Exported {
    format: String,
    provenance: String,
    record_set: String,
    synthetic: bool,
    records: Vec<String>,
    study: String,
    sites: Vec<ExportedSite>,
    measures: Vec<ExportedMeasure>,
}

#[derive(Deserialize)]
struct ExportedSite {
    name: String,
    curves: Vec<ExportedCurve>,
}

#[derive(Deserialize)]
struct ExportedCurve {
    im: String,
    unit: String,
    source: String,
    levels: Vec<f64>,
    maf_per_year: Vec<f64>,
    alarms: Value,
}

#[derive(Deserialize)]
struct ExportedMeasure {
    im: String,
    levels: Vec<f64>,
    band_of: String,
    units: Vec<Vec<usize>>,
    /// `[record, strength, level]`; none where infinite.
    peaks_m: Vec<Option<f64>>,
}

/// Stripes of one measure.
#[expect(clippy::struct_field_names, reason = "the measure itself")]
pub(crate) struct Measure {
    pub(crate) measure: IntensityMeasure,
    /// In the unit of the measure, ascending.
    pub(crate) levels: Vec<f64>,
    /// What a band takes for independent: `records` or `earthquakes`.
    pub(crate) band_of: String,
    /// The records of each.
    pub(crate) units: Vec<Vec<usize>>,
    /// One a strength.
    pub(crate) demands: Vec<PooledDemand>,
}

impl Measure {
    /// From peaks `[record, strength, level]`, m.
    pub(crate) fn new(
        (measure, levels): (IntensityMeasure, Vec<f64>),
        (band_of, units): (String, Vec<Vec<usize>>),
        (records, strengths, peaks_m): (usize, usize, &[f64]),
    ) -> Answer<Self> {
        let stride = strengths.checked_mul(levels.len()).ok_or("too many levels")?;
        if stride == 0 || records == 0 || stride.checked_mul(records) != Some(peaks_m.len()) {
            return Err(format!(
                "{}: {} peaks: not one for each of {records} records, {strengths} strengths and {} levels",
                measure.label(),
                peaks_m.len(),
                levels.len()
            ));
        }
        let mut seen = vec![false; records];
        let fresh = |record: &usize| seen.get_mut(*record).is_some_and(|seen| !std::mem::replace(seen, true));
        if !units.iter().flatten().all(fresh) || !seen.iter().all(|seen| *seen) {
            return Err(format!("{}: the units of the band do not hold each record once", measure.label()));
        }
        let demand = |strength: usize| {
            let stripes = Stripe::strided(&levels, &peaks_m[strength * levels.len()..], records, stride);
            PooledDemand::new(&stripes.map_err(refused)?).map_err(refused)
        };
        let demands = (0..strengths).map(demand).collect::<Answer<_>>()?;
        Ok(Self { measure, levels, band_of, units, demands })
    }
}

/// A site with its hazard.
pub(crate) struct Site {
    name: String,
    pub(crate) curves: Vec<SiteCurve>,
    /// What to do with levels outside the curves.
    pub(crate) extrapolate: Extrapolation,
}

/// The hazard curve of one measure at a site.
pub(crate) struct SiteCurve {
    pub(crate) measure: IntensityMeasure,
    pub(crate) curve: HazardCurve,
    weights: StripeWeights,
    /// What `uplift` warns of, as it writes it.
    alarms: Value,
}

/// The stripes, and the sites that meet them.
pub(crate) struct Stripes {
    pub(crate) provenance: String,
    pub(crate) record_set: String,
    pub(crate) synthetic: bool,
    pub(crate) records: Vec<String>,
    pub(crate) study: UniformRiskStudy,
    pub(crate) study_text: String,
    pub(crate) measures: Vec<Measure>,
    pub(crate) sites: Vec<Site>,
    /// The rows of a manifest of records that were dropped.
    pub(crate) manifest: Option<String>,
}

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
    /// Reads what `uplift export --web` wrote.
    pub(crate) fn read(bytes: &[u8]) -> Answer<Self> {
        let not_ours = |error: serde_json::Error| format!("not a file of `uplift export --web`: {error}");
        let read: Exported = serde_json::from_slice(bytes).map_err(not_ours)?;
        if read.format != FORMAT {
            return Err(format!("the file is of the format {:?}, and this page reads {FORMAT:?}", read.format));
        }
        let study = match Study::stored(&read.study).map_err(refused)? {
            AnyStudy::UniformRisk(study) => *study,
            _ => return Err("the study in the file is not of uniform risk".to_owned()),
        };
        let measure = |own: ExportedMeasure| {
            let peaks_m: Vec<f64> = own.peaks_m.iter().map(|peak_m| peak_m.unwrap_or(f64::INFINITY)).collect();
            let measure = own.im.parse().map_err(refused)?;
            let peaks = (read.records.len(), study.strengths.len(), &peaks_m[..]);
            Measure::new((measure, own.levels), (own.band_of, own.units), peaks)
        };
        let measures = read.measures.into_iter().map(measure).collect::<Answer<Vec<_>>>()?;
        let mut stripes = Self {
            provenance: read.provenance,
            record_set: read.record_set,
            synthetic: read.synthetic,
            records: read.records,
            study,
            study_text: read.study,
            measures,
            sites: Vec::new(),
            manifest: None,
        };
        let extrapolate = stripes.study.risk.extrapolate;
        for site in read.sites {
            let mut curves = Vec::new();
            for own in site.curves {
                let measure: IntensityMeasure = own.im.parse().map_err(refused)?;
                let curve = HazardCurve::new(measure.label(), own.unit, own.source, own.levels, own.maf_per_year);
                curves.push(stripes.site_curve(measure, curve.map_err(refused)?, (own.alarms, extrapolate))?);
            }
            stripes.sites.push(Site { name: site.name, curves, extrapolate });
        }
        Ok(stripes)
    }

    fn site_curve(
        &self,
        measure: IntensityMeasure,
        curve: HazardCurve,
        (alarms, extrapolate): (Value, Extrapolation),
    ) -> Answer<SiteCurve> {
        let of = self.measure(measure)?;
        let weights = StripeWeights::from_hazard(&curve, &of.levels, extrapolate).map_err(refused)?;
        Ok(SiteCurve { measure, curve, weights, alarms })
    }

    fn measure(&self, measure: IntensityMeasure) -> Answer<&Measure> {
        let found = self.measures.iter().find(|own| own.measure == measure);
        found.ok_or_else(|| format!("there are no stripes by {}", measure.label()))
    }

    /// Adds a site, or replaces the one of its name, with curves in their own units.
    pub(crate) fn add_site(&mut self, name: &str, curves: Vec<HazardCurve>, extrapolate: bool) -> Answer<Value> {
        let extrapolate = if extrapolate { Extrapolation::LogLog } else { Extrapolation::Refuse };
        let mut own = Vec::new();
        let mut notes = Vec::new();
        for curve in curves {
            let measure: IntensityMeasure = curve.measure().parse().map_err(refused)?;
            let curve = curve.in_field_units(self.study.gravity_m_s2).map_err(refused)?;
            let (curve, note) = self.of_the_records_definition(measure, curve)?;
            notes.extend(note);
            if own.iter().any(|own: &SiteCurve| own.measure == measure) {
                return Err(format!("two curves of {} for one site: choose one", measure.label()));
            }
            let alarms = if self.synthetic { self.synthetic_alarms() } else { json!([]) };
            let (first, last) = (curve.first().im, curve.last().im);
            let levels = &self.measure(measure)?.levels;
            if extrapolate == Extrapolation::LogLog && levels.iter().any(|level| !(first..=last).contains(level)) {
                let unit = measure.unit();
                notes.push(format!("{}: extrapolated below {first} and above {last} {unit}", measure.label()));
            }
            let curve = self.site_curve(measure, curve, (alarms, extrapolate));
            own.push(curve.map_err(|refusal| refusal.replace(EXTRAPOLATION_KEY, EXTRAPOLATION_BOX))?);
        }
        if own.is_empty() {
            return Err("no curve was chosen".to_owned());
        }
        self.sites.retain(|site| site.name != name);
        self.sites.push(Site { name: name.to_owned(), curves: own, extrapolate });
        Ok(json!({ "notes": notes, "about": self.about() }))
    }

    /// A curve by the definition that the records are measured by, as the program takes it, and what is assumed for it.
    fn of_the_records_definition(
        &self,
        measure: IntensityMeasure,
        curve: HazardCurve,
    ) -> Answer<(HazardCurve, Option<String>)> {
        let (label, hazard) = (measure.label(), &self.study.hazard);
        let wanted = definition_of(self.study.records.intensity);
        let Some(own) = curve.component().or(hazard.component) else {
            if wanted == ComponentDefinition::GeometricMean {
                let note = format!("{label}: taken as the {} of two components", wanted.key());
                return Ok((curve, Some(note)));
            }
            return Err(format!("{label}: the records are measured by the {}: name it in the file", wanted.key()));
        };
        match (own == wanted, hazard.factor(own, wanted, measure)) {
            (true, _) => Ok((curve, None)),
            (false, Some(factor)) => Ok((curve.converted(factor, wanted).map_err(refused)?, None)),
            (false, None) => Err(format!(
                "{label}: the curve gives {}, the records {}: drop a file with levels of that definition, named in \
                 the file",
                own.key(),
                wanted.key()
            )),
        }
    }

    /// The warning of synthetic records as the export has it.
    fn synthetic_alarms(&self) -> Value {
        let all = self.sites.iter().flat_map(|site| &site.curves).filter_map(|curve| curve.alarms.as_array()).flatten();
        let found = all.into_iter().find(|alarm| alarm["kind"] == "synthetic-records");
        found.into_iter().cloned().collect()
    }

    /// Puts the stripes of records that were dropped in the place of these; what was warned of no longer holds.
    pub(crate) fn replace(&mut self, records: Vec<String>, manifest: String, measures: Vec<Measure>) {
        let plural = if records.len() == 1 { "" } else { "s" };
        let record_set = format!("{} record file{plural}, dropped on this page", records.len());
        self.provenance.clone_from(&record_set);
        self.manifest = Some(manifest);
        // as the program has it
        let few = json!([{ "severity": "caution", "kind": "few-records", "subject": "Few records", "also": [],
            "what": format!("{} ({FEW_RECORDS} advised)", records.len()), "what_to_do": "Drop more" }]);
        let alarms = if records.len() < FEW_RECORDS { few } else { json!([]) };
        (self.record_set, self.records, self.measures, self.synthetic) = (record_set, records, measures, false);
        for curve in self.sites.iter_mut().flat_map(|site| &mut site.curves) {
            curve.alarms.clone_from(&alarms);
        }
    }

    /// What there is, for the page.
    pub(crate) fn about(&self) -> Value {
        let measure = |own: &Measure| {
            json!({
                "key": own.measure.key(),
                "label": own.measure.label(),
                "unit": own.measure.unit(),
                "levels": own.levels,
            })
        };
        let site = |own: &Site| {
            let measures: Vec<_> = own.curves.iter().map(|curve| curve.measure.key()).collect();
            json!({ "name": own.name, "measures": measures })
        };
        json!({
            "provenance": self.provenance,
            "record_set": self.record_set,
            "synthetic": self.synthetic,
            "records": self.records.len(),
            "strengths": self.study.strengths.to_vec(),
            "years": self.study.risk.years,
            "poes": self.study.risk.poe,
            "uplift_displacement_m": self.study.oscillator.uplift_displacement_m,
            "restitution": self.study.oscillator.restitution,
            "measures": self.measures.iter().map(measure).collect::<Vec<_>>(),
            "sites": self.sites.iter().map(site).collect::<Vec<_>>(),
        })
    }

    /// Where `at` is.
    pub(crate) fn place(&self, at: &At) -> Answer<Place<'_>> {
        let site = self.site(&at.site)?;
        let measure: IntensityMeasure = at.measure.parse().map_err(refused)?;
        let found = site.curves.iter().find(|curve| curve.measure == measure);
        let found = found.ok_or_else(|| format!("{} has no hazard curve of {}", site.name, measure.label()))?;
        let of = self.measure(measure)?;
        Ok(Place { of, curve: &found.curve, weights: &found.weights, alarms: &found.alarms })
    }

    /// The site of a name.
    pub(crate) fn site(&self, name: &str) -> Answer<&Site> {
        self.sites.iter().find(|site| site.name == name).ok_or_else(|| format!("there is no site {name:?}"))
    }

    /// How rare.
    pub(crate) fn risk(&self, at: &At) -> Answer<Risk> {
        at.risk(self.study.risk.years)
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
            "flag": all.iter().map(|own| flag(own.ordinate.flag)).collect::<Vec<_>>(),
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

fn flag(flag: OrdinateFlag) -> &'static str {
    match flag {
        OrdinateFlag::Regular => "regular",
        OrdinateFlag::NoExceedance => "no exceedance",
        OrdinateFlag::Censored => "censored",
    }
}
