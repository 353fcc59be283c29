//! What the end-to-end tests share: the built program, small studies, the places of things.

use std::collections::HashMap;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;
use uplift_labelled::LabelledReader;

pub use crate::python::{python, repository};

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

    /// What it printed as JSON, having succeeded.
    pub fn json(self) -> Value {
        serde_json::from_str(&self.ok().stdout).unwrap()
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

/// The built program, or the one that `UPLIFT_PROGRAM` names, in the folder `at`, its cache kept apart from the user's.
pub fn command(at: &Path) -> Command {
    let program = std::env::var_os("UPLIFT_PROGRAM").unwrap_or_else(|| env!("CARGO_BIN_EXE_uplift").into());
    let mut command = Command::new(program);
    command.current_dir(at).env("UPLIFT_CACHE", concat!(env!("CARGO_TARGET_TMPDIR"), "/cache")).env("NO_COLOR", "1");
    command
}

pub fn uplift<S: AsRef<str>>(at: &Path, arguments: &[S]) -> Finished {
    Finished::of(command(at).args(arguments.iter().map(AsRef::as_ref)).output().unwrap())
}

/// The same with a variable of the environment.
pub fn uplift_where<S: AsRef<str>>(at: &Path, (variable, value): (&str, &str), arguments: &[S]) -> Finished {
    let mut command = command(at);
    Finished::of(command.env(variable, value).args(arguments.iter().map(AsRef::as_ref)).output().unwrap())
}

/// The rows of a table, column name to cell.
pub fn rows(path: &Path) -> Vec<HashMap<String, String>> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let cells =
        |line: &str| header.iter().map(|name| (*name).to_owned()).zip(line.split(',').map(str::to_owned)).collect();
    lines.map(cells).collect()
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

/// All but the sites of [`SmallStudy::repaired`].
const REPAIRED_STUDY: &str = r#"title = "repaired"
[records.synthetic]
pairs = 40
[strengths]
values = [0.05, 0.1, 0.2, 0.4]
[pgv]
levels_cm_s = [0.5, 1, 2, 4, 8, 15, 30, 60, 120]
[pga]
levels_g = [0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 0.6, 1.2]
[risk]
maf_surface = false
[regression]
strength_above = 0
[consistency]
repair = "weights"
[hazard]
conversions = [{ from = "GMRotI50", to = "geometric mean", pgv = 1.0, pga = 1.0 }]
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

    /// A result `r.h5` of records that miss the hazard of all sites: by PGV the first cannot be repaired, and
    /// the second is; its name is markup.
    pub fn repaired() -> Self {
        let hazard = |file: &str| repository().join("hazard").join(file).display().to_string();
        let site = |name: &str, folder: &str| {
            let [pgv, pga] = ["pgv", "pga"].map(|measure| hazard(&format!("{folder}/{measure}.csv")));
            format!("[[sites]]\nname = \"{name}\"\npgv = '{pgv}'\npga = '{pga}'\n")
        };
        let text = format!("{REPAIRED_STUDY}{}{}", site("Montreux", "montreux"), site("Athens &lt; 1", "athens"));
        let study = Self::with(&text);
        study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
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

    /// The same, at work while the test goes on.
    pub fn start(&self, arguments: &[&str]) -> Running {
        Running::of(command(self.path()).args(arguments))
    }
}

/// Longer than anything here takes, however busy the machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// A run of the program that the test stops or looks at on its way; ended with the test, if not before.
#[derive(Debug)]
pub struct Running {
    child: Child,
    /// Standard error so far.
    said: Arc<Mutex<String>>,
    listener: Option<JoinHandle<()>>,
}

impl Running {
    fn of(command: &mut Command) -> Self {
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let said = Arc::new(Mutex::new(String::new()));
        let (stderr, heard) = (BufReader::new(child.stderr.take().unwrap()), said.clone());
        let listener = std::thread::spawn(move || {
            for line in stderr.lines() {
                *heard.lock().unwrap() += &(line.unwrap() + "\n");
            }
        });
        Self { child, said, listener: Some(listener) }
    }

    /// What it has said so far on standard error.
    pub fn said(&self) -> String {
        self.said.lock().unwrap().clone()
    }

    /// False once it has ended, by itself or not.
    pub fn is_at_work(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    /// Waits for the moment that `reached` knows; a run that ends before fails the test.
    pub fn wait_until(&mut self, moment: &str, reached: impl Fn() -> bool) {
        let begin = Instant::now();
        while !reached() {
            assert!(self.is_at_work(), "it ended before: {moment}\n{}", self.said());
            assert!(begin.elapsed() < PATIENCE, "never: {moment}\n{}", self.said());
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// Waits until it has said `words` on standard error.
    pub fn wait_until_said(&mut self, words: &str) {
        let said = self.said.clone();
        self.wait_until(words, || said.lock().unwrap().contains(words));
    }

    /// Ctrl-C.
    #[cfg(unix)]
    pub fn interrupt(&self) {
        self.signal("-INT");
    }

    /// What the system sends to whom it wants to end, and a queue when the time is up.
    #[cfg(unix)]
    pub fn terminate(&self) {
        self.signal("-TERM");
    }

    /// Holds it in its tracks, so that it is not over before something else is, however fast it is.
    #[cfg(unix)]
    pub fn hold(&self) {
        self.signal("-STOP");
    }

    /// Lets it go on.
    #[cfg(unix)]
    pub fn release(&self) {
        self.signal("-CONT");
    }

    #[cfg(unix)]
    fn signal(&self, signal: &str) {
        assert!(Command::new("kill").args([signal, &self.child.id().to_string()]).status().unwrap().success());
    }

    /// Ends it without a warning.
    pub fn kill(mut self) {
        self.child.kill().unwrap();
    }

    /// Waits for its end, and tells what it said on standard error.
    pub fn end(mut self) -> Finished {
        let code = self.child.wait().unwrap().code().unwrap_or(-1);
        self.listener.take().unwrap().join().unwrap();
        Finished { code, stdout: String::new(), stderr: self.said() }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
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

/// A folder with the structures and references of the repository in their places.
pub fn with_structures() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for place in ["configs/structures", "tests/reference"] {
        std::fs::create_dir_all(folder.path().join(place)).unwrap();
        for entry in std::fs::read_dir(repository().join(place)).unwrap() {
            let file = entry.unwrap();
            std::fs::copy(file.path(), folder.path().join(place).join(file.file_name())).unwrap();
        }
    }
    folder
}

/// Holds the `count` blocks of a document that begin with `$ uplift` against what these commands print in the folder
/// `at`; `UPDATE_DOCS=1` writes it.
pub fn hold_console(at: &Path, document: &str, count: usize) {
    let path = repository().join(document);
    let text = std::fs::read_to_string(&path).unwrap();
    let mut blocks: Vec<String> = text.split("\n```\n").map(str::to_owned).collect();
    let mut held = 0;
    for block in &mut blocks {
        let Some(told) = block.strip_prefix("$ uplift ") else { continue };
        let (command, output) = told.split_once('\n').unwrap_or((told, ""));
        let arguments: Vec<&str> = command.split(' ').collect();
        let printed = uplift(at, &arguments).ok().stdout;
        if std::env::var_os("UPDATE_DOCS").is_none() {
            assert_eq!(printed, format!("{output}\n"), "{document}: {command}");
        }
        *block = format!("$ uplift {command}\n{}", printed.trim_end());
        held += 1;
    }
    assert_eq!(held, count, "{document}");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(path, blocks.join("\n```\n")).unwrap();
    }
}

/// The numbers of an array of a result.
pub fn array(path: &Path, name: &str) -> Vec<f64> {
    LabelledReader::open(path).unwrap().array::<f64>(name).unwrap().values
}

/// Whether two arrays are the same to the bit.
pub fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}
