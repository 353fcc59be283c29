//! What is written: names and text of the curve files, and the lines for a study.

use std::collections::BTreeSet;
use std::path::Path;

use uplift_hazard::{ExportedCurve, HazardCurve, Statistic};
use uplift_motion::IntensityMeasure;

/// A curve with the file that it is written to.
pub(super) struct Chosen {
    pub(super) exported: ExportedCurve,
    pub(super) file: String,
    pub(super) weight: Option<f64>,
}

/// `pgv`, `pgv-quantile-0.15`, `pga-realization-003`, …
pub(super) fn file_stem(exported: &ExportedCurve) -> String {
    let measure: String =
        exported.curve.measure().to_lowercase().chars().filter(|c| c.is_ascii_alphanumeric() || *c == '.').collect();
    match &exported.kind {
        Statistic::Quantile(quantile) => format!("{measure}-quantile-{quantile}"),
        Statistic::Realization(number) => format!("{measure}-realization-{number:03}"),
        Statistic::Branch(path) => {
            let fitting = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
            format!("{measure}-{}", path.chars().map(fitting).take(80).collect::<String>())
        }
        _ => measure,
    }
}

pub(super) fn curve_text(curve: &HazardCurve, exported: &ExportedCurve) -> String {
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
        format!("written by uplift {} ({})", uplift_job::VERSION, uplift_job::COMMIT),
    ];
    curve.to_csv(&remarks)
}

/// Whether a curve is of `measure`.
pub(super) fn is_of(curve: &HazardCurve, measure: IntensityMeasure) -> bool {
    curve.measure().parse().is_ok_and(|own: IntensityMeasure| own == measure)
}

/// The measures that a study can take curves of, in their order.
pub(super) fn measures_of(written: &[Chosen]) -> BTreeSet<IntensityMeasure> {
    let measures = written.iter().filter_map(|written| written.exported.curve.measure().parse().ok());
    measures.filter(|measure: &IntensityMeasure| measure.can_be_scaled_to()).collect()
}

/// The section of a study that uses what was written.
pub(super) fn study_lines(written: &[Chosen], folder: &Path, site: &str) -> String {
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let path = |file: &str| quoted(&folder.join(file).display().to_string());
    let mut lines = vec!["[[sites]]".to_owned(), format!("name = {}", quoted(site))];
    for measure in measures_of(written) {
        let key = measure.key();
        let of = |written: &&Chosen| is_of(&written.exported.curve, measure);
        let single = |written: &&Chosen| matches!(written.exported.kind, Statistic::Mean | Statistic::Unspecified);
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
    // a site without a curve that a study takes has no lines
    if lines.len() > 2 { lines.join("\n") + "\n" } else { String::new() }
}
