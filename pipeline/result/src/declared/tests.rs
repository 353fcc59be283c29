//! The tables of arrays in `docs/hdf5-layout.md` are those declared.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use super::{Group, Names, Quantity, named};
use crate::*;

impl<T> Group<T> {
    /// Its rows of the table of arrays in `docs/hdf5-layout.md`.
    pub(super) fn rows(&self) -> String {
        let row = |quantity: &Quantity<T>| {
            let Quantity { name, unit, long_name, .. } = *quantity;
            let note = if quantity.note.is_empty() { long_name } else { quantity.note };
            let absent = if quantity.is_later { "; absent in older results" } else { "" };
            let unit = if quantity.element() == "text" { String::new() } else { format!(" {unit}") };
            let (path, axes, element) = (self.path, quantity.axes(EXAMPLES).join(", "), quantity.element());
            named(&format!("| `{path}/{name}` | {axes} | {element} |{unit} | {note}{absent} |\n"), EXAMPLES)
                .into_owned()
        };
        self.quantities.iter().map(row).collect()
    }
}

/// The names that `docs/hdf5-layout.md` shows.
const EXAMPLES: Names<'_> = &[
    ("<curve>", "<site>/pgv"),
    ("<axis>", "hazard_<site>_pgv"),
    ("<quantity>", "strength_factor`, `restitution`, `uplift_displacement_m`, `capacity_m"),
    ("<quantity_unit>", "1, 1, m, m"),
    ("<line>", "LINE"),
    ("<of_line>", ""),
    ("<abscissa>", "ABSCISSA"),
    ("<printed>", "printed_ABSCISSA"),
    ("<motion>", "motion_<set>"),
    ("<rounding>", ""),
    ("<rounded>", ""),
    ("<lower>", "u05_m"),
    ("<median>", "u50_m"),
    ("<upper>", "u95_m"),
    ("<of_repaired>", ""),
    ("<other>", "pga"),
    ("<other_unit>", "g"),
    ("<label>", "PGA"),
    ("<unit_key>", "cm_s"),
    ("<unit>", "cm/s"),
    ("<branches>", "branch_<site>_pgv or structure"),
    ("<one>", "branch or structure"),
    ("<many>", "branches or structures"),
    ("<levels>", "<im>_level"),
    ("<with>: ", ""),
    ("<im>", "pgv"),
];

/// The names of groups, their paths, and the rows of their arrays.
macro_rules! rows {
    ($($group:expr),+ $(,)?) => { [$((stringify!($group), $group.path, $group.rows())),+] };
}

/// The names of declared groups, their paths, and the rows of their arrays.
fn declared() -> impl Iterator<Item = (&'static str, &'static str, String)> {
    rows![
        RECORDS,
        MOTION_KEYS,
        INTENSITY,
        DRAWN_STRUCTURE,
        DRAWN_QUANTITY,
        HAZARD_CURVE,
        PEAKS,
        IMPACTS,
        FACTORS,
        SHARES,
        RISK_SURFACE,
        urs::GROUP,
        regression::GROUP,
        REPAIRED_FITS,
        CONSISTENCY,
        DIAGNOSES,
        REPAIRED_LEVELS,
        REPAIRS,
        WEIGHTS,
        REPAIRED_SPECTRA,
        BANDS,
        SIMULTANEOUS_BANDS,
        INFERRED_BANDS,
        FAILED_SAMPLES,
        JOINT_BANDS,
        FAILED_PAIRS,
        DRAWS,
        BRANCH_WEIGHTS,
        EPISTEMIC_SPECTRA,
        EPISTEMIC,
        UNCERTAINTY_SPECTRA,
        UNCERTAINTY,
        REPAIRED_EPISTEMIC_SPECTRA,
        REPAIRED_EPISTEMIC,
        INFLUENCE,
        INFLUENCE_REPAIRED,
        DISAGGREGATION,
        DISAGGREGATION_REPAIRED,
        EFFICIENCY_OF_STRIPES,
        EFFICIENCY,
        TRENDS,
        FINDINGS,
        SPECTRA,
        ROUNDED_SPECTRA,
        SET_SPECTRA,
        MOTIONS,
        RESTRAINED_DESIGN,
        SOLITARY_DESIGN,
        SOLITARY_CAPACITY,
        TABLE_EXCITATIONS,
        TABLE_TESTS,
        TABLE_ORDER,
        TABLE_SPECTRA,
        DESIGN_SPECTRUM,
    ]
    .into_iter()
}

/// What stands before a table: the groups whose arrays it has.
const MARK: (&str, &str) = ("<!-- arrays: ", " -->");

/// The page with its tables of declared groups made again, and the groups in them.
fn made_anew(page: &str) -> (String, Vec<&str>) {
    let (mut made, mut shown) = (String::new(), Vec::new());
    let mut lines = page.lines().peekable();
    while let Some(line) = lines.next() {
        writeln!(made, "{line}").unwrap();
        let Some(paths) = line.strip_prefix(MARK.0).and_then(|rest| rest.strip_suffix(MARK.1)) else { continue };
        while lines.next_if(|line| line.is_empty()).is_some() {}
        while lines.next_if(|line| line.starts_with('|')).is_some() {}
        while lines.next_if(|line| line.is_empty()).is_some() {}
        made.push_str("\n| array | dimensions | type | unit | content |\n|---|---|---|---|---|\n");
        for path in paths.split(", ") {
            let rows: String = declared().filter(|(_, own, _)| *own == path).map(|(.., rows)| rows).collect();
            assert!(!rows.is_empty(), "no group {path} is declared");
            made.push_str(&rows);
            shown.push(path);
        }
        if lines.peek().is_some() {
            made.push('\n');
        }
    }
    (made, shown)
}

#[test]
fn the_documentation_has_every_declared_array() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/hdf5-layout.md");
    let page = fs::read_to_string(&path).unwrap();
    let (made, shown) = made_anew(&page);
    for (_, group, _) in declared() {
        assert!(shown.contains(&group), "docs/hdf5-layout.md has no table of {group}");
    }
    if env::var_os("UPDATE_DOCS").is_some() {
        fs::write(&path, &made).unwrap();
    } else {
        let first = page.lines().zip(made.lines()).find(|(stands, made)| stands != made);
        assert!(
            page == made,
            "docs/hdf5-layout.md is not what is declared, first in {first:?}: UPDATE_DOCS=1 cargo test -p \
             uplift-result"
        );
    }
}

#[test]
fn no_group_is_missing_here() {
    let sources = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("src")).unwrap();
    let mut seen = 0;
    for path in sources.map(|entry| entry.unwrap().path()).filter(|path| path.is_file()) {
        let source = fs::read_to_string(&path).unwrap();
        for table in source.split("\ngroup! {\n").skip(1) {
            let name = table.split_once("pub const ").and_then(|(_, rest)| rest.split_once(':')).unwrap().0;
            assert!(declared().any(|(own, ..)| own == name), "{name} is not in `declared`");
            seen += 1;
        }
    }
    assert!(seen > 40, "{seen} groups");
}
