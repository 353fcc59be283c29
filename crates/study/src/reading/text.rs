//! A file as text, and the text as TOML.

use std::borrow::Cow;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::Table;
use super::findings::place;
use super::other_file::Wanted;
use super::suggestion::did_you_mean_file;
use crate::error::{MOST_LISTED, StudyError, StudyMistake, Unreadable};

/// Largest study file \[bytes\]; one with 100 000 numbers written out has 2 MB.
const LARGEST_FILE: u64 = 4 << 20;

/// What stands for standard input in the place of a file; paths in it start from the current directory.
pub(crate) const STANDARD_INPUT: &str = "-";

/// The text of the file `file`, if it is one that people write and may be what is `wanted`.
pub(crate) fn read_text(file: &Path, wanted: Wanted) -> Result<String, StudyError> {
    read(file, wanted).map_err(|reason| StudyError::unreadable(file, reason))
}

/// The text of a study on standard input, under the same conditions.
pub(crate) fn input_text() -> Result<String, StudyError> {
    let file = Path::new(STANDARD_INPUT);
    as_text(io::stdin().lock(), file, Wanted::Study).map_err(|reason| StudyError::unreadable(file, reason))
}

fn read(file: &Path, wanted: Wanted) -> Result<String, Unreadable> {
    let metadata = fs::metadata(file).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => Unreadable::Missing {
            advice: did_you_mean_file(file, "toml")
                .unwrap_or_else(|| format!("give its path from the current folder, e.g. {}", wanted.example())),
        },
        _ => Unreadable::System(error),
    })?;
    if metadata.is_dir() {
        let example = the_toml_file_in(file).unwrap_or_else(|| wanted.example().into());
        return Err(Unreadable::Folder { example });
    }
    if !metadata.is_file() {
        return Err(Unreadable::NotAFile);
    }
    as_text(fs::File::open(file)?, file, wanted)
}

/// The only TOML file in a folder, or of several the one that `uplift init` writes.
fn the_toml_file_in(folder: &Path) -> Option<PathBuf> {
    let written = folder.join("study.toml");
    if written.is_file() {
        return Some(written);
    }
    let paths = fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
    let mut files = paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml") && path.is_file());
    files.next().filter(|_| files.next().is_none())
}

fn as_text(source: impl Read, file: &Path, wanted: Wanted) -> Result<String, Unreadable> {
    let mut bytes = Vec::new();
    source.take(LARGEST_FILE + 1).read_to_end(&mut bytes)?;
    if let Some(reason) = wanted.refusal_of_bytes(file, &bytes) {
        return Err(reason);
    }
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(Unreadable::TooLarge { most_bytes: LARGEST_FILE });
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        Unreadable::NotUtf8 { line: valid.split(|&byte| byte == b'\n').count() }
    })
}

/// The text as TOML; the errors are those of its syntax.
pub(crate) fn parse_table(file: &Path, text: &str) -> Result<Table, StudyError> {
    Table::parse(text).map_err(|mut errors| {
        errors.sort_by_key(|error| error.span().map(|span| span.start));
        let listed = errors.iter().take(MOST_LISTED).map(|error| StudyMistake {
            key: String::new(),
            place: place(text, error.span().unwrap_or_default()),
            message: format!("not TOML: {}", error.message()),
            help: Some(syntax_help(error.message(), line_at(text, error.span())).into_owned()),
        });
        let listed: Vec<_> = listed.collect();
        let left_out = errors.len() - listed.len();
        StudyError::from_mistakes(file, text.to_owned(), listed, left_out)
    })
}

/// The line of `text` that a mistake begins on.
fn line_at(text: &str, span: Option<std::ops::Range<usize>>) -> &str {
    let at = span.map_or(0, |span| span.start).min(text.len());
    let (before, after) = text.split_at_checked(at).unwrap_or((text, ""));
    let begin = before.rfind('\n').map_or(0, |newline| newline + 1);
    let end = at + after.find('\n').unwrap_or(after.len());
    text.get(begin..end).unwrap_or_default()
}

/// What to do about a mistake of TOML syntax in this `line`.
fn syntax_help(message: &str, line: &str) -> Cow<'static, str> {
    if message.contains("duplicate") {
        "each key and each [section] is allowed once; write [[sites]] for another site".into()
    } else if let Some(pointed) = decimal_comma(line) {
        format!("the decimal mark is a point: write {pointed}").into()
    } else if line.split('#').next().is_some_and(|line| line.contains('"') && line.contains('\\')) {
        BACKSLASH.into()
    } else {
        "put texts, paths and grids in double quotes, lists in [ ]".into()
    }
}

/// The number of a line `key = 0,95`, with a point.
fn decimal_comma(line: &str) -> Option<String> {
    let (_, value) = line.split('#').next()?.split_once('=')?;
    let (whole, decimals) = value.trim().split_once(',')?;
    let is_number =
        whole.parse::<i64>().is_ok() && !decimals.is_empty() && decimals.bytes().all(|c| c.is_ascii_digit());
    is_number.then(|| format!("{whole}.{decimals}"))
}

/// What to do about a path of Windows.
pub(crate) const BACKSLASH: &str = "in double quotes a backslash has a meaning of its own: put paths of Windows in \
                                    'single quotes', or write / in place of \\";
