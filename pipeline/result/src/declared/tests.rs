//! The tables of arrays, axes and attributes in `docs/hdf5-layout.md` are those declared.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use super::{Group, Names, Quantity, named};
use crate::layout::attribute;
use crate::layout::axis::{self, Axis};
use crate::*;

impl<T> Group<T> {
    /// Its rows of the table of arrays in `docs/hdf5-layout.md`.
    pub(super) fn rows(&self) -> String {
        let of_sites: Names<'_> = if self.path == SITE_SPECTRA.path { &SITE_NAMES } else { &[] };
        let names = [of_sites, EXAMPLES].concat();
        let row = |quantity: &Quantity<T>| {
            let Quantity { unit, long_name, .. } = *quantity;
            let note = if quantity.note.is_empty() { long_name } else { quantity.note };
            let absent = if quantity.is_later { "; absent in older results" } else { "" };
            let unit = if quantity.element() == "text" { String::new() } else { format!(" {unit}") };
            let path = self.path(quantity, &names);
            let (axes, element) = (quantity.axes(&names).join(", "), quantity.element());
            named(&format!("| `{path}` | {axes} | {element} |{unit} | {note}{absent} |\n"), &names).into_owned()
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
    ("<sites>", "/"),
    ("<one>", "branch or structure"),
    ("<many>", "branches or structures"),
    ("<levels>", "<im>_level"),
    ("<with>: ", ""),
    (
        "<group>",
        "/bootstrap`, `/influence`, `/disaggregation`, `/efficiency`, `/sufficiency`, `/consistency`, \
         `/structures/<structure>/<command>/<key>",
    ),
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
        SITE_PLACES,
        SITE_SPECTRA,
        SITE_FLAGS,
        SITE_BANDS,
        SITE_SPREADS,
        SITE_FITS,
        SITE_PROBLEMS,
        SITE_CONSISTENCY,
    ]
    .into_iter()
}

impl Axis {
    /// Its row of a table of axes in `docs/hdf5-layout.md`.
    fn row(&self) -> String {
        let Axis { name, unit, long_name, note } = self;
        let note = if note.is_empty() { long_name } else { note };
        // of an array this stands for both axes that it may have
        let names = [&[("<branches>", "branch_<site>_<im>")], EXAMPLES].concat();
        named(&format!("| `{name}` | {unit} | {note} |\n"), &names).into_owned()
    }
}

/// The row of an attribute of the root in its table in `docs/hdf5-layout.md`.
fn root_row([name, element, note]: &[&str; 3]) -> String {
    let element = if *element == "String" { "text" } else { element };
    format!("| `{name}` | {element} | {note} |\n")
}

/// The row of another group in the tables of attributes.
fn attributes_row(group: &str, all: &[[&str; 3]]) -> String {
    let said = |[name, _, note]: &[&str; 3]| match *note {
        "" => format!("`{name}`"),
        note => format!("`{name}` ({note})"),
    };
    let all: Vec<String> = all.iter().map(said).collect();
    named(&format!("| `{group}` | {} |\n", all.join(", ")), EXAMPLES).into_owned()
}

/// The kinds of tables, as the comments before them name them, with their headings.
const TABLES: [(&str, &str); 4] = [
    ("arrays", "| array | dimensions | type | unit | content |\n|---|---|---|---|---|\n"),
    ("axes", "| `/axes/…` | unit | content |\n|---|---|---|\n"),
    ("attributes", "| group | attributes |\n|---|---|\n"),
    ("attributes of the root", "| attribute | type | content |\n|---|---|---|\n"),
];

/// Everything declared: the kind of its table, the name that the comment before the table lists, and its rows there.
fn all_rows() -> Vec<(&'static str, &'static str, String)> {
    let arrays = declared().map(|(_, path, rows)| ("arrays", path, rows));
    let axes = axis::ALL.iter().map(|axis| ("axes", axis.name, axis.row()));
    let attributes = attribute::ALL.iter().map(|(group, all)| match *group {
        "/" => ("attributes of the root", *group, all.iter().map(root_row).collect()),
        _ => ("attributes", *group, attributes_row(group, all)),
    });
    arrays.chain(axes).chain(attributes).collect()
}

/// The page with its tables of what is declared made again, and what is in them, by kind and name.
fn made_anew(page: &str) -> (String, Vec<(&str, &str)>) {
    let (mut made, mut shown) = (String::new(), Vec::new());
    let all = all_rows();
    let mut lines = page.lines().peekable();
    while let Some(line) = lines.next() {
        writeln!(made, "{line}").unwrap();
        let marked = line.strip_prefix("<!-- ").and_then(|rest| rest.strip_suffix(" -->")?.split_once(": "));
        let Some((kind, names)) = marked else { continue };
        let Some((_, heading)) = TABLES.iter().find(|(own, _)| *own == kind) else { continue };
        while lines.next_if(|line| line.is_empty()).is_some() {}
        while lines.next_if(|line| line.starts_with('|')).is_some() {}
        while lines.next_if(|line| line.is_empty()).is_some() {}
        write!(made, "\n{heading}").unwrap();
        for name in names.split(", ") {
            let rows = all.iter().filter(|(of, own, _)| (*of, *own) == (kind, name)).map(|(.., rows)| rows.as_str());
            let rows: String = rows.collect();
            assert!(!rows.is_empty(), "{kind}: {name} is not declared");
            made.push_str(&rows);
            shown.push((kind, name));
        }
        if lines.peek().is_some() {
            made.push('\n');
        }
    }
    (made, shown)
}

#[test]
fn the_documentation_has_all_that_is_declared() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/hdf5-layout.md");
    let page = fs::read_to_string(&path).unwrap();
    let (made, shown) = made_anew(&page);
    for (kind, name, _) in all_rows() {
        assert!(shown.contains(&(kind, name)), "docs/hdf5-layout.md has no table of {kind} with {name}");
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
