//! The reference of the keys: all that are read, and no others; the tables of the documentation are made from it.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use uplift_structure::UncertainQuantity;

use super::super::keys::{Declared, SectionKeys};
use super::super::reading::{Findings, Paths, Section, Table};
use super::super::{AnyStudy, Kind, library, library_schema, structure, structure_schema, study_schema};
use super::{displacement, resolving, shake_table};

/// The pages with the keys of each kind of study, and of structures.
fn pages() -> [(&'static str, &'static [SectionKeys]); 5] {
    [
        ("study-file.md", Kind::UniformRisk.keys()),
        ("displacement-study.md", Kind::Displacement.keys()),
        ("shake-table-study.md", Kind::ShakeTable.keys()),
        ("structure-file.md", &structure::KEYS),
        ("rocking-library.md", &library::KEYS),
    ]
}

/// What stands before a table: the sections whose keys it has.
const MARK: (&str, &str) = ("<!-- keys: ", " -->");

/// The page with its tables made again, and the rows of them.
fn made_anew(page: &str, sections: &[SectionKeys]) -> (String, BTreeSet<String>) {
    let (mut made, mut shown) = (String::new(), BTreeSet::new());
    let mut lines = page.lines().peekable();
    while let Some(line) = lines.next() {
        writeln!(made, "{line}").unwrap();
        let Some(names) = line.strip_prefix(MARK.0).and_then(|rest| rest.strip_suffix(MARK.1)) else { continue };
        while lines.next_if(|line| line.is_empty() || line.starts_with('|')).is_some() {}
        let sections: Vec<&SectionKeys> = names.split(", ").map(|name| section(sections, name)).collect();
        shown.extend(sections.iter().flat_map(|section| section.keys).map(|key| row(*key)));
        write!(made, "\n{}", table(&sections)).unwrap();
        if lines.peek().is_some() {
            made.push('\n');
        }
    }
    (made, shown)
}

/// The keys of the section `name` of a page; `top` for those before all sections.
fn section<'a>(sections: &'a [SectionKeys], name: &str) -> &'a SectionKeys {
    let path = if name == "top" { "" } else { name };
    let found = sections.iter().find(|section| section.section == path);
    found.unwrap_or_else(|| panic!("there is no section {name}"))
}

/// What tells a key from others.
fn row(key: &dyn Declared) -> String {
    format!("{:?}: {}", key.names(), key.meaning())
}

/// Keys with the name of their section where there are several; no column that is empty.
fn table(sections: &[&SectionKeys]) -> String {
    let cells = |key: &dyn Declared| [key.meaning().to_owned(), key.default(), key.range()];
    let rows = || sections.iter().flat_map(|section| section.keys.iter().map(move |key| (section.section, *key)));
    let is_used = [0, 1, 2].map(|column| rows().any(|(_, key)| !cells(key)[column].is_empty()));
    let used = |cells: [String; 3]| cells.into_iter().zip(is_used).filter_map(|(cell, used)| used.then_some(cell));
    let titles: Vec<String> = used(["meaning", "default", "range"].map(str::to_owned)).collect();
    let mut table = format!("| key | {} |\n|---|{}\n", titles.join(" | "), "---|".repeat(titles.len()));
    for (path, key) in rows() {
        let name = |name: &str| if sections.len() > 1 { format!("`{path}.{name}`") } else { format!("`{name}`") };
        let names: Vec<String> = key.names().into_iter().map(name).collect();
        write!(table, "| {} |", names.join(", ")).unwrap();
        for cell in used(cells(key)) {
            write!(table, " {cell}{}", if cell.is_empty() { "|" } else { " |" }).unwrap();
        }
        table.push('\n');
    }
    table
}

#[test]
fn the_documentation_has_every_key() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let mut shown = BTreeSet::new();
    for (name, sections) in pages() {
        let path = folder.join(name);
        let page = fs::read_to_string(&path).unwrap();
        let (made, keys) = made_anew(&page, sections);
        if env::var_os("UPDATE_DOCS").is_some() {
            fs::write(&path, &made).unwrap();
        } else {
            let first = page.lines().zip(made.lines()).find(|(stands, made)| stands != made);
            assert!(
                page == made,
                "docs/{name} is not what the keys say, first in {first:?}: UPDATE_DOCS=1 cargo test -p uplift-study"
            );
        }
        shown.extend(keys);
    }
    for (name, section) in pages().into_iter().flat_map(|(name, sections)| sections.iter().map(move |of| (name, of))) {
        let missing = section.keys.iter().map(|key| row(*key)).find(|key| !shown.contains(key));
        assert_eq!(missing, None, "a key of [{}] is in no table of docs/{name}", section.section);
    }
}

