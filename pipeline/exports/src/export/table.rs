//! A result as a tidy table.

use polars::prelude::Column;
use uplift_job::text::finite;
use uplift_result::declared::Quantity;
use uplift_result::{BandKind, EFFICIENCY, INFERRED_BANDS, StoredEfficiency, StoredSpread, before_unit, urs};
use uplift_studies::uniform_risk::{band_columns, spectra_table};
use uplift_uniform_risk::QUOTED_LIMITS;

use super::Export;
use super::added::SHARES;
use super::source::Row;

/// A column: its name, and its cells of a spectrum over the strengths, where that has some.
struct Cells<'a>(String, Box<OfRow<'a>>);
type OfRow<'a> = dyn Fn(&Row<'_>) -> Option<Vec<Option<f64>>> + 'a;

impl<'a> Cells<'a> {
    fn new(name: impl Into<String>, of: impl Fn(&Row<'_>) -> Option<Vec<Option<f64>>> + 'a) -> Self {
        Self(name.into(), Box::new(of))
    }
}

/// Cells of all `values`, infinite ones and NaN too.
fn all(values: &[f64]) -> Vec<Option<f64>> {
    values.iter().copied().map(Some).collect()
}

impl Export {
    /// A row for each ordinate: its quoted band and its fit beside it, its return period and flag, and the limits of
    /// its bands for each size of the sample, `u05_n20_m` for 20 records; then the bands of all records there could be
    /// and of another set; last mean and fractiles over weighted hazard curves and over possible structures,
    /// `u05_hazard_m`.
    pub fn columns(&self) -> Vec<Column> {
        let strengths = &self.spectra.strengths;
        let column = |Cells(name, of): Cells<'_>| {
            let cells = self.rows().flat_map(|row| of(&row).unwrap_or_else(|| vec![None; strengths.len()]));
            Column::new(name.into(), cells.collect::<Vec<_>>())
        };
        let fit_m = Cells::new("fit_m", |row| {
            let curve = row.spectrum.fit.curve()?;
            Some(strengths.iter().map(|&strength| Some(curve.at(strength))).collect())
        });
        let period = Cells::new("return_period_years", |row| Some(vec![Some(row.return_period); strengths.len()]));
        let mut columns = spectra_table(&self.spectra);
        let beside = columns.iter().position(|column| column.name() == urs::U_M.name).map_or(0, |place| place + 1);
        columns.splice(beside..beside, band_columns(&self.quoted_m).into_iter().chain([fit_m, period].map(column)));
        let mut more = self.band_cells(BandKind::PLAIN);
        more.extend(self.added_cells());
        more.extend(BandKind::ALL[1..].iter().flat_map(|&kind| self.band_cells(kind)));
        more.extend([BandKind::PLAIN, BandKind::REPAIRED].iter().flat_map(|&kind| self.inferred_cells(kind)));
        for over in self.spread_over() {
            let of = |(place, name)| {
                let limit_m = move |row: &Row<'_>| Some(all(self.spread_of(row, over)?[place]));
                Cells::new(format!("{name}_{}_m", over.key()), limit_m)
            };
            more.extend(StoredSpread::names().enumerate().map(of));
        }
        columns.extend(more.into_iter().map(column));
        columns
    }

    /// The limits of the bands of a kind, by size of the sample, then limit.
    fn band_cells(&self, kind: BandKind) -> Vec<Cells<'_>> {
        let Some(bands) = self.bands.as_ref().filter(|_| self.has_bands(kind)) else { return Vec::new() };
        let names = bands.limit_names();
        let of_size = |(size, records): (usize, &u32)| {
            let of_limit = |(limit, name): (usize, &String)| {
                let limit_m = move |row: &Row<'_>| Some(all(self.bands_of(row, kind).get(size)?.limits_m[limit]));
                Cells::new(before_unit(name, &format!("{}_n{records}", kind.suffix)), limit_m)
            };
            names.iter().enumerate().map(of_limit).collect::<Vec<_>>()
        };
        bands.sizes.iter().enumerate().flat_map(of_size).collect()
    }

    /// The same of the bands beyond the set, `truth_lower_n20_m`.
    fn inferred_cells(&self, kind: BandKind) -> Vec<Cells<'_>> {
        let Some(bands) = self.bands.as_ref().filter(|_| self.has_inferred_bands(kind)) else { return Vec::new() };
        let of_size = |(size, records): (usize, &u32)| {
            let suffix = format!("{}_n{records}", kind.suffix);
            INFERRED_BANDS.quantities.iter().enumerate().map(move |(limit, quantity)| {
                let limit_m = move |row: &Row<'_>| Some(all(self.bands_of(row, kind).get(size)?.inferred_m?[limit]));
                Cells::new(before_unit(quantity.name, &suffix), limit_m)
            })
        };
        bands.sizes.iter().enumerate().flat_map(of_size).collect()
    }

    /// What `uplift influence`, `uplift measures` and a repair added: levels below which 5 %, half and 95 % of the risk
    /// of an ordinate lie, in the unit of the measure; dispersions; displacements of weighted records with
    /// their quoted band.
    fn added_cells(&self) -> Vec<Cells<'_>> {
        let mut cells = Vec::new();
        if !self.added.influence.is_empty() {
            cells.extend(SHARES.map(|share| {
                Cells::new(format!("level_p{:02.0}", 100.0 * share), move |row| {
                    let influence = self.influence_on(row)?;
                    let strengths = 0..self.spectra.strengths.len();
                    Some(strengths.map(|strength| finite(influence.level(row.at, strength, share))).collect())
                })
            }));
        }
        if !self.added.efficiency.is_empty() {
            let of = |figure: &'static Quantity<StoredEfficiency>| {
                Cells::new(figure.exported_name(), move |row| {
                    let of = self.added.efficiency_of(row.spectrum.measure)?;
                    Some((0..of.rocking.len()).map(|at| figure.number(of, at).and_then(finite)).collect())
                })
            };
            // the others rank measures rather than describe spectra
            cells.extend(EFFICIENCY.exported().filter(|own| ["rocking", "initiation"].contains(&own.name)).map(of));
        }
        if self.has_repaired() {
            // infinite where censored
            let known = |u_m: &[f64]| u_m.iter().map(|u_m| Some(*u_m).filter(|u_m| !u_m.is_nan())).collect();
            cells.push(Cells::new(BandKind::REPAIRED.column(urs::U_M.name), move |row| {
                Some(known(self.repaired(row)?.0))
            }));
            cells.extend(QUOTED_LIMITS.iter().enumerate().map(|(limit, name)| {
                Cells::new(BandKind::REPAIRED.column(name), move |row| {
                    Some(known(&row.quoted_m(BandKind::REPAIRED)[limit]))
                })
            }));
        }
        cells
    }
}
