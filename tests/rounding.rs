//! Runs beyond double precision (docs/method.md, section 1.5): what hangs on one is marked wherever it is shown.

use uplift_labelled::LabelledReader;
use uplift_motion::STANDARD_GRAVITY_M_S2 as G;
use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_oscillator::{Excitation, GroundMotion, Oscillator, PostUplift, Sweep};
use uplift_spectra::percentile;

use crate::common::SmallStudy;

/// Ten motions strong enough for long trains of impacts: several medians take another value at the next double.
const STUDY: &str = r#"kind = "displacement spectra"
[records.synthetic]
pairs = 5
[scaling]
to = "1.5 PGA"
by = "component"
[spectrum]
percentiles = [50, 84]
[oscillator]
capacity_m = [0.4, 1.6]
[strengths]
values = [0.1, 0.2, 0.3, 0.4]
[design]
width_m = 0.1
height_m = 1
noise_points = 1
"#;
const CAPACITIES_M: [f64; 2] = [0.4, 1.6];
const PERCENTILES: [f64; 2] = [50.0, 84.0];
/// Those of the study's strengths that are nearest to 0.1, 0.2 and 0.4.
const PRINTED: [(usize, f64); 3] = [(0, 0.1), (1, 0.2), (3, 0.4)];

/// Whether an end of a range is printed otherwise than the value.
fn hangs(value: &[f64]) -> bool {
    value.iter().any(|end| format!("{end:.4}") != format!("{:.4}", value[0]))
}

/// The range over neighbouring scale factors is that of single runs, and the spectrum itself is not touched.
#[test]
fn printed_spectra_are_repeated_at_neighbouring_scale_factors() {
    let study = SmallStudy::with(STUDY);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let rounding = reader.array::<f64>("/spectra/u_m_rounding").unwrap();
    let lines = ["record_set", "scaling", "scaled_by", "uplift_displacement", "capacity", "percentile"];
    assert_eq!(rounding.dims, [&lines[..], &["printed_strength", "bound"]].concat());
    assert_eq!(rounding.shape, [1, 1, 1, 1, 2, 2, 3, 3]);
    assert_eq!(reader.axis::<f64>("printed_strength").unwrap(), PRINTED.map(|(_, strength)| strength));
    let u_m = reader.array::<f64>("/spectra/u_m").unwrap().values;
    let factors = reader.array::<f64>("/sets/synthetic/factor").unwrap().values;
    let pairs = generate(&SyntheticSetOptions { pairs: 5, seed: 1, ..SyntheticSetOptions::default() }).unwrap();
    let motions: Vec<GroundMotion<'_>> = pairs
        .iter()
        .flat_map(|pair| [&pair.h1, &pair.h2])
        .map(|motion| GroundMotion::new(Excitation::new(motion.dt_s(), motion.acceleration_m_s2()).unwrap()))
        .collect();
    let nudges: Vec<f64> = (1..=4).flat_map(|step| [-1e-15, 1e-15].map(|unit| 1.0 + f64::from(step) * unit)).collect();
    let (mut found, mut moved) = (rounding.values.chunks_exact(3), 0);
    for (line, capacity_m) in CAPACITIES_M.into_iter().enumerate() {
        for (row, percent) in PERCENTILES.into_iter().enumerate() {
            for (at, strength) in PRINTED {
                let found = found.next().unwrap();
                assert_eq!(found[0].to_bits(), u_m[(line * 2 + row) * 4 + at].to_bits());
                let oscillator =
                    Oscillator::new(strength, G, 0.0005, 0.95, PostUplift::Negative { capacity_m }).unwrap();
                let at_nudge = |nudge: &f64| {
                    let peak = |(motion, factor): (&GroundMotion<'_>, &f64)| {
                        Sweep::new(&oscillator, motion, true).peak(factor * nudge).displacement_m
                    };
                    percentile(&motions.iter().zip(&factors).map(peak).collect::<Vec<_>>(), percent)
                };
                let others: Vec<f64> = nudges.iter().map(at_nudge).chain([found[0]]).collect();
                let [lowest, highest] = [f64::min, f64::max].map(|end| others.iter().copied().reduce(end).unwrap());
                assert_eq!(found[1..], [lowest, highest], "{capacity_m} {percent} {strength}");
                moved += usize::from(hangs(found));
            }
        }
    }
    assert!(moved > 2, "{moved}: the study has runs beyond double precision");
    // what is in order is not marked
    assert!(moved < rounding.values.len() / 3, "{moved}");
}

