//! `uplift response --structure`: a frame under components of a record, in a plane and wobbling.

use std::path::Path;

use serde_json::Value;

use crate::common::{Finished, repository, uplift};

/// A frame of three columns without restrainers, cylinders.
const FREE: &str = "kind = \"frame\"\ncolumns = 3\nwidth_m = 0.2\nheight_m = 1.6\ncolumn_mass_kg = 200\n\
                    deck_mass_kg = 3000\ncolumn_shape = \"cylinder\"\n";
/// The same, restrained, with stoppers.
const HELD: &str = "kind = \"restrained-frame\"\ncolumns = 3\nwidth_m = 0.2\nheight_m = 1.6\ncolumn_mass_kg = 200\n\
                    deck_mass_kg = 3000\ncolumn_shape = \"cylinder\"\ngravity_m_s2 = 9.81\n[restrainer]\n\
                    kind = \"linear\"\nstiffness_n_m = 3e5\ntendon_stiffness_n_m = 5e6\n[restrainer.stopper]\n\
                    gap_m = 0.002\nstiffness_n_m = 1e6\n";
const SAMPLES: usize = 400;
const MASS_KG: f64 = 3000.0;

/// Two components of sines, and the first one in two directions; m/s² every 0.01 s.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let record = |name: &str, of: &dyn Fn(f64) -> f64| {
        let lines: Vec<String> = (0..=SAMPLES).map(|sample| of(0.01 * sample as f64).to_string()).collect();
        std::fs::write(folder.path().join(name), lines.join("\n")).unwrap();
    };
    let a = |time_s: f64| 1.9 * (5.0 * time_s).sin() * (-0.4 * time_s).exp();
    record("a.txt", &a);
    record("b.txt", &|time_s| 1.7 * (6.5 * time_s + 0.4).sin() * (-0.3 * time_s).exp());
    record("x.txt", &|time_s| 0.6 * a(time_s));
    record("y.txt", &|time_s| 0.8 * a(time_s));
    record("up.txt", &|time_s| 0.7 * (11.0 * time_s).sin());
    std::fs::write(folder.path().join("free.toml"), FREE).unwrap();
    std::fs::write(folder.path().join("held.toml"), HELD).unwrap();
    folder
}

fn shaken(folder: &Path, frame: &str, more: &[&str]) -> Finished {
    let arguments = ["response", "--structure", frame, "--unit", "m/s2", "--dt-s", "0.01"];
    uplift(folder, &[&arguments[..], more].concat())
}

fn number(run: &Value, key: &str) -> f64 {
    run[key].as_f64().unwrap_or_else(|| panic!("{key}: {run}"))
}

/// A block is a frame of one column that carries nothing: two crates, one answer.
#[test]
fn a_block_as_a_frame_is_the_block() {
    let folder = folder();
    std::fs::write(
        folder.path().join("block.toml"),
        "kind = \"block\"\nwidth_m = 0.3\nheight_m = 1.8\nmass_kg = 500\n",
    )
    .unwrap();
    let own = shaken(folder.path(), "block.toml", &["--h1", "a.txt", "--json"]);
    let frame = own.json();
    let arguments = ["response", "a.txt", "--unit", "m/s2", "--dt-s", "0.01", "--block", "--width-m", "0.3"];
    let block = uplift(folder.path(), &[&arguments[..], &["--height-m", "1.8", "--json"]].concat()).json();
    assert_eq!((&frame["model"], &frame["restitution_from"]), (&"planar".into(), &"momentum".into()));
    assert_eq!(frame["runs"].as_array().unwrap().len(), 1);
    let run = &frame["runs"][0];
    for key in ["peak_rotation_rad", "time_of_uplift_s", "time_of_peak_s"] {
        let (one, other) = (number(run, key), number(&block, key));
        assert!(one > 0.0 && (one / other - 1.0).abs() < 1e-9, "{key}: {one} {other}");
    }
    assert!((number(&frame, "restitution") / number(&block, "restitution") - 1.0).abs() < 1e-12);
    assert_eq!(run["impacts"], block["impacts"]);
    // in words of a block
    let said = shaken(folder.path(), "block.toml", &["--h1", "a.txt"]).ok().stdout;
    assert!(said.contains("block     block: 1.8 m high, ") && said.contains("under h1: the top moves "), "{said}");
    assert!(!said.contains("deck") && !said.contains("column"), "{said}");
}

