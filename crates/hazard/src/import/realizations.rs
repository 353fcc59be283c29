//! The weights of logic tree realizations.

use std::collections::BTreeMap;
use std::path::Path;

use crate::error::{HazardError, Place};
use crate::input;
use crate::text::{excerpt, fields, number};

/// Largest file of weights, unpacked, bytes.
const MAX_BYTES: u64 = 64 << 20;
/// How far the sum of the weights may be from 1: they are printed with seven digits or fewer.
const SUM_TOLERANCE: f64 = 1e-3;

/// One realization of the logic trees.
#[derive(Debug, Clone, PartialEq)]
pub struct RealizationWeight {
    /// Path through source model and ground motion logic tree, separated by `~`.
    pub branch_path: String,
    /// Its weight, above 0; the weights of a file add up to 1.
    pub weight: f64,
}

/// Reads `OpenQuake`'s export of realizations (`realizations_*.csv`: `rlz_id,branch_path,weight`), by number.
///
/// # Errors
/// [`HazardError::File`] for a file that cannot be read, is empty, or whose weights do not add up to 1;
/// [`HazardError::Row`] naming the line for missing columns, repeated numbers, and weights that are not above 0.
pub fn read_realization_weights(path: &Path) -> Result<BTreeMap<u32, RealizationWeight>, HazardError> {
    let name = path.display().to_string();
    parse(&input::text(input::open(path)?, &name, MAX_BYTES, "not an export of realizations")?, &name)
}

fn parse(text: &str, name: &str) -> Result<BTreeMap<u32, RealizationWeight>, HazardError> {
    let mut columns: Option<[usize; 3]> = None;
    let mut weights = BTreeMap::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.trim_start_matches('"').starts_with('#') {
            continue;
        }
        let place = || Place::Line { file: name.to_owned(), line: index + 1 };
        let row = |reason: String| HazardError::Row { place: place(), reason };
        let cells: Vec<&str> = fields(line, ',').collect();
        let Some([number_at, path_at, weight_at]) = columns else {
            let at = |names: &[&str]| cells.iter().position(|cell| names.contains(cell));
            let found = (at(&["rlz_id", "ordinal"]), at(&["branch_path", "uid"]), at(&["weight"]));
            let (Some(number), Some(path), Some(weight)) = found else {
                return Err(row(
                    "the columns rlz_id, branch_path and weight must be there; export realizations".to_owned()
                ));
            };
            columns = Some([number, path, weight]);
            continue;
        };
        let cell = |at: usize| cells.get(at).copied().ok_or_else(|| row(format!("only {} columns", cells.len())));
        let realization = cell(number_at)?;
        let realization: u32 = realization
            .parse()
            .map_err(|_| row(format!("{} is not the number of a realization", excerpt(realization))))?;
        let weight = number(cell(weight_at)?, place)?;
        // A little above 1 by rounding is found by the sum.
        if !(weight > 0.0) {
            return Err(row(format!("weight {weight} of realization {realization} must be above 0")));
        }
        let entry = RealizationWeight { branch_path: cell(path_at)?.to_owned(), weight };
        if weights.insert(realization, entry).is_some() {
            return Err(row(format!("realization {realization} is there twice; remove one of them")));
        }
    }
    let sum: f64 = weights.values().map(|realization| realization.weight).sum();
    if !((sum - 1.0).abs() <= SUM_TOLERANCE) {
        let reason =
            format!("the weights of its {} realizations add up to {sum}, not to 1; export all of them", weights.len());
        return Err(HazardError::File { file: name.to_owned(), reason });
    }
    Ok(weights)
}
