//! From the document to the resolved study: every section, key by key.

use std::path::Path;

use uplift_motion::STANDARD_GRAVITY_M_S2;

use super::bootstrap;
use super::form::{CONTOURS, EXTRAPOLATIONS};
use super::grid::{Grid, GridRule};
use super::hazard;
use super::measures;
use super::paths::{Folders, tidy};
use super::reader::{
    ABOVE_ZERO, Field, Ledger, PROBABILITY, Rule, Section, ZERO_OR_MORE, ZERO_TO_ONE, optional, quantity,
};
use super::records;
use super::resolved::{
    Contour, CurveFile, Extrapolate, Oscillator, Output, RecordSource, Regression, ResolvedStudy, Risk, Uplifted,
};
use super::site_table;
use super::sites;
use super::warnings;

/// The first key of a study of displacement spectra.
pub const DISPLACEMENT_SPECTRA: &str = "displacement spectra";
/// What a study is of; uniform risk unless its first key says otherwise.
const KINDS: [(&str, Kind); 2] =
    [("uniform risk spectra", Kind::UniformRisk), (DISPLACEMENT_SPECTRA, Kind::Displacement)];

/// 301 values, 0 to 1 in steps of 1/300.
pub(super) const STRENGTHS: [&str; 1] = ["0:1/300:1"];

/// 3002 values \[m\].
const THRESHOLDS_M: [&str; 3] = ["0", "0.0005", "0.001:0.001:3"];

/// Most probabilities, each a spectrum for every site.
const MOST_PROBABILITIES: usize = 1000;

/// A micrometre: less is no structure, and an oscillator so stiff that no motion resolves it.
pub(super) const UPLIFT_DISPLACEMENT: Rule = Rule { holds: |value| value >= 1e-6, words: "1e-6 m or above" };

/// What a study is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    UniformRisk,
    Displacement,
}

/// What the study is of; none where its `kind` is wrong.
pub(super) fn kind(root: &mut Section<'_>) -> Option<Kind> {
    root.field("kind").map_or(Some(Kind::UniformRisk), |field| field.choice(&KINDS))
}

/// Reads the whole study; what is wrong goes into the ledger. None where something is.
pub(super) fn study(
    mut root: Section<'_>,
    ledger: &Ledger,
    folders: &Folders,
    study_file: &Path,
) -> Option<ResolvedStudy> {
    let title = root.field("title").map(|field| field.text().map(str::to_owned));
    let seed = root.seed_or(1);
    let gravity = root.number_or("gravity_m_s2", "m/s2", ABOVE_ZERO, STANDARD_GRAVITY_M_S2);
    let records = records::read(root.section("records"), folders);
    let oscillator = oscillator(root.section("oscillator"));
    let strengths = strengths(root.section("strengths"), ledger);
    let switched_on = measures::switched_on(&mut root);
    let measures = measures::read(&mut root, ledger);
    let risk = risk(root.section("risk"), ledger);
    let hazard = hazard::read(root.section("hazard"));
    let sites = sites::read(root.field("sites"), &switched_on, folders);
    let site_table = site_table::read(root.field("site_table").as_ref(), &switched_on, strengths.as_ref(), folders);
    let regression = regression(root.section("regression"));
    let bootstrap = bootstrap::read(root.section("bootstrap"));
    let inputs = (records.iter())
        .filter_map(|records| match &records.source {
            RecordSource::Manifest { manifest, .. } => Some(manifest.as_path()),
            RecordSource::Synthetic { .. } => None,
        })
        .chain(sites.iter().flatten().flat_map(|site| site.curves.iter().flat_map(CurveFile::files)))
        .chain(site_table.iter().flatten().flat_map(site_table::SiteTable::files))
        .chain([study_file]);
    let output = output(root.section("output"), folders, study_file, inputs);
    root.finish();
    let mut study = ResolvedStudy {
        title: title.unwrap_or_else(|| Some(String::new()))?,
        seed: seed?,
        gravity_m_s2: gravity?,
        records: records?,
        oscillator: oscillator?,
        strengths: strengths?,
        measures: measures?,
        risk: risk?,
        hazard: hazard?,
        sites: sites?,
        site_table: site_table?,
        regression: regression?,
        bootstrap: bootstrap?,
        output: output?,
        warnings: Vec::new(),
    };
    study.warnings = warnings::of(&study);
    Some(study)
}

