//! What the order of the same arithmetic does to a spectrum (docs/method.md, section 1.3): every run solved by both
//! solvers, real records.

use rayon::prelude::*;
use uplift::events::Silent;
use uplift::inputs::{Record, read_records};
use uplift::result::{ResultFile, StoredMeasure, StoredStripes};
use uplift_fragility::Stripes;
use uplift_motion::{IntensityMeasure, scale_factor};
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, respond};
use uplift_risk::{PooledDemand, RiskCurve};
use uplift_study::Study;

use super::marks::hold;
use super::{quantile, with_real_records};
use crate::common::{repository, uplift};

/// Peaks `[record, level]` of one strength by the readable solver, m.
fn peaks_m(records: &[Record], strength: f64, measure: IntensityMeasure, levels: &[f64]) -> Vec<f64> {
    let oscillator = Oscillator::zsbe(strength).unwrap();
    let of_record = |record: &Record| {
        let motion = &record.accelerogram;
        let excitation = Excitation::new(motion.dt_s(), motion.acceleration_m_s2()).unwrap();
        let peak_m = |level: &f64| {
            let scaled = excitation.scaled(scale_factor(*level, record.intensity(measure)).unwrap()).unwrap();
            respond(&oscillator, &scaled, FreeVibration::FirstPeak).peak_displacement_m
        };
        levels.iter().map(peak_m).collect::<Vec<_>>()
    };
    records.par_iter().flat_map_iter(of_record).collect()
}

/// Relative differences of all ordinates of one strength, each with the name of its site.
fn differences(
    of: &StoredMeasure,
    strength: usize,
    readable_m: &[f64],
    sites: &[String],
    targets_per_year: &[f64],
) -> Vec<(f64, String)> {
    let stripes = Stripes::new(&of.levels, readable_m).unwrap();
    let demands = [of.demand(strength).unwrap(), PooledDemand::new(&stripes).unwrap()];
    let mut found = Vec::new();
    for (site, weights) in sites.iter().zip(&of.weights) {
        let [fast, readable] =
            demands.each_ref().map(|demand| RiskCurve::new(demand, weights).unwrap().exact_ordinates(targets_per_year));
        for (fast, readable) in fast.unwrap().iter().zip(readable.unwrap()) {
            let (a, b) = (fast.displacement_m, readable.displacement_m);
            found.push((if a == b { 0.0 } else { (a / b - 1.0).abs() }, site.clone()));
        }
    }
    found
}

/// Minutes: 350,000 runs of the readable solver.
#[test]
#[ignore = "minutes: make doc-figures"]
fn spectra_of_both_solvers() {
    let Some(real) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let file = repository().join("configs/europe.toml");
    let settings = ["risk.maf_surface=false", "strengths.values=0.05:0.05:1", &real[1], &real[3]].map(str::to_owned);
    let mut run = ["run", file.to_str().unwrap(), "-o", "r.h5", "-q"].map(str::to_owned).to_vec();
    run.extend(settings.iter().flat_map(|setting| ["--set".to_owned(), setting.clone()]));
    uplift(folder.path(), &run).ok();
    let records = read_records(&Study::load(&file, &settings).unwrap(), &Silent).unwrap().records;
    let stored = StoredStripes::read(&ResultFile::open(&folder.path().join("r.h5")).unwrap()).unwrap();
    let mut all: Vec<(f64, String)> = Vec::new();
    for of in &stored.measures {
        for (strength, &eta) in stored.strengths.iter().enumerate() {
            let readable_m = peaks_m(&records, eta, of.measure, &of.levels);
            let found = differences(of, strength, &readable_m, &stored.sites, &stored.targets_per_year);
            all.extend(found.into_iter().map(|(change, site)| (change, format!("{} at {site}", of.measure.label()))));
        }
    }
    let changes: Vec<f64> = all.iter().map(|(change, _)| *change).collect();
    let (most, place) = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    let name = |name: &str| format!("two-solvers.{name}");
    hold(
        "two-solvers",
        &[
            (name("ordinates"), changes.len().to_string()),
            (name("p90"), format!("{:.0e}", quantile(&changes, 0.9))),
            (name("p99"), format!("{:.1} %", 100.0 * quantile(&changes, 0.99))),
            (name("most"), format!("{:.0} % ({})", 100.0 * most, place.replace("Focsani", "Focşani"))),
        ],
    );
}
