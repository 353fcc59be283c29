//! Selections of records, as the tools write them.
#![allow(clippy::unwrap_used)]

use uplift_motion::{
    Horizontal, IntensityMeasure, MotionError, Period, SelectedComponent, SelectedName, SelectedSet, SelectionTool,
    ezgm_selection_from, read_selection, selection_from,
};

const HASELREC: &[u8] = include_bytes!("samples/selection.haselrec");
const HASELREC_2019: &[u8] = include_bytes!("samples/selection-2019.haselrec");
const CS_SELECTION: &[u8] = include_bytes!("samples/selection.cs");
const CS_SELECTION_ONE: &[u8] = include_bytes!("samples/selection-one.cs");
const EZGM: &[u8] = include_bytes!("samples/selection.ezgm");
const DJURA: &[u8] = include_bytes!("samples/selection.djura");
const ALL: [&[u8]; 6] = [HASELREC, HASELREC_2019, CS_SELECTION, CS_SELECTION_ONE, EZGM, DJURA];

fn sa(period_s: f64) -> IntensityMeasure {
    IntensityMeasure::Sa(Period::from_s(period_s).unwrap())
}

fn read(bytes: &[u8]) -> Result<SelectedSet, MotionError> {
    selection_from(bytes, "the file", sa(1.0))
}

/// `EzGM`'s lists, which one sample holds with an empty line between them.
fn ezgm(bytes: &[u8]) -> Result<SelectedSet, MotionError> {
    let middle = bytes.windows(2).position(|pair| pair == b"\n\n").unwrap_or(bytes.len());
    let factors = bytes.get(middle + 2..).unwrap_or_default();
    ezgm_selection_from([&bytes[..middle], factors], ["the file", "its factors, the file"], SelectedComponent::Pair)
}

fn files(names: &[&str]) -> SelectedName {
    SelectedName::Files(names.iter().map(|&name| name.to_owned()).collect())
}

/// Tool, level, and of each record its place, name, component and factor.
fn assert_is(
    set: &SelectedSet,
    (tool, level): (SelectionTool, Option<f64>),
    records: &[(usize, SelectedName, SelectedComponent, &str)],
) {
    assert_eq!((set.tool, set.level), (tool, level));
    let found: Vec<_> =
        set.records.iter().map(|r| (r.position, r.name.clone(), r.component, r.factor.as_str())).collect();
    assert_eq!(found, records);
}

#[test]
fn every_tool_is_detected_and_read() {
    use SelectedComponent::{Numbered, OfFile, Pair};
    let of_esm = SelectedName::EventStation { event: "XX-2001-0001".into(), station: "STB".into() };
    let rsn = SelectedName::SequenceNumber(12);
    let of_kik_net = SelectedName::Name("ABCH010101010101".into());
    let [first, second] = ["1.25", "0.80"];
    assert_is(
        &read(HASELREC).unwrap(),
        (SelectionTool::HaselRec, Some(0.35)),
        &[
            (5, rsn.clone(), Pair, first),
            (6, of_esm.clone(), Numbered(Horizontal::H2), second),
            (7, of_kik_net, Numbered(Horizontal::H1), "4.00"),
        ],
    );
    assert_is(
        &read(HASELREC_2019).unwrap(),
        (SelectionTool::HaselRec, Some(35.5)),
        &[(5, of_esm, Pair, second), (6, rsn, Pair, first)],
    );
    let [one, other] = ["EVENT\\STA360.AT2", "EVENT\\STA090.AT2"];
    assert_is(
        &read(CS_SELECTION).unwrap(),
        (SelectionTool::CsSelection, None),
        &[
            (8, files(&[one, other]), Pair, first),
            (9, files(&["EVENT\\STB360.AT2", "EVENT\\STB090.AT2"]), Pair, second),
        ],
    );
    assert_is(
        &read(CS_SELECTION_ONE).unwrap(),
        (SelectionTool::CsSelection, None),
        &[(8, files(&[other]), OfFile, first)],
    );
    assert_is(
        &ezgm(EZGM).unwrap(),
        (SelectionTool::EzGm, None),
        &[
            (1, files(&["RSN12_EVENT_STA360_ACC.txt"]), Pair, "1.25000"),
            (2, files(&["RSN13_EVENT_STB360_ACC.txt"]), Pair, "0.80000"),
        ],
    );
    assert_is(
        &read(DJURA).unwrap(),
        (SelectionTool::Djura, Some(0.35)),
        &[
            (1, files(&["RSN12_EVENT_STA360.AT2", "RSN12_EVENT_STA090.AT2"]), Pair, first),
            (2, files(&["RSN13_EVENT_STB090.AT2"]), OfFile, "0.8"),
        ],
    );
}

