//! Displacements of uniform risk with their confidence bands, read off a result at any strength and risk.

use std::path::Path;

use clap::Args;
use rayon::prelude::*;
use serde::Serialize;
use uplift_bootstrap::{inferred_limits_over_curves, truth_limits};
use uplift_hazard::{rate_from_probability, return_period_from_probability};
use uplift_job::table::{ColumnsOf, table_text};
use uplift_job::text::nearest;
use uplift_job::typed::number;
use uplift_job::{Array, JobError};
use uplift_motion::IntensityMeasure;
use uplift_result::{MeasureSpectra, ResultFile, SITE_BANDS};
use uplift_risk::StrengthPlace;
use uplift_structure::{Capacity, Demand, Rule};
use uplift_study::Oscillator;

use crate::consistency::{Question, Reweighing};
use crate::error::UniformRiskError;
use crate::precision::SHOWN_STRENGTHS;
use crate::quoted::{BandOf, QuotedUnits};
use crate::stored_stripes::{StoredMeasure, poe_index, stored_measure};
use crate::target_risks::TargetRisks;

pub use uplift_bootstrap::QUOTED_CONFIDENCE as CONFIDENCE;

/// The names of the limits of that band, m, in tables and exports.
pub const QUOTED_LIMITS: [&str; 2] = [SITE_BANDS.quantities[0].name, SITE_BANDS.quantities[1].name];
/// What displacements are asked for.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct DisplacementOptions {
    /// Uplift strengths; the nearest of the result to 0.1, 0.2 and 0.4 where none are given.
    #[arg(skip)]
    pub strengths: Vec<f64>,
    /// Risks; the smallest probability of the study where none are given.
    #[command(flatten)]
    pub risk: TargetRisks,
    /// Whether all probabilities of the study are read where no risks are given.
    #[arg(skip)]
    pub every_probability: bool,
    /// Whether bands over the weighted hazard curves of a site are left out, which take as long as all curves do.
    #[arg(skip)]
    pub without_hazard: bool,
    /// Sites [default: all]
    #[arg(long = "site", value_name = "SITE[,…]", value_delimiter = ',')]
    pub sites: Vec<String>,
    /// Intensity measure that records are scaled by [default: pgv]
    #[arg(long, alias = "im", value_name = "pgv|pga|sa_1s|...")]
    pub measure: Option<IntensityMeasure>,
    /// Displacement capacity, m: stiffness is negative after uplift (equal energy)
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub capacity_m: Option<f64>,
    /// Read the spectra repaired for hazard consistency
    #[arg(long)]
    pub repaired: bool,
}

/// A displacement of uniform risk.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Displacement {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`: what the records are scaled by.
    pub im: &'static str,
    /// Uplift strength.
    pub strength: f64,
    /// Probability of exceedance.
    pub poe: f64,
    /// Years that it refers to.
    pub years: f64,
    /// Return period, years (Eq. 4.8).
    pub return_period_years: f64,
    /// The displacement, m; infinite where overturning is more frequent than the return period allows.
    pub u_m: f64,
    /// Limits of its 90 % confidence band, m: where it lies for all records like those at hand. None of a single
    /// record.
    pub band_m: Option<[f64; 2]>,
    /// The same where it is not known either which of the site's weighted hazard curves holds, m. None of a site with
    /// one curve, and of repaired spectra.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub band_with_hazard_m: Option<[f64; 2]>,
}

/// Displacements of a result, by site, then risk, then strength.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DisplacementReport {
    /// Where the records come from, in a line.
    pub record_set: String,
    /// Number of records.
    pub records: usize,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// What they are scaled by.
    #[serde(skip)]
    pub measure: IntensityMeasure,
    /// Whether they are weighted for hazard consistency.
    pub repaired: bool,
    /// Whether the spread over weighted hazard curves is left out at a site that has some.
    #[serde(skip)]
    pub without_curves: bool,
    /// What the bands take for independent.
    pub band_of: BandOf,
    /// What was shaken, but for its strength.
    pub oscillator: Oscillator,
    /// Oscillators that each recorded motion shakes: 1, or as many as `[uncertainty]` draws about `oscillator`.
    /// `records` counts each of them.
    pub structures: usize,
    /// The displacement capacity asked for, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capacity_m: Option<f64>,
    /// The displacements; of a structure with a capacity by the rule of equal energy (Eq. 3.11).
    pub displacements: Vec<Displacement>,
}

