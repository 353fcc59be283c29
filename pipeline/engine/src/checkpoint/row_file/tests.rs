//! Files that are cut, damaged, of other work or of another version.
use super::*;

fn head() -> RowFileHead {
    RowFileHead::new("work".into(), "a title", [1, 1], [3, 1])
}

fn open(path: &Path, head: &RowFileHead) -> Result<(RowFile, Finding), EngineError> {
    RowFile::open(path, head, || HashSet::from([RowKey([1; 16])]))
}

fn with_three(path: &Path) -> Vec<u8> {
    let (file, found) = open(path, &head()).unwrap();
    assert!(found.rows.is_empty());
    for key in 0..3_u8 {
        let displacement_m = [f64::from(key), f64::INFINITY];
        file.append(
            RowKey([key; 16]),
            &AnalysisRow { motion: 0, system: 0, displacement_m: &displacement_m, impacts: &[7, 8] },
        );
    }
    assert!(!file.is_full());
    std::fs::read(path).unwrap()
}

// Cut anywhere, the file is gone on with from the last whole row.
#[test]
fn cut_at_every_byte() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.part");
    let whole = with_three(&path);
    let block = 24 + 24;
    let first = whole.len() - 3 * block;
    for length in 0..=whole.len() {
        std::fs::write(&path, &whole[..length]).unwrap();
        let (file, found) = open(&path, &head()).unwrap();
        let sound = length.saturating_sub(first) / block;
        assert_eq!(found.rows.len(), sound, "{length}");
        let row = AnalysisRow { motion: 0, system: 0, displacement_m: &[9.0, 9.5], impacts: &[1, 2] };
        file.append(RowKey([9; 16]), &row);
        drop(file);
        let found = RowFile::read(&path).unwrap().unwrap();
        assert_eq!((found.rows.len(), found.damaged_bytes), (sound + 1, 0), "{length}");
        assert_eq!(found.rows.rows[&RowKey([9; 16])], (vec![9.0, 9.5], vec![1, 2]));
    }
}

// A flipped byte costs one row, or those behind it where it is the length that is wrong; and what is gone on with is
// sound.
#[test]
fn a_flipped_byte_costs_its_row() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.part");
    let whole = with_three(&path);
    let first = whole.len() - 3 * 48;
    for index in first..whole.len() {
        let mut damaged = whole.clone();
        damaged[index] ^= 0x10;
        std::fs::write(&path, &damaged).unwrap();
        let found = RowFile::read(&path).unwrap().unwrap();
        let in_the_length = (16..20).contains(&((index - first) % 48));
        assert!(found.rows.len() == 2 || (in_the_length && found.rows.len() < 3), "{index}: {}", found.rows.len());
        assert!(found.damaged_bytes > 0);
        for (key, row) in &found.rows.rows {
            assert_eq!(*row, (vec![f64::from(key.0[0]), f64::INFINITY], vec![7, 8]), "{index}");
        }
        let (_, opened) = open(&path, &head()).unwrap();
        assert_eq!(opened.rows.len(), found.rows.len());
        let again = RowFile::read(&path).unwrap().unwrap();
        assert_eq!((again.rows.len(), again.damaged_bytes), (found.rows.len(), 0));
    }
}

#[test]
fn nothing_else_is_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.part");
    for notes in ["my notes\nof the day\n", "one line, not ended", "{\"format\":1}"] {
        std::fs::write(&path, notes).unwrap();
        assert!(open(&path, &head()).is_err());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), notes);
    }
    assert!(RowFile::read(&folder.path().join("absent")).unwrap().is_none());
}

#[test]
fn rows_of_other_work_are_carried_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.part");
    with_three(&path);
    let other = RowFileHead { work: "other".into(), ..head() };
    let (file, found) = open(&path, &other).unwrap();
    assert_eq!(found.rows.len(), 3);
    drop(file);
    let found = RowFile::read(&path).unwrap().unwrap();
    assert!(found.head.is_of(&other));
    // of them one is of this work, with two peaks
    assert_eq!((found.analyses(), found.rows.len()), (2, 3));
    // but no shard is taken for one of other work
    let shard = RowFileHead::new("third".into(), "", [1, 2], [3, 1]);
    assert!(open(&path, &shard).unwrap_err().to_string().contains("other work"));
}

/// A checkpoint of version 0.1 is read, and is overwritten: its keys are of no work of this version. A shard stays.
#[test]
fn a_file_of_the_version_before_is_no_mistake() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.part");
    let block = write_block(RowKey([1; 16]), &[0.5], &[3]);
    let write = |shards: u64| {
        let numbers = format!("\"shard\":1,\"shards\":{shards},\"pieces\":9");
        let head = format!("{{\"format\":\"uplift pieces 1\",\"work\":\"ab\",\"title\":\"old\",{numbers}}}\n");
        std::fs::write(&path, [head.as_bytes(), &block].concat()).unwrap();
    };
    write(1);
    let found = RowFile::read(&path).unwrap().unwrap();
    assert_eq!((found.rows.len(), found.damaged_bytes), (1, 0));
    let (_, found) = open(&path, &head()).unwrap();
    assert!(found.rows.is_empty() && found.damaged_bytes == 0);
    assert_eq!(RowFile::read(&path).unwrap().unwrap().head, head());
    write(2);
    let refused = open(&path, &RowFileHead::new("ab".into(), "old", [1, 2], [9, 1])).unwrap_err();
    assert!(refused.to_string().contains("shard 1 of 2 of other work"), "{refused}");
}
