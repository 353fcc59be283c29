//! A result as a MATLAB file.

pub(super) mod level_5;

use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_questions::efficiency::{FIGURES, TRENDS};
use uplift_result::declared::Quantity;
use uplift_result::{BAND_FIGURES, INFERRED_BANDS, StoredSpectra, StoredSpread, before_unit, regression, urs};
use uplift_uniform_risk::QUOTED_LIMITS;

use super::Export;
use super::added::Influence;
use super::bands::{BY_SPECTRUM, name_with};
use super::source;
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
            let shape = Shape(vec![strengths.len(), poes.len(), sites.len()]);
            add(&mut file, urs::GROUP.quantities, key, &shape, spectra);
            let rows = self.rows().filter(|row| row.spectrum.measure == spectra.measure);
            let quoted_m: Vec<[Vec<f64>; 2]> = rows.map(|row| row.quoted_m()).collect();
            for (limit, name) in QUOTED_LIMITS.iter().enumerate() {
                let limits_m: Vec<f64> = quoted_m.iter().flat_map(|of_row| of_row[limit].iter().copied()).collect();
                file.numbers(&before_unit(name, &format!("_{key}")), &shape, &limits_m);
            }
            add(&mut file, regression::COEFFICIENTS, key, &Shape(vec![poes.len(), sites.len()]), &spectra.fits);
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

    /// Whether the records bring the site's hazard, columns over the sites, and the spectra of weighted records as the
    /// plain ones.
    fn add_consistency(&self, file: &mut MatFile) {
        let StoredSpectra { strengths, poes, sites, .. } = &self.spectra;
        for of in &self.consistency {
            let key = of.scaled_to.key();
            let column = Shape::column(sites.len());
            for (name, _, by_site) in source::FIGURES {
                file.numbers(&format!("consistency_{name}_{key}"), &column, by_site(of));
            }
            let verdicts: Vec<&str> = of.verdict.iter().map(String::as_str).collect();
            file.texts(&format!("consistency_verdict_{key}"), &verdicts);
            if let Some(least) = &of.least_effective {
                file.numbers(&format!("consistency_least_effective_{key}"), &column, least);
            }
            let shape = Shape(vec![poes.len(), sites.len()]);
            file.numbers(&format!("consistency_ratio_{key}"), &shape, of.ratio.values());
            if let (Some(u_m), Some(fits)) = (&of.u_m, &of.fits) {
                let spectra = Shape(vec![strengths.len(), poes.len(), sites.len()]);
                file.numbers(&format!("u_consistent_{key}_m"), &spectra, u_m.values());
                add(file, regression::COEFFICIENTS, &format!("consistent_{key}"), &shape, fits);
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
        let shape = Shape::column(self.spectra.strengths.len());
        for of in &self.added.efficiency {
            let key = of.measure.key();
            for (name, _, values) in FIGURES {
                file.numbers(&format!("{name}_{key}"), &shape, values(of));
            }
            for (trend, (name, _, values)) in of.trends.iter().flat_map(|trend| TRENDS.map(|own| (trend, own))) {
                file.numbers(&format!("{name}_{}_{key}", trend.covariate), &shape, values(trend));
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
            let kinds = BY_SPECTRUM.into_iter().filter_map(|kind| Some((kind, kind.of(of)?)));
            for (kind, own) in kinds.clone() {
                for (name, limits) in bands.limit_names().iter().zip(own.limits_m) {
                    file.numbers(&name_with(kind, name, key), &spectra, limits.values());
                }
                for ((name, _), figure) in BAND_FIGURES.iter().zip(own.figures) {
                    if let Some(figure) = figure {
                        file.numbers(&name_with(kind, name, key), &figures, figure.values());
                    }
                }
            }
            for (kind, failed) in kinds.rev().filter_map(|(kind, own)| Some((kind, own.failed?))) {
                file.numbers(&name_with(kind, "failed", key), &of_sizes, failed.values());
            }
            if let Some(inferred) = &of.inferred {
                add(file, INFERRED_BANDS.quantities, key, &spectra, inferred);
            }
        }
    }
}

/// The arrays of `value`, each named with `key`.
fn add<T>(file: &mut MatFile, quantities: &[Quantity<T>], key: &str, shape: &Shape, value: &T) {
    let count = shape.0.iter().product();
    for quantity in quantities {
        let values: Vec<f64> = (0..count).filter_map(|at| quantity.number(value, at)).collect();
        file.numbers(&quantity.name_with(key), shape, &values);
    }
}
