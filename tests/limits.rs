//! What cannot be meant and what cannot fit is refused, at once and with the bound, by the built program.
//!
//! Before, most of these ran without end, filled the memory or gave numbers that mean nothing.

use std::process::Command;

use crate::common::{Finished, SMALL_STUDY, SmallStudy, command};

/// A record of 300 samples in g whose time step and peak are these.
fn record(study: &SmallStudy, name: &str, dt_s: f64, peak_g: f64) {
    let wave = |i: u32| format!("{:e} {:e}\n", f64::from(i) * dt_s, peak_g * (f64::from(i) * 0.1).sin());
    study.write(name, &(0..300).map(wave).collect::<String>());
}

#[test]
fn numbers_of_a_study_that_no_study_means() {
    let study = SmallStudy::new();
    for (setting, words) in [
        ("gravity_m_s2=1e8", &["gravity_m_s2", "from 0.1 to 2000 m/s2", "9.81 on Earth"][..]),
        ("gravity_m_s2=1e-8", &["from 0.1 to 2000"]),
        ("oscillator.post_uplift_stiffness_per_s2=1e30", &["from 1e-7 to 1e10 1/s2"]),
        ("oscillator.uplift_displacement_m=500", &["from 1e-6 to 10 m", "not in mm"]),
        ("oscillator.capacity_m=1e300", &["from 1e-6 to 1e6 m"]),
        ("oscillator.capacity_m=0.000500000001", &["stiffness after uplift", "1e10"]),
        ("oscillator.restitution=95", &["from 0 to 1", "95 % is 0.95"]),
        ("strengths.values=1e10", &["from 0 to 100", "uplift force over weight"]),
        ("strengths.values=[0.1, 1e300]", &["from 0 to 100"]),
        ("strengths.values=\"0:1e-12:1\"", &["1000000000001 values", "at most 100000"]),
        ("pgv.levels_cm_s=[1, 1e9]", &["from 1e-5 to 10000 cm/s", "not in m/s"]),
        ("pgv.levels_cm_s=\"1e-9:1e-9:200\"", &["at most 100000"]),
        ("pga.levels_g=[0.1, 4000]", &["from 1e-7 to 1000 g", "cm/s2"]),
        ("risk.thresholds_m=[0, 1e300]", &["from 0 to 10000 m"]),
        ("risk.thresholds_m=\"0.1:0.1:3\"", &["starts at 0.1 m", "start at 0"]),
        ("risk.thresholds_m=0", &["at least 2"]),
        ("risk.years=1e300", &["from 0.001 to 1e7 yr"]),
        ("records.synthetic.pairs=1000000000", &["from 1 to 10000"]),
        ("bootstrap.replicates=1000000000000", &["from 1 to 1000000"]),
        ("bootstrap.strength_above=1e300", &["from 0 to 100"]),
        ("hazard.conversions=[{ from = \"larger\", to = \"RotD50\", pgv = 1e300 }]", &["from 0.1 to 10"]),
    ] {
        study.uplift(&["check", "study.toml", "--set", setting]).fails(3, words);
    }
    // one by one plausible, together too stiff to be followed
    let stiff = ["gravity_m_s2=2000", "oscillator.uplift_displacement_m=1e-6", "strengths.values=100"];
    let stiff = stiff.iter().flat_map(|setting| ["--set", setting]);
    let check: Vec<&str> = ["check", "study.toml"].into_iter().chain(stiff).collect();
    study.uplift(&check).fails(3, &["stiffness while attached is 2e11 1/s²", "1e10 1/s²", "another unit"]);
}

// Moon, centrifuge and models on a shaking table.
#[test]
fn odd_but_legitimate_studies_pass() {
    let study = SmallStudy::new();
    for settings in [
        &["gravity_m_s2=1.62"][..],
        &["gravity_m_s2=981"],
        &["oscillator.uplift_displacement_m=1e-5", "oscillator.capacity_m=0.02"],
        &["oscillator.restitution=1", "strengths.values=[0, 5]"],
    ] {
        let settings = settings.iter().flat_map(|setting| ["--set", setting]);
        let run: Vec<&str> = ["run", "study.toml", "-o", "odd.h5", "--force"].into_iter().chain(settings).collect();
        study.uplift(&run).ok();
    }
}

