//! The report on consistency: rows, sentences and warnings.

use std::path::PathBuf;

use serde::Serialize;
use uplift_consistency::{Agreement, Diagnosis, Miss, Nearest, NoRepair, TwoSided, Verdict, Words};
use uplift_job::Array;
use uplift_job::text::per_cent;
use uplift_motion::IntensityMeasure;
use uplift_result::StoredConsistency;

use super::{Finding, Question, Repairs};

/// Displacements that agreement is looked at from, m: below it rocking has only just begun.
const AGREEMENT_FROM_M: f64 = 0.01;

/// The report on the consistency of a study or of its result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ConsistencyReport {
    /// One row for each measure that records are scaled to, and site.
    pub rows: Vec<ConsistencyRow>,
    /// Both analyses of a site taken apart.
    pub two_sided: Vec<TwoSidedRow>,
    /// Spectra by PGA over those by PGV, before and after the repair; none where there are not both.
    pub agreement: Vec<AgreementRow>,
    /// What the site's hazard is made of beside what the set has, where disaggregations were given.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub earthquakes: Vec<EarthquakeRow>,
    /// What deserves a look, and why a set could not be repaired.
    pub warnings: Vec<String>,
    /// Why nothing could be asked; empty where it could.
    pub note: String,
    /// Sites that nothing is said of, since they have no curves of two measures.
    pub unasked: Vec<String>,
    /// Records of the set.
    pub records: usize,
    /// Whether the records are synthetic.
    pub synthetic: bool,
    /// Earthquakes of the set, where they are known.
    pub events: Option<usize>,
    /// Years that probabilities refer to.
    pub years: f64,
    /// Scale factors outside these are counted.
    pub scale_factors: [f64; 2],
    /// The result file, which holds all of it now; none where it was only looked at.
    #[serde(skip)]
    pub result: Option<PathBuf>,
    /// The table beside it.
    #[serde(skip)]
    pub table: Option<PathBuf>,
}

/// The records scaled to one measure, at one site.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ConsistencyRow {
    /// The site.
    pub site: String,
    /// The measure that records are scaled to, `PGV` or `PGA`.
    pub scaled_to: &'static str,
    /// The measure whose hazard is compared.
    pub shows: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The largest and the smallest annual rate at which it is compared, 1/yr.
    pub range_per_year: [f64; 2],
    /// How many times the site's level the records bring, mean of the range; none where the range is too narrow.
    pub bias: Option<f64>,
    /// Root mean square of ln(implied/site).
    pub rms: Option<f64>,
    /// Largest |ln(implied/site)|.
    pub max: Option<f64>,
    /// `consistent`, `off`, `inconsistent`; none where the range is too narrow.
    pub verdict: Option<&'static str>,
    /// At each probability.
    pub targets: Vec<TargetRow>,
    /// The repair, where one was asked for.
    pub repair: Option<RepairRow>,
}

/// What the records bring at one probability.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetRow {
    /// Probability of exceedance.
    pub poe: f64,
    /// The site's level of the other measure; none where its curve does not reach.
    pub site_level: Option<f64>,
    /// The level that the records bring.
    pub implied_level: f64,
    /// That over the site's.
    pub ratio: Option<f64>,
    /// So many times as often as it should is the site's level reached.
    pub times_as_often: Option<f64>,
    /// 5, 50 and 95 % of the factors by which records are multiplied.
    pub scale_factors: [f64; 3],
    /// Share of the factors outside the study's `consistency.scale_factors`.
    pub outside_limits: f64,
    /// Share of the factors outside 1/10 to 10.
    pub outside_tenfold: f64,
    /// Effective records at the level of the probability.
    pub effective_records: f64,
    /// Effective earthquakes there; none where they are not known.
    pub effective_events: Option<f64>,
    /// Standard deviation of ln(other measure/measure scaled to) there.
    pub sd_ln_ratio: f64,
    /// Median magnitude.
    pub magnitude: Option<f64>,
    /// Median distance, km.
    pub distance_km: Option<f64>,
    /// Median Vs30, m/s.
    pub vs30_m_s: Option<f64>,
}

