//! Confidence bands of repaired spectra: every replicate has weights of its own.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use uplift::JobError;
use uplift::bootstrap::resampling_plan;
use uplift::bootstrap::{BootstrapOptions, bootstrap};
use uplift::events::{Events, Phase, Silent};
use uplift::result::{ResultFile, StoredStripes};
use uplift_consistency::{KNOTS, RecordSet, ScaledAnalysis, Scratch, Seismology, SetRecord, Solver};
use uplift_hazard::Extrapolation;
use uplift_risk::{RiskCurve, RunWeights};

use crate::common::{SmallStudy, array, repository, same_bits};

/// What a job that failed says.
fn job_error<T, E: std::error::Error + 'static>(outcome: &Result<T, E>) -> Option<&JobError> {
    uplift::cause(outcome.as_ref().err()?)
}

/// 105 synthetic pairs at Montreux, two strengths, coarse stripes.
fn study() -> SmallStudy {
    let [pgv, pga] = ["pgv", "pga"].map(|key| repository().join(format!("hazard/montreux/{key}.csv")));
    let study = SmallStudy::with(&format!(
        "[strengths]\nvalues = [0.1, 0.3]\n[pgv]\nlevels_cm_s = [\"1:1:20\", \"25:10:205\"]\n[pga]\nlevels_g = \
         [\"0.01:0.02:0.31\", \"0.35:0.1:2.05\"]\n[consistency]\nrepair = \"weights\"\n[risk]\nmaf_surface = false\n\
         [hazard]\nconversions = [{{ from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, pga = 1.0 }}]\n\
         [[sites]]\nname = \"Montreux\"\npgv = '{}'\npga = '{}'\n",
        pgv.display(),
        pga.display()
    ));
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
}

const ARRAYS: [&str; 6] = ["u05_m", "u50_m", "u95_m", "e_median", "r_90ci", "failed"];

fn bands(file: &Path) -> Vec<f64> {
    let of_measure = |key| ARRAYS.map(|name| array(file, &format!("/bootstrap/{key}/consistent/{name}"))).concat();
    ["pgv", "pga"].map(of_measure).concat()
}

// One replicate of a size is its own median: the ordinate of these records under the weights that are solved for them.
#[test]
fn a_replicate_is_weighed_by_weights_of_its_own() {
    let study = study();
    study.uplift(&["bootstrap", "r.h5", "-q", "--sizes", "60,105", "--replicates", "1"]).ok();
    let status = study.uplift(&["status", "r.h5"]).ok().stdout;
    assert!(status.contains("\n  added    repair, bootstrap\n"), "{status}");
    let path = study.path().join("r.h5");
    let file = ResultFile::open(&path).unwrap();
    let (records, stripes, hazard) =
        (file.records().unwrap(), StoredStripes::read(&file).unwrap(), file.hazard().unwrap());
    let plan = resampling_plan(&file).unwrap().unwrap();
    for (own, other) in [(0, 1), (1, 0)] {
        let measure = &stripes.measures[own];
        let [x, y] = [own, other].map(|at| records.intensities(stripes.measures[at].measure).unwrap());
        let row = |(pair, (&scaled_to, &other)): (usize, (&f64, &f64))| {
            let seismology = Seismology::default();
            SetRecord { scaled_to, other, pair, event: None, seismology }
        };
        let set = RecordSet::new(x.iter().zip(y).enumerate().map(row).collect()).unwrap();
        let [of_x, of_y] = [own, other].map(|at| &hazard[at].sites[0].curve);
        let targets = &stripes.targets_per_year;
        let analysis = ScaledAnalysis::new(&set, &measure.levels, of_x, of_y, targets, Extrapolation::Refuse).unwrap();
        let solver = Solver::new(&analysis, 0.05).unwrap();
        let mut scratch = Scratch::default();
        let of_set = solver.solve(&set.once(), &[0.0; KNOTS], &mut scratch).unwrap();
        let median = array(&path, &format!("/bootstrap/{}/consistent/u50_m", measure.measure.key()));
        let plain = array(&path, &format!("/bootstrap/{}/u50_m", measure.measure.key()));
        for (size, sample) in plan.samples().iter().enumerate() {
            let drawn = sample.multiplicities();
            let fit = solver.solve(drawn, &of_set.exponents, &mut scratch).unwrap();
            let mut shares = analysis.own_shares();
            solver.shares(drawn, &fit.exponents, &mut scratch, &mut shares).unwrap();
            let weights = RunWeights::new(analysis.stripes(), &shares).unwrap();
            for strength in 0..2 {
                let demand = measure.demand(strength).unwrap();
                let ordinates = RiskCurve::weighted(&demand, &weights).unwrap().exact_ordinates(targets).unwrap();
                for (poe, ordinate) in ordinates.iter().enumerate() {
                    let place = (poe * plan.sizes().len() + size) * 2 + strength;
                    assert_eq!(median[place].to_bits(), ordinate.displacement_m.to_bits());
                    assert_ne!(median[place].to_bits(), plain[place].to_bits(), "as if there were no weights");
                }
            }
        }
    }
}