#[test]
fn numbers_of_displacement_spectra() {
    let study = SmallStudy::with(
        "kind = \"displacement spectra\"\n[records.synthetic]\npairs = 2\n[[record_sets]]\nname = \"all\"\n\
         [oscillator]\n[strengths]\nvalues = [0.1, 0.3]\n[scaling]\nto = [\"unscaled\"]\n",
    );
    study.uplift(&["check", "study.toml"]).ok();
    for (setting, words) in [
        ("scaling.to=\"1e300 PGA\"", &["is not a scaling", "1e-4 to 10000"][..]),
        ("oscillator.uplift_displacement_m=1e6", &["from 1e-6 to 10 m"]),
        ("oscillator.capacity_m=[0.000500000001]", &["stiffness after uplift"]),
        ("design.safety_factor=1e300", &["from 1 to 1000", "not a percentage"]),
        ("design.width_m=1e200", &["from 0.001 to 1e6 m"]),
    ] {
        study.uplift(&["check", "study.toml", "--set", setting]).fails(3, words);
    }
}

#[test]
fn arguments_that_nobody_means() {
    let study = SmallStudy::new();
    record(&study, "ok.txt", 0.01, 0.3);
    let response = |arguments: &[&str]| -> Finished {
        study.uplift(&[&["response", "ok.txt", "--unit", "g"], arguments].concat())
    };
    let strength = ["--strength", "0.1"];
    for (option, value, words) in [
        ("--scale", "1e308", "from -1e6 to 1e6"),
        ("--free-vibration-s", "1e9", "from 0 to 3600 s"),
        ("--gravity-m-s2", "1e300", "from 0.1 to 2000 m/s2"),
        ("--uplift-displacement-m", "1e-300", "from 1e-6 to 10 m"),
        ("--uplift-displacement-m", "1e300", "from 1e-6 to 10 m"),
        ("--capacity-m", "1e300", "from 1e-6 to 1e6 m"),
        ("--post-uplift-stiffness-per-s2", "1e300", "from 1e-7 to 1e10 1/s2"),
        ("--restitution", "1.5", "from 0 to 1"),
        ("--dt-s", "1e300", "from 1e-6 to 10 s"),
    ] {
        response(&[&strength[..], &[option, value]].concat()).fails(2, &[words]);
    }
    response(&["--strength", "1e10"]).fails(2, &["strength is 1e10", "from 0 to 100"]);
    for scale in ["nan", "-1e7"] {
        response(&[&strength[..], &["--scale", scale]].concat()).fails(2, &["scale is", "from -1e6 to 1e6"]);
    }
    // all at once
    response(&["--strength", "1e10", "--scale", "1e308"]).fails(2, &["2 problems", "strength", "scale"]);
    response(&[&strength[..], &["--capacity-m", "0.000500000001"]].concat()).fails(2, &["stiffness after uplift"]);
    let stiff = ["--uplift-displacement-m", "1e-6", "--free-vibration-s", "3600", "--gravity-m-s2", "900"];
    response(&[&["--strength", "10"], &stiff[..]].concat()).fails(2, &["1e7 are computed at most"]);
    for (option, value) in [("--frequencies", "0.04,1e9"), ("--half-widths", "1e-9,1"), ("--accelerations", "1,1e300")]
    {
        study.uplift(&["pulse", option, value]).fails(2, &["from 1e-4 to 10000"]);
    }
    study.uplift(&["pulse", "--sizes-m", "1,1e12"]).fails(2, &["size is 1e12 m", "from 0.001 to 1e9 m"]);
    study.uplift(&["pulse", "--period-s", "1e6"]).fails(2, &["period is 1e6 s", "from 1e-4 to 10000 s"]);
    study.uplift(&["pulse", "--amplitude-g", "1e300"]).fails(2, &["from 1e-6 to 1000 g"]);
    study.uplift(&["records", "synthesize", "-o", "d", "--count", "1000000000"]).fails(2, &["1 to 10000"]);
}

