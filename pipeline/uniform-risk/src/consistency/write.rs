//! Consistency in the result file, and as a table beside it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_consistency::{DEVIATION_RATES, Diagnosis, KNOTS, Repaired};
use uplift_job::outputs::beside;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::IntensityMeasure;
use uplift_result::declared::of_measure;
use uplift_result::layout::{axis, consistency as layout};
use uplift_result::{
    CONSISTENCY, EFFECTIVE_RECORDS, Fit, REPAIRED_EPISTEMIC, REPAIRED_EPISTEMIC_SPECTRA, REPAIRED_FITS, REPAIRED_LEVEL,
    REPAIRED_U_M, StoredConsistency, consistency_names, flag_number, sign,
};
use uplift_risk::Ordinate;

use super::asked::stored;
use super::{ConsistencyReport, Finding, Question, Repairs};
use crate::{BRANCHES, write_branch_spectra};

/// Flag of an ordinate that does not exist, since the set could not be repaired.
const NO_REPAIR: u8 = 3;

/// A column: what it is of the thing that a row is about.
type Of<T, V = f64> = fn(&T) -> V;
/// The same over the levels of a repaired set.
type OfLevels = Of<Repaired, Vec<f64>>;

/// The groups and axes that a new look replaces.
pub fn replaced() -> Vec<String> {
    let axes = [axis::RATE, axis::KNOT].map(axis::path);
    std::iter::once(CONSISTENCY.root().to_owned()).chain(axes).collect()
}

/// The table beside the result file.
pub fn consistency_path(result: &Path) -> PathBuf {
    beside(result, "consistency.csv")
}

/// Whether the weights of all runs are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    /// No: they follow from the exponents.
    Exponents,
    /// Yes.
    Weights,
}

/// Adds `findings` and the spectra of their weights to a result.
///
/// # Errors
/// A file that cannot be written.
pub fn add(
    writer: &mut LabelledWriter,
    question: &Question,
    findings: &[Finding],
    repairs: &[Repairs],
    keep: Keep,
) -> Result<(), LabelledError> {
    if findings.is_empty() {
        return Ok(());
    }
    sign(writer, CONSISTENCY.root())?;
    writer.attribute(CONSISTENCY.root(), "smoothness", question.settings.smoothness)?;
    writer.attribute(CONSISTENCY.root(), "repair", if repairs.is_empty() { "none" } else { "weights" })?;
    let rates: Vec<u32> = (1..).take(DEVIATION_RATES).collect();
    writer.axis_u32(axis::RATE, &rates, "1", "annual rate at which hazards are compared, the most frequent first")?;
    let knots: Vec<u32> = (1..).take(KNOTS).collect();
    writer.axis_u32(axis::KNOT, &knots, "1", "knot of the weights' exponent")?;
    for (measure, _) in &question.analyses {
        let own: Vec<&Finding> = findings.iter().filter(|finding| finding.scaled_to == *measure).collect();
        let Some(first) = own.first() else { continue };
        let table = Table { writer, question, measure: *measure, other: first.other, findings: &own };
        table.write(repairs.iter().find(|repairs| repairs.measure == *measure), keep)?;
    }
    Ok(())
}

/// The arrays of one measure.
struct Table<'a> {
    writer: &'a mut LabelledWriter,
    question: &'a Question,
    measure: IntensityMeasure,
    other: IntensityMeasure,
    findings: &'a [&'a Finding],
}

