//! `uplift hazard import`: curve files of a site from what an engine exports.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use uplift_hazard::{
    ComponentDefinition, ExportedCurve, HazardCurve, RealizationWeight, Statistic, read_export,
    read_realization_weights,
};

use uplift_motion::IntensityMeasure;

use super::{CommandError, SiteArguments, Terminal, distinct};
use uplift::result::write_atomically;
use uplift_study::levels_within;

/// Distance of a site from the place asked for that needs no word, km.
const NEAR_KM: f64 = 10.0;

#[derive(Debug, Args)]
pub(super) struct ImportArguments {
    /// Exports: OpenQuake CSV or NRML, USGS JSON; several files for several measures, or for the realizations of a logic tree
    #[arg(required = true, value_name = "EXPORT")]
    exports: Vec<PathBuf>,
    /// Folder for the curve files; made if it is not there
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    #[command(flatten)]
    site: SiteArguments,
    /// How the ground-motion models combine horizontal components: geometric mean, GMRotI50, RotD50, RotD100, larger, arbitrary. Exports do not say it
    #[arg(long, value_name = "WORD")]
    component: Option<ComponentDefinition>,
    /// Weights of the realizations (OpenQuake's realizations_*.csv)
    #[arg(long, value_name = "FILE")]
    weights: Option<PathBuf>,
    /// Refuse a site farther from --near than this, km
    #[arg(long, value_name = "KM", default_value_t = 100.0)]
    within_km: f64,
}

/// How far apart two exports may have the same site, km.
const ONE_PLACE_KM: f64 = 1.0;

/// A curve with the file it is written to.
struct Written {
    exported: ExportedCurve,
    file: String,
    weight: Option<f64>,
}

pub(super) fn import(arguments: &ImportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let fail = |error: uplift_hazard::HazardError| CommandError::input(error.to_string());
    let weights = arguments.weights.as_ref().map(|path| read_realization_weights(path)).transpose().map_err(fail)?;
    let mut curves: Vec<ExportedCurve> = Vec::new();
    for export in distinct(&arguments.exports) {
        curves.extend(read_export(export, &arguments.site.selection()).map_err(fail)?);
    }
    let site = one_site(&curves, arguments)?;
    if let Some(weights) = &weights {
        check_weights(&curves, weights)?;
    }
    if let Some(distance_km) = curves.iter().filter_map(|curve| curve.distance_km).reduce(f64::max) {
        // a NaN is no distance to be within
        if !(distance_km <= arguments.within_km) {
            return Err(CommandError::input(format!(
                "the nearest site, {site}, is {distance_km:.1} km away: give a nearer place, or --within-km {:.0} if it will do",
                distance_km.ceil()
            )));
        }
        let far = if distance_km > NEAR_KM { ": is that near enough?" } else { "" };
        terminal.say(&format!("nearest site: {site}, {distance_km:.1} km away{far}"));
    }
    let mut written: Vec<Written> = Vec::new();
    for exported in curves {
        let file = format!("{}.csv", file_stem(&exported));
        if written.iter().any(|other| other.file == file) {
            return Err(CommandError::input(format!(
                "two curves of {} {} for {site}: give the export of one calculation",
                exported.curve.measure(),
                exported.kind
            )));
        }
        let weight = weights.as_ref().and_then(|weights| weight_of(&exported.kind, weights));
        written.push(Written { exported, file, weight });
    }
    let folder = &arguments.output;
    std::fs::create_dir_all(folder)
        .map_err(|error| CommandError::input(format!("{} cannot be made: {error}", folder.display())))?;
    for Written { exported, file, .. } in &written {
        for (count, what) in [
            (exported.dropped_zeros, "level(s) of zero at the end"),
            (exported.dropped_certain, "level(s) of probability 1 at the start"),
        ] {
            if count > 0 {
                terminal.say(&format!("{file}: {count} {what} left out: no rate belongs to them"));
            }
        }
        let curve = exported.curve.clone();
        let component = curve.component().or(arguments.component);
        let (path, text) = (folder.join(file), curve_text(&curve.with_component(component), exported));
        if std::fs::read(&path).is_ok_and(|there| there != text.as_bytes()) {
            return Err(CommandError::Usage(format!(
                "{} is there already, with another curve: give another folder with -o, or remove it",
                path.display()
            )));
        }
        write_atomically(&path, text.as_bytes())?;
    }
    if arguments.component.is_none() && written.iter().any(|written| written.exported.curve.component().is_none()) {
        terminal.say(
            "the exports do not say how horizontal components are combined: --component says it, and a study checks it",
        );
    }
    for remark in remarks(&written) {
        terminal.say(&remark);
    }
    let mut out = std::io::stdout().lock();
    write!(out, "{}", study_lines(&written, folder, &site))?;
    Ok(())
}

