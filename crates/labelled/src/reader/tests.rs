use super::*;
use crate::LabelledWriter;
use crate::seal::seal;
use uplift_atomic_file::FileError;

fn small_file(folder: &Path) -> PathBuf {
    let path = folder.join("result.h5");
    let mut writer = LabelledWriter::create(&path).unwrap();
    writer.axis("strength", &[0.1, 0.2], "1", "strength").unwrap();
    writer.array("/urs/u_m", &["strength"], &[1.0, 2.0], "m", "displacement").unwrap();
    writer.attribute("/", "list", vec![1.0, 2.0]).unwrap();
    writer.attribute("/", "program", "uplift").unwrap();
    writer.finish().unwrap();
    path
}

#[test]
fn what_is_no_result_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let open = |path: &Path| LabelledReader::open(path).err().unwrap();
    let message = open(&folder.path().join("none.h5")).to_string();
    assert!(message.ends_with("none.h5: cannot open the file: there is no such file or folder"), "{message}");
    assert!(matches!(open(folder.path()), LabelledError::File(FileError::NotAFile { found: "a folder", .. })));
    for text in ["", "station,pga_g\nA,0.1\n", "\u{89}HDF\r\n\u{1a}\n"] {
        let path = folder.path().join("text.h5");
        fs::write(&path, text).unwrap();
        assert!(matches!(open(&path), LabelledError::NotHdf5 { bytes, .. } if bytes == text.len() as u64));
    }
}

#[test]
fn a_column_is_read_without_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.h5");
    let mut writer = LabelledWriter::create(&path).unwrap();
    writer.axis("site", &[1.0, 2.0, 3.0], "1", "site").unwrap();
    writer.axis("strength", &[0.1, 0.2], "1", "strength").unwrap();
    writer.array("/u_m", &["site", "strength"], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "m", "displacement").unwrap();
    writer.finish().unwrap();
    let reader = LabelledReader::open(&path).unwrap();
    assert_eq!(reader.along_first_axis("/u_m", &[1]).unwrap(), [2.0, 4.0, 6.0]);
    for other in [&[2][..], &[], &[0, 0]] {
        assert!(matches!(reader.along_first_axis("/u_m", other), Err(LabelledError::Hdf5 { .. })), "{other:?}");
    }
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let whole = fs::read(small_file(folder.path())).unwrap();
    let path = folder.path().join("cut.h5");
    // behind the end of the arrays stands the checksum of them all, which HDF5 does not look at
    let end = whole.windows(8).position(|word| word == b"\nuplift:").unwrap();
    for length in [end, whole.len() - 1] {
        fs::write(&path, &whole[..length]).unwrap();
        assert_eq!(crate::verify(&path).unwrap().seal, crate::Seal::Missing);
        assert!(matches!(LabelledReader::open(&path), Err(LabelledError::Unsealed { .. })));
    }
    for length in (0..end).step_by(37).chain([end - 1]) {
        fs::write(&path, &whole[..length]).unwrap();
        let error = LabelledReader::open(&path).err().unwrap();
        let refused = match length {
            0..8 => matches!(error, LabelledError::NotHdf5 { .. }),
            _ => matches!(error, LabelledError::Truncated { bytes, .. } if bytes == length as u64),
        };
        assert!(refused, "{length} bytes: {error}");
    }
}

#[test]
fn what_is_not_there_or_not_so_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let reader = LabelledReader::open(&small_file(folder.path())).unwrap();
    let shown = |error: LabelledError| {
        let message = error.to_string();
        message.split_once("result.h5: ").unwrap().1.to_owned()
    };
    assert_eq!(shown(reader.array::<f64>("/urs/v_m").unwrap_err()), "has no /urs/v_m");
    assert_eq!(shown(reader.array::<f64>("/none/u_m").unwrap_err()), "has no /none/u_m");
    assert_eq!(shown(reader.array::<f64>("").unwrap_err()), "has no ");
    assert_eq!(shown(reader.array::<f64>("a\0b").unwrap_err()), "has no a\0b");
    assert_eq!(shown(reader.axis::<f64>("poe").unwrap_err()), "has no /axes/poe");
    assert_eq!(shown(reader.children("/none").unwrap_err()), "has no /none");
    assert_eq!(shown(reader.children("/urs/u_m").unwrap_err()), "/urs/u_m is an array, but a group is needed");
    assert_eq!(shown(reader.array::<f64>("/urs").unwrap_err()), "/urs is a group, but an array is needed");
    assert_eq!(shown(reader.array::<u8>("/urs/u_m").unwrap_err()), "/urs/u_m is of type float64, but uint8 is needed");
    assert_eq!(shown(reader.array::<String>("/urs/u_m").unwrap_err()), "/urs/u_m is no text, but text is needed");
    assert_eq!(shown(reader.attribute::<f64>("/", "seed").unwrap_err()), "has no attribute \"seed\" of /");
    assert_eq!(
        shown(reader.attribute::<f64>("/", "list").unwrap_err()),
        "attribute \"list\" of / is a list of 2 numbers, but one number is needed"
    );
    assert!(matches!(reader.attribute::<f64>("/", "program"), Err(LabelledError::WrongType { .. })));
    assert!(matches!(reader.attribute::<String>("/", "list"), Err(LabelledError::WrongType { .. })));
    assert!(matches!(reader.attribute::<i64>("/", "list"), Err(LabelledError::WrongType { .. })));
}

#[test]
fn what_other_programs_write_is_read_as_far_as_it_goes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("foreign.h5");
    let file = File::create(&path).unwrap();
    file.new_dataset::<f64>().shape([2, 3]).create("unnamed").unwrap();
    // Eight exabytes on paper, nothing on the disk.
    file.new_dataset::<f64>().chunk((1, 1000)).shape([1 << 30, 1 << 30]).create("huge").unwrap();
    let ascii = hdf5::types::FixedAscii::<8>::from_ascii("fixed").unwrap();
    file.new_attr::<hdf5::types::FixedAscii<8>>().create("text").unwrap().write_scalar(&ascii).unwrap();
    file.close().unwrap();
    assert!(matches!(LabelledReader::open(&path), Err(LabelledError::Unsealed { .. })));

    // with a seal, as if it were ours
    let bytes = fs::metadata(&path).unwrap().len();
    let mut file = fs::File::options().read(true).write(true).open(&path).unwrap();
    seal(&mut file, [("/huge".to_owned(), vec![(bytes, 0)])].into()).unwrap();
    let reader = LabelledReader::open(&path).unwrap();
    assert_eq!(reader.attribute::<String>("/", "text").unwrap(), "fixed");
    assert!(matches!(reader.array::<f64>("/unnamed"), Err(LabelledError::WrongType { .. })));
    let huge = reader.array::<f64>("/huge").unwrap_err().to_string();
    assert!(huge.contains("does not fit into a file of"), "{huge}");
}

#[cfg(unix)]
#[test]
fn a_file_open_elsewhere_is_reported_as_locked() {
    let folder = tempfile::tempdir().unwrap();
    let path = small_file(folder.path());
    let elsewhere = fs::File::open(&path).unwrap();
    elsewhere.lock().unwrap();
    assert!(matches!(LabelledReader::open(&path), Err(LabelledError::Locked { .. })));
    elsewhere.unlock().unwrap();
    LabelledReader::open(&path).unwrap();
}
