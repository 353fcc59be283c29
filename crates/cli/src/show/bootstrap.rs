//! Confidence bands: of the spectrum that a run shows, and in detail Table 4.1 and rocking initiation.

use std::io::Write;

use uplift::bootstrap::{BootstrapReport, Initiation, MANY_FAILED, ReferenceRow};
use uplift::result::{MeasureBands, StoredJointBands};
use uplift::spectrum::SpectrumReport;
use uplift::text::{Table, per_cent, risk_in_words, risk_name, two_digits};

use uplift::uniform_risk::{Displacement, DisplacementReport};

use super::alarms::print_result_warnings;
use super::spectrum::print_displacements;
use super::{print_more, shown_path, typed_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The bands of `shown` displacements and how they depend on the number of records; in detail Table 4.1 and all
/// other figures. A quiet terminal gets the tables alone.
pub(crate) fn print_bootstrap(
    report: &BootstrapReport,
    shown: &SpectrumReport,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    let out = &mut output();
    print_displacements(out, &shown.found)?;
    if terminal.shows_details() {
        print_details(out, report)?;
    } else if !report.reference.is_empty() {
        print_figures(out, report, rarest(report), true)?;
    }
    if !terminal.is_quiet() {
        print_sizes(out, report, &shown.found)?;
    }
    let result = &report.stored.path;
    print_result_warnings(out, &shown.alarms, result, terminal)?;
    if !terminal.is_quiet() {
        let tables = report.tables.each_ref().map(|file| shown_path(file).display().to_string());
        writeln!(out, "\nBands    /bootstrap in {}", shown_path(result).display())?;
        if report.rows.iter().any(|row| row.repaired.is_some()) {
            writeln!(out, "Repaired spectra have bands too: uplift spectrum {} --repaired", typed_path(result))?;
        }
        writeln!(out, "Tables   {}", tables.join(", "))?;
        print_more(out, terminal)?;
    }
    Ok(())
}

/// Table 4.1 for each probability, repaired and joint bands, and rocking initiation.
fn print_details(out: &mut impl Write, report: &BootstrapReport) -> Result<(), CommandError> {
    for poe in 0..report.stored.poes.len() {
        print_figures(out, report, poe, poe == rarest(report))?;
    }
    print_repaired(out, report)?;
    print_inferred(out, report)?;
    print_joint(out, report)?;
    print_initiation(out, report)
}

/// The position of the smallest probability, which Table 4.1 is about.
fn rarest(report: &BootstrapReport) -> usize {
    (0..report.stored.poes.len()).min_by(|&a, &b| report.stored.poes[a].total_cmp(&report.stored.poes[b])).unwrap_or(0)
}

fn print_figures(
    out: &mut impl Write,
    report: &BootstrapReport,
    poe: usize,
    compared: bool,
) -> Result<(), CommandError> {
    let reference = Some(&report.reference).filter(|rows| compared && !rows.is_empty());
    writeln!(
        out,
        "\nAccuracy of the spectra, {}: error of the median e and width r of the {} interval, per cent{}",
        risk_in_words(report.stored.poes[poe], report.stored.years),
        per_cent(report.confidence),
        if reference.is_some() { "; reference to the right of each bar" } else { "" }
    )?;
    let places = report.stored.sites.iter().enumerate();
    let places = places.flat_map(|site| report.sizes.iter().enumerate().map(move |size| (site, size)));
    let table = Table::from_rows(places)
        .left("site", |((_, name), (index, _))| if index == 0 { name.as_str() } else { "" })
        .right("records", |(_, (_, size))| size)
        .each(&report.bands, |table, bands| {
            let (label, of) = (bands.measure.label(), &bands.plain);
            let printed = |name: &str, size: u32| {
                let is_own =
                    |row: &&ReferenceRow| row.sample_size == size && row.site.to_lowercase() == name.to_lowercase();
                reference?.iter().find(is_own)?.figures.iter().find(|(key, _)| key == bands.measure.key())
            };
            let error = |name: &str, size| printed(name, size).map(|(_, figures)| format!("{:.1}", figures[0]));
            let range = |name: &str, size| printed(name, size).map(|(_, figures)| format!("{:.0}", figures[1]));
            let dash = || "-".to_owned();
            table
                .right(format!("{label} e"), |((site, _), (size, _))| figure(of.error_of_median[[site, poe, size]], 1))
                .right("r", |((site, _), (size, _))| figure(of.range_of_interval[[site, poe, size]], 0))
                .when(reference.is_some(), |table| {
                    table
                        .bar("e", |((_, name), (_, &size))| error(name, size).unwrap_or_else(dash))
                        .right("r", |((_, name), (_, &size))| range(name, size).unwrap_or_else(dash))
                })
        });
    writeln!(out, "{table}")?;
    Ok(())
}

/// The figures of repaired spectra, beside those of the plain ones.
fn print_repaired(out: &mut impl Write, report: &BootstrapReport) -> Result<(), CommandError> {
    let mut rows = Vec::new();
    let mut failing = Vec::new();
    for row in &report.rows {
        let Some(repaired) = row.repaired else { continue };
        let percent = |value: Option<f64>, digits: usize| figure(value.unwrap_or(f64::NAN), digits);
        rows.push(vec![
            row.site.clone(),
            row.im.to_owned(),
            risk_name(row.poe, report.stored.years),
            row.sample_size.to_string(),
            percent(row.r_90ci, 0),
            percent(repaired.e_median, 1),
            percent(repaired.r_90ci, 0),
            format!("{:.1}", repaired.failed),
        ]);
        let told = format!("{} by {}, samples of {}: {:.0} %", row.site, row.im, row.sample_size, repaired.failed);
        if repaired.failed > 100.0 * MANY_FAILED && !failing.contains(&told) {
            failing.push(told);
        }
    }
    if rows.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "\nRepaired spectra, weights solved for every resample: e and r of the {} interval, r of the plain spectra, \
         and resamples whose weights miss the hazard, per cent",
        per_cent(report.confidence)
    )?;
    let header = ["site", "im", "probability", "records", "plain r", "repaired e", "repaired r", "failed"];
    writeln!(out, "{}", Table::new(header, rows))?;
    if !failing.is_empty() {
        writeln!(out, "{}", too_many_fail("samples", &failing))?;
    }
    Ok(())
}

