//! Paths and words of commands as a user types them.

use std::path::Path;

/// A path as short as the user would type it.
pub fn shown_path(path: &Path) -> &Path {
    std::env::current_dir().ok().and_then(|folder| path.strip_prefix(folder).ok()).unwrap_or(path)
}

/// The same as a shell takes it.
pub fn typed_path(path: &Path) -> String {
    typed(&shown_path(path).display().to_string())
}

/// A word of a command as a shell takes it.
pub fn typed(word: &str) -> String {
    let is_plain = !word.is_empty() && word.chars().all(|own| own.is_alphanumeric() || "/._-+,@:\\=".contains(own));
    if is_plain { word.to_owned() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::typed;

    #[test]
    fn words_that_a_shell_would_part_or_read_are_quoted() {
        for (word, as_typed) in [
            ("results/quick.h5", "results/quick.h5"),
            ("records.first=20", "records.first=20"),
            ("my study.toml", "'my study.toml'"),
            ("it's", r"'it'\''s'"),
        ] {
            assert_eq!(typed(word), as_typed);
        }
    }
}