impl Table<'_> {
    fn write(mut self, repairs: Option<&Repairs>, keep: Keep) -> Result<(), LabelledError> {
        let measures = (self.measure, self.other);
        let levels = self.question.levels(self.measure).len();
        let stored = stored(self.question, measures, levels, (self.findings, self.findings), repairs);
        self.deviation(&stored)?;
        self.targets()?;
        if let Some(repairs) = repairs {
            self.weights(keep)?;
            if let Some((records, u_m)) = stored.effective_records.as_ref().zip(stored.u_m.as_ref()) {
                EFFECTIVE_RECORDS.write_array(self.writer, &self.names(), records.values())?;
                REPAIRED_U_M.write_array(self.writer, &self.names(), u_m.values())?;
            }
            self.spectra(repairs)?;
            self.branches(repairs)?;
        }
        Ok(())
    }

    /// The spectra of weighted hazard curves, each repaired by itself.
    fn branches(&mut self, repairs: &Repairs) -> Result<(), LabelledError> {
        let mut axes = BTreeSet::new();
        // as the plain spectra of the branches name them, whether repaired or not
        let of_site = |site: usize| {
            let has_branches = self.question.branches.contains_key(&(self.measure, site));
            has_branches.then(|| axis::branch(&self.question.sites[site], self.measure, &mut axes))
        };
        let axes: Vec<Option<String>> = (0..self.question.sites.len()).map(of_site).collect();
        for branches in &repairs.branches {
            let site = &self.question.sites[branches.site];
            let Some(axis) = &axes[branches.site] else { continue };
            let own = [of_measure(self.measure)[0], ("<site>", site), ("<branches>", axis)];
            let groups = (&REPAIRED_EPISTEMIC_SPECTRA, &REPAIRED_EPISTEMIC);
            write_branch_spectra(self.writer, branches, groups, &[&own[..], &BRANCHES].concat())?;
        }
        Ok(())
    }

    /// Values `[site, inner]` of the sites that were looked at, NaN of the others.
    fn by_site(&self, inner: usize, values: impl Fn(&Finding) -> Vec<f64>) -> Vec<f64> {
        let mut all = vec![f64::NAN; self.question.sites.len() * inner];
        for finding in self.findings {
            let own = values(finding);
            all[finding.site * inner..][..own.len()].copy_from_slice(&own);
        }
        all
    }

    fn array(
        &mut self,
        name: &str,
        dims: &[&str],
        values: &[f64],
        unit: &str,
        what: &str,
    ) -> Result<(), LabelledError> {
        self.writer.array_f64(&layout::array(self.measure, name), dims, values, unit, what)
    }

    /// The hazard of the other measure: the site's, what the records bring, and what weighted ones bring.
    fn deviation(&mut self, stored: &StoredConsistency) -> Result<(), LabelledError> {
        let lengths = [(axis::SITE, stored.bias.len()), (axis::RATE, DEVIATION_RATES), (axis::POE, stored.poes.len())];
        CONSISTENCY.write(self.writer, &self.names(), &lengths, stored)?;
        let repaired = |own: &Finding| Some(own.repaired()?.diagnosis.deviation.as_ref()?.implied_levels.to_vec());
        let levels = self.by_site(DEVIATION_RATES, |finding| repaired(finding).unwrap_or_default());
        REPAIRED_LEVEL.write_array(self.writer, &self.names(), &levels)?;
        let rms = |own: &Finding| vec![own.diagnosis.deviation.as_ref().map_or(f64::NAN, |deviation| deviation.rms)];
        let (name, values) = (layout::of_other(self.other, "rms"), self.by_site(1, rms));
        self.array(&name, &[axis::SITE], &values, "1", "root mean square of ln(implied/site)")
    }

    fn names(&self) -> [(&'static str, &'static str); 4] {
        consistency_names(self.measure, self.other)
    }

    /// What the records bring at each probability.
    fn targets(&mut self) -> Result<(), LabelledError> {
        type OfTarget = fn(&Diagnosis, usize) -> f64;
        let poes = self.question.poes.len();
        let dims = [axis::SITE, axis::POE];
        let columns: [(&str, OfTarget, &str); 6] = [
            (
                "times_as_often",
                |d, at| d.targets[at].times_as_often.unwrap_or(f64::NAN),
                "how many times as often as it should the site's level is reached",
            ),
            ("scale_factor_05", |d, at| d.targets[at].scale_factors.percentiles[0], "5 % of the scale factors"),
            ("scale_factor_50", |d, at| d.targets[at].scale_factors.percentiles[1], "median of the scale factors"),
            ("scale_factor_95", |d, at| d.targets[at].scale_factors.percentiles[2], "95 % of the scale factors"),
            (
                "scale_factors_outside",
                |d, at| d.targets[at].scale_factors.outside_limits,
                "share of the scale factors outside consistency.scale_factors",
            ),
            (
                "effective_events",
                |d, at| d.stripes[d.targets[at].stripe].effective_events.unwrap_or(f64::NAN),
                "effective earthquakes",
            ),
        ];
        for (name, value, what) in columns {
            let of = |finding: &Finding| (0..poes).map(|poe| value(&finding.diagnosis, poe)).collect();
            let values = self.by_site(poes, of);
            let name = if name == "times_as_often" { layout::of_other(self.other, name) } else { name.to_owned() };
            self.array(&name, &dims, &values, "1", what)?;
        }
        Ok(())
    }

    /// The weights of the repair, and what the set is under them.
    fn weights(&mut self, keep: Keep) -> Result<(), LabelledError> {
        let question = self.question;
        let levels = question.levels(self.measure).len();
        let level = axis::level(self.measure);
        let of_repaired = |value: OfLevels| move |finding: &Finding| finding.repaired().map_or_else(Vec::new, value);
        let values = self.by_site(KNOTS, of_repaired(|repaired| repaired.fit.exponents.to_vec()));
        self.array("exponent", &[axis::SITE, axis::KNOT], &values, "1", "exponent of the weights")?;
        let values = self.by_site(KNOTS, of_repaired(|repaired| repaired.knot_levels.to_vec()));
        let what = format!("{} of the knots", self.other.label());
        self.array("knot", &[axis::SITE, axis::KNOT], &values, self.other.unit(), &what)?;
        let values = self.by_site(1, of_repaired(|repaired| vec![f64::from(repaired.fit.iterations)]));
        self.array("iterations", &[axis::SITE], &values, "1", "steps of the fit")?;
        let stripes: [(&str, OfLevels, &str); 2] = [
            (
                "mean_ln_ratio",
                |repaired| repaired.diagnosis.stripes.iter().map(|stripe| stripe.mean_ln_ratio).collect(),
                "mean of ln(other measure/measure scaled to) under the weights",
            ),
            (
                "sd_ln_ratio",
                |repaired| repaired.diagnosis.stripes.iter().map(|stripe| stripe.sd_ln_ratio).collect(),
                "standard deviation of it",
            ),
        ];
        for (name, value, what) in stripes {
            let values = self.by_site(levels, of_repaired(value));
            self.array(name, &[axis::SITE, &level], &values, "1", what)?;
        }
        if keep == Keep::Weights {
            let runs = levels * question.records.len();
            let values = self.by_site(runs, of_repaired(|repaired| repaired.weights.shares().to_vec()));
            let dims = [axis::SITE, &level, axis::RECORD];
            self.array("weight", &dims, &values, "1", "share of the record at the level")?;
        }
        Ok(())
    }

    /// The spectra of the weights, with their fits.
    fn spectra(&mut self, repairs: &Repairs) -> Result<(), LabelledError> {
        let dims = [axis::SITE, axis::POE, axis::STRENGTH];
        let columns: [(&str, Of<Ordinate>, &str); 2] = [
            ("lower_tail_share", |own| own.lower_tail_share, "share of its risk from below the first stripe"),
            ("upper_tail_share", |own| own.upper_tail_share, "share of its risk from above the last stripe"),
        ];
        for (name, value, what) in columns {
            let values = repairs.ordinates.map(|ordinate| ordinate.as_ref().map_or(f64::NAN, value)).into_values();
            self.array(name, &dims, &values, "1", what)?;
        }
        let flag =
            |ordinate: &Option<Ordinate>| ordinate.as_ref().map_or(NO_REPAIR, |ordinate| flag_number(ordinate.flag));
        let flags = repairs.ordinates.map(flag).into_values();
        let what = "0 regular, 1 no exceedance so that the ordinate is 0, 2 censored, 3 no repair";
        self.writer.array_u8(&layout::array(self.measure, "flag"), &dims, &flags, "1", what)?;
        let fits = repairs.fits.map(|fit| Fit::of(fit.as_ref().ok()));
        let [sites, poes] = fits.shape();
        REPAIRED_FITS.write(self.writer, &of_measure(self.measure), &[(axis::SITE, sites), (axis::POE, poes)], &fits)
    }
}

