//! Tells the program which commit it was built from.

use std::process::Command;

fn main() {
    // whoever develops would build the whole pipeline again after every commit
    if std::env::var("PROFILE").is_ok_and(|profile| profile == "debug") {
        println!("cargo::rustc-env=UPLIFT_COMMIT=development");
        println!("cargo::rerun-if-changed=build.rs");
        return;
    }
    let commit = commit().unwrap_or_else(|| "unknown".to_owned());
    println!("cargo::rustc-env=UPLIFT_COMMIT={commit}");
    for path in ["../../.git/HEAD", "../../.git/index", "src"] {
        if std::path::Path::new(path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
}

/// The commit, and whether files are not as they were committed. `git describe --dirty` would tell the same, but it
/// writes the index, so that the next build would begin here once more.
fn commit() -> Option<String> {
    let commit = git(&["rev-parse", "--short", "HEAD"])?;
    let changed = git(&["--no-optional-locks", "status", "--porcelain", "--untracked-files=no"])?;
    Some(if changed.is_empty() { commit } else { commit + "-dirty" })
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
