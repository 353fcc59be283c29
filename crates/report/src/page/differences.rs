//! In which settings several results differ: what names each of them.

use std::collections::BTreeMap;

use serde::Serialize;
use toml::Value;
use uplift::result::Head;

/// Settings that say what a result is called and where it lies: nothing of its numbers.
const NAMES: [&str; 2] = ["title", "output.file"];
/// What is asked of a spectrum once it is there, and so comes last.
const AFTERWARDS: &str = "bootstrap.";
/// What the description of the records goes by.
const RECORDS: &str = "records";
/// So many settings make a name, each shortened to so many letters.
const IN_A_NAME: usize = 2;
const LETTERS: usize = 32;

/// A setting that is not the same in all results.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(super) struct Difference {
    /// Key of the study, `records.first`.
    key: String,
    /// Its value in each result; a dash where it is not set.
    values: Vec<String>,
}

/// The differences of the studies in `heads`, by key; of what only names a study nothing is said.
pub(super) fn differences(heads: &[&Head]) -> Vec<Difference> {
    let settings: Vec<BTreeMap<String, String>> = heads.iter().map(|head| settings(head)).collect();
    let mut keys: Vec<&String> =
        settings.iter().flat_map(BTreeMap::keys).filter(|key| !NAMES.contains(&key.as_str())).collect();
    keys.sort_by_key(|key| (key.starts_with(AFTERWARDS), *key));
    keys.dedup();
    let values = |key: &&String| -> Vec<Option<&String>> { settings.iter().map(|of| of.get(*key)).collect() };
    let differs = |values: &Vec<Option<&String>>| values.iter().any(|value| *value != values[0]);
    let mut found: Vec<Difference> = keys
        .iter()
        .map(|key| (*key, values(key)))
        .filter(|(_, values)| differs(values))
        .map(|(key, values)| Difference {
            key: key.clone(),
            values: values.into_iter().map(|value| value.cloned().unwrap_or_else(|| "–".to_owned())).collect(),
        })
        .collect();
    // the description of the records follows from the settings that choose them, where these differ
    if found.iter().any(|of| of.key.starts_with("records.")) {
        found.retain(|of| of.key != RECORDS);
    }
    found
}

/// What each result is called: by its settings, else its title, else its file, whichever tells all of them apart.
pub(super) fn names(differences: &[Difference], titles: &[&str], files: &[&str]) -> Vec<String> {
    let by_settings = |result: usize| -> String {
        let told =
            differences.iter().take(IN_A_NAME).map(|of| format!("{} = {}", of.key, shortened(&of.values[result])));
        told.collect::<Vec<_>>().join(", ")
    };
    let candidates: [Vec<String>; 3] = [
        (0..files.len()).map(by_settings).collect(),
        titles.iter().map(|&title| title.to_owned()).collect(),
        files.iter().map(|&file| file.to_owned()).collect(),
    ];
    let apart = |names: &Vec<String>| {
        let mut sorted: Vec<&String> = names.iter().collect();
        sorted.sort_unstable();
        names.iter().all(|name| !name.is_empty()) && sorted.windows(2).all(|pair| pair[0] != pair[1])
    };
    let numbered = || (1..=files.len()).map(|number| format!("result {number}")).collect();
    candidates.into_iter().find(apart).unwrap_or_else(numbered)
}

/// The end of a long value, where files differ.
fn shortened(value: &str) -> String {
    let letters = value.chars().count();
    if letters <= LETTERS {
        return value.to_owned();
    }
    std::iter::once('…').chain(value.chars().skip(letters - LETTERS)).collect()
}

/// Every setting of a study, by its key with the tables that it stands in.
fn settings(head: &Head) -> BTreeMap<String, String> {
    let mut settings = BTreeMap::new();
    // a result that was opened has a study that can be read
    if let Ok(study) = head.study_toml.parse::<toml::Table>() {
        collect("", &Value::Table(study), &mut settings);
    }
    settings.insert(RECORDS.to_owned(), head.record_set.clone());
    settings
}

fn collect(key: &str, value: &Value, settings: &mut BTreeMap<String, String>) {
    let below = |name: &str| if key.is_empty() { name.to_owned() } else { format!("{key}.{name}") };
    match value {
        Value::Table(table) => table.iter().for_each(|(name, value)| collect(&below(name), value, settings)),
        Value::Array(items) if items.iter().any(Value::is_table) => {
            items
                .iter()
                .enumerate()
                .for_each(|(index, item)| collect(&below(&(index + 1).to_string()), item, settings));
        }
        Value::String(text) => drop(settings.insert(key.to_owned(), text.clone())),
        other => drop(settings.insert(key.to_owned(), other.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(values: &[(&str, [&str; 2])]) -> Vec<Difference> {
        let of = |(key, values): &(&str, [&str; 2])| Difference {
            key: (*key).to_owned(),
            values: values.iter().map(|&value| value.to_owned()).collect(),
        };
        values.iter().map(of).collect()
    }

    #[test]
    fn results_are_named_by_their_differences() {
        let differences = found(&[("records.first", ["30", "15"])]);
        assert_eq!(names(&differences, &["a", "a"], &["x.h5", "x.h5"]), ["records.first = 30", "records.first = 15"]);
        assert_eq!(names(&[], &["a", "b"], &["x.h5", "x.h5"]), ["a", "b"]);
        assert_eq!(names(&[], &["a", "a"], &["x.h5", "y.h5"]), ["x.h5", "y.h5"]);
        assert_eq!(names(&[], &["a", "a"], &["x.h5", "x.h5"]), ["result 1", "result 2"]);
        let long = "/".repeat(60);
        let differences = found(&[("records.manifest", [&format!("{long}a.csv"), &format!("{long}b.csv")])]);
        let told = names(&differences, &["", ""], &["x.h5", "y.h5"]);
        assert!(told[0].ends_with("/a.csv") && told[1].ends_with("/b.csv") && told[0].len() < 60, "{told:?}");
    }
}
