//! The hazard curves of a study's sites, with the weights of the stripes that follow from them.

use std::path::{Path, PathBuf};

use uplift_hazard::{HazardCurve, rate_from_probability};
use uplift_job::JobError;
use uplift_job::checksum::checksum_of_file;
use uplift_job::text::{counted, rate, rounded};
use uplift_motion::IntensityMeasure;
use uplift_risk::StripeWeights;
use uplift_study::{
    CurveFile, MeasurePlan, UniformRiskStudy, definition_of, levels_key, levels_place, usual_top_level,
};

use super::curve_file::{are_interchanged, read_converted, stripe_weights};
use super::other_unit::{curve_line, from_outside};
use crate::error::InputsError;

/// The hazard of one site in one measure.
#[derive(Debug, Clone)]
pub struct SiteHazard {
    /// Name of the site.
    pub site: String,
    /// The measure.
    pub measure: IntensityMeasure,
    /// The curve that the spectra are made of.
    pub curve: HazardInput,
    /// Weighted alternatives to it, if the site has some.
    pub branches: Vec<BranchHazard>,
}

/// A hazard curve as used.
#[derive(Debug, Clone)]
pub struct HazardInput {
    /// Where it was read; none for the mean of the branches.
    pub file: Option<PathBuf>,
    /// SHA-256 of the file; empty for a mean.
    pub checksum: String,
    /// The curve in field units, cm/s or g.
    pub curve: HazardCurve,
    /// What each stripe weighs in the risk integral (Eq. 4.4).
    pub weights: StripeWeights,
}

/// One of several weighted curves.
#[derive(Debug, Clone)]
pub struct BranchHazard {
    /// Its name.
    pub name: String,
    /// Its weight.
    pub weight: f64,
    /// Its curve.
    pub input: HazardInput,
}

/// Read the curves of every site and measure, `[measure][site]`, and notes about what was dropped from them.
///
/// # Errors
/// Everything that is wrong with them, at once.
pub fn read_hazard(study: &UniformRiskStudy) -> Result<(Vec<Vec<SiteHazard>>, Vec<String>), InputsError> {
    let mut mistakes = Vec::new();
    let mut notes = Vec::new();
    let mut undefined = Vec::new();
    let mut all = Vec::new();
    for plan in &study.measures {
        let mut sites = Vec::new();
        for site in &study.sites {
            let Some(file) = site.curve(plan.measure) else { continue };
            let (notes, undefined, mistakes) = (&mut notes, &mut undefined, &mut mistakes);
            let measure = plan.measure;
            let mut reader = SiteReader { site: &site.name, file, measure, study, notes, undefined, mistakes };
            sites.extend(reader.read(plan));
        }
        all.push(sites);
    }
    notes.extend(undefined_note(study, &undefined));
    notes.extend(extrapolated_note(study, &all));
    notes.extend(study.measures.iter().zip(&all).filter_map(|(plan, sites)| shortened_note(plan, sites)));
    if mistakes.is_empty() { Ok((all, notes)) } else { Err(JobError::Inputs(mistakes).into()) }
}

/// That curves do not reach all levels of their measure and are extrapolated; none where all do.
fn extrapolated_note(study: &UniformRiskStudy, hazard: &[Vec<SiteHazard>]) -> Option<String> {
    let by_measure = study.measures.iter().zip(hazard);
    let of_sites = by_measure.flat_map(|(plan, sites)| sites.iter().map(move |site| (plan, site)));
    let extrapolated: Vec<String> = of_sites
        .filter_map(|(plan, SiteHazard { site, measure, curve, .. })| {
            let (first, last) = (plan.levels.first()?, plan.levels.last()?);
            let [from, to] = [curve.curve.first().im, curve.curve.last().im];
            let (im, unit) = (measure.label(), measure.unit());
            let what = format!("{site}, {im}, spans {from} to {to} {unit}, the levels {first} to {last}");
            (*first < from || to < *last).then_some(what)
        })
        .collect();
    extrapolated.first().map(|first| {
        let more = if extrapolated.len() > 1 { "; …" } else { "" };
        format!("{} extrapolated ({first}{more})", counted(extrapolated.len(), "hazard curve"))
    })
}

