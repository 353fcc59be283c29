//! Damaged result files: what reads one answers with the sound numbers or with an error, and never hangs.
//!
//! The trials marked `torture` are many; `make torture` runs them. `UPLIFT_PROGRAM` names another build to try.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use sha2::{Digest, Sha256};

use crate::common::{SMALL_STUDY, SmallStudy, command, repository};

/// Longer than any of these commands takes on a small result, however busy the machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// Each command that reads the result `r.h5`, with the file that it leaves, if what it prints is not all.
const READERS: [(&str, &str); 13] = [
    ("table r.h5 --json", ""),
    ("table r.h5", ""),
    ("status r.h5", ""),
    ("export r.h5 --csv -o out.csv", "out.csv"),
    ("export r.h5 --json -o out.json", "out.json"),
    ("export r.h5 --mat -o out.mat", "out.mat"),
    ("report r.h5 -o out.html", "out.html"),
    ("design pier.toml --urs r.h5 --site Here --json", ""),
    ("overturning block.toml --urs r.h5 --site Here --json", ""),
    ("plot r.h5 -o figures", "figures/urs-pgv.svg"),
    ("influence r.h5 --json", ""),
    ("measures r.h5 --json", ""),
    ("bootstrap r.h5 --replicates 20 --json", ""),
];

/// Bytes that tell of time and place and not of numbers are blotted out.
fn told(folder: &Path, reader: (&str, &str)) -> (i32, String) {
    let (arguments, file) = reader;
    let done = crate::common::uplift(folder, &arguments.split(' ').collect::<Vec<_>>());
    let mut told = done.stdout;
    if !file.is_empty() && done.code == 0 {
        told += &String::from_utf8_lossy(&std::fs::read(folder.join(file)).unwrap());
    }
    (done.code, without_times(&told))
}

/// Every `2026-01-31T12:00:00Z` as `T`.
fn without_times(text: &str) -> String {
    let is_time = |word: &[u8]| {
        let shape = b"0000-00-00T00:00:00Z";
        word.iter().zip(shape).all(|(byte, like)| if *like == b'0' { byte.is_ascii_digit() } else { byte == like })
    };
    let bytes = text.as_bytes();
    let (mut kept, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        if bytes.len() - at >= 20 && is_time(&bytes[at..at + 20]) {
            kept.push(b'T');
            at += 20;
        } else {
            kept.push(bytes[at]);
            at += 1;
        }
    }
    String::from_utf8(kept).unwrap()
}

/// Numbers that look like chance and are the same every time.
struct Chance(u64);

impl Chance {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % bound
    }
}

/// A study with its result `r.h5`, which has a few arrays in chunks, and the structures beside it.
fn study_with_result() -> (SmallStudy, Vec<u8>) {
    let study = SmallStudy::with(&SMALL_STUDY.replace("\"0.1:0.1:0.8\"", "\"0.06:0.001:0.8\""));
    for name in ["pier.toml", "block.toml"] {
        std::fs::copy(repository().join("configs/structures").join(name), study.path().join(name)).unwrap();
    }
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let bytes = std::fs::read(study.path().join("r.h5")).unwrap();
    (study, bytes)
}

/// Flips one bit in each of `flips` copies and gives them to every reader. What is silent: exit code 0, and other
/// numbers than those of the sound file.
fn flip_bits(flips: usize) {
    let (study, sound) = study_with_result();
    let path = study.path().join("r.h5");
    let mut expected = BTreeMap::new();
    for reader in READERS {
        std::fs::write(&path, &sound).unwrap();
        let (code, told) = told(study.path(), reader);
        assert_eq!(code, 0, "{reader:?}: {told}");
        expected.insert(reader.0, told);
    }
    let mut chance = Chance(16);
    let (mut silent, mut refused, mut passed) = (Vec::new(), 0, 0);
    for _ in 0..flips {
        let (at, bit) = (chance.below(sound.len()), chance.below(8));
        let mut damaged = sound.clone();
        damaged[at] ^= 1 << bit;
        for reader in READERS {
            std::fs::write(&path, &damaged).unwrap();
            match told(study.path(), reader) {
                (0, told) if told == expected[reader.0] => passed += 1,
                (0, _) => silent.push(format!("{} with byte {at} flipped", reader.0)),
                (4, _) => refused += 1,
                (code, told) => panic!("{} with byte {at} flipped ends with {code}: {told}", reader.0),
            }
        }
    }
    println!("{flips} flips: {refused} refused, {passed} sound where read, {} silent", silent.len());
    assert!(silent.is_empty(), "{silent:#?}");
    assert!(refused > 2 * flips, "hardly anything is refused: {refused}");
}

#[test]
#[ignore = "long: make test-long"]
fn no_reader_is_deceived_by_a_flipped_bit() {
    flip_bits(10);
}

