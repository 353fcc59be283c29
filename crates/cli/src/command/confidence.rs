//! The confidence-interval report: Table 4.1, what it means in words, and rocking initiation.

use std::io::Write;
use std::path::Path;

use serde_json::json;

use crate::error::CommandError;
use crate::show::shown_path;
use uplift::bootstrap::Bands;
use uplift::bootstrap::{BandsFile, band_paths};
use uplift::result::StoredStripes;
use uplift::table::ReferenceTable;
use uplift::text::{per_cent, table};

/// A row of the reference: one site and sample size, figures by measure (`pgv`, `pga`) in per cent.
pub(super) struct Reference {
    site: String,
    sample_size: u32,
    figures: Vec<(String, f64, f64)>,
}

/// The report on the bands of a result.
pub(super) struct Report<'a> {
    pub(super) file: &'a BandsFile<'a>,
    pub(super) reference: Option<&'a [Reference]>,
}

impl Report<'_> {
    /// The rows as JSON.
    pub(super) fn print_json(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let BandsFile { stored, plan, bands, .. } = self.file;
        let sizes = plan.sizes();
        let mut rows = Vec::new();
        for bands in *bands {
            for (cell, (error, range)) in bands.error_of_median.iter().zip(&bands.range_of_interval).enumerate() {
                let spectrum = cell / sizes.len();
                rows.push(json!({
                    "site": stored.sites[spectrum / stored.poes.len()],
                    "im": bands.measure.label(),
                    "poe": stored.poes[spectrum % stored.poes.len()],
                    "sample_size": sizes[cell % sizes.len()],
                    "e_median": error.map(|error| 100.0 * error),
                    "r_90ci": range.map(|range| 100.0 * range),
                }));
            }
        }
        writeln!(out, "{:#}", serde_json::Value::Array(rows))?;
        Ok(())
    }

    /// The report for people; a `quiet` one is the tables alone.
    pub(super) fn print(&self, out: &mut impl Write, quiet: bool) -> Result<(), CommandError> {
        let stored = self.file.stored;
        for (poe, &probability) in stored.poes.iter().enumerate() {
            // Table 4.1 is about the rarest
            let rarest = stored.poes.iter().all(|&other| other >= probability);
            self.print_figures(out, poe, rarest)?;
        }
        if !quiet {
            self.print_reading(out)?;
        }
        self.print_joint(out)?;
        self.print_initiation(out)?;
        if !quiet {
            let [bands, figures] = band_paths(&stored.path);
            writeln!(out, "\nBands: /bootstrap in {}", shown_path(&stored.path).display())?;
            for file in [bands, figures] {
                writeln!(out, "       {}", shown_path(&file).display())?;
            }
        }
        Ok(())
    }

    fn print_figures(&self, out: &mut impl Write, poe: usize, compared: bool) -> Result<(), CommandError> {
        let BandsFile { stored, plan, bands, .. } = self.file;
        let sizes = plan.sizes();
        let reference = self.reference.filter(|_| compared);
        writeln!(
            out,
            "\nHow sure the spectra of {} in {} years are: error of the median e and width r of the {} interval, per cent{}",
            per_cent(stored.poes[poe]),
            stored.years,
            per_cent(self.file.settings.confidence),
            if reference.is_some() { "; right of the bars the reference" } else { "" }
        )?;
        let mut header = vec!["site".to_owned(), "records".to_owned()];
        for bands in *bands {
            let label = bands.measure.label();
            header.extend([format!("{label} e"), "r".to_owned()]);
            if reference.is_some() {
                header.extend(["| e".to_owned(), "r".to_owned()]);
            }
        }
        let mut rows = Vec::new();
        for (site, name) in stored.sites.iter().enumerate() {
            for (size_index, &size) in sizes.iter().enumerate() {
                let cell = (site * stored.poes.len() + poe) * sizes.len() + size_index;
                let shown = if size_index == 0 { name.clone() } else { String::new() };
                let mut row = vec![shown, size.to_string()];
                for bands in *bands {
                    row.push(figure(bands.error_of_median[cell], 1));
                    row.push(figure(bands.range_of_interval[cell], 0));
                    if let Some(reference) = reference {
                        let found = reference
                            .iter()
                            .find(|row| row.sample_size == size && row.site.to_lowercase() == name.to_lowercase())
                            .and_then(|row| row.figures.iter().find(|(key, ..)| key == bands.measure.key()));
                        row.push(found.map_or_else(|| "| -".to_owned(), |(_, error, _)| format!("| {error:.1}")));
                        row.push(found.map_or_else(|| "-".to_owned(), |(.., range)| format!("{range:.0}")));
                    }
                }
                rows.push(row);
            }
        }
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        writeln!(out, "{}", table(&header, &rows))?;
        Ok(())
    }

    /// What the figures mean, in sentences.
    fn print_reading(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let BandsFile { stored, plan, bands, settings, .. } = self.file;
        let sizes = plan.sizes();
        writeln!(
            out,
            "\nIn words, at the strength where the interval is widest in metres, in {} of the resamples (where displacements are small, at higher strengths, the interval may be many times as wide in per cent: see the bands):",
            per_cent(settings.confidence)
        )?;
        for bands in *bands {
            for (poe, &probability) in stored.poes.iter().enumerate() {
                let widths = |size: usize| -> Vec<f64> {
                    (0..stored.sites.len())
                        .filter_map(|site| {
                            bands.range_of_interval[(site * stored.poes.len() + poe) * sizes.len() + size]
                        })
                        .collect()
                };
                let parts: Vec<String> = sizes
                    .iter()
                    .enumerate()
                    .map(|(index, size)| {
                        let mut widths = widths(index);
                        widths.sort_by(f64::total_cmp);
                        match (widths.first(), widths.last()) {
                            (Some(least), Some(most)) => {
                                let (least, most) = (format!("{:.0}", 50.0 * least), format!("{:.0}", 50.0 * most));
                                let range = if least == most { most } else { format!("{least} to {most}") };
                                format!("{size} records, within ±{range} %")
                            }
                            _ => format!("{size} records, not at all (overturning, or no displacement)"),
                        }
                    })
                    .collect();
                writeln!(
                    out,
                    "  {}, {} in {} years: the spectrum is known from {}",
                    bands.measure.label(),
                    per_cent(probability),
                    stored.years,
                    parts.join("; ")
                )?;
            }
        }
        Ok(())
    }

    /// Records and hazard together, for the sites with branches.
    fn print_joint(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let BandsFile { stored, plan, bands, settings, .. } = self.file;
        let sizes = plan.sizes().len();
        let mut rows = Vec::new();
        for bands in *bands {
            for joint in &bands.joint {
                for (cell, range) in joint.range_of_interval.iter().enumerate() {
                    let of_records = bands.range_of_interval[joint.site * stored.poes.len() * sizes + cell];
                    rows.push(vec![
                        stored.sites[joint.site].clone(),
                        bands.measure.label().to_owned(),
                        per_cent(stored.poes[cell / sizes]),
                        plan.sizes()[cell % sizes].to_string(),
                        figure(of_records, 0),
                        figure(*range, 0),
                    ]);
                }
            }
        }
        if rows.is_empty() {
            return Ok(());
        }
        writeln!(
            out,
            "\nRecords and hazard together: width r of the {} interval over the records, and over the records and the weighted hazard curves, per cent",
            per_cent(settings.confidence)
        )?;
        writeln!(out, "{}", table(&["site", "im", "probability", "records", "r", "joint r"], &rows))?;
        Ok(())
    }

    /// The bands where rocking begins (Section 4.5.2, Fig. 4.10).
    fn print_initiation(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let BandsFile { stored, plan, bands, .. } = self.file;
        let Some(size_index) = (0..plan.sizes().len()).max_by_key(|&index| plan.sizes()[index]) else { return Ok(()) };
        // the most frequent shaking is the one that may not lift the structure
        let Some(poe) = (0..stored.poes.len()).max_by(|&a, &b| stored.poes[a].total_cmp(&stored.poes[b])) else {
            return Ok(());
        };
        let mut rows = Vec::new();
        for (site, name) in stored.sites.iter().enumerate() {
            for (index, bands) in bands.iter().enumerate() {
                let cell = (site * stored.poes.len() + poe) * plan.sizes().len() + size_index;
                let mut row = vec![if index == 0 { name.clone() } else { String::new() }];
                row.push(bands.measure.label().to_owned());
                row.extend(initiation(stored, bands, cell));
                rows.push(row);
            }
        }
        writeln!(
            out,
            "\nRocking initiation, {} in {} years, samples of {}: strength at which the limits and the median fall to the\n\
             uplift displacement of {} m, and the width of the interval there over the median",
            per_cent(stored.poes[poe]),
            stored.years,
            plan.sizes()[size_index],
            stored.uplift_displacement_m
        )?;
        let header = ["site", "im", "lower", "median", "upper", "width of u, %"];
        writeln!(out, "{}", table(&header, &rows))?;
        Ok(())
    }
}

