//! `uplift records import download.zip`: PEER's archive as it is downloaded.

use std::io::{Cursor, Write};
use std::path::Path;

use walkdir::WalkDir;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use crate::common::{Finished, uplift};
use crate::records::{download, rows};

/// An archive of these files.
fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        writer.start_file(*name, SimpleFileOptions::default()).unwrap();
        writer.write_all(content).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// The files below a folder, by their paths in it.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = WalkDir::new(folder).sort_by_file_name().into_iter().map(Result::unwrap);
    entries
        .filter(|entry| entry.file_type().is_file())
        .map(|entry| {
            let name = entry.path().strip_prefix(folder).unwrap().to_string_lossy().replace('\\', "/");
            (name, std::fs::read(entry.path()).unwrap())
        })
        .collect()
}

/// The download of the tests of folders as an archive, with what else such archives hold.
fn peer_archive() -> Vec<u8> {
    let folder = download();
    let mut all = files(folder.path());
    all.push(("__MACOSX/._RSN12_EVENT_STA360.AT2".to_owned(), vec![0, 5, 22, 7]));
    all.push(("readme.pdf".to_owned(), b"%PDF".to_vec()));
    let borrowed: Vec<(&str, &[u8])> = all.iter().map(|(name, content)| (name.as_str(), content.as_slice())).collect();
    archive(&borrowed)
}

fn import(at: &Path, archive: &str) -> Finished {
    uplift(at, &["records", "import", archive, "-o", "set/manifest.csv", "--force"])
}

#[test]
fn an_archive_gives_the_manifest_of_its_folder() {
    let place = tempfile::tempdir().unwrap();
    let at = place.path();
    std::fs::create_dir(at.join("set")).unwrap();
    std::fs::write(at.join("PEER download.zip"), peer_archive()).unwrap();
    let done = import(at, "PEER download.zip").ok();
    assert!(done.stdout.contains("2 pairs"), "{}", done.stdout);
    for remark in ["1 of 2 records of the search have no pair", "RSN14_EVENT_STC000.AT2: its other horizontal"] {
        assert!(done.stderr.contains(remark), "{remark:?} is not in:\n{}", done.stderr);
    }
    // the folder of the same files has the same manifest but for the places of the files
    let folder = download();
    uplift(folder.path(), &["records", "import", ".", "-o", "set.csv"]).ok();
    let mut expected = rows(&folder.path().join("set.csv"));
    for row in &mut expected {
        // the second pair has no vertical component
        for column in ["file_h1", "file_h2", "file_v"] {
            if !row[column].is_empty() {
                row.insert(column.to_owned(), format!("PEER download/{}", row[column]));
            }
        }
    }
    assert_eq!(rows(&at.join("set/manifest.csv")), expected);
    let unpacked = files(&at.join("set/PEER download"));
    assert!(
        unpacked.iter().all(|(name, _)| !name.contains("VT2") && !name.contains("MACOSX") && !name.contains("pdf"))
    );
    // a second time finds them there, and a study reads them
    import(at, "PEER download.zip").ok();
    uplift(at, &["records", "show", "set/manifest.csv", "RSN12_EVENT_STA"]).ok();
    // what is there and is not of the archive is not imported with it, and not replaced
    std::fs::write(at.join("set/PEER download/RSN12_EVENT_STA360.AT2"), "mine").unwrap();
    import(at, "PEER download.zip").fails(2, &["RSN12_EVENT_STA360.AT2 is another file", "import that folder"]);
    assert_eq!(std::fs::read(at.join("set/PEER download/RSN12_EVENT_STA360.AT2")).unwrap(), b"mine");
}

/// `bytes` with every `from` replaced by a `to` of the same length.
fn replaced(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let mut bytes = bytes.to_vec();
    let places: Vec<usize> = (0..bytes.len() - from.len()).filter(|&at| bytes[at..].starts_with(from)).collect();
    assert!(!places.is_empty());
    for at in places {
        bytes[at..at + to.len()].copy_from_slice(to);
    }
    bytes
}

#[test]
fn archives_that_are_refused_leave_nothing_behind() {
    let place = tempfile::tempdir().unwrap();
    let at = place.path();
    std::fs::create_dir(at.join("set")).unwrap();
    let text: Vec<u8> =
        (0..4000_u32).flat_map(|i| format!("{}\n", i.wrapping_mul(2_654_435_761) % 1000).into_bytes()).collect();
    let one = archive(&[("xx/RSN1_A.AT2", &text)]);
    // the flag of encryption in both heads of the file
    let mut encrypted = one.clone();
    for (mark, flags) in [(b"PK\x03\x04", 6), (b"PK\x01\x02", 8)] {
        let head = (0..encrypted.len() - 4).find(|&at| encrypted[at..].starts_with(mark)).unwrap();
        encrypted[head + flags] |= 1;
    }
    let mut damaged = one.clone();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 0xff;
    let bomb = archive(&[("RSN1_A.AT2", &vec![b'0'; 65 << 20])]);
    assert!(bomb.len() < 1 << 20);
    for (bytes, words) in [
        (replaced(&one, b"xx/RSN1", b"../RSN1"), &["\"../RSN1_A.AT2\"", "outside the folder"][..]),
        (encrypted, &["RSN1_A.AT2", "is encrypted", "with its password"]),
        (damaged, &["RSN1_A.AT2", "damaged or not complete"]),
        (one[..one.len() - 30].to_vec(), &["damaged or not complete", "download it again"]),
        (bomb, &["RSN1_A.AT2", "exceeds 64 MiB a file"]),
        (archive(&[("a.pdf", b"%PDF")]), &["no files that could be records"]),
        (archive(&[]), &["no files that could be records"]),
    ] {
        std::fs::write(at.join("d.zip"), bytes).unwrap();
        import(at, "d.zip").fails(4, &[&["d.zip"], words].concat());
        assert_eq!(files(&at.join("set")), []);
    }
    assert!(!at.join("RSN1_A.AT2").exists());
}

#[test]
fn an_archive_elsewhere_is_named_as_such() {
    let place = tempfile::tempdir().unwrap();
    let at = place.path();
    std::fs::write(at.join("d.zip"), peer_archive()).unwrap();
    std::fs::write(at.join("m.csv"), "record_id,file_h1,file_h2\nA,d.zip,d.zip\n").unwrap();
    std::fs::write(at.join("s.toml"), "[records]\nmanifest = \"d.zip\"\n[pgv]\n[[sites]]\nname='A'\npgv='c.csv'\n")
        .unwrap();
    std::fs::write(at.join("c.csv"), "iml,maf\n0.01,1\n500,1e-6\n").unwrap();
    for arguments in [
        &["records", "show", "d.zip"][..],
        &["records", "list", "d.zip"],
        &["response", "d.zip", "--strength", "0.2"],
        &["records", "show", "m.csv", "A"],
        &["check", "s.toml"],
        &["run", "d.zip"],
    ] {
        let run = uplift(at, arguments);
        assert!(run.code > 1 && run.stderr.contains("uplift records import"), "{arguments:?}\n{}", run.stderr);
        assert!(run.stderr.contains("zip archive"), "{arguments:?}\n{}", run.stderr);
    }
}
