//! Tidy tables beside the result file, for spreadsheets and scripts.

use std::iter::repeat_n;
use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::outputs::{Output, OutputKind, beside};
use uplift_job::table::ColumnsOf;
use uplift_result::declared::{Field, Place, Quantity};
use uplift_result::{Fits, ResultFile, SiteArrays, StoredSpectra, regression, urs};
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::{DisplacementOptions, QUOTED_LIMITS, displacements};

use super::site_table::{PROBLEM, site_table_paths};
use crate::Table;
use crate::error::StudiesError;

/// The tables beside the result file `result`: spectra and coefficients.
fn csv_paths(result: &Path) -> [PathBuf; 2] {
    ["urs.csv", "regression.csv"].map(|ending| beside(result, ending))
}

/// All files but the result that a run of `study` with the result at `result` writes.
pub fn tables(study: &UniformRiskStudy, result: &Path) -> Vec<Output> {
    let mut tables = Vec::new();
    if study.output.csv && !study.sites.is_empty() {
        let [spectra, coefficients] = csv_paths(result);
        tables.push(Output::new(spectra, OutputKind::Table(urs::LOWER_TAIL_SHARE.name)));
        tables.push(Output::new(coefficients, OutputKind::Table(regression::RMSE_PLAIN_M.name)));
    }
    if study.site_table.is_some() {
        tables.push(Output::new(SiteArrays::path(result), OutputKind::Sites));
    }
    if study.site_table.is_some() && study.output.csv {
        let [spectra, coefficients, map] = site_table_paths(result);
        tables.push(Output::new(spectra, OutputKind::Table(urs::FLAG.name)));
        tables.push(Output::new(coefficients, OutputKind::Table(PROBLEM)));
        tables.push(Output::new(map, OutputKind::GeoJson));
    }
    tables
}

/// The tables of the result in `file`.
///
/// # Errors
/// A file that is damaged.
pub fn csv_tables(file: &ResultFile) -> Result<Vec<Table>, StudiesError> {
    let [ordinates, coefficients] = csv_paths(file.path());
    let spectra = file.spectra()?;
    let mut columns = spectra_table(&spectra);
    columns.extend(band_columns(&quoted_bands_m(file, &spectra, false)?));
    Ok(vec![(ordinates, columns), (coefficients, regression_table(&spectra))])
}

/// A row for each ordinate: what it is of, then the arrays of its spectrum.
pub fn spectra_table(spectra: &StoredSpectra) -> Vec<Column> {
    let mut columns = subject_columns(spectra, spectra.strengths.len());
    let strengths = spectra.measures.iter().flat_map(|of| of.fits.values()).flat_map(|_| &spectra.strengths).copied();
    columns.push(Column::new("strength".into(), strengths.collect::<Vec<f64>>()));
    let places = || spectra.measures.iter().flat_map(|of| (0..of.u_m.values().len()).map(move |at| (of, at)));
    columns.extend(urs::GROUP.quantities.iter().map(|quantity| column(quantity, places(), |_, _| true)));
    columns
}

/// Limits of the quoted bands of the ordinates in `file` or of the `repaired` ones, m, by measure, site, probability,
/// then strength; none for a single record and without repair.
///
/// # Errors
/// A file that is damaged.
pub fn quoted_bands_m(
    file: &ResultFile,
    spectra: &StoredSpectra,
    repaired: bool,
) -> Result<Vec<Option<[f64; 2]>>, StudiesError> {
    let consistency = file.consistency()?;
    let is_repaired = |measure| consistency.iter().any(|own| own.scaled_to == measure && own.u_m.is_some());
    let mut bands_m = Vec::new();
    for of in &spectra.measures {
        if repaired && !is_repaired(of.measure) {
            bands_m.resize(bands_m.len() + of.u_m.values().len(), None);
            continue;
        }
        let (strengths, measure) = (spectra.strengths.clone(), Some(of.measure));
        let asked = DisplacementOptions {
            strengths,
            measure,
            every_probability: true,
            without_hazard: true,
            repaired,
            ..Default::default()
        };
        bands_m.extend(displacements(file, &asked)?.displacements.into_iter().map(|own| own.band_m));
    }
    Ok(bands_m)
}

/// The columns of these limits, of every ordinate.
pub fn band_columns(bands_m: &[Option<[f64; 2]>]) -> [Column; 2] {
    let limits_m = |at: usize| bands_m.iter().map(|own| own.map(|limits_m| limits_m[at])).collect::<Vec<Option<f64>>>();
    std::array::from_fn(|at| Column::new(QUOTED_LIMITS[at].into(), limits_m(at)))
}

/// A row for each spectrum: what it is of, then its coefficients.
fn regression_table(spectra: &StoredSpectra) -> Vec<Column> {
    use regression::{BOUND_ACTIVE, C0_M, C1, C2_M, POINTS, RMSE_M, RMSE_PLAIN_M};
    let mut columns = subject_columns(spectra, 1);
    let places = || spectra.measures.iter().flat_map(|of| (0..of.fits.values().len()).map(|at| (&of.fits, at)));
    let is_fitted = |fits: &Fits, at: usize| fits[at].curve().is_some();
    let coefficients = [C0_M, C1, C2_M, RMSE_M, RMSE_PLAIN_M, BOUND_ACTIVE];
    columns.extend(coefficients.iter().map(|quantity| column(quantity, places(), is_fitted)));
    columns.push(column(&POINTS, places(), |_, _| true));
    columns
}

/// The columns that say what a spectrum is of, each `times` over.
fn subject_columns(spectra: &StoredSpectra, times: usize) -> Vec<Column> {
    ColumnsOf::new(spectra.rows().flat_map(|row| repeat_n(row, times)))
        .with("site", |row| row.site)
        .with("im", |row| row.measure.label())
        .with("poe", |row| row.poe)
        .with("years", |_| spectra.years)
        .build()
}

/// A stored array as a column of a table; cells are empty where `is_there` says so.
fn column<'a, T: 'a>(
    quantity: &Quantity<T>,
    places: impl Iterator<Item = (&'a T, usize)>,
    is_there: impl Fn(&T, usize) -> bool,
) -> Column {
    fn cells<'a, T: 'a, V: 'a, C>(
        place: &Place<T, V>,
        places: impl Iterator<Item = (&'a T, usize)>,
        is_there: impl Fn(&T, usize) -> bool,
        cell: impl Fn(&'a V) -> C,
    ) -> Vec<Option<C>> {
        places.map(|(of, at)| is_there(of, at).then(|| cell((place.get)(of, at)))).collect()
    }
    let name = quantity.name.into();
    match &quantity.field {
        // zero has no sign in a table
        Field::F64(place) => Column::new(name, cells(place, places, is_there, |value| value + 0.0)),
        Field::Made(number) => {
            Column::new(name, places.map(|(of, at)| is_there(of, at).then(|| number(of, at))).collect::<Vec<_>>())
        }
        Field::U32(place) => Column::new(name, cells(place, places, is_there, |&count| count)),
        Field::Bool(place) => Column::new(name, cells(place, places, is_there, |&is| is)),
        Field::Flag(place) => Column::new(name, cells(place, places, is_there, |flag| flag.word())),
        Field::Text(place) => Column::new(name, cells(place, places, is_there, String::as_str)),
    }
}
