//! The name of a site or record set.

use crate::keys::{Key, Text, text};
use crate::reading::Section;

/// The key of the name.
pub(crate) const KEY: Key<Text> = text("name");

/// Longest name, in bytes.
const LONGEST: usize = 100;

/// The name of a section of a list of `what`, of no other among `names` and fit for a group of the result file.
pub(crate) fn read(section: &mut Section<'_>, what: &str, example: &str, names: &mut Vec<String>) -> Option<String> {
    let field = section.needed(&KEY, format!("the {what} has no name"), format!("add name = \"{example}\""))?;
    let name = field.filled_text()?.trim();
    // The name is one of a group in the result file, and part of file names.
    let unfit = name.len() > LONGEST
        || matches!(name, "." | "..")
        || name.contains(|letter: char| letter.is_control() || "/\\:*?\"<>|".contains(letter));
    if unfit {
        return field.refuse(
            "the name cannot name a group of the result file",
            format!("use at most {LONGEST} bytes, and none of / \\ : * ? \" < > |"),
        );
    }
    let folded = name.to_lowercase();
    if names.contains(&folded) {
        return field.refuse(
            format!("there is another {what} {name}"),
            format!("give each {what} a name of its own (upper and lower case are the same)"),
        );
    }
    names.push(folded);
    Some(name.to_owned())
}
