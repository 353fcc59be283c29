//! The part of `uplift run` that many sites take: read before the analyses, computed and written after them.

mod cube;
mod files;
mod layout;
mod repair;
mod shape;
mod slices;

pub use files::{SiteTableFiles, site_table_paths};
pub use layout::{SHOWN_ON_MAP, SiteRow, SiteTableLayout};
pub use repair::{RepairedSite, SiteRepair};
pub(super) use shape::PROBLEM;
pub use slices::{SLICE, join, slice_path, sorted_slices, stripes_beside};

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use uplift_hazard::HazardCurve;
use uplift_ida::Watch;
use uplift_inputs::{BatchSite, SharedCurve, SiteCurves, SiteExport, SiteList, read_site_list};
use uplift_job::JobError;
use uplift_job::events::{Events, Progress};
use uplift_job::text::{risk_name, thousands};
use uplift_risk::{OrdinateFlag, StripeWeights};
use uplift_study::{Repair, UniformRiskStudy};
use uplift_uniform_risk::consistency::Question;
use uplift_uniform_risk::{BandOf, QuotedUnits, SiteRisk, SiteSpectra, Stripes, pooled_demand, precision};

use crate::error::StudiesError;

/// Bytes of text, about, that are in memory at a time.
const BATCH_BYTES: usize = 16 << 20;
/// Bytes that an ordinate takes as text, about.
const ORDINATE_BYTES: usize = 80;
/// Sites by which it is decided whether bands are by record or by earthquake.
const JUDGED_SITES: usize = 8;

/// What many sites leave behind: nothing where the study has no table of sites.
#[derive(Default)]
pub struct SiteOutput {
    /// What to know before using the numbers.
    pub warnings: Vec<String>,
    /// With how many sites deserve which warning, as JSON.
    files: Option<(SiteTableFiles, String)>,
}

impl SiteOutput {
    /// Put the files in their places.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(self) -> Result<Vec<PathBuf>, StudiesError> {
        self.files.map_or(Ok(Vec::new()), |(files, findings)| files.finish(&findings))
    }

    fn new(
        files: SiteTableFiles,
        tally: &Tally,
        study: &UniformRiskStudy,
        list: &SiteList,
    ) -> Result<Self, StudiesError> {
        let findings = serde_json::to_string(tally).map_err(|error| JobError::input(error.to_string()))?;
        Ok(Self { warnings: tally.warnings(study, list), files: Some((files, findings)) })
    }
}

/// The study's table of sites, found in its exports.
///
/// # Errors
/// A table or an export that cannot be used.
pub fn read(study: &UniformRiskStudy, events: &dyn Events) -> Result<Option<SiteList>, StudiesError> {
    let list = read_site_list(study)?;
    if let Some(list) = &list {
        events.remark("sites", &list.description());
    }
    Ok(list)
}

