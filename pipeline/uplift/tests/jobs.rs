//! Jobs called as a library, without a terminal: what they report is what they write, and a stop is obeyed.
#![allow(clippy::unwrap_used)]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use uplift::JobError;

use tempfile::TempDir;
use uplift::bootstrap::{BootstrapOptions, bootstrap};
use uplift::efficiency::{EfficiencyOptions, efficiency};
use uplift::events::{Events, Phase};
use uplift::influence::{InfluenceOptions, influence};
use uplift::result::OneRisk;
use uplift::structure::{DesignOptions, OverturningOptions, design, overturning};
use uplift::study::{AnyStudy, Structure, Study};
use uplift::{RunOptions, Silent, run};
use uplift_labelled::LabelledReader;
use uplift_motion::IntensityMeasure;

/// What a job that failed says.
fn job_error<T, E: std::error::Error + 'static>(outcome: &Result<T, E>) -> Option<&JobError> {
    uplift::cause(outcome.as_ref().err()?)
}

const STUDY: &str = r#"title = "small"
[records]
manifest = "manifest.csv"
[strengths]
values = [0.05, 0.1, 0.2, 0.4]
[pgv]
levels_cm_s = [1, 3, 10, 30, 100]
[pga]
levels_g = [0.02, 0.1, 0.3, 1.0]
[[sites]]
name = "Here"
pgv = "pgv.csv"
pga = "pga.csv"
[[sites]]
name = "There"
pgv = "pgv.csv"
pga = "pga.csv"
"#;
/// Strengths, probabilities and sites of the study.
const STRENGTHS: usize = 4;
const POES: [f64; 3] = [0.02, 0.1, 0.5];
const SITES: [&str; 2] = ["Here", "There"];

/// A burst of 12 s, slower and stronger from record to record, m/s².
fn motion(record: f64) -> String {
    let sample = |step: u32| {
        let time_s = 0.01 * f64::from(step);
        let burst = (-(time_s - 5.0).powi(2) / 3.0).exp() * (0.3 * record + 2.0 / record * time_s).sin();
        burst * (9.0 / record * time_s).sin()
    };
    let samples: Vec<String> = (0..1200).map(|step| format!("{:.6}", sample(step))).collect();
    samples.join("\n")
}

/// A folder with a result and a structure in it.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        let curve = |range: [f64; 3], k0: f64, k: f64| {
            let rows = range.map(|im: f64| format!("{im},{:e}", k0 * im.powf(-k)));
            format!("iml,maf\n{}\n", rows.join("\n"))
        };
        folder.write("pgv.csv", &curve([0.5, 10.0, 300.0], 0.2, 2.0));
        folder.write("pga.csv", &curve([0.01, 0.1, 3.0], 1e-4, 2.2));
        folder.write("block.toml", "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n");
        let mut manifest = "record_id,file_h1,file_h2,dt_s,unit,magnitude\n".to_owned();
        for record in 1..=4 {
            folder.write(&format!("{record}.txt"), &motion(f64::from(record)));
            let magnitude = 5.5 + 0.3 * f64::from(record);
            writeln!(manifest, "R{record},{record}.txt,{record}.txt,0.01,m/s2,{magnitude}").unwrap();
        }
        folder.write("manifest.csv", &manifest);
        let study = Study::load(&folder.write("study.toml", STUDY), &[]).unwrap();
        let options = RunOptions { output: Some(folder.result()), ..RunOptions::default() };
        run(&AnyStudy::UniformRisk(Box::new(study)), &options, &Silent).unwrap();
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.path(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    fn result(&self) -> PathBuf {
        self.path("r.h5")
    }

    fn block(&self) -> Structure {
        Structure::load(&self.path("block.toml")).unwrap()
    }
}

fn array(result: &Path, name: &str) -> Vec<f64> {
    LabelledReader::open(result).unwrap().array::<f64>(name).unwrap().values
}

