//! A result as a tidy table.

use std::iter::repeat_n;

use polars::prelude::Column;
use uplift_job::text::finite;
use uplift_result::{INFERRED_BANDS, SpreadOver, StoredSpread, urs};
use uplift_studies::uniform_risk::spectra_table;

use super::Export;
use super::added::SHARES;
use super::source::{BandOf, Row};

impl Export {
    /// A row for each ordinate: its fit beside it, its return period and flag, and the limits of its bands for each
    /// size of the sample, `u05_n20_m` for 20 records; then the bands of all records there could be and of another set;
    /// last mean and fractiles over weighted hazard curves and over possible structures, `u05_hazard_m`.
    pub fn columns(&self) -> Vec<Column> {
        let (mut period, mut fit_m) = (Vec::new(), Vec::new());
        let mut added = AddedColumns::default();
        let has_repaired = self.has_repaired();
        let names = self.band_names();
        let mut limits: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
        let mut further = self.further_bands();
        let mut spreads: Vec<(SpreadOver, Vec<Vec<Option<f64>>>)> =
            self.spread_over().map(|over| (over, vec![Vec::new(); 6])).collect();
        let inferred_names = self.inferred_names();
        let mut inferred_limits: Vec<Vec<f64>> = vec![Vec::new(); inferred_names.len()];
        for row in self.rows() {
            let curve = row.spectrum.fit.curve();
            let strengths = &self.spectra.strengths;
            fit_m.extend(strengths.iter().map(|&strength| curve.map(|curve| curve.at(strength))));
            period.extend(repeat_n(row.return_period, strengths.len()));
            added.extend(self, &row);
            if has_repaired {
                added.extend_repaired(self, &row);
            }
            let bands = self.bands_of(&row);
            let of_row = bands.iter().flat_map(|band| band.limits_m);
            for (column, values) in limits.iter_mut().zip(of_row) {
                column.extend_from_slice(values);
            }
            let of_row = bands.iter().flat_map(|band| band.inferred_m.into_iter().flatten());
            for (column, values) in inferred_limits.iter_mut().zip(of_row) {
                column.extend_from_slice(values);
            }
            for bands in &mut further {
                bands.extend(self, &row);
            }
            for (over, columns) in &mut spreads {
                let limits_m = self.spread_of(&row, *over);
                for (place, column) in columns.iter_mut().enumerate() {
                    let value = |strength| limits_m.map(|limits_m: [&[f64]; 6]| limits_m[place][strength]);
                    column.extend((0..self.spectra.strengths.len()).map(value));
                }
            }
        }
        let mut columns = spectra_table(&self.spectra);
        let beside = columns.iter().position(|column| column.name() == urs::U_M.name).map_or(0, |place| place + 1);
        columns.splice(
            beside..beside,
            [Column::new("fit_m".into(), fit_m), Column::new("return_period_years".into(), period)],
        );
        columns.extend(names.into_iter().zip(limits).map(|(name, values)| Column::new(name.into(), values)));
        columns.extend(added.into_columns());
        columns.extend(further.into_iter().flat_map(FurtherBands::into_columns));
        let inferred = inferred_names.into_iter().zip(inferred_limits);
        columns.extend(inferred.map(|(name, values)| Column::new(name.into(), values)));
        for (over, values) in spreads {
            let named = StoredSpread::names().zip(values);
            columns.extend(named.map(|(name, values)| Column::new(format!("{name}_{}_m", over.key()).into(), values)));
        }
        columns
    }

    /// The columns of bands that some spectra have and others have not: of repaired spectra, and those over weighted
    /// hazard curves too.
    fn further_bands(&self) -> Vec<FurtherBands> {
        let [joint, repaired_joint] = self.has_joint_bands();
        let kinds: [(bool, &str, BandsOf); 3] = [
            (self.has_repaired_bands(), "_consistent", Export::repaired_bands_of),
            (joint, "_joint", Export::joint_bands_of),
            (repaired_joint, "_consistent_joint", Export::repaired_joint_bands_of),
        ];
        let some = kinds.into_iter().filter(|(is_there, ..)| *is_there);
        let names = |suffix: &str| {
            let named = |name: &String| name.replacen("_n", &format!("{suffix}_n"), 1);
            self.band_names().iter().map(named).collect::<Vec<_>>()
        };
        some.map(|(_, suffix, bands_of)| {
            let names = names(suffix);
            FurtherBands { bands_of, limits_m: vec![Vec::new(); names.len()], names }
        })
        .collect()
    }