#[test]
fn records_that_no_instrument_wrote() {
    let study = SmallStudy::with(
        &SMALL_STUDY.replace("first = 4\n[records.synthetic]\npairs = 4\n", "manifest = \"manifest.csv\"\n"),
    );
    for (name, dt_s, peak_g, words) in [
        ("slow.txt", 1e3, 0.3, "from 1e-6 to 10 s"),
        ("fast.txt", 1e-9, 0.3, "from 1e-6 to 10 s"),
        ("strong.txt", 0.01, 1e5, "is its unit right"),
        ("overflow.txt", 0.01, 1e300, "is its unit right"),
    ] {
        record(&study, name, dt_s, peak_g);
        study.write("manifest.csv", &format!("record_id,file_h1,file_h2,unit\nA,{name},{name},g\n"));
        study.uplift(&["response", name, "--unit", "g", "--strength", "0.1"]).fails(4, &[name, words]);
        study.uplift(&["run", "study.toml"]).fails(4, &[name, words]);
    }
    // one that hardly moves needs factors that make noise of it
    record(&study, "quiet.txt", 0.01, 1e-30);
    study.write("manifest.csv", "record_id,file_h1,file_h2,unit\nA,quiet.txt,quiet.txt,g\n");
    study.uplift(&["run", "study.toml"]).fails(4, &["record A", "is the unit of the record right"]);
}

#[test]
fn structures_that_nobody_builds() {
    let study = SmallStudy::new();
    let frame =
        "kind = \"frame\"\ncolumns = 4\nwidth_m = 1.6\nheight_m = 9.6\ncolumn_mass_kg = 48000\ndeck_mass_kg = 9e5\n";
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    for (old, new, words) in [
        ("deck_mass_kg = 9e5", "deck_mass_kg = 1e200", "from 0 to 1e12 kg"),
        ("columns = 4", "columns = 4000000000", "from 1 to 1e6"),
        ("width_m = 1.6", "width_m = 1e9", "from 0.001 to 1e6 m"),
        ("kind = \"frame\"", "kind = \"frame\"\ngravity_m_s2 = 1e8", "from 0.1 to 2000 m/s2"),
        ("kind = \"frame\"", "kind = \"frame\"\nuplift_displacement_m = 500", "from 1e-6 to 10 m"),
    ] {
        study.write("frame.toml", &frame.replace(old, new));
        study.uplift(&["design", "frame.toml", "--urs", "r.h5", "--site", "Here"]).fails(3, &["frame.toml", words]);
    }
}

/// `uplift ARGUMENTS` where the process may have so many kilobytes of address space.
#[cfg(target_os = "linux")]
fn with_address_space(study: &SmallStudy, kilobytes: u64, arguments: &str, limits: &str) -> (i32, String) {
    let program = command(study.path()).get_program().to_string_lossy().into_owned();
    let line = format!("ulimit -v {kilobytes} && exec {program} {arguments}");
    let mut shell = Command::new("sh");
    let output = shell.args(["-c", &line]).current_dir(study.path()).env("UPLIFT_LIMITS", limits).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    (output.status.code().unwrap_or(-1), said)
}

