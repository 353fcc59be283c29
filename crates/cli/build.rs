//! How the program is linked.

use std::env::var;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=no-unwinding.ld");
    // Functions that compile to the same code are kept once, and tables for unwinding left out. lld can, which links
    // programs for this target since Rust 1.90; a linker that was chosen, as zig, may not.
    let released = var("PROFILE").is_ok_and(|profile| profile == "release");
    let is_chosen = |flags: String| ["linker=", "-linker", "fuse-ld"].iter().any(|flag| flags.contains(flag));
    let is_lld = var("RUSTC_LINKER").is_err()
        && !var("CARGO_ENCODED_RUSTFLAGS").is_ok_and(is_chosen)
        && var("TARGET").is_ok_and(|target| target == "x86_64-unknown-linux-gnu");
    if let (true, Ok(folder)) = (released && is_lld, var("CARGO_MANIFEST_DIR")) {
        println!("cargo:rustc-link-arg-bins=-Wl,--icf=all");
        println!("cargo:rustc-link-arg-bins=-T{folder}/no-unwinding.ld");
    }
}
