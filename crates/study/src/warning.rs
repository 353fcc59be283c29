//! What a study or a structure may say, but probably does not mean.

use std::fmt;

use serde::Serialize;
use uplift_plausible::Unlikely;

/// Something that is allowed but probably not meant.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Warning {
    /// What was found, with key, value and unit.
    pub what: String,
    /// What to do about it, with the key.
    pub what_to_do: String,
    /// Whether it is a number that is possible but unlikely, in another unit mostly: all that follows is wrong then.
    pub unlikely: bool,
}

impl Warning {
    pub(crate) fn new(what: impl Into<String>, what_to_do: impl Into<String>) -> Self {
        Self { what: what.into(), what_to_do: what_to_do.into(), unlikely: false }
    }

    /// A number of a file that is possible but unlikely.
    pub(crate) fn unlikely(found: &Unlikely) -> Self {
        Self { unlikely: true, ..Self::new(found.to_string(), found.what_to_do()) }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.what, self.what_to_do)
    }
}