/// Writes down what it is reported, and stops the job after so many steps.
#[derive(Default)]
struct Recorder {
    remarks: Mutex<Vec<String>>,
    /// Label, unit and length of each phase.
    phases: Mutex<Vec<(String, &'static str, u64)>>,
    steps: AtomicU64,
    stop_after: Option<u64>,
}

impl Recorder {
    fn stopping_after(steps: u64) -> Self {
        Self { stop_after: Some(steps), ..Self::default() }
    }

    fn remarks(&self) -> String {
        self.remarks.lock().unwrap().join("\n")
    }

    fn phases(&self) -> Vec<(String, &'static str, u64)> {
        self.phases.lock().unwrap().clone()
    }

    fn steps(&self) -> u64 {
        self.steps.load(Ordering::Relaxed)
    }
}

impl Events for Recorder {
    fn remark(&self, topic: &str, text: &str) {
        self.remarks.lock().unwrap().push(format!("{topic}: {text}"));
    }

    fn begin(&self, phase: Phase<'_>) {
        self.phases.lock().unwrap().push((phase.label.to_owned(), phase.unit, phase.total));
    }

    fn advance(&self, steps: u64) {
        self.steps.fetch_add(steps, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.stop_after.is_some_and(|steps| self.steps() >= steps)
    }
}

fn is_choice<T>(outcome: &Result<T, impl std::error::Error + 'static>, asked: &str) -> bool {
    matches!(job_error(outcome), Some(JobError::Choice { option, .. }) if *option == asked)
}

#[test]
fn a_bootstrap_reports_what_it_writes() {
    let folder = Folder::new();
    let options = BootstrapOptions { sizes: Some(vec![2, 4]), replicates: Some(30), ..BootstrapOptions::default() };
    let events = Recorder::default();
    let report = bootstrap(&folder.result(), &options, &events).unwrap();
    assert_eq!((report.stored.path.clone(), report.confidence), (folder.result(), 0.9));
    assert!(report.tables.iter().all(|table| table.is_file()));
    assert!(events.remarks().contains("plan: resamples of 2, 4 records, 30 of each size"), "{}", events.remarks());
    // an ordinate a site, probability, sample and strength
    let steps = (SITES.len() * POES.len() * 2 * 30 * STRENGTHS) as u64;
    assert_eq!(events.phases(), [("PGV".to_owned(), "ordinates", steps), ("PGA".to_owned(), "ordinates", steps)]);
    assert_eq!(events.steps(), 2 * steps);

    let mut row = report.rows.iter();
    for (bands, im) in report.bands.iter().zip(["pgv", "pga"]) {
        assert_eq!(bands.plain.limits_m[2].values(), array(&folder.result(), &format!("/bootstrap/{im}/u95_m")));
        let ranges = array(&folder.result(), &format!("/bootstrap/{im}/r_90ci"));
        for (site, poe, size) in (0..2).flat_map(|site| (0..6).map(move |cell| (site, cell / 2, cell % 2))) {
            let row = row.next().unwrap();
            assert_eq!((row.site.as_str(), row.poe, row.sample_size), (SITES[site], POES[poe], [2, 4][size]));
            assert_eq!(
                row.r_90ci.unwrap_or(f64::NAN).to_bits(),
                ranges[(site * POES.len() + poe) * 2 + size].to_bits()
            );
        }
    }
    assert!(row.next().is_none());
    // programs get the rows alone
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json.as_array().unwrap().len(), 24);
    assert_eq!(json[0].as_object().unwrap().len(), 7);
}

#[test]
fn reading_records_obeys_a_stop() {
    let folder = Folder::new();
    let study = || AnyStudy::UniformRisk(Box::new(Study::load(&folder.path("study.toml"), &[]).unwrap()));
    let options = RunOptions { output: Some(folder.path("again.h5")), ..RunOptions::default() };
    folder.write("pgv.csv", "iml,maf\n1,2\n");
    let refused = run(&study(), &options, &Silent);
    assert!(matches!(job_error(&refused), Some(JobError::Inputs(_))), "{refused:?}");
    // their mistakes are sought beside those of the hazard
    let stopped = run(&study(), &options, &Recorder::stopping_after(0));
    assert!(matches!(job_error(&stopped), Some(JobError::Interrupted)), "{stopped:?}");
}

#[test]
fn an_interrupted_bootstrap_resumes() {
    let folder = Folder::new();
    let options = BootstrapOptions { sizes: Some(vec![4]), replicates: Some(20), ..BootstrapOptions::default() };
    let stopped = bootstrap(&folder.result(), &options, &Recorder::stopping_after(1));
    let Some(JobError::Paused { done, total, path, .. }) = job_error(&stopped) else { panic!("{stopped:?}") };
    assert!((1..*total).contains(done) && path.is_file(), "{done} of {total}");
    assert!(!LabelledReader::open(&folder.result()).unwrap().exists("/bootstrap"));
    let events = Recorder::default();
    let resumed = bootstrap(&folder.result(), &options, &events).unwrap();
    assert!(events.remarks().contains(&format!("resumed: {done} strengths")), "{}", events.remarks());
    assert!(!path.exists());
    let again = bootstrap(&folder.result(), &options, &Silent).unwrap();
    assert_eq!((resumed.rows, resumed.bands), (again.rows, again.bands));
}

#[test]
fn influence_reports_what_it_writes() {
    let folder = Folder::new();
    let report = influence(
        &folder.result(),
        &InfluenceOptions { poe: Some(0.1), top: 2, ..InfluenceOptions::default() },
        &Silent,
    )
    .unwrap();
    assert!(report.records.len() <= 2 * 2 * 3 * 2 && !report.records.is_empty());
    let without = array(&folder.result(), "/influence/pgv/u_without_m");
    let spectra = array(&folder.result(), "/urs/pgv/u_m");
    let first = &report.records[0];
    let record: usize = first.record.trim_start_matches('R').parse().unwrap();
    let strengths = LabelledReader::open(&folder.result()).unwrap().axis::<f64>("strength").unwrap();
    let at = strengths.iter().position(|&strength| strength == first.at_strength).unwrap();
    let change = without[(record - 1) * STRENGTHS + at] / spectra[at] - 1.0;
    assert!((first.largest_change_pct - 100.0 * change).abs() < 1e-9, "{first:?} {change}");
    // 5 levels, and so 6 bins
    let shares = array(&folder.result(), "/disaggregation/pgv/share");
    let row = report.intensities.iter().find(|row| row.site == "There" && row.im == "PGV").unwrap();
    let strength = strengths.iter().position(|&strength| strength == row.strength).unwrap();
    let ordinate = (POES.len() + 1) * STRENGTHS + strength;
    assert_eq!((row.poe, row.u_m), (0.1, spectra[ordinate]));
    assert_eq!([row.share_below_stripes, row.share_above_stripes], [shares[6 * ordinate], shares[6 * ordinate + 5]]);
    let other = InfluenceOptions { poe: Some(0.3), ..InfluenceOptions::default() };
    assert!(is_choice(&influence(&folder.result(), &other, &Silent), "--poe"));
    let stopped = influence(&folder.result(), &InfluenceOptions::default(), &Recorder::stopping_after(0));
    assert!(matches!(job_error(&stopped), Some(JobError::Interrupted)));
}

#[test]
fn efficiency_reports_what_it_writes() {
    let folder = Folder::new();
    let options =
        EfficiencyOptions { measures: IntensityMeasure::OF_CHAPTER_4.to_vec(), ..EfficiencyOptions::default() };
    let report = efficiency(&folder.result(), &options, &Silent).unwrap();
    assert_eq!((report.rows.len(), report.stored.records.len()), (2 * STRENGTHS, 4));
    for (rows, im) in report.rows.chunks(STRENGTHS).zip(["pgv", "pga"]) {
        let of = |name: &str| array(&folder.result(), &format!("/{name}"));
        let same = |found: Vec<f64>, written: Vec<f64>| {
            assert!(found.iter().zip(&written).all(|(a, b)| a.to_bits() == b.to_bits()), "{found:?} {written:?}");
        };
        same(rows.iter().map(|row| row.dispersion_rocking).collect(), of(&format!("efficiency/{im}/rocking")));
        for covariate in &report.covariates {
            let found = rows.iter().map(|row| row.trends[covariate].p_value.unwrap_or(f64::NAN)).collect();
            same(found, of(&format!("sufficiency/{im}/{covariate}/p_value")));
        }
    }
    let stopped = efficiency(&folder.result(), &EfficiencyOptions::default(), &Recorder::stopping_after(0));
    assert!(matches!(job_error(&stopped), Some(JobError::Interrupted)));
}

#[test]
fn a_design_starts_from_the_spectrum_in_the_file() {
    let folder = Folder::new();
    let options = DesignOptions {
        site: Some("there".to_owned()),
        risk: OneRisk { poe: Some(0.1), ..OneRisk::default() },
        ..DesignOptions::default()
    };
    let events = Recorder::default();
    let report = design(&folder.block(), &folder.result(), &options, &events).unwrap();
    assert_eq!((report.site.as_str(), report.im, report.poe), ("There", "PGV", 0.1));
    // tan(alpha) = 0.2 is a strength of the study, and there the factor on the motion is in the strength already
    let spectrum = report.spectrum.unwrap();
    let u_m = array(&folder.result(), "/urs/pgv/u_m");
    let row = (POES.len() + 1) * STRENGTHS;
    let strengths = LabelledReader::open(&folder.result()).unwrap().axis::<f64>("strength").unwrap();
    let (a, b) = spectrum.between_strengths;
    let at = strengths.iter().position(|&strength| strength == b).unwrap();
    let share = if b > a { (spectrum.strength - a) / (b - a) } else { 1.0 };
    let left = if b > a { u_m[row + at - 1] } else { u_m[row + at] };
    let expected = left + share * (u_m[row + at] - left);
    assert!((spectrum.ordinate_m - expected).abs() < 1e-12 * expected, "{spectrum:?} {expected}");
    let check = report.rules[0].check().unwrap();
    assert_eq!(check.required_capacity_m, 2.5 * spectrum.zero_stiffness_demand_m);
    let exact = report.exact.unwrap();
    // the study's oscillator and two of the structure's
    assert_eq!((exact.analyses, exact.sensitivity), (4 * 5 * 3, None));
    // and the block itself
    let phases = vec![("PGV".to_owned(), "analyses", 4 * 5 * 3), ("PGV, block".to_owned(), "analyses", 4 * 5)];
    assert_eq!((events.phases(), events.steps()), (phases, 4 * 5 * 4));
    // ten strengths more of two oscillators, and eight roundings of three
    let options = DesignOptions { sensitivity: true, ..options };
    let of_neighbours = design(&folder.block(), &folder.result(), &options, &Silent).unwrap().exact.unwrap();
    assert_eq!(of_neighbours.analyses, 4 * 5 * 47);
    assert_eq!(of_neighbours.sensitivity.unwrap().rounding.demand_m.value, exact.demand_m);
    // programs get null for what is infinite
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["exact"]["demand_m"].is_null(), exact.overturns);
    assert_eq!(json["rules"][1]["rule"], "equal-energy");