/// Refuses weights of only some realizations of a measure.
fn check_weights(curves: &[ExportedCurve], weights: &BTreeMap<u32, RealizationWeight>) -> Result<(), CommandError> {
    let mut sums: BTreeMap<&str, (f64, usize)> = BTreeMap::new();
    for curve in curves {
        if let Some(weight) = weight_of(&curve.kind, weights) {
            let sum = sums.entry(curve.curve.measure()).or_default();
            *sum = (sum.0 + weight, sum.1 + 1);
        }
    }
    match sums.iter().find(|(_, (sum, _))| (sum - 1.0).abs() > 1e-4) {
        Some((measure, (sum, count))) => Err(CommandError::input(format!(
            "{measure}: {count} of {} realizations are given, and their weights add up to {sum:.4}: give the exports of all realizations",
            weights.len()
        ))),
        None => Ok(()),
    }
}

/// What the user should know before a study takes the curves.
fn remarks(written: &[Written]) -> Vec<String> {
    let mut remarks = Vec::new();
    for measure in IntensityMeasure::ALL {
        let of: Vec<&HazardCurve> = (written.iter().map(|written| &written.exported.curve))
            .filter(|curve| curve.measure().eq_ignore_ascii_case(measure.key()))
            .collect();
        let least = of.iter().map(|curve| curve.first().im).fold(0.0, f64::max);
        let most = of.iter().map(|curve| curve.last().im).fold(f64::INFINITY, f64::min);
        if let (false, Some((key, levels))) = (of.is_empty(), levels_within(measure, least, most)) {
            let unit = measure.unit();
            remarks.push(format!(
                "the {measure} curves span {least:.4} to {most:.4} {unit}, and the default stripes do not: in the study, {key} = {levels} (or risk.extrapolate = \"loglog\")"
            ));
        }
    }
    let weighted = |written: &Written| written.weight.is_some();
    let single = |written: &Written| matches!(written.exported.kind, Statistic::Mean | Statistic::Unspecified);
    if !written.iter().any(|written| weighted(written) || single(written)) {
        remarks.push(
            "no mean among the exports: for a study give the mean too, or all realizations with --weights".to_owned(),
        );
    }
    remarks
}

/// The name of the site that all curves belong to.
fn one_site(curves: &[ExportedCurve], arguments: &ImportArguments) -> Result<String, CommandError> {
    let Some(first) = curves.first() else {
        return Err(CommandError::input("the export holds no hazard curve".to_owned()));
    };
    let key = |curve: &ExportedCurve| {
        (curve.site.name.clone(), curve.site.longitude_deg.to_bits(), curve.site.latitude_deg.to_bits())
    };
    let mut sites: Vec<_> = curves.iter().map(key).collect();
    sites.sort();
    sites.dedup();
    // several engines write the same place with other digits
    let chosen = arguments.site.name.is_some() || arguments.site.near.is_some();
    if let (true, Some(other)) = (
        chosen,
        curves
            .iter()
            .find(|other| other.site.distance_km(first.site.longitude_deg, first.site.latitude_deg) > ONE_PLACE_KM),
    ) {
        return Err(CommandError::input(format!(
            "the exports give two places for one site, {} and {}, {:.1} km apart: import them one by one, or give exports of the same sites",
            first.site,
            other.site,
            other.site.distance_km(first.site.longitude_deg, first.site.latitude_deg)
        )));
    }
    if sites.len() > 1 && !chosen {
        return Err(CommandError::Usage(format!(
            "the exports hold {} sites: pick one by --near LON,LAT{}",
            sites.len(),
            if sites.iter().any(|(name, ..)| name.is_some()) { " or --name NAME" } else { "" }
        )));
    }
    Ok(first.site.name.clone().unwrap_or_else(|| format!("{} {}", first.site.longitude_deg, first.site.latitude_deg)))
}