#[test]
fn beyond_the_yield_of_its_tendons_a_frame_is_cautioned() {
    let folder = folder();
    let weak = |yield_n: &str| HELD.replace("[restrainer.stopper]", &format!("tendon_yield_n = {yield_n}\n$0"));
    let said = |yield_n: &str| {
        let text = weak(yield_n).replace("$0", "[restrainer.stopper]");
        std::fs::write(folder.path().join("weak.toml"), text).unwrap();
        shaken(folder.path(), "weak.toml", &["--h1", "a.txt", "--scale", "2"]).ok().stdout
    };
    let caution = "note      tendons stay elastic in this model: from ";
    assert!(said("100").contains(caution) && !said("1e9").contains(caution), "{}", said("100"));
}

/// Shaking along one line is planar motion in that line; swapping the components reflects the path.
#[test]
fn directions_are_what_they_are_called() {
    let folder = folder();
    let elastic = ["--restitution", "1", "--rest-amplitude-rad", "1e-5", "--json"];
    let wobbling =
        shaken(folder.path(), "held.toml", &[&["--h1", "x.txt", "--h2", "y.txt"], &elastic[..]].concat()).json();
    let planar =
        shaken(folder.path(), "held.toml", &[&["--h2", "a.txt", "--model", "planar"], &elastic[..]].concat()).json();
    assert_eq!((&wobbling["model"], &wobbling["runs"][0]["under"]), (&"wobbling".into(), &"h1 and h2".into()));
    assert_eq!(planar["runs"][0]["under"], "h2");
    let u_m = number(&planar["runs"][0], "peak_displacement_m");
    for (key, share) in [("peak_displacement_m", 1.0), ("peak_displacement_x_m", 0.6), ("peak_displacement_y_m", 0.8)] {
        let found = number(&wobbling["runs"][0], key);
        assert!(u_m > 0.01 && (found / (share * u_m) - 1.0).abs() < 1e-7, "{key}: {found} {u_m}");
    }
    let pair = |h1: &str, h2: &str| shaken(folder.path(), "held.toml", &["--h1", h1, "--h2", h2, "--json"]).json();
    let (one, other) = (pair("a.txt", "b.txt"), pair("b.txt", "a.txt"));
    let (one, other) = (&one["runs"][0], &other["runs"][0]);
    for (key, mirrored) in [
        ("peak_displacement_m", "peak_displacement_m"),
        ("peak_displacement_x_m", "peak_displacement_y_m"),
        ("peak_tendon_n", "peak_tendon_n"),
    ] {
        let (one, other) = (number(one, key), number(other, mirrored));
        assert!((one / other - 1.0).abs() < 1e-6, "{key}: {one} {other}");
    }
    // in the plane both components come in turn
    let both = shaken(
        folder.path(),
        "held.toml",
        &["--h1", "a.txt", "--h2", "b.txt", "--v", "up.txt", "--model", "planar", "--json"],
    )
    .json();
    let under: Vec<&str> = both["runs"].as_array().unwrap().iter().map(|run| run["under"].as_str().unwrap()).collect();
    assert_eq!(under, ["h1", "h2"]);
    assert_eq!(both["components"].as_array().unwrap().len(), 3);
    // the vertical component changes it
    let without = shaken(folder.path(), "held.toml", &["--h1", "a.txt", "--model", "planar", "--json"]).json();
    assert!(number(&without["runs"][0], "peak_displacement_m") != number(&both["runs"][0], "peak_displacement_m"));
}

