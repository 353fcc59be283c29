//! What a result knows of the consistency of its records with the hazard.

use std::collections::BTreeSet;

use uplift_consistency::{DEVIATION_RATES, Diagnosis, KNOTS, Repaired};
use uplift_job::Array;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::IntensityMeasure;
use uplift_risk::Ordinate;

use super::declared::{Group, Quantity, group, measure_names};
use super::layout::attribute::sign;
use super::layout::axis::{self, KNOT, POE, RATE, RECORD, SITE, STRENGTH, STRIPE_LEVEL};
use super::spectra::{Fit, Fits, regression};
use super::spread::BranchSpectra;
use super::stored_result::StoredResult;
use crate::error::ResultError;

/// The consistency of the records scaled to one measure; NaN at sites that were not looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredConsistency {
    /// The measure that records are scaled to.
    pub scaled_to: IntensityMeasure,
    /// The measure whose hazard is compared.
    pub other: IntensityMeasure,
    /// Rates at which it is, 1/yr, `[site, rate]`.
    pub rate_per_year: Array<2>,
    /// Levels of the site's own curve `[site, rate]`.
    pub site_level: Array<2>,
    /// Levels that the records bring `[site, rate]`.
    pub implied_level: Array<2>,
    /// Levels that weighted records bring `[site, rate]`; none before a repair.
    pub repaired_level: Option<Array<2>>,
    /// How many times the site's level the records bring, mean of the range `[site]`.
    pub bias: Vec<f64>,
    /// Largest |ln(implied/site)| `[site]`.
    pub max: Vec<f64>,
    /// `consistent`, `off`, `inconsistent`, or empty `[site]`.
    pub verdict: Vec<String>,
    /// Probabilities that ratios and repaired spectra are of.
    pub poes: Vec<f64>,
    /// Years that they refer to.
    pub years: f64,
    /// Level that the records bring over the site's `[site, poe]`.
    pub ratio: Array<2>,
    /// Effective records under the weights `[site, level]`; none before a repair.
    pub effective_records: Option<Array<2>>,
    /// Displacements of weighted records `[site, poe, strength]`, m; NaN where there is no repair. None before one.
    pub u_m: Option<Array<3>>,
    /// Coefficients of these spectra `[site, poe]`; NaN where there is no fit. None before a repair.
    pub fits: Option<Fits>,
}

/// All that a result holds of the consistency of its records, as it is written.
#[derive(Debug)]
pub struct ConsistencyGroup<'a> {
    /// Smoothness of the weights.
    pub smoothness: f64,
    /// Names of the sites.
    pub sites: &'a [String],
    /// Number of records.
    pub records: usize,
    /// Whether the weights of all runs are kept, which follow from the exponents.
    pub keeps_weights: bool,
    /// A measure each; none where no site has curves of two measures.
    pub measures: Vec<MeasureConsistency<'a>>,
}

/// What is written of the records scaled to one measure.
#[derive(Debug)]
pub struct MeasureConsistency<'a> {
    /// What is read again.
    pub stored: StoredConsistency,
    /// What records that count alike bring `[site]`.
    pub diagnoses: Vec<Option<&'a Diagnosis>>,
    /// The repairs `[site]`.
    pub repaired: Vec<Option<&'a Repaired>>,
    /// Ordinates of weighted records `[site, poe, strength]`; none before a repair.
    pub ordinates: Option<&'a Array<3, Option<Ordinate>>>,
    /// Positions of the sites with weighted hazard curves, and their spectra where each curve is repaired by itself.
    pub branches: Vec<(usize, Option<&'a BranchSpectra>)>,
}

group! {
    /// The hazard of the `<other>` measure: the site's own, and what the records bring.
    pub const CONSISTENCY: StoredConsistency = "/consistency/<im>";
    "rate_per_year" [SITE, RATE] F64 "1/yr" "annual rate of exceedance"
        ("rates at which the hazard of the other measure is compared ([method](method.md#18-hazard-consistency)); NaN \
          at sites without its curve, here and below") = |of, at| of.rate_per_year[at];
    "<other>_site" [SITE, RATE] F64 "<other_unit>" "level of the site's own hazard curve, <label>"
        ("level of the site's own hazard curve of the other measure, here PGA") = |of, at| of.site_level[at];
    "<other>_implied" [SITE, RATE] F64 "<other_unit>" "level of the records, <label>"
        = |of, at| of.implied_level[at];
    "<other>_bias" [SITE] F64 "1" "level of the records over the site's, mean of the range"
        ("exp of the mean of ln(implied/site)") as "bias" = |of, at| of.bias[at];
    "<other>_max" [SITE] F64 "1" "largest absolute ln(implied/site)" as "max" "largest |ln|" = |of, at| of.max[at];
    "<other>_verdict" [SITE] Text "" "consistent, off or inconsistent; empty where unknown"
        ("`consistent`, `off`, `inconsistent`; empty where undecided") = |of, at| of.verdict[at];
    "<other>_ratio" [SITE, POE] F64 "1" "level of the records over the site's" = |of, at| of.ratio[at];
}

