//! Studies by other measures than PGV and PGA, and their comparison.

use serde_json::Value;
use uplift::result::ResultFile;
use uplift_motion::IntensityMeasure;

use crate::common::{SmallStudy, array};

fn rows(json: &str) -> Vec<Value> {
    serde_json::from_str(json).unwrap()
}

/// Four synthetic pairs, at one site of spectral acceleration alone.
const BY_SA: &str = r#"title = "SA"
[records.synthetic]
pairs = 4
[strengths]
values = [0.05, 0.1, 0.2]
[measures.sa_0p5s]
levels_g = [0.02, 0.1, 0.3, 1.0]
[risk]
maf_surface = false
[[sites]]
name = "Here"
sa_0p5s = "sa.csv"
"#;

#[test]
fn a_study_of_spectral_acceleration_alone() {
    let study = SmallStudy::with(BY_SA);
    study.write("sa.csv", "# IM: SA(0.50) [g]\niml,maf\n0.01,2\n0.1,0.016\n3,1e-5\n");
    let said = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok().stdout;
    assert!(said.contains("Uniform risk spectra, 4 synthetic records, 2 % in 50 years, by SA(0.5)\n"), "{said}");
    let path = study.path().join("r.h5");
    let file = ResultFile::open(&path).unwrap();
    let half: IntensityMeasure = "sa_0p5s".parse().unwrap();
    let records = file.records().unwrap();
    let known = records.intensities(half).unwrap();
    assert_eq!(known, array(&path, "/records/sa_0p5s_g"));
    assert!(known.iter().zip(&records.pga_g).all(|(sa, pga)| (0.2..5.0).contains(&(sa / pga))), "{known:?}");
    // as a study by PGA finds it for the same factors: levels of one record's PGA over its SA
    let levels: Vec<String> =
        [0.02, 0.1, 0.3, 1.0].iter().map(|level| format!("{:?}", level / known[0] * records.pga_g[0])).collect();
    study.write(
        "pga.toml",
        &format!(
            "[records.synthetic]\npairs = 4\n[strengths]\nvalues = [0.05, 0.1, 0.2]\n[pga]\nlevels_g = [{}]\n",
            levels.join(", ")
        ),
    );
    study.uplift(&["run", "pga.toml", "-o", "pga.h5", "-q"]).ok();
    let of_first = |file: &str, key: &str| array(&study.path().join(file), &format!("/ida/{key}/edp_m"))[..12].to_vec();
    for (by_sa, by_pga) in of_first("r.h5", "sa_0p5s").into_iter().zip(of_first("pga.h5", "pga")) {
        assert!((by_sa - by_pga).abs() <= 1e-9 * by_pga, "{by_sa} {by_pga}");
    }
    study.uplift(&["bootstrap", "r.h5", "-q", "--sizes", "4", "--replicates", "10"]).ok();
    let table = study.uplift(&["table", "r.h5"]).ok().stdout;
    assert!(table.contains("SA(0.5)"), "{table}");
    study.uplift(&["table", "r.h5", "--measure", "pgv"]).fails(4, &["use --measure sa_0p5s"]);
    study.uplift(&["table", "r.h5", "--measure", "psa"]).fails(2, &["unknown intensity measure \"psa\""]);
    let status = study.uplift(&["status", "r.h5"]).ok().stdout;
    assert!(status.contains("SA(0.5)  48 analyses"), "{status}");
    // what was computed is not computed again
    let again = study.uplift(&["run", "study.toml", "-o", "r.h5", "--again"]).ok().stderr;
    assert!(again.contains("48 of 48 analyses resumed"), "{again}");
}

#[test]
fn records_that_miss_the_hazard_are_in_the_json_too() {
    let study = SmallStudy::repaired();
    let misses = &rows(&study.uplift(&["measures", "r.h5", "--json", "-q"]).ok().stdout);
    let of = |im: &str| &misses.iter().find(|row| row["im"] == im).unwrap()["misses"];
    let consistency = study.uplift(&["consistency", "r.h5", "--json", "-q"]).json();
    for im in ["PGV", "PGA"] {
        let worst = consistency["rows"].as_array().unwrap().iter().filter(|row| row["scaled_to"] == im);
        let worst = worst.max_by(|a, b| a["max"].as_f64().unwrap().total_cmp(&b["max"].as_f64().unwrap())).unwrap();
        assert_eq!([&of(im)["site"], &of(im)["bias"]], [&worst["site"], &worst["bias"]], "{im}");
        assert!(of(im)["times"].is_string(), "{}", of(im));
    }
    assert!(of("PGD").is_null(), "{}", of("PGD"));
}