/// Rows lie on the laws: `T = k Δ` until the stopper, base shear, `M = N b`, and nothing exceeds the peaks.
#[test]
fn a_history_row_by_row() {
    let folder = folder();
    let more = ["--h1", "a.txt", "--h2", "b.txt", "--v", "up.txt", "--history", "h.csv", "--json"];
    let report = shaken(folder.path(), "held.toml", &more).json();
    let run = &report["runs"][0];
    assert_eq!(run["events"][0]["event"], "stopper-engages");
    let text = std::fs::read_to_string(folder.path().join("h.csv")).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(header.len(), 22);
    let place = |name: &str| header.iter().position(|column| *column == name).unwrap();
    let (mut largest, mut closed) = ([0.0_f64; 3], 0);
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let at = |name: &str| cells[place(name)].parse::<f64>().unwrap_or(f64::NAN);
        let (x, y) = (at("displacement_x_m"), at("displacement_y_m"));
        largest[0] = largest[0].max(x.hypot(y));
        largest[1] = largest[1].max(at("tendon_n"));
        largest[2] = largest[2].max(at("spring_m"));
        let deck = at("deck_acceleration_x_m_s2").hypot(at("deck_acceleration_y_m_s2"));
        assert!((at("base_shear_n") - MASS_KG * deck).abs() < 1e-9 * MASS_KG * deck.max(1.0));
        if at("rotation_rad") == 0.0 {
            assert!(cells[place("top_axial_n")].is_empty());
            closed += 1;
            continue;
        }
        assert!((at("top_moment_n_m") / at("top_axial_n") - 0.1).abs() < 1e-12);
        // P = m_d (g + a_z), and the column's own weight with half the deck's acceleration
        let (up, ground) = (at("deck_acceleration_z_m_s2"), at("ground_acceleration_z_m_s2"));
        let base_n = 1000.0 * (9.81 + up) + 200.0 * (9.81 + 0.5 * (up + ground));
        assert!((at("base_axial_n") / base_n - 1.0).abs() < 1e-12);
        // Δ = 2b sin(θ/2), and spring and tendon share it
        let elongation_m = 0.2 * (0.5 * at("rotation_rad")).sin();
        assert!((at("spring_m") + at("tendon_n") / 5e6 - elongation_m).abs() < 1e-12);
        let stopped_n = 1e6 * (at("spring_m") - 0.002).max(0.0);
        assert!((at("tendon_n") - 3e5 * at("spring_m") - stopped_n).abs() < 1e-6);
    }
    assert!(closed > 0);
    for (key, largest) in ["peak_displacement_m", "peak_tendon_n", "peak_spring_m"].into_iter().zip(largest) {
        let peak = number(run, key);
        assert!(largest > 0.9 * peak && largest <= peak * (1.0 + 1e-12), "{key}: {largest} {peak}");
    }
    assert!((number(run, "peak_drift") * 1.6 / number(run, "peak_displacement_m") - 1.0).abs() < 1e-12);
}

#[test]
fn an_overturned_frame_is_said_and_drawn_with_what_the_model_leaves_out() {
    let folder = folder();
    let more = ["--h1", "a.txt", "--h2", "b.txt", "--scale", "4"];
    let run =
        shaken(folder.path(), "free.toml", &[&more[..], &["--plot", "p.svg", "--history", "h.csv"]].concat()).ok();
    assert!(
        run.stdout.contains("under h1 and h2: overturned, after") && run.stdout.contains("torsion"),
        "{}",
        run.stdout
    );
    let svg = std::fs::read_to_string(folder.path().join("p.svg")).unwrap();
    assert!(svg.contains("displacement along h2, m") && svg.contains("base shear, kN") && !svg.contains("tendon"));
    let text = std::fs::read_to_string(folder.path().join("h.csv")).unwrap();
    assert!(text.trim_end().ends_with("overturned") && !text.contains("NaN"), "{}", &text[text.len() - 200..]);
    let report = shaken(folder.path(), "free.toml", &[&more[..], &["--json"]].concat()).json();
    let run = &report["runs"][0];
    assert!(run["peak_displacement_m"].is_null() && run["peak_drift"].is_null() && run["overturned"] == true);
    assert!(run["peak_tendon_n"].is_null() && report["notes"][0].as_str().unwrap().contains("torsion"));
    // what stays below the threshold says so
    let still = shaken(folder.path(), "free.toml", &["--h1", "a.txt", "--scale", "0.1"]).ok();
    assert!(still.stdout.contains("never uplifts"), "{}", still.stdout);
}

