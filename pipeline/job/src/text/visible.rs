//! Text from files on its way to a screen: what a terminal would obey is spelt out.

use std::borrow::Cow;

/// `text` with the characters spelt out that a terminal obeys, or that reorder what stands beside them: an escape
/// becomes `\u{1b}`. Line breaks and tabs stay.
pub fn visible(text: &str) -> Cow<'_, str> {
    spelt_out(text, |letter| is_obeyed(letter) && letter != '\n' && letter != '\t')
}

/// The same on one line, for a name or a remark.
pub fn one_line(text: &str) -> Cow<'_, str> {
    spelt_out(text, is_obeyed)
}

/// Whether a terminal obeys the character: a control character, a separator of lines, or a mark of the direction of
/// writing; or whether it is none: no reader of XML takes a text with it.
pub fn is_obeyed(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
        || matches!(letter, '\u{fffe}' | '\u{ffff}')
}

fn spelt_out(text: &str, wanted: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.chars().any(&wanted) {
        return Cow::Borrowed(text);
    }
    let mut spelt = String::with_capacity(text.len() + 16);
    for letter in text.chars() {
        if wanted(letter) { spelt.extend(letter.escape_unicode()) } else { spelt.push(letter) }
    }
    Cow::Owned(spelt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_spelt_out() {
        assert_eq!(visible("\u{1b}[31mred\u{9b}2J\u{202e}\r\n\tη"), "\\u{1b}[31mred\\u{9b}2J\\u{202e}\\u{d}\n\tη");
        assert_eq!(one_line("two\nlines\t\0"), "two\\u{a}lines\\u{9}\\u{0}");
        assert_eq!(visible("\u{fffe}\u{ffff}\u{fffd}"), "\\u{fffe}\\u{ffff}\u{fffd}");
        assert!(matches!(visible("Zürich, Ωμέγα 東京 🏗"), Cow::Borrowed(_)));
    }
}