// The Arias intensity grows with the square of the factor: at the squares of levels of PGV the runs are the same.
#[test]
fn levels_of_arias_intensity_are_squares() {
    let one = "[records.synthetic]\npairs = 1\n[strengths]\nvalues = [0.1, 0.3]\n";
    let study = SmallStudy::with(&format!(
        "{one}[pgv]\nlevels_cm_s = [10, 40]\n[[sites]]\nname = \"x\"\npgv = \"here-pgv.csv\"\n\
         arias = {{ file = \"arias.csv\", unit = \"m/s\" }}\n"
    ));
    study.write("arias.csv", "# IM: IA [m/s]\niml,maf\n0.00001,1\n10,1e-6\n");
    study.uplift(&["run", "study.toml", "-o", "pgv.h5", "-q"]).ok();
    let of = |file: &str, name: &str| array(&study.path().join(file), name);
    let (pgv, arias) = (of("pgv.h5", "/records/pgv_cm_s")[0], of("pgv.h5", "/records/arias_cm_s")[0]);
    let levels = [10.0, 40.0].map(|level: f64| format!("{:?}", arias * (level / pgv).powi(2))).join(", ");
    study.write("arias.toml", &format!("{one}[measures.arias]\nlevels_cm_s = [{levels}]\n"));
    study.uplift(&["run", "arias.toml", "-o", "arias.h5", "-q"]).ok();
    let [by_pgv, by_arias] =
        [("pgv", "pgv"), ("arias", "arias")].map(|(file, key)| of(&format!("{file}.h5"), &format!("/ida/{key}/edp_m")));
    for (one, other) in by_pgv.iter().zip(&by_arias) {
        assert!((one - other).abs() <= 1e-9 * one, "{by_pgv:?} {by_arias:?}");
    }
}

// PGA told of the runs by PGV, against the runs by PGA itself.
#[test]
#[ignore = "long: make test-long"]
fn a_measure_scatters_alike_in_its_own_and_in_other_runs() {
    let both = "[records.synthetic]\npairs = 40\n[strengths]\nvalues = [0.1]\n";
    let levels = "levels_cm_s = [\"0.1:0.1:0.9\", \"1:1:20\", \"25:5:200\"]\n";
    let site = "[[sites]]\nname = \"Here\"\npgv = \"here-pgv.csv\"\npga = \"pga.csv\"\n[risk]\n\
                extrapolate = \"loglog\"\nmaf_surface = false\n";
    let study = SmallStudy::with(&format!("{both}[pgv]\n{levels}{site}"));
    study.uplift(&["run", "study.toml", "-o", "pgv.h5", "-q"]).ok();
    study.write(
        "both.toml",
        &format!("{both}[pga]\nlevels_g = [\"0.002:0.002:0.018\", \"0.02:0.02:0.4\", \"0.45:0.05:2\"]\n{site}"),
    );
    study.uplift(&["run", "both.toml", "-o", "pga.h5", "-q"]).ok();
    let row = |file: &str| {
        let found =
            rows(&study.uplift(&["measures", file, "--json", "--measure", "pga", "--measure", "sa_1s"]).ok().stdout);
        let of = |im: &str| found.iter().find(|row| row["im"] == im).cloned();
        (of("PGA").unwrap(), of("SA(1.0)").unwrap())
    };
    let ((told, sa), (own, sa_of_pga)) = (row("pgv.h5"), row("pga.h5"));
    assert_eq!((&told["scaled_to"], &own["scaled_to"]), (&Value::from("PGV"), &Value::from("PGA")));
    for key in ["dispersion_initiation", "dispersion_level"] {
        for (told, own) in [(&told, &own), (&sa, &sa_of_pga)] {
            let (told, own) = (told[key].as_f64().unwrap(), own[key].as_f64().unwrap());
            assert!((told / own - 1.0).abs() < 0.06, "{key}: {told} {own}");
        }
    }
    // the axes of levels of an earlier answer go with it
    study.uplift(&["measures", "pgv.h5", "-q", "--force", "--measure", "cav"]).ok();
    let file = study.path().join("pgv.h5");
    assert!(array(&file, "/efficiency/cav/dispersion").len() > 1);
    let listed = study.uplift(&["measures", "pgv.h5", "--force", "--measure", "cav", "--json"]).ok().stdout;
    assert!(!listed.contains("SA(1.0)"));
}

// Records that are gone: what the result knows of them is compared, and the rest named.
#[test]
fn without_the_records_known_measures_are_compared() {
    let study = SmallStudy::new();
    study.uplift(&["records", "synthesize", "-o", "records", "--count", "4", "-q"]).ok();
    study.write(
        "real.toml",
        &format!(
            "{}[pgv]\nlevels_cm_s = [\"1:3:199\"]\n[[sites]]\nname = \"Here\"\npgv = \"here-pgv.csv\"\n",
            "[records]\nmanifest = \"records/manifest.csv\"\n[strengths]\nvalues = [0.1]\n"
        ),
    );
    study.uplift(&["run", "real.toml", "-o", "r.h5", "-q"]).ok();
    std::fs::rename(study.path().join("records"), study.path().join("gone")).unwrap();
    let finished = study.uplift(&["measures", "r.h5", "--json"]).ok();
    let labels: Vec<String> = rows(&finished.stdout).iter().map(|row| row["im"].as_str().unwrap().to_owned()).collect();
    assert_eq!(labels, ["PGV", "PGA"]);
    assert!(finished.stderr.contains("left out, which need the records"), "{}", finished.stderr);
}
