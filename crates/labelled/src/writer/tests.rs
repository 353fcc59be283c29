use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use super::*;
use crate::LabelledReader;
use uplift_atomic_file::FileError;

fn texts(values: &[&str]) -> Vec<String> {
    values.iter().map(ToString::to_string).collect()
}

/// Every type, dimensions 0 to 3, one array large enough for compressed chunks.
fn write_everything(path: &Path) -> Result<(), LabelledError> {
    let mut writer = LabelledWriter::create(path)?;
    writer.attribute("/", "program", "uplift")?;
    writer.attribute("/", "study_toml", "name = \"Öland\"\n".repeat(10_000))?;
    writer.attribute("/", "seed", u64::MAX)?;
    writer.attribute("/", "offset", -3_i64)?;
    writer.attribute("/", "ratios", vec![0.5, -0.0, f64::INFINITY])?;
    writer.attribute("/", "many", vec![1_i64; 20_000])?;
    writer.attribute("/", "checksums", texts(&["a1", "", "ß"]))?;
    writer.attribute("/", "none", Vec::<f64>::new())?;
    writer.axis_text("site", &texts(&["L'Aquila", "Βόλος"]), "site")?;
    writer.axis("strength", &[0.1, 0.2, 0.3], "1", "uplift strength over weight")?;
    writer.axis::<u32>("sample_size", &[5, u32::MAX], "1", "records in a sample")?;
    writer.axis::<i64>("step", &(-50..50).collect::<Vec<_>>(), "s", "time step")?;
    writer.array("/urs/pgv/u_m", &["site", "strength"], &everything_f64(), "m", "displacement")?;
    writer.attribute("/urs/pgv/u_m", "tail", 0.25)?;
    writer.array::<u8>("/urs/pgv/bound_active", &["strength"], &[0, 1, 255], "1", "flag")?;
    writer.array::<u32>("/ida/impacts", &["sample_size", "site"], &[1, 2, 3, u32::MAX], "1", "impacts")?;
    writer.array::<f32>("/ida/edp_m", &["step", "sample_size", "step_b"], &[], "m", "").unwrap_err();
    writer.axis::<i64>("step_b", &(0..100).collect::<Vec<_>>(), "s", "time step")?;
    writer.array::<f32>("/ida/edp_m", &["step", "sample_size", "step_b"], &large_f32(), "m", "displacement")?;
    writer.array_text("/records/event", &["strength"], &texts(&["Irpinia", "", "中越"]), "event")?;
    writer.array("/total", &[], &[7.5], "1", "a single number")?;
    writer.array("/shallow", &["strength"], &[1.0, 2.0, 3.0], "1", "an array in the root")?;
    writer.finish()
}

fn everything_f64() -> Vec<f64> {
    vec![1.0, f64::NAN, -0.0, f64::NEG_INFINITY, f64::MIN_POSITIVE / 2.0, f64::MAX]
}

fn large_f32() -> Vec<f32> {
    (0..20_000_u16).map(|i| f32::from(i).sqrt()).collect()
}

