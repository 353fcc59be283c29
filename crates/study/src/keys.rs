//! The reference of the keys of a study file: what each means, beside what reads it.
//!
//! The tables of `docs/study-file.md` and `docs/displacement-spectra.md` are made from it, in Markdown. A test compares
//! them; `UPDATE_DOCS=1 cargo test -p uplift-study` writes them anew. Another test compares the keys with those that
//! the reader asks for.

/// A key of a study file; several with the same meaning stand together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// Its names, or those of several.
    pub names: &'static [&'static str],
    /// What it is, with its unit.
    pub meaning: &'static str,
    /// What holds where it is not given.
    pub default: &'static str,
    /// What it may be.
    pub range: &'static str,
}

/// The keys of one section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SectionKeys {
    /// The section as a dotted path, `records.select`; empty at the top of the file.
    pub section: &'static str,
    /// Its keys, in the order of the documentation.
    pub keys: &'static [Key],
}
