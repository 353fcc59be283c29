//! What overturning comes to: fragility and risk of each model by each measure.

use std::path::PathBuf;

use serde::Serialize;
use uplift_fragility::LognormalFit;
use uplift_ida::{PLANAR_FRAME, System, WOBBLING_FRAME};
use uplift_job::alarm::Alarm;
use uplift_motion::IntensityMeasure;
use uplift_spectra::Noisy;
use uplift_uniform_risk::{EventRisk, SpectraOfResult};

use crate::certainty::Bands;
use crate::collapse::Collapse;
use crate::limit::{FrameLimit, LimitRisk};
use crate::report::{ReportSource, StructureReport};
use crate::uncertain::UncertaintyReport;

/// The report of the overturning of a structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverturningReport {
    /// The structure; each model has its own restitution.
    pub structure: StructureReport,
    /// The result that it was examined under.
    #[serde(flatten)]
    pub source: ReportSource,
    /// Years that probabilities refer to.
    pub years: f64,
    /// How the structure is modelled.
    pub models: Vec<ModelReport>,
    /// What a frame must not pass before it overturns; none of a structure that is not shaken as one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<FrameLimit>,
    /// Fragility and risk, one a measure and model, in this order.
    pub overturning: Vec<CollapseReport>,
    /// The oscillator where its quantities are not known exactly; none where the structure file says that they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyReport>,
    /// Whether it is judged by its oscillator alone, though a frame or block models it itself.
    pub by_proxy: bool,
    /// Why the structure itself is left out although no `--proxy` asks for that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_own: Option<String>,
    /// How the models differ, and what could not be done.
    pub notes: Vec<String>,
    /// What to know before using the numbers, the worst first.
    pub alarms: Vec<Alarm>,
    /// What was written.
    #[serde(skip)]
    pub files: Vec<PathBuf>,
}

impl OverturningReport {
    /// The risks site by site, each with its measure and model and the position of the site.
    pub fn by_site(&self) -> impl Iterator<Item = (&SiteRisk, &CollapseReport, usize)> {
        let sites = self.overturning.first().map_or(0, |found| found.sites.len());
        (0..sites).flat_map(|place| self.overturning.iter().map(move |found| (&found.sites[place], found, place)))
    }

    /// The limit, where passing it and not overturning tells how often the frame fails.
    pub fn governing_limit(&self) -> Option<FrameLimit> {
        let governs = |of: &SiteRisk| of.beyond_limit.is_some_and(|limit| limit.governs(&of.risk));
        let frame = self.frame()?;
        let own = self.overturning.iter().filter(|found| found.model == frame);
        self.limit.filter(|_| own.flat_map(|found| &found.sites).any(governs))
    }

    /// The model of a frame that decides; none of a structure that is not shaken as one.
    pub fn frame(&self) -> Option<&'static str> {
        let has = |frame: &&str| self.models.iter().any(|of| of.model == *frame);
        [WOBBLING_FRAME, PLANAR_FRAME].into_iter().find(has)
    }

    /// Whether it is a frame under both components.
    pub fn wobbles(&self) -> bool {
        self.frame() == Some(WOBBLING_FRAME)
    }
}

/// A model of a structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelReport {
    /// `oscillator`, `block`, `equivalent block`, `wobbling frame` or `planar frame`.
    pub model: &'static str,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Where that comes from.
    pub restitution_from: &'static str,
    /// Half diagonal R of the block, m; none for the oscillator.
    pub size_m: Option<f64>,
    /// Slenderness α of the block, rad; none for the oscillator.
    pub slenderness_rad: Option<f64>,
}

/// Overturning of one model by one measure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CollapseReport {
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Unit of the levels.
    pub unit: &'static str,
    /// `oscillator`, `block`, `equivalent block`, `wobbling frame` or `planar frame`.
    pub model: &'static str,
    /// Levels of the stripes, ascending.
    pub levels: Vec<f64>,
    /// Records that overturn the structure at each level.
    pub overturned: Vec<u32>,
    /// Fewest and most of them with all scale factors up to 4e-15 smaller and larger: another count than the one above
    /// hangs on runs beyond double precision (docs/method.md, section 1.5). None where this is not asked for, and of a
    /// frame; so are the other ranges.
    pub overturned_rounding: Option<Vec<[u32; 2]>>,
    /// Records.
    pub records: u32,
    /// Median of the lognormal fragility of maximum likelihood; none where there is no fit.
    pub theta: Option<f64>,
    /// Its dispersion.
    pub beta: Option<f64>,
    /// The median with its range over the same scale factors; NaN where one of them has no fit.
    pub theta_rounding: Option<Noisy>,
    /// The dispersion with its range.
    pub beta_rounding: Option<Noisy>,
    /// Its logarithmic likelihood.
    pub log_likelihood: Option<f64>,
    /// The risk at each site.
    pub sites: Vec<SiteRisk>,
    /// The fit itself.
    #[serde(skip)]
    pub fit: Option<LognormalFit>,
}

