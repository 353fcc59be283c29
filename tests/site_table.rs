//! Many sites: a table of them and an engine's exports become tables and a map.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;
use uplift::text::two_digits;
use uplift_labelled::LabelledReader;

use crate::common::{SMALL_STUDY, SmallStudy};

/// A site of an export: name, longitude, latitude and k0 of the curve λ = k0 im⁻²; at sea k0 is 0.
pub(crate) type Site = (&'static str, f64, f64, f64);

pub(crate) const SITES: [Site; 5] = [
    ("alpha", 10.0, 45.0, 0.2),
    ("sea", 11.0, 45.0, 0.0),
    ("beta", 12.0, 45.0, 0.1),
    ("gamma", 190.0, -20.0, 0.4),
    ("delta", 12.0, 45.2, 0.05),
];

/// An export as `OpenQuake` writes it: probabilities in one year.
pub(crate) fn openquake(measure: &str, levels: &[f64], sites: &[Site]) -> String {
    let mut text = format!(
        "#,,,,,,\"generated_by='OpenQuake engine 3.26.2', checksum=1, kind='mean', investigation_time=1.0, \
         imt='{measure}'\"\n\
         custom_site_id,lon,lat,depth"
    );
    for level in levels {
        write!(text, ",poe-{level:.7}").unwrap();
    }
    for (name, longitude, latitude, k0) in sites {
        write!(text, "\n{name},{longitude:.5},{latitude:.5},0.00000").unwrap();
        for level in levels {
            write!(text, ",{:.9E}", -(-k0 / (level * level)).exp_m1()).unwrap();
        }
    }
    text + "\n"
}

pub(crate) const PGV_LEVELS: [f64; 5] = [0.5, 2.0, 20.0, 100.0, 300.0];
pub(crate) const PGA_LEVELS: [f64; 4] = [0.01, 0.1, 1.0, 3.0];

/// Sites in another order than those of the export, one of them twice and one unknown; no hazard curve of theirs is
/// anywhere else.
const TABLE: &str = "site_id;Lon;LAT [deg];vs30;problem\n\
    Delta, Upper;12.001;45.2;0800;yes\nAlpha;10;45.004;760;\n;12.0;45.0;;\nSea;11;45;1;\nGamma;-170;-20;1;\n\
    Alpha again;10;45;2;\nNowhere;0;0;3;\n";

pub(crate) fn many(text: &str) -> SmallStudy {
    let study = SmallStudy::with(text);
    study.write("pgv-export.csv", &openquake("PGV", &PGV_LEVELS, &SITES));
    let weaker: Vec<Site> = SITES.iter().rev().map(|&(name, lon, lat, k0)| (name, lon, lat, 1e-3 * k0)).collect();
    study.write("pga-export.csv", &openquake("PGA", &PGA_LEVELS, &weaker));
    study.write("table.csv", TABLE);
    study
}

/// The small study without [[sites]].
fn without_sites() -> &'static str {
    SMALL_STUDY.split("[[sites]]").next().unwrap()
}

const SECTION: &str = "[site_table]\nsites = \"table.csv\"\npgv = \"pgv-export.csv\"\npga = \"pga-export.csv\"\n";

pub(crate) fn read(at: &Path, name: &str) -> String {
    std::fs::read_to_string(at.join(name)).unwrap()
}

/// Rows of a table by their first column, measure and probability: the columns `wanted`, as text.
pub(crate) fn rows(text: &str, wanted: &[&str]) -> BTreeMap<String, Vec<Vec<String>>> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|column| *column == name).unwrap_or_else(|| panic!("{name}"));
    let mut found: BTreeMap<String, Vec<Vec<String>>> = BTreeMap::new();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let key = ["site", "im", "poe"].map(|name| cells[column(name)]).join(" ");
        found.entry(key).or_default().push(wanted.iter().map(|name| cells[column(name)].to_owned()).collect());
    }
    found
}