#[cfg(target_os = "linux")]
#[test]
fn what_does_not_fit_is_refused_before_anything_is_computed() {
    let study = SmallStudy::new();
    // 2 measures x 2 sites x 5000 strengths x 20000 thresholds x 8 bytes = 3.2 GB
    study.write(
        "large.toml",
        &SMALL_STUDY
            .replace("[0, 0.05, \"0.1:0.1:0.8\"]", "\"0.0002:0.0002:1\"")
            .replace("[0, 0.0005, \"0.01:0.01:1\"]", "\"0:0.0001:2\""),
    );
    let gigabytes = |number: u64| number << 20;
    for arguments in ["check large.toml", "run large.toml -o r.h5"] {
        let (code, said) = with_address_space(&study, gigabytes(3), &format!("{arguments} --threads 1"), "refuse");
        assert_eq!(code, 4, "{said}");
        for words in ["GB of memory are needed", "ulimit -v", "risk.maf_surface = false", "UPLIFT_LIMITS=warn"] {
            assert!(said.contains(words), "{words}\n{said}");
        }
        assert!(!study.path().join("r.h5").exists() && !study.path().join("r.h5.part").exists());
    }
    // records are not made before it is known that there is room for them
    let (code, said) = with_address_space(
        &study,
        gigabytes(3),
        "check study.toml --threads 1 --set records.synthetic.pairs=10000",
        "refuse",
    );
    assert!(code == 4 && said.contains("about 5.0 GB of memory are needed"), "{said}");
    // without the surface, and where whoever asks knows better
    let small = "run large.toml -o r.h5 --threads 1 --set risk.maf_surface=false --set strengths.values=0.3";
    let (code, said) = with_address_space(&study, gigabytes(3), small, "refuse");
    assert_eq!(code, 0, "{said}");
    let (code, said) = with_address_space(&study, gigabytes(3), "check large.toml --threads 1", "warn");
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("GB of memory are needed"), "{said}");
    let (code, said) = with_address_space(&study, gigabytes(3), "check study.toml --threads 1", "never");
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("UPLIFT_LIMITS") && said.contains("\"warn\""), "{said}");
    // every ordinate of every replicate of whole spectra
    let bootstrap = "bootstrap r.h5 --threads 1 --replicates 1000000 --simultaneous --sizes 1,2,3,4";
    let (code, said) = with_address_space(&study, gigabytes(1), bootstrap, "refuse");
    assert_eq!(code, 4, "{said}");
    assert!(said.contains("of memory are needed") && said.contains("replicates"), "{said}");
}

/// What a limit of the address space ends is refused, however much there is.
#[cfg(target_os = "linux")]
#[test]
fn no_figure_and_no_comparison_is_ended_for_want_of_memory() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    for (name, factor) in [("measured.csv", 1.0), ("computed.csv", 1.01)] {
        let rows =
            (0..200_000).map(|row| format!("{row},{}\n", factor * f64::from(row + 1))).collect::<Vec<_>>().concat();
        study.write(name, &format!("exc_id,u_m\n{rows}"));
    }
    for arguments in [
        "plot r.h5 --only urs-pgv --format png --dpi 1200 --force --threads 1",
        "validate measured.csv computed.csv --replicates 1",
    ] {
        for kilobytes in [300_000, 450_000, 600_000] {
            let (code, said) = with_address_space(&study, kilobytes, arguments, "refuse");
            assert!(code == 0 || (code == 4 && said.contains("of memory")), "{kilobytes} {arguments}: {code} {said}");
            assert!(code == 4 || kilobytes > 300_000, "{arguments}: {said}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_plan_says_what_there_is() {
    let study = SmallStudy::new();
    let said = study.uplift(&["check", "study.toml"]).ok().stdout;
    assert!(said.contains("\nMemory    ") && said.matches(" free").count() == 2, "{said}");
    let json = study.uplift(&["check", "study.toml", "--json"]).ok().stdout;
    let plan: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(plan["room"]["memory_most"]["bytes"].as_u64().unwrap() > plan["memory_bytes"].as_u64().unwrap());
    assert_eq!(plan["room"]["cannot"].as_array().unwrap().len(), 0);
}

// The system ends a program whose file grows beyond the limit, unless the program wants to hear of it.
#[cfg(unix)]
#[test]
fn the_limit_of_file_sizes_is_an_error_and_no_end() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let before = std::fs::read(study.path().join("r.h5")).unwrap();
    let program = command(study.path()).get_program().to_string_lossy().into_owned();
    for arguments in ["report r.h5", "influence r.h5", "bootstrap r.h5 --replicates 20", "export r.h5 --json"] {
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("ulimit -f 4; exec {program} {arguments}")]).current_dir(study.path());
        let done = shell.env("UPLIFT_LIMITS", "warn").output().unwrap();
        let said = String::from_utf8_lossy(&done.stderr);
        assert_eq!(done.status.code(), Some(4), "{arguments}: {said}");
        assert!(said.contains("File too large"), "{arguments}: {said}");
        assert_eq!(std::fs::read(study.path().join("r.h5")).unwrap(), before, "{arguments}");
    }
    let names = study.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let left: Vec<String> = names.filter(|name| name.starts_with('.')).collect();
    assert!(left.is_empty(), "{left:?}");
}
