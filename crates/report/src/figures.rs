//! The figures of Chapters 2 to 4, made of a result file alone; and those of a record, a structure or a pulse, which
//! need none.
//!
//! What is to be seen is decided here, how it is drawn in [`plot`](uplift_plot).

mod confidence;
mod demand;
mod displacement;
mod efficiency;
mod history;
mod overturning;
mod pulses;
mod spectra;

pub use displacement::{Extent, displacement_figures};
pub use history::{block_history_figure, history_figure};
pub use overturning::overturning_figure;
pub use pulses::pulse_figures;
pub use spectra::hazard_figure;

use std::path::Path;

use uplift::Array;
use uplift::UpliftError;
use uplift::result::{Kind, ResultFile, StoredBands, StoredHazard, StoredRecords, StoredSpectra, StoredStripes};
use uplift_motion::IntensityMeasure;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

/// The figures of the result at `path`, of either kind.
///
/// # Errors
/// A file that is missing, damaged or no result.
pub fn result_figures(path: &Path) -> Result<Vec<Figure>, UpliftError> {
    let file = ResultFile::open(path)?;
    match file.kind() {
        Kind::UniformRisk => FigureSource::read(&file)?.figures(),
        Kind::Displacement => displacement_figures(&file, &file.displacements()?, Extent::All),
    }
}

/// A result of uniform risk spectra, read for its figures.
pub struct FigureSource {
    pub(crate) stored: StoredStripes,
    pub(crate) spectra: StoredSpectra,
    pub(crate) bands: Option<StoredBands>,
    hazard: Vec<StoredHazard>,
    records: StoredRecords,
    remark: &'static str,
}

impl FigureSource {
    /// Read what the figures of `file` show.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites.
    pub fn read(file: &ResultFile) -> Result<Self, UpliftError> {
        Ok(Self {
            stored: file.stripes()?,
            spectra: file.spectra()?,
            bands: file.bands()?,
            hazard: file.hazard()?,
            records: file.records()?,
            remark: if file.head()?.synthetic { SYNTHETIC } else { "" },
        })
    }

    /// The spectra `[site, poe, strength]` of `measure` as the result has them, m.
    pub(crate) fn u_m(&self, measure: IntensityMeasure) -> Option<&Array<3>> {
        self.spectra.measures.iter().find(|spectra| spectra.measure == measure).map(|spectra| &spectra.u_m)
    }

    /// Every figure that the result has the numbers for, in the order of the chapter.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn figures(&self) -> Result<Vec<Figure>, UpliftError> {
        let mut figures = Vec::new();
        figures.push(spectra::hazard(self));
        figures.extend(demand::ida_curves(self)?);
        figures.extend(demand::fragilities(self)?);
        figures.extend(demand::risk_curves(self)?);
        figures.extend(demand::risk_surfaces(self)?);
        figures.extend(spectra::spectra(self));
        figures.extend(spectra::fits(self));
        figures.extend(confidence::bands(self));
        figures.extend(confidence::measures_together(self));
        figures.extend(confidence::initiation(self));
        figures.push(efficiency::efficiency(self)?);
        Ok(figures)
    }

    fn figure(
        &self,
        id: impl Into<String>,
        title: impl Into<String>,
        caption: impl Into<String>,
        panels: Vec<Panel>,
    ) -> Figure {
        let columns = if panels.len() > 4 { 3 } else { panels.len().min(2) };
        Figure {
            id: id.into(),
            title: title.into(),
            caption: caption.into(),
            remark: self.remark.to_owned(),
            panels,
            columns,
        }
    }

    /// A line over the strengths.
    fn over_strengths(&self, name: impl Into<String>, values: &[f64], tone: Tone) -> Series {
        Series::line(name, self.stored.strengths.iter().copied().zip(values.iter().copied()).collect(), tone)
    }

    /// Positions of the sites shown: the first nine.
    fn sites(&self) -> std::ops::Range<usize> {
        0..self.stored.sites.len().min(9)
    }

    /// Position of the smallest probability.
    fn rarest(&self) -> usize {
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

/// What figures of synthetic records say.
const SYNTHETIC: &str = "synthetic records: not for design";
/// Label of the strength axis.
const STRENGTH: &str = "uplift strength f_up/(m g)";