#[test]
fn spectra_are_to_the_bit_those_of_the_same_curves_as_sites() {
    for contour in ["exact", "grid"] {
        let study = many(&format!(
            "{}[site_table]\npgv = \"pgv-export.csv\"\npga = \"pga-export.csv\"\n[[sites]]\nname = \"alpha\"\n\
             pgv = \"alpha/pgv.csv\"\npga = \"alpha/pga.csv\"\n[[sites]]\nname = \"delta\"\n\
             pgv = \"delta/pgv.csv\"\npga = \"delta/pga.csv\"\n",
            without_sites()
        ));
        for name in ["alpha", "delta"] {
            study.uplift(&["hazard", "import", "pgv-export.csv", "pga-export.csv", "-o", name, "--name", name]).ok();
        }
        study.uplift(&["run", "study.toml", "-o", "r.h5", "--set", &format!("risk.contour={contour}")]).ok();
        for (ours, theirs, columns) in [
            ("r.sites.csv", "r.urs.csv", &["years", "strength", "u_m", "flag"][..]),
            (
                "r.sites.coefficients.csv",
                "r.regression.csv",
                &["years", "c0_m", "c1", "c2_m", "rmse_m", "bound_active"],
            ),
        ] {
            let [ours, theirs] = [ours, theirs].map(|name| rows(&read(study.path(), name), columns));
            assert_eq!(theirs.len(), 2 * 2 * 3);
            for (key, theirs) in &theirs {
                let ours = &ours[key];
                assert_eq!(ours.len(), theirs.len(), "{key}");
                for (ours, theirs) in ours.iter().flatten().zip(theirs.iter().flatten()) {
                    match (ours.parse::<f64>(), theirs.parse::<f64>()) {
                        (Ok(ours), Ok(theirs)) => assert_eq!(ours.to_bits(), theirs.to_bits(), "{key}"),
                        _ => assert_eq!(ours, theirs, "{key}"),
                    }
                }
            }
            assert_eq!(ours.len(), if columns[1] == "strength" { 24 } else { 30 }, "the site at sea has no spectrum");
        }
    }
}

/// The three files without the provenance, which holds the time: of tables it stands beside them.
pub(crate) fn files(at: &Path, result: &str) -> [String; 3] {
    ["sites.csv", "sites.coefficients.csv", "sites.geojson"].map(|extension| {
        let text = read(at, &format!("{result}.{extension}"));
        let lines: Vec<&str> = text.lines().filter(|line| !line.contains("uplift 0")).collect();
        let within = usize::from(extension.ends_with("json"));
        assert_eq!(lines.len() + within, text.lines().count(), "{extension}");
        if within == 0 {
            assert!(read(at, &format!("{result}.{extension}-metadata.json")).contains("\"uplift 0"), "{extension}");
        }
        lines.join("\n")
    })
}

