//! What each variant changes of a study: a product of values, or the rows of a table.

use std::path::Path;

use sha2::{Digest, Sha256};
use uplift_atomic_file::read_file;
use uplift_job::text::distinct;
use uplift_job::{JobError, text_table};
use uplift_labelled::hexadecimal;

use crate::error::UpliftError;

/// Variants of one sweep: more are a study of their own.
pub(super) const MOST_VARIANTS: usize = 1000;
/// Longest name of a variant that is made of its values; longer ones are cut, and a hash of all tells them apart.
const LONGEST_NAME: usize = 80;
/// Largest table of cases.
const MOST_BYTES: u64 = 16 << 20;
/// The column of a table of cases that names them.
const NAME: &str = "name";

/// One variant of a study.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Variant {
    /// The name that was given to it; none to make one of its values.
    pub(super) name: Option<String>,
    /// Keys of the study with their values, as `--set` takes them.
    pub(super) changes: Vec<(String, String)>,
    /// Where it was written: `cases.csv, row 2`; none of a product.
    pub(super) place: Option<String>,
}

impl Variant {
    /// As `--set` takes them.
    pub(super) fn overrides(&self) -> impl Iterator<Item = String> + '_ {
        self.changes.iter().map(|(key, value)| format!("{key}={value}"))
    }

    /// A mistake in one of its values in the words of whoever wrote it: by row and column of a table of cases, or by
    /// `--over`.
    pub(super) fn mistake(&self, said: String) -> String {
        let of_change = |(key, value): &(String, String)| {
            let reason = said.strip_prefix(&format!("--set {key}={value}: "))?;
            Some(match &self.place {
                Some(place) => format!("{place}, column {key}: {reason}"),
                None => format!("--over {key}={value}: {reason}"),
            })
        };
        self.changes.iter().find_map(of_change).unwrap_or(said)
    }

    /// The value of `key`; none where it is that of the study.
    pub(super) fn value(&self, key: &str) -> Option<&str> {
        self.changes.iter().find(|(own, _)| own == key).map(|(_, value)| value.as_str())
    }

    /// A name of file out of the last part of each key and its value.
    fn name_of_values(&self) -> String {
        let plain = |text: &str| -> String {
            let letter = |letter: char| if letter.is_alphanumeric() || "._-".contains(letter) { letter } else { '-' };
            text.chars().map(letter).collect::<String>().trim_matches(['-', '.']).to_owned()
        };
        let part = |(key, value): &(String, String)| {
            format!("{}-{}", plain(key.rsplit('.').next().unwrap_or(key)), plain(value))
        };
        let name = self.changes.iter().map(part).collect::<Vec<_>>().join("_");
        if name.is_empty() {
            return "as-it-stands".to_owned();
        }
        if name.len() <= LONGEST_NAME { name } else { format!("{}-{}", shortened(&name), self.digest()) }
    }

    fn digest(&self) -> String {
        let all = self.overrides().collect::<Vec<_>>().join("\n");
        hexadecimal(&Sha256::digest(all.as_bytes()))[..8].to_owned()
    }
}

/// The beginning of a name, cut between letters.
fn shortened(name: &str) -> String {
    name.chars().take(LONGEST_NAME / 2).collect()
}

/// Names of all variants, each once, whatever a file system thinks of capitals: two of the same values in letters that
/// a file name has not are told apart by a hash of them.
pub(super) fn names(variants: &[Variant]) -> Vec<String> {
    let own: Vec<String> =
        variants.iter().map(|variant| variant.name.clone().unwrap_or_else(|| variant.name_of_values())).collect();
    let is_twice = |name: &String| own.iter().filter(|other| is_same_name(other, name)).count() > 1;
    let name = |(variant, name): (&Variant, &String)| {
        if is_twice(name) { format!("{name}-{}", variant.digest()) } else { name.clone() }
    };
    variants.iter().zip(&own).map(name).collect()
}

