//! `uplift response`: one record through one oscillator, as typed.

use std::fmt::Write as _;

use serde_json::Value;

use crate::common::{real_records, repository, uplift};

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

// The exact cases typed at the command line: what the file format, the units and the options do to them is tested with
// them.
#[test]
fn exact_cases_through_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(repository().join("crates/oscillator/tests/data/nsbe_cases.json")).unwrap();
    let cases = json(&text);
    for (name, samples) in cases["records"].as_object().unwrap() {
        let mut column = String::from("# acceleration in m/s2\n");
        for sample in samples.as_array().unwrap() {
            writeln!(column, "{:e}", sample.as_f64().unwrap()).unwrap();
        }
        std::fs::write(folder.path().join(format!("{name}.txt")), column).unwrap();
    }
    for case in cases["cases"].as_array().unwrap() {
        let number = |key: &str| case[key].to_string();
        let mut arguments: Vec<String> = vec!["response".into(), format!("{}.txt", case["record"].as_str().unwrap())];
        for (option, key) in [
            ("--strength", "eta"),
            ("--scale", "scale"),
            ("--uplift-displacement-m", "u_up"),
            ("--restitution", "r_c"),
            ("--gravity-m-s2", "g"),
            ("--dt-s", "dt"),
            ("--free-vibration-s", "t_free"),
        ] {
            arguments.extend([option.to_owned(), number(key)]);
        }
        arguments.extend(["--unit", "m/s2", "--json"].map(str::to_owned));
        if !case["u_cap"].is_null() {
            arguments.extend(["--capacity-m".to_owned(), number("u_cap")]);
        }
        let got = json(&uplift(folder.path(), &arguments).ok().stdout);
        let (id, expected) = (case["id"].as_str().unwrap(), &case["expected"]);
        assert_eq!(got["overturned"], expected["collapsed"], "{id}");
        if case["n_impacts_comparable"] == true {
            assert_eq!(got["impacts"], expected["n_impacts"], "{id}");
        }
        match expected["u_max"].as_f64() {
            None => assert!(got["peak_displacement_m"].is_null(), "{id}"),
            Some(u_max) => {
                let error = (got["peak_displacement_m"].as_f64().unwrap() - u_max).abs();
                assert!(error <= case["suggested_rel_tol"].as_f64().unwrap() * u_max, "{id}: {got}");
            }
        }
    }
}

#[test]
fn history_holds_samples_and_events_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let column: String =
        (0..400).fold(String::new(), |text, i| text + &format!("{}\n", (f64::from(i) * 0.05).sin() * 0.4));
    std::fs::write(folder.path().join("sine.txt"), column).unwrap();
    let run = uplift(
        folder.path(),
        &["response", "sine.txt", "--strength", "0.2", "--dt-s", "0.01", "--unit", "g", "--history", "h.csv", "--json"],
    )
    .ok();
    let response = json(&run.stdout);
    let text = std::fs::read_to_string(folder.path().join("h.csv")).unwrap();
    let mut lines = text.lines();
    let beside = std::fs::read_to_string(folder.path().join("h.csv-metadata.json")).unwrap();
    assert!(beside.contains("record sine.txt"), "{beside}");
    insta::assert_snapshot!(
        lines.next().unwrap(),
        @"time_s,displacement_m,velocity_m_s,ground_acceleration_m_s2,event"
    );
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let times: Vec<f64> = rows.iter().map(|row| row[0].parse().unwrap()).collect();
    assert!(times.windows(2).all(|pair| pair[0] <= pair[1]));
    assert_eq!(rows.iter().filter(|row| row[4].is_empty()).count(), 400);
    let impacts = rows.iter().filter(|row| row[4] == "after impact").count();
    assert_eq!(response["impacts"], impacts);
    assert!(impacts > 0);
    let largest = rows.iter().map(|row| row[1].parse::<f64>().unwrap().abs()).fold(0.0, f64::max);
    let peak = response["peak_displacement_m"].as_f64().unwrap();
    assert!(largest <= peak * (1.0 + 1e-12) && largest > 0.99 * peak, "{largest} {peak}");
}

