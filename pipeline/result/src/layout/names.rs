//! Names in angle brackets, which stand in declarations for those of a result.

use std::borrow::Cow;

use uplift_motion::IntensityMeasure;

/// What stands in a result for the names in angle brackets of a declaration: `<im>`, `<site>`.
pub type Names<'a> = &'a [(&'a str, &'a str)];

/// The names of the arrays of one measure.
pub fn measure_names(measure: IntensityMeasure) -> [(&'static str, &'static str); 1] {
    [("<im>", measure.key())]
}

/// A text with `names` for what stands in angle brackets.
pub(crate) fn named<'a>(text: &'a str, names: Names<'_>) -> Cow<'a, str> {
    if !text.contains('<') {
        return text.into();
    }
    names.iter().fold(text.to_owned(), |text, (sign, name)| text.replace(sign, name)).into()
}