    /// Names of the columns of bands, by size of the sample, then limit.
    fn band_names(&self) -> Vec<String> {
        let Some(bands) = &self.bands else { return Vec::new() };
        let limits = bands.limit_names();
        let of_size = |size: &u32| {
            let size = *size;
            limits.each_ref().map(|limit| format!("{}_n{size}_m", limit.trim_end_matches("_m")))
        };
        bands.sizes.iter().flat_map(of_size).collect()
    }

    /// The same of the bands beyond the set, `truth_lower_n20_m`.
    fn inferred_names(&self) -> Vec<String> {
        let sizes = self.bands.iter().filter(|_| self.has_inferred_bands()).flat_map(|bands| &bands.sizes);
        sizes
            .flat_map(|size| INFERRED_BANDS.quantities.iter().map(move |limit| limit.name_with(&format!("n{size}"))))
            .collect()
    }
}

/// The bands of a spectrum, by size of the sample.
type BandsOf = for<'a> fn(&'a Export, &Row<'_>) -> Vec<BandOf<'a>>;

/// Columns of bands that some spectra have.
struct FurtherBands {
    bands_of: BandsOf,
    /// By size of the sample, then limit.
    names: Vec<String>,
    /// None where a spectrum has no such band, m.
    limits_m: Vec<Vec<Option<f64>>>,
}

impl FurtherBands {
    /// The cells of one spectrum.
    fn extend(&mut self, export: &Export, row: &Row<'_>) {
        let bands = (self.bands_of)(export, row);
        let of_row: Vec<&[f64]> = bands.iter().flat_map(|band| band.limits_m).collect();
        for (place, column) in self.limits_m.iter_mut().enumerate() {
            let value = |strength| of_row.get(place).map(|values: &&[f64]| values[strength]);
            column.extend((0..export.spectra.strengths.len()).map(value));
        }
    }

    fn into_columns(self) -> impl Iterator<Item = Column> {
        self.names.into_iter().zip(self.limits_m).map(|(name, values)| Column::new(name.into(), values))
    }
}

/// Columns of what `uplift influence`, `uplift measures` and a repair added; empty where there was none.
#[derive(Default)]
struct AddedColumns {
    /// Levels below which 5 %, half and 95 % of the risk of an ordinate lie, in the unit of the measure.
    levels: [Vec<Option<f64>>; 3],
    /// Dispersion of the stripes that rock, and of the level at first uplift.
    dispersions: [Vec<Option<f64>>; 2],
    /// Displacements of weighted records, m.
    consistent_m: [Vec<Option<f64>>; 1],
}

impl AddedColumns {
    /// The cells of one spectrum.
    fn extend(&mut self, export: &Export, row: &Row<'_>) {
        let strengths = 0..export.spectra.strengths.len();
        if !export.added.influence.is_empty() {
            let influence = export.influence_on(row);
            for (cells, share) in self.levels.iter_mut().zip(SHARES) {
                let level = |strength| finite(influence?.level(row.at, strength, share));
                cells.extend(strengths.clone().map(level));
            }
        }
        if !export.added.efficiency.is_empty() {
            let of = export.added.efficiency_of(row.spectrum.measure);
            let values = [of.map(|of| &of.rocking), of.map(|of| &of.initiation)];
            for (cells, values) in self.dispersions.iter_mut().zip(values) {
                cells.extend(strengths.clone().map(|strength| finite(values?[strength])));
            }
        }
    }

    /// Those of weighted records; infinite where censored.
    fn extend_repaired(&mut self, export: &Export, row: &Row<'_>) {
        let [cells] = &mut self.consistent_m;
        let u_m = export.repaired(row).map(|(u_m, _)| u_m);
        cells.extend(
            (0..export.spectra.strengths.len())
                .map(|strength| u_m.map(|u_m| u_m[strength]).filter(|u_m| !u_m.is_nan())),
        );
    }

    fn into_columns(self) -> impl Iterator<Item = Column> {
        let names =
            ["level_p05", "level_p50", "level_p95", "dispersion_rocking", "dispersion_initiation", "u_consistent_m"];
        let cells = self.levels.into_iter().chain(self.dispersions).chain(self.consistent_m);
        let some = names.into_iter().zip(cells).filter(|(_, cells)| !cells.is_empty());
        some.map(|(name, cells)| Column::new(name.into(), cells))
    }
}