/// That the levels of `plan` are the default ones that the curves of all `sites` cover, and whose curves cut them; none
/// where the study gives its levels.
fn shortened_note(plan: &MeasurePlan, sites: &[SiteHazard]) -> Option<String> {
    if !plan.is_cut {
        return None;
    }
    let spans = sites.iter().flat_map(|site| {
        let branches = site.branches.iter().map(|branch| &branch.input);
        let curves = std::iter::once(&site.curve).chain(branches).map(|input| &input.curve);
        curves.map(|curve| (site.site.as_str(), curve.first().im, curve.last().im))
    });
    let from = spans.clone().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let to = spans.min_by(|a, b| a.2.total_cmp(&b.2))?;
    let (first, last) = (plan.levels.first()?, plan.levels.last()?);
    let whose = if from.0 == to.0 { from.0.to_owned() } else { format!("{} and {}", from.0, to.0) };
    let (measure, unit) = (plan.measure.label(), plan.measure.unit());
    Some(format!("default levels of {measure} cut to {first} to {last} {unit} by the hazard curves of {whose}"))
}

/// That curves do not say how horizontal components are combined; none where all do.
fn undefined_note(study: &UniformRiskStudy, undefined: &[String]) -> Option<String> {
    undefined.first().map(|first| {
        format!(
            "horizontal component of {} not given ({first}{}): taken as {}. Set hazard.component",
            counted(undefined.len(), "hazard curve"),
            if undefined.len() > 1 { "; …" } else { "" },
            definition_of(study.records.intensity)
        )
    })
}

/// The hazard of a site in a measure that its study is not analysed by: what the records bring is held against it.
#[derive(Debug, Clone)]
pub struct OtherHazard {
    /// Name of the site.
    pub site: String,
    /// The measure.
    pub measure: IntensityMeasure,
    /// Where it was read; none for the mean of branches.
    pub file: Option<PathBuf>,
    /// SHA-256 of the file; empty for a mean.
    pub checksum: String,
    /// The curve in field units, cm/s or g.
    pub curve: HazardCurve,
    /// Name and SHA-256 of the file of each branch that it is the mean of.
    pub branches: Vec<(String, String)>,
}

/// Reads the curves of the measures that `study` is not analysed by, and notes about what was dropped from them.
///
/// # Errors
/// Everything that is wrong with them, at once.
pub fn read_other_hazard(study: &UniformRiskStudy) -> Result<(Vec<OtherHazard>, Vec<String>), InputsError> {
    let (mut mistakes, mut notes, mut undefined, mut all) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for site in &study.sites {
        for file in &site.curves {
            if study.measures.iter().any(|plan| plan.measure == file.measure) {
                continue;
            }
            let measure = file.measure;
            let (notes, undefined, mistakes) = (&mut notes, &mut undefined, &mut mistakes);
            let mut reader = SiteReader { site: &site.name, file, measure, study, notes, undefined, mistakes };
            all.extend(reader.other());
        }
    }
    notes.extend(undefined_note(study, &undefined));
    if mistakes.is_empty() { Ok((all, notes)) } else { Err(JobError::Inputs(mistakes).into()) }
}

/// The mean of weighted curves, with the levels asked for among its own.
fn weighted_mean(curves: &[(f64, &HazardCurve)], levels: &[f64]) -> Result<HazardCurve, String> {
    HazardCurve::weighted_mean(curves, levels).map_err(|error| format!("the branches have no mean: {error}"))
}

/// A curve as its file has it.
struct ReadCurve {
    curve: HazardCurve,
    /// SHA-256 of the file.
    checksum: String,
    /// Rows of probability 1 at its start, which carry no rate.
    dropped_certain: usize,
}

