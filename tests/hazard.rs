//! `uplift hazard`: exports of engines become curve files that a study takes, and definitions that differ are refused.

use std::fmt::Write as _;

use crate::common::{SMALL_STUDY, SmallStudy, uplift};

/// An export as an engine writes it: probabilities in `years` of curves λ = k0 im⁻² at some sites.
pub fn openquake(kind: &str, years: f64, sites: &[(&str, f64, f64, f64)]) -> String {
    let levels = [0.5, 2.0, 20.0, 300.0];
    let mut text = format!(
        "#,,,,,,\"generated_by='OpenQuake engine 3.26.2', start_date='2026-01-01T00:00:00', checksum=1, \
         kind='{kind}', investigation_time={years}, imt='PGV'\"\n\
         custom_site_id,lon,lat,depth"
    );
    for level in levels {
        write!(text, ",poe-{level:.7}").unwrap();
    }
    text.push('\n');
    for (name, longitude, latitude, k0) in sites {
        write!(text, "{name},{longitude:.5},{latitude:.5},0.00000").unwrap();
        for level in levels {
            write!(text, ",{:.9E}", -(-years * k0 / (level * level)).exp_m1()).unwrap();
        }
        text.push('\n');
    }
    text
}

pub const SITES: [(&str, f64, f64, f64); 2] = [("here", 10.0, 45.0, 0.2), ("there", 12.0, 45.0, 0.1)];

#[test]
fn a_site_of_an_export_becomes_a_study() {
    let study = SmallStudy::new();
    study.write("export.csv", &openquake("mean", 1.0, &SITES));
    study.uplift(&["hazard", "import", "export.csv", "-o", "mine"]).fails(2, &["2 sites", "--near", "--name"]);
    study.uplift(&["hazard", "import", "export.csv", "-o", "mine", "--name", "nowhere"]).fails(4, &["nowhere", "here"]);
    study
        .uplift(&["hazard", "import", "export.csv", "-o", "mine", "--near", "0,0"])
        .fails(4, &["km away", "--within-km"]);
    study.uplift(&["hazard", "import", "export.csv", "-o", "mine", "--near", "45"]).fails(2, &["longitude first"]);
    assert!(!study.path().join("mine").exists());
    let near = ["hazard", "import", "export.csv", "-o", "mine", "--near", "11.8,45.0", "--component", "RotD50"];
    let done = study.uplift(&near).ok();
    // a degree of longitude at 45° is 78.6 km
    assert!(done.stderr.contains("nearest site: there, 15.7 km away: is that close enough?"), "{}", done.stderr);
    let swapped = study.uplift(&["hazard", "show", "export.csv", "--near", "45.0,11.8"]).ok().stderr;
    assert!(swapped.contains("--near takes longitude, then latitude"), "{swapped}");
    assert!(done.stdout.contains("[[sites]]\nname = \"there\"\npgv = \"mine/pgv.csv\""), "{}", done.stdout);
    let written = std::fs::read_to_string(study.path().join("mine/pgv.csv")).unwrap();
    for words in
        ["site: there", "longitude 12", "component: RotD50", "PGV [cm/s]", "OpenQuake engine 3.26.2", "checksum=1"]
    {
        assert!(written.contains(words), "{words}: {written}");
    }
    let rates: Vec<f64> = written
        .lines()
        .filter(|line| line.starts_with(char::is_numeric))
        .map(|line| line.split_once(',').unwrap().1.parse().unwrap())
        .collect();
    for (rate, level) in rates.iter().zip([0.5, 2.0, 20.0, 300.0_f64]) {
        // nine digits are printed of probabilities near one, where the rate is ill-conditioned
        assert!((rate / (0.1 / (level * level)) - 1.0).abs() < 1e-7, "{rate}");
    }
    // the printed lines are a study's
    study.write(
        "mine.toml",
        &format!(
            "[records]\nintensity = \"rotd50\"\nfirst = 2\n[strengths]\nvalues = 0.2\n\
        [pgv]\nlevels_cm_s = [1, 10, 100]\n{}",
            done.stdout
        ),
    );
    study.uplift(&["run", "mine.toml"]).ok();

    let shown = study.uplift(&["hazard", "show", "export.csv"]).ok().stdout;
    assert!(shown.contains("here, mean") && shown.contains("there, mean"), "{shown}");
    let shown = study.uplift(&["hazard", "show", "mine/pgv.csv"]).ok().stdout;
    // λ = -ln(1 - 0.02)/50 is exceeded at sqrt(0.1/λ)
    let level = (0.1 / (-(0.98_f64.ln()) / 50.0)).sqrt();
    assert!(shown.contains(&format!("{level:.2}")) && shown.contains("RotD50"), "{level}: {shown}");
    // curves of several files in one table
    let shown = study.uplift(&["hazard", "show", "mine/pgv.csv", "export.csv"]).ok().stdout;
    let named = |name: &str| shown.lines().filter(|line| line.starts_with(name)).count();
    assert_eq!(["mine/pgv", "here, mean", "there, mean", "curve "].map(named), [1; 4], "{shown}");
    study.uplift(&["hazard", "plot", "mine/pgv.csv", "export.csv", "-o", "curves.svg"]).ok();
    let figure = std::fs::read_to_string(study.path().join("curves.svg")).unwrap();
    assert!(figure.contains("there, mean") && figure.contains("PGV, cm/s"));
    study.uplift(&["hazard", "plot", "mine/pgv.csv", "-o", "curves.pdf"]).fails(2, &[".svg or .png"]);
}

