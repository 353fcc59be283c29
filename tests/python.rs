//! The Python that reads files of this program in the tests. A module of several test programs: it names no crate.
#![allow(unreachable_pub)]

use std::path::{Path, PathBuf};
use std::process::Command;

/// The top of the repository, seen from any crate.
pub fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// The Python of `UPLIFT_PYTHON`, else of the repository's `.venv`; none skips the test, on a build server fails it.
pub fn python() -> Option<PathBuf> {
    let python = std::env::var_os("UPLIFT_PYTHON").map_or_else(|| repository().join(".venv/bin/python"), PathBuf::from);
    let works = Command::new(&python)
        .args(["-c", "import h5py, xarray, netCDF4, h5netcdf, openpyxl, pandas, check_jsonschema"])
        .output();
    if works.is_ok_and(|output| output.status.success()) {
        return Some(python);
    }
    assert!(std::env::var_os("CI").is_none(), "no Python with the packages of tests/python/requirements.txt");
    println!("skipped: no Python with the packages of tests/python/requirements.txt (set UPLIFT_PYTHON)");
    None
}
