//! What tools of record selection write, made a table of sets at each level, and run.

use std::fmt::Write as _;

use crate::at_level::{LEVELS, STUDY, run};
use crate::common::{SmallStudy, array, same_bits};
use crate::records::rows;

/// Six synthetic pairs under names as PEER gives them, their manifest, and a study of them.
fn downloaded() -> (SmallStudy, Vec<f64>) {
    let study = SmallStudy::with(&STUDY.replace("[records.synthetic]\npairs = 6", "[records]\nmanifest = \"set.csv\""));
    study.uplift(&["records", "synthesize", "-o", "made", "--count", "6", "-q"]).ok();
    let mut manifest = "record_id,file_h1,file_h2\n".to_owned();
    for number in 1..=6 {
        for (made, name) in [("H1", "000"), ("H2", "090")] {
            let [from, to] = [format!("made/SYN{number:03}_{made}.AT2"), format!("RSN{number}_A_STA{name}.AT2")];
            std::fs::copy(study.path().join(from), study.path().join(to)).unwrap();
        }
        writeln!(manifest, "r{number},RSN{number}_A_STA000.AT2,RSN{number}_A_STA090.AT2").unwrap();
    }
    study.write("set.csv", &manifest);
    study.uplift(&["run", "study.toml", "-o", "plain.h5", "-q"]).ok();
    let pgv = array(&study.path().join("plain.h5"), "/records/pgv_cm_s");
    (study, pgv)
}

/// The records of a level, counted from one, with their factors.
fn chosen(level: usize, pgv: &[f64]) -> Vec<(usize, String)> {
    let of = |record: usize| (record, format!("{:.4}", LEVELS[level] / pgv[record - 1]));
    (1..=pgv.len()).filter(|record| !(record + level).is_multiple_of(3)).map(of).collect()
}

/// The selections of all levels as each tool writes them, with the file that the command takes.
fn write_selections(study: &SmallStudy, tool: &str, pgv: &[f64]) -> Vec<String> {
    let of_level = |level: usize| {
        let chosen = chosen(level, pgv);
        let lines = |of: &dyn Fn(usize, &str) -> String| -> String {
            chosen.iter().map(|(record, factor)| of(*record, factor)).collect()
        };
        let listed = |of: &dyn Fn(usize, &str) -> String| lines(&|record, factor| of(record, factor) + ",");
        let folder = format!("{tool}/{level}");
        std::fs::create_dir_all(study.path().join(&folder)).unwrap();
        let (name, text) = match tool {
            "haselREC" => {
                let rows = lines(&|record, factor| format!("1 NGA-West2 - - {record} - 6.5 20 400 nan {factor}\n"));
                let columns =
                    "num source event_id station_code recID component magnitude distance vs30 EC8 scale_factor";
                let head = format!("reference hazard value =  {}\nmean_mag_disag =  6\n{columns}\n", LEVELS[level]);
                ("PGV_summary_selection.txt", head + &rows)
            }
            "CS_Selection" => {
                let rows = lines(&|record, factor| {
                    format!("1 \t 99 \t {factor} \t A\\STA000.AT2 \t RSN{record}_A_STA090.AT2 \t u \t u \n")
                });
                let columns =
                    ["Record Number", "Record Sequence Number", "Scale Factor", "File Name Dir. 1"].join(" \t ");
                // the file in the folder of an earthquake has no number: told by the other
                ("Output_File.dat", format!("a \n \n{columns} \t File Name Dir. 2 \t URL 1 \t URL 2 \n{rows}"))
            }
            "EzGM" => {
                study.write(&format!("{folder}/GMR_sf_used.txt"), &lines(&|_, factor| format!("{factor}\n")));
                ("GMR_H1_names.txt", lines(&|record, _| format!("RSN{record}_A_STA000_ACC.txt\n")))
            }
            _ => {
                let lists = [
                    ("sf", listed(&|_, factor| factor.to_owned())),
                    ("rsn", listed(&|record, _| record.to_string())),
                    ("gm_components", listed(&|_, _| "\"H1, H2\"".to_owned())),
                    (
                        "rec_filenames",
                        listed(&|record, _| format!("\"RSN{record}_A_STA000.AT2, RSN{record}_A_STA090.AT2\"")),
                    ),
                    ("Scaled_IMs", listed(&|_, _| format!("[1, {}]", LEVELS[level]))),
                ]
                .map(|(key, list)| format!("\"{key}\": [{}]", list.trim_end_matches(',')));
                let best = lists.join(", ");
                ("records.json", format!("{{\"selected_scaled_best\": {{{best}, \"im_idxs\": {{\"PGV\": [1]}}}}}}"))
            }
        };
        let file = format!("{folder}/{name}");
        study.write(&file, &text);
        file
    };
    (0..LEVELS.len()).rev().map(of_level).collect()
}

