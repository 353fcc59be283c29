//! By what the numbers of a result are known: a digest of what its study says and of what it was given.

use std::collections::BTreeMap;

use toml::Value;
use uplift_ida::NUMERICS;
use uplift_job::checksum::checksum;
use uplift_job::outputs;

use super::file::ResultFile;
use super::head::{Head, UNSAID_NUMERICS};
use crate::error::ResultError;

/// Letters of a digest that is written into tables and figures: two results of a folder do not share them.
const LETTERS: usize = 12;

/// The digest of a study, complete as in a result, of its inputs, name to SHA-256, and of the version of the solver's
/// numbers. Where its files lie, its title and what is asked of a result later do not count.
pub(super) fn digest_of(study_toml: &str, input_checksums: &BTreeMap<String, String>, numerics: u32) -> String {
    let mut said = Value::Table(what_counts(study_toml).unwrap_or_default());
    forget_places(&mut said);
    let solver = if numerics > UNSAID_NUMERICS { format!("\nnumerics {numerics}") } else { String::new() };
    let mut digest = checksum(format!("{said}\n{input_checksums:?}{solver}").as_bytes());
    digest.truncate(LETTERS);
    digest
}

/// The digest of a study and its inputs as this program computes them.
pub(crate) fn study_digest(study_toml: &str, input_checksums: &BTreeMap<String, String>) -> String {
    digest_of(study_toml, input_checksums, NUMERICS)
}

/// Leaves of every path of a machine the name of its file.
fn forget_places(value: &mut Value) {
    match value {
        Value::String(text) if std::path::Path::new(text).is_absolute() => {
            *text = text.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
        }
        Value::Array(values) => values.iter_mut().for_each(forget_places),
        Value::Table(table) => table.iter_mut().for_each(|(_, value)| forget_places(value)),
        _ => {}
    }
}

/// Sections of a study on which its stripes and spectra do not depend.
const WITHOUT_INFLUENCE: [&str; 4] = ["title", "bootstrap", "consistency", "output"];

/// The sections of a study, as text, on which its numbers depend.
pub fn what_counts(study_toml: &str) -> Option<toml::Table> {
    let mut table: toml::Table = toml::from_str(study_toml).ok()?;
    for section in WITHOUT_INFLUENCE {
        table.remove(section);
    }
    Some(table)
}

impl Head {
    /// By what the numbers of this result are known: twelve letters, the same for the same study, inputs and
    /// version of the solver's numbers wherever they lie and whoever runs them.
    pub fn study_digest(&self) -> String {
        digest_of(&self.study_toml, &self.input_checksums, self.numerics)
    }
}

impl ResultFile {
    /// What a file that is made of this result says of itself: the program, the result and the digest of its study.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn mark(&self) -> Result<String, ResultError> {
        Ok(format!("{}; {}", outputs::mark(), self.name_and_digest()?))
    }

    /// The same without the program, for a file that is made of several.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn name_and_digest(&self) -> Result<String, ResultError> {
        let name = self.path().file_name().unwrap_or_default().to_string_lossy();
        Ok(format!("{name}; study digest {}", self.head()?.study_digest()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_counts_is_in_the_digest_and_nothing_else() {
        let inputs = BTreeMap::from([("record A".to_owned(), "12".to_owned())]);
        let study = |title: &str, seed: u64, file: &str| {
            format!(
                "title = \"{title}\"\nseed = {seed}\n[[sites]]\npgv = {{ file = \"{file}\" }}\n[output]\ncsv = true\n"
            )
        };
        let digest = study_digest(&study("a", 1, "/one/pgv.csv"), &inputs);
        assert_eq!(digest.len(), LETTERS);
        assert_eq!(digest, study_digest(&study("b", 1, "/another/place/pgv.csv"), &inputs));
        assert_ne!(digest, study_digest(&study("a", 2, "/one/pgv.csv"), &inputs));
        assert_ne!(digest, study_digest(&study("a", 1, "/one/pga.csv"), &inputs));
        assert_ne!(digest, study_digest(&study("a", 1, "/one/pgv.csv"), &BTreeMap::new()));
    }

    #[test]
    fn another_solver_is_another_digest_and_what_was_written_before_keeps_its_own() {
        let inputs = BTreeMap::from([("record A".to_owned(), "12".to_owned())]);
        let of = |numerics| digest_of("seed = 1", &inputs, numerics);
        // as computed before the version was said, by the same study and inputs
        let before = checksum(format!("{}\n{inputs:?}", Value::Table(what_counts("seed = 1").unwrap())).as_bytes());
        assert_eq!(of(UNSAID_NUMERICS), before[..LETTERS]);
        assert_ne!(of(UNSAID_NUMERICS + 1), of(UNSAID_NUMERICS));
        assert_ne!(of(UNSAID_NUMERICS + 2), of(UNSAID_NUMERICS + 1));
        assert_eq!(study_digest("seed = 1", &inputs), of(NUMERICS));
    }
}