#[test]
#[ignore = "minutes: make torture"]
fn torture_flipped_bits() {
    flip_bits(1400);
}

/// Whether the program comes back at all; one that does not is ended.
fn returns(folder: &Path, arguments: &[&str]) -> Option<i32> {
    let mut child = command(folder).args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begin = Instant::now();
    while begin.elapsed() < PATIENCE {
        if let Some(status) = child.try_wait().unwrap() {
            return Some(status.code().unwrap_or(-1));
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    None
}

/// Zeroes a block in each of `blocks` copies and has them verified and read.
fn zero_blocks(blocks: usize) {
    let (study, sound) = study_with_result();
    let path = study.path().join("r.h5");
    let mut chance = Chance(17);
    let mut hung = Vec::new();
    let mut tried = 0;
    while tried < blocks {
        let length = 8 << chance.below(8);
        // the structure lies at the beginning and between the arrays
        let at = if tried % 2 == 0 { chance.below(sound.len().min(20_000)) } else { chance.below(sound.len()) };
        let mut damaged = sound.clone();
        let end = (at + length).min(damaged.len());
        damaged[at..end].fill(0);
        if damaged == sound {
            continue;
        }
        tried += 1;
        std::fs::write(&path, &damaged).unwrap();
        for arguments in [["verify", "r.h5"].as_slice(), &["table", "r.h5"]] {
            match returns(study.path(), arguments) {
                None => hung.push(format!("{} with {length} bytes from {at} zeroed", arguments[0])),
                Some(code) => assert!(
                    code == 4 || (code == 0 && arguments[0] == "table"),
                    "{} with {length} bytes from {at} zeroed ends with {code}",
                    arguments[0]
                ),
            }
        }
    }
    println!("{blocks} zeroed blocks: {} hung", hung.len());
    assert!(hung.is_empty(), "{hung:#?}");
}

#[test]
fn nothing_hangs_on_a_zeroed_block() {
    zero_blocks(24);
}

#[test]
#[ignore = "minutes: make torture"]
fn torture_zeroed_blocks() {
    zero_blocks(1000);
}

/// A run and a bootstrap on disks that are full after ever more blocks: a limit on the size of files stands in for it.
#[cfg(unix)]
#[test]
#[ignore = "minutes: make torture"]
fn torture_full_disks() {
    let (study, sound) = study_with_result();
    let path = study.path().join("r.h5");
    let program = command(study.path()).get_program().to_owned();
    let (mut failed, mut written) = (0, 0);
    for blocks in 1..=380 {
        std::fs::write(&path, &sound).unwrap();
        let arguments = if blocks % 2 == 0 {
            "bootstrap r.h5 --replicates 20"
        } else {
            "run study.toml -o r.h5 --force --set oscillator.restitution=0.9"
        };
        // 4 or 8 kB a step, as the shell counts
        let limit = format!("trap '' XFSZ; ulimit -f {}; exec \"$0\" $1", 8 * blocks);
        let mut shell = std::process::Command::new("sh");
        shell
            .args(["-c", &limit])
            .arg(&program)
            .arg(arguments)
            .current_dir(study.path())
            .env("UPLIFT_CACHE", "")
            .env("UPLIFT_LIMITS", "warn");
        let done = shell.output().unwrap();
        let said = String::from_utf8_lossy(&done.stderr);
        let verified = study.uplift(&["verify", "r.h5"]);
        assert_eq!(verified.code, 0, "{blocks} blocks: {said}\n{}", verified.stderr);
        match done.status.code() {
            Some(0) => written += 1,
            Some(4) => {
                failed += 1;
                // or what is new is in the result, and only its table found no room
                let is_kept = std::fs::read(&path).unwrap() == sound || said.contains(".csv: cannot write");
                assert!(is_kept, "{blocks} blocks: {said}");
            }
            code => panic!("{blocks} blocks: {code:?} {said}"),
        }
    }
    println!("380 full disks: {failed} failed and kept a whole result, {written} had room");
    assert!(failed > 50 && written > 50, "{failed} failed, {written} had room");
}

/// A disk with room for the result but not for its table: the result is there, and what writes the table is said and
/// computes nothing anew.
#[cfg(unix)]
#[test]
fn a_result_without_room_for_its_tables_is_whole() {
    let (study, _) = study_with_result();
    let size = |name: &str| std::fs::metadata(study.path().join(name)).unwrap().len();
    let [result, table] = ["r.h5", "r.urs.csv"].map(size);
    assert!(table > result + 8192, "{table} and {result} bytes");
    // between the two, as the shell counts
    let blocks = u64::midpoint(table, result) / 512;
    let limit = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" run study.toml -o r.h5");
    for name in ["r.h5", "r.urs.csv"] {
        std::fs::remove_file(study.path().join(name)).unwrap();
    }
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", &limit]).arg(command(study.path()).get_program()).current_dir(study.path());
    let done = shell.env("UPLIFT_CACHE", "").env("UPLIFT_LIMITS", "warn").output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(4), "{said}");
    assert!(said.contains("r.h5 is complete") && said.contains("r.urs.csv: cannot write"), "{said}");
    study.uplift(&["verify", "r.h5"]).ok();

    let again = study.uplift(&["run", "study.toml", "-o", "r.h5", "--again"]).ok();
    assert!(again.stderr.contains("26,748 of 26,748 analyses resumed"), "{}", again.stderr);
    assert!(!study.path().join("r.part.h5").exists() && study.path().join("r.urs.csv").exists());
}