#[test]
fn the_level_is_that_of_the_measure() {
    let of = |measure| selection_from(DJURA, "the file", measure);
    // what Djura does not tell is to be given; what differs from record to record was not selected for
    assert_eq!(of(sa(0.3)).unwrap().level, None);
    assert_eq!(of(IntensityMeasure::Cav).unwrap().level, None);
    for measure in [sa(0.5), IntensityMeasure::Pga, IntensityMeasure::Pgv] {
        let message = of(measure).unwrap_err().to_string();
        assert!(message.contains(measure.label()) && message.contains("not selected for a level of it"), "{message}");
    }
    let alike = String::from_utf8(DJURA.to_vec()).unwrap().replace("24.0", "31.0");
    assert_eq!(selection_from(alike.as_bytes(), "x", IntensityMeasure::Pgv).unwrap().level, Some(31.0));
    // numbers of records where there are no files
    let numbers = alike.replace("rec_filenames", "names");
    let set = selection_from(numbers.as_bytes(), "x", sa(1.0)).unwrap();
    assert_eq!(set.records[0].name, SelectedName::SequenceNumber(12));
    assert_eq!(set.records[1].component, SelectedComponent::Numbered(Horizontal::H2));
    // the spectrum of a code has no level
    let of_code = String::from_utf8(HASELREC.to_vec()).unwrap().replace("reference hazard value", "average_misfit (%)");
    assert_eq!(read(of_code.as_bytes()).unwrap().level, None);
}

#[test]
fn mistakes_are_reported_with_their_line() {
    for (bytes, from, to, words) in [
        (HASELREC, "1.25", "0.00", "line 5: the scale factor is \"0.00\""),
        (HASELREC, " 12 ", " twelve ", "line 5: recID is \"twelve\""),
        (HASELREC, " nan 2 6.1", " nan 3 6.1", "line 6: component is \"3\""),
        (HASELREC, "XX-2001-0001", "nan", "line 6: the record has no event_id"),
        (HASELREC, "0.80 0.1 40.0 0.1 40.0", "0.80", "line 6: 11 words under a header of 15"),
        (HASELREC, "0.35", "-1", "line 1: the reference hazard value is \"-1\""),
        (HASELREC_2019, " 500.0", "", "line 5: 9 words under a header of 8"),
        (CS_SELECTION, "Scale Factor", "Factor", "line 7: the header has no Scale Factor"),
        (CS_SELECTION, "File Name Dir. 2", "Dir. 2", "the header has no File Name, or File Name Dir. 1 and Dir. 2"),
        (CS_SELECTION, "   0.80", "NaN", "line 9: the scale factor is \"NaN\""),
        (CS_SELECTION, "\t EVENT\\STB360.AT2 ", "", "line 9: 6 cells between tabs, expected 7"),
        (CS_SELECTION, "EVENT\\STB360.AT2", "", "line 9: the record has no file name"),
        (DJURA, "\"sf\": [1.25, 0.8]", "\"sf\": [1.25]", "1 factors (sf), 2 names"),
        (DJURA, "\"sf\": [1.25, 0.8]", "\"sf\": [1.25, NaN]", "the scale factor is \"null\""),
        (DJURA, "\"H2\"]", "\"V\"]", "record 2: gm_components is \"V\""),
        (DJURA, "\"sf\"", "\"factors\"", "missing field `sf`"),
        (b"record_id,pgv_cm_s\n", "", "", "unknown format"),
        (b"num source recID scale_factor\n", "", "", "it names no record"),
    ] {
        let text = std::str::from_utf8(bytes).unwrap().replacen(from, to, 1);
        let message = read(text.as_bytes()).unwrap_err().to_string();
        assert!(message.contains("the file") && message.contains(words), "{words}: {message}");
    }
    for (from, to, words) in
        [("0.80000", "", "2 names, and 1 factors"), ("0.80", "-0.80", "line 2: the scale factor is \"-0.80000\"")]
    {
        let message = ezgm(std::str::from_utf8(EZGM).unwrap().replace(from, to).as_bytes()).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn lists_of_ezgm_lie_side_by_side() {
    let folder = std::env::temp_dir().join(format!("uplift-selection-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let names = folder.join("GMR_names.txt");
    std::fs::write(&names, "a.txt\n").unwrap();
    let alone = read_selection(&names, sa(1.0)).unwrap_err().to_string();
    std::fs::write(folder.join("GMR_sf_used"), "2.00000\n").unwrap();
    let set = read_selection(&names, sa(1.0));
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(alone.contains("GMR_sf_used.txt, its factors, is not beside it"), "{alone}");
    assert_eq!(set.unwrap().records[0].component, SelectedComponent::OfFile);
}

/// Whatever the bytes, the answer is a set with factors above zero, or a short message that names the file.
#[test]
fn every_cut_and_every_flipped_bit_gives_an_answer() {
    let check = |bytes: &[u8]| {
        for result in [read(bytes), ezgm(bytes)] {
            match result {
                Ok(set) => {
                    assert!(!set.records.is_empty());
                    assert!(set.records.iter().all(|record| record.factor.parse::<f64>().unwrap() > 0.0));
                }
                Err(error) => {
                    let message = error.to_string();
                    assert!(message.contains("the file") && message.len() < 1000, "{message}");
                }
            }
        }
    };
    for sample in ALL {
        for cut in 0..sample.len() {
            check(&sample[..cut]);
        }
        for at in 0..sample.len() {
            for bit in 0..8 {
                let mut damaged = sample.to_vec();
                damaged[at] ^= 1 << bit;
                check(&damaged);
            }
        }
    }
    let noise: Vec<u8> = (0..20_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    for bytes in [&noise[..], b"", b"\n\n", b"{", &[b'{'; 5000], &[b'['; 5000], b"PK\x03\x04", &[0; 5000]] {
        check(bytes);
        assert!(read(bytes).is_err());
    }
}