group! {
    /// What else was found of the records at each site.
    pub const DIAGNOSES: Diagnosis = CONSISTENCY.path;
    "<other>_rms" [SITE] Made "1" "root mean square of ln(implied/site)"
        = |of, _at| of.deviation.as_ref().map_or(f64::NAN, |deviation| deviation.rms);
    "<other>_times_as_often" [SITE, POE] Made "1" "rate at which the records reach the site's level, over its target"
        = |of, at| of.targets[at].times_as_often.unwrap_or(f64::NAN);
    "scale_factor_05" [SITE, POE] Made "1" "5 % of the scale factors"
        ("5 % of the factors that records are multiplied by at the level of the probability")
        = |of, at| of.targets[at].scale_factors.percentiles[0];
    "scale_factor_50" [SITE, POE] Made "1" "median of the scale factors"
        = |of, at| of.targets[at].scale_factors.percentiles[1];
    "scale_factor_95" [SITE, POE] Made "1" "95 % of the scale factors"
        = |of, at| of.targets[at].scale_factors.percentiles[2];
    "scale_factors_outside" [SITE, POE] Made "1" "share of the scale factors outside consistency.scale_factors"
        ("share of them outside `consistency.scale_factors`") = |of, at| of.targets[at].scale_factors.outside_limits;
    "effective_events" [SITE, POE] Made "1" "effective earthquakes"
        ("effective earthquakes there; NaN where unknown")
        = |of, at| of.stripes[of.targets[at].stripe].effective_events.unwrap_or(f64::NAN);
}

group! {
    /// Levels that the weighted records of each site bring.
    pub const REPAIRED_LEVELS: Repaired = CONSISTENCY.path;
    "<other>_repaired" [SITE, RATE] Made "<other_unit>" "level of the weighted records, <label>"
        = |of, at| of.diagnosis.deviation.as_ref().map_or(f64::NAN, |deviation| deviation.implied_levels[at]);
}

group! {
    /// The weights of each site's repair, and what the records are under them.
    pub const REPAIRS: Repaired = CONSISTENCY.path;
    "effective_records" [SITE, STRIPE_LEVEL] Made "1" "effective records under the weights"
        ("effective records under the weights; after a repair, as all that follows")
        = |of, at| of.diagnosis.stripes[at].effective_records;
    "exponent" [SITE, KNOT] Made "1" "exponent of the weights" = |of, at| of.fit.exponents[at];
    "knot" [SITE, KNOT] Made "<other_unit>" "<label> of the knots"
        ("levels of the other measure at which the exponents hold") = |of, at| of.knot_levels[at];
    "iterations" [SITE] Made "1" "steps of the fit" = |of, _at| f64::from(of.fit.iterations);
    "mean_ln_ratio" [SITE, STRIPE_LEVEL] Made "1" "mean of ln(other measure/measure scaled to) under the weights"
        = |of, at| of.diagnosis.stripes[at].mean_ln_ratio;
    "sd_ln_ratio" [SITE, STRIPE_LEVEL] Made "1" "standard deviation of it"
        = |of, at| of.diagnosis.stripes[at].sd_ln_ratio;
}

group! {
    /// The weights of all runs; kept where it is asked for.
    pub const WEIGHTS: Repaired = CONSISTENCY.path;
    "weight" [SITE, STRIPE_LEVEL, RECORD] Made "1" "share of the record at the level"
        ("share of each record at each level; only with `--keep-weights`") = |of, at| of.weights.shares()[at];
}