/// Reads displacements off the result `file`, which is at the risks asked for
/// ([`at_target_risks`](crate::at_target_risks)), linear between its strengths.
///
/// The band is that of [`truth_limits`] over [`QuotedUnits`], the same as `truth` in `/bootstrap`.
///
/// # Errors
/// A file that is damaged, of another kind, or without sites; strengths, risks, sites or a measure that it does not
/// have.
pub fn displacements(file: &ResultFile, asked: &DisplacementOptions) -> Result<DisplacementReport, UniformRiskError> {
    let is_rarest_alone = asked.risk.has_targets_of_study() && !asked.every_probability;
    let (axes, study, spectra, head) = (file.axes_with_sites()?, file.stored_study()?, file.spectra()?, file.head()?);
    let poes = if is_rarest_alone { vec![poe_index(&spectra.poes, None)?] } else { (0..spectra.poes.len()).collect() };
    let places = strengths(&asked.strengths, &spectra.strengths)?;
    let sites = sites(&asked.sites, &spectra.sites)?;
    let measures = file.measures();
    let measure = measures[measure_index(&measures, asked.measure)?];
    let targets_per_year = (poes.iter())
        .map(|&poe| rate_from_probability(spectra.poes[poe], spectra.years))
        .collect::<Result<Vec<_>, _>>()?;
    let u_m = ordinates(file, spectra.measures, measure, asked.repaired)?;
    let rule = capacity_rule(asked.capacity_m, study.oscillator.uplift_displacement_m)?;

    let mut looked_at: Vec<usize> = places.iter().flat_map(|place| [place.left, place.right]).collect();
    looked_at.sort_unstable();
    looked_at.dedup();
    let stripes = stored_measure(file, &axes, &[], measure, study.risk.extrapolate)?;
    let units = QuotedUnits::read(file, measure, &Question::from_result(file)?);
    let reweighing = if asked.repaired { Reweighing::from_result(file)? } else { None };
    let question = BandsAsked {
        stripes: &stripes,
        units: &units.records,
        reweighing: reweighing.as_ref(),
        targets_per_year: &targets_per_year,
        without_hazard: asked.without_hazard,
    };
    let of_strength = |&strength: &usize| question.bands(strength, &sites);
    // [strength][site][poe][by one curve, by the weighted ones]
    let bands_m = looked_at.par_iter().map(of_strength).collect::<Result<Vec<_>, _>>()?;
    let row = |strength: usize| looked_at.partition_point(|&own| own < strength);

    let mut displacements = Vec::new();
    for (of_site, &site) in sites.iter().enumerate() {
        for (of_poe, &poe) in poes.iter().enumerate() {
            for place in &places {
                let [left_m, right_m] = [place.left, place.right].map(|strength| u_m[[site, poe, strength]]);
                let [left_limits_m, right_limits_m] =
                    [place.left, place.right].map(|at| bands_m[row(at)][of_site][of_poe]);
                let [band_m, band_with_hazard_m] = [0, 1].map(|kind| {
                    let (left_m, right_m) = (left_limits_m[kind], right_limits_m[kind]);
                    let band_m = [0, 1].map(|limit| rule(place.between(left_m[limit], right_m[limit])));
                    // a single record has none
                    Some(band_m).filter(|[_, upper_m]| !upper_m.is_nan())
                });
                displacements.push(Displacement {
                    site: spectra.sites[site].clone(),
                    im: measure.label(),
                    strength: place.strength,
                    poe: spectra.poes[poe],
                    years: spectra.years,
                    return_period_years: return_period_from_probability(spectra.poes[poe], spectra.years)?,
                    u_m: rule(place.between(left_m, right_m)),
                    band_m,
                    band_with_hazard_m,
                });
            }
        }
    }
    Ok(DisplacementReport {
        record_set: head.record_set,
        records: axes.records.len(),
        synthetic: head.synthetic,
        measure,
        repaired: asked.repaired,
        without_curves: asked.repaired && sites.iter().any(|&site| study.sites[site].has_weighted_curves(measure)),
        band_of: units.of,
        structures: study.structures_of_a_motion(),
        oscillator: study.oscillator,
        capacity_m: asked.capacity_m,
        displacements,
    })
}

