//! Every kind of case, and the verdict on each.

use serde::Deserialize;
use serde_json::Value;

use comparison::Comparison;

mod comparison;
mod discs;
mod free_wobbling;
mod motions;
mod records;
mod restrainer;
mod shake_table;
mod statics;
mod validation;

/// What became of a case.
pub(crate) struct Verdict {
    /// Name of the case.
    pub(crate) id: String,
    /// Everything that differs, in words; empty where all agrees.
    pub(crate) differences: Vec<String>,
    /// Numbers that were compared.
    #[allow(dead_code)] // the tests ask for it
    pub(crate) compared: usize,
}

/// A file of cases; lists that it does not have are empty.
#[derive(Deserialize)]
struct File {
    #[serde(default)]
    statics: Vec<Value>,
    #[serde(default)]
    discs: Vec<Value>,
    #[serde(default)]
    planar: Vec<Value>,
    #[serde(default)]
    wobbling: Vec<Value>,
    #[serde(default)]
    validation: Vec<Value>,
    #[serde(default)]
    shake_table: Vec<Value>,
    /// Frames that wobble, those that nothing shakes.
    #[serde(default)]
    cases: Vec<Value>,
}

/// How a case is checked.
type Check = fn(&Value, &mut Comparison) -> Result<(), String>;

/// The verdict on every case of a file.
///
/// # Errors
/// The file is no JSON, or not an object with lists of cases.
pub(crate) fn verdicts(text: &str) -> Result<Vec<Verdict>, serde_json::Error> {
    let file: File = serde_json::from_str(text)?;
    let free: Vec<Value> = file.cases.iter().filter(|case| free_wobbling::is_free(case)).cloned().collect();
    let kinds: [(&[Value], Check); 7] = [
        (&file.statics, statics::statics_case),
        (&file.discs, discs::disc_case),
        (&file.planar, motions::planar_case),
        (&file.wobbling, motions::wobbling_case),
        (&file.validation, validation::validation_case),
        (&file.shake_table, shake_table::shake_table_case),
        (&free, free_wobbling::free_case),
    ];
    Ok(kinds.into_iter().flat_map(|(cases, check)| cases.iter().map(move |case| verdict(case, check))).collect())
}

fn verdict(case: &Value, check: Check) -> Verdict {
    let id = match (case.get("id").and_then(Value::as_str), case.get("exc_id")) {
        (Some(id), _) => id.to_owned(),
        (None, Some(excitation)) => format!("excitation {excitation}"),
        (None, None) => "(no id)".to_owned(),
    };
    let mut comparison = Comparison::default();
    if let Err(message) = check(case, &mut comparison) {
        comparison.differences.push(format!("cannot be computed: {message}"));
    }
    Verdict { id, differences: comparison.differences, compared: comparison.compared }
}