/// Spectra and coefficients of every site of the list, written site by site; `line` says where the numbers come from.
pub(crate) fn compute<'a>(
    study: &'a UniformRiskStudy,
    list: &SiteList,
    (stripes, question): (&[Stripes], &Question),
    (path, line): (&Path, &str),
    events: &dyn Events,
) -> Result<SiteOutput, StudiesError> {
    // both are in the order of the study's measures
    let is_listed = |own: &&Stripes| list.exports.iter().any(|export| export.measure == own.measure);
    let listed: Vec<&Stripes> = stripes.iter().filter(is_listed).collect();
    let mut risks: Vec<SiteRisk<'_>> =
        listed.iter().map(|stripes| SiteRisk::new(study, stripes)).collect::<Result<_, _>>()?;
    let is_repaired = study.consistency.repair == Repair::Weights;
    let repair = is_repaired.then(|| SiteRepair::new(question, list)).transpose()?;
    let mut files = SiteTableFiles::create(path, study, list, line)?;
    let mut tally = Tally::new(study, list);
    list.require_unchanged()?;
    let mut curves = SiteCurves::open(list, list.range.clone())?;
    let ordinates = list.exports.len() * study.risk.poe.len() * study.strengths.len();
    let most = (BATCH_BYTES / (ORDINATE_BYTES * ordinates.max(1))).clamp(8, 512);
    let progress = Progress::begin(events, "sites", "sites", list.range.len() as u64);

    if study.site_table.as_ref().is_some_and(|table| table.bands) {
        // of the table, so that its slices have the bands of the whole
        let first = SiteCurves::open(list, 0..list.sites.len().min(most))?.next_batch(most)?;
        let with_bands = |(export, risk): (usize, SiteRisk<'a>)| {
            let units = quoted_units(study, list, (export, listed[export]), (&first, question))?;
            if units.of == BandOf::Earthquakes {
                events.remark("sites", &format!("bands by {} are by earthquake", listed[export].measure.label()));
            }
            Ok::<_, StudiesError>(risk.with_bands(units.records, files.layout().in_table().to_vec()))
        };
        risks = risks.into_iter().enumerate().map(with_bands).collect::<Result<_, _>>()?;
    }
    let mut batch = curves.next_batch(most)?;
    while !batch.is_empty() {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        // the next sites are read while these are computed
        let of_site = |site: &BatchSite| spectra_of(study, list, (&risks, repair.as_ref()), &files, site);
        let (done, next): (Vec<(SiteRow, SiteFindings)>, _) =
            rayon::join(|| batch.par_iter().map(of_site).collect(), || curves.next_batch(most));
        progress.finished(done.len() as u64);
        for (row, findings) in done {
            files.write(row)?;
            tally.add(&findings);
        }
        batch = next?;
    }
    drop(progress);
    SiteOutput::new(files, &tally, study, list)
}

/// The units of all bands by the measure of `export`, as the first sites of the table tell them.
fn quoted_units(
    study: &UniformRiskStudy,
    list: &SiteList,
    (export, stripes): (usize, &Stripes),
    (first, question): (&[BatchSite], &Question),
) -> Result<QuotedUnits, StudiesError> {
    let weights = |site: &BatchSite| {
        let (own, exported) = (&list.exports[export], site.curves[export].as_ref().as_ref().ok()?);
        own.weights(study, &own.curve(study, exported).ok()?).ok()
    };
    let weights: Vec<StripeWeights> = first.iter().filter_map(weights).take(JUDGED_SITES).collect();
    let demand = |strength| pooled_demand(stripes, strength);
    let found = precision(study, stripes.measure, demand, &weights.iter().collect::<Vec<_>>(), question)?;
    Ok(QuotedUnits::from_precision(found.as_ref(), question))
}

/// What deserves a warning, for each export and probability.
struct SiteFindings {
    /// `[export][poe]`.
    spectra: Vec<Vec<[bool; FINDINGS]>>,
    /// `[export]`, whether there is no repaired spectrum where one was asked for.
    unrepaired: Vec<bool>,
}

const FINDINGS: usize = 4;