#[test]
fn everything_comes_back_as_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/deeper/result.h5");
    write_everything(&path).unwrap();
    let reader = LabelledReader::open(&path).unwrap();

    assert_eq!(reader.attribute::<String>("/", "program").unwrap(), "uplift");
    assert_eq!(reader.attribute::<String>("/", "study_toml").unwrap().len(), 160_000);
    assert_eq!(reader.attribute::<u64>("/", "seed").unwrap(), u64::MAX);
    assert_eq!(reader.attribute::<i64>("/", "offset").unwrap(), -3);
    let ratios = reader.attributes::<f64>("/", "ratios").unwrap();
    assert_eq!(ratios.iter().map(|r| r.to_bits()).collect::<Vec<_>>(), [0.5, -0.0, f64::INFINITY].map(f64::to_bits));
    assert_eq!(reader.attributes::<i64>("/", "many").unwrap(), vec![1; 20_000]);
    assert_eq!(reader.attributes::<String>("/", "checksums").unwrap(), texts(&["a1", "", "ß"]));
    assert!(reader.attributes::<f64>("/", "none").unwrap().is_empty());
    assert_eq!(reader.attribute::<f64>("/urs/pgv/u_m", "tail").unwrap(), 0.25);
    assert_eq!(reader.attribute::<String>("/urs/pgv/u_m", "units").unwrap(), "m");
    assert_eq!(reader.attribute::<String>("/urs/pgv/u_m", "long_name").unwrap(), "displacement");

    assert_eq!(reader.axis::<String>("site").unwrap(), texts(&["L'Aquila", "Βόλος"]));
    assert_eq!(reader.axis::<f64>("strength").unwrap(), [0.1, 0.2, 0.3]);
    assert_eq!(reader.axis::<u32>("sample_size").unwrap(), [5, u32::MAX]);
    assert_eq!(reader.axis::<i64>("step").unwrap(), (-50..50).collect::<Vec<_>>());

    let u_m = reader.array::<f64>("/urs/pgv/u_m").unwrap();
    assert_eq!((u_m.dims, u_m.shape), (texts(&["site", "strength"]), vec![2, 3]));
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&u_m.values), bits(&everything_f64()));
    assert_eq!(reader.array::<u8>("/urs/pgv/bound_active").unwrap().values, [0, 1, 255]);
    assert_eq!(reader.array::<u32>("/ida/impacts").unwrap().values, [1, 2, 3, u32::MAX]);
    let edp_m = reader.array::<f32>("/ida/edp_m").unwrap();
    assert_eq!((edp_m.shape, edp_m.values), (vec![100, 2, 100], large_f32()));
    let widened: Vec<f64> = large_f32().into_iter().map(f64::from).collect();
    assert_eq!(reader.array::<f64>("/ida/edp_m").unwrap().values, widened);
    assert_eq!(reader.array::<String>("/records/event").unwrap().values, texts(&["Irpinia", "", "中越"]));
    let total = reader.array::<f64>("/total").unwrap();
    assert_eq!((total.dims.len(), total.shape.len(), total.values), (0, 0, vec![7.5]));

    assert!(reader.exists("/urs/pgv") && reader.exists("/") && !reader.exists("/urs/pga"));
    assert_eq!(reader.children("/").unwrap(), ["axes", "ida", "records", "shallow", "total", "urs"]);
    assert_eq!(reader.children("/urs/pgv").unwrap(), ["bound_active", "u_m"]);
    assert_eq!(reader.children("/axes").unwrap(), ["sample_size", "site", "step", "step_b", "strength"]);
    assert_eq!(files_in(&folder.path().join("new/deeper")), ["result.h5"]);
}

#[test]
fn same_content_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b] = ["a.h5", "another name.h5"].map(|name| folder.path().join(name));
    write_everything(&a).unwrap();
    // HDF5 keeps times in seconds.
    std::thread::sleep(std::time::Duration::from_millis(1_100));
    write_everything(&b).unwrap();
    assert!(fs::read(a).unwrap() == fs::read(b).unwrap());
}

#[test]
fn a_dropped_writer_leaves_the_older_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.h5");
    fs::write(&path, "older").unwrap();
    let mut writer = LabelledWriter::create(&path).unwrap();
    writer.axis("strength", &[0.1], "1", "strength").unwrap();
    assert_eq!(files_in(folder.path()).len(), 2);
    drop(writer);
    assert_eq!(fs::read(&path).unwrap(), b"older");
    assert_eq!(files_in(folder.path()), ["result.h5"]);

    let (mut first, second) = (LabelledWriter::create(&path).unwrap(), LabelledWriter::create(&path).unwrap());
    first.attribute("/", "writer", "first").unwrap();
    second.finish().unwrap();
    first.finish().unwrap();
    assert_eq!(LabelledReader::open(&path).unwrap().attribute::<String>("/", "writer").unwrap(), "first");
}

#[cfg(unix)]
#[test]
fn a_link_is_followed_and_special_places_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("file.h5"), folder.path().join("link.h5"));
    fs::write(&file, "older").unwrap();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    LabelledWriter::create(&link).unwrap().finish().unwrap();
    assert!(link.is_symlink() && LabelledReader::open(&file).is_ok());

    for path in [folder.path(), Path::new("/dev/null"), Path::new("/")] {
        assert!(
            matches!(LabelledWriter::create(path), Err(LabelledError::File(FileError::NotAFile { .. }))),
            "{}",
            path.display()
        );
    }
    let below_a_file = LabelledWriter::create(&file.join("result.h5")).err().unwrap();
    assert!(matches!(below_a_file, LabelledError::File(FileError::Io { .. })), "{below_a_file}");
    let no_folder = LabelledWriter::create(Path::new("/proc/none/result.h5")).err().unwrap().to_string();
    assert!(no_folder.starts_with("/proc/none: cannot create the folder: "), "{no_folder}");
}

