use std::fs;
use std::path::PathBuf;

use super::*;
use crate::{LabelledError, LabelledReader, LabelledWriter, verify};

/// A file with an array in chunks, one in a piece, texts and attributes.
fn file(folder: &Path) -> PathBuf {
    let path = folder.join("result.h5");
    let values: Vec<f64> = (0..40_000_u64).map(|at| (at.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 11) as f64).collect();
    let mut writer = LabelledWriter::create(&path).unwrap();
    writer.attribute("/", "program", "uplift").unwrap();
    writer.axis("level", &values[..40_000], "cm/s", "level").unwrap();
    writer.axis_text("site", &["Athens".to_owned(), "Perugia".to_owned()], "site").unwrap();
    writer.array("/ida/edp_m", &["level"], &values, "m", "demand").unwrap();
    writer.array("/urs/u_m", &["site"], &[0.5, 0.25], "m", "displacement").unwrap();
    writer.finish().unwrap();
    path
}

fn read_all(path: &Path) -> Result<(), LabelledError> {
    let reader = LabelledReader::open(path)?;
    reader.attribute::<String>("/", "program")?;
    reader.axis::<f64>("level")?;
    reader.axis::<String>("site")?;
    reader.array::<f64>("/ida/edp_m")?;
    reader.array::<f64>("/urs/u_m")?;
    Ok(())
}

fn lines(path: &Path) -> Lines {
    Lines::read(&mut File::open(path).unwrap()).unwrap().unwrap()
}

#[test]
fn what_lies_in_chunks_has_a_checksum_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path());
    let index = lines(&path).index.unwrap();
    assert_eq!(index.arrays.keys().collect::<Vec<_>>(), ["/axes/level", "/ida/edp_m"]);
    let bytes: u64 = index.arrays.values().flat_map(|part| &part.extents).map(|(_, length)| length).sum();
    assert!(bytes > 200_000, "{bytes} bytes lie in chunks");
    // so that little is read when a file is opened, however large its arrays
    let structure = index.structure(lines(&path).content).unwrap();
    let structure: u64 = structure.iter().map(|(_, length)| length).sum();
    assert_eq!(structure + bytes, lines(&path).content);
    assert!(structure < 40_000, "{structure} bytes are read to open the file");
    read_all(&path).unwrap();
    assert!(verify(&path).unwrap().is_sound());
}

#[test]
fn no_changed_byte_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path());
    let whole = fs::read(&path).unwrap();
    let content = usize::try_from(lines(&path).content).unwrap();
    // every byte of the lines behind the end, and bytes all over the file
    for at in (0..content).step_by(911).chain(content..whole.len()) {
        let mut damaged = whole.clone();
        damaged[at] ^= 0x08;
        fs::write(&path, &damaged).unwrap();
        assert_ne!(verify(&path).map_or(Seal::Missing, |verdict| verdict.seal), Seal::Whole, "byte {at}");
        let read = read_all(&path);
        // a last line that says something else of the same parts is seen by `verify` alone
        if at < content + INDEX.len() {
            assert!(read.is_err(), "byte {at}");
        }
        let structure = |error: &LabelledError| matches!(error, LabelledError::Damaged { object: None, .. });
        assert!(read.as_ref().is_ok_and(|()| at > content) || read.is_err(), "byte {at}");
        if let Err(error) = read
            && !structure(&error)
            && at > 8
        {
            let named = matches!(&error, LabelledError::Damaged { object: Some(_), .. });
            assert!(named || matches!(error, LabelledError::Unsealed { .. }), "byte {at}: {error}");
        }
    }
}

#[test]
fn damage_is_located_without_hdf5() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path());
    let whole = fs::read(&path).unwrap();
    let index = lines(&path).index.unwrap();
    let place = usize::try_from(index.arrays["/ida/edp_m"].extents[0].0).unwrap() + 5;
    for (at, expected) in [
        (place, "/ida/edp_m: the values have changed"),
        (place.min(16), "groups, attributes or small arrays have changed"),
    ] {
        let mut damaged = whole.clone();
        damaged[at] ^= 1;
        fs::write(&path, &damaged).unwrap();
        let verdict = verify(&path).unwrap();
        assert_eq!((verdict.seal, verdict.damaged), (Seal::Broken, vec![expected.to_owned()]));
    }
    // an array that is sound can be read beside one that is not
    let mut damaged = whole;
    damaged[place] ^= 1;
    fs::write(&path, &damaged).unwrap();
    let reader = LabelledReader::open(&path).unwrap();
    reader.array::<f64>("/urs/u_m").unwrap();
    let error = reader.array::<f64>("/ida/edp_m").unwrap_err();
    assert!(matches!(&error, LabelledError::Damaged { object: Some(object), .. } if object == "/ida/edp_m"), "{error}");
    assert!(error.to_string().contains("/ida/edp_m has changed since it was written"), "{error}");
}

#[test]
fn files_of_an_earlier_version_are_read_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path());
    let content = usize::try_from(lines(&path).content).unwrap();
    let mut bytes = fs::read(&path).unwrap();
    bytes.truncate(content);
    let line = [BEFORE, hexadecimal(&Sha256::digest(&bytes)).as_bytes(), b"\n"].concat();
    bytes.extend(line);
    fs::write(&path, &bytes).unwrap();
    read_all(&path).unwrap();
    assert!(verify(&path).unwrap().is_sound());
    for at in (0..bytes.len()).step_by(1009) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x10;
        fs::write(&path, &damaged).unwrap();
        assert!(LabelledReader::open(&path).is_err(), "byte {at}");
    }
}

#[test]
fn overlapping_parts_are_no_seal() {
    let part = |extents: &[Extent]| Part { sha256: String::new(), extents: extents.to_vec() };
    let structure = |parts: &[&[Extent]]| {
        let arrays = parts.iter().enumerate().map(|(at, extents)| (at.to_string(), part(extents))).collect();
        Index { structure: String::new(), arrays }.structure(100)
    };
    assert_eq!(structure(&[&[(10, 20)], &[(50, 50)]]), Some(vec![(0, 10), (30, 20), (100, 0)]));
    assert_eq!(structure(&[&[(10, 20)], &[(29, 2)]]), None);
    assert_eq!(structure(&[&[(90, 11)]]), None);
    assert_eq!(structure(&[&[(u64::MAX, 2)]]), None);
    assert_eq!(joined(vec![(8, 2), (0, 4), (4, 4), (20, 1)]), [(0, 10), (20, 1)]);
}