#[test]
fn selections_of_every_tool_become_the_table_and_run() {
    let (study, pgv) = downloaded();
    let mut by_hand = "record_id,pgv_cm_s,factor\n".to_owned();
    for (level, value) in LEVELS.iter().enumerate() {
        for (record, factor) in chosen(level, &pgv) {
            writeln!(by_hand, "r{record},{value},{factor}").unwrap();
        }
    }
    run(&study, &by_hand);
    let expected = rows(&study.path().join("sets.csv"));
    // the highest level comes first, and the table begins with the lowest
    for (tool, levels) in
        [("haselREC", None), ("CS_Selection", Some("100,30,10,3,1")), ("EzGM", Some("100,30,10,3,1")), ("Djura", None)]
    {
        let files = write_selections(&study, tool, &pgv);
        let table = format!("{tool}.csv");
        let mut arguments = vec!["records", "at-level", "--manifest", "set.csv", "--measure", "pgv", "-o", &table];
        arguments.extend(files.iter().map(String::as_str));
        arguments.extend(levels.into_iter().flat_map(|levels| ["--level", levels]));
        let written = study.uplift(&arguments).ok();
        assert!(written.stdout.contains(&format!("at_level = \"{table}\"")), "{}", written.stdout);
        assert!(written.stdout.contains("[pgv]\nlevels_cm_s = [1, 3, 10, 30, 100]"), "{}", written.stdout);
        assert!(written.stderr.contains(&format!("by {tool}")), "{}", written.stderr);
        let found = rows(&study.path().join(&table));
        assert_eq!(found.len(), expected.len(), "{tool}");
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found["record_id"], expected["record_id"], "{tool}");
            for column in ["pgv_cm_s", "factor"] {
                assert_eq!(found[column].parse::<f64>(), expected[column].parse::<f64>(), "{tool} {column}");
            }
        }
        let result = format!("{tool}.h5");
        let set = format!("records.at_level={table}");
        study.uplift(&["run", "study.toml", "--set", &set, "-o", &result, "-q"]).ok();
        for array_name in ["/ida/pgv/edp_m", "/ida/pgv/factor", "/urs/pgv/u_m"] {
            let of = |file: &str| array(&study.path().join(file), array_name);
            assert!(same_bits(&of("sets.h5"), &of(&result)), "{tool} {array_name}");
        }
    }
}

