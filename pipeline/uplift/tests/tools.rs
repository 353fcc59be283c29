//! The smaller jobs called as a library, without a terminal: records made, imported, listed and chosen, one response,
//! pulses, hazard curves.
#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::sync::Mutex;

use uplift::JobError;
use uplift::errors::{InputsError, LaboratoryError};
use uplift::events::{Events, Silent};
use uplift::hazard_curves::{self, CurveOptions};
use uplift::import::{self, ImportOptions};
use uplift::inputs::FileOptions;
use uplift::pulses::{BlockPlan, PulseOptions, PulsePlan, pulses};
use uplift::records::{
    Criteria, SelectOptions, SetOptions, ShowOptions, ShowReport, SynthesizeOptions, list, select, show, synthesize,
};
use uplift::response::{HistoryRow, Response, ResponseOptions, response};
use uplift::result::TargetRisks;
use uplift::status::status;
use uplift::table::{TableOptions, table};
use uplift::typed::Overwriting;
use uplift::verify::verify;
use uplift_block::RickerShape;
use uplift_motion::Combination;
use uplift_study::{CRITERIA, Range};

/// What a job that failed says.
fn job_error<T, E: std::error::Error + 'static>(outcome: &Result<T, E>) -> Option<&JobError> {
    uplift::cause(outcome.as_ref().err()?)
}

/// Who remembers what was noted, and stops a job at its first chance where told to.
#[derive(Default)]
struct Listener {
    notes: Mutex<Vec<String>>,
    stops: bool,
}

impl Events for Listener {
    fn note(&self, text: &str) {
        self.notes.lock().unwrap().push(text.to_owned());
    }

    fn cancelled(&self) -> bool {
        self.stops
    }
}

fn made(at: &Path, pairs: usize) -> std::path::PathBuf {
    let listener = Listener::default();
    let options = SynthesizeOptions { count: pairs, ..SynthesizeOptions::new(at.join("set")) };
    let report = synthesize(&options, &listener).unwrap();
    assert_eq!(report.pairs, pairs);
    assert_eq!(*listener.notes.lock().unwrap(), ["synthetic records: not for design"]);
    report.manifest
}

fn all(manifest: &Path) -> SetOptions {
    SetOptions {
        manifest: manifest.to_owned(),
        tag: None,
        intensity: Combination::GeometricMean,
        criteria: Criteria::default(),
    }
}

#[test]
fn records_made_are_imported_listed_shown_and_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let manifest = made(folder.path(), 3);
    let output = folder.path().join("again.csv");
    let options = ImportOptions {
        folder: folder.path().join("set"),
        output: output.clone(),
        files: FileOptions::default(),
        pulses: false,
        overwriting: Overwriting::default(),
    };
    let imported = import::import(&options, &Silent).unwrap();
    assert_eq!((imported.pairs, imported.files, imported.components), (3, 6, 6));
    assert_eq!(imported.manifest, Some(output));
    // the files are read as the manifest of the import says, and measure the same
    let [first, again] = [&manifest, imported.manifest.as_ref().unwrap()].map(|set| list(&all(set), &Silent).unwrap());
    assert_eq!(first.count, 3);
    for (one, other) in first.records.iter().zip(&again.records) {
        assert_eq!(one.pga_g.to_bits(), other.pga_g.to_bits());
    }
    let looked = ShowOptions {
        input: manifest.clone(),
        record: Some(first.records[0].record.clone()),
        files: FileOptions::default(),
    };
    let ShowReport::Record(record) = show(&looked).unwrap() else { panic!("a record was asked for") };
    assert!((record.peaks[0].pga_g - first.records[0].pga_g).abs() < 1e-12);

    let magnitude = CRITERIA.into_iter().find(|criterion| criterion.key == "magnitude").unwrap();
    let range = Range::parse("6:8").unwrap();
    let mut set = all(&manifest);
    set.criteria.0.ranges.push((magnitude, range));
    let output = folder.path().join("chosen.csv");
    let chosen =
        select(&SelectOptions { set, output: Some(output.clone()), overwriting: Overwriting::default() }, &Silent)
            .unwrap();
    assert_eq!((chosen.records.len(), chosen.count), (3, 3));
    assert!(chosen.study_lines.ends_with("[records.select]\nmagnitude = \"6:8\"\n"), "{}", chosen.study_lines);
    assert_eq!(list(&all(&output), &Silent).unwrap().records, first.records);
}