/// The repair of one row.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RepairRow {
    /// Why there is none; none where there is one.
    pub failed: Option<String>,
    /// Where that is so: the reachable hazard that is nearest to the site's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<NearestRow>,
    /// Exponents b₁ … b₄ of the weights at the knots.
    pub exponents: Option<[f64; 4]>,
    /// Largest |ln(implied/site)| after it.
    pub max: Option<f64>,
    /// Bias after it.
    pub bias: Option<f64>,
    /// Fewest effective records at a stripe in the range.
    pub least_effective: Option<f64>,
    /// Of how many records of that stripe.
    pub least_effective_of: Option<usize>,
    /// Steps of the fit.
    pub iterations: Option<u32>,
    /// At each probability, with the weights.
    pub targets: Vec<TargetRow>,
}

/// Where the nearest reachable hazard of the other measure misses the site's most, on each side.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NearestRow {
    /// Where it is exceeded too often; none where nowhere.
    pub too_often: Option<MissRow>,
    /// Where it is exceeded too rarely.
    pub too_rarely: Option<MissRow>,
    /// The worse of both sides in words.
    #[serde(skip)]
    pub worst: String,
}

/// A level of the other measure that is missed: records on its other side, scaled to the level of the same rate, would
/// bring the hazard nearer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MissRow {
    /// The site's level of the other measure.
    pub level: f64,
    /// The site's rate of it, 1/yr.
    pub rate_per_year: f64,
    /// The nearest reachable rate over the site's.
    pub times_as_often: f64,
    /// The site's level of the measure scaled to at the same rate.
    pub scaled_to_level: f64,
}

/// Magnitude and distance at one probability: of the site's hazard, and medians of the records.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EarthquakeRow {
    /// The site.
    pub site: String,
    /// The measure, by which the hazard is disaggregated and records are scaled.
    pub scaled_to: &'static str,
    /// Probability of exceedance.
    pub poe: f64,
    /// Mean magnitude of the disaggregation.
    pub mean_magnitude: f64,
    /// Mean distance of the disaggregation, km.
    pub mean_distance_km: f64,
    /// Median magnitude of the records; none where it is not known.
    pub magnitude: Option<f64>,
    /// Median distance of the records, km; none where it is not known.
    pub distance_km: Option<f64>,
    /// Median magnitude of the records as they are weighed by a repair; none without one.
    pub repaired_magnitude: Option<f64>,
    /// Median distance of the records as they are weighed by a repair, km; none without one.
    pub repaired_distance_km: Option<f64>,
}

impl NearestRow {
    fn new(nearest: &Nearest, words: &Words<'_>) -> Self {
        let row = |miss: Miss| MissRow {
            level: miss.level,
            rate_per_year: miss.rate_per_year,
            times_as_often: miss.times,
            scaled_to_level: miss.scaled_to,
        };
        Self {
            too_often: nearest.too_often.map(row),
            too_rarely: nearest.too_rarely.map(row),
            worst: nearest.worst_side().sentence(words),
        }
    }
}

/// Both analyses of a site taken apart (see `TwoSided`).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TwoSidedRow {
    /// The site.
    pub site: String,
    /// Where the set lies between PGV and PGA, in the logarithm: other records can cure it.
    pub location: f64,
    /// What no single set can avoid, in the logarithm.
    pub spread: f64,
}

/// Spectra by PGA over those by PGV, where their displacements are 10 mm and more.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AgreementRow {
    /// The site; none for all sites together.
    pub site: Option<String>,
    /// Of the plain spectra: number of ordinates, geometric mean of the ratios, smallest, largest.
    pub plain: Option<(usize, f64, f64, f64)>,
    /// The same of the repaired ones.
    pub repaired: Option<(usize, f64, f64, f64)>,
}