    let ask = |options: DesignOptions| design(&folder.block(), &folder.result(), &options, &Silent);
    assert!(is_choice(&ask(DesignOptions::default()), "--site"));
    assert!(is_choice(&ask(DesignOptions { site: Some("Nowhere".to_owned()), ..options.clone() }), "--site"));
    for (poe, return_period) in [(Some(1.5), None), (None, Some(0.0))] {
        let refused = ask(DesignOptions { risk: OneRisk { poe, return_period, years: None }, ..options.clone() });
        assert!(matches!(job_error(&refused), Some(JobError::Usage(_))), "{refused:?}");
    }
    let safety = ask(DesignOptions { safety_factor: 0.5, ..options.clone() });
    assert!(matches!(job_error(&safety), Some(JobError::Implausible(_))));
    let alone = ask(DesignOptions { spectrum_only: true, ..options }).unwrap();
    assert_eq!((alone.exact, alone.spectrum), (None, Some(spectrum)));
}

// What is finished of the structure's own analysis is in a checkpoint beside the result until all of it is reported.
#[test]
fn a_stopped_design_and_overturning_go_on() {
    let folder = Folder::new();
    let options = DesignOptions { site: Some("Here".to_owned()), ..DesignOptions::default() };
    let ask = |events: &dyn Events| design(&folder.block(), &folder.result(), &options, events);
    let whole = ask(&Silent).unwrap();
    let stopped = ask(&Recorder::stopping_after(1));
    let Some(JobError::Paused { done, total, path, .. }) = job_error(&stopped) else { panic!("{stopped:?}") };
    assert!((1..*total).contains(done) && path.is_file(), "{done} of {total}");
    let events = Recorder::default();
    assert_eq!(ask(&events).unwrap(), whole);
    assert!(events.remarks().contains("known"), "{}", events.remarks());
    assert!(!path.exists());

    let options = OverturningOptions::default();
    let ask = |events: &dyn Events| overturning(&folder.block(), &folder.result(), &options, events);
    let whole = ask(&Silent).unwrap();
    let stopped = ask(&Recorder::stopping_after(1));
    let Some(JobError::Paused { path, .. }) = job_error(&stopped) else { panic!("{stopped:?}") };
    assert!(path.is_file());
    assert_eq!(ask(&Silent).unwrap(), whole);
    assert!(!path.exists());
}

