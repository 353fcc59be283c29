//! The figures of Chapters 2 to 4, and more, made of a result file alone; and those of a record, a structure or a
//! pulse, which need none.
//!
//! What is to be seen is decided here, how it is drawn in [`plot`](uplift_plot).

mod columns;
mod confidence;
mod consistency;
mod demand;
mod displacement;
mod efficiency;
mod frame;
mod frame_risk;
mod history;
mod influence;
mod library;
mod overturning;
mod pulses;
mod shake_table;
mod sites;
mod spectra;
mod spread;
mod sweep;
mod tails;
mod together;
mod validation;

pub use columns::{column_figures, protocol_figure, pushover_figure, restrainer_figure};
pub use displacement::{Extent, displacement_figures};
pub use frame::frame_figure;
pub use frame_risk::frame_risk_figure;
pub use history::{block_history_figure, history_figure};
pub(crate) use library::LIBRARY_FIGURES;
pub use library::library_figures;
pub use overturning::overturning_figure;
pub use pulses::pulse_figures;
pub use shake_table::shake_table_figures;
use sites::site_maps;
pub use spectra::hazard_figure;
pub use sweep::sweep_figure;
pub(crate) use together::together;
pub use validation::{distributions_figure, pairs_figure};

use std::path::Path;

use uplift::result::{
    Kind, ResultFile, SiteArrays, StoredBands, StoredConsistency, StoredHazard, StoredInfluence, StoredRecords,
    StoredSpectra, StoredSpread, StoredStripes,
};
use uplift::text::risks_in_words;
use uplift::uniform_risk::{BandOf, QuotedUnits};
use uplift::{Array, JobError, UpliftError};
use uplift_motion::IntensityMeasure;
use uplift_plot::{Axis, Band, Figure, Panel, Series, Tone, share_y};

/// The figures of the result at `path`, of either kind.
///
/// - `strengths`: those of its maps of many sites; a few if empty.
///
/// # Errors
/// A file that is missing, damaged or no result; strengths that its sites do not have, or of a result without maps.
pub fn result_figures(path: &Path, strengths: &[f64]) -> Result<Vec<Figure>, UpliftError> {
    let file = ResultFile::open(path)?;
    if !strengths.is_empty() && (file.kind() != Kind::UniformRisk || !SiteArrays::path(path).is_file()) {
        return Err(JobError::Usage("--strength is of maps: the result has no table of sites".to_owned()).into());
    }
    match file.kind() {
        Kind::UniformRisk => {
            let maps = site_maps(path, &file, strengths, remark(file.head()?.synthetic))?;
            if !maps.is_empty() && file.axes()?.sites.is_empty() {
                return Ok(maps);
            }
            Ok([FigureSource::read(&file)?.figures(Extent::All)?.into_all(), maps].concat())
        }
        Kind::Displacement => displacement_figures(&file, &file.displacements()?, Extent::All),
        Kind::ShakeTable => Ok(shake_table_figures(&file.shake_table()?)),
    }
}

/// A result of uniform risk spectra, read for its figures.
pub struct FigureSource {
    pub(crate) stored: StoredStripes,
    pub(crate) spectra: StoredSpectra,
    pub(crate) bands: Option<StoredBands>,
    /// What the quoted bands of each measure take for independent.
    pub(crate) band_of: Vec<BandOf>,
    pub(crate) spreads: Vec<StoredSpread>,
    pub(crate) influence: Vec<StoredInfluence>,
    pub(crate) consistency: Vec<StoredConsistency>,
    pub(crate) least_effective: Vec<Option<Vec<f64>>>,
    hazard: Vec<StoredHazard>,
    records: StoredRecords,
    remark: &'static str,
}

/// The figures of a result of uniform risk spectra, by what they answer.
pub struct RiskFigures {
    /// How far do structures move?
    pub answer: Vec<Figure>,
    /// How sure is that?
    pub confidence: Vec<Figure>,
    /// Where does it come from?
    pub causes: Vec<Figure>,
    /// Curves fitted to it, to compute with.
    pub fits: Vec<Figure>,
}

impl RiskFigures {
    /// All of them, in their order.
    pub fn into_all(self) -> Vec<Figure> {
        [self.answer, self.confidence, self.causes, self.fits].concat()
    }
}

impl FigureSource {
    /// Read what the figures of `file` show.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites.
    pub fn read(file: &ResultFile) -> Result<Self, UpliftError> {
        let consistency = file.consistency()?;
        let least = consistency.iter().map(|of| uplift::consistency::least_effective(file, of));
        Ok(Self {
            stored: StoredStripes::read(file)?,
            spectra: file.spectra()?,
            bands: file.bands()?,
            band_of: QuotedUnits::from_file(file)?.iter().map(|units| units.of).collect(),
            spreads: file.spreads()?,
            // of the risks of its study alone
            influence: if file.is_at_target_risks() { Vec::new() } else { file.influence()? },
            least_effective: least.collect::<Result<_, _>>()?,
            consistency,
            hazard: file.hazard()?,
            records: file.records()?,
            remark: remark(file.head()?.synthetic),
        })
    }