group! {
    /// The spectra of weighted records, a row each ordinate.
    pub const REPAIRED_SPECTRA: Ordinate = CONSISTENCY.path;
    "u_m" [SITE, POE, STRENGTH] F64 "m" "uniform risk displacement of the weighted records"
        ("the spectra of the weighted records, as `/urs`; NaN where there is no repair") = |of, _at| of.displacement_m;
    "lower_tail_share" [SITE, POE, STRENGTH] Made "1" "share of its risk from below the first level"
        ("as that of `/urs`; NaN where there is no repair") = |of, _at| of.lower_tail_share;
    "upper_tail_share" [SITE, POE, STRENGTH] Made "1" "share of its risk from above the last level"
        ("as that of `/urs`; NaN where there is no repair") = |of, _at| of.upper_tail_share;
    "flag" [SITE, POE, STRENGTH] Flag "1"
        "0 regular, 1 no exceedance so that the ordinate is 0, 2 censored, 3 no repair"
        ("as that of `/urs`, and 3: no repair") = |of, _at| of.flag;
}

/// Names of the arrays of the analysis by a measure, about another one.
fn consistency_names(scaled_to: IntensityMeasure, other: IntensityMeasure) -> [(&'static str, &'static str); 4] {
    [("<im>", scaled_to.key()), ("<other>", other.key()), ("<other_unit>", other.unit()), ("<label>", other.label())]
}

/// Coefficients of the spectra of weighted records.
pub const REPAIRED_FITS: Group<Fits> = Group {
    path: "/consistency/<im>/regression",
    quantities: &[
        Quantity { long_name: "c0 of u = c0 exp(c1 strength) + c2, weighted records", ..regression::C0_M },
        regression::C1,
        regression::C2_M,
        regression::RMSE_M,
    ],
};

impl StoredConsistency {
    /// Whether there are spectra of weighted records at a site.
    pub fn is_repaired(&self, site: usize) -> bool {
        self.u_m.as_ref().is_some_and(|u_m| u_m.block([site]).iter().any(|u_m| !u_m.is_nan()))
    }

    /// Whether these are to be shown beside the plain spectra: there are some, and the plain ones are of records that
    /// miss the site's hazard.
    pub fn stands_beside(&self, site: usize) -> bool {
        self.verdict[site] == "inconsistent" && self.is_repaired(site)
    }
}

impl ConsistencyGroup<'_> {
    /// The groups and axes of a result that a new look replaces.
    pub fn replaced() -> [String; 3] {
        [CONSISTENCY.root().to_owned(), axis::path(RATE.name), axis::path(KNOT.name)]
    }

    /// Writes it.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write(&self, writer: &mut LabelledWriter) -> Result<(), LabelledError> {
        if self.measures.is_empty() {
            return Ok(());
        }
        let is_repaired = self.measures.iter().any(|own| own.ordinates.is_some());
        sign(writer, CONSISTENCY.root())?;
        writer.attribute(CONSISTENCY.root(), "smoothness", self.smoothness)?;
        writer.attribute(CONSISTENCY.root(), "repair", if is_repaired { "weights" } else { "none" })?;
        RATE.write(writer, &[], &(1..).take(DEVIATION_RATES).collect::<Vec<u32>>())?;
        KNOT.write(writer, &[], &(1..).take(KNOTS).collect::<Vec<u32>>())?;
        self.measures.iter().try_for_each(|own| self.write_measure(writer, own))
    }

    fn write_measure(&self, writer: &mut LabelledWriter, own: &MeasureConsistency<'_>) -> Result<(), LabelledError> {
        let stored = &own.stored;
        let (measure, level) = (stored.scaled_to, STRIPE_LEVEL.for_measure(stored.scaled_to));
        let names = consistency_names(measure, stored.other);
        let [sites, poes] = stored.ratio.shape();
        let lengths = [
            (SITE.name, sites),
            (RATE.name, DEVIATION_RATES),
            (POE.name, poes),
            (STRENGTH.name, own.ordinates.map_or(0, |of| of.shape()[2])),
            (KNOT.name, KNOTS),
            (level.as_str(), stored.effective_records.as_ref().map_or(0, |of| of.shape()[1])),
            (RECORD.name, self.records),
        ];
        let repaired = || own.repaired.iter().copied();
        CONSISTENCY.write(writer, &names, &lengths, stored)?;
        DIAGNOSES.write_rows(writer, &names, &lengths, own.diagnoses.iter().copied())?;
        REPAIRED_LEVELS.write_rows(writer, &names, &lengths, repaired())?;
        let (Some(ordinates), Some(fits)) = (own.ordinates, &stored.fits) else { return Ok(()) };
        REPAIRS.write_rows(writer, &names, &lengths, repaired())?;
        if self.keeps_weights {
            WEIGHTS.write_rows(writer, &names, &lengths, repaired())?;
        }
        REPAIRED_SPECTRA.write_rows(writer, &names, &lengths, ordinates.values().iter().map(Option::as_ref))?;
        REPAIRED_FITS.write(writer, &names, &lengths, fits)?;
        let mut axes = BTreeSet::new();
        for (site, branches) in &own.branches {
            let site = &self.sites[*site];
            // as the plain spectra of the branches name them, whether repaired or not
            let axis = axis::branch(site, measure, &mut axes);
            branches.map_or(Ok(()), |own| own.write_repaired(writer, (measure, site, &axis)))?;
        }
        Ok(())
    }
}