fn figure(ratio: Option<f64>, digits: usize) -> String {
    ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{:.digits$}", 100.0 * ratio))
}

/// Strengths at which the lower limit, the median and the upper limit fall to the uplift displacement, and the relative width of the
/// band at that of the median.
fn initiation(stored: &StoredStripes, bands: &Bands, cell: usize) -> Vec<String> {
    let count = stored.strengths.len();
    let row = cell * count..(cell + 1) * count;
    let at_uplift = |values: &[f64]| values.iter().position(|&u_m| u_m <= stored.uplift_displacement_m);
    let (lower, median, upper) = (&bands.lower_m[row.clone()], &bands.median_m[row.clone()], &bands.upper_m[row]);
    let strength = |values: &[f64]| {
        at_uplift(values).map_or_else(|| "above all".to_owned(), |index| format!("{:.3}", stored.strengths[index]))
    };
    let width = at_uplift(median)
        .map(|index| (upper[index] - lower[index]) / median[index])
        .filter(|width| width.is_finite())
        .map_or_else(|| "-".to_owned(), |width| format!("{:.0}", 100.0 * width));
    vec![strength(lower), strength(median), strength(upper), width]
}

/// Reads a table with the columns of Table 4.1.
pub(super) fn read_reference(path: &Path) -> Result<Vec<Reference>, CommandError> {
    let table = ReferenceTable::read(path)?;
    let columns = |key: &str| (format!("{key}_e_median_pct"), format!("{key}_r_90ci_pct"));
    let measures: Vec<&str> = ["pgv", "pga"]
        .into_iter()
        .filter(|key| {
            let (error, range) = columns(key);
            table.has(&error) && table.has(&range)
        })
        .collect();
    if !table.has("site") || !table.has("sample_size") || measures.is_empty() {
        return Err(table
            .fail("needs the columns site, sample_size, and pgv_e_median_pct with pgv_r_90ci_pct or the same of pga")
            .into());
    }
    (0..table.rows())
        .map(|row| {
            let figures = measures.iter().map(|key| {
                let (error, range) = columns(key);
                Ok(((*key).to_owned(), table.number(&error, row)?, table.number(&range, row)?))
            });
            Ok(Reference {
                site: table.text("site", row),
                sample_size: table.number("sample_size", row)?,
                figures: figures.collect::<Result<_, CommandError>>()?,
            })
        })
        .collect()
}
