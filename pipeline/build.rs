//! Tells the program which commit it was built from.

use std::process::Command;

fn main() {
    let commit = git(&["rev-parse", "--short", "HEAD"])
        .map_or_else(|| "unknown".to_owned(), |commit| commit + if is_changed() { "-dirty" } else { "" });
    println!("cargo::rustc-env=UPLIFT_COMMIT={commit}");
    for path in ["../.git/HEAD", "../.git/index", "src"] {
        if std::path::Path::new(path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
}

/// Whether files are not as they were committed. `git describe --dirty` would tell the same, but it writes the index,
/// so that the next build would begin here once more.
fn is_changed() -> bool {
    git(&["--no-optional-locks", "status", "--porcelain", "--untracked-files=no"])
        .is_some_and(|files| !files.is_empty())
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
