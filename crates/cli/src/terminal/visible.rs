//! The ways out to the terminal: texts from files do not command it.

use std::io::{self, Stderr, StdoutLock, Write};

use uplift::text::{is_obeyed, visible};

/// A stream on which what a terminal would obey is spelt out. Each write holds whole characters, as those of the
/// formatting macros do.
pub(crate) struct Visible<W>(W);

/// Text of JSON in which what a terminal would obey is spelt as JSON does.
pub(crate) fn visible_json(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for letter in json.chars() {
        if is_obeyed(letter) && letter != '\n' {
            text.extend(format!("\\u{:04x}", u32::from(letter)).chars());
        } else {
            text.push(letter);
        }
    }
    text
}

pub(crate) fn output() -> Visible<StdoutLock<'static>> {
    Visible(io::stdout().lock())
}

pub(crate) fn error_output() -> Visible<Stderr> {
    Visible(io::stderr())
}

impl<W: Write> Write for Visible<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write_all(visible(&String::from_utf8_lossy(bytes)).as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_spelt_out() {
        let mut out = Visible(Vec::new());
        let site = "\u{1b}[2Jη\u{9b}";
        writeln!(out, "site {site}: {:>4}", 1.5).unwrap();
        assert_eq!(String::from_utf8(out.0).unwrap(), "site \\u{1b}[2Jη\\u{9b}:  1.5\n");
    }
}