#[test]
fn any_number_of_threads_and_any_order_of_the_export_gives_the_same_bytes() {
    let study = many(&format!("{}{SECTION}", without_sites()));
    study.uplift(&["run", "study.toml", "-o", "one.h5", "--threads", "1"]).ok();
    study.uplift(&["run", "study.toml", "-o", "three.h5", "--threads", "3"]).ok();
    let one = files(study.path(), "one");
    assert!(one[0].lines().count() > 100);
    assert_eq!(one, files(study.path(), "three"));
    let mut reversed = SITES;
    reversed.reverse();
    study.write("pgv-export.csv", &openquake("PGV", &PGV_LEVELS, &reversed));
    study.uplift(&["run", "study.toml", "-o", "reversed.h5"]).ok();
    assert_eq!(one, files(study.path(), "reversed"));
    // nothing is left aside
    let left = std::fs::read_dir(study.path()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    assert_eq!(left.filter(|name| name.contains("partial")).count(), 0);
}

#[test]
fn tables_and_map_of_a_list_of_sites() {
    let study = many(&format!("{}{SECTION}strengths = [0.2, 0.4]\n", without_sites()));
    let done = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    // a number first, also where nothing is left to compute
    let again = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok().stdout;
    let arrays = cube(study.path(), "r");
    let rarest = arrays.axis::<f64>("poe").unwrap().iter().position(|poe| *poe == 0.02).unwrap();
    // seven sites × two measures × three probabilities × two strengths
    let all = arrays.array::<f64>("/urs/u_m").unwrap().values;
    let u_m: Vec<f64> = all.chunks(12).map(|site| site[2 * rarest]).filter(|own| !own.is_nan()).collect();
    let [least, most] = [u_m.iter().copied().fold(1.0, f64::min), u_m.iter().copied().fold(0.0, f64::max)];
    let range = format!("{}–{}", two_digits(least), two_digits(most));
    for said in [&done.stdout, &again] {
        assert!(said.trim_start().starts_with("Uniform risk spectra of a table of 7 sites, 2 % in 50 years"), "{said}");
        let row: Vec<&str> = said.lines().find(|line| line.starts_with("PGV ")).unwrap().split_whitespace().collect();
        assert_eq!(row[..3], ["PGV", "5", &range], "{said}");
    }
    // what it advises can be typed
    let map = done.stdout.lines().find_map(|line| line.strip_prefix("Map      uplift ")).unwrap();
    study.uplift(&map.split(' ').collect::<Vec<_>>()).ok();
    assert!(!done.stdout.contains("uplift report"), "{}", done.stdout);
    assert!(done.stderr.contains("7; 6 found in the export of PGV, 6 found in the export of PGA"), "{}", done.stderr);
    for words in ["r.sites.csv", "r.sites.coefficients.csv", "r.sites.geojson"] {
        assert!(done.stdout.contains(words), "{words}\n{}", done.stdout);
    }
    let warnings = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    for words in [
        "PGV: 1 of 7 sites have no site of pgv-export.csv within 1 km: Nowhere (0, 0) is ",
        "PGV: 1 of 7 sites have no hazard curve that can be used: Sea (11, 45): no hazard: 0 levels",
        "pga-export.csv does not say how horizontal components are combined: taken as geometric mean",
    ] {
        assert!(warnings.contains(words), "{words}\n{warnings}");
    }
    assert!(!warnings.contains("no [[sites]]"), "{warnings}");
    let spectra = read(study.path(), "r.sites.csv");
    insta::assert_snapshot!(spectra.lines().next().unwrap(), @"site,longitude,latitude,im,poe,years,strength,u_m,flag");
    // five sites, two measures, three probabilities, two strengths
    assert_eq!(spectra.lines().count(), 1 + 5 * 2 * 3 * 2);
    let coefficients = read(study.path(), "r.sites.coefficients.csv");
    let mut lines = coefficients.lines();
    insta::assert_snapshot!(
        lines.next().unwrap(),
        @"site,longitude,latitude,im,poe,years,c0_m,c1,c2_m,rmse_m,bound_active,problem,vs30,table_problem"
    );
    assert!(lines.next().unwrap().starts_with("\"Delta, Upper\",12.001,45.2,PGV,0.02,50.0,"), "{coefficients}");
    assert_eq!(coefficients.lines().count(), 1 + 7 * 2 * 3);
    assert!(coefficients.contains("Nowhere,0.0,0.0,PGA,0.5,50.0,,,,,,no site of the export within 1 km,3,\n"));
    assert!(coefficients.contains("\n3,12.0,45.0,PGV,"), "a site without a name goes by its row: {coefficients}");
    // twice the same site of the export: the same numbers
    let by_site = rows(&spectra, &["strength", "u_m", "flag"]);
    assert_eq!(by_site["Alpha PGV 0.02"], by_site["Alpha again PGV 0.02"]);
    assert_ne!(by_site["Alpha PGV 0.02"], by_site["Gamma PGV 0.02"]);

    let map: Value = serde_json::from_str(&read(study.path(), "r.sites.geojson")).unwrap();
    assert_eq!(map["type"], "FeatureCollection");
    assert!(map["provenance"].as_str().unwrap().contains("synthetic"));
    let features = map["features"].as_array().unwrap();
    let names: Vec<&str> = features.iter().map(|feature| feature["properties"]["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["Delta, Upper", "Alpha", "3", "Sea", "Gamma", "Alpha again", "Nowhere"]);
    let alpha = &features[1];
    assert_eq!((&alpha["type"], &alpha["geometry"]["type"]), (&"Feature".into(), &"Point".into()));
    assert_eq!(alpha["geometry"]["coordinates"], serde_json::json!([10.0, 45.004]));
    assert_eq!(features[4]["geometry"]["coordinates"], serde_json::json!([-170.0, -20.0]));
    let u_m = &by_site["Alpha PGV 0.02"][0][1];
    assert_eq!(alpha["properties"]["pgv_2pct_50yr_u_m_at_0.2"].as_f64().unwrap(), u_m.parse::<f64>().unwrap());
    for key in ["pga_50pct_50yr_u_m_at_0.4", "pga_10pct_50yr_c1", "pgv_2pct_50yr_c2_m", "pgv_2pct_50yr_rmse_m"] {
        assert!(alpha["properties"].as_object().unwrap().contains_key(key), "{key}");
        assert!(features[3]["properties"][key].is_null(), "{key}");
    }
    assert_eq!(features[0]["properties"]["vs30"], "0800");
    assert_eq!(features[0]["properties"]["table_problem"], "yes");
    assert_eq!(features[1]["properties"]["vs30"], 760);
    let problem = features[6]["properties"]["problem"].as_str().unwrap();
    assert_eq!(problem, "PGV: no site of the export within 1 km; PGA: no site of the export within 1 km");

    // where the numbers come from is in the result file too, and the study in it runs again
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    assert!(reader.attribute::<String>("/", "warnings").unwrap().contains("Nowhere (0, 0)"));
    let checksums = reader.attribute::<String>("/", "input_checksums").unwrap();
    for name in ["site table\"", "site table PGV\"", "site table PGA\""] {
        assert!(checksums.contains(name), "{checksums}");
    }
    study.write("again.toml", &reader.attribute::<String>("/", "study_toml").unwrap());
    study.uplift(&["run", "again.toml", "-o", "again.h5", "-q"]).ok();
    assert_eq!(files(study.path(), "r"), files(study.path(), "again"));
}

#[test]
fn every_site_of_the_first_export_where_there_is_no_table() {
    let study = many(&format!("{}[site_table]\npga = \"pga-export.csv\"\n", without_sites()));
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let coefficients = rows(&read(study.path(), "r.sites.coefficients.csv"), &["problem"]);
    assert_eq!(coefficients.len(), 5 * 3);
    assert!(coefficients["sea PGA 0.02"][0][0].starts_with("no hazard"));
    // in the order of the export
    let spectra = read(study.path(), "r.sites.csv");
    assert!(spectra.lines().nth(1).unwrap().starts_with("delta,12.0,45.2,PGA,0.02,50.0,0.0,"), "{spectra}");
    assert!(spectra.contains("\ngamma,190.0,-20.0,"));
    let map = read(study.path(), "r.sites.geojson");
    assert!(map.contains("\"coordinates\":[-170.0,-20.0]"), "{map}");
    // ordinates at all strengths in the table, at a few on the map
    assert_eq!(rows(&spectra, &["u_m"])["alpha PGA 0.1"].len(), 10);
    for key in ["pga_10pct_50yr_u_m_at_0.1\"", "pga_10pct_50yr_u_m_at_0.2\"", "pga_10pct_50yr_u_m_at_0.4\""] {
        assert!(map.contains(key), "{key}");
    }
    assert!(!map.contains("_at_0.3\""));
}

#[test]
fn curves_that_do_not_cover_the_levels_and_sites_that_overturn_are_rows_with_a_reason() {
    let study = many(&format!("{}{SECTION}", without_sites()));
    // the curve of beta ends below the last level
    let export = read(study.path(), "pgv-export.csv");
    let cut: Vec<String> = export
        .lines()
        .map(|line| match line.strip_prefix("beta") {
            Some(_) => {
                let cells: Vec<&str> = line.split(',').collect();
                format!("{},0,0", cells[..cells.len() - 2].join(","))
            }
            None => line.to_owned(),
        })
        .collect();
    study.write("pgv-export.csv", &cut.join("\n"));
    let done = study.uplift(&["run", "study.toml", "-o", "r.h5", "--set", "oscillator.capacity_m=0.002"]).ok();
    for words in [
        "2 of 7 sites have no hazard curve that can be used: 3 (12, 45): ",
        "leave the level out of pgv.levels_cm_s",
        "have ordinates that are censored",
        "have no fit",
        "1 curves of pgv-export.csv end in zeros",
    ] {
        assert!(done.stdout.contains(words) || reader_warnings(&study).contains(words), "{words}\n{}", done.stdout);
    }
    let coefficients = read(study.path(), "r.sites.coefficients.csv");
    let row = coefficients.lines().find(|line| line.starts_with("3,12.0,45.0,PGV,0.02")).unwrap();
    assert!(
        row.contains(",,,,,") && row.contains("PGV = 30 cm/s lies outside") && row.contains("leave the level out"),
        "{row}"
    );
    assert!(coefficients.contains("no fit: the spectrum is censored at strength 0.1"), "{coefficients}");
    assert!(read(study.path(), "r.sites.csv").contains(",inf,censored"));
    let map: Value = serde_json::from_str(&read(study.path(), "r.sites.geojson")).unwrap();
    let properties = &map["features"][1]["properties"];
    assert!(properties["pgv_2pct_50yr_u_m_at_0.1"].is_null());
    assert!(properties["problem"].as_str().unwrap().contains("pgv_2pct_50yr: no fit: the spectrum is censored"));
    // with a curve that goes on straight the site has a spectrum
    study.uplift(&["run", "study.toml", "-o", "r.h5", "--force", "--set", "risk.extrapolate=loglog"]).ok();
    assert!(read(study.path(), "r.sites.csv").contains("\n3,12.0,45.0,PGV,0.02"));
}

fn reader_warnings(study: &SmallStudy) -> String {
    LabelledReader::open(&study.path().join("r.h5")).unwrap().attribute::<String>("/", "warnings").unwrap()
}

#[test]
fn definitions_of_the_measure_are_kept_apart_as_for_sites() {
    let study = many(&format!("{}{SECTION}", without_sites()));
    let rotated = ["--set", "hazard.component=RotD50"];
    let check = |more: &[&str]| study.uplift(&[&["check", "study.toml"][..], &rotated, more].concat());
    let refused = check(&[]).fails(4, &["PGV", "PGA", "RotD50", "geometric mean", "conversions", "pgv = …"]);
    assert_eq!(refused.stderr.matches("the curve gives RotD50").count(), 2, "once a file:\n{}", refused.stderr);
    let half = "hazard.conversions=[{ from = \"RotD50\", to = \"geometric mean\", pgv = 0.5, pga = 0.5 }]";
    let done = check(&["--set", half, "--set", "pgv.levels_cm_s=[1, 3, 10, 30, 100]"]).ok();
    assert!(!done.stdout.contains("does not say"), "{}", done.stdout);
    // half the levels at the same rates: where λ = k0 im⁻², the spectra of a quarter of the rate
    let run = |name: &str, more: &[&str]| {
        study.uplift(&[&["run", "study.toml", "-o", name, "-q"][..], more].concat()).ok();
        rows(&read(study.path(), &name.replace("h5", "sites.csv")), &["strength", "flag", "u_m"])
    };
    let halved = run("h.h5", &[&rotated[..], &["--set", half]].concat());
    let quarter: Vec<Site> = SITES.iter().map(|&(name, lon, lat, k0)| (name, lon, lat, 0.25 * k0)).collect();
    let levels: Vec<f64> = PGV_LEVELS.iter().map(|level| 0.5 * level).collect();
    study.write("pgv-export.csv", &openquake("PGV", &levels, &quarter));
    let written = run("q.h5", &[]);
    assert_eq!(halved["Alpha PGV 0.1"], written["Alpha PGV 0.1"]);
}

/// The numbers of many sites beside a result.
fn cube(at: &Path, result: &str) -> LabelledReader {
    LabelledReader::open(&at.join(format!("{result}.sites.h5"))).unwrap()
}

#[test]
fn arrays_hold_what_the_tables_hold() {
    let study = many(&format!("{}{SECTION}strengths = [0.2, 0.4]\nbands = true\n", without_sites()));
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let reader = cube(study.path(), "r");
    let u_m = reader.array::<f64>("/urs/u_m").unwrap();
    assert_eq!(u_m.dims, ["site", "measure", "poe", "strength"]);
    assert_eq!(u_m.shape, [7, 2, 3, 2]);
    let columns = ["u_m", "lower_m", "upper_m"];
    let spectra = rows(&read(study.path(), "r.sites.csv"), &columns);
    let fits = rows(&read(study.path(), "r.sites.coefficients.csv"), &["c0_m", "c1", "c2_m", "rmse_m", "problem"]);
    let flags = reader.array::<u8>("/urs/flag").unwrap().values;
    let problems = reader.array::<String>("/urs/problem").unwrap().values;
    let [sites, measures] = ["site", "measure"].map(|axis| reader.axis::<String>(axis).unwrap());
    let poes = reader.axis::<f64>("poe").unwrap();
    for (number, &site) in ["Alpha", "3", "Sea", "Gamma", "Alpha again", "Nowhere"].iter().enumerate() {
        let place = number + 1; // a comma in the first name
        assert_eq!(sites[place], site);
        for (m, measure) in measures.iter().enumerate() {
            for (p, poe) in poes.iter().enumerate() {
                let (key, fit) = (format!("{site} {} {poe}", measure.to_uppercase()), (place * 2 + m) * 3 + p);
                for (column, name) in columns.iter().enumerate() {
                    let own = &reader.array::<f64>(&format!("/urs/{name}")).unwrap().values[2 * fit..][..2];
                    match spectra.get(&key) {
                        Some(rows) => {
                            let theirs: Vec<f64> = rows.iter().map(|row| row[column].parse().unwrap()).collect();
                            assert_eq!(own, theirs, "{key} {name}");
                        }
                        None => assert!(own.iter().all(|value| value.is_nan()), "{key} {name}"),
                    }
                }
                assert_eq!(flags[2 * fit] == 3, !spectra.contains_key(&key), "{key}");
                let theirs = &fits[&key][0];
                for (column, name) in ["c0_m", "c1", "c2_m", "rmse_m"].iter().enumerate() {
                    let own = reader.array::<f64>(&format!("/urs/{name}")).unwrap().values[fit];
                    assert_eq!(
                        theirs[column].parse::<f64>().ok(),
                        Some(own).filter(|own| !own.is_nan()),
                        "{key} {name}"
                    );
                }
                assert_eq!(theirs[4], problems[fit].split(',').next().unwrap(), "{key}");
            }
        }
    }
    study.uplift(&["verify", "r.sites.h5"]).ok();
    // and the maps are made of them
    study.uplift(&["plot", "r.h5", "--only", "map", "-o", "maps"]).ok();
    let map = read(study.path(), "maps/map-pgv-2pct.svg");
    assert!(map.contains("strength 0.2") && map.contains("longitude, °") && map.contains("synthetic records"), "{map}");
    study.uplift(&["plot", "r.h5", "--only", "map-pgv-2pct", "--strength", "0.4", "-o", "maps"]).ok();
    let map = read(study.path(), "maps/map-pgv-2pct.svg");
    assert!(map.contains("strength 0.4") && !map.contains("strength 0.2"), "{map}");
    study
        .uplift(&["plot", "r.h5", "--only", "map", "--strength", "0.3"])
        .fails(2, &["no strength 0.3: it has 0.2, 0.4"]);
    // without tables the arrays alone
    study.uplift(&["run", "study.toml", "-o", "alone.h5", "--set", "output.csv=false"]).ok();
    assert!(!study.path().join("alone.sites.csv").exists());
    assert_eq!(cube(study.path(), "alone").array::<f64>("/urs/u_m").unwrap().values.len(), u_m.values.len());
    // and another file of that name is nobody's to replace
    study.write("mine.sites.h5", "mine");
    study.uplift(&["run", "study.toml", "-o", "mine.h5"]).fails(2, &["mine.sites.h5", "already exists"]);
}

#[test]
fn slices_joined_are_the_whole_table() {
    let study = many(&format!("{}{SECTION}bands = true\n", without_sites()));
    study.uplift(&["run", "study.toml", "-o", "whole.h5"]).ok();
    let repair = ["--set", "consistency.repair=\"weights\""];
    study.uplift(&[&["run", "study.toml", "-o", "repaired.h5"][..], &repair].concat()).ok();
    for (whole, more) in [("whole", &[][..]), ("repaired", &repair)] {
        let set = [&["--set", "output.file=\"part.h5\""][..], more].concat();
        for slice in ["1/3", "2/3", "3/3"] {
            let done = study.uplift(&[&["run", "study.toml", "--force", "--sites", slice][..], &set].concat()).ok();
            // only the first of all computes stripes
            let known = slice != "1/3" || whole == "repaired";
            assert_eq!(done.stderr.contains("resumed"), known, "{}", done.stderr);
        }
        let again = study.uplift(&[&["run", "study.toml", "--sites", "2/3"][..], &set].concat()).ok();
        assert!(again.stdout.contains("done already"), "{}", again.stdout);
        // the numbers of the sites are in their files alone: a run that was killed before these computes them again
        let map = study.path().join("part.slice-2-of-3.sites.geojson");
        std::fs::remove_file(&map).unwrap();
        let again = study.uplift(&[&["run", "study.toml", "--sites", "2/3"][..], &set].concat()).ok();
        assert!(again.stderr.contains("resumed") && map.exists(), "{}", again.stderr);
        let slices = ["part.slice-3-of-3.h5", "part.slice-1-of-3.h5", "part.slice-2-of-3.h5"];
        let cubes = slices.map(|slice| slice.replace(".h5", ".sites.h5"));
        let paths = slices.into_iter().chain(cubes.iter().map(String::as_str));
        let merge: Vec<&str> =
            ["merge", "study.toml"].into_iter().chain(paths).chain(["-o", "joined.h5", "--force"]).collect();
        study.uplift(&[&merge[..], more].concat()).ok();
        assert_eq!(files(study.path(), whole), files(study.path(), "joined"));
        let [one, other] = [whole, "joined"].map(|name| cube(study.path(), name));
        let names = if more.is_empty() { &["urs"][..] } else { &["urs", "consistent"] };
        for name in names.iter().flat_map(|group| ["u_m", "lower_m", "c1"].map(|name| format!("/{group}/{name}"))) {
            let bits = |of: &LabelledReader| {
                of.array::<f64>(&name).unwrap().values.iter().map(|v| v.to_bits()).collect::<Vec<_>>()
            };
            assert_eq!(bits(&one), bits(&other), "{name}");
        }
        let [one, other] = [whole, "joined"].map(|name| study.uplift(&["warnings", &format!("{name}.h5")]).ok().stdout);
        assert_eq!(one, other.replace("joined", whole));
    }
}

#[test]
fn slices_that_do_not_make_the_table_are_refused() {
    let study = many(&format!("{}{SECTION}", without_sites()));
    for slice in ["1/3", "2/3", "3/3", "1/2"] {
        study.uplift(&["run", "study.toml", "--sites", slice, "-q"]).ok();
    }
    let [one, two, three] = [1, 2, 3].map(|number| format!("results/study.slice-{number}-of-3.h5"));
    let merge = |slices: &[&str]| study.uplift(&[&["merge", "study.toml"][..], slices, &["-o", "joined.h5"]].concat());
    merge(&[&one, &three]).fails(4, &["1 slice missing: 2/3", "--sites 2/3"]);
    let said = study.uplift(&["status", "study.toml"]).ok().stdout;
    assert!(said.contains("1 of 2; missing 2\n") && said.contains("3 of 3; ready for `uplift merge`"), "{said}");
    study.write("copy.h5", "");
    std::fs::copy(study.path().join(&one), study.path().join("copy.h5")).unwrap();
    merge(&[&one, "copy.h5", &two, &three])
        .fails(4, &["copy.h5: slice 1/3 is given twice, also as results/study.slice-1"]);
    merge(&[&one, &two, &three, "results/study.slice-1-of-2.h5"]).fails(4, &["of 2 and 3"]);
    merge(&[&one, "results/study.shard-1-of-2"]).fails(2, &["is a result, and others are shards"]);
    let other = ["merge", "study.toml", &one, &two, &three, "-o", "joined.h5", "--set", "risk.years=10"];
    study.uplift(&other).fails(4, &["slice-1-of-3.h5: is a slice of another study"]);
    study.uplift(&["run", "study.toml", "-o", "whole.h5", "-q"]).ok();
    merge(&["whole.h5", &two]).fails(4, &["whole.h5: is not a slice of a table"]);
    for ask in ["table", "spectrum"] {
        study.uplift(&[ask, "whole.h5"]).fails(4, &["not in the result, but in whole.sites.h5 and whole.sites.csv"]);
    }
    // what is refused of a table is where it can be had
    let words = ["its sites are a table: its column `verdict` needs consistency.repair"];
    study.uplift(&["consistency", "whole.h5"]).fails(4, &words);
    study.uplift(&["run", "study.toml", "-o", "of.h5", "-q", "--set", "consistency.repair=weights"]).ok();
    let words = ["their verdicts are the column `verdict` of of.sites.coefficients.csv"];
    study.uplift(&["consistency", "of.h5"]).fails(4, &words);
    // a table that was edited is not joined
    let table = "results/study.slice-2-of-3.sites.csv";
    study.write(table, &read(study.path(), table).replacen("PGV", "PGA", 1));
    merge(&[&one, &two, &three]).fails(4, &["slice-2-of-3.sites.csv: is missing, or was changed", "--again"]);
    study.uplift(&["run", "study.toml", "--sites", "2/3", "-q", "--again"]).ok();
    merge(&[&one, &two, &three]).ok();
    std::fs::remove_file(study.path().join("results/study.slice-3-of-3.sites.h5")).unwrap();
    let gone = study.uplift(&["merge", "study.toml", &one, &two, &three, "-o", "j.h5"]);
    let gone = gone.fails(4, &["slice-3-of-3.sites.h5: cannot open the file"]).stderr;
    assert_eq!(gone.matches("slice-3-of-3.sites.h5").count(), 1, "{gone}");
    study.uplift(&["run", "study.toml", "--sites", "8/8"]).fails(4, &["has 7 sites: at most 7 slices"]);
    study.uplift(&["status", "whole.sites.h5"]).fails(4, &["h5: these are the sites of a result: give a result"]);
    let plain = SmallStudy::new();
    plain.uplift(&["run", "study.toml", "--sites", "1/4"]).fails(3, &["the study has no table of sites"]);
    plain.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    plain
        .uplift(&["merge", "study.toml", "r.h5", "-o", "m.h5"])
        .fails(4, &["r.h5: is a result", "has no [site_table]"]);
    plain.uplift(&["export", "r.h5", "--csv", "--json", "-o", "e.csv"]).fails(2, &["-o takes one format, and 2 are"]);
    plain.uplift(&["bootstrap", "r.urs.csv"]).fails(3, &["it is a table, not a study", "its result is r.h5"]);
    study.uplift(&["run", "study.toml", "--sites", "0/8"]).fails(2, &["write 3/1000"]);
}

#[test]
fn mistakes_in_the_study() {
    let study = many(&format!("{}{SECTION}", without_sites()));
    for (set, words) in [
        ("site_table.sites=\"absent.csv\"", &["file not found", "absent.csv"][..]),
        ("site_table.within_km=0", &["within_km", "from 0.001 to 20040 km"]),
        ("site_table.strengths=[0.2, 0.25]", &["0.25 is not among the strengths", "nearest", "0.2"]),
        ("site_table.strengths=\"0.2:0.1\"", &["strengths"]),
        ("site_table.within=3", &["unknown key `within`", "within_km"]),
        ("site_table=3", &["a section"]),
        ("site_table.bands=3", &["bands", "true or false"]),
        ("site_table.slice=\"9/3\"", &["\"9/3\" is not a slice", "write 3/1000"]),
    ] {
        study.uplift(&["check", "study.toml", "--set", set]).fails(3, words);
    }
    study.write(
        "wrong.toml",
        &format!("{}[site_table]\nsites = \"absent.csv\"\nwithin_km = -1\nstrengths = 7\n", without_sites()),
    );
    study
        .uplift(&["check", "wrong.toml"])
        .fails(3, &["absent.csv", "within_km", "7 is not among", "no hazard curves of a measure", "pgv or pga"]);
}

#[test]
fn mistakes_in_the_files() {
    let study = many(&format!("{}{SECTION}", without_sites()));
    let check = |table: &str| {
        study.write("table.csv", table);
        study.uplift(&["check", "study.toml"])
    };
    check("name,place\nA,here\n").fails(4, &["table.csv", "columns longitude and latitude", "found name, place"]);
    check("lon,lat\n").fails(4, &["no sites"]);
    check("").fails(4, &["table.csv"]);
    check("lon,lat\n1,2\n\"3,5\",4\nx,5\n6,95\n7,\n").fails(
        4,
        &["row 2", "with a decimal point", "row 3", "\"x\"", "row 4", "are they swapped?", "row 5", "latitude is \"\""],
    );
    check("lon,lat,name\n10,45,A\n12,45,B\n10,45,a\n12,45.2,\n12,45.2,\n").fails(
        4,
        &["table.csv, row 3 below the header: site a is in row 1 too: remove one of them, or give each a name"],
    );
    check("lon,lat\n10,45\n10,45\n").ok();
    check(&format!("lon,lat\n{}", "x,y\n".repeat(30))).fails(4, &["22 more rows like these"]);
    // none of the sites: said once for each export, before anything is computed
    check("lon,lat,name\n0,0,A\n1,1,B\n")
        .fails(4, &["no site of the table has hazard", "2 of 2 sites", "A (0, 0) is 5"]);
    check("lon,lat\n45,10\n").fails(4, &["are longitude and latitude swapped?"]);
    check("lon,lat,name\n11,45,Sea\n").fails(4, &["no site of the table has hazard", "Sea (11, 45): no hazard"]);
    check("lon\tlat\n10\t45\n").ok();
    // nor one measure: its analyses would be for nothing
    let further = "pga.levels_g=[0.02, 0.1, 0.3, 5]";
    let words =
        ["no site of the table has hazard of PGA that can be used", "leave out [pga]", "PGA = 5 g lies outside"];
    for command in [&["check", "study.toml"][..], &["run", "study.toml", "-o", "r.h5"]] {
        let refused = study.uplift(&[command, &["--set", further]].concat()).fails(4, &words);
        assert!(!refused.stderr.contains("analyses"), "{}", refused.stderr);
    }

    // exports of something else, of several things, cut off; all mistakes at once
    study.write("pgv-export.csv", &openquake("PGA", &PGA_LEVELS, &SITES));
    study.write("pga-export.csv", &read(study.path(), "pga-export.csv").replace(",0.00000,", ","));
    study.uplift(&["check", "study.toml"]).fails(
        4,
        &["pgv-export.csv: has PGA, but no PGV", "pga-export.csv, line 3: 7 columns where the column names are 8"],
    );
    study.write("pgv-export.csv", "");
    study.uplift(&["check", "study.toml"]).fails(4, &["pgv-export.csv", "empty"]);
}

#[test]
fn nothing_that_is_read_is_overwritten() {
    let study = many(&format!("{}{}", without_sites(), SECTION.replace("table.csv", "mine.sites.csv")));
    study.write("mine.sites.csv", TABLE);
    study.uplift(&["run", "study.toml", "-o", "mine.h5"]).fails(2, &["mine.sites.csv", "would overwrite an input"]);
    assert_eq!(read(study.path(), "mine.sites.csv"), TABLE);
    study.uplift(&["run", "study.toml", "-o", "other.h5"]).ok();
}

#[test]
fn other_formats_of_exports() {
    let study = many(&format!("{}[site_table]\npgv = \"export.xml\"\n", without_sites()));
    let curve = |lon: f64, poes: &str| {
        format!("<hazardCurve><gml:Point><gml:pos>{lon} 45.0</gml:pos></gml:Point><poEs>{poes}</poEs></hazardCurve>")
    };
    let nrml = |statistics: &str| {
        format!(
            "<?xml version=\"1.0\"?><nrml xmlns:gml=\"http://www.opengis.net/gml\" \
             xmlns=\"http://openquake.org/xmlns/nrml/0.4\"><hazardCurves {statistics} investigationTime=\"50\" \
             IMT=\"PGV\"><IMLs>0.5 2 20 100</IMLs>{}{}</hazardCurves></nrml>",
            curve(10.0, "0.99 0.5 0.01 0.0001"),
            curve(11.0, "0 0 0 0"),
        )
    };
    study.write("export.xml", &nrml("statistics=\"mean\""));
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let warnings = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    assert!(warnings.contains("1 of 2 sites have no hazard curve that can be used: 2 (11, 45)"), "{warnings}");
    study.write("export.xml", &nrml("statistics=\"quantile\" quantileValue=\"0.15\""));
    let done = study.uplift(&["check", "study.toml"]).ok();
    assert!(done.stdout.contains("holds quantile 0.15 curves, not those of the mean hazard"), "{}", done.stdout);
}