impl ConsistencyReport {
    /// The report on `findings`; `plain_m` are the plain spectra `[site, poe, strength]` of each measure, m.
    pub(super) fn new(
        question: &Question,
        findings: &[Finding],
        plain_m: &[(IntensityMeasure, Array<3>)],
        repairs: &[Repairs],
    ) -> Self {
        let note = if findings.is_empty() { nothing_to_ask(question) } else { String::new() };
        Self {
            rows: findings.iter().map(|finding| row(question, finding)).collect(),
            two_sided: two_sided(question, findings),
            agreement: agreement(question, plain_m, repairs),
            warnings: findings
                .iter()
                .flat_map(|finding| warnings(question, finding))
                .chain(branch_warnings(question, repairs))
                .collect(),
            note,
            unasked: unasked(question, findings),
            records: question.records.len(),
            synthetic: question.synthetic,
            events: (!question.events.is_empty()).then_some(question.events.len()),
            years: question.years,
            scale_factors: question.settings.scale_factors,
            earthquakes: Vec::new(),
            result: None,
            table: None,
        }
    }
}

fn unasked(question: &Question, findings: &[Finding]) -> Vec<String> {
    let is_unasked = |(site, _): &(usize, &String)| findings.iter().all(|finding| finding.site != *site);
    question.sites.iter().enumerate().filter(is_unasked).map(|(_, name)| name.clone()).collect()
}

fn nothing_to_ask(question: &Question) -> String {
    if question.sites.is_empty() {
        "the study has no sites, so there is no hazard to compare the records with".to_owned()
    } else {
        "no site has hazard curves of two measures: give each both, pgv and pga, to compare the records with them"
            .to_owned()
    }
}

fn row(question: &Question, finding: &Finding) -> ConsistencyRow {
    let deviation = finding.diagnosis.deviation.as_ref();
    ConsistencyRow {
        site: question.sites[finding.site].clone(),
        scaled_to: finding.scaled_to.label(),
        shows: finding.other.label(),
        unit: finding.other.unit(),
        range_per_year: [finding.range.high_per_year, finding.range.low_per_year],
        bias: deviation.map(|deviation| deviation.bias),
        rms: deviation.map(|deviation| deviation.rms),
        max: deviation.map(|deviation| deviation.max),
        verdict: finding.diagnosis.verdict().map(Verdict::key),
        targets: targets(question, &finding.diagnosis),
        repair: finding.repair.as_ref().map(|repair| match repair {
            Err(reason) => RepairRow {
                failed: Some(said(question, finding, |words| reason.sentence(words))),
                nearest: said(question, finding, |words| {
                    reason.nearest().map(|nearest| NearestRow::new(nearest, words))
                }),
                exponents: None,
                max: None,
                bias: None,
                least_effective: None,
                least_effective_of: None,
                iterations: None,
                targets: Vec::new(),
            },
            Ok(repaired) => {
                let deviation = repaired.diagnosis.deviation.as_ref();
                RepairRow {
                    failed: None,
                    nearest: None,
                    exponents: Some(repaired.fit.exponents),
                    max: deviation.map(|deviation| deviation.max),
                    bias: deviation.map(|deviation| deviation.bias),
                    least_effective: repaired.diagnosis.least_effective.map(|least| least.records),
                    least_effective_of: repaired
                        .diagnosis
                        .least_effective
                        .map(|least| question.records_at(least.level)),
                    iterations: Some(repaired.fit.iterations),
                    targets: targets(question, &repaired.diagnosis),
                }
            }
        }),
    }
}