    /// The spectra `[site, poe, strength]` of `measure` as the result has them, m.
    pub(crate) fn u_m(&self, measure: IntensityMeasure) -> Option<&Array<3>> {
        self.spectra.measures.iter().find(|spectra| spectra.measure == measure).map(|spectra| &spectra.u_m)
    }

    /// The spectra `[site, poe, strength]` of weighted records, m, of a site whose hazard the records do not have
    /// without weights.
    pub(crate) fn repaired(&self, measure: IntensityMeasure, site: usize) -> Option<&Array<3>> {
        let stands = |of: &&StoredConsistency| of.scaled_to == measure && of.stands_beside(site);
        self.consistency.iter().find(stands)?.u_m.as_ref()
    }

    /// The figures that the result has the numbers for: all, or about ten for the page.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn figures(&self, extent: Extent) -> Result<RiskFigures, UpliftError> {
        let mut answer: Vec<Figure> = spectra::sites(self).into_iter().collect();
        answer.extend(spectra::spectra(self));
        let mut confidence = confidence::measures_together(self);
        confidence.extend(spread::spreads(self));
        confidence.extend(consistency::consistency(self));
        let mut causes = vec![spectra::hazard(self)];
        // the page has what is of one measure of the first
        let shown = if extent == Extent::All { usize::MAX } else { 1 };
        causes.extend(influence::disaggregation(self).into_iter().take(shown));
        causes.extend(influence::influence(self).into_iter().take(shown));
        causes.extend(demand::risk_curves(self)?.into_iter().take(shown));
        if extent == Extent::All {
            confidence.extend(confidence::bands(self));
            confidence.extend(confidence::initiation(self));
            confidence.push(demand::fragilities(self)?);
            confidence.extend(tails::tail_shares(self));
            causes.extend(demand::risk_surfaces(self)?);
            causes.push(demand::ida_curves(self)?);
            // structures of a motion are no more observations than the motion is: as `uplift measures` has it
            if self.stored.units.structures_of_a_motion == 1 {
                causes.push(efficiency::efficiency(self)?);
            }
        }
        Ok(RiskFigures { answer, confidence, causes, fits: spectra::fits(self).into_iter().collect() })
    }

    fn figure(
        &self,
        id: impl Into<String>,
        title: impl Into<String>,
        caption: impl Into<String>,
        mut panels: Vec<Panel>,
    ) -> Figure {
        // the sites are compared: what lies higher must be larger
        share_y(&mut panels);
        let columns = if panels.len() > 4 { 3 } else { panels.len().min(2) };
        Figure { columns, ..Figure::new(id, title, caption, panels).with_remark(self.remark) }
    }

    /// A line over the strengths.
    fn over_strengths(&self, name: impl Into<String>, values: &[f64], tone: Tone) -> Series {
        Series::sampled(name, self.stored.strengths.iter().copied().zip(values.iter().copied()).collect(), tone)
    }

    /// Lines at the target rates of the spectra between two ends, with one name.
    fn targets(&self, (from, to): (f64, f64), tone: Tone) -> impl Iterator<Item = Series> {
        let stored = &self.stored;
        let name = format!("targets: {}", risks_in_words(&stored.poes, stored.years, ", "));
        let names = std::iter::once(name).chain(std::iter::repeat(String::new()));
        let line = move |(&rate, name): (&f64, String)| Series::line(name, vec![(from, rate), (to, rate)], tone);
        stored.targets_per_year.iter().zip(names).map(line)
    }

    /// An area between two lines over the strengths.
    fn between(&self, lower: &[f64], upper: &[f64], tone: Tone) -> Band {
        let limits = self.stored.strengths.iter().zip(lower.iter().zip(upper));
        let points = limits.map(|(&eta, (&low, &high))| (eta, low, high)).collect();
        Band { name: String::new(), points, tone }
    }

    /// Positions of the sites shown: the first nine.
    pub(crate) fn sites(&self) -> std::ops::Range<usize> {
        0..self.stored.sites.len().min(9)
    }

    /// Position of the smallest probability.
    pub(crate) fn rarest(&self) -> usize {
        let poes = &self.stored.poes;
        (0..poes.len()).min_by(|&a, &b| poes[a].total_cmp(&poes[b])).unwrap_or_default()
    }
}

/// An axis from the first to the last value.
fn spanned(axis: Axis, values: &[f64]) -> Axis {
    match values {
        [first, .., last] => axis.between(*first, *last),
        _ => axis,
    }
}

/// What figures of synthetic records say; those of others say nothing.
fn remark(is_synthetic: bool) -> &'static str {
    if is_synthetic { "synthetic records: not for design" } else { "" }
}

/// Label of the strength axis.
const STRENGTH: &str = "uplift strength η = f_{up}/(m g)";
/// Label of an axis of peak displacements.
const DISPLACEMENT: &str = "displacement u_{max}, m";
