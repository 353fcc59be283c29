//! `uplift table`: the coefficients of Eq. 4.11, ours beside a reference; for displacement spectra the design example.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use uplift_regression::Exponential;

mod displacement;
use crate::error::CommandError;
use crate::terminal::tell;
use uplift::reference::ReferenceTable;
use uplift::result::{Kind, ResultFile, Spectrum, StoredSpectra};
use uplift::text::{finite, per_cent, table as lines};

/// Strengths above this are compared, up to 1 (the range of Table 4.2's fits).
const COMPARED_ABOVE: f64 = 0.05;
/// Where the reference curve is below this, a ratio says nothing: it is at the uplift displacement.
const COMPARED_FROM_M: f64 = 0.003;

#[derive(Debug, Args)]
pub(super) struct TableArguments {
    /// Result file of `uplift run`
    result: PathBuf,
    /// Table to compare with
    #[arg(
        long,
        value_name = "FILE.csv",
        help = "Table to compare with: CSV with the columns site, poe_50y (or poe), c0_m, c1, c2_m, rmse_m; for displacement spectra record_set, scaling, quantity, value and, for oscillators, rule (ED, EE)"
    )]
    reference: Option<PathBuf>,
    /// Which intensity measure; not for displacement spectra
    #[arg(long, default_value = "pgv", value_parser = ["pgv", "pga", "all"], ignore_case = true)]
    im: String,
    /// Print the rows as JSON
    #[arg(long)]
    json: bool,
}

/// A row of the reference.
struct Reference {
    site: String,
    poe: f64,
    curve: Exponential,
    rmse_m: Option<f64>,
}