#[test]
fn overturning_reports_what_it_writes() {
    let folder = Folder::new();
    let options = OverturningOptions {
        measure: Some(IntensityMeasure::Pga),
        sensitivity: true,
        table: Some(folder.path("o.csv")),
        ..OverturningOptions::default()
    };
    let events = Recorder::default();
    let report = overturning(&folder.block(), &folder.result(), &options, &events).unwrap();
    assert_eq!(report.files, [folder.path("o.csv"), folder.path("o.risk.csv")]);
    let models: Vec<&str> = report.models.iter().map(|model| model.model).collect();
    assert_eq!(models, ["oscillator", "block"]);
    assert_eq!(events.phases().len(), 2);
    // each run, and eight neighbours of it: what rounding decides is marked
    assert_eq!(events.steps(), 9 * 2 * 4 * 4);
    let table = std::fs::read_to_string(folder.path("o.csv")).unwrap();
    let overturned: Vec<&str> = table.lines().skip(1).map(|line| line.split(',').nth(5).unwrap()).collect();
    let counted: Vec<String> =
        report.overturning.iter().flat_map(|found| found.overturned.iter().map(u32::to_string)).collect();
    assert_eq!(overturned, counted);
    let risk = std::fs::read_to_string(folder.path("o.risk.csv")).unwrap();
    let last: Vec<&str> = risk.lines().last().unwrap().split(',').collect();
    let block = &report.overturning[1].sites[1];
    assert_eq!((last[0], last[2]), (block.site.as_str(), "block"));
    let per_year: f64 = last[3].parse().unwrap();
    assert!((per_year - block.risk.per_year).abs() <= 1e-12 * per_year);

    let ask = |options: OverturningOptions| overturning(&folder.block(), &folder.result(), &options, &Silent);
    assert!(is_choice(&ask(OverturningOptions { site: Some("Nowhere".to_owned()), ..options.clone() }), "--site"));
    let restitution = ask(OverturningOptions { restitution: Some(1.5), ..options.clone() });
    assert!(matches!(job_error(&restitution), Some(JobError::Usage(_))));
    let table = ask(OverturningOptions { table: Some(folder.path("pga.csv")), ..options });
    assert!(matches!(job_error(&table), Some(JobError::Usage(_))), "a hazard curve is left alone");
}
