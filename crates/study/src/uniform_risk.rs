//! A study of uniform risk spectra (Chapter 4 of Reggiani Manzo's dissertation).
//!
//! | module | section |
//! |---|---|
//! | `records` | `[records]` |
//! | `oscillator` | `[oscillator]` |
//! | `uncertainty` | `[uncertainty]`: what of the oscillator is not known exactly |
//! | `measures`, `default_levels`, `lower_levels` | `[pgv]`, `[pga]`, `[measures.…]`, their levels and lower ones |
//! | `risk` | `[risk]` |
//! | `hazard` | `[hazard]` |
//! | `sites`, `curve`, `branches` | `[[sites]]`, the hazard curves of one, their weighted alternatives |
//! | `site_table` | `[site_table]` |
//! | `regression` | `[regression]` |
//! | `bootstrap` | `[bootstrap]` |
//! | `consistency` | `[consistency]` |

mod bootstrap;
mod branches;
mod consistency;
mod curve;
mod default_levels;
mod hazard;
mod lower_levels;
mod measures;
mod oscillator;
mod records;
mod regression;
mod risk;
mod rotation;
mod site_table;
mod sites;
mod uncertainty;
mod warnings;

use std::collections::BTreeSet;

use serde::Serialize;
use uplift_bootstrap::Unit;
use uplift_motion::{Component, IntensityMeasure, Rotation};

use crate::grid::Grid;
use crate::keys::{Integer, Key, SectionKeys, Shape};
use crate::reading::{Paths, Section};
use crate::sections::output::{self, Output};
use crate::sections::stiffness;
use crate::sections::uncertainty::{Uncertainty, UncertaintyKind};
use crate::sections::{self, record_source, selection, strengths, top};
use crate::warning::Warning;

pub use bootstrap::Bootstrap;
pub use branches::Branch;
pub use consistency::{Consistency, Repair};
pub use curve::{CurveFile, CurveKind};
pub use hazard::{Conversion, Hazard, definition_of};
pub use lower_levels::{levels_key, levels_place, lower_starts};
pub use measures::MeasurePlan;
pub use oscillator::Oscillator;
pub(crate) use oscillator::{FREE_VIBRATION, RESTITUTION};
pub use records::Records;
pub use regression::Regression;
pub use risk::{Contour, Risk};
pub use site_table::{ExportFiles, SiteSlice, SiteTable};
pub use sites::Site;
pub use warnings::usual_top_level;

/// Every key.
pub(crate) const KEYS: [SectionKeys; 32] = [
    TOP,
    records::KEYS,
    rotation::KEYS,
    selection::KEYS,
    record_source::SYNTHETIC_KEYS,
    oscillator::KEYS,
    sections::uncertainty::KEYS,
    sections::uncertainty::QUANTITY_KEYS,
    sections::uncertainty::CORRELATION_KEYS,
    strengths::KEYS,
    measures::PGV_KEYS,
    measures::PGA_KEYS,
    measures::SA_KEYS,
    measures::PGD_KEYS,
    measures::SI_KEYS,
    measures::CAV_KEYS,
    measures::ARIAS_KEYS,
    risk::KEYS,
    hazard::KEYS,
    hazard::CONVERSION_KEYS,
    sites::KEYS,
    SectionKeys::new("sites.pgv", curve::KEYS).shape(Shape::FileOrTable),
    SectionKeys::new("sites.pga", curve::KEYS).shape(Shape::FileOrTable),
    SectionKeys::new("sites.sa_1s", curve::KEYS).shape(Shape::FileOrTable),
    SectionKeys::new("sites.pgv.branches", branches::KEYS).shape(Shape::List),
    SectionKeys::new("sites.pga.branches", branches::KEYS).shape(Shape::List),
    SectionKeys::new("sites.sa_1s.branches", branches::KEYS).shape(Shape::List),
    site_table::KEYS,
    regression::KEYS,
    bootstrap::KEYS,
    consistency::KEYS,
    output::KEYS,
];

const TOP: SectionKeys = SectionKeys::new("", &[&top::KIND, &top::TITLE, &SEED, &top::GRAVITY]);
const SEED: Key<Integer> = top::seed(1)
    .meaning("seed of what is drawn at random: the component where it is `\"random\"`, the azimuth of a pair");

