//! The ways out to the terminal: texts from files do not command it.

use std::io::{self, Stderr, StdoutLock, Write};
use std::sync::atomic::{AtomicBool, Ordering};

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

/// The stream of answers.
pub(crate) type Output = Visible<Answer<StdoutLock<'static>>>;

pub(crate) fn output() -> Output {
    Visible(Answer(io::stdout().lock(), &HAS_BEGUN))
}

pub(crate) fn error_output() -> Visible<Stderr> {
    Visible(io::stderr())
}

/// Whether anything was answered.
static HAS_BEGUN: AtomicBool = AtomicBool::new(false);

/// An answer, which begins on the first line: a paragraph that leaves one free above itself may be the first.
pub(crate) struct Answer<W>(W, &'static AtomicBool);

impl<W: Write> Write for Answer<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let skipped =
            if self.1.load(Ordering::Relaxed) { 0 } else { bytes.iter().take_while(|byte| **byte == b'\n').count() };
        self.1.fetch_or(skipped < bytes.len(), Ordering::Relaxed);
        self.0.write_all(&bytes[skipped..])?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
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
    use super::*;

    #[test]
    fn an_answer_begins_on_the_first_line() {
        static BEGUN: AtomicBool = AtomicBool::new(false);
        let mut out = Answer(Vec::new(), &BEGUN);
        writeln!(out).unwrap();
        writeln!(out, "\nSpectra").unwrap();
        writeln!(out, "\nWarnings").unwrap();
        assert_eq!(String::from_utf8(out.0).unwrap(), "Spectra\n\nWarnings\n");
    }

    #[test]
    fn what_a_terminal_would_obey_is_spelt_out() {
        let mut out = Visible(Vec::new());
        let site = "\u{1b}[2Jη\u{9b}";
        writeln!(out, "site {site}: {:>4}", 1.5).unwrap();
        assert_eq!(String::from_utf8(out.0).unwrap(), "site \\u{1b}[2Jη\\u{9b}:  1.5\n");
    }
}
