//! What an unknown word was probably meant to be.

use std::fs;
use std::path::Path;

use uplift_motion::IntensityMeasure;

/// Units as keys end in them, each after an underscore, longest first.
const UNITS: [&str; 12] = ["per_s2", "cm_s2", "m_s2", "mm_s", "cm_s", "m_s", "mm", "cm", "in", "m", "g", "s"];

/// "did you mean `…`?" with the one of `known` most like `word`, if any is like it.
pub fn did_you_mean(word: &str, known: &[&str]) -> Option<String> {
    most_like(word, known).map(|candidate| format!("did you mean `{candidate}`?"))
}

/// The same with a file of this `ending` beside `file`, whether or not `file` has the ending.
pub fn did_you_mean_file(file: &Path, ending: &str) -> Option<String> {
    let ending = format!(".{ending}");
    let name = file.file_name()?.to_str()?;
    // from where a name without folder starts
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let entries = fs::read_dir(folder).ok()?;
    let names: Vec<String> = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    // the ending makes all names alike
    let mut stems: Vec<&str> = names.iter().filter_map(|name| name.strip_suffix(&ending)).collect();
    stems.sort_unstable();
    let meant = most_like(name.strip_suffix(&ending).unwrap_or(name), &stems)?;
    Some(format!("did you mean `{}`?", file.with_file_name(format!("{meant}{ending}")).display()))
}

fn most_like<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    // A long word is far from every key, and the distance costs its length squared.
    if word.len() > 100 {
        return None;
    }
    let lower = word.to_lowercase();
    known
        .iter()
        .map(|&candidate| {
            let other = candidate.to_lowercase();
            let begins = lower.len() > 2 && (lower.starts_with(&other) || other.starts_with(&lower));
            let alike = strsim::normalized_damerau_levenshtein(&lower, &other);
            let alike = if begins { alike.max(0.7) } else { alike };
            (alike, candidate)
        })
        .filter(|&(alike, _)| alike > 0.55)
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, candidate)| candidate)
}

/// What to do about keys of other programs that no key here stands for: `path` and `known` tell the section.
pub(crate) fn from_other_programs(path: &str, key: &str, known: &[&str]) -> Option<&'static str> {
    let key = key.to_lowercase();
    let is_modulus = key.contains("modulus") || key.starts_with("young");
    match &*key {
        "return_period" | "return_periods" | "return_period_years" if path == "risk" => Some(
            "a result is read at any return period: uplift spectrum RESULT --return-period 475; the study gives `poe` \
             and `years`",
        ),
        "longitude" | "latitude" | "lon" | "lat" if path.starts_with("sites[") => {
            Some("a site needs no coordinates: its curve is the hazard there; leave the key out")
        }
        "e" | "e_pa" | "e_mpa" | "e_gpa" | "e_n_m2" if known.contains(&"period_s") => Some(NO_MODULUS),
        _ if is_modulus && known.contains(&"period_s") => Some(NO_MODULUS),
        _ => None,
    }
}

/// A structure file has forces and displacements, no material.
const NO_MODULUS: &str =
    "the modulus is not read: give uplift_displacement_m = force at uplift / stiffness, or period_s";

/// The section of the measures that Chapter 4 has not.
pub(crate) const MEASURES: &str = "measures";

/// What to do where `key` is another spelling of an intensity measure, or looks like one; `is_top` tells whether it
/// stands before all sections, where only those of Chapter 4 do.
pub(crate) fn measure_by_its_key(key: &str, is_top: bool) -> Option<String> {
    let plain = key.to_lowercase();
    let is_spectral = ["sa", "avgsa"].iter().any(|name| {
        let rest = plain.strip_prefix(name);
        rest.is_some_and(|rest| {
            rest.is_empty() || rest.starts_with(|c: char| c == '_' || c == '(' || c.is_ascii_digit())
        })
    });
    match key.parse::<IntensityMeasure>() {
        Ok(measure) if is_top => Some(format!("head the section with [{MEASURES}.{}]", measure.key())),
        Ok(measure) if measure.key() != key => Some(format!("write {} as `{}`", measure.label(), measure.key())),
        Err(_) if is_spectral => {
            Some(format!("measures are {}; periods are from 0.01 to 20 s", IntensityMeasure::ACCEPTED))
        }
        _ => None,
    }
}

/// What to do where `key` is one of `known` but for its unit.
pub(crate) fn other_unit(key: &str, known: &[&str]) -> Option<String> {
    let (stem, own) = stem_and_unit(key);
    known.iter().find(|&&candidate| stem_and_unit(candidate).0 == stem).map(|&candidate| {
        match stem_and_unit(candidate).1 {
            Some(unit) if own.is_none() => format!("write `{candidate}`, in {unit}"),
            Some(unit) => format!("unit: it is given in {unit}, as `{candidate}`; convert the value"),
            None => format!("unit: it has none, write `{candidate}`"),
        }
    })
}

/// A key without its unit, and the unit as people write it: `1/s2`, `cm/s`.
fn stem_and_unit(key: &str) -> (&str, Option<String>) {
    let stem = |unit: &str| key.strip_suffix(unit)?.strip_suffix('_');
    let parts = UNITS.iter().find_map(|unit| Some((stem(unit)?, Some(unit.replace("per", "1").replace('_', "/")))));
    parts.unwrap_or((key, None))
}
