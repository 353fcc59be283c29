//! What a result file has beside its arrays: axes, attributes and the groups of answers (docs/hdf5-layout.md).

pub mod attribute;
pub mod axis;
pub mod names;

use std::collections::BTreeSet;

/// Version of the layout of the result file.
pub const LAYOUT: i64 = 1;

/// What structures were asked, and the answers.
pub mod structures {
    /// The group of all structures.
    pub const ROOT: &str = "/structures";

    /// The answers on a structure.
    pub fn group(structure: &str) -> String {
        format!("{ROOT}/{structure}")
    }

    /// The answer of a command to the question of this key.
    pub fn answer(structure: &str, command: &str, key: &str) -> String {
        format!("{}/{command}/{key}", group(structure))
    }
}

/// As much of a name as an axis name can hold: lower-case ASCII.
pub fn axis_part(name: &str) -> String {
    let fit = |character: char| if character.is_ascii_alphanumeric() { character } else { '_' };
    name.to_lowercase().chars().take(40).map(fit).collect()
}

/// The name of an axis, longer where it is taken: by a name that differs only in what an axis name cannot hold.
pub fn unique_axis(mut axis: String, taken: &mut BTreeSet<String>) -> String {
    while !taken.insert(axis.clone()) {
        axis.push('x');
    }
    axis
}

/// Names of both limits and the median: `u05_m`, `u50_m`, `u95_m` for a confidence of 0.9, `u02_5_m` and `u97_5_m` for
/// 0.95.
pub fn limit_names(confidence: f64) -> [String; 3] {
    let tail = 0.5 * (1.0 - confidence);
    [tail, 0.5, 1.0 - tail].map(|level| percentile_name(100.0 * level))
}

/// Name of a percentile of displacements: `u05_m`, or `u02_5_m` for 2.5 %.
pub fn percentile_name(percent: f64) -> String {
    let percent = ((percent * 1e6).round() / 1e6).to_string();
    let (whole, part) = percent.split_once('.').map_or((percent.as_str(), ""), |(whole, part)| (whole, part));
    let part = if part.is_empty() { String::new() } else { format!("_{part}") };
    format!("u{whole:0>2}{part}_m")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_named_by_their_level() {
        assert_eq!(limit_names(0.9), ["u05_m", "u50_m", "u95_m"]);
        assert_eq!(limit_names(0.95), ["u02_5_m", "u50_m", "u97_5_m"]);
        assert_eq!(limit_names(0.68), ["u16_m", "u50_m", "u84_m"]);
    }
}