/// Reads what belongs to one site and measure.
struct SiteReader<'a> {
    site: &'a str,
    file: &'a CurveFile,
    measure: IntensityMeasure,
    study: &'a UniformRiskStudy,
    notes: &'a mut Vec<String>,
    /// Curves that do not say which definition of the measure they are of.
    undefined: &'a mut Vec<String>,
    mistakes: &'a mut Vec<String>,
}

impl SiteReader<'_> {
    /// The hazard; none where something is wrong, which is then among the mistakes.
    fn read(&mut self, plan: &MeasurePlan) -> Option<SiteHazard> {
        let file = self.file;
        let branches: Vec<BranchHazard> = file
            .branches
            .iter()
            .filter_map(|branch| {
                let input = self.input(&branch.file, plan)?;
                Some(BranchHazard { name: branch.name.clone(), weight: branch.weight, input })
            })
            .collect();
        let curve = match &file.file {
            Some(path) => self.input(path, plan)?,
            // a mean of some of the branches would be another curve
            None if branches.len() < file.branches.len() => return None,
            None => self.mean(&branches, plan)?,
        };
        Some(SiteHazard { site: self.site.to_owned(), measure: self.measure, curve, branches })
    }

    /// The curve of a measure that the study is not analysed by.
    fn other(&mut self) -> Option<OtherHazard> {
        let file = self.file;
        let mut branches = Vec::new();
        let (curve, checksum) = if let Some(path) = &file.file {
            let read = self.read_file(path);
            let read = self.noted(read)?;
            (read.curve, read.checksum)
        } else {
            let mut curves = Vec::new();
            for branch in &file.branches {
                let read = self.read_file(&branch.file);
                let ReadCurve { curve, checksum, .. } = self.noted(read)?;
                curves.push((branch.weight, curve));
                branches.push((branch.name.clone(), checksum));
            }
            let curves: Vec<(f64, &HazardCurve)> = curves.iter().map(|(weight, curve)| (*weight, curve)).collect();
            let mean = weighted_mean(&curves, &[]);
            (self.noted(mean)?, String::new())
        };
        Some(OtherHazard {
            site: self.site.to_owned(),
            measure: self.measure,
            file: file.file.clone(),
            checksum,
            curve,
            branches,
        })
    }

    fn input(&mut self, path: &Path, plan: &MeasurePlan) -> Option<HazardInput> {
        let read = self.read_file(path).and_then(|ReadCurve { curve, checksum, dropped_certain }| {
            let weights = self.weights(&curve, &path.display().to_string(), plan, dropped_certain)?;
            Ok(HazardInput { file: Some(path.to_owned()), checksum, curve, weights })
        });
        self.noted(read)
    }

    fn mean(&mut self, branches: &[BranchHazard], plan: &MeasurePlan) -> Option<HazardInput> {
        let curves: Vec<(f64, &HazardCurve)> =
            branches.iter().map(|branch| (branch.weight, &branch.input.curve)).collect();
        let mean = weighted_mean(&curves, &plan.levels).and_then(|curve| {
            let weights = self.weights(&curve, "the mean of the branches", plan, 0)?;
            Ok(HazardInput { file: None, checksum: String::new(), curve, weights })
        });
        self.noted(mean)
    }

    fn noted<T>(&mut self, read: Result<T, String>) -> Option<T> {
        match read {
            Ok(read) => Some(read),
            Err(reason) => {
                self.mistakes.push(format!("site {}, {}: {reason}", self.site, self.measure.label()));
                None
            }
        }
    }

    /// The curve of a file for the records' definition of the measure.
    fn read_file(&mut self, path: &Path) -> Result<ReadCurve, String> {
        let (read, is_defined) = read_converted(self.study, (self.site, self.file), path)?;
        for dropped in read.dropped() {
            self.notes.push(format!("site {}, {}: {dropped}", self.site, self.measure.label()));
        }
        if !is_defined {
            self.undefined.push(format!("{}, {}", self.site, self.measure.label()));
        }
        let checksum = checksum_of_file(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(ReadCurve { curve: read.curve, checksum, dropped_certain: read.dropped_certain })
    }

    /// What to do about a curve that is shorter than the levels, which go up to `most`, beside writing the `levels`
    /// that it covers: the first word, and the rest.
    fn remedy(&self, curve: &HazardCurve, most: f64, levels: &str) -> (&'static str, String) {
        let risk = &self.study.risk;
        let rates = risk.poe.iter().filter_map(|&poe| rate_from_probability(poe, risk.years).ok());
        let (end, least_per_year) = (curve.last(), rates.fold(f64::INFINITY, f64::min));
        // levels up to there would leave out most of the risk
        if most > end.im && end.maf > least_per_year {
            let rest = format!(
                "a longer curve, or risk.extrapolate = \"loglog\": this one ends at {} per year, and the study asks \
                 for {}",
                rate(end.maf),
                rate(least_per_year)
            );
            return ("Use", rest);
        }
        ("In", format!("{levels}. Or use a longer curve, or risk.extrapolate = \"loglog\""))
    }

    fn weights(
        &self,
        curve: &HazardCurve,
        name: &str,
        plan: &MeasurePlan,
        dropped_certain: usize,
    ) -> Result<StripeWeights, String> {
        stripe_weights(self.study, plan, curve).map_err(|reason| {
            if are_interchanged(self.study, self.site, self.file, plan).unwrap_or(false) {
                return format!(
                    "{name}: are the files of pgv and pga interchanged? Each covers the levels of the other. As they \
                     are, {reason}"
                );
            }
            if let Some(other_unit) = from_outside(self.study, (self.site, self.file), plan, curve) {
                // who reads a curve in another unit is not helped by an extrapolation of it
                let key = levels_key(self.measure);
                return format!("{name}: {other_unit}; if not, use a longer curve or leave levels out of {key}");
            }
            let dropped = match dropped_certain {
                0 => String::new(),
                rows => format!(" ({} of probability 1 dropped)", counted(rows, "row")),
            };
            let (first, last) = (curve.first().im, curve.last().im);
            let unit = self.measure.unit();
            let [begin, end] = [first, last].map(|end| rounded(end, 6));
            let (least, most) = (plan.levels[0], plan.levels[plan.levels.len() - 1]);
            let span = match (least < first, most > last) {
                (true, true) => Some(format!("spans {begin} to {end} {unit}{dropped}, the levels {least} to {most}")),
                (true, false) => Some(format!("begins at {begin} {unit}{dropped}, the levels at {least} {unit}")),
                (false, true) => Some(format!("ends at {end} {unit}, the levels at {most} {unit}")),
                (false, false) => None,
            };
            let (Some(span), Some(within)) = (span, MeasurePlan::default_within(self.measure, first, last)) else {
                return format!("{name}: {reason}{dropped}");
            };
            let (section, key) = levels_place(self.measure);
            let (so, remedy) = self.remedy(curve, most, &format!("[{section}] write: {key} = {}", within.levels));
            let therefore = usual_top_level(self.measure)
                .and_then(|(_, usual)| usual.unlikely("its last level", last))
                .map_or_else(
                    || format!(". {so}"),
                    |unlikely| {
                        let units: Vec<String> =
                            self.file.other_units().map(|unit| format!("\"{}\"", unit.symbol())).collect();
                        let unit = format!("unit = {}", units.join(" or "));
                        let line = curve_line(self.measure, !self.file.branches.is_empty(), &unit);
                        format!(
                            ": {unlikely}. If so, write {line} (and in the head of the file, if it says another), or \
                             convert numbers in any other unit. If not, {}",
                            so.to_lowercase()
                        )
                    },
                );
            format!("{name}: the curve {span}{therefore} {remedy}")
        })
    }
}