#[test]
fn realizations_become_branches() {
    let study = SmallStudy::new();
    let site = |k0: f64| [("here", 10.0, 45.0, k0)];
    study.write("mean.csv", &openquake("mean", 50.0, &site(0.175)));
    study.write("one.csv", &openquake("rlz-000", 50.0, &site(0.2)));
    study.write("two.csv", &openquake("rlz-001", 50.0, &site(0.1)));
    study.write(
        "weights.csv",
        "#,,\"generated_by='OpenQuake engine 3.26.2'\"\nrlz_id,branch_path,weight\n0,A~x,0.75\n1,A~y,0.25\n",
    );
    let done = study
        .uplift(&[
            "hazard",
            "import",
            "mean.csv",
            "one.csv",
            "two.csv",
            "-o",
            "h",
            "--weights",
            "weights.csv",
            "--component",
            "geometric mean",
        ])
        .ok();
    assert!(done.stdout.contains("pgv = { file = \"h/pgv.csv\", branches = ["), "{}", done.stdout);
    assert!(
        done.stdout.contains("weight = 0.75") && done.stdout.contains("pgv-realization-001.csv"),
        "{}",
        done.stdout
    );
    study.write(
        "mine.toml",
        &format!("[records]\nfirst = 2\n[strengths]\nvalues = 0.2\n[pgv]\nlevels_cm_s = [3, 10, 100]\n{}", done.stdout),
    );
    study.uplift(&["run", "mine.toml"]).ok();
    let import = ["hazard", "import", "one.csv", "-o", "again"];
    study.uplift(&[&import[..], &["--weights", "weights.csv"]].concat()).fails(4, &["1 of 2 realizations", "0.75"]);
    let alone = study.uplift(&import).ok();
    assert!(
        alone.stderr.contains("no mean among the exports") && !alone.stdout.contains("[[sites]]"),
        "{}",
        alone.stderr
    );
    study.uplift(&["hazard", "import", "one.csv", "one.csv", "mean.csv", "-o", "again"]).ok();
    study.write("copy.csv", &openquake("rlz-000", 50.0, &site(0.3)));
    study
        .uplift(&["hazard", "import", "one.csv", "copy.csv", "-o", "again"])
        .fails(4, &["two curves", "realization 0"]);
}