/// What the records say beyond themselves: for the rarest probability, samples of their own number.
fn print_inferred(out: &mut impl Write, report: &BootstrapReport) -> Result<(), CommandError> {
    let own = u32::try_from(report.stored.records.len()).unwrap_or(u32::MAX);
    let size = if report.sizes.contains(&own) { Some(own) } else { report.sizes.iter().copied().max() };
    let rarest = report.stored.poes.iter().copied().min_by(f64::total_cmp);
    let (Some(size), Some(poe)) = (size, rarest) else { return Ok(()) };
    let limits = |[lower, upper]: [f64; 2]| [format!("{lower:+.0}"), format!("{upper:+.0}")];
    let rows: Vec<Vec<String>> = report
        .rows
        .iter()
        .filter(|row| row.sample_size == size && row.poe.total_cmp(&poe).is_eq())
        .map(|row| {
            let mut shown = vec![row.site.clone(), row.im.to_owned()];
            let Some(found) = row.inferred else {
                shown.extend(["-"; 5].map(str::to_owned));
                return shown;
            };
            shown.push(format!("{:.3}", found.strength));
            shown.extend(limits(found.truth).into_iter().chain(limits(found.prediction)));
            shown
        })
        .collect();
    writeln!(
        out,
        "\nConfidence and prediction bands, {}: the spectrum of all records like these, and of another set of {size}, \
         each with {} confidence; limits in per cent of the ordinate, at the strength where the confidence band is \
         widest in metres",
        risk_in_words(poe, report.stored.years),
        per_cent(report.confidence)
    )?;
    let header = ["site", "im", "strength", "truth from", "to", "another set from", "to"];
    writeln!(out, "{}", Table::new(header, rows))?;
    Ok(())
}

/// How wide the band is for each number of records, over all sites.
fn print_sizes(out: &mut impl Write, report: &BootstrapReport, shown: &DisplacementReport) -> Result<(), CommandError> {
    let width = |own: &Displacement| own.band_m.map_or(0.0, |[lower_m, upper_m]| (upper_m - lower_m) / own.u_m);
    let banded = shown.displacements.iter().filter(|own| own.u_m.is_finite() && width(own) > 0.0);
    let Some(widest) = banded.max_by(|a, b| width(a).total_cmp(&width(b))) else { return Ok(()) };
    let stored = &report.stored;
    let at_site = stored.sites.iter().position(|site| *site == widest.site);
    let at_poe = stored.poes.iter().position(|poe| poe.total_cmp(&widest.poe).is_eq());
    let at_strength = stored.strengths.iter().position(|strength| strength.total_cmp(&widest.strength).is_eq());
    let bands = report.bands.iter().find(|bands| bands.measure.label() == widest.im);
    let inferred = bands.and_then(|bands| bands.inferred.as_ref());
    let (Some(site), Some(poe), Some(strength), Some(inferred)) = (at_site, at_poe, at_strength, inferred) else {
        return Ok(());
    };
    let (site_name, at) = (&widest.site, widest.strength);
    writeln!(
        out,
        "\nWidest for its ordinate: {site_name}, strength {at}, {} m; its limits by the number of records",
        two_digits(widest.u_m)
    )?;
    for (size, count) in report.sizes.iter().enumerate() {
        let [lower, upper] = inferred.truth_m.each_ref().map(|limits| limits.block([site, poe, size])[strength]);
        let upper = if upper.is_finite() { format!("{} m", two_digits(upper)) } else { "overturning".to_owned() };
        writeln!(out, "  {count} records: {} to {upper}", two_digits(lower))?;
    }
    Ok(())
}

