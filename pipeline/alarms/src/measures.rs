//! Spectra of one site and probability by PGV and by PGA that disagree, and not because one of the curves is wrong: the
//! demand is one, and two numbers for it are one too many.

use std::collections::BTreeMap;

use uplift_job::Array;
use uplift_job::alarm::{Alarm, Case, RESULT, Severity};
use uplift_job::text::{per_cent, rounded, short, two_digits};
use uplift_motion::IntensityMeasure;
use uplift_result::{MeasureSpectra, StoredBands};
use uplift_risk::{COMPARED_FROM_M, MEASURES_APART, MEASURES_APART_DECISIVE};

use super::evidence::{Evidence, Scope};
use super::{consistency, curves};

/// The spectrum of one measure, with its band.
#[derive(Debug, Clone, Copy)]
struct Side<'a> {
    u_m: &'a [f64],
    /// Lower and upper limits.
    band_m: Option<[&'a [f64]; 2]>,
}

/// Where two spectra are furthest apart.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Gap {
    strength: usize,
    /// The second over the first.
    ratio: f64,
    /// Whether their bands do not meet; none without bands.
    outside: Option<bool>,
}

/// The largest gap between two spectra, of those that their bands do not hold or, without bands, beyond the limit; and
/// of those that no band excuses, since wide ones meet anywhere.
fn largest_gap(one: Side<'_>, other: Side<'_>, at: &[usize]) -> Option<Gap> {
    let gap = |&strength: &usize| -> Option<Gap> {
        let (a, b) = (one.u_m[strength], other.u_m[strength]);
        // where neither is more than a few millimetres they say nothing of rocking
        let compared = a.is_finite() && b.is_finite() && a > 0.0 && b > 0.0 && a.max(b) > COMPARED_FROM_M;
        let ratio = b / a;
        let times = ratio.max(1.0 / ratio);
        let outside = one.band_m.zip(other.band_m).map(|([low_a, high_a], [low_b, high_b])| {
            low_a[strength] > high_b[strength] || low_b[strength] > high_a[strength]
        });
        let apart = outside.unwrap_or(times > MEASURES_APART) || times > MEASURES_APART_DECISIVE;
        (compared && apart).then_some(Gap { strength, ratio, outside })
    };
    at.iter().filter_map(gap).max_by(|a, b| a.ratio.ln().abs().total_cmp(&b.ratio.ln().abs()))
}

/// One for every remedy.
pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Vec<Alarm> {
    let spectra = &evidence.spectra;
    let of = |measure| spectra.measures.iter().find(|spectra| spectra.measure == measure);
    let (Some(pgv), Some(pga)) = (of(IntensityMeasure::Pgv), of(IntensityMeasure::Pga)) else { return Vec::new() };
    let strengths: Vec<usize> = (0..spectra.strengths.len())
        .filter(|&strength| scope.holds_strength(spectra.strengths[strength]) && spectra.strengths[strength] > 0.0)
        .collect();
    let mut cases: BTreeMap<String, Vec<Case>> = BTreeMap::new();
    // both measures are looked at, whichever is asked about
    for (site, name) in spectra.sites.iter().enumerate() {
        for poe in 0..spectra.poes.len() {
            let is_asked = scope.site.is_none_or(|wanted| wanted == site) && scope.holds_poe(poe);
            if !is_asked || curves::are_apart(evidence, site) {
                continue;
            }
            let bands = evidence.bands.as_ref().zip(evidence.poes_of_bands[poe]);
            let side = |of_measure| side(of_measure, bands, [site, poe]);
            let (one, other) = (side(pgv), side(pga));
            let Some(gap) = largest_gap(one, other, &strengths) else { continue };
            let subject = format!("{name}, {}", evidence.risk(poe));
            let case = case((evidence, scope), (site, subject), gap);
            cases.entry(case.what_to_do.clone()).or_default().push(case);
        }
    }
    cases.into_values().filter_map(|cases| Alarm::from_cases("measures-disagree", cases)).collect()
}

