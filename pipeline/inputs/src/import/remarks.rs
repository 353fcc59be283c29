//! What an import found that deserves a look, kind by kind.

use std::fmt;

use serde::Serialize;
use uplift_job::text::one_line;

use super::collect::Imported;

/// Remarks of one kind.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Remarks {
    /// What kind of thing it is, in a few words.
    pub kind: &'static str,
    /// The remarks, each with the name of the record or file first.
    pub texts: Vec<String>,
}

impl Remarks {
    /// Those of an import, kinds in the order in which they came up, files that are no records last.
    pub(super) fn of(imported: &Imported) -> Vec<Self> {
        let mut kinds: Vec<Self> = Vec::new();
        for warning in &imported.warnings {
            match kinds.iter_mut().find(|kind| kind.kind == warning.kind) {
                Some(kind) => kind.texts.push(warning.text.clone()),
                None => kinds.push(Self { kind: warning.kind, texts: vec![warning.text.clone()] }),
            }
        }
        if !imported.passed_over.is_empty() {
            kinds.push(Self { kind: "not read", texts: imported.passed_over.clone() });
        }
        kinds
    }
}

impl fmt::Display for Remarks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} ({}):", self.kind, self.texts.len())?;
        self.texts.iter().try_for_each(|text| writeln!(f, "  - {}", one_line(text)))
    }
}