fn spectra_of(
    study: &UniformRiskStudy,
    list: &SiteList,
    (risks, repair): (&[SiteRisk<'_>], Option<&SiteRepair<'_>>),
    files: &SiteTableFiles,
    site: &BatchSite,
) -> (SiteRow, SiteFindings) {
    let curve = |(export, exported): (&SiteExport, &SharedCurve)| {
        export.curve(study, exported.as_ref().as_ref().map_err(Clone::clone)?)
    };
    let curves: Vec<Result<HazardCurve, String>> = list.all_exports().zip(&site.curves).map(curve).collect();
    let mut spectra: Vec<Result<SiteSpectra, String>> = (list.exports.iter().zip(risks).zip(&curves))
        .map(|((export, risk), curve)| risk.spectra(&export.weights(study, curve.as_ref().map_err(Clone::clone)?)?))
        .collect();
    let of_branches = list.branches.iter().zip(&site.curves[curves.len()..]);
    for (measure, (own, risk)) in spectra.iter_mut().zip(risks).enumerate() {
        let weighted = of_branches.clone().filter(|(branch, _)| branch.of == measure).map(|(branch, exported)| {
            let curve = branch.export.curve(study, exported.as_ref().as_ref().map_err(Clone::clone)?)?;
            Ok::<_, String>((branch.weight, branch.export.weights(study, &curve)?))
        });
        // a site that a realization has no curve for has no spread
        if let (Ok(own), Ok(weighted)) = (own, weighted.collect::<Result<Vec<_>, _>>())
            && !weighted.is_empty()
        {
            own.spread_m = risk.spread_m(&weighted, files.layout().in_table()).unwrap_or_default();
        }
    }
    let repaired: Option<Vec<RepairedSite>> = repair.map(|repair| {
        risks.iter().enumerate().map(|(export, risk)| repair.repair_site(export, risk, &curves)).collect()
    });
    let findings = SiteFindings {
        spectra: spectra
            .iter()
            .map(|spectra| spectra.as_ref().map_or(Vec::new(), |spectra| found(study, spectra)))
            .collect(),
        unrepaired: repaired.iter().flatten().map(|own| own.spectra.is_err()).collect(),
    };
    (files.layout().row(&list.sites[site.site], &spectra, repaired.as_deref()), findings)
}

fn found(study: &UniformRiskStudy, spectra: &SiteSpectra) -> Vec<[bool; FINDINGS]> {
    let spectrum = |ordinates: &[uplift_risk::Ordinate]| {
        [
            ordinates.iter().any(|ordinate| ordinate.flag == OrdinateFlag::Censored),
            ordinates.iter().any(uplift_risk::Ordinate::has_significant_tail),
        ]
    };
    let by_poe = spectra.ordinates.chunks(study.strengths.len()).zip(&spectra.fits);
    by_poe
        .map(|(ordinates, fit)| {
            let [censored, tail] = spectrum(ordinates);
            [censored, tail, fit.is_err(), fit.as_ref().is_ok_and(|fit| fit.at_search_limit)]
        })
        .collect()
}

/// How many sites deserve which warning.
#[derive(Serialize, Deserialize)]
struct Tally {
    /// `[export][poe]`.
    counts: Vec<Vec<[u64; FINDINGS]>>,
    /// `[export]`.
    unrepaired: Vec<u64>,
}

impl Tally {
    fn new(study: &UniformRiskStudy, list: &SiteList) -> Self {
        Self {
            counts: vec![vec![[0; FINDINGS]; study.risk.poe.len()]; list.exports.len()],
            unrepaired: vec![0; list.exports.len()],
        }
    }

    fn add(&mut self, findings: &SiteFindings) {
        self.unrepaired.iter_mut().zip(&findings.unrepaired).for_each(|(count, &own)| *count += u64::from(own));
        for (counts, findings) in self.counts.iter_mut().zip(&findings.spectra) {
            for (counts, findings) in counts.iter_mut().zip(findings) {
                counts.iter_mut().zip(findings).for_each(|(count, &found)| *count += u64::from(found));
            }
        }
    }

    /// Adds those of other sites of the same study.
    fn join(&mut self, other: &Self) {
        self.unrepaired.iter_mut().zip(&other.unrepaired).for_each(|(count, own)| *count += own);
        let counts = self.counts.iter_mut().flatten().flatten();
        counts.zip(other.counts.iter().flatten().flatten()).for_each(|(count, own)| *count += own);
    }

    fn warnings(&self, study: &UniformRiskStudy, list: &SiteList) -> Vec<String> {
        const WORDS: [&str; FINDINGS] = [
            "have ordinates that are censored: overturned runs, or the last threshold, exceed the target risk",
            "have ordinates that take more than 1 % of their risk from outside the levels: add lower or higher levels",
            "have no fit: the column `problem` says why",
            "have a spectrum that is not a decaying exponential: its coefficients mean nothing one by one",
        ];
        let all = thousands(list.range.len() as u64);
        let mut warnings = Vec::new();
        for (export, &count) in list.exports.iter().zip(&self.unrepaired).filter(|(_, count)| **count > 0) {
            warnings.push(format!(
                "site table, {}: {} of {all} sites have no repaired spectrum: the column `no_repair` says why",
                export.measure.label(),
                thousands(count)
            ));
        }
        for (export, counts) in list.exports.iter().zip(&self.counts) {
            for (&poe, counts) in study.risk.poe.iter().zip(counts) {
                for (&count, words) in counts.iter().zip(WORDS).filter(|(count, _)| **count > 0) {
                    let (label, count) = (export.measure.label(), thousands(count));
                    let risk = risk_name(poe, study.risk.years);
                    warnings.push(format!("site table, {label}, {risk}: {count} of {all} sites {words}"));
                }
            }
        }
        warnings
    }
}
