//! What to know before the numbers are used, the gravest first.

use serde::Serialize;
use uplift::result::Head;

/// How a run's own remark on synthetic records begins.
const SYNTHETIC: &str = "the records are synthetic";

/// One thing to know, and what to do about it.
#[derive(Debug, Serialize)]
pub(crate) struct Alarm {
    /// `mistake`, `caution` or `note`: how it is shown.
    severity: &'static str,
    /// What it is about; empty for all of it.
    subject: String,
    /// What else it is about.
    also: Vec<String>,
    what: String,
    /// Empty where `what` says it.
    what_to_do: String,
}

impl Alarm {
    /// Numbers that are not for use.
    pub(crate) fn synthetic() -> Self {
        let what = "The ground motions were made by the program (synthetic records), and scatter less than real ones. \
                    These numbers show how it works; they are not for design.";
        Self::new("caution", what, "Bring real records: records/README.md.")
    }

    /// What to know with the numbers.
    pub(crate) fn note(what: &str) -> Self {
        let mut letters = what.chars();
        let what: String = letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect();
        Self::new("note", &what, "")
    }

    fn new(severity: &'static str, what: &str, what_to_do: &str) -> Self {
        let (what, what_to_do) = (what.to_owned(), what_to_do.to_owned());
        Self { severity, subject: String::new(), also: Vec::new(), what, what_to_do }
    }
}

/// What a result says of itself, each thing once.
pub(super) fn alarms(head: &Head) -> Vec<Alarm> {
    let synthetic = head.synthetic.then(Alarm::synthetic);
    let said = |warning: &&String| !(head.synthetic && warning.starts_with(SYNTHETIC));
    synthetic.into_iter().chain(head.warnings.iter().filter(said).map(|warning| Alarm::note(warning))).collect()
}