#[test]
#[ignore = "long: make test-long"]
fn they_stand_beside_the_plain_bands_and_hang_on_no_thread() {
    let study = study();
    let options = ["-q", "--sizes", "40,105", "--replicates", "60", "--simultaneous"];
    let run = |file: &str, more: &[&str]| study.uplift(&[&["bootstrap", file][..], &options, more].concat()).ok();
    for copy in ["one.h5", "plain.h5"] {
        std::fs::copy(study.path().join("r.h5"), study.path().join(copy)).unwrap();
    }
    let told = run("r.h5", &["--details"]).stdout;
    assert!(told.contains("weights solved for every resample"), "{told}");
    run("one.h5", &["--threads", "1"]);
    let [file, one] = ["r.h5", "one.h5"].map(|name| study.path().join(name));
    assert!(same_bits(&bands(&file), &bands(&one)));
    let [inner, whole] = ["u95_m", "simultaneous_upper_m"].map(|name| format!("/bootstrap/pga/consistent/{name}"));
    assert!(array(&file, &inner).iter().zip(&array(&file, &whole)).all(|(inner, whole)| inner <= whole));
    // the set that is repaired is in the middle of its resamples
    let errors = array(&file, "/bootstrap/pga/consistent/e_median");
    assert!(errors.iter().all(|error| *error < 25.0), "{errors:?}");

    // without a repair, the plain bands have the same bits, and there are no others
    study.uplift(&["run", "study.toml", "-o", "plain.h5", "-q", "--force", "--set", "consistency.repair=none"]).ok();
    assert!(!run("plain.h5", &[]).stdout.contains("repaired"));
    for name in &ARRAYS[..5] {
        let name = format!("/bootstrap/pga/{name}");
        assert!(same_bits(&array(&file, &name), &array(&study.path().join("plain.h5"), &name)), "{name}");
    }
    let [table, figures] = ["r.bands.csv", "r.table-4-1.csv"]
        .map(|name| std::fs::read_to_string(study.path().join(name)).unwrap().lines().next().unwrap().to_owned());
    assert!(
        table.ends_with(
            "u05_consistent_m,u50_consistent_m,u95_consistent_m,simultaneous_lower_consistent_m,\
             simultaneous_upper_consistent_m,truth_lower_consistent_m,truth_upper_consistent_m,\
             prediction_lower_consistent_m,prediction_upper_consistent_m"
        ),
        "{table}"
    );
    assert!(figures.ends_with("e_median_consistent_pct,r_90ci_consistent_pct,failed_consistent_pct"), "{figures}");

    // asked for the risks of the study anew, the bands are the same
    let json = |more: &[&str]| -> serde_json::Value {
        let export = ["export", "r.h5", "--json", "-o", "r.json", "-q", "--force"];
        study.uplift(&[&export[..], more].concat()).ok();
        serde_json::from_str(&std::fs::read_to_string(study.path().join("r.json")).unwrap()).unwrap()
    };
    let (stored, asked) = (json(&[]), json(&["--poe", "0.02,0.1,0.5"]));
    let stored = stored["spectra"].as_array().unwrap();
    for (stored, asked) in stored.iter().zip(asked["spectra"].as_array().unwrap()) {
        assert_eq!(stored["bands_consistent"], asked["bands_consistent"]);
        assert_eq!(stored["bands_consistent"].as_array().unwrap().len(), 2);
        // the band to quote is among them
        assert!(stored["bands_consistent"][0]["truth_upper_m"].as_array().unwrap()[0].is_number());
    }
    study.uplift(&["export", "r.h5", "--csv", "-o", "r.csv", "-q"]).ok();
    let exported = std::fs::read_to_string(study.path().join("r.csv")).unwrap();
    assert!(exported.lines().next().unwrap().contains(",truth_lower_consistent_n"), "{exported:.600}");
    let page = {
        study.uplift(&["report", "r.h5", "-q"]).ok();
        std::fs::read_to_string(study.path().join("r.html")).unwrap()
    };
    assert!(page.contains("id=\"r1-bands-together-repaired\""));
}

/// Stops at the first step of a phase of repaired spectra.
#[derive(Default)]
struct StopAtRepaired {
    is_repaired: AtomicBool,
    is_stopped: AtomicBool,
}

impl Events for StopAtRepaired {
    fn begin(&self, phase: Phase<'_>) {
        self.is_repaired.store(phase.label == "PGV repaired", Ordering::Relaxed);
    }

    fn advance(&self, _: u64) {
        let is_repaired = self.is_repaired.load(Ordering::Relaxed);
        self.is_stopped.fetch_or(is_repaired, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }
}

#[test]
#[ignore = "long: make test-long"]
fn a_stop_between_two_of_them_loses_nothing() {
    let study = study();
    let [whole, parts] = ["r.h5", "parts.h5"].map(|name| study.path().join(name));
    std::fs::copy(&whole, &parts).unwrap();
    let options = BootstrapOptions { sizes: Some(vec![105]), replicates: Some(40), ..BootstrapOptions::default() };
    bootstrap(&whole, &options, &Silent).unwrap();
    let stopped = bootstrap(&parts, &options, &StopAtRepaired::default());
    let Some(JobError::Paused { what, done, total, path }) = job_error(&stopped) else { panic!("{stopped:?}") };
    assert_eq!((*what, *done, *total), ("repaired sites", 1, 2));
    assert!(path.is_file());
    bootstrap(&parts, &options, &Silent).unwrap();
    assert!(!path.exists());
    assert!(same_bits(&bands(&whole), &bands(&parts)));
}
