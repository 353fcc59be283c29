//! What the end-to-end tests share: the built program, small studies, the places of things.
#![allow(dead_code, clippy::unwrap_used, clippy::print_stdout, unreachable_pub)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

pub fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// What a run of the program left behind.
#[derive(Debug)]
pub struct Finished {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Finished {
    fn of(output: Output) -> Self {
        Self {
            code: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Succeeded, or this test shows what the program said.
    pub fn ok(self) -> Self {
        assert_eq!(self.code, 0, "{}\n{}", self.stdout, self.stderr);
        self
    }

    /// Failed with this code, saying each of these words, without a backtrace.
    pub fn fails(self, code: i32, words: &[&str]) -> Self {
        assert_eq!(self.code, code, "{}\n{}", self.stdout, self.stderr);
        for word in words {
            assert!(self.stderr.contains(word), "{word:?} is not in:\n{}", self.stderr);
        }
        assert!(!self.stderr.contains("panicked") && !self.stderr.contains("backtrace"), "{}", self.stderr);
        self
    }
}

/// The built program in the folder `at`, its cache kept apart from the user's.
pub fn command(at: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uplift"));
    command.current_dir(at).env("UPLIFT_CACHE", concat!(env!("CARGO_TARGET_TMPDIR"), "/cache")).env("NO_COLOR", "1");
    command
}

pub fn uplift<S: AsRef<str>>(at: &Path, arguments: &[S]) -> Finished {
    Finished::of(command(at).args(arguments.iter().map(AsRef::as_ref)).output().unwrap())
}

/// A folder with a study that takes well under a second: two sites with curves λ = k₀ im^(−k), four synthetic pairs.
pub struct SmallStudy {
    pub folder: TempDir,
}

/// An earlier result, as far as its first bytes tell.
pub const EARLIER: &[u8] = b"\x89HDF\r\n\x1a\nan earlier result";

pub const SMALL_STUDY: &str = r#"title = "small"
[records]
first = 4
[records.synthetic]
pairs = 4
[strengths]
values = [0, 0.05, "0.1:0.1:0.8"]
[pgv]
levels_cm_s = [1, 3, 10, 30, 100]
[pga]
levels_g = [0.02, 0.1, 0.3, 1.0]
[risk]
thresholds_m = [0, 0.0005, "0.01:0.01:1"]
[[sites]]
name = "Here"
pgv = "here-pgv.csv"
pga = "pga.csv"
[[sites]]
name = "There"
pgv = { file = "there-pgv.csv", unit = "m/s", kind = "poe", years = 50 }
pga = "pga.csv"
"#;

impl SmallStudy {
    pub fn new() -> Self {
        Self::with(SMALL_STUDY)
    }

    pub fn with(text: &str) -> Self {
        let study = Self { folder: tempfile::tempdir().unwrap() };
        study.write("study.toml", text);
        let curve = |range: &[f64], k0: f64, k: f64| -> Vec<(f64, f64)> {
            range.iter().map(|&im| (im, k0 * im.powf(-k))).collect()
        };
        let rows = |points: &[(f64, f64)], header: &str| -> String {
            let lines: Vec<String> = points.iter().map(|(im, value)| format!("{im},{value:e}")).collect();
            format!("# a power law\n{header}\n{}\n", lines.join("\n"))
        };
        let pgv = curve(&[0.5, 2.0, 20.0, 300.0], 0.2, 2.0);
        study.write("here-pgv.csv", &rows(&pgv, "iml,maf"));
        let probabilities: Vec<(f64, f64)> =
            pgv.iter().map(|&(im, rate)| (im / 100.0, -(-50.0 * 0.5 * rate).exp_m1())).collect();
        study.write("there-pgv.csv", &rows(&probabilities, "iml,poe"));
        study.write("pga.csv", &rows(&curve(&[0.01, 0.1, 3.0], 1e-4, 2.2), "iml,maf"));
        study
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    pub fn write_bytes(&self, name: &str, bytes: &[u8]) {
        std::fs::write(self.path().join(name), bytes).unwrap();
    }

    /// `uplift ARGUMENTS` in the folder of the study.
    pub fn uplift(&self, arguments: &[&str]) -> Finished {
        uplift(self.path(), arguments)
    }

    /// The same, stopped by Ctrl-C after two seconds.
    #[cfg(unix)]
    pub fn uplift_stopped(&self, arguments: &[&str]) -> Finished {
        let child = command(self.path())
            .args(arguments)
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_secs(2));
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        Finished::of(child.wait_with_output().unwrap())
    }
}

/// The real records, which may not be distributed: the folder of `UPLIFT_RECORDS`, else a place beside the repository.
pub fn real_records() -> Option<PathBuf> {
    let folder =
        std::env::var_os("UPLIFT_RECORDS").map_or_else(|| repository().join("../shared/records"), PathBuf::from);
    if folder.join("manifest.csv").is_file() {
        return Some(folder.canonicalize().unwrap());
    }
    println!("skipped: no real records (set UPLIFT_RECORDS to a folder with a manifest.csv)");
    None
}

/// The Python of `UPLIFT_PYTHON`, else of the repository's `.venv`; none skips the test, on a build server fails it.
pub fn python() -> Option<PathBuf> {
    let python = std::env::var_os("UPLIFT_PYTHON").map_or_else(|| repository().join(".venv/bin/python"), PathBuf::from);
    let works = Command::new(&python).args(["-c", "import h5py, xarray, netCDF4, h5netcdf, pandas"]).output();
    if works.is_ok_and(|output| output.status.success()) {
        return Some(python);
    }
    assert!(std::env::var_os("CI").is_none(), "no Python with h5py, xarray, netCDF4, h5netcdf and pandas");
    println!("skipped: no Python with h5py, xarray, netCDF4, h5netcdf and pandas (set UPLIFT_PYTHON)");
    None
}