/// The curve of a wrong unit is warned of where it is looked at, as in a check.
#[test]
fn a_hardly_possible_curve_is_warned_of_when_it_is_shown() {
    let study = SmallStudy::new();
    study.write("odd.csv", "# IM: PGV [cm/s]\niml,maf\n0.001,0.5\n0.01,0.05\n0.1,1e-5\n");
    let shown = study.uplift(&["hazard", "show", "odd.csv"]).ok().stdout;
    let words = "\nWarnings\n  mistake? odd: 0.3 cm/s is exceeded only 1.0e-5 times a year, which is hardly possible: \
                 check the unit";
    assert!(shown.contains("0.001 to 0.1") && shown.contains(words), "{shown}");
    let usual = study.uplift(&["hazard", "show", "here-pgv.csv", "--measure", "PGV", "--unit", "cm/s"]).ok().stdout;
    assert!(!usual.contains("Warnings"), "{usual}");
    // a header without a unit is that of a study, as a check takes it; numbers in m/s are asked about
    study.write("plain.csv", "PGV,rate\n0.001,1.5\n0.01,0.4\n0.1,0.01\n1,1e-5\n3,1e-7\n");
    study.write("cut.csv", "# IM: PGV [cm/s]\niml,maf\n0.5,0.1\n20,0.01\n");
    let cut = study.uplift(&["hazard", "show", "cut.csv"]).ok().stdout;
    assert!(cut.contains("ends at 20 cm/s, exceeded more often than 2 % in 50 years: is it cut short?"), "{cut}");
    let asked = study.uplift(&["hazard", "show", "plain.csv"]).ok().stdout;
    let words = ["PGV [cm/s]", "mistake? plain: the last level is 3 cm/s", "was the level meant in m/s"];
    assert!(words.iter().all(|words| asked.contains(words)), "{asked}");
    let right = study.uplift(&["hazard", "show", "plain.csv", "--unit", "m/s"]).ok().stdout;
    assert!(right.contains("0.1 to 300") && !right.contains("Warnings"), "{right}");
    // probabilities under the heading of rates
    study.write("poe.csv", "pgv_cm_s,maf\n0.5,0.99\n1,0.98\n5,0.6\n80,0.01\n300,0.0001\n");
    let doubted = study.uplift(&["hazard", "show", "poe.csv"]).ok().stdout;
    let words = "mistake? poe: its rates level off just below 1 (0.99 a year at 0.5 cm/s), as probabilities in many \
                 years do";
    assert!(doubted.contains(words) && doubted.contains("poe for maf in its head"), "{doubted}");
    // rows that are left out
    let shown = study.uplift(&["hazard", "show", "zeros.csv", "poe.csv"]).fails(4, &["zeros.csv"]).stdout;
    assert!(shown.contains("\npoe "), "{shown}");
    study.write("zeros.csv", "pgv_cm_s,PoE in 50 years\n0.1,1\n0.5,0.9\n80,0.01\n300,0.0001\n400,0\n500,0\n");
    let told = study.uplift(&["hazard", "show", "zeros.csv"]).ok();
    for dropped in ["zeros at the end of the hazard curve are left out (2)", "probabilities of 1 at the start"] {
        assert!(told.stderr.contains(&format!("zeros.csv: {dropped}")), "{}", told.stderr);
    }
}

/// One file that is no curve does not hide the others, and is named.
#[test]
fn a_curve_in_an_impossible_unit_is_named_beside_the_others() {
    let study = SmallStudy::new();
    study.write("ok.csv", "pgv_cm_s,maf\n0.5,0.8\n80,0.001\n300,0.00001\n");
    study.write("inches.csv", "PGV [in/s],maf\n0.5,0.1\n20,0.0001\n");
    let run = study.uplift(&["hazard", "show", "ok.csv", "inches.csv"]);
    let run = run.fails(4, &["inches.csv: measure PGV cannot be in \"in/s\": use cm/s or m/s"]);
    assert!(run.stdout.contains("\nok ") && run.stdout.contains("PGV [cm/s]"), "{}", run.stdout);
    study.uplift(&["hazard", "show", "inches.csv"]).fails(4, &["inches.csv: measure PGV"]);
}

