//! What to know before numbers are used, as a plain value; the crate `uplift_alarms` raises it.

use std::fmt;

use serde::Serialize;
use serde_json::Value;

/// What stands for the result in a command of [`Alarm::what_to_do`] until a face names it: an alarm is the same
/// wherever the file lies.
pub const RESULT: &str = "RESULT";

/// How much depends on it, the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// An input is probably not what was meant, and every number is wrong if so.
    Mistake,
    /// Numbers that should not be used before it is seen to.
    Caution,
    /// To be known with the numbers.
    Note,
}

impl Severity {
    /// Its word: `mistake?`, `caution`, `note`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Mistake => "mistake?",
            Self::Caution => "caution",
            Self::Note => "note",
        }
    }
}

/// One thing to know before the numbers are used.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Alarm {
    /// How much depends on it.
    pub severity: Severity,
    /// What kind it is, for programs: `measures-disagree`.
    pub kind: &'static str,
    /// What it is about: the study, or the worst of several spectra, `Athens, PGV, 2 %`.
    pub subject: String,
    /// The others of which the same is to be said.
    pub also: Vec<String>,
    /// What was found, with numbers.
    pub what: String,
    /// What to do about it, with the key of the study; empty where `what` says it.
    pub what_to_do: String,
}

impl Alarm {
    /// The alarm about one `subject`.
    pub fn new(severity: Severity, kind: &'static str, subject: &str, what: String, what_to_do: &str) -> Self {
        let (subject, what_to_do) = (subject.to_owned(), what_to_do.to_owned());
        Self { severity, kind, subject, also: Vec::new(), what, what_to_do }
    }

    /// The one alarm of several cases of a kind: the worst of them, the others by name.
    pub fn from_cases(kind: &'static str, mut cases: Vec<Case>) -> Option<Self> {
        cases.sort_by(|a, b| b.badness.total_cmp(&a.badness));
        let mut cases = cases.into_iter();
        let worst = cases.next()?;
        let Case { severity, subject, what, what_to_do, .. } = worst;
        Some(Self { severity, kind, subject, also: cases.map(|case| case.subject).collect(), what, what_to_do })
    }

    /// What to do about it, with the name of the result.
    pub fn remedy(&self, result: &str) -> String {
        self.what_to_do.replace(RESULT, result)
    }

    /// The same alarm, whose commands name the `result`.
    #[must_use]
    pub fn naming(self, result: &str) -> Self {
        Self { what_to_do: self.remedy(result), ..self }
    }
}

/// Names the `result` in what to do about every alarm of an answer as JSON: an answer that is kept does not name it.
pub fn name_result(answer: &mut Value, result: &str) {
    match answer {
        Value::Array(all) => all.iter_mut().for_each(|own| name_result(own, result)),
        Value::Object(fields) => fields.iter_mut().for_each(|(key, own)| match own {
            Value::String(what_to_do) if key == "what_to_do" => *what_to_do = what_to_do.replace(RESULT, result),
            own => name_result(own, result),
        }),
        _ => {}
    }
}

impl fmt::Display for Alarm {
    /// `Athens, PGV, 2 % (4 cases): what was found`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let also = match self.also.len() {
            0 => String::new(),
            others => format!(" ({} cases)", others + 1),
        };
        write!(formatter, "{}{also}: {}", self.subject, self.what)
    }
}

/// One of several spectra, curves or sites of which the same is to be said.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// How much depends on it.
    pub severity: Severity,
    /// By which the worst is found.
    pub badness: f64,
    /// What it is about.
    pub subject: String,
    /// What was found, with numbers.
    pub what: String,
    /// What to do about it.
    pub what_to_do: String,
}
