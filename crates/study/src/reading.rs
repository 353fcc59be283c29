//! Reading TOML so that every mistake is found at once and told with its place.
//!
//! | module | what is in it |
//! |---|---|
//! | `text` | a file as text, and the text as TOML |
//! | `document` | TOML in which every key and value knows where it comes from |
//! | `overrides` | `--set key=value`, put into the document |
//! | `section`, `field` | a table and a value while they are read, with what is checked of any of them |
//! | `rule` | what a number must satisfy, as a test and in words |
//! | `paths` | paths: found and made absolute, or taken as they stand |
//! | `letters` | what no text may hold |
//! | `findings` | the mistakes so far, and their places |
//! | `suggestion` | what an unknown word was probably meant to be |

pub(crate) mod document;
pub(crate) mod field;
pub(crate) mod findings;
pub(crate) mod letters;
pub(crate) mod other_file;
pub(crate) mod overrides;
pub(crate) mod paths;
pub(crate) mod rule;
pub(crate) mod section;
mod suggestion;
pub(crate) mod text;

pub(crate) use document::{Node, Origin, Table, Value};
pub(crate) use field::{Field, LARGEST_INTEGER, commas, optional};
pub(crate) use findings::{Finding, Findings};
pub(crate) use paths::Paths;
pub(crate) use rule::{PROBABILITY, Rule, ZERO_TO_ONE, quantity};
pub(crate) use section::Section;
pub(crate) use suggestion::MEASURES;
pub use suggestion::{did_you_mean, did_you_mean_file};
