//! How sensitive peaks are (docs/method.md, section 1.5).

use uplift_labelled::LabelledReader;

use super::marks::hold;
use super::{quantile, range};
use crate::common::{SmallStudy, real_records, repository};

/// The study of section 1.5 with its levels multiplied by `factor`: displacements of all runs, m.
fn displacements_m(factor: &str) -> Vec<f64> {
    let levels: Vec<String> = ["5", "10", "20", "30", "50", "100", "200"].map(|level| by(level, factor)).to_vec();
    let study = SmallStudy::with(&format!(
        "[strengths]\nvalues = [0.05, 0.1, 0.2, 0.3, 0.5, 0.8]\n[pgv]\nlevels_cm_s = [{}]\n[risk]\nmaf_surface = \
         false\n[[sites]]\nname = \"Here\"\npgv = \"here-pgv.csv\"\n",
        levels.join(", ")
    ));
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    LabelledReader::open(&study.path().join("r.h5")).unwrap().array::<f64>("/ida/pgv/edp_m").unwrap().values
}

/// A level times 1, or times 1 and a little, in decimals.
fn by(level: &str, factor: &str) -> String {
    match factor {
        "1e-12" => format!("{level}.{level:0>12}"),
        "1e-3" => format!("{level}.{level:0>3}"),
        _ => level.to_owned(),
    }
}

fn power(value: f64) -> String {
    let decade = value.log10().floor();
    let digit = (value / 10_f64.powf(decade)).round();
    if digit == 1.0 { format!("$10^{{{decade}}}$") } else { format!("${digit} \\cdot 10^{{{decade}}}$") }
}

#[test]
#[ignore = "long: make test-long"]
fn of_synthetic_records() {
    let peaks_m = displacements_m("1");
    let changes = |factor: &str| -> Vec<f64> {
        let others = displacements_m(factor);
        let pairs = peaks_m.iter().zip(others).filter(|(peak_m, _)| **peak_m > 0.0005);
        pairs.map(|(peak_m, other_m)| (other_m / peak_m - 1.0).abs()).collect()
    };
    let share = |values: &[f64], above: f64| {
        100.0 * values.iter().filter(|value| **value > above).count() as f64 / values.len() as f64
    };
    let (rounding, small) = (changes("1e-12"), changes("1e-3"));
    let condition: Vec<f64> = rounding.iter().map(|change| change / 1e-12).collect();
    let name = |name: &str| format!("conditioning.{name}");
    hold(
        "conditioning",
        &[
            (name("runs"), condition.len().to_string()),
            (name("median"), format!("{:.0}", quantile(&condition, 0.5))),
            (name("p90"), power(quantile(&condition, 0.9))),
            (name("above"), format!("{:.0} %", share(&condition, 1e6))),
            (name("most"), power(range(condition.iter().copied())[1])),
            (name("moved"), format!("{:.1} %", share(&rounding, 0.01))),
            (name("small-median"), format!("{:.1} %", 100.0 * quantile(&small, 0.5))),
            (name("small-p90"), format!("{:.0} %", 100.0 * quantile(&small, 0.9))),
        ],
    );
}

/// The real run whose condition exceeds 1e16: a record of the far-field set, by record to 0.5 of the median PGA.
#[test]
#[ignore = "long: make test-long"]
fn of_a_real_record() {
    let Some(records) = real_records() else { return };
    let record = records.join("RSN169_ImperialValley06_Delta/RSN169_IMPVALL.H_H-DLT262.AT2");
    let strength = (1.0_f64 / 6.0).tan().to_string();
    let folder = tempfile::tempdir().unwrap();
    let peak_m = |scale: f64| -> f64 {
        let scale = scale.to_string();
        let arguments = ["response", record.to_str().unwrap(), "--strength", &strength, "--capacity-m", "1.6"];
        let options = ["--scale", &scale, "--free-vibration-s", "1000", "--json"];
        let said = crate::common::uplift(folder.path(), &[&arguments[..], &options[..]].concat()).ok().stdout;
        serde_json::from_str::<serde_json::Value>(&said).unwrap()["peak_displacement_m"].as_f64().unwrap()
    };
    let scale: f64 = 0.640_375_985_850_353_4;
    let neighbours: Vec<f64> = (0..25).map(|place| f64::from_bits(scale.to_bits() + place - 8)).map(peak_m).collect();
    let [lowest, highest] = range(neighbours);
    let relative = (1..=50).flat_map(|step| [-1e-15, 1e-15].map(|unit| f64::from(step) * unit));
    let shown: Vec<String> = relative.map(|relative| format!("{:.3}", peak_m(scale * (1.0 + relative)))).collect();
    let chance = |text: &String| shown.iter().filter(|other| *other == text).count() as f64 / shown.len() as f64;
    // of a run and `neighbours` of it to show the same digits
    let alike =
        |neighbours: i32| shown.iter().map(|text| chance(text).powi(neighbours)).sum::<f64>() / shown.len() as f64;
    let per_cent = |share: f64, decimals: usize| format!("{:.decimals$} %", 100.0 * share);
    let name = |name: &str| format!("rounding.{name}");
    hold(
        "rounding",
        &[
            (
                name("pair"),
                format!("from {:.3} to {:.3} m", peak_m(scale), peak_m(f64::from_bits(scale.to_bits() + 1))),
            ),
            (name("range"), format!("{lowest:.3} to {highest:.3} m")),
            (name("alike"), per_cent(alike(1), 0)),
            (name("missed-by-2"), per_cent(alike(2), 0)),
            (name("missed-by-8"), per_cent(alike(8), 1)),
        ],
    );
}

