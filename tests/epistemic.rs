//! Sites with several weighted hazard curves: spectra of the branches, their mean and fractiles, and the joint band
//! with the bootstrap.

use serde_json::Value;
use uplift_labelled::LabelledReader;

use crate::common::{SmallStudy, repository};
use crate::site_table::{PGV_LEVELS, openquake, read};

const HEAD: &str = r#"seed = 3
[records]
first = 4
[records.synthetic]
pairs = 4
[strengths]
values = ["0.1:0.1:0.8"]
[pgv]
levels_cm_s = [1, 3, 10, 30, 100]
[risk]
poe = [0.02, 0.5]
maf_surface = false
[[sites]]
name = "Here"
"#;

/// Two power laws, one twice the other, and their mean with weights 0.3 and 0.7, which is 1.7 times the first.
fn study() -> SmallStudy {
    let study = SmallStudy::with(&format!(
        "{HEAD}[sites.pgv]\n[[sites.pgv.branches]]\nfile = \"a.csv\"\nweight = 0.3\n[[sites.pgv.branches]]\n\
         name = \"twice\"\nfile = \"b.csv\"\nweight = 0.7\n"
    ));
    for (name, factor) in [("a", 1.0), ("b", 2.0), ("mean", 1.7)] {
        let rows: Vec<String> =
            [0.5_f64, 2.0, 20.0, 300.0].iter().map(|&im| format!("{im},{:e}", 0.1 * factor * im.powi(-2))).collect();
        study.write(&format!("{name}.csv"), &format!("iml,maf\n{}\n", rows.join("\n")));
        study.write(&format!("{name}.toml"), &format!("{HEAD}pgv = \"{name}.csv\"\n"));
    }
    study
}

fn array(study: &SmallStudy, file: &str, name: &str) -> Vec<f64> {
    LabelledReader::open(&study.path().join(file)).unwrap().array::<f64>(name).unwrap().values
}