fn targets(question: &Question, diagnosis: &Diagnosis) -> Vec<TargetRow> {
    let of = |(poe, target): (&f64, &uplift_consistency::TargetDiagnosis)| {
        let stripe = &diagnosis.stripes[target.stripe];
        TargetRow {
            poe: *poe,
            site_level: target.site_level,
            implied_level: target.implied_level,
            ratio: target.ratio,
            times_as_often: target.times_as_often,
            scale_factors: target.scale_factors.percentiles,
            outside_limits: target.scale_factors.outside_limits,
            outside_tenfold: target.scale_factors.outside_tenfold,
            effective_records: stripe.effective_records,
            effective_events: stripe.effective_events,
            sd_ln_ratio: stripe.sd_ln_ratio,
            magnitude: target.medians.magnitude,
            distance_km: target.medians.distance_km,
            vs30_m_s: target.medians.vs30_m_s,
        }
    };
    question.poes.iter().zip(&diagnosis.targets).map(of).collect()
}

impl Question {
    /// Why there is no repair; none where there is one, or none was asked for.
    pub fn no_repair(&self, finding: &Finding) -> Option<String> {
        let reason = finding.repair.as_ref()?.as_ref().err()?;
        Some(said(self, finding, |words| reason.sentence(words)))
    }
}