impl StoredResult {
    /// The consistency of the records with the hazard of another measure, at the study's risks: one for each measure
    /// that they are scaled to; none where no site has curves of two measures, and in results of versions that did not
    /// ask.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn stored_consistency(&self) -> Result<Vec<StoredConsistency>, ResultError> {
        let mut found = Vec::new();
        for scaled_to in self.measures() {
            let arrays = self.reader.children(&CONSISTENCY.for_measure(scaled_to)).unwrap_or_default();
            for other in arrays.iter().filter_map(|name| name.strip_suffix("_site")?.parse().ok()) {
                found.push(self.consistency_of(scaled_to, other)?);
            }
        }
        Ok(found)
    }

    /// Whether there are spectra of weighted records.
    pub fn has_repair(&self) -> bool {
        self.measures().into_iter().any(|own| REPAIRED_SPECTRA.is_in(self, &measure_names(own)))
    }

    fn consistency_of(
        &self,
        scaled_to: IntensityMeasure,
        other: IntensityMeasure,
    ) -> Result<StoredConsistency, ResultError> {
        let axes = self.stored_axes()?;
        let (sites, poes, strengths) = (axes.sites.len(), axes.poes.len(), axes.strengths.len());
        let rates = self.reader.axis::<u32>(RATE.name)?.len();
        let level = STRIPE_LEVEL.for_measure(scaled_to);
        let levels = self.reader.axis::<f64>(&level)?.len();
        let lengths = [(SITE.name, sites), (RATE.name, rates), (POE.name, poes)];
        let by_poe = [(SITE.name, sites), (POE.name, poes)];
        let names = consistency_names(scaled_to, other);
        let nan = |inner| Array::from_fn([sites, inner], |_| f64::NAN);
        let mut found = StoredConsistency {
            scaled_to,
            other,
            rate_per_year: nan(rates),
            site_level: nan(rates),
            implied_level: nan(rates),
            repaired_level: None,
            bias: vec![f64::NAN; sites],
            max: vec![f64::NAN; sites],
            verdict: vec![String::new(); sites],
            poes: axes.poes,
            years: axes.years,
            ratio: nan(poes),
            effective_records: None,
            u_m: None,
            fits: None,
        };
        CONSISTENCY.read(self, &names, &lengths, &mut found)?;
        if REPAIRED_SPECTRA.is_in(self, &names) {
            let by_level = [(SITE.name, sites), (&level[..], levels)];
            found.effective_records = Some(REPAIRS.read_array("effective_records", self, &names, by_level)?);
            let by_rate = [(SITE.name, sites), (RATE.name, rates)];
            found.repaired_level = Some(REPAIRED_LEVELS.read_array("<other>_repaired", self, &names, by_rate)?);
            let spectrum = [(SITE.name, sites), (POE.name, poes), (STRENGTH.name, strengths)];
            found.u_m = Some(REPAIRED_SPECTRA.read_array("u_m", self, &names, spectrum)?);
            found.fits = Some(self.repaired_fits(scaled_to, by_poe)?);
        }
        Ok(found)
    }

    /// The coefficients of the repaired spectra.
    fn repaired_fits(&self, scaled_to: IntensityMeasure, by_poe: [(&str, usize); 2]) -> Result<Fits, ResultError> {
        let mut fits = Fits::from_fn(by_poe.map(|(_, length)| length), |_| Fit::NONE);
        REPAIRED_FITS.read(self, &measure_names(scaled_to), &by_poe, &mut fits)?;
        // it is nowhere below: where it is held it is exactly there
        Ok(fits.map(|fit| Fit { bound_active: fit.c2_m <= 0.0, ..*fit }))
    }
}