#[test]
fn branches_are_the_studies_of_their_curves() {
    let study = study();
    for name in ["study", "a", "b", "mean"] {
        study.uplift(&["run", &format!("{name}.toml"), "-o", &format!("{name}.h5"), "-q"]).ok();
        let options = ["--replicates", "101", "--sizes", "3,8", "-q"];
        study.uplift(&[&["bootstrap", &format!("{name}.h5")][..], &options[..]].concat()).ok();
    }
    let spectra = |file: &str| array(&study, file, "/urs/pgv/u_m");
    let (a, b) = (spectra("a.h5"), spectra("b.h5"));
    assert_ne!(a, b);
    assert_eq!(array(&study, "study.h5", "/epistemic/pgv/Here/u_m"), [a.clone(), b.clone()].concat());
    assert_eq!(array(&study, "study.h5", "/epistemic/pgv/Here/weight"), [0.3, 0.7]);
    // the spectrum of the site is that of the mean hazard
    assert_eq!(spectra("study.h5"), spectra("mean.h5"));
    for (index, mean) in array(&study, "study.h5", "/epistemic/pgv/Here/mean_m").into_iter().enumerate() {
        assert!((mean - (0.3 * a[index] + 0.7 * b[index])).abs() <= 1e-15 * mean);
    }
    // more hazard, more demand: the first branch is every fractile up to 30 %
    for (name, expected) in [("u05_m", &a), ("u16_m", &a), ("u50_m", &b), ("u84_m", &b), ("u95_m", &b)] {
        assert_eq!(&array(&study, "study.h5", &format!("/epistemic/pgv/Here/{name}")), expected, "{name}");
    }
    // a mixture's quantile lies between those of its parts; with 101 replicates both definitions of a quantile agree
    let mut between = 0;
    for name in ["u05_m", "u50_m", "u95_m"] {
        let joint = array(&study, "study.h5", &format!("/bootstrap/pgv/joint/Here/{name}"));
        let of = |file: &str| array(&study, file, &format!("/bootstrap/pgv/{name}"));
        for ((joint, a), b) in joint.iter().zip(of("a.h5")).zip(of("b.h5")) {
            assert!((a..=b).contains(joint), "{name}: {a} {joint} {b}");
            between += usize::from(a < *joint && *joint < b);
        }
    }
    assert!(between > 0, "the branches are mixed");
    let text = study.uplift(&["bootstrap", "study.h5", "--replicates", "20", "--details"]).ok().stdout;
    assert!(text.contains("Records and hazard together"), "{text}");
    // a spectrum has a second band, which holds those by each curve; what has one curve has one band
    let bands = |file: &str, name: &str| -> Vec<[f64; 2]> {
        let told = study.uplift(&["spectrum", file, "--json", "--strength", "0.2,0.4", "-q"]).json();
        let rows = told["displacements"].as_array().unwrap().iter();
        let limits = |band: &Value| [0, 1].map(|limit| band[limit].as_f64().unwrap());
        rows.filter(|row| !row[name].is_null()).map(|row| limits(&row[name])).collect()
    };
    assert!(bands("mean.h5", "band_with_hazard_m").is_empty());
    let with_hazard = bands("study.h5", "band_with_hazard_m");
    assert_eq!(with_hazard.len(), 2);
    let by_each = bands("a.h5", "band_m").into_iter().zip(bands("b.h5", "band_m"));
    for ([lower, upper], ([a, _], [_, b])) in with_hazard.into_iter().zip(by_each) {
        assert!(a <= lower && lower < upper && upper <= b, "{a} {lower} {upper} {b}");
    }
    let told = |more: &[&str]| study.uplift(&[&["spectrum", "study.h5"], more].concat()).ok().stdout;
    assert!(told(&[]).contains("\n  with its hazard curves  "), "{}", told(&[]));
    assert!(told(&["--strength", "0.2"]).contains("\n  with its weighted hazard curves: 90 % band "));
    assert!(told(&["--csv"]).lines().next().unwrap().ends_with(",lower_with_hazard_m,upper_with_hazard_m"));
    study.uplift(&["report", "study.h5", "-q"]).ok();
    assert!(std::fs::read_to_string(study.path().join("study.html")).unwrap().contains("with its hazard curves"));
    // the study in the file gives the same study again
    let toml =
        LabelledReader::open(&study.path().join("study.h5")).unwrap().attribute::<String>("/", "study_toml").unwrap();
    study.write("again.toml", &toml);
    study.uplift(&["run", "again.toml", "-o", "again.h5", "-q"]).ok();
    assert_eq!(array(&study, "again.h5", "/epistemic/pgv/Here/u_m"), [a, b].concat());
}

/// A branch whose file says its unit is read in that unit, as the file alone is.
#[test]
fn a_branch_in_another_unit_is_converted() {
    let study = study();
    let rows: Vec<String> =
        [0.5_f64, 2.0, 20.0, 300.0].iter().map(|&im| format!("{},{:e}", im / 100.0, 0.2 * im.powi(-2))).collect();
    study.write("b_m.csv", &format!("PGV (m/s),maf\n{}\n", rows.join("\n")));
    let text = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    study.write("metres.toml", &text.replace("b.csv", "b_m.csv"));
    let explicit = text.replace("file = \"b.csv\"", "file = \"b_m.csv\"\nunit = \"m/s\"");
    study.write("explicit.toml", &explicit);
    for name in ["study", "metres", "explicit"] {
        study.uplift(&["run", &format!("{name}.toml"), "-o", &format!("{name}.h5"), "-q"]).ok();
        let of = |name: &str| array(&study, &format!("{name}.h5"), "/epistemic/pgv/Here/u_m");
        for (found, expected) in of(name).iter().zip(of("study")) {
            assert!((found - expected).abs() <= 1e-12 * expected, "{name}: {found} {expected}");
        }
    }
    // the result keeps it: later commands read the same
    study.uplift(&["spectrum", "metres.h5"]).ok();
    assert!(study.uplift(&["run", "metres.toml", "-o", "metres.h5"]).ok().stdout.contains("done already"));
    let toml = LabelledReader::open(&study.path().join("metres.h5")).unwrap();
    study.write("again.toml", &toml.attribute::<String>("/", "study_toml").unwrap());
    study.uplift(&["check", "again.toml"]).ok();
    // the unit that the study says holds for a branch as for a file alone
    study.write(
        "said.toml",
        &text.replace("[sites.pgv]\n", "[sites.pgv]\nunit = \"cm/s\"\n").replace("b.csv", "b_m.csv"),
    );
    study.uplift(&["check", "said.toml"]).fails(4, &["b_m.csv", "m/s"]);
    // one file has one unit
    study.write("twice.toml", &text.replace("file = \"b.csv\"", "file = \"a.csv\"\nunit = \"m/s\""));
    study.uplift(&["check", "twice.toml"]).fails(3, &["a.csv is given in two units"]);
}