/// Whether two names are one file on some machine.
fn is_same_name(one: &str, other: &str) -> bool {
    one.to_lowercase() == other.to_lowercase()
}

/// All keys that vary, in the order in which they come.
pub(super) fn keys(variants: &[Variant]) -> Vec<String> {
    distinct(variants.iter().flat_map(|variant| &variant.changes).map(|(key, _)| key.clone()))
}

/// Every combination of the values in `over`, each `KEY=VALUE,VALUE…`; the last runs fastest. A comma within brackets,
/// braces or quotes belongs to a value.
///
/// # Errors
/// Everything that is no key with values, and a key or value that comes twice.
pub(super) fn product(over: &[String]) -> Result<Vec<Variant>, UpliftError> {
    let (mut axes, mut mistakes): (Vec<(String, Vec<String>)>, Vec<String>) = (Vec::new(), Vec::new());
    for text in over {
        let Some((key, values)) = text.split_once('=') else {
            mistakes.push(format!("--over {text}: write KEY=VALUE,VALUE, e.g. oscillator.restitution=0.85,0.95"));
            continue;
        };
        let (key, values) = (key.trim().to_owned(), split(values));
        if key.is_empty() || values.iter().any(String::is_empty) {
            mistakes.push(format!("--over {text}: a key or a value is missing"));
        } else if axes.iter().any(|(other, _)| *other == key) {
            mistakes.push(format!("--over {text}: {key} is given twice: give all its values at once"));
        } else if let Some(twice) = values.iter().enumerate().find(|(place, value)| values[..*place].contains(value)) {
            mistakes.push(format!("--over {text}: {} is given twice", twice.1));
        } else {
            axes.push((key, values));
        }
    }
    let count = axes.iter().fold(1_usize, |count, (_, values)| count.saturating_mul(values.len()));
    if count > MOST_VARIANTS {
        mistakes.push(format!("--over: {count} combinations, more than {MOST_VARIANTS}: give fewer values"));
    }
    if !mistakes.is_empty() {
        return Err(JobError::Usage(mistakes.join("\n")).into());
    }
    let mut variants = vec![Variant::default()];
    for (key, values) in &axes {
        let with = |variant: &Variant| {
            let variant = variant.clone();
            values.iter().map(move |value| {
                let mut variant = variant.clone();
                variant.changes.push((key.clone(), value.clone()));
                variant
            })
        };
        variants = variants.iter().flat_map(with).collect();
    }
    Ok(variants)
}

/// The rows of the table at `path` as variants: a column a key, and one called `name` if they are to have names; an
/// empty cell leaves the study as it is. Blank rows are skipped.
///
/// # Errors
/// A file that is no such table; names that are none of a file, or come twice.
pub(super) fn cases(path: &Path) -> Result<Vec<Variant>, UpliftError> {
    let fail = |reason: String| JobError::input(format!("{}: {reason}", path.display()));
    let (table, short) = text_table::parse_with_short_row(&read_file(path, MOST_BYTES)?, &[NAME]).map_err(&fail)?;
    if table.get_column_index("record_id").is_some() {
        return Err(fail(
            "it is a manifest of records: a table of cases has a column for each key of the study".to_owned(),
        )
        .into());
    }
    if let Some((line, cells)) = short {
        let missing = table.columns()[cells].name();
        return Err(fail(format!(
            "line {line}: column {missing} is missing: end the row with a separator to keep the study's value"
        ))
        .into());
    }
    let mut variants = vec![Variant::default(); table.height()];
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    for (row, variant) in variants.iter_mut().enumerate() {
        variant.place = Some(format!("{name}, row {}", row + 1));
    }
    for column in table.columns() {
        let key = column.name().trim().to_owned();
        // so a reader of tables tells them apart
        if let Some((twice, _)) = key.rsplit_once("_duplicated_") {
            return Err(fail(format!("column {twice} is given twice")).into());
        }
        let cells = column.str().map_err(|error| fail(error.to_string()))?;
        for (variant, cell) in variants.iter_mut().zip(cells.iter()) {
            let Some(cell) = cell.map(str::trim).filter(|cell| !cell.is_empty()) else { continue };
            if key == NAME {
                variant.name = Some(cell.to_owned());
            } else {
                variant.changes.push((key.clone(), cell.to_owned()));
            }
        }
    }
    let mut mistakes = Vec::new();
    for (place, variant) in variants.iter().enumerate() {
        let Some(name) = &variant.name else { continue };
        let plain = name.chars().all(|letter| letter.is_alphanumeric() || "._-".contains(letter));
        if !plain || name.starts_with('.') || name.chars().count() > LONGEST_NAME {
            mistakes.push(format!(
                "row {}: name {name:?}: write up to {LONGEST_NAME} letters, digits, points, dashes, underscores",
                place + 1
            ));
        }
        let own = |other: &Variant| other.name.as_deref().is_some_and(|other| is_same_name(other, name));
        if variants[..place].iter().any(own) {
            mistakes
                .push(format!("row {}: name {name:?} is given twice (upper and lower case are the same)", place + 1));
        }
    }
    // blank rows
    variants.retain(|variant| variant.name.is_some() || !variant.changes.is_empty());
    if variants.is_empty() {
        mistakes.push("no case below the header".to_owned());
    }
    if mistakes.is_empty() { Ok(variants) } else { Err(fail(mistakes.join("; ")).into()) }
}

