//! The sites of a study and the files of their hazard curves.

use uplift_motion::IntensityMeasure;

use super::branches;
use super::document::Value;
use super::measures::{MEASURES, MeasureKeys};
use super::paths::Folders;
use super::reader::{ABOVE_ZERO, Field, Section};
use super::resolved::{CurveFile, CurveKind, Site};

/// Most sites in one study.
const MOST_SITES: usize = 1000;

/// Longest name of a site or record set, in bytes.
const LONGEST_NAME: usize = 100;

/// Reads the sites; each must have a curve of each measure in `measures`.
pub(super) fn read(field: Option<Field<'_>>, measures: &[IntensityMeasure], folders: &Folders) -> Option<Vec<Site>> {
    let Some(field) = field else {
        return Some(Vec::new());
    };
    let Value::List(_) = field.node.value else {
        return field.wrong_type("a list of sections", "head each site with [[sites]], in double brackets");
    };
    let items = field.items();
    if items.len() > MOST_SITES {
        field.mistake(format!("there are {} sites", items.len()), format!("give at most {MOST_SITES}"));
        return None;
    }
    let mut sites = Some(Vec::new());
    let mut names: Vec<String> = Vec::new();
    for item in items {
        let site = site(&item, measures, folders, &mut names);
        match (&mut sites, site) {
            (Some(sites), Some(site)) => sites.push(site),
            _ => sites = None,
        }
    }
    sites
}

fn site(item: &Field<'_>, measures: &[IntensityMeasure], folders: &Folders, names: &mut Vec<String>) -> Option<Site> {
    let mut section = item.section();
    if !section.is_present() {
        return None;
    }
    let name = unique_name(&mut section, "site", "Athens", names);
    let mut curves = Some(Vec::new());
    for keys in &MEASURES {
        let (key, measure) = (keys.section, keys.measure);
        let Some(field) = section.field(key) else {
            if measures.contains(&measure) {
                section.mistake(
                    key,
                    format!(
                        "{} has no {} curve, and the study has a section [{key}]",
                        name.as_deref().unwrap_or("the site"),
                        measure.label()
                    ),
                    format!("add {key} = \"path of the curve\" to the site, or remove [{key}]"),
                );
                curves = None;
            }
            continue;
        };
        match (&mut curves, curve(&field, keys, folders)) {
            (Some(curves), Some(curve)) => curves.push(curve),
            _ => curves = None,
        }
    }
    section.finish();
    Some(Site { name: name?, curves: curves? })
}

/// The name of a section of a list of `what`, of no other among `names` and fit for a group of the result file.
pub(super) fn unique_name(
    section: &mut Section<'_>,
    what: &str,
    example: &str,
    names: &mut Vec<String>,
) -> Option<String> {
    let Some(field) = section.field("name") else {
        section.mistake("name", format!("the {what} has no name"), format!("add name = \"{example}\""));
        return None;
    };
    let name = field.filled_text()?.trim();
    // The name is one of a group in the result file, and part of file names.
    let unfit = name.len() > LONGEST_NAME
        || matches!(name, "." | "..")
        || name.contains(|letter: char| letter.is_control() || "/\\:*?\"<>|".contains(letter));
    if unfit {
        field.mistake(
            "the name cannot name a group of the result file",
            format!("use at most {LONGEST_NAME} bytes, and none of / \\ : * ? \" < > |"),
        );
        return None;
    }
    let folded = name.to_lowercase();
    if names.contains(&folded) {
        field.mistake(
            format!("there is another {what} {name}"),
            format!("give each {what} a name of its own; capitals make no difference"),
        );
        return None;
    }
    names.push(folded);
    Some(name.to_owned())
}

fn curve(field: &Field<'_>, keys: &MeasureKeys, folders: &Folders) -> Option<CurveFile> {
    let measure = keys.measure;
    match field.node.value {
        Value::Text(_) => {
            return Some(CurveFile {
                measure,
                file: Some(folders.input(field)?),
                unit: keys.default_unit,
                kind: CurveKind::Maf,
                branches: Vec::new(),
            });
        }
        Value::Table(_) => {}
        _ => {
            return field.wrong_type(
                "the path of a hazard curve",
                "write \"path\", or { file = \"path\", unit = …, kind = … }",
            );
        }
    }
    let mut section = field.section();
    let branches = section.field("branches").map_or(Some(Vec::new()), |field| branches::read(&field, folders));
    let file = match (section.field("file"), &branches) {
        (Some(field), _) => folders.input(&field).map(Some),
        // branches with mistakes are still branches
        (None, None) => Some(None),
        (None, Some(branches)) if !branches.is_empty() => Some(None),
        (None, Some(_)) => {
            section.mistake("file", "the curve has no file", "add file = \"path\", or branches = [ … ]");
            None
        }
    };
    let unit = section.field("unit").map_or(Some(keys.default_unit), |field| field.choice(keys.units));
    let kind = kind(&mut section);
    section.finish();
    Some(CurveFile { measure, file: file?, unit: unit?, kind: kind?, branches: branches? })
}

fn kind(section: &mut Section<'_>) -> Option<CurveKind> {
    let is_poe = section.field("kind").map_or(Some(false), |field| field.choice(&[("maf", false), ("poe", true)]));
    let years_field = section.field("years");
    let years = (years_field.as_ref()).map(|field| field.number("yr", ABOVE_ZERO));
    match (is_poe?, years) {
        (true, Some(years)) => Some(CurveKind::Poe { years: years? }),
        (true, None) => {
            section.mistake(
                "years",
                "the curve gives probabilities, of exceedance in how many years?",
                "add years = 1 or years = 50, as the file says",
            );
            None
        }
        (false, None) => Some(CurveKind::Maf),
        (false, Some(_)) => {
            if let Some(field) = years_field {
                field.mistake(
                    "annual frequencies have no time",
                    "write kind = \"poe\" for probabilities, or leave `years` out",
                );
            }
            None
        }
    }
}
