//! How other programs call intensity measures, and in which units they take them.

use uplift_fragility::{PelicunDemand, pelicun_demand};
use uplift_job::JobError;
use uplift_motion::IntensityMeasure;

use super::FragilityFormat;

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