#[test]
fn a_curve_of_another_definition_is_refused_unless_converted() {
    let study = SmallStudy::with(&SMALL_STUDY.replace("first = 4", "first = 2"));
    let pgv = std::fs::read_to_string(study.path().join("here-pgv.csv")).unwrap();
    let there = std::fs::read_to_string(study.path().join("there-pgv.csv")).unwrap();
    study.write("here-pgv.csv", &format!("# component: RotD50\n{pgv}"));
    study
        .uplift(&["check", "study.toml"])
        .fails(4, &["here-pgv.csv", "RotD50", "geometric mean", "conversions", "from = \"RotD50\""]);
    let converted = "hazard.conversions=[{ from = \"RotD50\", to = \"geometric mean\", pgv = 0.5 }]";
    study
        .uplift(&[
            "run",
            "study.toml",
            "--set",
            "hazard.conversions=[{ from = \"RotD50\", to = \"geometric mean\", pga = 0.5 }]",
        ])
        .fails(4, &["RotD50"]);
    let done = study.uplift(&["run", "study.toml", "--set", converted]).ok();
    // the others do not say theirs
    assert_eq!(done.code, 0);
    let warnings = study.uplift(&["warnings", "results/study.h5"]).ok().stdout;
    assert!(warnings.contains("horizontal component of 3 hazard curves not given"), "{warnings}");
    study
        .uplift(&["check", "study.toml", "--set", converted, "--set", "records.intensity=\"rotd100\""])
        .fails(4, &["RotD100"]);
    // what says something that is not understood is not passed over, and what says nothing is the geometric mean or is
    // refused
    study.write("there-pgv.csv", "# component: GMRotD50\niml,poe\n0.005,0.9\n3,0.0001\n");
    study
        .uplift(&["check", "study.toml", "--set", converted])
        .fails(4, &["there-pgv.csv, line 1", "GMRotD50", "GMRotI50"]);
    study.write("there-pgv.csv", "# IM: PGV [m/s], larger of SRSS\niml,poe\n0.005,0.9\n3,0.0001\n");
    study.uplift(&["check", "study.toml", "--set", converted]).fails(4, &["there-pgv.csv, line 1", "larger of SRSS"]);
    study.write("there-pgv.csv", &there);
    let rotated = ["check", "study.toml", "--set", "records.intensity=\"rotd50\""];
    study.uplift(&rotated).fails(4, &["site There, PGV", "does not say how", "[hazard] component"]);
    let all = ["--set", "hazard.component=\"geometric mean\"", "--set", converted];
    let done = study.uplift(&[&["run", "study.toml", "--force"][..], &all].concat()).ok();
    assert!(!done.stdout.contains("do not say"), "{}", done.stdout);
    // Half the levels at the same rates: where λ = k0 im⁻², a quarter of the rate.
    let urs = std::fs::read_to_string(study.path().join("results/study.urs.csv")).unwrap();
    study.write(
        "here-pgv.csv",
        &pgv.lines()
            .map(|line| match line.split_once(',') {
                Some((level, rate)) if level.parse::<f64>().is_ok() => {
                    format!("{},{rate}\n", 0.5 * level.parse::<f64>().unwrap())
                }
                _ => format!("{line}\n"),
            })
            .collect::<String>(),
    );
    study.uplift(&["run", "study.toml", "--force"]).ok();
    let halved = std::fs::read_to_string(study.path().join("results/study.urs.csv")).unwrap();
    let numbers = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(numbers(&urs), numbers(&halved));
    for (set, words) in [
        ("hazard.component=\"rotd51\"", &["RotD50"][..]),
        ("hazard.conversions=[{ pgv = 1 }]", &["from"]),
        ("hazard.conversions=[{ from = \"larger\", to = \"RotD50\" }]", &["factor"]),
        ("hazard.conversions=[{ from = \"larger\", to = \"RotD50\", pgv = 0 }]", &["from 0.1 to 10"]),
        (
            "hazard.conversions=[{ from = \"larger\", to = \"RotD50\", pgv = 1 }, { from = \"larger\", to = \
             \"RotD50\", pga = 1 }]",
            &["twice"],
        ),
    ] {
        study.uplift(&["check", "study.toml", "--set", set]).fails(3, words);
    }
}

#[test]
fn what_is_no_hazard() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let write = |name: &str, text: &str| std::fs::write(at.join(name), text).unwrap();
    write("plain.csv", "1,0.1\n2,0.05\n");
    write("broken.xml", "<nrml><hazardCurves>");
    write("empty.csv", "");
    uplift(at, &["hazard", "show", "absent.csv"]).fails(4, &["absent.csv"]);
    uplift(at, &["hazard", "show", "empty.csv"]).fails(4, &["empty.csv"]);
    uplift(at, &["hazard", "show", "plain.csv"]).fails(4, &["does not say its measure", "# IM: PGV [cm/s]"]);
    // blanks between numbers are no name of a column
    write("bare.txt", "1 0.1\n10 0.001\n");
    uplift(at, &["hazard", "show", "bare.txt"]).fails(4, &["does not say its measure"]);
    uplift(at, &["hazard", "show", "plain.csv", "--measure", "pgv", "--unit", "cm/s"]).fails(4, &["iml,maf"]);
    uplift(at, &["hazard", "show", "plain.csv", "--measure", "pgv", "--unit", "cm/s", "--years", "50"]).ok();
    // the unit may follow the measure without brackets; of a head that is not understood, the remedy works
    let rows = "\n1,0.9\n10,0.1\n";
    write("bare.csv", &format!("PGV cm/s,probability of exceedance in 50 years{rows}"));
    uplift(at, &["hazard", "show", "bare.csv"]).ok();
    write("head.csv", &format!("speed,chance{rows}"));
    let remedy = "PGV [cm/s],PoE in 50 years";
    for measure in [&[][..], &["--measure", "pgv"]] {
        let show = [&["hazard", "show", "head.csv"], measure].concat();
        uplift(at, &show).fails(4, &["line 1", "\"speed\"", &format!("write e.g. \"{remedy}\"")]);
    }
    write("head.csv", &format!("{remedy}{rows}"));
    uplift(at, &["hazard", "show", "head.csv"]).ok();
    write("one.csv", "PGV [cm/s]\n1\n10\n");
    uplift(at, &["hazard", "show", "one.csv"]).fails(4, &["one column", "two are needed"]);
    uplift(at, &["hazard", "show", "broken.xml"]).fails(4, &["broken.xml"]);
    uplift(at, &["hazard", "import", "plain.csv", "-o", "x"]).fails(4, &["plain.csv"]);
    assert!(!at.join("x").exists());
}