/// What `say` makes of the words of a finding.
fn said<T>(question: &Question, finding: &Finding, say: impl Fn(&Words<'_>) -> T) -> T {
    let levels = question.analyses.iter().find(|(measure, _)| *measure == finding.scaled_to);
    let years = question.years;
    say(&Words {
        scaled_to: finding.scaled_to.label(),
        scaled_to_unit: finding.scaled_to.unit(),
        other: finding.other.label(),
        other_unit: finding.other.unit(),
        levels: levels.map_or(&[][..], |(_, levels)| levels),
        has_level_sets: question.has_level_sets(),
        record: &|record| question.records.get(record).map_or_else(String::new, |record| record.id.clone()),
        event: &|event| question.events.get(event).cloned().unwrap_or_default(),
        target: &|target| {
            question.poes.get(target).map_or_else(String::new, |&poe| format!("{} in {years} years", per_cent(poe)))
        },
    })
}

fn warnings(question: &Question, finding: &Finding) -> Vec<String> {
    let subject = format!("{} by {}", question.sites[finding.site], finding.scaled_to.label());
    let sentences: Vec<String> = match &finding.repair {
        None if finding.diagnosis.verdict().is_none() => {
            vec![said(question, finding, |words| NoRepair::NarrowRange(finding.range).sentence(words))]
        }
        None => Vec::new(),
        Some(Err(reason)) => {
            vec![format!("no repaired spectrum: {}", said(question, finding, |words| reason.sentence(words)))]
        }
        Some(Ok(repaired)) => {
            repaired.warnings.iter().map(|warning| said(question, finding, |words| warning.sentence(words))).collect()
        }
    };
    sentences.into_iter().map(|sentence| format!("{subject}: {sentence}")).collect()
}

/// What to know of repaired spectra of weighted hazard curves.
fn branch_warnings(question: &Question, repairs: &[Repairs]) -> Vec<String> {
    let mut sentences = if repairs.is_empty() { Vec::new() } else { question.branches_apart() };
    for repairs in repairs {
        for own in &repairs.branches {
            let failed: Vec<&str> = (own.names.iter().enumerate())
                .filter(|(branch, _)| own.spectra_m.block([*branch]).iter().all(|u_m| u_m.is_nan()))
                .map(|(_, name)| name.as_str())
                .collect();
            if !failed.is_empty() {
                sentences.push(format!(
                    "{} by {}: no repaired spectrum of {} of {} weighted hazard curves ({}), so none of their mean",
                    question.sites[own.site],
                    repairs.measure.label(),
                    failed.len(),
                    own.names.len(),
                    failed.join(", ")
                ));
            }
        }
    }
    sentences
}

fn two_sided(question: &Question, findings: &[Finding]) -> Vec<TwoSidedRow> {
    let of_site = |site: usize| {
        let deviation = |scaled_to, other| {
            let is_own = |own: &&Finding| own.site == site && own.scaled_to == scaled_to && own.other == other;
            findings.iter().find(is_own)?.diagnosis.deviation.as_ref()
        };
        let (pgv, pga) = (IntensityMeasure::Pgv, IntensityMeasure::Pga);
        let both = TwoSided::from_deviations(deviation(pgv, pga)?, deviation(pga, pgv)?);
        Some(TwoSidedRow { site: question.sites[site].clone(), location: both.location, spread: both.spread })
    };
    (0..question.sites.len()).filter_map(of_site).collect()
}

fn agreement(question: &Question, plain_m: &[(IntensityMeasure, Array<3>)], repairs: &[Repairs]) -> Vec<AgreementRow> {
    let plain = |measure| plain_m.iter().find(|(own, _)| *own == measure).map(|(_, spectra_m)| spectra_m);
    let (Some(pga), Some(pgv)) = (plain(IntensityMeasure::Pga), plain(IntensityMeasure::Pgv)) else {
        return Vec::new();
    };
    let repaired = |measure| repairs.iter().find(|repairs| repairs.measure == measure);
    let both = repaired(IntensityMeasure::Pga).zip(repaired(IntensityMeasure::Pgv));
    let numbers = |found: Agreement| (found.count, found.geometric_mean, found.smallest, found.largest);
    let of_sites = |sites: &[usize]| {
        let plain = sites.iter().flat_map(|&site| pairs(pga.block([site]), pgv.block([site])));
        let repaired = both.and_then(|(pga, pgv)| {
            let displacement = |ordinates: &[Option<uplift_risk::Ordinate>]| -> Vec<f64> {
                ordinates.iter().map(|ordinate| ordinate.map_or(f64::NAN, |ordinate| ordinate.displacement_m)).collect()
            };
            let of_site = |&site: &usize| {
                let [pga, pgv] = [pga, pgv].map(|own| displacement(own.ordinates.block([site])));
                pga.into_iter().zip(pgv).collect::<Vec<_>>()
            };
            Agreement::from_pairs(sites.iter().flat_map(of_site), AGREEMENT_FROM_M, f64::INFINITY)
        });
        (Agreement::from_pairs(plain, AGREEMENT_FROM_M, f64::INFINITY).map(numbers), repaired.map(numbers))
    };
    let all: Vec<usize> = (0..question.sites.len()).collect();
    let mut rows = Vec::new();
    for &site in &all {
        let (plain, repaired) = of_sites(&[site]);
        rows.push(AgreementRow { site: Some(question.sites[site].clone()), plain, repaired });
    }
    if all.len() > 1 {
        let (plain, repaired) = of_sites(&all);
        rows.push(AgreementRow { site: None, plain, repaired });
    }
    rows
}

fn pairs<'a>(first_m: &'a [f64], second_m: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
    first_m.iter().copied().zip(second_m.iter().copied())
}

/// What the records have of the other measure where they miss the site's hazard of it, `2.5 times the site's PGV`; none
/// where they have it.
pub fn missed_in_words(consistency: &StoredConsistency, site: usize) -> Option<String> {
    let is_missed = consistency.verdict[site] == Verdict::Inconsistent.key();
    let times = || times_in_words(consistency, site, consistency.bias[site]);
    is_missed.then(|| format!("{} times the site's {}", times(), consistency.other.label()))
}

/// How many times the site's level scaled records have: `times` where that alone is inconsistent, `1.6`; else what they
/// have at the rates compared, `0.5 to 2.1`.
pub fn times_in_words(consistency: &StoredConsistency, site: usize, times: f64) -> String {
    if Verdict::from_bias(times, times.ln().abs()) == Verdict::Inconsistent {
        return format!("{times:.1}");
    }
    let [implied, own] = [&consistency.implied_level, &consistency.site_level].map(|level| level.block([site]));
    let ratios = implied.iter().zip(own).map(|(implied, own)| implied / own).filter(|ratio| ratio.is_finite());
    let (least, most) = ratios.fold((times, times), |(least, most), ratio| (least.min(ratio), most.max(ratio)));
    format!("{least:.1} to {most:.1}")
}