fn oscillator(mut section: Section<'_>) -> Option<Oscillator> {
    let uplift = section.number_or("uplift_displacement_m", "m", UPLIFT_DISPLACEMENT, 0.0005);
    let restitution = section.number_or("restitution", "", ZERO_TO_ONE, 0.95);
    let free_vibration = section.boolean_or("free_vibration", true);
    let capacity_field = section.field("capacity_m");
    let stiffness_field = section.field("post_uplift_stiffness_per_s2");
    section.finish();
    let capacity = optional(capacity_field.as_ref(), |field| field.number("m", ABOVE_ZERO));
    let stiffness = optional(stiffness_field.as_ref(), |field| field.number("1/s2", ABOVE_ZERO));
    if let (Some(field), Some(Some(capacity)), Some(uplift)) = (&capacity_field, capacity, uplift)
        && capacity <= uplift
    {
        field.mistake(
            format!(
                "the capacity {} is not above the uplift displacement {}",
                quantity(capacity, "m"),
                quantity(uplift, "m")
            ),
            "raise it, or leave it out for an oscillator that never overturns",
        );
    }
    if let (Some(_), Some(field)) = (&capacity_field, &stiffness_field) {
        field.mistake(
            "a positive stiffness after uplift excludes a capacity",
            "keep `capacity_m` (force falls) or this key (force rises), not both",
        );
    }
    let uplifted = match (capacity?, stiffness?) {
        (Some(capacity_m), _) => Uplifted::NegativeStiffness { capacity_m },
        (None, Some(stiffness_per_s2)) => Uplifted::PositiveStiffness { stiffness_per_s2 },
        (None, None) => Uplifted::ZeroStiffness,
    };
    Some(Oscillator {
        uplift_displacement_m: uplift?,
        restitution: restitution?,
        free_vibration: free_vibration?,
        uplifted,
    })
}

fn strengths(mut section: Section<'_>, ledger: &Ledger) -> Option<Grid> {
    let rule = GridRule { unit: "", each: ZERO_OR_MORE, least_count: 1 };
    let strengths = Grid::of_key(&mut section, "values", rule, &STRENGTHS, ledger);
    section.finish();
    strengths
}

fn risk(mut section: Section<'_>, ledger: &Ledger) -> Option<Risk> {
    let poe = section.field("poe").map_or_else(|| Some(vec![0.02, 0.10, 0.50]), |field| probabilities(&field));
    let years = section.number_or("years", "yr", ABOVE_ZERO, 50.0);
    let contour = section.field("contour").map_or(Some(Contour::Exact), |field| field.choice(&CONTOURS));
    let rule =
        GridRule { unit: "m", each: ZERO_OR_MORE, least_count: if contour == Some(Contour::Grid) { 2 } else { 1 } };
    let thresholds_m = Grid::of_key(&mut section, "thresholds_m", rule, &THRESHOLDS_M, ledger);
    let maf_surface = section.boolean_or("maf_surface", true);
    let extrapolate =
        section.field("extrapolate").map_or(Some(Extrapolate::Refuse), |field| field.choice(&EXTRAPOLATIONS));
    section.finish();
    Some(Risk {
        poe: poe?,
        years: years?,
        contour: contour?,
        thresholds_m: thresholds_m?,
        maf_surface: maf_surface?,
        extrapolate: extrapolate?,
    })
}

fn probabilities(field: &Field<'_>) -> Option<Vec<f64>> {
    let items = field.items();
    if items.is_empty() {
        field.mistake("the list is empty", "give at least one probability, e.g. [0.1]");
        return None;
    }
    if items.len() > MOST_PROBABILITIES {
        field.mistake(
            format!("the list has {} probabilities", items.len()),
            format!("give at most {MOST_PROBABILITIES}"),
        );
        return None;
    }
    let mut complete = true;
    let mut probabilities: Vec<f64> = Vec::new();
    for item in &items {
        match item.number("", PROBABILITY) {
            Some(poe) if probabilities.contains(&poe) => {
                item.mistake(format!("{poe} is given twice"), "give each probability once");
                complete = false;
            }
            Some(poe) => probabilities.push(poe),
            None => complete = false,
        }
    }
    complete.then_some(probabilities)
}

fn regression(mut section: Section<'_>) -> Option<Regression> {
    let strength_above = section.number_or("strength_above", "", ZERO_OR_MORE, 0.05);
    section.finish();
    Some(Regression { strength_above: strength_above? })
}

/// Reads the section `[output]`; the result must be none of the `inputs`.
pub(super) fn output<'a>(
    mut section: Section<'_>,
    folders: &Folders,
    study_file: &Path,
    mut inputs: impl Iterator<Item = &'a Path>,
) -> Option<Output> {
    let csv = section.boolean_or("csv", true);
    let field = section.field("file");
    let file = if let Some(field) = &field {
        folders.output(field)
    } else {
        let stem = study_file.file_stem().unwrap_or("study".as_ref());
        let mut name = stem.to_owned();
        name.push(".h5");
        let file = tidy(&folders.current.join("results").join(name));
        if file.is_dir() || file.to_str().is_none() {
            section.mistake(
                "file",
                format!("the result file cannot be {}", file.display()),
                "give it a name, e.g. file = \"/data/study.h5\"",
            );
        }
        Some(file)
    };
    if let (Some(field), Some(file)) = (&field, &file)
        && inputs.any(|input| input == file)
    {
        field.mistake(
            format!("the results would overwrite an input: {}", file.display()),
            "give the result file a name of its own, e.g. results/study.h5",
        );
    }
    section.finish();
    Some(Output { file: file?, csv: csv? })
}
