//! A result as JSON.

use serde_json::{Value, json};
use uplift_job::alarm::name_result;
use uplift_job::text::finite;
use uplift_questions::influence::{CHANGES, RecordInfluence};
use uplift_result::declared::{Field, Group, Quantity};
use uplift_result::{
    BANDS, BandKind, EFFICIENCY, Fit, Fits, INFERRED_BANDS, StoredBands, StoredEfficiency, StoredSpread, StoredTrend,
    TRENDS, regression, urs,
};
use uplift_uniform_risk::{CONFIDENCE, QUOTED_LIMITS};

use super::Export;
use super::added::Influence;
use super::bands::BandOf;
use super::source::{ConsistencyOf, Row};

impl Export {
    /// Everything as one JSON object; what is not finite is null.
    pub fn json(&self) -> Value {
        let mut all = json!({
            "provenance": self.provenance(),
            "title": self.head.title,
            "created": self.head.created,
            "study_digest": self.head.study_digest(),
            "record_set": self.head.record_set,
            "synthetic": self.head.synthetic,
            "alarms": self.alarms,
            "years": self.spectra.years,
            "strength": self.spectra.strengths,
            "confidence": self.bands.as_ref().map_or(CONFIDENCE, |bands| bands.confidence),
            "resampled": self.bands.as_ref().map(|bands| bands.unit.key()),
            "influence": self.influences(),
            "efficiency": self.added.efficiency.iter().map(efficiency).collect::<Vec<_>>(),
            "spectra": self.rows().map(|row| self.spectrum(&row)).collect::<Vec<_>>(),
        });
        if !self.consistency.is_empty() {
            all["consistency"] = self.consistencies().map(|row| consistency(&row)).collect();
        }
        if !self.findings.is_empty() {
            all["structures"] = self.findings_json();
        }
        name_result(&mut all, &self.typed);
        all
    }

    fn spectrum(&self, row: &Row<'_>) -> Value {
        let mut spectrum = json!({
            "site": row.spectrum.site,
            "im": row.spectrum.measure.label(),
            "poe": row.spectrum.poe,
            "return_period_years": finite(row.return_period),
        });
        for quantity in urs::GROUP.exported() {
            spectrum[quantity.exported_name()] =
                self.places(row).map(|at| cell(quantity, row.of_measure, at)).collect();
        }
        spectrum["confidence"] = CONFIDENCE.into();
        spectrum["band_of"] = <&str>::from(row.band_of).into();
        add_quoted(&mut spectrum, row, BandKind::PLAIN);
        spectrum["fit"] = coefficients(&row.spectrum.fit);
        spectrum["bands"] = self.bands_json(row, BandKind::PLAIN).into();
        spectrum["disaggregation"] =
            self.influence_on(row).map(|influence| self.disaggregation(row.at, influence)).into();
        if let Some((u_m, fit)) = self.repaired(row) {
            spectrum[BandKind::REPAIRED.column(urs::U_M.name)] = numbers(u_m).into();
            add_quoted(&mut spectrum, row, BandKind::REPAIRED);
            spectrum["fit_consistent"] = coefficients(fit);
            spectrum["bands_consistent"] = self.bands_json(row, BandKind::REPAIRED).into();
        }
        for kind in [BandKind::JOINT, BandKind::REPAIRED_JOINT] {
            let bands = self.bands_json(row, kind);
            if !bands.is_empty() {
                spectrum[format!("bands{}", kind.suffix)] = bands.into();
            }
        }
        for over in self.spread_over() {
            let Some(limits_m) = self.spread_of(row, over) else { continue };
            let named = StoredSpread::names().zip(limits_m);
            let named = named.map(|(name, values_m)| (format!("{name}_m"), numbers(values_m).into()));
            spectrum[format!("spread_over_{}", over.key())] = Value::Object(named.collect());
        }
        spectrum
    }

    /// The bands of a kind of a spectrum, by size of the sample.
    fn bands_json(&self, row: &Row<'_>, kind: BandKind) -> Vec<Value> {
        let names = self.bands.as_ref().map(StoredBands::limit_names).unwrap_or_default();
        self.bands_of(row, kind).iter().map(|own| band(own, &names)).collect()
    }