/// The rows of a report as a table: a row a measure, site and probability.
pub fn columns(report: &ConsistencyReport) -> Vec<Column> {
    let targets = || report.rows.iter().flat_map(|row| row.targets.iter().map(move |target| (row, target)));
    let text =
        |value: fn(&super::ConsistencyRow) -> String| -> Vec<String> { targets().map(|(row, _)| value(row)).collect() };
    let number = |value: fn(&super::ConsistencyRow, &super::TargetRow) -> Option<f64>| -> Vec<Option<f64>> {
        targets().map(|(row, target)| value(row, target)).collect()
    };
    let repaired = |value: fn(&super::TargetRow) -> Option<f64>| -> Vec<Option<f64>> {
        let of = |(row, target): (&super::ConsistencyRow, &super::TargetRow)| {
            let own = row.repair.as_ref()?.targets.iter().find(|own| own.poe.to_bits() == target.poe.to_bits())?;
            value(own)
        };
        targets().map(of).collect()
    };
    vec![
        Column::new("site".into(), text(|row| row.site.clone())),
        Column::new("scaled_to".into(), text(|row| row.scaled_to.to_owned())),
        Column::new("shows".into(), text(|row| row.shows.to_owned())),
        Column::new("unit".into(), text(|row| row.unit.to_owned())),
        Column::new("poe".into(), number(|_, target| Some(target.poe))),
        Column::new("years".into(), vec![report.years; targets().count()]),
        Column::new("site_level".into(), number(|_, target| target.site_level)),
        Column::new("implied_level".into(), number(|_, target| Some(target.implied_level))),
        Column::new("ratio".into(), number(|_, target| target.ratio)),
        Column::new("times_as_often".into(), number(|_, target| target.times_as_often)),
        Column::new("bias".into(), number(|row, _| row.bias)),
        Column::new("rms".into(), number(|row, _| row.rms)),
        Column::new("max".into(), number(|row, _| row.max)),
        Column::new("verdict".into(), text(|row| row.verdict.unwrap_or_default().to_owned())),
        Column::new("scale_factor_05".into(), number(|_, target| Some(target.scale_factors[0]))),
        Column::new("scale_factor_50".into(), number(|_, target| Some(target.scale_factors[1]))),
        Column::new("scale_factor_95".into(), number(|_, target| Some(target.scale_factors[2]))),
        Column::new("scale_factors_outside".into(), number(|_, target| Some(target.outside_limits))),
        Column::new("effective_records".into(), number(|_, target| Some(target.effective_records))),
        Column::new("effective_events".into(), number(|_, target| target.effective_events)),
        Column::new("repaired_ratio".into(), repaired(|target| target.ratio)),
        Column::new("repaired_effective_records".into(), repaired(|target| Some(target.effective_records))),
        Column::new("repaired_effective_events".into(), repaired(|target| target.effective_events)),
    ]
}