#[test]
fn what_hangs_on_rounding_is_marked_wherever_it_is_shown() {
    let study = SmallStudy::with(STUDY);
    let printed = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok().stdout;
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let rounding = reader.array::<f64>("/spectra/u_m_rounding").unwrap().values;
    // the median of the largest capacity is printed
    let shown: Vec<&[f64]> = rounding.chunks_exact(3).skip(2 * 3).take(3).collect();
    let row = printed.lines().find(|line| line.starts_with("synthetic ")).unwrap();
    let cells: Vec<String> = shown
        .iter()
        .map(|value| {
            let mark = if hangs(value) { format!("* [{:.4}, {:.4}]", value[1], value[2]) } else { String::new() };
            format!("{:.4}{mark}", value[0])
        })
        .collect();
    assert!(cells.iter().any(|cell| cell.contains('*')), "{cells:?}");
    assert!(cells.iter().all(|cell| row.contains(cell)), "{cells:?}\n{row}");
    assert!(printed.contains("*: the last digits are not significant (rounding"), "{printed}");

    // designs: in the table with the range below it, and as JSON says
    let table = study.uplift(&["table", "r.h5", "--json"]).json();
    let rows = table["rows"].as_array().unwrap();
    let hanging: Vec<_> = rows.iter().filter(|row| row["hangs_on_rounding"] == true).collect();
    assert!(!hanging.is_empty(), "{rows:?}");
    let table = study.uplift(&["table", "r.h5"]).ok().stdout;
    let told = |row: &serde_json::Value| {
        let quantity = row["quantity"].as_str().unwrap();
        let decimals = if quantity.ends_with("_pct") { 1 } else { 3 };
        let end = |name: &str| row[name].as_f64().map_or("overturns".to_owned(), |value| format!("{value:.decimals$}"));
        let (lowest, highest) = (end("rounding_lowest"), end("rounding_highest"));
        format!("{}, {quantity}, 1.5 PGA by component: {lowest} to {highest}", row["rule"].as_str().unwrap())
    };
    for row in &hanging {
        assert!(table.contains(&told(row)), "{}\n{table}", told(row));
    }

    // the page: asterisks with their meaning, rings with ranges in the captions
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    let page = page.replace("<sub>", "_").replace("</sub>", "");
    for row in &hanging {
        assert!(page.contains(&told(row)), "{}", told(row));
    }
    let of_curve: Vec<&[f64]> = rounding.chunks_exact(3).collect();
    for (line, capacity_m) in CAPACITIES_M.into_iter().enumerate() {
        for (place, (_, strength)) in PRINTED.into_iter().enumerate() {
            let value = of_curve[line * 2 * 3 + place];
            if hangs(value) && value[2].is_finite() {
                let words = format!("u_cap = {capacity_m} m at {strength:.4}: {:.4} m to {:.4} m", value[1], value[2]);
                assert!(page.contains(&words), "{words}");
            }
        }
    }
    study.uplift(&["plot", "r.h5", "-q"]).ok();
    for name in ["spectra-synthetic-median-uplift-0.0005", "design"] {
        let svg = std::fs::read_to_string(study.path().join(format!("r.figures/{name}.svg"))).unwrap();
        assert!(svg.contains("decided by rounding") && svg.contains("fill=\"none\""), "{name}");
    }
}

/// The table has the range beside the ordinates that are printed, and nothing beside the others.
#[test]
fn the_table_of_spectra_has_the_range() {
    let study = SmallStudy::with(STUDY);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let rounding = reader.array::<f64>("/spectra/u_m_rounding").unwrap().values;
    let table = std::fs::read_to_string(study.path().join("r.displacements.csv")).unwrap();
    let mut rows = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = rows.next().unwrap();
    let column =
        |name: &str| header.iter().position(|found| *found == name).unwrap_or_else(|| panic!("{name}: {header:?}"));
    let mut seen = 0;
    for row in rows {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        let line = CAPACITIES_M.iter().position(|capacity_m| *capacity_m == number("capacity_m")).unwrap();
        let place = PRINTED.iter().position(|(_, strength)| *strength == number("strength"));
        for (percentile, name) in ["u50", "u84"].into_iter().enumerate() {
            let [lowest, highest] = ["lowest", "highest"].map(|end| format!("{name}_rounding_{end}_m"));
            let Some(place) = place else {
                assert_eq!([row[column(&lowest)], row[column(&highest)]], ["", ""]);
                continue;
            };
            let at = 3 * ((line * PERCENTILES.len() + percentile) * PRINTED.len() + place);
            let found = [&format!("{name}_m"), &lowest, &highest].map(|name| number(name));
            assert_eq!(found, rounding[at..at + 3], "{row:?}");
            seen += 1;
        }
    }
    assert_eq!(3 * seen, rounding.len());
}

#[test]
fn a_check_estimates_the_cost_of_the_repetition() {
    let study = SmallStudy::with(STUDY);
    let plan = study.uplift(&["check", "study.toml", "--json"]).json();
    // ten motions; two capacities at four strengths, at three of them again at eight neighbours
    assert_eq!((&plan["analyses"], &plan["rounding_analyses"]), (&80.into(), &480.into()));
    let said = study.uplift(&["check", "study.toml", "--details"]).ok().stdout;
    assert!(said.contains("\nRounding  480 more analyses"), "{said}");
}