#[test]
fn mistakes_in_branches_are_all_said() {
    let study = study();
    let site = |branches: &str| {
        study.write("bad.toml", &format!("{HEAD}pgv = {{ branches = [{branches}] }}\n"));
        study.uplift(&["check", "bad.toml"])
    };
    site("").fails(3, &["0 branches"]);
    site("{ file = \"a.csv\", weight = 0.5 }").fails(3, &["1 branches"]);
    site("{ file = \"a.csv\", weight = 0.5 }, { file = \"b.csv\", weight = 0.6 }").fails(3, &["add up to 1.1"]);
    site("{ file = \"a.csv\" }, { weight = 0.6 }").fails(3, &["no weight", "no file"]);
    site("{ file = \"absent.csv\", weight = 0.5 }, { file = \"b.csv\", weight = 5 }")
        .fails(3, &["absent.csv", "below 1"]);
    site("{ file = \"a.csv\", weight = 0.5, name = \"x\" }, { file = \"b.csv\", weight = 0.5, name = \"x\" }")
        .fails(3, &["has this name"]);
    study.write("short.csv", "iml,maf\n2,0.1\n20,0.01\n");
    site("{ file = \"a.csv\", weight = 0.5 }, { file = \"short.csv\", weight = 0.5 }")
        .fails(4, &["short.csv", "the curve spans 2 to 20 cm/s"]);
}

/// 105 synthetic pairs at a site whose hazard is that of Montreux or that of Athens, by both measures.
pub(crate) fn two_measures(pgv: &str, pga: &str, more: &str) -> SmallStudy {
    let hazard = repository().join("hazard").display().to_string();
    let curves = |measure: &str, names: &str| {
        let of = |(name, place, weight): (&str, &str, f64)| {
            format!("{{ name = \"{name}\", file = '{hazard}/{place}/{measure}.csv', weight = {weight} }}")
        };
        let mut names = names.split(' ');
        let [first, second] = [names.next().unwrap(), names.next().unwrap()];
        format!("{measure}.branches = [{}, {}]\n", of((first, "montreux", 0.3)), of((second, "athens", 0.7)))
    };
    let curve = |measure: &str, names: &str| match names {
        place @ ("montreux" | "athens") => format!("{measure} = '{hazard}/{place}/{measure}.csv'\n"),
        names => curves(measure, names),
    };
    SmallStudy::with(&format!(
        "[strengths]\nvalues = [0.1, 0.2, 0.4]\n[pgv]\nlevels_cm_s = [\"1:0.5:20\", \"25:5:200\"]\n[pga]\n[risk]\n\
         maf_surface = false\n[hazard]\nconversions = [{{ from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, \
         pga = 1.0 }}]\n[[sites]]\nname = \"Here\"\n{}{}[consistency]\nrepair = \"weights\"\n{more}",
        curve("pgv", pgv),
        curve("pga", pga)
    ))
}