/// The parts of `text` between commas that stand in no bracket, brace or quote.
fn split(text: &str) -> Vec<String> {
    let (mut parts, mut depth, mut quote) = (vec![String::new()], 0_i32, None);
    for letter in text.chars() {
        match (letter, quote) {
            ('"' | '\'', None) => quote = Some(letter),
            (_, Some(open)) if letter == open => quote = None,
            ('[' | '{', None) => depth += 1,
            (']' | '}', None) => depth -= 1,
            (',', None) if depth <= 0 => {
                parts.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(part) = parts.last_mut() {
            part.push(letter);
        }
    }
    parts.iter().map(|part| part.trim().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn over(texts: &[&str]) -> Result<Vec<Variant>, UpliftError> {
        product(&texts.iter().map(|&text| text.to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn a_product_has_every_combination_and_the_last_runs_fastest() {
        let found = over(&["oscillator.restitution=0.85, 0.95", "strengths.values=[0.1, 0.2],\"0:0.1:1\""]).unwrap();
        let overrides: Vec<Vec<String>> = found.iter().map(|variant| variant.overrides().collect()).collect();
        let of = |restitution: &str, strengths: &str| {
            vec![format!("oscillator.restitution={restitution}"), format!("strengths.values={strengths}")]
        };
        let (list, range) = ("[0.1, 0.2]", "\"0:0.1:1\"");
        assert_eq!(overrides, [of("0.85", list), of("0.85", range), of("0.95", list), of("0.95", range)]);
        assert_eq!(names(&found)[0], "restitution-0.85_values-0.1--0.2");
        assert_eq!(keys(&found), ["oscillator.restitution", "strengths.values"]);
        assert_eq!(names(&over(&[]).unwrap()), ["as-it-stands"]);
    }

    #[test]
    fn names_that_letters_do_not_tell_apart_get_a_hash() {
        let found = names(&over(&["a.title=x y,x-y", "b.k=1"]).unwrap());
        assert!(found[0] != found[1] && found.iter().all(|name| name.starts_with("title-x-y_k-1-")), "{found:?}");
        let long = format!("a.values=[{}]", "0.123456789, ".repeat(40));
        assert!(names(&over(&[&long]).unwrap())[0].len() < 60);
    }

    #[test]
    fn all_mistakes_of_a_product_are_reported_at_once() {
        let error = over(&["a", "b=1,,2", "c=1,1", "d=1", "d=2"]).unwrap_err().to_string();
        for words in ["--over a: write", "a value is missing", "1 is given twice", "d is given twice"] {
            assert!(error.contains(words), "{error}");
        }
    }
}