/// The risk of overturning at one site.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SiteRisk {
    /// The site.
    pub site: String,
    /// From the counts, with no curve fitted.
    #[serde(flatten)]
    pub risk: EventRisk,
    /// Its confidence band by the records; none where no run shows it, and of a single record.
    pub bands: Option<Bands>,
    /// How often the limit of a frame is passed; none without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_limit: Option<LimitRisk>,
    /// From the counts with repaired weights, by which the records bring the site's hazard; none where the result has
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repaired: Option<EventRisk>,
    /// How sure that is; none where there is none, and where no run shows it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repaired_bands: Option<Bands>,
    /// Frequency with the lognormal fragility in place of the counts, 1/yr; none without a fit.
    pub lognormal_per_year: Option<f64>,
    /// Its confidence band by the records; none without a fit, where that hangs on one record, and of a single one.
    pub lognormal_bands: Option<Bands>,
    /// The frequency from the counts with its range over scale factors up to 4e-15 smaller and larger, 1/yr.
    pub per_year_rounding: Option<Noisy>,
    /// That with the lognormal fragility; NaN where one of them has no fit.
    pub lognormal_per_year_rounding: Option<Noisy>,
}

/// Overturning at the scale factors themselves, and at their neighbours some roundings away.
pub(super) struct Collapses {
    pub(super) own: Collapse,
    /// None of a frame, whose neighbours are not analysed.
    pub(super) rounded: Vec<Collapse>,
    /// How sure its risks are, `[site]`.
    pub(super) bands: Vec<Option<Bands>>,
    /// How often the limit of a frame is passed, `[site]`; empty of a model that is not held against one.
    pub(super) beyond_limit: Vec<LimitRisk>,
    /// The bands of the risks with repaired weights.
    pub(super) repaired_bands: Vec<Option<Bands>>,
    /// The same of those by the lognormal fragility.
    pub(super) lognormal_bands: Vec<Option<Bands>>,
}

/// Overturning of a frame by each of its models.
pub(super) type FrameCollapses = Vec<(&'static str, Collapses)>;

/// The rows of a report: by each measure the models, those of the frame last.
pub(super) fn reports(
    (found, of_frame): (&[(&SpectraOfResult, Vec<Collapses>)], &[FrameCollapses]),
    kinds: &[&'static str],
    records: u32,
    sites: &[&str],
) -> Vec<CollapseReport> {
    let of_measure = |(place, (measure, found)): (usize, &(&SpectraOfResult, Vec<Collapses>))| {
        let own = found.iter().zip(kinds.iter().copied());
        let of_frame = of_frame.get(place).into_iter().flatten().map(|(model, found)| (found, *model));
        let report = |(found, model)| CollapseReport::from_collapse(found, measure.measure(), model, records, sites);
        own.chain(of_frame).map(report).collect::<Vec<_>>()
    };
    found.iter().enumerate().flat_map(of_measure).collect()
}

impl ModelReport {
    pub(super) fn from_model((model, kind, restitution_from): (&System, &'static str, &'static str)) -> Self {
        let block = match model {
            System::Oscillator(_) | System::Frame(_) => None,
            System::Block(block) => Some(block),
        };
        Self {
            model: kind,
            restitution: model.restitution(),
            restitution_from,
            size_m: block.map(uplift_block::RockingBlock::size_m),
            slenderness_rad: block.map(uplift_block::RockingBlock::slenderness_rad),
        }
    }
}

impl CollapseReport {
    fn from_collapse(
        Collapses { own, rounded, bands, beyond_limit, repaired_bands, lognormal_bands }: &Collapses,
        measure: IntensityMeasure,
        model: &'static str,
        records: u32,
        sites: &[&str],
    ) -> Self {
        let around = |value: &dyn Fn(&Collapse) -> f64| {
            (!rounded.is_empty()).then(|| Noisy::around(value(own), rounded.iter().map(value)))
        };
        let fit = own.fit.as_ref().ok();
        let of_fit = |value: &dyn Fn(&LognormalFit) -> f64| {
            fit.and_then(|_| around(&|found| found.fit.as_ref().map_or(f64::NAN, value)))
        };
        let site = |(index, site): (usize, &&str)| SiteRisk {
            site: (*site).to_owned(),
            risk: own.risks[index],
            bands: bands[index],
            beyond_limit: beyond_limit.get(index).copied(),
            repaired: own.repaired[index],
            repaired_bands: repaired_bands[index],
            lognormal_per_year: own.fitted.as_ref().map(|fitted| fitted[index].per_year),
            lognormal_bands: lognormal_bands[index],
            per_year_rounding: around(&|found| found.risks[index].per_year),
            lognormal_per_year_rounding: own
                .fitted
                .as_ref()
                .and_then(|_| around(&|found| found.fitted.as_ref().map_or(f64::NAN, |fitted| fitted[index].per_year))),
        };
        let count = |found: &Collapse, level: usize| found.counts[level].exceedances;
        let counts_at = |level: usize| {
            let counts = rounded.iter().map(move |found| count(found, level));
            counts.fold([count(own, level); 2], |[fewest, most], other| [fewest.min(other), most.max(other)])
        };
        Self {
            im: measure.label(),
            unit: measure.unit(),
            model,
            levels: own.counts.iter().map(|count| count.level).collect(),
            overturned: own.counts.iter().map(|count| count.exceedances).collect(),
            overturned_rounding: (!rounded.is_empty()).then(|| (0..own.counts.len()).map(counts_at).collect()),
            records,
            theta: fit.map(|fit| fit.fragility.median()),
            beta: fit.map(|fit| fit.fragility.dispersion()),
            theta_rounding: of_fit(&|fit| fit.fragility.median()),
            beta_rounding: of_fit(&|fit| fit.fragility.dispersion()),
            log_likelihood: fit.map(|fit| fit.log_likelihood),
            sites: sites.iter().enumerate().map(site).collect(),
            fit: fit.copied(),
        }
    }
}