/// `pgv`, `pgv-quantile-0.15`, `pga-realization-003`, …
fn file_stem(exported: &ExportedCurve) -> String {
    let measure: String =
        exported.curve.measure().to_lowercase().chars().filter(|c| c.is_ascii_alphanumeric() || *c == '.').collect();
    match &exported.kind {
        Statistic::Quantile(quantile) => format!("{measure}-quantile-{quantile}"),
        Statistic::Realization(number) => format!("{measure}-realization-{number:03}"),
        Statistic::Branch(path) => {
            let fitting = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
            format!("{measure}-{}", path.chars().map(fitting).take(80).collect::<String>())
        }
        Statistic::Mean | Statistic::Unspecified => measure,
    }
}

fn weight_of(kind: &Statistic, weights: &BTreeMap<u32, RealizationWeight>) -> Option<f64> {
    match kind {
        Statistic::Realization(number) => weights.get(number).map(|weight| weight.weight),
        Statistic::Branch(path) => {
            weights.values().find(|weight| weight.branch_path == *path).map(|weight| weight.weight)
        }
        Statistic::Mean | Statistic::Quantile(_) | Statistic::Unspecified => None,
    }
}

fn curve_text(curve: &HazardCurve, exported: &ExportedCurve) -> String {
    let site = &exported.site;
    // a name must not be taken for what the lines of a curve declare
    let plain = |name: &String| name.replace([';', ',', ':', '#', '\n', '\r'], " ");
    let name = site.name.as_ref().map_or_else(String::new, |name| format!("site: {}; ", plain(name)));
    let vs30 = exported.vs30_m_s.map_or_else(String::new, |vs30| format!("; Vs30 {vs30} m/s"));
    let rate = match exported.investigation_years {
        Some(years) => format!("mean annual frequency of exceedance, 1/yr, as -ln(1 - p)/T with T = {years} yr"),
        None => "mean annual frequency of exceedance, 1/yr".to_owned(),
    };
    let remarks = [
        format!("{name}longitude {}; latitude {}{vs30}; {}", site.longitude_deg, site.latitude_deg, exported.kind),
        format!("maf: {rate}"),
        format!("from: {}", curve.source()),
        format!("written by uplift {} ({})", uplift::VERSION, uplift::COMMIT),
    ];
    curve.to_csv(&remarks)
}

/// The section of a study that uses what was written.
fn study_lines(written: &[Written], folder: &Path, site: &str) -> String {
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let path = |file: &str| quoted(&folder.join(file).display().to_string());
    let mut lines = vec!["[[sites]]".to_owned(), format!("name = {}", quoted(site))];
    for key in ["pgv", "pga"] {
        let of = |written: &&Written| written.exported.curve.measure().eq_ignore_ascii_case(key);
        let single = |written: &&Written| matches!(written.exported.kind, Statistic::Mean | Statistic::Unspecified);
        let mean = written.iter().filter(of).find(single).map(|written| path(&written.file));
        let branches: Vec<String> = written
            .iter()
            .filter(of)
            .filter_map(|written| {
                let weight = written.weight?;
                Some(format!("    {{ file = {}, weight = {weight} }},\n", path(&written.file)))
            })
            .collect();
        match (mean, branches.as_slice()) {
            (None, []) => {}
            (Some(mean), []) => lines.push(format!("{key} = {mean}")),
            (mean, branches) => {
                let file = mean.map_or_else(String::new, |mean| format!("file = {mean}, "));
                lines.push(format!("{key} = {{ {file}branches = [\n{}] }}", branches.concat()));
            }
        }
    }
    let used = lines.len() > 2;
    let mut text = lines.join("\n") + "\n";
    if !used {
        text = String::new();
    }
    let names: Vec<&str> = written.iter().map(|written| written.file.as_str()).collect();
    format!("# {} curve(s) in {}: {}\n{text}", written.len(), folder.display(), names.join(", "))
}