impl DisplacementReport {
    /// The displacements as a table of comma-separated values, with all their digits.
    ///
    /// # Errors
    /// None for a report that was read.
    pub fn csv(&self) -> Result<Vec<u8>, JobError> {
        let limit = |band_m: Option<[f64; 2]>, at: usize| band_m.map_or(f64::NAN, |limits_m| limits_m[at]);
        let mut columns = ColumnsOf::new(&self.displacements)
            .with("site", |own| own.site.as_str())
            .with("im", |own| own.im)
            .with("strength", |own| own.strength)
            .with("poe", |own| own.poe)
            .with("years", |own| own.years)
            .with("return_period_years", |own| own.return_period_years)
            .with("u_m", |own| own.u_m)
            .with(QUOTED_LIMITS[0], |own| limit(own.band_m, 0))
            .with(QUOTED_LIMITS[1], |own| limit(own.band_m, 1));
        if self.displacements.iter().any(|own| own.band_with_hazard_m.is_some()) {
            columns = columns
                .with("lower_with_hazard_m", |own| limit(own.band_with_hazard_m, 0))
                .with("upper_with_hazard_m", |own| limit(own.band_with_hazard_m, 1));
        }
        table_text(Path::new("standard output"), "", columns.build())
    }
}

/// What bands are asked for.
struct BandsAsked<'a> {
    stripes: &'a StoredMeasure,
    /// The records of each pair or earthquake.
    units: &'a [Vec<usize>],
    /// What has the weights of repaired spectra; none of plain ones.
    reweighing: Option<&'a Reweighing>,
    targets_per_year: &'a [f64],
    /// Whether those over the weighted hazard curves are left out.
    without_hazard: bool,
}

impl BandsAsked<'_> {
    /// Limits at a strength of the result, by the mean hazard curve and over the weighted ones,
    /// `[site][target][kind]`, m; NaN of a single record, of a site without repair where repaired spectra are asked
    /// for, and over the weighted curves where these are left out, where there are none, and of repaired spectra.
    fn bands(&self, strength: usize, sites: &[usize]) -> Result<Vec<Vec<[[f64; 2]; 2]>>, UniformRiskError> {
        let Self { stripes, units, reweighing, targets_per_year, without_hazard } = *self;
        let demand = stripes.demand(strength)?;
        let of_site = |&site: &usize| {
            let limits_m = match reweighing.map(|own| own.weights(stripes.measure, site)) {
                None => truth_limits(&demand, &stripes.weights[site], units, targets_per_year, CONFIDENCE)?,
                Some(Some(weights)) => truth_limits(&demand, weights, units, targets_per_year, CONFIDENCE)?,
                Some(None) => vec![[f64::NAN; 2]; targets_per_year.len()],
            };
            let curves = if reweighing.is_some() || without_hazard { &[] } else { &stripes.branches[site][..] };
            let over_curves = |&target: &f64| inferred_limits_over_curves(&demand, curves, units, (target, CONFIDENCE));
            let over_curves_m = targets_per_year.iter().map(over_curves).collect::<Result<Vec<_>, _>>()?;
            Ok(limits_m.into_iter().zip(over_curves_m).map(<[_; 2]>::from).collect())
        };
        sites.iter().map(of_site).collect()
    }
}

/// The spectra by `measure`, `[site, poe, strength]`, m: the plain or the repaired ones.
fn ordinates(
    file: &ResultFile,
    plain: Vec<MeasureSpectra>,
    measure: IntensityMeasure,
    repaired: bool,
) -> Result<Array<3>, UniformRiskError> {
    let found = if repaired {
        file.consistency()?.into_iter().find(|own| own.scaled_to == measure).and_then(|own| own.u_m)
    } else {
        plain.into_iter().find(|own| own.measure == measure).map(|own| own.u_m)
    };
    Ok(found.ok_or_else(|| {
        JobError::Usage(format!(
            "--repaired: the result has no repaired spectra by {}; add them: uplift consistency {} --repair",
            measure.label(),
            file.path().display()
        ))
    })?)
}

fn strengths(asked: &[f64], known: &[f64]) -> Result<Vec<StrengthPlace>, JobError> {
    if asked.is_empty() {
        let shown = nearest(known, &SHOWN_STRENGTHS).into_iter();
        return Ok(shown.filter_map(|index| StrengthPlace::among(known, known[index])).collect());
    }
    let [first, last] = [known.first(), known.last()].map(|value| value.copied().unwrap_or(f64::NAN));
    let place = |&strength: &f64| {
        StrengthPlace::among(known, strength).ok_or_else(|| {
            let remedy = if strength < 0.0 {
                "; a strength is not negative"
            } else {
                "; widen strengths.values and run the study again"
            };
            JobError::Usage(format!("--strength {strength}: the result has strengths from {first} to {last}{remedy}"))
        })
    };
    each_once(asked.iter().map(place), |own| format!("--strength {}", own.strength))
}

/// Positions of the sites `asked` for.
fn sites(asked: &[String], known: &[String]) -> Result<Vec<usize>, JobError> {
    if asked.is_empty() {
        return Ok((0..known.len()).collect());
    }
    each_once(asked.iter().map(|name| site_index("--site", known, name)), |&site| format!("--site {}", known[site]))
}