#[test]
#[ignore = "long: make test-long"]
fn every_branch_is_repaired_by_its_own_pair_of_curves() {
    let both = two_measures("north south", "north south", "");
    let printed = both.uplift(&["run", "study.toml", "-o", "r.h5"]).ok().stdout;
    let measures = ["pgv", "pga"];
    let of = |name: &str| measures.map(|measure| array(&both, "r.h5", &format!("/consistency/{measure}/{name}")));
    let branches = of("branches/Here/u_m");
    for (index, place) in ["montreux", "athens"].into_iter().enumerate() {
        let alone = two_measures(place, place, "");
        alone.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
        for (measure, branches) in measures.iter().zip(&branches) {
            let expected = array(&alone, "r.h5", &format!("/consistency/{measure}/u_m"));
            assert_eq!(branches[index * expected.len()..][..expected.len()], expected, "{place} by {measure}");
            assert_ne!(expected, array(&alone, "r.h5", &format!("/urs/{measure}/u_m")));
        }
    }
    for (mean, branches) in of("branches/Here/mean_m").iter().zip(&branches) {
        let (north, south) = branches.split_at(mean.len());
        for (mean, (north, south)) in mean.iter().zip(north.iter().zip(south)) {
            assert!((mean - (0.3 * north + 0.7 * south)).abs() <= 1e-14 * mean);
        }
    }
    assert!(!printed.contains("repaired by their mean only"), "{printed}");
    // bands of repaired numbers have no second one, and that is said
    let left_out = "the mean of the weighted hazard curves; their spread is left out";
    both.write(
        "frame.toml",
        "kind = \"frame\"\ncolumns = 4\nwidth_m = 1.6\nheight_m = 9.6\ncolumn_mass_kg = 48000\ndeck_mass_kg = 900000\n",
    );
    let frame = ["frame.toml", "--urs", "r.h5"];
    for (asked, more) in [
        (&["spectrum", "r.h5"][..], &["--repaired"][..]),
        (&["spectrum", "r.h5", "--strength", "0.2"], &["--repaired"]),
        (&[&["design"], &frame[..]].concat(), &["--repaired"]),
        (
            &[&["target"], &frame[..], &["--vary", "width", "--overturning", "1e-4", "--proxy"]].concat(),
            &["--repaired"],
        ),
    ] {
        let told = |more: &[&str]| both.uplift(&[asked, more].concat()).ok().stdout;
        assert_eq!([told(&[]), told(more)].map(|said| said.contains(left_out)), [false, true], "{asked:?}");
    }
    for command in ["overturning", "risk"] {
        let told = both.uplift(&[&[command], &frame[..]].concat()).ok().stdout;
        assert!(told.contains(left_out), "{told}");
    }
    // the same, asked of the result of a plain run
    both.uplift(&["run", "study.toml", "-o", "plain.h5", "--set", "consistency.repair=\"none\"", "-q"]).ok();
    both.uplift(&["consistency", "plain.h5", "--repair", "-q"]).ok();
    for name in ["branches/Here/u_m", "branches/Here/u50_m"] {
        let later = measures.map(|measure| array(&both, "plain.h5", &format!("/consistency/{measure}/{name}")));
        assert_eq!(later, of(name));
    }
}

#[test]
#[ignore = "long: make test-long"]
fn branches_that_are_not_the_same_are_repaired_by_their_mean_and_it_is_said() {
    let apart = two_measures("north south", "north elsewhere", "");
    apart.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let told = apart.uplift(&["consistency", "r.h5", "-q", "--details"]).ok().stdout;
    assert!(told.contains("Here by PGV: its weighted hazard curves are repaired by their mean only"), "{told}");
    let file = LabelledReader::open(&apart.path().join("r.h5")).unwrap();
    assert!(file.exists("/consistency/pgv/u_m") && !file.exists("/consistency/pgv/branches"));
}