#[test]
fn contradictions_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = LabelledWriter::create(&folder.path().join("result.h5")).unwrap();
    writer.axis("strength", &[0.1, 0.2], "1", "strength").unwrap();
    writer.array("/a/b", &["strength"], &[1.0, 2.0], "m", "b").unwrap();
    let mut messages = Vec::new();
    let mut misuse = |result: Result<(), LabelledError>| match result {
        Err(error @ LabelledError::Misuse { .. }) => messages.push(error.to_string()),
        other => panic!("expected a misuse, got {other:?}"),
    };
    misuse(writer.array("/a/c", &["strength"], &[1.0], "m", "c"));
    misuse(writer.array("/a/c", &["poe"], &[1.0], "m", "c"));
    misuse(writer.array("/a/c", &["strength", "strength"], &[1.0; 4], "m", "c"));
    misuse(writer.array("/a/b", &["strength"], &[1.0, 2.0], "m", "b"));
    misuse(writer.array("/a/b/c", &["strength"], &[1.0, 2.0], "m", "c"));
    misuse(writer.array("/a/strength", &["strength"], &[1.0, 2.0], "m", "c"));
    misuse(writer.array_text("/a/c", &["strength"], &texts(&["nul\0", ""]), "c"));
    misuse(writer.axis("strength", &[0.1], "1", "strength"));
    misuse(writer.axis::<f64>("empty", &[], "1", "empty"));
    misuse(writer.attribute("/a/none", "name", 1.0));
    misuse(writer.attribute("/a/b", "CLASS", "x"));
    for path in ["a/c", "/", "", "//a", "/a/", "/a/../c", "/a\0"] {
        misuse(writer.array(path, &[], &[1.0], "m", "c"));
    }
    for name in ["", "Strength", "1st", "a/b", "ä", &"a".repeat(64)] {
        misuse(writer.axis(name, &[0.1], "1", "strength"));
    }
    assert!(messages[0].ends_with(
        "result.h5: cannot write /a/c: 1 values for the shape [2] of [\"strength\"]; this is a bug in the program"
    ));
    assert_eq!(messages.iter().collect::<BTreeSet<_>>().len(), messages.len());
    writer.axis(&"a".repeat(63), &[0.1], "1", "the longest name").unwrap();
    writer.finish().unwrap();
}

#[test]
fn chunks_are_small_and_whole() {
    assert_eq!(chunk_shape(&[105, 301, 75], 8), [1, 301, 75]);
    assert_eq!(chunk_shape(&[105, 301, 4], 8), [27, 301, 4]);
    assert_eq!(chunk_shape(&[3, 1_000_000], 8), [1, 32_768]);
    assert_eq!(chunk_shape(&[9, 9], 1), [9, 9]);
}

/// Runs as a child of the next test, under a limit on the size of files; without one it does nothing.
#[test]
fn disk_full_child() {
    let Some(folder) = std::env::var_os("UPLIFT_TEST_DISK_FULL") else { return };
    let path = Path::new(&folder).join("result.h5");
    let outcome = write_everything(&path).map_or_else(|error| error.to_string(), |()| "written".to_owned());
    fs::write(Path::new(&folder).join("outcome"), outcome).unwrap();
    // The library has survived its failure: a small file can still be written and read.
    let small = Path::new(&folder).join("small.h5");
    if LabelledWriter::create(&small).and_then(LabelledWriter::finish).is_ok() {
        LabelledReader::open(&small).unwrap();
        fs::remove_file(small).unwrap();
    }
}