#[test]
fn components_and_series_that_are_scaled_already_stand_as_what_they_are() {
    let (study, pgv) = downloaded();
    let one = "num source event_id station_code recID component magnitude distance vs30 EC8 scale_factor\n\
               1 NGA-West2 - - 2 1 6.5 20 400 nan 0.50\n2 NGA-West2 - - 3 - 6.5 20 400 nan 0.70\n";
    study.write("one_summary_selection.txt", one);
    let at_level = |arguments: &[&str]| {
        let fixed = ["records", "at-level", "--manifest", "set.csv", "--measure", "pgv", "--level", "10", "--force"];
        study.uplift(&[&fixed[..], arguments].concat()).ok()
    };
    let said = at_level(&["one_summary_selection.txt", "--both", "-o", "one.csv"]);
    assert!(said.stdout.contains("component = \"both\""), "{}", said.stdout);
    assert!(said.stderr.contains("1 component named only by 1 or 2 of the tool's database"), "{}", said.stderr);
    let column = |name: &str| rows(&study.path().join("one.csv")).iter().map(|r| r[name].clone()).collect::<Vec<_>>();
    assert_eq!(column("record_id"), ["r2:h1", "r3:h1", "r3:h2"]);
    assert_eq!(column("factor"), ["0.50", "0.70", "0.70"]);

    // EzGM's own series, imported: they have their factor
    let series: String = pgv.iter().take(2).enumerate().fold(String::new(), |mut text, (index, _)| {
        let number = index + 1;
        let name = format!("RSN{number}_A_STA000_ACC.txt");
        std::fs::copy(study.path().join(format!("RSN{number}_A_STA000.AT2")), study.path().join(&name)).unwrap();
        writeln!(text, "{name}").unwrap();
        text
    });
    study.write("GMR_H1_names.txt", &series);
    study.write("GMR_sf_used.txt", "2.00000\n3.00000\n");
    study.write(
        "set.csv",
        "record_id,file_h1,file_h2\na,RSN1_A_STA000_ACC.txt,RSN1_A_STA090.AT2\nb,RSN2_A_STA000.AT2,RSN2_A_STA090.AT2\n",
    );
    let said = at_level(&["GMR_H1_names.txt", "-o", "one.csv"]);
    assert!(said.stderr.contains("1 from EzGM's own series, which are scaled already"), "{}", said.stderr);
    assert_eq!(
        (column("record_id"), column("factor")),
        (vec!["a".into(), "b".into()], vec!["1".into(), "3.00000".into()])
    );
}

#[test]
fn selections_that_do_not_fit_are_refused_at_once_and_nothing_is_written() {
    let (study, _) = downloaded();
    let head = "num source event_id station_code recID component magnitude distance vs30 EC8 scale_factor\n";
    let row = |rsn: &str| format!("1 NGA-West2 - - {rsn} - 6.5 20 400 nan 1.50\n");
    study.write("a.txt", &format!("reference hazard value =  10\n{head}{}{}{}", row("1"), row("77"), row("78")));
    study.write("b.txt", &format!("{head}{}{}", row("2"), row("2")));
    study.write("c.txt", "something else\n");
    let refused = |arguments: &[&str], code: i32, words: &[&str]| {
        let fixed = ["records", "at-level", "--manifest", "set.csv", "--measure", "pgv", "-o", "t.csv"];
        study.uplift(&[&fixed[..], arguments].concat()).fails(code, words);
        assert!(!study.path().join("t.csv").exists());
    };
    refused(
        &["a.txt", "b.txt", "c.txt"],
        4,
        &[
            "a.txt: 2 of 3 records are not in set.csv: RSN 77 (line 4), RSN 78 (line 5): import them, too",
            "b.txt: haselREC does not write the PGV that it was selected for: give --level, in cm/s",
            "c.txt: unknown format",
        ],
    );
    refused(&["b.txt", "--level", "3"], 4, &["line 3: r2 is in line 2 already"]);
    refused(&["a.txt", "--level", "12"], 4, &["says that it was selected for 10 cm/s, and --level is 12 cm/s"]);
    refused(&["a.txt", "b.txt", "--level", "10,10"], 4, &["both have the level 10 cm/s"]);
    refused(&["a.txt", "--level", "10,30"], 2, &["2 levels for 1 file"]);
    refused(&["a.txt", "--level", "0"], 2, &["--level is 0: give numbers above 0, in cm/s"]);
    let twice =
        "record_id,file_h1,file_h2\nx,RSN2_A_STA000.AT2,RSN2_A_STA090.AT2\ny,RSN2_A_STA090.AT2,RSN2_A_STA000.AT2\n";
    study.write("set.csv", twice);
    refused(&["b.txt", "--level", "3"], 4, &["RSN 2 is x, y in the manifest: leave all but one out of it"]);
    study.write("GMR_H1_names.txt", "RSN1_A_STA000_ACC.txt\n");
    refused(&["GMR_H1_names.txt", "--level", "3"], 4, &["GMR_sf_used.txt, its factors, is not beside it"]);
}