/// A frame under twenty pairs, with the hazard that the rows `hazard` of its site say.
fn structure_study(hazard: &str) -> SmallStudy {
    let study = SmallStudy::with(&format!(
        "title = \"small\"\n[records.synthetic]\npairs = 20\n[strengths]\nvalues = [0.05, 0.1, 0.2]\n[pga]\n\
         levels_g = [0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.8, 1.2, 2]\n[bootstrap]\nreplicates = 101\n\
         [risk]\npoe = [0.5]\n[[sites]]\n\
         name = \"Here\"\n{hazard}"
    ));
    for (name, factor) in [("a", 1.0), ("b", 3.0)] {
        let row = |im: f64| format!("{im},{:e}", 2e-4 * factor * im.powf(-2.0));
        let rows: Vec<String> = [0.01, 0.1, 1.0, 4.0].map(row).to_vec();
        study.write(&format!("{name}.csv"), &format!("iml,maf\n{}\n", rows.join("\n")));
    }
    study.write(
        "frame.toml",
        "kind = \"frame\"\ncolumns = 4\nwidth_m = 0.6\nheight_m = 4\ncolumn_mass_kg = 1000\ndeck_mass_kg = 9000\n",
    );
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
}

fn two_curves(first: &str, second: &str) -> SmallStudy {
    let of = |name: &str, file: &str, weight: f64| {
        format!("[[sites.pga.branches]]\nname = \"{name}\"\nfile = \"{file}.csv\"\nweight = {weight}\n")
    };
    structure_study(&format!("[sites.pga]\n{}{}", of("first", first, 0.4), of("second", second, 0.6)))
}

fn answer(study: &SmallStudy, asked: &[&str]) -> serde_json::Value {
    let arguments = [&asked[..1], &["frame.toml", "--urs", "r.h5", "--json", "-q"], &asked[1..]].concat();
    study.uplift(&arguments).json()
}

const TARGET: [&str; 7] = ["target", "--vary", "width", "--overturning", "2e-3", "--tolerance", "0.05"];

/// The bands of a structure's numbers, `[number][limit]`: as the records tell them, and with the hazard's curves.
fn bands_of_structure(study: &SmallStudy) -> [Vec<[f64; 2]>; 2] {
    let limits = |value: &serde_json::Value| {
        let all: Vec<f64> = value.as_array().unwrap().iter().map(|limit| limit.as_f64().unwrap()).collect();
        [all[0], all[all.len() - 1]]
    };
    let design = &answer(study, &["design"])["exact"]["bands"];
    let overturning = &answer(study, &["overturning"])["overturning"][0]["sites"][0]["bands"];
    let target = answer(study, &TARGET);
    let numbers = |whose: &str, of_target: usize| {
        let own = [
            &design["demand_m"][whose],
            &design["capacity_less_demand_m"][whose],
            &design["beyond_capacity_per_year"][whose],
            &design["overturning_per_year"][whose],
            &overturning[whose],
            &target["bands"][of_target]["value"],
            &target["bands"][of_target]["per_year"],
        ];
        own.into_iter().filter(|value| !value.is_null()).map(limits).collect::<Vec<_>>()
    };
    [numbers("by_record", 0), numbers("with_hazard", 1)]
}

