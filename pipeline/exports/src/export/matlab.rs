//! A result as a MATLAB file.

pub(super) mod level_5;

use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_motion::IntensityMeasure;
use uplift_result::declared::{Field, Lengths, Quantity};
use uplift_result::layout::axis::{POE, SAMPLE_SIZE, SITE, STRENGTH};
use uplift_result::{
    BANDS, BandKind, CONSISTENCY, EFFICIENCY, INFERRED_BANDS, StoredSpectra, StoredSpread, TRENDS, regression, urs,
};
use uplift_uniform_risk::QUOTED_LIMITS;

use super::Export;
use super::added::Influence;
use super::bands::{BY_SPECTRUM, name_with};
use crate::error::ExportsError;
use level_5::{MatFile, Shape};

impl Export {
    /// A MATLAB file: `u_pgv_m` and its band are strength × probability × site, bands `u05_pgv_m` are strength × size ×
    /// probability × site, coefficients probability × site.
    ///
    /// # Errors
    /// A result that is too large for the format.
    pub fn matlab(&self) -> Result<Vec<u8>, ExportsError> {
        let StoredSpectra { strengths, poes, years, sites, measures } = &self.spectra;
        let mut file = MatFile::new(self.provenance());
        file.text("provenance", self.provenance());
        let said = |alarm: &Alarm| format!("{}: {alarm}", alarm.severity.word());
        let alarms: Vec<String> = self.alarms.iter().map(said).collect();
        file.texts("warnings", &alarms.iter().map(String::as_str).collect::<Vec<_>>());
        file.numbers("strength", &Shape::column(strengths.len()), strengths);
        file.numbers("poe", &Shape::column(poes.len()), poes);
        file.numbers("years", &Shape::column(1), &[*years]);
        file.numbers("return_period_years", &Shape::column(poes.len()), &self.return_periods);
        file.texts("site", &sites.iter().map(String::as_str).collect::<Vec<_>>());
        for spectra in measures {
            let key = spectra.measure.key();
            // spectra come site by site, in each probability by probability: the order of MATLAB's columns
            let lengths = &[(SITE.name, sites.len()), (POE.name, poes.len()), (STRENGTH.name, strengths.len())];
            add(&mut file, urs::GROUP.exported(), lengths, spectra, |own| own.name_with(key));
            self.add_quoted(&mut file, spectra.measure, BandKind::PLAIN);
            add(&mut file, regression::COEFFICIENTS, lengths, &spectra.fits, |own| own.name_with(key));
        }
        self.add_consistency(&mut file);
        self.add_bands(&mut file);
        self.add_spreads(&mut file);
        self.add_influence(&mut file);
        self.add_efficiency(&mut file);
        if !self.findings.is_empty() {
            self.add_findings(&mut file);
        }
        Ok(file.finish().map_err(JobError::input)?)
    }

    /// The quoted band of the spectra of a kind by a measure: `lower_pgv_m`.
    fn add_quoted(&self, file: &mut MatFile, measure: IntensityMeasure, kind: BandKind) {
        let StoredSpectra { strengths, poes, sites, .. } = &self.spectra;
        let rows = self.rows().filter(|row| row.spectrum.measure == measure);
        let quoted_m: Vec<[Vec<f64>; 2]> = rows.map(|row| row.quoted_m(kind)).collect();
        let shape = Shape(vec![strengths.len(), poes.len(), sites.len()]);
        for (limit, name) in QUOTED_LIMITS.iter().enumerate() {
            let limits_m = quoted_m.iter().map(|of_row| of_row[limit].as_slice()).collect::<Vec<_>>().concat();
            file.numbers(&name_with(kind, name, measure.key()), &shape, &limits_m);
        }
    }

    /// Whether the records bring the site's hazard, columns over the sites, and the spectra of weighted records as the
    /// plain ones.
    fn add_consistency(&self, file: &mut MatFile) {
        let StoredSpectra { strengths, poes, sites, .. } = &self.spectra;
        for (of, least) in self.consistency.iter().zip(&self.least_effective) {
            let key = of.scaled_to.key();
            let lengths = &[(SITE.name, sites.len()), (POE.name, poes.len())];
            add(file, CONSISTENCY.exported(), lengths, of, |own| format!("consistency_{}_{key}", own.exported_name()));
            let verdicts: Vec<&str> = of.verdict.iter().map(String::as_str).collect();
            file.texts(&format!("consistency_verdict_{key}"), &verdicts);
            if let Some(least) = least {
                file.numbers(&format!("consistency_least_effective_{key}"), &Shape::column(sites.len()), least);
            }
            let shape = Shape(vec![poes.len(), sites.len()]);
            file.numbers(&format!("consistency_ratio_{key}"), &shape, of.ratio.values());
            if let (Some(u_m), Some(fits)) = (&of.u_m, &of.fits) {
                let spectra = Shape(vec![strengths.len(), poes.len(), sites.len()]);
                file.numbers(&name_with(BandKind::REPAIRED, urs::U_M.name, key), &spectra, u_m.values());
                self.add_quoted(file, of.scaled_to, BandKind::REPAIRED);
                let name = |own: &Quantity<_>| own.name_with(&format!("consistent_{key}"));
                add(file, regression::COEFFICIENTS, lengths, fits, name);
            }
        }
    }