/// The position of the site called `wanted` by an `option`; in letters of either case where none is spelt so.
///
/// # Errors
/// A site that is not among those `known`.
pub fn site_index(option: &'static str, known: &[String], wanted: &str) -> Result<usize, JobError> {
    let spelt_so = known.iter().position(|site| site == wanted);
    let found = spelt_so.or_else(|| known.iter().position(|site| site.to_lowercase() == wanted.to_lowercase()));
    found.ok_or_else(|| JobError::Choice {
        option,
        noun: "site",
        wanted: Some(wanted.to_owned()),
        known: known.to_vec(),
    })
}

/// What was asked for, unless one of it is given twice.
fn each_once<T: PartialEq>(
    asked: impl Iterator<Item = Result<T, JobError>>,
    name: impl Fn(&T) -> String,
) -> Result<Vec<T>, JobError> {
    let mut all = Vec::new();
    for one in asked {
        let one = one?;
        if all.contains(&one) {
            return Err(JobError::Usage(format!("{} is given twice", name(&one))));
        }
        all.push(one);
    }
    Ok(all)
}

/// The position of the uplift strength `wanted`.
///
/// # Errors
/// A strength that is not among those `known`.
pub fn strength_index(known: &[f64], wanted: f64) -> Result<usize, JobError> {
    let found = known.iter().position(|own| (own - wanted).abs() <= 1e-9 * own.abs());
    found.ok_or_else(|| JobError::Choice {
        option: "--strength",
        noun: "strength",
        wanted: Some(wanted.to_string()),
        known: known.iter().map(ToString::to_string).collect(),
    })
}

/// The position of the measure `wanted`; of the first where none is, which is PGV if the result has it.
///
/// # Errors
/// A measure that is not among those `known`.
pub fn measure_index(known: &[IntensityMeasure], wanted: Option<IntensityMeasure>) -> Result<usize, JobError> {
    let found = known.iter().position(|own| wanted.is_none_or(|wanted| *own == wanted));
    found.ok_or_else(|| JobError::Choice {
        option: "--measure",
        noun: "measure",
        wanted: wanted.map(|measure| measure.key().to_owned()),
        known: known.iter().map(|own| own.key().to_owned()).collect(),
    })
}

/// From the displacement of an oscillator without stiffness after uplift to that of one with a capacity (Eq. 3.11).
fn capacity_rule(capacity_m: Option<f64>, uplift_displacement_m: f64) -> Result<impl Fn(f64) -> f64, JobError> {
    let usage = |error| JobError::Usage(format!("--capacity-m: {error}"));
    let capacity =
        capacity_m.map(|capacity_m| Capacity::new(uplift_displacement_m, capacity_m)).transpose().map_err(usage)?;
    Ok(move |zero_m: f64| match &capacity {
        // not a number: no repaired spectrum, or no band; infinite: it overturns
        Some(capacity) if zero_m.is_finite() => {
            Rule::EqualEnergy.demand(capacity, zero_m).map_or(f64::NAN, Demand::displacement_m)
        }
        _ => zero_m,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strength_is_read_between_its_neighbours_only() {
        let read = |strength: f64| {
            let u_m = [1.0, 0.5, f64::INFINITY];
            let place = StrengthPlace::among(&[0.1, 0.2, 0.4], strength)?;
            Some(place.between(u_m[place.left], u_m[place.right]))
        };
        assert_eq!([read(0.1), read(0.2), read(0.125)], [Some(1.0), Some(0.5), Some(0.875)]);
        assert_eq!([read(0.3), read(0.4)], [Some(f64::INFINITY); 2]);
        assert_eq!([read(0.09), read(0.5)], [None; 2]);
        assert!(strengths(&[0.5], &[0.1, 0.2]).unwrap_err().to_string().contains("from 0.1 to 0.2"));
    }

    #[test]
    fn equal_energy_raises_a_displacement_and_ends_in_overturning() {
        let rule = capacity_rule(Some(1.6), 0.0005).unwrap();
        // Table 3.5, near-field pulse-like, 1.0 PGA
        assert!((rule(0.472) - 0.576).abs() < 0.001);
        assert_eq!(rule(1.0), f64::INFINITY);
        assert!(rule(f64::NAN).is_nan());
        assert_eq!(capacity_rule(None, 0.0005).unwrap()(0.472), 0.472);
        assert!(capacity_rule(Some(0.0001), 0.0005).is_err_and(|error| error.to_string().contains("--capacity-m")));
    }
}