    /// The records of every spectrum, the most influential first.
    fn influences(&self) -> Vec<Value> {
        let of_row = |row: Row<'_>| {
            let of = |found: &RecordInfluence| {
                let mut said = json!({
                    "site": row.spectrum.site,
                    "im": row.spectrum.measure.label(),
                    "poe": row.spectrum.poe,
                    "record": self.added.records[found.record],
                });
                for (name, _, value) in CHANGES {
                    said[name] = finite(value(found)).into();
                }
                said
            };
            let ranking = self.influence_on(&row).map(|influence| &influence.ranking[row.at]);
            ranking.into_iter().flatten().map(of).collect::<Vec<Value>>()
        };
        self.rows().flat_map(of_row).collect()
    }

    /// Where the risk of each ordinate comes from.
    fn disaggregation(&self, [site, poe]: [usize; 2], influence: &Influence) -> Value {
        let share = |strength| numbers(influence.stored.shares.block([site, poe, strength]));
        json!({
            "level_from": influence.stored.bins,
            "share": (0..self.spectra.strengths.len()).map(share).collect::<Vec<_>>(),
        })
    }
}

fn coefficients(fit: &Fit) -> Value {
    let fit = Fits::from_fn([1, 1], |_| *fit);
    let all = regression::GROUP.exported();
    Value::Object(all.map(|quantity| (quantity.name.to_owned(), cell(quantity, &fit, 0))).collect())
}

/// The value at an index of a stored array.
pub(super) fn cell<T>(quantity: &Quantity<T>, of: &T, at: usize) -> Value {
    match &quantity.field {
        Field::F64(place) => finite(*(place.get)(of, at)).into(),
        Field::Made(number) => finite(number(of, at)).into(),
        Field::U32(place) => (*(place.get)(of, at)).into(),
        Field::Bool(place) => (*(place.get)(of, at)).into(),
        Field::Flag(place) => (place.get)(of, at).word().into(),
        Field::Text(place) => (place.get)(of, at).as_str().into(),
    }
}

fn consistency(row: &ConsistencyOf<'_>) -> Value {
    let mut said = json!({
        "site": row.site,
        "scaled_to": row.of.scaled_to.label(),
        "shows": row.of.other.label(),
        "poe": row.of.poes,
        "years": row.of.years,
        "ratio": numbers(row.ratio),
    });
    for (figure, value) in row.figures() {
        said[figure.exported_name()] = finite(value).into();
    }
    said["verdict"] = row.verdict.into();
    if let Some(least) = row.least_effective {
        said["least_effective_records"] = finite(least).into();
    }
    said
}

fn efficiency(of: &StoredEfficiency) -> Value {
    let trend = |trend: &StoredTrend| {
        let mut said = json!({ "covariate": trend.covariate });
        add(&mut said, &TRENDS, trend, trend.slope.len());
        said
    };
    let mut said = json!({ "im": of.measure.label(), "scaled_to": of.scaled_to.label() });
    add(&mut said, &EFFICIENCY, of, of.rocking.len());
    said["trends"] = of.trends.iter().map(trend).collect();
    said
}

/// The limits of the quoted band of a kind of spectrum.
fn add_quoted(spectrum: &mut Value, row: &Row<'_>, kind: BandKind) {
    for (name, limits_m) in QUOTED_LIMITS.iter().zip(row.quoted_m(kind)) {
        spectrum[kind.column(name)] = numbers(&limits_m).into();
    }
}

/// A band, its percentiles called `names`.
fn band(band: &BandOf<'_>, names: &[String; 3]) -> Value {
    let mut said = json!({ "sample_size": band.records });
    for (name, limit_m) in names.iter().zip(band.limits_m) {
        said[name] = numbers(limit_m).into();
    }
    for (quantity, figure) in BANDS.exported().zip(band.figures) {
        said[quantity.exported_name()] = finite(figure).into();
    }
    for (quantity, limits_m) in INFERRED_BANDS.quantities.iter().zip(band.inferred_m.iter().flatten()) {
        said[quantity.name] = numbers(limits_m).into();
    }
    if let Some(share) = band.failed_share {
        said["failed_share"] = finite(share).into();
    }
    said
}

/// The first `count` values of each array of `group`.
fn add<T>(said: &mut Value, group: &Group<T>, of: &T, count: usize) {
    for quantity in group.exported() {
        said[quantity.exported_name()] = (0..count).map(|at| cell(quantity, of, at)).collect();
    }
}

fn numbers(values: &[f64]) -> Vec<Option<f64>> {
    values.iter().copied().map(finite).collect()
}