#[test]
#[ignore = "long: make test-long"]
fn numbers_of_a_structure_are_banded_over_the_curves_of_the_hazard() {
    let alone = ["a", "b"].map(|name| bands_of_structure(&structure_study(&format!("pga = \"{name}.csv\"\n"))));
    for [records, with_hazard] in &alone {
        assert!(records.len() == 7 && with_hazard.is_empty(), "a site with one curve has nothing to weigh");
    }
    // the same curve twice leaves what the records say
    let [records, with_hazard] = bands_of_structure(&two_curves("a", "a"));
    assert_eq!((&records, with_hazard.len()), (&alone[0][0], 7));
    for (found, expected) in with_hazard.iter().flatten().zip(records.iter().flatten()) {
        assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found} {expected}");
    }
    // limits of a mixture lie between those of its curves
    let study = two_curves("a", "b");
    let [records, with_hazard] = bands_of_structure(&study);
    assert_eq!(with_hazard.len(), 7);
    for (number, limits) in with_hazard.iter().enumerate() {
        // a curve that is not known to hold puts one end further out
        let [lower, upper] = records[number];
        assert!(limits[0] < lower || limits[1] > upper, "{number}: {:?} {limits:?}", records[number]);
        // frequencies at the value found are of another structure under another curve
        if number == 6 {
            continue;
        }
        let [of_a, of_b] = [0, 1].map(|curve: usize| alone[curve][0][number]);
        for end in [0, 1] {
            let [least, most] = [of_a[end].min(of_b[end]), of_a[end].max(of_b[end])];
            assert!((least..=most).contains(&limits[end]), "{number}: {of_a:?} {of_b:?} {limits:?}");
        }
    }
    // told in words, kept in the result, and exported
    let told = study.uplift(&["design", "frame.toml", "--urs", "r.h5", "-q", "--details"]).ok().stdout;
    assert!(told.contains("with the site's 2 hazard curves, ") && told.contains("capacity less demand"), "{told}");
    let told =
        study.uplift(&["overturning", "frame.toml", "--urs", "r.h5", "-q", "--details", "-o", "o.csv"]).ok().stdout;
    assert!(told.contains("with the site's weighted hazard curves"), "{told}");
    let table = std::fs::read_to_string(study.path().join("o.risk.csv")).unwrap();
    assert!(table.contains("maf_records_upper_per_year,maf_hazard_lower_per_year"), "{table}");
    assert!(table.contains("maf_lognormal_records_upper_per_year,maf_lognormal_hazard_lower_per_year"), "{table}");
    let told = study
        .uplift(&[&["target", "frame.toml", "--urs", "r.h5", "-q", "--details"], &TARGET[1..]].concat())
        .ok()
        .stdout;
    assert!(told.contains("records and hazard"), "{told}");
    study.uplift(&["export", "r.h5", "--json", "-o", "x.json", "-q"]).ok();
    let json = std::fs::read_to_string(study.path().join("x.json")).unwrap();
    assert!(json.contains("records and hazard"), "the answers that are kept");
}

/// What a rule asks for follows from the spectrum, and each curve has one.
#[test]
#[ignore = "long: make test-long"]
fn a_verdict_that_depends_on_the_curve_is_reported() {
    let rule = |name: &str| {
        let study = structure_study(&format!("pga = \"{name}.csv\"\n"));
        move |factor: &str| {
            answer(&study, &["design", "--spectrum-only", "--safety-factor", factor])["rules"][1]["from_spectrum"]
                .clone()
        }
    };
    let alone = ["a", "b"].map(rule);
    let [safe, unsafe_] = alone.each_ref().map(|rule| rule("1")["safety_factor"].as_f64().unwrap());
    assert!(safe > 1.01 * unsafe_ && unsafe_ > 1.0, "{safe} {unsafe_}");
    // a factor between those that the structure has by either curve
    let factor = (safe * unsafe_).sqrt().to_string();
    let [most_m, least_m] = alone.each_ref().map(|rule| rule(&factor)["margin_m"].as_f64().unwrap());
    let study = two_curves("a", "b");
    let notes =
        |factor: &str| answer(&study, &["design", "--spectrum-only", "--safety-factor", factor])["notes"].to_string();
    let told = format!("satisfied by curves of 40 % of the weight, with margins from {least_m:+.4} to {most_m:+.4} m");
    assert!(notes(&factor).contains(&format!("equal energy depends on the hazard curve: {told}")), "{told}");
    assert!(!notes("1").contains("depends on the hazard curve"), "{}", notes("1"));
}

