//! `uplift library`: how blocks and oscillators respond over normalised intensities.

use std::collections::HashMap;

use serde_json::Value;

use crate::common::{SmallStudy, rows, uplift};

fn number(row: &HashMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name}: {row:?}"))
}

/// A ground that sets off for good with a constant acceleration, and one that jerks for two hundredths of a second.
fn steps(library: &str) -> SmallStudy {
    let folder = SmallStudy::new();
    let step: String = (0..1500).map(|_| "1\n").collect();
    let jerk: String = (0..1500).map(|sample| if sample == 2 { "1\n" } else { "0\n" }).collect();
    folder.write("step.txt", &step);
    folder.write("jerk.txt", &jerk);
    let row = |id: &str, file: &str| format!("{id},{file},{file},0.01,m/s2\n");
    let rows = [row("A", "step.txt"), row("B", "jerk.txt")].concat();
    folder.write("manifest.csv", &format!("record_id,file_h1,file_h2,dt_s,unit\n{rows}"));
    folder.write("library.toml", &format!("[records]\nmanifest = \"manifest.csv\"\nduplicates = \"keep\"\n{library}"));
    folder
}

// A block rocks from PGA = g tan α on, whatever shakes it. A constant acceleration above it overturns the block without
// return; a jerk of 0.02 s and so an impulse of 0.01 s times its peak does not.
#[test]
fn a_case_known_by_hand() {
    let folder = steps(
        "[block]\nsize_m = 1\nslenderness_rad = [0.1, 0.2]\nrestitution = 0.9\n\
         [oscillator]\ncapacity_m = [0.4, inf]\n[strengths]\nvalues = 0.1\n[levels]\npga = [0.99, 1.01]\npgv = 0.001\n",
    );
    let run = folder.uplift(&["library", "library.toml", "-o", "out", "--json"]).ok();
    let report: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((&report["motions"], &report["analyses"]), (&Value::from(4), &Value::from(4 * (3 * 3 + 2))));
    let levels = rows(&folder.path().join("out/levels.csv"));
    assert_eq!(levels.len(), 3 * 3 + 2);
    for row in levels.iter().filter(|row| row["kind"] == "block") {
        let alpha = number(row, "slenderness_rad");
        assert!((number(row, "uplift_acceleration_g") / alpha.tan() - 1.0).abs() < 1e-12);
        assert!((number(row, "p_rad_s").powi(2) / (0.75 * 9.806_65) - 1.0).abs() < 1e-12);
        let expected = match row["im"].as_str() {
            "pga" if number(row, "level") > 1.0 => [1.0, 0.5],
            _ => [0.0, 0.0],
        };
        assert_eq!(["share_rocking", "share_overturning"].map(|name| number(row, name)), expected, "{row:?}");
        let infinite = number(row, "response_84").is_infinite();
        assert_eq!(infinite, expected[1] > 0.0, "{row:?}");
    }
    // of an oscillator with a capacity p² is the slope of its force, η g/(u_cap − u_up)
    let falling: Vec<_> = levels.iter().filter(|row| row["capacity_m"] == "0.4").collect();
    assert!((number(falling[0], "p_rad_s").powi(2) * 0.3995 / 0.980_665 - 1.0).abs() < 1e-12);
    let is_constant = |row: &&HashMap<String, String>| row["kind"] == "oscillator" && row["capacity_m"].is_empty();
    let constant: Vec<_> = levels.iter().filter(is_constant).collect();
    assert!(constant.iter().all(|row| row["im"] == "pga" && row["response"] == "u_m"), "{constant:?}");
    let fits = rows(&folder.path().join("out/fits.csv"));
    let of_block = fits.iter().find(|row| row["kind"] == "block" && row["im"] == "pga" && row["of"] == "rocking");
    assert!(of_block.unwrap()["median"].is_empty() && format!("{of_block:?}").contains("exceedances begin at level"));
    assert_eq!(rows(&folder.path().join("out/surfaces.csv")).len(), 3);

    let model = std::fs::read_to_string(folder.path().join("out/fragility.xml")).unwrap();
    assert!(model.contains("<limitStates>rocking overturning</limitStates>"), "{model}");
    let of = |id: &str, element: &str| {
        let function = model.split(&format!("id=\"{id}\"")).nth(1).unwrap_or_else(|| panic!("{id}: {model}"));
        let text = function.split(&format!("<{element}>")).nth(1).unwrap().split('<').next().unwrap();
        text.split(' ').map(|number| number.parse().unwrap()).collect::<Vec<f64>>()
    };
    let near = |found: Vec<f64>, expected: &[f64]| {
        assert!(found.len() == expected.len(), "{found:?}");
        assert!(found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{found:?} {expected:?}");
    };
    // PGA in g and PGV in cm/s, of a level 1: g tan α, and g tan α/p
    let (tangent, p_rad_s) = (0.1_f64.tan(), (0.75 * 9.806_65_f64).sqrt());
    let block = "block_R_1_m_alpha_0p1_rad_r_0p9";
    near(of(&format!("{block}_pga"), "imls imt=\"PGA\""), &[0.99 * tangent, 1.01 * tangent]);
    near(of(&format!("{block}_pgv"), "imls imt=\"PGV\""), &[0.001 * 980.665 * tangent / p_rad_s]);
    assert_eq!(of(&format!("{block}_pga"), "poes ls=\"rocking\""), [0.0, 1.0]);
    assert_eq!(of(&format!("{block}_pga"), "poes ls=\"overturning\""), [0.0, 0.5]);
    let constant = "oscillator_eta_0p1_u_up_0p0005_m_r_0p95_pga";
    assert_eq!(of(constant, "poes ls=\"overturning\""), [0.0, 0.0], "it cannot overturn");
    assert!(!model.contains("_lognormal"), "half of the motions at one level have no fit: {model}");
}

// The same block under the same records, whose components are the same motion: PGA is then that of the component.
#[test]
fn shares_are_those_of_overturning() {
    let folder = SmallStudy::new();
    folder.uplift(&["records", "synthesize", "-o", "set", "--count", "12", "-q"]).ok();
    let row = |record: u32| format!("SYN{record:03},set/SYN{record:03}_H1.AT2,set/SYN{record:03}_H1.AT2\n");
    let text: String = (1..=12).map(row).collect();
    folder.write("twice.csv", &format!("record_id,file_h1,file_h2\n{text}"));
    let (alpha, levels) = (0.1_f64, [0.9, 1.5, 2.5, 4.0, 6.0, 9.0]);
    let records = "[records]\nmanifest = \"twice.csv\"\nduplicates = \"keep\"\n";
    folder.write(
        "library.toml",
        &format!("{records}[block]\nsize_m = 1.5\nslenderness_rad = {alpha}\n[levels]\npga = {levels:?}\n"),
    );
    folder.uplift(&["library", "library.toml", "-o", "one", "--threads", "1", "-q"]).ok();
    folder.uplift(&["library", "library.toml", "-o", "two", "--threads", "2", "-q"]).ok();
    let figures = ["block-pga.svg", "block-pgv.svg"];
    for name in ["levels.csv", "fits.csv", "surfaces.csv", "fragility.xml", "pelicun.csv"].into_iter().chain(figures) {
        let [one, two] = ["one", "two"].map(|out| std::fs::read(folder.path().join(out).join(name)).unwrap());
        assert!(one == two, "{name} depends on the number of threads");
    }
    // a block rocks above PGA = g tan α: the step has a lognormal function as steep as the levels are near
    let model = std::fs::read_to_string(folder.path().join("one/fragility.xml")).unwrap();
    let parameters = model.split("_pga_lognormal").nth(1).unwrap().split("\"rocking\" mean=\"").nth(1).unwrap();
    let mean: f64 = parameters.split('"').next().unwrap().parse().unwrap();
    assert!(mean > 0.9 * alpha.tan() && mean < 1.5 * alpha.tan(), "{parameters}");
    let found: Vec<f64> = rows(&folder.path().join("one/levels.csv"))
        .iter()
        .filter(|row| row["im"] == "pga")
        .map(|row| number(row, "share_overturning"))
        .collect();

    let levels_g: Vec<f64> = levels.iter().map(|level| level * alpha.tan()).collect();
    folder.write(
        "study.toml",
        &format!(
            "title = \"same\"\n{records}[strengths]\nvalues = [0.1, 0.2]\n[pga]\nlevels_g = {levels_g:?}\n[[sites]]\n\
             name = \"Here\"\npga = \"pga.csv\"\n"
        ),
    );
    folder.write("block.toml", &format!("kind = \"block\"\nslenderness_rad = {alpha}\nsize_m = 1.5\nmass_kg = 1\n"));
    folder.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let run = folder.uplift(&["overturning", "block.toml", "--urs", "r.h5", "--json", "-q"]).ok();
    let report: Value = serde_json::from_str(&run.stdout).unwrap();
    let block = report["overturning"].as_array().unwrap().iter().find(|of| of["model"] == "block").unwrap();
    let records = block["records"].as_f64().unwrap();
    let counts = block["overturned"].as_array().unwrap().iter();
    let expected: Vec<f64> = counts.map(|count| count.as_f64().unwrap() / records).collect();
    assert!(expected[1] < 0.5 && expected[5] > 0.3, "{expected:?}");
    assert_eq!(found, expected);
}

#[test]
fn the_answer_is_short_and_mistakes_are_reported_before_the_work() {
    let folder = SmallStudy::new();
    let text = "title = \"few\"\n[records.synthetic]\npairs = 4\n[block]\nsize_m = [1, 2]\n[oscillator]\n[levels]\n\
                pga = [2, 5, 9]\npgv = [0.3, 0.9]\n";
    folder.write("library.toml", text);
    let said = folder.uplift(&["library", "library.toml"]).ok().stdout;
    assert!(said.lines().count() <= 15, "{said}");
    assert!(said.lines().take(5).any(|line| line.contains("block R 1 m, alpha 0.1 rad")), "{said}");
    assert!(said.contains("4 more systems") && said.contains("not for design"), "{said}");
    // what is there already is overwritten, but nothing of another program
    folder.uplift(&["library", "library.toml", "-q"]).ok();
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    folder.write("mine/fits.csv", "a,b\n1,2\n");
    folder.uplift(&["library", "library.toml", "-o", "mine"]).fails(2, &["mine/fits.csv", "--force"]);
    for (place, name, other) in [("a", "oscillator-pga.svg", "<svg/>"), ("b", "fragility.xml", "<nrml/>")] {
        assert!(folder.path().join("results/library").join(name).is_file(), "{said}");
        std::fs::create_dir(folder.path().join(place)).unwrap();
        folder.write(&format!("{place}/{name}"), other);
        folder.uplift(&["library", "library.toml", "-o", place]).fails(2, &[name, "--force"]);
    }
    folder.uplift(&["library", "library.toml", "-o", "out.csv"]).fails(2, &["-o names a folder"]);
    folder.write("bad.toml", "[block]\nsize_m = 0\nslenderness_rad = 2\n[levels]\nsa = 1\n");
    folder.uplift(&["library", "bad.toml"]).fails(3, &["bad.toml", "size_m", "slenderness_rad", "`sa`"]);
    folder.uplift(&["library", "absent.toml"]).fails(3, &["absent.toml", "no such file"]);
    folder.uplift(&["library", "study.toml"]).fails(3, &["it is a study, not a library: `uplift run`"]);
    folder.write("nothing.toml", "title = \"nothing\"\n");
    folder.uplift(&["library", "nothing.toml"]).fails(3, &["the library has nothing to shake"]);
    uplift(folder.path(), &["library", "library.toml", "--set", "records.first=0"]).fails(3, &["records.first"]);
}
