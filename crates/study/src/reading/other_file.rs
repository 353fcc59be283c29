//! Files of another kind than the one that is read, told by what they hold.

use std::path::{Path, PathBuf};

use uplift_structure::Kind as StructureKind;

use super::{Table, Value};
use crate::error::Unreadable;
use crate::kind::Kind;

/// What is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    Study,
    Structure,
    Library,
}

impl Wanted {
    fn words(self) -> &'static str {
        match self {
            Self::Study => "a study",
            Self::Structure => "a structure",
            Self::Library => "a library",
        }
    }

    /// One that stands in the repository.
    pub(crate) fn example(self) -> &'static str {
        match self {
            Self::Study => "configs/europe.toml",
            Self::Structure => "configs/structures/pier.toml",
            Self::Library => "configs/rocking-library.toml",
        }
    }

    fn refuse(self, found: &'static str, advice: &str) -> Unreadable {
        Unreadable::Other { found, wanted: self.words(), advice: advice.to_owned() }
    }

    /// Why the file at `path` with these first `bytes` cannot be what is wanted; none where it may be.
    pub(crate) fn refusal_of_bytes(self, path: &Path, bytes: &[u8]) -> Option<Unreadable> {
        let begins = |marks: &[&[u8]]| marks.iter().any(|mark| bytes.starts_with(mark));
        let ends = |ending: &str| path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending));
        if begins(&[b"\x89HDF\r\n\x1a\n"]) {
            let advice = match self {
                Self::Study | Self::Library => "`uplift status`, `table`, `plot`, `report` and `export` take results",
                Self::Structure => "the structure comes first, and the result after --urs",
            };
            Some(self.refuse("a result", advice))
        } else if begins(&[b"PK\x03\x04"]) {
            Some(self.refuse("a zip archive", "`uplift records import` takes one of records"))
        } else if begins(&[b"\xff\xfe", b"\xfe\xff"]) {
            Some(Unreadable::Utf16)
        } else if ends("csv") && bytes.split(|&byte| byte == b'\n').take(HEAD_LINES).any(is_header_of_manifest) {
            let advice = "a study names it: [records] manifest = \"…\"; `uplift records list` shows its records";
            Some(self.refuse("a manifest of records", advice))
        } else if ends("at2") || has_head_of_at2(bytes) || begins_with_numbers(bytes) {
            let advice = "`uplift response` shakes a system with it, `uplift records import` makes a manifest of a \
                          folder of records, and a study names that: [records] manifest = \"…\"";
            Some(self.refuse("a record", advice))
        } else if ends("csv") {
            let advice = "a study names the tables that it reads: manifest, hazard curves, sites";
            let of_result = result_of(path).map(|result| format!("{advice}; its result is {}", result.display()));
            Some(self.refuse("a table", of_result.as_deref().unwrap_or(advice)))
        } else {
            None
        }
    }

    /// The same of a file that is TOML.
    pub(crate) fn refusal_of_table(self, table: &Table) -> Option<Unreadable> {
        let kind = table.get("kind").and_then(|entry| match &entry.node.value {
            Value::Text(kind) => Some(kind.as_str()),
            _ => None,
        });
        let has = |keys: &[&str]| kind.is_none() && keys.iter().any(|key| table.get(key).is_some());
        let is_named = kind.is_some_and(|kind| Kind::ALL.iter().any(|known| known.key() == kind));
        let found = if kind.is_some_and(|kind| StructureKind::ALL.iter().any(|known| known.name() == kind)) {
            Self::Structure
        } else if is_named || has(&["sites", "site_table", "pgv", "pga", "risk"]) {
            Self::Study
        } else if has(&["block", "levels"]) {
            Self::Library
        } else if has(&["records"]) && self == Self::Structure {
            Self::Study
        } else {
            return None;
        };
        (found != self).then(|| self.refuse(found.words(), found.commands()))
    }

    /// What takes it.
    fn commands(self) -> &'static str {
        match self {
            Self::Study => "`uplift run` takes it",
            Self::Structure => "`uplift design` and `overturning` take it, with --urs RESULT, and `pushover` without",
            Self::Library => "`uplift library` takes it",
        }
    }
}

/// The result beside the table at `path` that is named after it: `site.h5` of `site.urs.csv`.
fn result_of(path: &Path) -> Option<PathBuf> {
    // the program's own tables have two endings
    let shorter = path.with_extension("");
    shorter.extension().map(|_| shorter.with_extension("h5")).filter(|result| result.is_file())
}

/// Lines among which the header of a manifest is; comments come before it.
const HEAD_LINES: usize = 20;

/// Whether a line has the columns that every manifest has.
fn is_header_of_manifest(line: &[u8]) -> bool {
    let line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line);
    let has = |name: &[u8]| line.split(|byte| b",;\t\r\"".contains(byte)).any(|found| found == name);
    has(b"record_id") && has(b"file_h1") && has(b"file_h2")
}

/// Whether the first line has nothing but numbers, as columns of samples have, and no TOML.
fn begins_with_numbers(bytes: &[u8]) -> bool {
    let line = bytes.split(|&byte| byte == b'\n').next().and_then(|line| std::str::from_utf8(line).ok()).unwrap_or("");
    let mut words = line.split([' ', '\t', ',', ';', '\r']).filter(|word| !word.is_empty()).peekable();
    words.peek().is_some() && words.all(|word| word.parse::<f64>().is_ok())
}

/// Whether the first lines have the number of points of an AT2 file, and not in a comment of TOML.
fn has_head_of_at2(bytes: &[u8]) -> bool {
    let mut head = bytes.split(|&byte| byte == b'\n').take(6);
    head.any(|line| !line.contains(&b'#') && line.windows(4).any(|word| word == b"NPTS"))
}
