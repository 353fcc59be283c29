//! Names in a result file that are declared beside no array: of axes and of answers (docs/hdf5-layout.md).

use std::collections::BTreeSet;

use uplift_motion::IntensityMeasure;

/// Version of the layout of the result file.
pub const LAYOUT: i64 = 1;

/// The sentence on how well the records know the spectra of a measure, an attribute of its group in `/urs`.
pub const URS_PRECISION: &str = "precision";

/// Half of the confidence band over the ordinate by record, and by earthquake, attributes of the same group.
pub const HALF_WIDTHS: [&str; 2] = ["half_width", "half_width_by_event"];

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

/// Names of the axes.
pub mod axis {
    use super::{BTreeSet, IntensityMeasure, axis_part, unique_axis};

    /// The axes with fixed names.
    pub const ALL: &[&str] = &[
        RECORD,
        STRUCTURE,
        STRENGTH,
        THRESHOLD,
        SITE,
        POE,
        SAMPLE_SIZE,
        REPLICATE,
        RECORD_SET,
        SCALING,
        SCALED_BY,
        PERCENTILE,
        UPLIFT_DISPLACEMENT,
        CAPACITY,
        HEIGHT,
        SLENDERNESS,
        PRINTED_STRENGTH,
        PRINTED_SLENDERNESS,
        RULE,
        BOUND,
        RATE,
        KNOT,
        LEVEL,
        EXCITATION,
        DIRECTION,
        PERIOD,
    ];
    /// Ground motions.
    pub const RECORD: &str = "record";
    /// Structures that may be.
    pub const STRUCTURE: &str = "structure";
    /// Uplift strengths.
    pub const STRENGTH: &str = "strength";
    /// Displacement thresholds.
    pub const THRESHOLD: &str = "threshold";
    /// Sites.
    pub const SITE: &str = "site";
    /// Probabilities of exceedance.
    pub const POE: &str = "poe";
    /// Records in a sample.
    pub const SAMPLE_SIZE: &str = "sample_size";
    /// Numbers of the replicates.
    pub const REPLICATE: &str = "replicate";
    /// Record sets.
    pub const RECORD_SET: &str = "record_set";
    /// What motions are scaled to.
    pub const SCALING: &str = "scaling";
    /// Whose peak meets it.
    pub const SCALED_BY: &str = "scaled_by";
    /// Percentiles over the motions of a set.
    pub const PERCENTILE: &str = "percentile";
    /// Displacements at uplift.
    pub const UPLIFT_DISPLACEMENT: &str = "uplift_displacement";
    /// Displacement capacities.
    pub const CAPACITY: &str = "capacity";
    /// Heights of blocks.
    pub const HEIGHT: &str = "height";
    /// Slendernesses of blocks.
    pub const SLENDERNESS: &str = "slenderness";
    /// Strengths at which a run prints its spectra.
    pub const PRINTED_STRENGTH: &str = "printed_strength";
    /// Slendernesses at which a run prints its spectra.
    pub const PRINTED_SLENDERNESS: &str = "printed_slenderness";
    /// Design rules.
    pub const RULE: &str = "rule";
    /// A value and its range.
    pub const BOUND: &str = "bound";

    /// Rates at which the hazard of two measures is compared.
    pub const RATE: &str = "rate_number";
    /// Knots of the exponent of weights.
    pub const KNOT: &str = "knot_number";
    /// Levels of shaking of a table.
    pub const LEVEL: &str = "level";
    /// What a table plays.
    pub const EXCITATION: &str = "excitation";
    /// Horizontal components of what a table plays.
    pub const DIRECTION: &str = "direction";
    /// Natural periods.
    pub const PERIOD: &str = "period";

    /// Rows of the answer to the question of this key.
    pub fn finding(key: &str) -> String {
        format!("finding_{key}")
    }

    /// The path of an axis.
    pub fn path(name: &str) -> String {
        format!("/axes/{name}")
    }

    /// Stripe levels of a measure.
    pub fn level(measure: IntensityMeasure) -> String {
        format!("{}_level", measure.key())
    }

    /// Levels of a measure that every record is brought to, though it is scaled to another.
    pub fn common_level(measure: IntensityMeasure) -> String {
        format!("{}_common_level", measure.key())
    }

    /// Levels from which the bins of a measure reach up.
    pub fn bin(measure: IntensityMeasure) -> String {
        format!("{}_bin", measure.key())
    }

    /// Levels of the hazard curve of a site.
    pub fn hazard(site: &str, measure: IntensityMeasure, taken: &mut BTreeSet<String>) -> String {
        unique_axis(format!("hazard_{}_{}", axis_part(site), measure.key()), taken)
    }

    /// Weighted hazard curves of a site.
    pub fn branch(site: &str, measure: IntensityMeasure, taken: &mut BTreeSet<String>) -> String {
        unique_axis(format!("branch_{}_{}", axis_part(site), measure.key()), taken)
    }

    /// Motions of a record set.
    pub fn motion(set: &str, taken: &mut BTreeSet<String>) -> String {
        unique_axis(format!("motion_{}", axis_part(set)), taken)
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

    /// The page that describes the file names every axis.
    #[test]
    fn the_documentation_has_every_axis() {
        let page = include_str!("../../../docs/hdf5-layout.md");
        for name in axis::ALL {
            assert!(page.contains(&format!("| `{name}` |")), "docs/hdf5-layout.md has no axis {name}");
        }
    }
}
