//! Files of labelled arrays as other programs see them: Python's libraries and h5dump.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "../../../tests/python.rs"]
mod python;

use std::path::Path;
use std::process::{Command, Output};

use uplift_labelled::LabelledWriter;

use python::{python, repository};

fn texts(values: &[&str]) -> Vec<String> {
    values.iter().map(ToString::to_string).collect()
}

/// A file with the shapes and types of a result: texts beyond ASCII, flags, not-a-number, a large compressed array.
fn write_example(path: &Path) {
    let mut writer = LabelledWriter::create(path).unwrap();
    writer.attribute("/", "program", "uplift").unwrap();
    writer.attribute("/", "study_toml", "[study]\nname = \"Βόλος\"\n").unwrap();
    writer.attribute("/", "seed", 20_260_101_u64).unwrap();
    writer.attribute("/", "input_checksums", texts(&["ab12", "cd34"])).unwrap();
    writer.axis_text("site", &texts(&["L'Aquila", "Βόλος"]), "site").unwrap();
    writer.axis_text("record", &(0..40).map(|i| format!("RSN{i}")).collect::<Vec<_>>(), "record").unwrap();
    writer.axis("poe", &[0.1, 0.02], "1", "probability of exceedance in 50 years").unwrap();
    writer.axis("strength", &[0.1, 0.2, 0.3], "1", "uplift strength over weight").unwrap();
    writer.axis("pgv_level", &(1..=150).map(f64::from).collect::<Vec<_>>(), "cm/s", "peak velocity").unwrap();
    writer.axis::<u32>("sample_size", &[10, 20], "1", "records in a sample").unwrap();
    writer.axis::<i64>("offset", &[-1, 0, 1], "s", "seconds from the start").unwrap();
    let u_m: Vec<f64> = (0..12).map(|i| if i == 7 { f64::NAN } else { f64::from(i) }).collect();
    writer.array("/urs/pgv/u_m", &["site", "poe", "strength"], &u_m, "m", "displacement").unwrap();
    writer.array::<u8>("/urs/pgv/bound_active", &["site", "poe"], &[0, 1, 0, 255], "1", "bound is active").unwrap();
    let edp_m: Vec<f64> = (0..40 * 3 * 150).map(|i| f64::from(i).sqrt()).collect();
    writer.array("/ida/pgv/edp_m", &["record", "strength", "pgv_level"], &edp_m, "m", "displacement").unwrap();
    let impacts: Vec<u32> = (0..120).collect();
    writer.array::<u32>("/ida/pgv/impacts", &["record", "strength"], &impacts, "1", "impacts").unwrap();
    writer.array::<f32>("/bootstrap/pgv/u50_m", &["sample_size", "offset"], &[0.5; 6], "m", "median").unwrap();
    writer.array_text("/records/event", &["record"], &vec!["中越, 2004".to_owned(); 40], "event").unwrap();
    writer.array("/bootstrap/pgv/total", &[], &[7.5], "1", "a single number").unwrap();
    writer.finish().unwrap();
}

fn succeeded(output: &Output) -> String {
    let (stdout, stderr) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{stdout}\n{stderr}");
    stdout.into_owned()
}

#[test]
fn python_sees_names_units_and_values() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.h5");
    write_example(&path);
    let script = repository().join("tests/python/read_result.py");
    let printed = succeeded(&Command::new(python).arg(script).arg(&path).output().unwrap());
    let lines: Vec<serde_json::Value> = printed.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let edp_sum: f64 = (0..18_000).map(|i| f64::from(i).sqrt()).sum();
    let expected = [
        ("/bootstrap/pgv/total", "float64", vec![], vec![], Some("1"), Some(7.5)),
        ("/bootstrap/pgv/u50_m", "float32", vec!["sample_size", "offset"], vec![2, 3], Some("m"), Some(3.0)),
        (
            "/ida/pgv/edp_m",
            "float64",
            vec!["record", "strength", "pgv_level"],
            vec![40, 3, 150],
            Some("m"),
            Some(edp_sum),
        ),
        ("/ida/pgv/impacts", "uint32", vec!["record", "strength"], vec![40, 3], Some("1"), Some(7140.0)),
        ("/records/event", "text", vec!["record"], vec![40], None, None),
        ("/urs/pgv/bound_active", "uint8", vec!["site", "poe"], vec![2, 2], Some("1"), Some(256.0)),
        ("/urs/pgv/u_m", "float64", vec!["site", "poe", "strength"], vec![2, 2, 3], Some("m"), Some(59.0)),
    ];
    assert_eq!(lines.len(), expected.len(), "{printed}");
    for (line, (path, kind, dims, shape, units, sum)) in lines.iter().zip(expected) {
        assert_eq!(line["path"], path);
        assert_eq!(line["type"], kind, "{path}");
        assert_eq!(line["dims"], serde_json::json!(dims), "{path}");
        assert_eq!(line["shape"], serde_json::json!(shape), "{path}");
        assert_eq!(line["units"], serde_json::json!(units), "{path}");
        match sum {
            // Summed in another order: a few units in the last place.
            Some(sum) => assert!((line["sum"].as_f64().unwrap() - sum).abs() <= 1e-12 * sum, "{path}: {line}"),
            None => assert!(line.get("sum").is_none(), "{path}"),
        }
    }
}

#[test]
fn h5dump_shows_the_tree() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.h5");
    write_example(&path);
    let Ok(output) = Command::new("h5dump").arg("-H").arg(&path).output() else {
        println!("skipped: no h5dump");
        return;
    };
    let header = succeeded(&output);
    for name in ["\"u_m\"", "\"edp_m\"", "\"pgv_level\"", "\"DIMENSION_LIST\"", "\"units\"", "HARDLINK \"/axes/site\""]
    {
        assert!(header.contains(name), "{name} is not in\n{header}");
    }
    // Neither text of HDF5 nor of this layer is null-padded: h5py and netCDF4 would not recognise the scales.
    assert!(header.contains("H5T_STR_NULLTERM") && !header.contains("H5T_STR_NULLPAD"), "{header}");
}