    /// Mean and fractiles over what is not known, as the spectra: `u05_hazard_pgv_m`; NaN where a site has no such
    /// spread.
    fn add_spreads(&self, file: &mut MatFile) {
        let StoredSpectra { strengths, poes, sites, measures, .. } = &self.spectra;
        let shape = Shape(vec![strengths.len(), poes.len(), sites.len()]);
        for over in self.spread_over() {
            for of in measures {
                let none = vec![f64::NAN; strengths.len()];
                for (place, name) in StoredSpread::names().enumerate() {
                    let rows = self.rows().filter(|row| row.spectrum.measure == of.measure);
                    let values = rows.flat_map(|row| match self.spread_of(&row, over) {
                        Some(limits_m) => limits_m[place].to_vec(),
                        None => none.clone(),
                    });
                    let values: Vec<f64> = values.collect();
                    file.numbers(&format!("{name}_{}_{}_m", over.key(), of.measure.key()), &shape, &values);
                }
            }
        }
    }

    /// What `uplift influence` found, if it was run: `share_pgv` is bin × strength × probability × site,
    /// `u_without_pgv_m` strength × record × probability × site.
    fn add_influence(&self, file: &mut MatFile) {
        let StoredSpectra { strengths, poes, sites, .. } = &self.spectra;
        let records: Vec<&str> = self.added.records.iter().map(String::as_str).collect();
        if !self.added.influence.is_empty() {
            file.texts("record", &records);
        }
        for Influence { stored, .. } in &self.added.influence {
            let key = stored.measure.key();
            file.numbers(&format!("bin_{key}"), &Shape::column(stored.bins.len()), &stored.bins);
            let shape = Shape(vec![stored.bins.len(), strengths.len(), poes.len(), sites.len()]);
            file.numbers(&format!("share_{key}"), &shape, stored.shares.values());
            if let Some(without_m) = &stored.without_m {
                let shape = Shape(vec![strengths.len(), records.len(), poes.len(), sites.len()]);
                file.numbers(&format!("u_without_{key}_m"), &shape, without_m.values());
            }
        }
    }

    /// What `uplift measures` found, if it was run: columns over the strengths.
    fn add_efficiency(&self, file: &mut MatFile) {
        let lengths = &[(STRENGTH.name, self.spectra.strengths.len())];
        for of in &self.added.efficiency {
            let key = of.measure.key();
            add(file, EFFICIENCY.exported(), lengths, of, |own| own.name_with(key));
            for trend in &of.trends {
                let name = |own: &Quantity<_>| own.name_with(&format!("{}_{key}", trend.covariate));
                add(file, TRENDS.exported(), lengths, trend, name);
            }
        }
    }

    /// The bands, if there are some.
    fn add_bands(&self, file: &mut MatFile) {
        let Some(bands) = &self.bands else { return };
        let StoredSpectra { strengths, poes, sites, .. } = &self.spectra;
        let sizes: Vec<f64> = bands.sizes.iter().copied().map(f64::from).collect();
        file.numbers("sample_size", &Shape::column(sizes.len()), &sizes);
        file.numbers("confidence", &Shape::column(1), &[bands.confidence]);
        for of in &bands.measures {
            let key = of.measure.key();
            let spectra = Shape(vec![strengths.len(), sizes.len(), poes.len(), sites.len()]);
            let figures = Shape(vec![sizes.len(), poes.len(), sites.len()]);
            let of_sizes = Shape(vec![sizes.len(), sites.len()]);
            let kinds = BY_SPECTRUM.into_iter().filter_map(|kind| Some((kind, kind.select(of)?)));
            for (kind, own) in kinds.clone() {
                for (name, limits) in bands.limit_names().iter().zip(own.limits_m) {
                    file.numbers(&name_with(kind, name, key), &spectra, limits.values());
                }
                for (figure, own) in BANDS.exported().zip(own.figures) {
                    if let Some(own) = own {
                        file.numbers(&name_with(kind, figure.exported_name(), key), &figures, own.values());
                    }
                }
            }
            for (kind, failed) in kinds.clone().rev().filter_map(|(kind, own)| Some((kind, own.failed?))) {
                file.numbers(&name_with(kind, "failed", key), &of_sizes, failed.values());
            }
            for (kind, inferred) in kinds.filter_map(|(kind, own)| Some((kind, own.inferred?))) {
                let sizes = (SAMPLE_SIZE.name, sizes.len());
                let lengths =
                    &[(SITE.name, sites.len()), (POE.name, poes.len()), sizes, (STRENGTH.name, strengths.len())];
                add(file, INFERRED_BANDS.quantities, lengths, inferred, |own| name_with(kind, own.name, key));
            }
        }
    }
}

/// Arrays of `value` under the names that `name` gives them, their axes in MATLAB's order: the reverse.
pub(super) fn add<T: 'static>(
    file: &mut MatFile,
    quantities: impl IntoIterator<Item = &'static Quantity<T>>,
    lengths: Lengths<'_>,
    value: &T,
    name: impl Fn(&Quantity<T>) -> String,
) {
    for quantity in quantities {
        let shape: Vec<usize> = quantity.shape(&[], lengths).into_iter().rev().map(|(_, length)| length).collect();
        let (name, count) = (name(quantity), shape.iter().product());
        if let Field::Text(place) = &quantity.field {
            let texts: Vec<&str> = (0..count).map(|at| (place.get)(value, at).as_str()).collect();
            file.texts(&name, &texts);
        } else {
            let shape = if let [length] = shape[..] { Shape::column(length) } else { Shape(shape) };
            file.numbers(&name, &shape, &quantity.numbers(value, 0..count));
        }
    }
}