#[test]
fn mistakes_are_said() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("one.txt"), "0.1\n0.2\n").unwrap();
    let response = |arguments: &[&str]| uplift(folder.path(), &[&["response"], arguments].concat());
    response(&["absent.AT2", "--strength", "0.2"]).fails(4, &["absent.AT2"]);
    response(&["one.txt", "--strength", "0.2"]).fails(4, &["one.txt"]);
    response(&["one.txt", "--strength", "0.2", "--unit", "furlong"]).fails(2, &["furlong", "cm/s2"]);
    response(&["one.txt", "--strength", "-1", "--dt-s", "0.01", "--unit", "g"]).fails(2, &["strength is -1"]);
    response(&["one.txt", "--strength", "0.2", "--capacity-m", "0.0001", "--dt-s", "0.01", "--unit", "g"])
        .fails(2, &["0.0001", "capacity"]);
    response(&["one.txt"]).fails(2, &["--strength"]);
    // what can be, and is a mistake of unit or scale
    for system in [&["--strength", "0.2"][..], &["--block", "--width-m", "1", "--height-m", "5"]] {
        let asked = ["one.txt", "--dt-s", "0.01", "--unit", "g", "--scale", "1000"];
        let said = response(&[&asked[..], system].concat()).ok();
        let all = said.stdout + &said.stderr;
        assert!(all.contains("PGA of the record is 200 g") && all.contains("4 is the most"), "{all}");
        let asked = ["one.txt", "--dt-s", "1", "--unit", "m/s2", "--scale", "90"];
        let said = response(&[&asked[..], system].concat()).ok();
        let all = said.stdout + &said.stderr;
        assert!(all.contains("PGV of the record is ") && all.contains("time step"), "{all}");
    }
}

#[test]
fn real_record() {
    let Some(records) = real_records() else { return };
    let record = records.join("RSN1004_Northridge01_LASepulvedaVAHospital/RSN1004_NearNoPulse_LASepulvedaVAH_270.AT2");
    let run = uplift(&records, &["response", record.to_str().unwrap(), "--strength", "0", "--json"]).ok();
    let response = json(&run.stdout);
    // strength zero: the peak ground displacement, from two independent integrations
    let (peak, pgd) = (response["peak_displacement_m"].as_f64().unwrap(), response["pgd_m"].as_f64().unwrap());
    assert!((peak / pgd - 1.0).abs() < 1e-12, "{peak} {pgd}");
    assert!((response["pga_g"].as_f64().unwrap() - 0.75251).abs() < 1e-5);
    assert!((response["pgv_cm_s"].as_f64().unwrap() - 77.647).abs() < 1e-3);
}

#[test]
fn a_history_is_drawn_with_its_impacts() {
    let folder = tempfile::tempdir().unwrap();
    let column: String =
        (0..400).fold(String::new(), |text, i| text + &format!("{}\n", (f64::from(i) * 0.05).sin() * 0.4));
    std::fs::write(folder.path().join("sine.txt"), column).unwrap();
    let response = |more: &[&str]| {
        let arguments = ["response", "sine.txt", "--strength", "0.2", "--dt-s", "0.01", "--unit", "g"];
        uplift(folder.path(), &[&arguments[..], more].concat())
    };
    let run = response(&["--plot", "h.svg", "--json"]).ok();
    let impacts = usize::try_from(json(&run.stdout)["impacts"].as_u64().unwrap()).unwrap();
    let svg = std::fs::read_to_string(folder.path().join("h.svg")).unwrap();
    // a dot for each impact, and one in the legend
    assert_eq!(svg.matches("<circle").count(), impacts + 1);
    assert!(svg.contains("displacement, m") && !svg.contains("sine.txt times 1"));
    // as many digits as a peak has
    let said = response(&[]).ok().stdout;
    let peak = said.split_once("peak displacement ").unwrap().1.split(' ').next().unwrap();
    assert_eq!(peak.trim_start_matches(['0', '.']).len(), 3, "{said}");
    response(&["--plot", "h.pdf"]).fails(2, &[".svg or .png"]);
}