pub(super) fn table(arguments: &TableArguments) -> Result<(), CommandError> {
    let file = ResultFile::open(&arguments.result)?;
    if file.kind() == Kind::Displacement {
        return displacement::table(&file, arguments.reference.as_deref(), arguments.json);
    }
    let result = file.spectra()?;
    let references = match &arguments.reference {
        Some(path) => read_reference(path)?,
        None => Vec::new(),
    };
    let wanted = arguments.im.to_lowercase();
    let rows: Vec<(Spectrum<'_>, Option<&Reference>)> = result
        .rows()
        .filter(|spectrum| wanted == "all" || spectrum.measure.key() == wanted)
        .map(|spectrum| (spectrum, references.iter().find(|reference| same(&spectrum, reference))))
        .collect();
    if rows.is_empty() {
        let found = if result.measures.is_empty() { "it has none" } else { "it has the other measure: use --im" };
        return Err(CommandError::input(format!(
            "{}: has no spectra by {}: {found}",
            arguments.result.display(),
            wanted.to_uppercase()
        )));
    }
    if arguments.reference.is_some() && rows.iter().all(|(_, reference)| reference.is_none()) {
        // the coefficients are of use all the same; the remark is for who mistyped a name
        let names = |of: &mut dyn Iterator<Item = &str>| {
            let mut names: Vec<&str> = of.collect();
            names.sort_unstable();
            names.dedup();
            names.join(", ")
        };
        tell(&format!(
            "note: no row of the reference has a site and probability of the result: it has {}, the result {}",
            names(&mut references.iter().map(|reference| reference.site.as_str())),
            names(&mut rows.iter().map(|(spectrum, _)| spectrum.site))
        ));
    }
    let mut out = std::io::stdout().lock();
    if arguments.json {
        let json: Vec<serde_json::Value> = rows
            .iter()
            .map(|(spectrum, reference)| {
                json!({
                    "site": spectrum.site,
                    "im": spectrum.measure.label(),
                    "poe": spectrum.poe,
                    "c0": finite(spectrum.fit.c0_m),
                    "c1": finite(spectrum.fit.c1),
                    "c2": finite(spectrum.fit.c2_m),
                    "rmse": finite(spectrum.fit.rmse_m),
                    "median_ratio": reference.and_then(|reference| median_ratio(&result.strengths, spectrum, reference)),
                })
            })
            .collect();
        writeln!(out, "{:#}", serde_json::Value::Array(json))?;
        return Ok(());
    }
    let record_set = file.head()?.record_set;
    print(&mut out, &record_set, &result, &rows, arguments.reference.is_some())
}

fn print(
    out: &mut impl Write,
    record_set: &str,
    result: &StoredSpectra,
    rows: &[(Spectrum<'_>, Option<&Reference>)],
    compared: bool,
) -> Result<(), CommandError> {
    writeln!(out, "u = c0 exp(c1 strength) + c2, metres; records: {record_set}")?;
    let ours = |spectrum: &Spectrum<'_>| {
        let fit = &spectrum.fit;
        if fit.c0_m.is_nan() {
            return vec!["no fit".to_owned(), String::new(), String::new(), String::new()];
        }
        let bound = if fit.bound_active { " *" } else { "  " };
        vec![
            format!("{:.4}", fit.c0_m),
            format!("{:.4}", fit.c1),
            format!("{:.4}{bound}", fit.c2_m),
            format!("{:.4}", fit.rmse_m),
        ]
    };
    let mut header = vec!["site", "im", "poe", "c0", "c1", "c2  ", "rmse"];
    if compared {
        header.extend(["| c0", "c1", "c2", "rmse", "| ratio"]);
    }
    let cells: Vec<Vec<String>> = rows
        .iter()
        .map(|(spectrum, reference)| {
            let mut row = vec![spectrum.site.to_owned(), spectrum.measure.label().to_owned(), per_cent(spectrum.poe)];
            row.extend(ours(spectrum));
            if compared {
                let Some(reference) = reference else {
                    row.extend(["| -", "-", "-", "-", "| -"].map(str::to_owned));
                    return row;
                };
                let Exponential { c0, c1, c2 } = reference.curve;
                row.extend([format!("| {c0:.4}"), format!("{c1:.4}"), format!("{c2:.4}")]);
                row.push(reference.rmse_m.map_or_else(|| "-".to_owned(), |rmse| format!("{rmse:.4}")));
                let ratio = median_ratio(&result.strengths, spectrum, reference);
                row.push(ratio.map_or_else(|| "| -".to_owned(), |ratio| format!("| {ratio:.2}")));
            }
            row
        })
        .collect();
    writeln!(out, "{}", lines(&header, &cells))?;
    writeln!(out, "* c2 held at 0; probabilities in {} years; rmse with n - 3 degrees of freedom", result.years)?;
    if compared {
        writeln!(
            out,
            "right of the bars: the reference, and the median ratio of our spectrum to its curve over strengths in \
             ({COMPARED_ABOVE}, 1] where that exceeds {} mm",
            1000.0 * COMPARED_FROM_M
        )?;
    }
    Ok(())
}

fn same(spectrum: &Spectrum<'_>, reference: &Reference) -> bool {
    spectrum.site.to_lowercase() == reference.site.to_lowercase() && (spectrum.poe - reference.poe).abs() < 1e-9
}

/// Median of our ordinates over the reference curve, where it can be compared.
fn median_ratio(strengths: &[f64], spectrum: &Spectrum<'_>, reference: &Reference) -> Option<f64> {
    let mut ratios: Vec<f64> = strengths
        .iter()
        .zip(spectrum.u_m)
        .filter(|(strength, _)| **strength > COMPARED_ABOVE && **strength <= 1.0)
        .map(|(&strength, u_m)| (u_m, reference.curve.at(strength)))
        .filter(|(_, reference_m)| *reference_m > COMPARED_FROM_M)
        .map(|(u_m, reference_m)| u_m / reference_m)
        .collect();
    ratios.sort_by(f64::total_cmp);
    let middle = ratios.len() / 2;
    match ratios.len() {
        0 => None,
        odd if odd % 2 == 1 => Some(ratios[middle]),
        _ => Some(0.5 * (ratios[middle - 1] + ratios[middle])),
    }
    .filter(|ratio| ratio.is_finite())
}

fn read_reference(path: &Path) -> Result<Vec<Reference>, CommandError> {
    let table = ReferenceTable::read(path)?;
    let poe_column = if table.has("poe_50y") { "poe_50y" } else { "poe" };
    let missing: Vec<&str> =
        ["site", poe_column, "c0_m", "c1", "c2_m"].into_iter().filter(|name| !table.has(name)).collect();
    if !missing.is_empty() {
        return Err(table.fail(format!("has no column {}", missing.join(", "))).into());
    }
    (0..table.rows())
        .map(|row| {
            Ok(Reference {
                site: table.text("site", row),
                poe: table.number(poe_column, row)?,
                curve: Exponential {
                    c0: table.number("c0_m", row)?,
                    c1: table.number("c1", row)?,
                    c2: table.number("c2_m", row)?,
                },
                rmse_m: table.number("rmse_m", row).ok(),
            })
        })
        .collect()
}