/// The schemas that come with the configs are what the keys say.
#[test]
fn the_schemas_are_those_of_the_keys() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs");
    for (name, schema) in [
        ("study.schema.json", study_schema()),
        ("structures/structure.schema.json", structure_schema()),
        ("library.schema.json", library_schema()),
    ] {
        let made = format!("{schema:#}\n");
        if env::var_os("UPDATE_DOCS").is_some() {
            fs::write(folder.join(name), &made).unwrap();
        }
        let stands = fs::read_to_string(folder.join(name)).unwrap_or_default();
        assert!(stands == made, "configs/{name} is not what the keys say: UPDATE_DOCS=1 cargo test -p uplift-study");
    }
}

/// The keys that reading these studies asks for, as dotted paths without positions in lists.
fn asked(studies: &[&str]) -> BTreeSet<String> {
    let mut asked = BTreeSet::new();
    for study in studies {
        let (document, findings) = (Table::parse(study).unwrap(), Findings::default());
        AnyStudy::read(Section::root(&document, &findings), &Paths::AsWritten).unwrap();
        asked.extend(findings.asked.into_inner());
    }
    let without_positions = |key: String| -> String {
        key.split('[').map(|part| part.split_once(']').map_or(part, |(_, after)| after)).collect()
    };
    asked.into_iter().map(without_positions).collect()
}

#[test]
fn every_key_is_in_the_reference_and_no_other() {
    const CURVES: &str = "[pgv]\n[pga]\n[measures.sa_1s]\n[consistency]\nagainst = \"sa_1s\"\n\
        [hazard]\nconversions = [{ from = \"larger\", to = \"RotD50\", sa_1s = 1 }]\n\
        [uncertainty.restitution]\ndistribution = \"triangular\"\nlower = 0.8\nupper = 0.9\n\
        [uncertainty.strength]\ndistribution = \"lognormal\"\ncoefficient_of_variation = 0.1\n\
        [[uncertainty.correlation]]\nbetween = [\"strength\", \"restitution\"]\ncoefficient = 0.5\n\
        [site_table]\nsa_1s = \"a\"\n[[sites]]\nname = \"x\"\n[sites.pgv]\n\
        branches = [{ file = \"a\", weight = 0.5 }, { file = \"b\", weight = 0.5 }]\n[sites.pga]\n\
        branches = [{ file = \"a\", weight = 0.5 }, { file = \"b\", weight = 0.5 }]\n[sites.sa_1s]\n\
        branches = [{ file = \"a\", weight = 0.5 }, { file = \"b\", weight = 0.5 }]\n";
    const BLOCKS: &str = "kind = \"displacement spectra\"\n[block]\n[design]";
    const FURTHER: &str = "[measures.pgd]\n[measures.si]\n[measures.cav]\n[measures.arias]";
    for (kind, studies) in [
        (Kind::UniformRisk, &[resolving::COMPLETE, CURVES, FURTHER][..]),
        (Kind::Displacement, &[displacement::COMPLETE, BLOCKS]),
        (Kind::ShakeTable, &[shake_table::COMPLETE, shake_table::BARE]),
    ] {
        let mut known = BTreeSet::new();
        for section in kind.keys() {
            for name in section.keys.iter().flat_map(|key| key.names()) {
                known.insert(format!("{}.{name}", section.section).trim_start_matches('.').to_owned());
            }
        }
        let of_one_quantity = |key: String| {
            let others = UncertainQuantity::ALL.map(|quantity| format!("uncertainty.{}", quantity.key()));
            let own = others.iter().find_map(|other| key.strip_prefix(other.as_str()));
            own.map_or(key.clone(), |rest| format!("uncertainty.restitution{rest}"))
        };
        // the keys of every quantity are reported with those of one
        let asked: BTreeSet<String> = asked(studies).into_iter().map(of_one_quantity).collect();
        let never: Vec<_> = known.difference(&asked).collect();
        assert!(never.is_empty(), "in the reference of {}, but never read: {never:?}", kind.key());
        // a section is known by its keys; the table of a grid is reported with the grids
        let within = |section: &str, key: &str| section.strip_prefix(key).is_some_and(|rest| rest.starts_with('.'));
        let is_section = |key: &str| kind.keys().iter().any(|known| known.section == key || within(known.section, key));
        let of_a_grid = |key: &str| {
            key.rsplit_once('.')
                .is_some_and(|(grid, part)| known.contains(grid) && ["start", "stop", "count"].contains(&part))
        };
        // asked for only to say where it belongs
        let elsewhere = |key: &str| kind != Kind::UniformRisk && key == "records.tag";
        let told = |key: &str| is_section(key) || of_a_grid(key) || elsewhere(key);
        let unknown: Vec<_> = asked.difference(&known).filter(|key| !told(key)).collect();
        assert!(unknown.is_empty(), "read, but not in the reference of {}: {unknown:?}", kind.key());
    }
}