/// Of percentiles that rounding moves, how many so many neighbours miss: the same scalings some 1e-15 apart, of the
/// sets of Chapter 3.
#[test]
#[ignore = "minutes: make doc-figures"]
fn of_percentiles() {
    const NEIGHBOURS: i32 = 50;
    let Some(records) = real_records() else { return };
    let config = repository().join("configs/chapter-3.toml").to_str().unwrap().to_owned();
    let folder = tempfile::tempdir().unwrap();
    let (mut ordinates, mut shares) = (0, Vec::new());
    for (measure, multiple) in
        ["PGA", "PGV"].into_iter().flat_map(|measure| [0.5, 1.0, 2.0].map(|times| (measure, times)))
    {
        let steps = [0].into_iter().chain((1..=NEIGHBOURS / 2).flat_map(|step| [-step, step]));
        let to = |step: i32| format!("\"{} {measure}\"", multiple * (1.0 + f64::from(step) * 1e-15));
        let to: Vec<String> = steps.map(to).collect();
        let set = [
            format!("records.manifest={}", records.join("manifest.csv").display()),
            format!("scaling.to=[{}]", to.join(", ")),
            "spectrum.percentiles=[16, 50, 84]".to_owned(),
            "oscillator.uplift_displacement_m=0.0005".to_owned(),
            format!("strengths.values=[0.1, {}, 0.2, 0.4]", (1.0_f64 / 6.0).tan()),
            "design.noise_points=1".to_owned(),
        ];
        let mut run = vec!["run", &config, "-o", "r.h5", "-q", "--force"];
        run.extend(set.iter().flat_map(|set| ["--set", set]));
        crate::common::uplift(folder.path(), &run).ok();
        // [record_set, scaling, scaled_by, uplift_displacement, capacity, percentile, strength]
        let u = LabelledReader::open(&folder.path().join("r.h5")).unwrap().array::<f64>("/spectra/u_m").unwrap();
        let of_scaling: usize = u.shape[2..].iter().product();
        let shown: Vec<String> = u.values.iter().map(|value| format!("{value:.4}")).collect();
        for of_set in shown.chunks(u.shape[1] * of_scaling) {
            let (own, others) = of_set.split_at(of_scaling);
            for (place, own) in own.iter().enumerate() {
                let moved = others.chunks(of_scaling).filter(|other| other[place] != *own).count();
                ordinates += 1;
                shares.extend((moved > 0).then_some(moved as f64 / f64::from(NEIGHBOURS)));
            }
        }
    }
    let name = |name: &str| format!("rounding-missed.{name}");
    let missed = |neighbours: i32| {
        let missed = shares.iter().map(|share| (1.0 - share).powi(neighbours)).sum::<f64>() / shares.len() as f64;
        (name(&format!("by-{neighbours}")), format!("{:.0} %", 100.0 * missed))
    };
    let mut computed = vec![
        (name("ordinates"), ordinates.to_string()),
        (name("moved"), format!("{:.1} %", 100.0 * shares.len() as f64 / f64::from(ordinates))),
        (name("share"), format!("{:.0} %", 100.0 * quantile(&shares, 0.5))),
    ];
    computed.extend([1, 2, 4, 8, 16, 24].map(missed));
    hold("rounding-missed", &computed);
}