/// A limit on the size of files (the system's reason: "File too large") stands for a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_is_an_error_wherever_it_strikes() {
    let folder = tempfile::tempdir().unwrap();
    let size = {
        let path = folder.path().join("result.h5");
        write_everything(&path).unwrap();
        usize::try_from(fs::metadata(path).unwrap().len()).unwrap()
    };
    let blocks = size.div_ceil(512);
    let (mut failed, mut written) = (0, 0);
    for limit in (1..4).chain((4..blocks + 40).step_by(29)).chain(blocks - 3..blocks + 3) {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("result.h5"), "older").unwrap();
        let script = format!("trap '' XFSZ; ulimit -f {limit}; exec \"$0\" \"$@\"");
        let child = Command::new("sh")
            .args(["-c", &script])
            .arg(std::env::current_exe().unwrap())
            .args(["--exact", "writer::tests::disk_full_child", "--nocapture"])
            .env("UPLIFT_TEST_DISK_FULL", folder.path())
            .output()
            .unwrap();
        let stderr = String::from_utf8_lossy(&child.stderr);
        assert!(!stderr.contains("HDF5") && !stderr.contains("panicked"), "limit {limit}: {stderr}");
        assert!(child.status.success(), "limit {limit}: {:?} {stderr}", child.status);
        let outcome = fs::read_to_string(folder.path().join("outcome")).unwrap();
        assert_eq!(files_in(folder.path()), ["outcome", "result.h5"], "limit {limit}: {outcome}");
        if outcome == "written" {
            written += 1;
            assert!(limit * 512 + 511 >= size, "limit {limit} of {blocks}");
        } else {
            failed += 1;
            assert!(outcome.contains("result.h5: cannot ") && outcome.contains(": File too large"), "{outcome}");
        }
    }
    assert!(failed > 10 && written > 0, "{failed} failed, {written} written");
}

fn files_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn rows_one_after_the_other_are_the_array_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let rows = 2000_u32;
    let values: Vec<f64> = (0..rows * 3 * 41).map(|i| f64::from(i).sin()).collect();
    let flags: Vec<u8> = (0_u8..7).cycle().take(2000).collect();
    let write = |name: &str, at_once: Option<&[usize]>| {
        let path = folder.path().join(name);
        let mut writer = LabelledWriter::create(&path).unwrap();
        writer.axis::<u32>("site", &(0..rows).collect::<Vec<_>>(), "1", "site").unwrap();
        writer.axis::<u32>("poe", &[0, 1, 2], "1", "probability").unwrap();
        writer.axis::<u32>("strength", &(0..41).collect::<Vec<_>>(), "1", "strength").unwrap();
        let dims = ["site", "poe", "strength"];
        let Some(parts) = at_once else {
            writer.array("/urs/u_m", &dims, &values, "m", "displacement").unwrap();
            writer.array::<u8>("/flag", &["site"], &flags, "1", "flag").unwrap();
            writer.finish().unwrap();
            return fs::read(path).unwrap();
        };
        let mut array = writer.grow::<f64>("/urs/u_m", &dims, "m", "displacement").unwrap();
        let mut begin = 0;
        for rows in parts {
            let end = begin + rows * 3 * 41;
            writer.append(&mut array, &values[begin..end]).unwrap();
            begin = end;
        }
        writer.complete(array).unwrap();
        let mut array = writer.grow::<u8>("/flag", &["site"], "1", "flag").unwrap();
        flags.chunks(300).for_each(|some| writer.append(&mut array, some).unwrap());
        writer.complete(array).unwrap();
        writer.finish().unwrap();
        LabelledReader::open(&path).unwrap().array::<f64>("/urs/u_m").unwrap();
        fs::read(path).unwrap()
    };
    let whole = write("whole.h5", None);
    assert!(whole == write("pieces.h5", Some(&[1, 699, 0, 1000, 300])), "other bytes");
    assert!(whole == write("rows.h5", Some(&[1; 2000])), "other bytes");
}

#[test]
fn rows_too_many_or_too_few_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = LabelledWriter::create(&folder.path().join("a.h5")).unwrap();
    writer.axis::<u32>("site", &[1, 2, 3], "1", "site").unwrap();
    let mut array = writer.grow::<f64>("/u_m", &["site"], "m", "displacement").unwrap();
    writer.append(&mut array, &[1.0, 2.0]).unwrap();
    assert!(matches!(writer.complete(array), Err(LabelledError::Misuse { .. })));
    let mut array = writer.grow::<f64>("/v_m", &["site"], "m", "displacement").unwrap();
    assert!(matches!(writer.append(&mut array, &[0.0; 4]), Err(LabelledError::Misuse { .. })));
}