/// A study of uniform risk spectra with every default filled in, every path found and every unit checked.
///
/// It is serialised as a study file that loads to an equal value, wherever it is stored.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UniformRiskStudy {
    /// Free text.
    pub title: String,
    /// Seed of whatever is drawn at random; below 2⁶³.
    pub seed: u64,
    /// Acceleration of gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// Which ground motions.
    pub records: Records,
    /// The oscillator but for its strength.
    pub oscillator: Oscillator,
    /// What of the oscillators is not known exactly; a strength scatters about each of `strengths`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<Uncertainty>,
    /// Uplift strengths η = `f_up`/(m g) \[-\].
    #[serde(serialize_with = "strengths::write")]
    pub strengths: Grid,
    /// Intensity measures with the levels that records are scaled to; at least one.
    #[serde(flatten, serialize_with = "measures::write")]
    pub measures: Vec<MeasurePlan>,
    /// Probabilities, and how the spectrum is read from the risk integral.
    pub risk: Risk,
    /// What the hazard curves have in common.
    #[serde(skip_serializing_if = "Hazard::is_empty")]
    pub hazard: Hazard,
    /// Sites; each has a curve of each measure in `measures`.
    pub sites: Vec<Site>,
    /// Many sites, their hazard in exports.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub site_table: Option<SiteTable>,
    /// The fit of Eq. 4.11.
    pub regression: Regression,
    /// The bootstrap over records.
    pub bootstrap: Bootstrap,
    /// Whether the records bring the hazard of the other measure, and what is done about it.
    #[serde(skip_serializing_if = "Consistency::is_default")]
    pub consistency: Consistency,
    /// What is written where.
    pub output: Output,
    /// What is allowed but probably not meant.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}

impl UniformRiskStudy {
    /// The measures beside PGV and PGA that the study needs of its records: those that it is analysed by, and those
    /// with a hazard curve.
    pub fn further_measures(&self) -> Vec<IntensityMeasure> {
        let analysed = self.measures.iter().map(|plan| plan.measure);
        let of_sites = self.sites.iter().flat_map(|site| site.curves.iter().map(|curve| curve.measure));
        let of_table = self.site_table.iter().flat_map(|table| table.exports.iter().map(|own| own.measure));
        let all: BTreeSet<IntensityMeasure> = analysed.chain(of_sites).chain(of_table).collect();
        all.into_iter().filter(|measure| !measure.is_of_chapter_4()).collect()
    }

    /// The key of the site of this `name` in an override that a shell takes in single quotes: `sites.Athens`,
    /// `sites."Sion 2.1"`; its position where the name holds what ends the quotes or the key.
    pub fn key_of_site(&self, name: &str) -> String {
        let position = self.sites.iter().position(|site| site.name == name);
        match position.filter(|_| name.contains(['\'', '='])) {
            Some(position) => format!("sites.{position}"),
            None if name.contains(['.', '[']) => format!("sites.\"{name}\""),
            None => format!("sites.{name}"),
        }
    }

    /// Structures that each motion shakes: as many records are made of it.
    pub fn structures_of_a_motion(&self) -> usize {
        let Some(uncertainty) = &self.uncertainty else { return 1 };
        match uncertainty.kind {
            // structures that are all alike are one
            _ if uncertainty.is_known() => 1,
            UncertaintyKind::Epistemic => uncertainty.samples,
            UncertaintyKind::Aleatory => uncertainty.draws,
        }
    }

    /// Records that are made of a pair: of its components or azimuths, and of the structures that each shakes.
    pub fn records_of_a_pair(&self) -> usize {
        self.records.component.records_per_pair() * self.structures_of_a_motion()
    }

    /// The name of the pair that the record `id` is made of: what a record is of its pair, and which structure it
    /// shakes, follow it.
    pub fn pair_of_record<'a>(&self, id: &'a str) -> &'a str {
        let directions = usize::from(self.records.component.records_per_pair() > 1);
        let suffixes = directions + usize::from(self.structures_of_a_motion() > 1);
        (0..suffixes).try_fold(id, |id, _| Some(id.rsplit_once(':')?.0)).unwrap_or(id)
    }

    /// What the bootstrap draws where `asked` is asked for, else what the study says: records of the azimuths of a
    /// pair, or of its structures, are never drawn apart.
    pub fn drawn_unit(&self, asked: Option<Unit>) -> Unit {
        match asked.unwrap_or(self.bootstrap.unit) {
            Unit::Record if self.keeps_pairs_together() => Unit::Pair,
            unit => unit,
        }
    }

    /// Whether the records of a pair tell no more than the pair does: those of its azimuths, and of its structures.
    pub fn keeps_pairs_together(&self) -> bool {
        matches!(self.records.component, Component::Rotated(Rotation::Each { .. })) || self.structures_of_a_motion() > 1
    }
}