/// Records and hazard together, for the sites with weighted hazard curves; of the plain spectra and of the repaired
/// ones.
fn print_joint(out: &mut impl Write, report: &BootstrapReport) -> Result<(), CommandError> {
    let has_repaired = report.bands.iter().any(|bands| repaired_joint(bands).is_some());
    let (mut rows, mut failing) = (Vec::new(), Vec::new());
    for bands in &report.bands {
        let Some(joint) = &bands.plain.joint else { continue };
        for (at @ [site, poe, size], of_records) in bands.plain.range_of_interval.blocks() {
            if !joint.sites.contains(&site) {
                continue;
            }
            let (name, label, records) = (&report.stored.sites[site], bands.measure.label(), report.sizes[size]);
            let mut row = vec![
                name.clone(),
                label.to_owned(),
                risk_name(report.stored.poes[poe], report.stored.years),
                records.to_string(),
                figure(of_records[0], 0),
                figure(joint.range_of_interval[at], 0),
            ];
            if has_repaired {
                let of_repair = repaired_joint(bands);
                let failed = of_repair.and_then(|joint| Some(joint.failed.as_ref()?[[site, size]])).unwrap_or(f64::NAN);
                let repaired = bands.repaired.as_ref().map(|own| own.bands.range_of_interval[at]);
                row.push(figure(repaired.unwrap_or(f64::NAN), 0));
                row.push(figure(of_repair.map_or(f64::NAN, |joint| joint.range_of_interval[at]), 0));
                row.push(figure(100.0 * failed, 1));
                if poe == 0 && failed > MANY_FAILED {
                    failing.push(format!("{name} by {label}, samples of {records}: {:.0} %", 100.0 * failed));
                }
            }
            rows.push(row);
        }
    }
    if rows.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "\nRecords and hazard together: width r of the {} interval over the records, and over the records and the \
         weighted hazard curves{}, per cent",
        per_cent(report.confidence),
        if has_repaired {
            "; the same for the repaired spectra, and how many of their weights do not match the hazard of the curve"
        } else {
            ""
        }
    )?;
    let header = ["site", "im", "probability", "records", "r", "joint r", "repaired r", "repaired joint r", "failed"];
    writeln!(out, "{}", Table::new(header.into_iter().take(if has_repaired { 9 } else { 6 }), rows))?;
    if !failing.is_empty() {
        writeln!(out, "{}", too_many_fail("pairs of a sample and a hazard curve", &failing))?;
    }
    Ok(())
}

/// The joint bands of the repaired spectra by a measure.
fn repaired_joint(bands: &MeasureBands) -> Option<&StoredJointBands> {
    bands.repaired.as_ref()?.bands.joint.as_ref()
}

/// That many of `what` fail.
fn too_many_fail(what: &str, failing: &[String]) -> String {
    format!("Weights fail for many {what}, so the band is repaired only in part ({}): add records", failing.join("; "))
}

/// The bands where rocking begins (Section 4.5.2, Fig. 4.10).
fn print_initiation(out: &mut impl Write, report: &BootstrapReport) -> Result<(), CommandError> {
    let Some(size_index) = (0..report.sizes.len()).max_by_key(|&index| report.sizes[index]) else { return Ok(()) };
    // the most frequent shaking is the one that may not lift the structure
    let Some(poe) =
        (0..report.stored.poes.len()).max_by(|&a, &b| report.stored.poes[a].total_cmp(&report.stored.poes[b]))
    else {
        return Ok(());
    };
    let mut rows = Vec::new();
    for (site, name) in report.stored.sites.iter().enumerate() {
        for (index, bands) in report.bands.iter().enumerate() {
            let mut row = vec![if index == 0 { name.clone() } else { String::new() }];
            row.push(bands.measure.label().to_owned());
            row.extend(initiation(report.initiation(&bands.plain, [site, poe, size_index])));
            rows.push(row);
        }
    }
    writeln!(
        out,
        "\nRocking initiation, {}, samples of {}: strength at which the limits and the median fall to the\n\
         uplift displacement of {} m, and the width of the interval there over the median",
        risk_in_words(report.stored.poes[poe], report.stored.years),
        report.sizes[size_index],
        report.stored.uplift_displacement_m
    )?;
    let header = ["site", "im", "lower", "median", "upper", "width of u, %"];
    writeln!(out, "{}", Table::new(header, rows))?;
    Ok(())
}

fn figure(per_cent: f64, digits: usize) -> String {
    if per_cent.is_nan() { "-".to_owned() } else { format!("{per_cent:.digits$}") }
}

/// Strengths at which the lower limit, the median and the upper limit fall to the uplift displacement, and the width of
/// the band at that of the median.
fn initiation(found: Initiation) -> [String; 4] {
    let strength = |strength: Option<f64>| strength.map_or_else(|| "above all".to_owned(), |eta| format!("{eta:.3}"));
    let [lower, median, upper] = [found.lower, found.median, found.upper].map(strength);
    [lower, median, upper, figure(100.0 * found.width.unwrap_or(f64::NAN), 0)]
}