#[test]
fn an_import_without_pairs_says_what_it_found() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.txt"), "no record\n").unwrap();
    let output = folder.path().join("set.csv");
    let options = ImportOptions {
        folder: folder.path().to_owned(),
        output: output.clone(),
        files: FileOptions::default(),
        pulses: true,
        overwriting: Overwriting::default(),
    };
    let report = import::import(&options, &Silent).unwrap();
    assert_eq!((report.pairs, report.manifest, report.files), (0, None, 1));
    assert!(report.remarks.iter().any(|remarks| remarks.kind == "not read" && remarks.texts[0].contains("a.txt")));
    assert!(report.remarks_file.unwrap().exists() && !output.exists());
    let stopped = import::import(&options, &Listener { stops: true, ..Listener::default() });
    assert!(matches!(job_error(&stopped), Some(JobError::Interrupted)));
}

#[test]
fn a_response_with_its_history() {
    let folder = tempfile::tempdir().unwrap();
    made(folder.path(), 1);
    let record = std::fs::read_dir(folder.path().join("set"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .find(|path| path.to_string_lossy().ends_with("H1.AT2"))
        .unwrap();
    let options = ResponseOptions {
        record: Some(record),
        strength: Some(0.05),
        scale: 3.0,
        free_vibration_s: 2.0,
        history: true,
        ..ResponseOptions::default()
    };
    let Response::Oscillator(report) = response(&options).unwrap() else { panic!("of an oscillator") };
    let history = report.history.as_ref().unwrap();
    let count = |word: &str| history.rows.iter().filter(|row| row.event == Some(word)).count();
    assert_eq!(count(HistoryRow::AFTER_IMPACT), usize::try_from(report.impacts).unwrap());
    assert_eq!(count(HistoryRow::UPLIFT), usize::try_from(report.uplifts).unwrap());
    // between samples the motion may be larger, by little
    let largest = history.rows.iter().fold(0.0_f64, |most, row| most.max(row.displacement_m.abs()));
    assert!(largest <= report.peak_displacement_m && largest > 0.99 * report.peak_displacement_m);
    // the same response without a history
    let alone = response(&ResponseOptions { history: false, ..options.clone() }).unwrap();
    assert_eq!(serde_json::to_value(&alone).unwrap(), serde_json::to_value(&report).unwrap());
    assert!(matches!(
        job_error(&response(&ResponseOptions { strength: Some(-1.0), ..options })),
        Some(JobError::Implausible(_))
    ));
}

#[test]
fn pulses_without_files_and_refused() {
    let grid = |text: &str| text.parse().unwrap();
    let plan = PulsePlan {
        shapes: &[RickerShape::Symmetric],
        slenderness_rad: 0.1,
        restitution: None,
        frequencies: grid("1,2,4"),
        accelerations: grid("1.5,5"),
        half_widths: grid("0.5,1"),
        frequency_lines: grid("2"),
        acceleration_lines: grid("2"),
        blocks: BlockPlan { amplitude_g: 1.0, period_s: None, sizes_m: grid("1"), slendernesses_rad: grid("0.2") },
    };
    let report = pulses(&PulseOptions { plan: plan.clone(), folder: None, force: false }, &Silent).unwrap();
    assert_eq!((report.wavelets[0].points, report.files.len()), (6, 0));
    let impossible = PulsePlan { slenderness_rad: -1.0, restitution: Some(2.0), ..plan };
    let Err(LaboratoryError::Blocks(mistakes)) =
        pulses(&PulseOptions { plan: impossible, folder: None, force: false }, &Silent)
    else {
        panic!("blocks that cannot be")
    };
    assert_eq!(mistakes.len(), 2, "{mistakes:?}");
}

#[test]
fn hazard_curves_are_read_and_shown() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pgv.csv");
    std::fs::write(&file, "# IM: PGV [cm/s]\niml,maf\n0.5,0.8\n2,0.05\n20,0.0005\n300,0.000002\n").unwrap();
    let report = hazard_curves::show(std::slice::from_ref(&file), &CurveOptions::default(), &Silent).unwrap();
    let [curve] = report.curves.as_slice() else { panic!("one curve") };
    assert_eq!((curve.measure.as_str(), curve.points, curve.levels.len()), ("PGV", 4, report.probabilities.len()));
    let files = [file.clone(), file];
    assert_eq!(hazard_curves::read(&files, &CurveOptions::default(), &Silent).unwrap().len(), 1);
    let absent = hazard_curves::show(&["absent.csv".into()], &CurveOptions::default(), &Silent);
    assert!(matches!(absent, Err(InputsError::Hazard(_))));
}

#[test]
fn what_is_no_result_is_an_error_or_a_finding() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("r.h5");
    assert!(status(&file).is_err());
    let options = TableOptions { result: file.clone(), reference: None, measure: None, risk: TargetRisks::default() };
    assert!(table(&options, &Silent).is_err());
    let report = verify(std::slice::from_ref(&file), &Silent).unwrap();
    assert!(report.mistakes()[0].contains("r.h5"), "{:?}", report.mistakes());
    assert!(matches!(
        job_error(&verify(&[file], &Listener { stops: true, ..Listener::default() })),
        Some(JobError::Interrupted)
    ));
}
