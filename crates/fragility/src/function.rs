//! Fragilities as other programs take them: of a system, over the levels of an intensity measure.

use crate::LognormalFragility;

/// What the functions of one system show: how often its limit states are exceeded at each level.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityFunction {
    /// Letters, digits, `-` and `_`: the taxonomy of its assets.
    pub id: String,
    /// Intensity measure type of `OpenQuake`, as `PGA` or `SA(1.0)`.
    pub imt: String,
    /// Levels in the unit of `OpenQuake`, ascending.
    pub levels: Vec<f64>,
    /// Its limit states, from the first that is exceeded to the last.
    pub states: Vec<FragilityState>,
}

/// How often one limit state is exceeded.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityState {
    /// Name in the model.
    pub name: String,
    /// Shares at the levels.
    pub shares: Vec<f64>,
    /// A lognormal function over the levels; none where there is no fit.
    pub lognormal: Option<LognormalFragility>,
}

/// What other programs accept as a name: all but letters, digits and `-` of `words` becomes `_`, a point `p`.
pub fn plain_id(words: &str) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() || letter == '-' { letter } else { '_' };
    words.replace('.', "p").chars().map(plain).collect()
}

/// What to say of the limit states of a function that have no lognormal function; nothing where all have one.
pub(crate) fn without_fit(id: &str, missing: &[&str]) -> Option<String> {
    (!missing.is_empty()).then(|| format!("{id}: no lognormal function: {} has no fit", missing.join(", ")))
}
