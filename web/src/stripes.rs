//! The stripes of a result, as `uplift export --web` writes them, and the sites that meet them.

use serde_json::{Value, json};
use uplift_fragility::Stripes as Stripe;
use uplift_hazard::{ComponentDefinition, Extrapolation, HazardCurve};
use uplift_motion::IntensityMeasure;
use uplift_risk::{FEW_RECORDS, PooledDemand, StripeWeights};
use uplift_study::{AnyStudy, Study, UniformRiskStudy, definition_of};
use uplift_web_stripes::{FORMAT, WebMeasure, WebStripes};

use crate::calculator::{Answer, At, Risk, refused};

/// What a refused curve is told, and what the page offers for it.
const EXTRAPOLATION_KEY: &str = "choose log-log extrapolation (risk.extrapolate = \"loglog\")";
const EXTRAPOLATION_BOX: &str = "tick “Extrapolate curves that end too early”";

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
    pub(crate) name: String,
    pub(crate) curves: Vec<SiteCurve>,
    /// What to do with levels outside the curves.
    pub(crate) extrapolate: Extrapolation,
}

/// The hazard curve of one measure at a site.
pub(crate) struct SiteCurve {
    pub(crate) measure: IntensityMeasure,
    pub(crate) curve: HazardCurve,
    pub(crate) weights: StripeWeights,
    /// What `uplift` warns of, as it writes it.
    pub(crate) alarms: Value,
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

impl Stripes {
    /// Reads what `uplift export --web` wrote.
    pub(crate) fn read(bytes: &[u8]) -> Answer<Self> {
        let not_ours = |error: serde_json::Error| format!("not a file of `uplift export --web`: {error}");
        let read: WebStripes = serde_json::from_slice(bytes).map_err(not_ours)?;
        if read.format != FORMAT {
            return Err(format!("the file is of the format {:?}, and this page reads {FORMAT:?}", read.format));
        }
        let study = match Study::stored(&read.study).map_err(refused)? {
            AnyStudy::UniformRisk(study) => *study,
            _ => return Err("the study in the file is not of uniform risk".to_owned()),
        };
        let measure = |own: WebMeasure| {
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

    pub(crate) fn measure(&self, measure: IntensityMeasure) -> Answer<&Measure> {
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
            let (curve, note) = self.by_the_records_definition(measure, curve)?;
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
    fn by_the_records_definition(
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

    /// The site of a name.
    pub(crate) fn site(&self, name: &str) -> Answer<&Site> {
        self.sites.iter().find(|site| site.name == name).ok_or_else(|| format!("there is no site {name:?}"))
    }

    /// How rare.
    pub(crate) fn risk(&self, at: &At) -> Answer<Risk> {
        at.risk(self.study.risk.years)
    }
}