/// Realizations of a logic tree for the sites of a table: the spread of each is that of a site with these branches.
#[test]
fn a_table_of_sites_has_the_spread_of_its_realizations() {
    let sites = |factors: [f64; 3]| {
        let [here, sea, there] = factors;
        [("here", 10.0, 45.0, 0.1 * here), ("sea", 11.0, 45.0, sea), ("there", 12.0, 45.5, 0.1 * there)]
    };
    let head = HEAD.split("[[sites]]").next().unwrap();
    let branches = "branches = [{ file = \"one.csv\", weight = 0.3 }, { file = \"two.csv\", weight = 0.7 }]";
    let table = format!("[site_table]\npgv = {{ file = \"mean.csv\", {branches} }}\n");
    let study = SmallStudy::with(&format!("{head}{table}"));
    let exports = [("mean", [1.7, 0.0, 0.51]), ("one", [1.0, 0.0, 1.0]), ("two", [2.0, 0.0, 0.3])];
    for (name, factors) in exports {
        let text = openquake("PGV", &PGV_LEVELS, &sites(factors));
        study.write("own.csv", &text);
        for site in ["here", "there"] {
            let import = ["hazard", "import", "own.csv", "-o", &format!("{name}-{site}"), "--name", site];
            study.uplift(&[&import[..], &["--component", "geometric mean"]].concat()).ok();
        }
        let kind = if name == "mean" { "mean" } else { "rlz-000" };
        study.write(&format!("{name}.csv"), &text.replace("kind='mean'", &format!("kind='{kind}'")));
    }
    let of_site = |site: &str| {
        let branches = branches.replace(".csv", &format!("-{site}/pgv.csv"));
        format!("[[sites]]\nname = \"{site}\"\npgv = {{ file = \"mean-{site}/pgv.csv\", {branches} }}\n")
    };
    study.write("alone.toml", &format!("{head}{}{}", of_site("here"), of_site("there")));
    study.uplift(&["run", "alone.toml", "-o", "alone.h5", "-q"]).ok();
    let said = study.uplift(&["run", "study.toml", "-o", "many.h5"]).ok();
    assert!(!said.stderr.contains("not those of the mean hazard"), "{}", said.stderr);
    let [poes, strengths] = [2, 8];
    let quantities = [("mean_hazard_m", "mean_m"), ("u05_hazard_m", "u05_m"), ("u84_hazard_m", "u84_m")];
    for (theirs, own) in quantities {
        let many = array(&study, "many.sites.h5", &format!("/urs/{theirs}"));
        assert_eq!(many.len(), 3 * poes * strengths);
        let [here, sea, there] = [0, 1, 2].map(|site| many[site * poes * strengths..][..poes * strengths].to_vec());
        assert_eq!(here, array(&study, "alone.h5", &format!("/epistemic/pgv/here/{own}")), "{own}");
        assert_eq!(there, array(&study, "alone.h5", &format!("/epistemic/pgv/there/{own}")), "{own}");
        assert!(sea.iter().all(|value| value.is_nan()), "{sea:?}");
    }
    let text = read(study.path(), "many.sites.csv");
    let header = text.lines().next().unwrap();
    assert!(header.ends_with(",flag,mean_hazard_m,u05_hazard_m,u16_hazard_m,u50_hazard_m,u84_hazard_m,u95_hazard_m"));
    assert_eq!(text.lines().count(), 1 + 2 * poes * strengths);
    // slices joined
    for slice in ["1/2", "2/2"] {
        study.uplift(&["run", "study.toml", "--set", "output.file=\"part.h5\"", "--sites", slice, "-q"]).ok();
    }
    study.uplift(&["merge", "study.toml", "part.slice-1-of-2.h5", "part.slice-2-of-2.h5", "-o", "joined.h5"]).ok();
    assert_eq!(read(study.path(), "joined.sites.csv"), text);
    // mistakes
    study.write("two.csv", &openquake("PGA", &PGV_LEVELS, &sites([1.0, 1.0, 1.0])));
    study.uplift(&["check", "study.toml"]).fails(4, &["two.csv", "no PGV"]);
    let wrong = |from: &str, to: &str, words: &[&str]| {
        study.write("wrong.toml", &format!("{head}{}", table.replace(from, to)));
        study.uplift(&["check", "wrong.toml"]).fails(3, words);
    };
    wrong("weight = 0.7", "weight = 0.6", &["the weights add up to 0.8999999999999999"]);
    wrong("file = \"mean.csv\",", "", &["no export of the mean hazard"]);
    wrong("pgv = {", "pgv = \"mean.csv\"\npga = {", &["the study has no spectra by PGA"]);
}