/// A file may bear a seal and yet be one from which HDF5 does not return (docs/testing.md): `verify` gives up in time.
#[test]
#[ignore = "a minute: make torture"]
fn torture_a_seal_over_what_hdf5_cannot_read() {
    let (study, mut bytes) = study_with_result();
    // the seal of an earlier version, over a heap of texts whose first object is none, and of no length
    let content = bytes.windows(8).position(|word| word == b"\nuplift:").unwrap();
    bytes.truncate(content);
    let heap = bytes.windows(4).position(|word| word == b"GCOL").unwrap();
    bytes[heap + 16..heap + 32].fill(0);
    let seal = uplift_labelled::hexadecimal(&Sha256::digest(&bytes));
    bytes.extend(format!("\nuplift: SHA-256 of everything before this line: {seal}\n").into_bytes());
    std::fs::write(study.path().join("r.h5"), &bytes).unwrap();
    study.uplift(&["verify", "r.h5"]).fails(4, &["r.h5 is damaged: HDF5 has not read its arrays within 60 s"]);
}

/// The checkpoint of a bootstrap that was interrupted, damaged in each of `flips` copies: the bands that are made of it
/// are those of an undisturbed bootstrap.
#[cfg(unix)]
fn flip_checkpoint(flips: usize) {
    const CALL: [&str; 6] = ["bootstrap", "r.h5", "--replicates", "4000", "--threads", "1"];
    let study = SmallStudy::with(&SMALL_STUDY.replace("\"0.1:0.1:0.8\"", "\"0.06:0.005:0.8\""));
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let result = study.path().join("r.h5");
    let checkpoint = study.path().join("r.bootstrap.part.h5");
    let bare = std::fs::read(&result).unwrap();
    let bands = |path: &Path| {
        let reader = uplift_labelled::LabelledReader::open(path).unwrap();
        let names = reader.children("/bootstrap/pgv").unwrap();
        let bits = |name: &String| -> Vec<u64> {
            let array = reader.array::<f64>(&format!("/bootstrap/pgv/{name}")).unwrap();
            array.values.iter().map(|value| value.to_bits()).collect()
        };
        names.iter().filter(|name| name.ends_with("_m")).map(bits).collect::<Vec<_>>()
    };
    study.uplift(&CALL).ok();
    let expected = bands(&result);
    assert!(!expected.is_empty());
    let mut kept = None;
    for pause in 0..100 {
        std::fs::write(&result, &bare).unwrap();
        let run = study.start(&CALL);
        std::thread::sleep(Duration::from_millis(50 * pause));
        run.interrupt();
        let said = run.end().stderr;
        if said.contains("interrupted: ") && !said.contains("interrupted: 0 of") {
            kept = Some(std::fs::read(&checkpoint).unwrap());
            break;
        }
    }
    let kept = kept.unwrap();
    // undamaged it is gone on from
    assert!(study.uplift(&CALL).ok().stderr.contains("strengths from"));
    let mut chance = Chance(18);
    let (mut wrong, mut used) = (Vec::new(), 0);
    for _ in 0..flips {
        let (at, bit) = (chance.below(kept.len()), chance.below(8));
        let mut damaged = kept.clone();
        damaged[at] ^= 1 << bit;
        std::fs::write(&result, &bare).unwrap();
        std::fs::write(&checkpoint, damaged).unwrap();
        let done = study.uplift(&CALL).ok();
        used += usize::from(done.stderr.contains("strengths from"));
        if bands(&result) != expected {
            wrong.push(at);
        }
    }
    println!("{flips} flips of the checkpoint: {used} gone on from, {} sealed", wrong.len());
    assert!(wrong.is_empty(), "bytes {wrong:?}");
}

#[cfg(unix)]
#[test]
#[ignore = "long: make test-long"]
fn no_damage_of_a_checkpoint_is_sealed() {
    flip_checkpoint(4);
}

#[cfg(unix)]
#[test]
#[ignore = "minutes: make torture"]
fn torture_bootstrap_checkpoint() {
    flip_checkpoint(120);
}