#[test]
fn wrong_arguments_are_refused() {
    let folder = folder();
    let at = folder.path();
    std::fs::write(at.join("square.toml"), FREE.replace("cylinder", "rectangle")).unwrap();
    std::fs::write(at.join("mass.toml"), "kind = \"point-mass\"\nmass_kg = 1\nwidth_m = 1\ncentre_height_m = 4\n")
        .unwrap();
    shaken(at, "square.toml", &["--h1", "a.txt", "--h2", "b.txt", "--model", "wobbling"])
        .fails(2, &["rectangular section", "column_shape"]);
    shaken(at, "mass.toml", &["--h1", "a.txt"]).fails(2, &["mass.toml", "point-mass", "restrained-frame"]);
    std::fs::write(at.join("wide.toml"), "kind = \"block\"\nwidth_m = 5\nheight_m = 2\nmass_kg = 1\n").unwrap();
    shaken(at, "wide.toml", &["--h1", "a.txt"]).fails(3, &["wide.toml: slenderness alpha is 1.19029 rad"]);
    shaken(at, "held.toml", &[]).fails(2, &["--h1"]);
    shaken(at, "held.toml", &["a.txt"]).fails(2, &["write --h1 a.txt"]);
    let missing = shaken(at, "held.toml", &["--h1", "none.txt"]).fails(4, &["none.txt: there is no such file"]);
    assert_eq!(missing.stderr.matches("none.txt").count(), 1, "{}", missing.stderr);
    shaken(at, "held.toml", &["--h1", "a.txt", "--h2", "b.txt", "--channel", "1"])
        .fails(2, &["--channel", "2 components"]);
    shaken(at, "held.toml", &["--h1", "a.txt", "--history", "a.txt"]).fails(2, &["a.txt"]);
    shaken(at, "held.toml", &["--h1", "a.txt", "--plot", "held.toml", "--force"]).fails(2, &["held.toml"]);
    shaken(at, "held.toml", &["--h1", "a.txt", "--model", "twisting"]).fails(2, &["planar or wobbling"]);
    shaken(at, "held.toml", &["--h1", "a.txt", "--rest-amplitude-rad", "1"])
        .fails(2, &["amplitude of rest", "0.1 rad"]);
    shaken(at, "held.toml", &["--h1", "a.txt", "--strength", "0.2"]).fails(2, &["--strength"]);
    shaken(at, "held.toml", &["--h1", "a.txt", "--gravity-m-s2", "9"]).fails(2, &["--gravity-m-s2"]);
    shaken(at, "held.toml", &["--v", "up.txt", "--h1", "up.txt", "--scale", "30"]).fails(2, &["leave the ground"]);
    uplift(at, &["response", "a.txt", "--h1", "b.txt"]).fails(2, &["--structure"]);
}

/// What is allowed but hardly meant is said, and what would have no effect is refused.
#[test]
fn slips_of_files_and_units() {
    let folder = folder();
    let notes =
        |more: &[&str]| shaken(folder.path(), "held.toml", &[more, &["--json"]].concat()).json()["notes"].to_string();
    let twice = notes(&["--h1", "a.txt", "--h2", "a.txt"]);
    assert!(twice.contains("h1 and h2 are the same motion: is one of them a mistake?"), "{twice}");
    let pair = notes(&["--h1", "a.txt", "--h2", "b.txt"]);
    assert!(!pair.contains("the same motion") && !pair.contains("close by the upright"), "{pair}");
    // a real frame under a record passes through a hundredth of its largest rotation
    uplift(folder.path(), &["records", "synthesize", "-o", "d", "--count", "1", "-q"]).ok();
    let prototype = repository().join("configs/structures/prototype.toml").display().to_string();
    let ask = ["response", "--structure", &prototype, "--h1", "d/SYN001_H1.AT2", "--h2", "d/SYN001_H2.AT2", "--json"];
    let record = uplift(folder.path(), &ask).json();
    let (run, notes) = (&record["runs"][0], record["notes"].to_string());
    assert!(number(run, "least_rotation_rad") < 0.01 * run["peak_rotation_rad"].as_f64().unwrap_or(f64::INFINITY));
    assert!(notes.contains("passes close by the upright") && notes.contains("base shear"), "{notes}");
    // a file that says its step and unit takes no other
    let lines: Vec<String> = (0..200).map(|sample| format!("{:.5}", 0.2 * (0.05 * f64::from(sample)).sin())).collect();
    let head = "PEER NGA\nSome Event, 1/2/1999, A Station, 90\nACCELERATION TIME SERIES IN UNITS OF G\n\
                NPTS=   200, DT=   .0100 SEC\n";
    std::fs::write(folder.path().join("a.AT2"), format!("{head}{}\n", lines.join(" "))).unwrap();
    shaken(folder.path(), "held.toml", &["--h1", "a.AT2"]).fails(2, &["--dt-s and --unit", "a.AT2 (at2)", "its own"]);
    // beside one that does not, they are for that one
    shaken(folder.path(), "held.toml", &["--h1", "a.AT2", "--h2", "b.txt"]).ok();
    for system in [&["--strength", "0.1"][..], &["--block", "--width-m", "0.2", "--height-m", "1.6"]] {
        let ask = |more: &[&str]| uplift(folder.path(), &[&["response", "a.AT2"], system, more].concat());
        ask(&["--unit", "g"]).fails(2, &["--unit of a record that states its own"]);
        ask(&[]).ok();
    }
}
