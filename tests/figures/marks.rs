//! Marked figures in the documents: found, compared, written.

use std::path::PathBuf;
use std::sync::Mutex;

use crate::common::repository;

const BEGIN: &str = "<!-- figure: ";
const END: &str = "<!-- end -->";

/// The sources, by which names begin; those that `make test` leaves out are slow.
const SOURCES: [&str; 32] = [
    "base-widths",
    "conditioning",
    "consistency",
    "coverage",
    "curves",
    "designs",
    "embedded",
    "embedded-choices",
    "embedded-set",
    "fixed-step",
    "frames",
    "influence",
    "levels",
    "levels-at-athens",
    "newmark",
    "own-oscillator",
    "own-oscillator-embedded",
    "published",
    "real",
    "rounding",
    "rounding-missed",
    "rounding-ordinates",
    "shake-table",
    "shake-table-pga",
    "table-4-1",
    "table-4-2",
    "tables-2",
    "tables-3",
    "two-solvers",
    "validation",
    "validation-example",
    "worked",
];

/// One process writes, one source at a time.
static WRITING: Mutex<()> = Mutex::new(());

struct Mark {
    name: String,
    text: String,
}

fn documents() -> Vec<PathBuf> {
    let mut found = ["README.md", "hazard/README.md"].map(PathBuf::from).to_vec();
    for entry in std::fs::read_dir(repository().join("docs")).unwrap() {
        let name = PathBuf::from("docs").join(entry.unwrap().file_name());
        if name.extension().is_some_and(|extension| extension == "md") {
            found.push(name);
        }
    }
    found
}

fn marks(text: &str) -> Vec<Mark> {
    let mark = |after: &str| {
        let (name, rest) = after.split_once(" -->").expect("a mark that is closed");
        let (text, _) = rest.split_once(END).unwrap_or_else(|| panic!("figure {name} has no end"));
        Mark { name: name.to_owned(), text: words(text) }
    };
    text.split(BEGIN).skip(1).map(mark).collect()
}

/// Without line breaks and the like.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Compares what `source` computed with every document: no figure of it is another. What stands in no document is only
/// computed.
pub fn hold(source: &str, computed: &[(String, String)]) {
    assert!(SOURCES.contains(&source), "{source} is not among the sources");
    let _one_at_a_time = WRITING.lock();
    let update = std::env::var_os("UPDATE_DOCS").is_some();
    let mut wrong = Vec::new();
    for document in documents() {
        let path = repository().join(&document);
        let mut text = std::fs::read_to_string(&path).unwrap();
        let mut changed = false;
        for Mark { name, text: printed } in marks(&text) {
            if name.split('.').next() != Some(source) {
                continue;
            }
            let Some((_, value)) = computed.iter().find(|(computed, _)| *computed == name) else {
                wrong.push(format!("{}: nothing computes {name}", document.display()));
                continue;
            };
            if printed == words(value) {
                continue;
            }
            if update {
                let begin = text.find(&format!("{BEGIN}{name} -->")).unwrap() + BEGIN.len() + name.len() + 4;
                let end = begin + text[begin..].find(END).unwrap();
                text.replace_range(begin..end, value);
                changed = true;
            } else {
                wrong.push(format!("{}: {name} is {value}, not {printed}", document.display()));
            }
        }
        if changed {
            std::fs::write(path, text).unwrap();
        }
    }
    assert!(wrong.is_empty(), "(UPDATE_DOCS=1 writes them)\n{}", wrong.join("\n"));
}

#[test]
fn every_mark_has_a_source() {
    let mut count = 0;
    for document in documents() {
        let text = std::fs::read_to_string(repository().join(&document)).unwrap();
        for Mark { name, .. } in marks(&text) {
            assert!(SOURCES.contains(&name.split('.').next().unwrap()), "{}: {name}", document.display());
            count += 1;
        }
    }
    assert!(count > 0);
}