/// A mistake unless a site, or the table of many, has a curve of the measure that the consistency is asked against.
fn require_curve(root: &Section<'_>, against: IntensityMeasure, sites: &[Site], table: Option<&SiteTable>) {
    let is_of_table = table.is_some_and(|table| table.export(against).is_some());
    let has_sites = !sites.is_empty() || table.is_some();
    if has_sites && !is_of_table && !sites.iter().any(|site| site.curve(against).is_some()) {
        root.mistake(
            "consistency.against",
            format!("no site has a curve of {}", against.label()),
            format!("add {} = \"path of the curve\" to a site, or name another measure", against.key()),
        );
    }
}

/// Reads the whole study but for its `kind`; none where something is wrong.
pub(crate) fn read(mut root: Section<'_>, paths: &Paths) -> Option<UniformRiskStudy> {
    let title = root.read(&top::TITLE);
    let seed = root.read(&SEED);
    let gravity = root.read(&top::GRAVITY);
    let records = records::read(root.section("records"), paths);
    let oscillator = oscillator::read(root.section("oscillator"));
    let uncertainty = root.section("uncertainty");
    let is_uncertain = uncertainty.is_present();
    let uncertainty = uncertainty::read(uncertainty, oscillator.as_ref());
    let names_levels = records.as_ref().is_some_and(|records| records.at_level.is_some());
    if is_uncertain && names_levels {
        uncertainty::refuse_sets_of_levels(&root);
    }
    let strengths = strengths::read(root.section("strengths"));
    let (switched_on, measures) = measures::read(&mut root);
    let risk = risk::read(root.section("risk"));
    let hazard = hazard::read(root.section("hazard"));
    let sites = sites::read(root.field("sites"), &switched_on, paths);
    let site_table = site_table::read(root.field("site_table").as_ref(), &switched_on, strengths.as_ref(), paths);
    let regression = regression::read(root.section("regression"));
    let bootstrap = bootstrap::read(root.section("bootstrap"));
    let consistency = consistency::read(root.section("consistency"));
    if let (Some(against), Some(sites)) = (consistency.as_ref().and_then(|of| of.against), &sites) {
        require_curve(&root, against, sites, site_table.as_ref().and_then(Option::as_ref));
    }
    if let Some(several) = measures.as_ref().map(Vec::len).filter(|&number| names_levels && number != 1) {
        root.mistake(
            "records.at_level",
            format!("the table has levels of one measure, and the study has {several}"),
            "leave one of them in the study: a study each for the sets of the others",
        );
    }
    let inputs = (records.iter().flat_map(Records::files))
        .chain(sites.iter().flatten().flat_map(|site| site.curves.iter().flat_map(CurveFile::files)))
        .chain(site_table.iter().flatten().flat_map(SiteTable::files));
    let output = output::read(root.section("output"), paths, inputs);
    if let (Some(oscillator), Some(strengths), Some(gravity)) = (&oscillator, &strengths, gravity)
        && let Some(strongest) = strengths.last()
    {
        let system = (*strongest, gravity, oscillator.uplift_displacement_m, oscillator.restitution);
        stiffness::check(&root, system, oscillator.post_uplift);
    }
    root.finish();
    let (uncertainty, doubts) = uncertainty?;
    let mut study = UniformRiskStudy {
        title: title?,
        seed: seed?,
        gravity_m_s2: gravity?,
        records: records?,
        oscillator: oscillator?,
        uncertainty,
        strengths: strengths?,
        measures: measures?,
        risk: risk?,
        hazard: hazard?,
        sites: sites?,
        site_table: site_table?,
        regression: regression?,
        bootstrap: bootstrap?,
        consistency: consistency?,
        output: output?,
        warnings: Vec::new(),
    };
    study.warnings = warnings::from_study(&study);
    study.warnings.extend(doubts);
    Some(study)
}