fn case((evidence, scope): (&Evidence, &Scope), (site, subject): (usize, String), gap: Gap) -> Case {
    let times = gap.ratio.max(1.0 / gap.ratio);
    let [larger, smaller] = if gap.ratio > 1.0 { ["PGA", "PGV"] } else { ["PGV", "PGA"] };
    let allowed = match (&evidence.bands, gap.outside) {
        (Some(bands), Some(true)) => format!(", outside both {} bands", per_cent(bands.confidence)),
        (Some(bands), Some(false)) => format!(", though their wide {} bands overlap", per_cent(bands.confidence)),
        _ => String::new(),
    };
    // of a result that has the spectra to use a note is enough; a design is about to use others
    let is_repaired = !scope.for_design && evidence.consistency.iter().any(|of| of.is_repaired(site));
    Case {
        severity: if times > MEASURES_APART_DECISIVE && !is_repaired { Severity::Caution } else { Severity::Note },
        badness: times,
        subject,
        what: format!(
            "the {larger} spectrum is {} times {smaller}'s at strength {}{allowed}",
            if times < 1e6 { two_digits(times) } else { short(times) },
            rounded(evidence.spectra.strengths[gap.strength], 4)
        ),
        what_to_do: consistency::remedy_of_gap(evidence, scope, site)
            .unwrap_or_else(|| format!("Choose between them: uplift measures {RESULT}")),
    }
}

/// The spectrum of a site and probability with its band for all records, of a probability by its position there.
fn side<'a>(spectra: &'a MeasureSpectra, bands: Option<(&'a StoredBands, usize)>, [site, poe]: [usize; 2]) -> Side<'a> {
    let band = || {
        let (bands, poe) = bands?;
        let size = (0..bands.sizes.len()).max_by_key(|&size| bands.sizes[size])?;
        let of_measure = bands.by_measure(spectra.measure)?;
        let [lower, _, upper] = &of_measure.plain.limits_m;
        // what all records there could be have; in results made before it was known, what resamples have
        let [lower, upper] =
            of_measure.inferred.as_ref().map_or([lower, upper], |own| [&own.truth_m[0], &own.truth_m[1]]);
        let of = |limit: &'a Array<4>| limit.block([site, poe, size]);
        Some([of(lower), of(upper)])
    };
    Side { u_m: spectra.u_m.block([site, poe]), band_m: band() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: [usize; 4] = [0, 1, 2, 3];

    #[test]
    fn without_bands_a_ratio_of_more_than_two_counts_and_millimetres_do_not() {
        let side = |u_m| Side { u_m, band_m: None };
        // 2.5 times in millimetres; 1.9 times; a quarter; censored
        let (one, other) = ([0.001, 0.1, 0.2, 0.1], [0.0025, 0.19, 0.05, f64::INFINITY]);
        let gap = largest_gap(side(&one), side(&other), &AT);
        assert_eq!(gap, Some(Gap { strength: 2, ratio: 0.25, outside: None }));
        assert_eq!(largest_gap(side(&one), side(&other), &AT[..2]), None);
    }

    #[test]
    fn with_bands_what_they_do_not_hold_counts_and_what_none_excuses() {
        let (one, other) = ([0.1, 0.1, 0.1, 0.1], [0.29, 0.13, 0.1, 0.31]);
        let (low, high) = ([0.08, 0.09, 0.08, 0.08], [0.12, 0.11, 0.12, 0.12]);
        let (other_low, other_high) = ([0.11, 0.12, 0.05, 0.1], [0.9, 0.14, 0.2, 0.9]);
        let one = Side { u_m: &one, band_m: Some([&low, &high]) };
        let other = Side { u_m: &other, band_m: Some([&other_low, &other_high]) };
        // 2.9 times, but the bands meet; 1.3 times, and they do not; 3.1 times is too much for any band
        let gap = |at: &[usize]| largest_gap(one, other, at).map(|gap| (gap.strength, gap.outside));
        assert_eq!(gap(&AT[..3]), Some((1, Some(true))));
        assert_eq!(gap(&AT), Some((3, Some(false))));
    }
}
