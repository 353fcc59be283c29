//! How other programs call intensity measures, and in which units they take them.

use uplift_job::JobError;
use uplift_motion::IntensityMeasure;

use super::FragilityFormat;

/// A measure of another program.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Foreign {
    /// Its name there.
    pub(crate) name: String,
    /// Its unit there, as pelicun writes it.
    pub(crate) unit: &'static str,
    /// Its value there over its value here.
    pub(crate) factor: f64,
}

/// Refuses a measure that the program of `format` does not have.
///
/// # Errors
/// [`JobError::Usage`] for such a measure.
pub(super) fn check(measure: IntensityMeasure, format: FragilityFormat) -> Result<(), JobError> {
    let (found, program) = match format {
        FragilityFormat::OpenQuake => (openquake(measure), "OpenQuake"),
        FragilityFormat::Pelicun => (pelicun(measure), "pelicun"),
        FragilityFormat::Csv => return Ok(()),
    };
    found.map(|_| ()).ok_or_else(|| {
        JobError::Usage(format!("--fragility: {program} has no {}: choose another with --measure", measure.long_name()))
    })
}

/// The intensity measure type of `OpenQuake` 3.26 (`openquake.hazardlib.imt`); none where it has none.
pub(super) fn openquake(measure: IntensityMeasure) -> Option<Foreign> {
    let of = |name: &str, unit, factor| Some(Foreign { name: name.to_owned(), unit, factor });
    match measure {
        IntensityMeasure::Pgv => of("PGV", "cm/s", 1.0),
        IntensityMeasure::Pga => of("PGA", "g", 1.0),
        IntensityMeasure::Sa(_) => of(measure.label(), "g", 1.0),
        IntensityMeasure::AvgSa { .. } => of("AvgSA", "g", 1.0),
        IntensityMeasure::Pgd => of("PGD", "cm", 1.0),
        IntensityMeasure::Cav => of("CAV", "g s", 1.0 / 980.665),
        IntensityMeasure::Arias => of("IA", "m/s", 0.01),
        IntensityMeasure::SpectrumIntensity | IntensityMeasure::D575 | IntensityMeasure::D595 => None,
    }
}

/// The demand type of pelicun 3 (`pelicun.base.EDP_TYPES`); none where it has none.
pub(crate) fn pelicun(measure: IntensityMeasure) -> Option<Foreign> {
    let of = |name: String, unit| Some(Foreign { name, unit, factor: 1.0 });
    match measure {
        IntensityMeasure::Pgv => of("Peak Ground Velocity".to_owned(), "cmps"),
        IntensityMeasure::Pga => of("Peak Ground Acceleration".to_owned(), "g"),
        IntensityMeasure::Sa(period) => of(format!("Spectral Acceleration|{period}"), "g"),
        IntensityMeasure::AvgSa { .. }
        | IntensityMeasure::Pgd
        | IntensityMeasure::Cav
        | IntensityMeasure::Arias
        | IntensityMeasure::SpectrumIntensity
        | IntensityMeasure::D575
        | IntensityMeasure::D595 => None,
    }
}

/// The same in the head of a table of demands.
pub(crate) fn pelicun_acronym(measure: IntensityMeasure) -> String {
    match measure {
        IntensityMeasure::Sa(period) => format!("SA_{period}"),
        other => other.label().to_owned(),
    }
}
