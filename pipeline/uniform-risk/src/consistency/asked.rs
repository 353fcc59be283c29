//! The answer at risks that a result was asked for after its run: verdict and weights are those of the study's own
//! probabilities, and spectra are read at the others.

use uplift_consistency::{DEVIATION_RATES, Verdict};
use uplift_job::Array;
use uplift_motion::IntensityMeasure;
use uplift_result::{Fit, ResultFile, StoredConsistency};

use super::spectra::repairs_of;
use super::{Finding, Question, Repairs};
use crate::error::UniformRiskError;
use crate::stored_stripes::StoredStripes;

/// What [`ResultFile::consistency`] says of `file` at the risks that it is asked for; with the spectra of weights where
/// it has some.
///
/// # Errors
/// A file that is damaged.
pub(crate) fn consistency_of_asked(file: &ResultFile) -> Result<Vec<StoredConsistency>, UniformRiskError> {
    let (question, is_repaired) = (Question::from_result(file)?, file.has_repair());
    let findings = question.findings(is_repaired)?;
    let axes = file.axes()?;
    let asked = question.at(&axes.poes, axes.years)?;
    let levels_asked = asked.findings(false)?;
    let repairs =
        if is_repaired { repairs_of(file, &StoredStripes::read(file)?, &asked, &findings)? } else { Vec::new() };
    let mut found = Vec::new();
    for (scaled_to, levels) in &question.analyses {
        let own: Vec<&Finding> = findings.iter().filter(|finding| finding.scaled_to == *scaled_to).collect();
        if let Some(first) = own.first() {
            let repairs = repairs.iter().find(|repairs| repairs.measure == *scaled_to);
            let of_ratio: Vec<&Finding> = levels_asked.iter().filter(|own| own.scaled_to == *scaled_to).collect();
            found.push(stored(&asked, (*scaled_to, first.other), levels.len(), (&own, &of_ratio), repairs));
        }
    }
    Ok(found)
}

/// What a result holds of the `findings` on one measure, with the ratios of `of_ratio`.
pub(super) fn stored(
    question: &Question,
    (scaled_to, other): (IntensityMeasure, IntensityMeasure),
    levels: usize,
    (findings, of_ratio): (&[&Finding], &[&Finding]),
    repairs: Option<&Repairs>,
) -> StoredConsistency {
    let sites = question.sites.len();
    let (findings, of_ratio) = (by_site(findings, sites), by_site(of_ratio, sites));
    let of_site = |site: usize| findings[site];
    let deviation = |site: usize| of_site(site)?.diagnosis.deviation.as_ref();
    let repaired = |site: usize| of_site(site)?.repaired();
    let rates = [sites, DEVIATION_RATES];
    StoredConsistency {
        scaled_to,
        other,
        rate_per_year: Array::from_fn(rates, |[site, rate]| {
            of_site(site).map_or(f64::NAN, |finding| finding.range.rates::<DEVIATION_RATES>()[rate])
        }),
        site_level: Array::from_fn(rates, |[site, rate]| deviation(site).map_or(f64::NAN, |own| own.site_levels[rate])),
        implied_level: Array::from_fn(rates, |[site, rate]| {
            deviation(site).map_or(f64::NAN, |own| own.implied_levels[rate])
        }),
        repaired_level: repairs.map(|_| {
            Array::from_fn(rates, |[site, rate]| {
                let own = repaired(site).and_then(|repaired| repaired.diagnosis.deviation.as_ref());
                own.map_or(f64::NAN, |own| own.implied_levels[rate])
            })
        }),
        bias: (0..sites).map(|site| deviation(site).map_or(f64::NAN, |own| own.bias)).collect(),
        max: (0..sites).map(|site| deviation(site).map_or(f64::NAN, |own| own.max)).collect(),
        verdict: (0..sites)
            .map(|site| of_site(site).and_then(|own| own.diagnosis.verdict()).map_or("", Verdict::key).to_owned())
            .collect(),
        poes: question.poes.clone(),
        years: question.years,
        ratio: Array::from_fn([sites, question.poes.len()], |[site, poe]| {
            of_ratio[site].and_then(|own| own.diagnosis.targets[poe].ratio).unwrap_or(f64::NAN)
        }),
        effective_records: repairs.map(|_| {
            Array::from_fn([sites, levels], |[site, level]| {
                repaired(site).map_or(f64::NAN, |own| own.diagnosis.stripes[level].effective_records)
            })
        }),
        fits: repairs.map(|repairs| repairs.fits.map(|fit| Fit::from_exponential(fit.as_ref().ok()))),
        u_m: repairs.map(|repairs| {
            repairs.ordinates.map(|ordinate| ordinate.map_or(f64::NAN, |ordinate| ordinate.displacement_m))
        }),
    }
}

/// The finding of each site, where there is one.
pub(super) fn by_site<'a>(findings: &[&'a Finding], sites: usize) -> Vec<Option<&'a Finding>> {
    let mut all = vec![None; sites];
    for &finding in findings {
        all[finding.site] = Some(finding);
    }
    all
}
