//! What other programs take: formats of fragilities, and intensity measures by their names and units.

use clap::ValueEnum;
use uplift_fragility::{PelicunDemand, pelicun_demand};
use uplift_job::JobError;
use uplift_motion::IntensityMeasure;

/// Formats of fragilities.
#[expect(clippy::doc_markdown, reason = "what completions show has no backticks")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FragilityFormat {
    /// A fragility model of OpenQuake (NRML 0.5): counted shares, and lognormal functions of them.
    #[value(name = "openquake")]
    OpenQuake,
    /// A fragility table of pelicun 3: counted shares, and lognormal functions of them.
    Pelicun,
    /// A tidy table, a row each level, and another of the fits.
    Csv,
}

/// A measure of another program.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Foreign {
    /// Its name there.
    pub(crate) name: String,
    /// Its value there over its value here.
    pub(crate) factor: f64,
}

/// Refuses a measure that the program of `format` does not have.
///
/// # Errors
/// [`JobError::Usage`] for such a measure.
pub(super) fn check(measure: IntensityMeasure, format: FragilityFormat) -> Result<(), JobError> {
    let (is_known, program) = match format {
        FragilityFormat::OpenQuake => (openquake(measure).is_some(), "OpenQuake"),
        FragilityFormat::Pelicun => (pelicun(measure).is_some(), "pelicun"),
        FragilityFormat::Csv => return Ok(()),
    };
    is_known.then_some(()).ok_or_else(|| {
        JobError::Usage(format!("--fragility: {program} has no {}: choose another with --measure", measure.long_name()))
    })
}

/// The intensity measure type of `OpenQuake` 3.26 (`openquake.hazardlib.imt`); none where it has none.
pub(super) fn openquake(measure: IntensityMeasure) -> Option<Foreign> {
    let of = |name: &str, factor| Some(Foreign { name: name.to_owned(), factor });
    match measure {
        IntensityMeasure::Pgv => of("PGV", 1.0),
        IntensityMeasure::Pga => of("PGA", 1.0),
        IntensityMeasure::Sa(_) => of(measure.label(), 1.0),
        IntensityMeasure::AvgSa { .. } => of("AvgSA", 1.0),
        IntensityMeasure::Pgd => of("PGD", 1.0),
        IntensityMeasure::Cav => of("CAV", 1.0 / 980.665),
        IntensityMeasure::Arias => of("IA", 0.01),
        IntensityMeasure::SpectrumIntensity | IntensityMeasure::D575 | IntensityMeasure::D595 => None,
    }
}

/// The demand type of pelicun 3; none where it has none.
pub(crate) fn pelicun(measure: IntensityMeasure) -> Option<PelicunDemand> {
    openquake(measure).and_then(|own| pelicun_demand(&own.name))
}
