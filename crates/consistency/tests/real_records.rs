//! Real records, which may not be distributed, at three sites against an independent prototype: skipped where they are
//! absent.
// digits as they are printed
#![allow(clippy::unreadable_literal)]

use std::collections::BTreeMap;
use std::sync::OnceLock;

use uplift_consistency::{
    ConsistencyError, HighLimit, KNOTS, RecordSet, RepairOptions, Repaired, Scratch, Solver, StripeStatistics, Warning,
};
use uplift_motion::{ReadOptions, RecordPair, read_path};
use uplift_risk::{PooledDemand, RiskCurve, RunWeights};

use crate::common::{ONE_BY_ONE, STRENGTHS, ScaledTo, Site, demands_m, pooled, record_set, records_folder, targets};
use crate::expected::{Expected, original_zones, project_sites};
use crate::golden::{agree, both_ways, compare, compare_ordinates, from_10_mm, keep, needs_nothing, scatter};

/// The 105 pairs of the stand-in set, in the order of their manifest.
fn pairs() -> Option<&'static [RecordPair]> {
    static PAIRS: OnceLock<Option<Vec<RecordPair>>> = OnceLock::new();
    let pairs = PAIRS.get_or_init(|| {
        let folder = records_folder()?;
        let manifest = std::fs::read_to_string(folder.join("manifest.csv")).unwrap();
        let mut lines = manifest.lines();
        let names = cells(lines.next().unwrap());
        let of_set = lines.filter(|line| line.split([',', ' ', ';', '"']).any(|word| word == "ord105"));
        let pair = |line: &str| {
            let cells: BTreeMap<String, String> = names.iter().cloned().zip(cells(line)).collect();
            let component = |file: &str| read_path(&folder.join(&cells[file]), &ReadOptions::default()).unwrap();
            let text = |key: &str| (key.to_owned(), cells[key].clone());
            let metadata = ["event", "magnitude", "rrup_km", "vs30"].map(text).into_iter().collect();
            let id = cells["record_id"].clone();
            RecordPair { id, h1: component("file_h1"), h2: component("file_h2"), metadata }
        };
        Some(of_set.map(pair).collect())
    });
    if pairs.is_none() {
        println!("skipped: no real records (set UPLIFT_RECORDS to a folder with a manifest.csv)");
    }
    pairs.as_deref()
}

/// Cells of a line of CSV; a quoted cell may hold commas.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    for (index, part) in line.split('"').enumerate() {
        // every other part is quoted
        let mut pieces = if index % 2 == 1 { vec![part] } else { part.split(',').collect() }.into_iter();
        cells.last_mut().unwrap().push_str(pieces.next().unwrap());
        cells.extend(pieces.map(str::to_owned));
    }
    cells
}

/// Demands of the set at all strengths, pooled: by PGV, then by PGA.
fn demands(pairs: &[RecordPair]) -> &'static [Vec<PooledDemand>; 2] {
    static DEMANDS: OnceLock<[Vec<PooledDemand>; 2]> = OnceLock::new();
    DEMANDS.get_or_init(|| {
        ScaledTo::BOTH.map(|scaled_to| {
            demands_m(pairs, scaled_to, &STRENGTHS).iter().map(|of_one| pooled(of_one, scaled_to)).collect()
        })
    })
}

fn compare_site(pairs: &[RecordPair], site: &Site, expected: &Expected) -> [Repaired; 2] {
    let (mut found, mut stripes) = (Vec::new(), Vec::new());
    for (index, scaled_to) in ScaledTo::BOTH.into_iter().enumerate() {
        let set = record_set(pairs, scaled_to);
        let name = format!("{} by {}", expected.site, scaled_to.measure());
        let analysis = site.analysis(&set, scaled_to);
        let repaired = compare(&name, &analysis, &expected.rows[index]);
        println!("{name}: {:?}", repaired.warnings);
        assert!((4..=5).contains(&repaired.fit.iterations), "{name}: {} steps", repaired.fit.iterations);
        for (target, ordinates_m) in targets().into_iter().zip(&expected.ordinates_m[index]) {
            if let Some(ordinates_m) = ordinates_m {
                let name = format!("{name}, {target:.2e} per year");
                compare_ordinates(&name, &repaired, &demands(pairs)[index], target, ordinates_m);
            }
        }
        found.push(repaired);
        stripes.push(analysis.stripes().clone());
    }
    let found = found.try_into().unwrap();
    // by PGV Aachen's stripes begin too high for 50 % in 50 years
    let count = if expected.site == "Aachen" { 2 } else { 3 };
    agree(&both_ways(demands(pairs), [&stripes[0], &stripes[1]], &found, &targets()[..count]));
    found
}

#[test]
fn the_set_at_three_sites_of_the_project() {
    let Some(pairs) = pairs() else { return };
    assert_eq!(pairs.len(), 105);
    for expected in project_sites() {
        let site = Site::former(expected.site);
        let repaired = compare_site(pairs, &site, &expected);
        for (index, scaled_to) in ScaledTo::BOTH.into_iter().enumerate() {
            let name = format!("{} by {}", expected.site, scaled_to.measure());
            let set = record_set(pairs, scaled_to);
            needs_nothing(&set, &site, scaled_to, &demands(pairs)[index]);
            let analysis = site.analysis(&set, scaled_to);
            let range = analysis.range();
            let lower_tail = name == "Aachen by PGV";
            let high = if lower_tail { 0.012938 } else { 0.0207944 };
            assert!((range.high_per_year / high - 1.0).abs() < 5e-5, "{name}: {range:?}");
            assert!((range.low_per_year / 0.000101014 - 1.0).abs() < 5e-6, "{name}: {range:?}");
            assert_eq!(range.high_limit == HighLimit::FirstStripe, lower_tail, "{name}: {range:?}");

            let most = match name.as_str() {
                "Aachen by PGV" => 0.02,
                "Montreux by PGV" => 0.0355,
                "Athens by PGV" => 0.0187,
                _ => 0.015,
            };
            let max = repaired[index].diagnosis.deviation.as_ref().unwrap().max;
            assert!(max < most + 0.002, "{name}: {max}");

            let close = |found: &[f64], expected: [f64; 3], tolerance: f64| {
                for (found, expected) in found.iter().zip(expected) {
                    assert!((found / expected - 1.0).abs() < tolerance, "{name}: {found} {expected}");
                }
            };
            let before = analysis.diagnose(None, [0.2, 5.0]).unwrap();
            let often: Vec<f64> = before.targets.iter().map(|target| target.times_as_often.unwrap()).collect();
            match name.as_str() {
                "Aachen by PGA" => {
                    close(&often, [6.954, 5.033, 2.888], 5e-4);
                    close(&scatter(&repaired[index]), [0.3496, 0.3334, 0.3023], 0.01);
                }
                "Athens by PGV" => {
                    close(&often, [1.125, 0.8008, 0.6056], 5e-4);
                    close(&scatter(&repaired[index]), [0.4124, 0.4279, 0.4608], 0.01);
                }
                _ => {}
            }
        }
    }
}

/// The difference between spectra by PGA and by PGV that a single scaled set makes, and how much of it is left: 144
/// ordinates of six sites, those of 10 mm and more.
#[test]
fn spectra_by_pga_and_by_pgv_agree_once_repaired() {
    let Some(pairs) = pairs() else { return };
    let sets = ScaledTo::BOTH.map(|scaled_to| record_set(pairs, scaled_to));
    let (mut before, mut after) = (Vec::new(), Vec::new());
    for name in ["Aachen", "Baden", "Montreux", "Perugia", "Focsani", "Athens"] {
        let site = Site::former(name);
        let [pgv, pga] = [0, 1].map(|index| site.analysis(&sets[index], ScaledTo::BOTH[index]));
        let repaired = [&pgv, &pga].map(|analysis| analysis.repair(&RepairOptions::default()).unwrap());
        let of_site = both_ways(demands(pairs), [pgv.stripes(), pga.stripes()], &repaired, &targets());
        for (all, of_site) in [&mut before, &mut after].into_iter().zip(of_site) {
            all.extend(of_site);
        }
        if name == "Aachen" {
            assert_eq!(repaired[0].warnings, [Warning::LowerTail]);
            let narrow = |warning: &&Warning| matches!(warning, Warning::NarrowScatter { .. });
            assert_eq!(repaired[1].warnings.iter().filter(narrow).count(), 3, "{:?}", repaired[1].warnings);
        }
    }
    assert_eq!(before.len(), 144);
    for (pairs_m, count, mean, rms) in [(&before, 46, 3.59, 1.395), (&after, 47, 1.0, 0.048)] {
        let found = from_10_mm(pairs_m);
        println!("{found:?}");
        assert_eq!(found.count, count, "{found:?}");
        assert!((found.geometric_mean / mean - 1.0).abs() < 0.005 && (found.rms - rms).abs() < 0.001, "{found:?}");
    }
}

/// Two digits are printed, of factors and of effective earthquakes.
#[test]
fn scale_factors_and_earthquakes_of_the_set() {
    let Some(pairs) = pairs() else { return };
    let set = record_set(pairs, ScaledTo::Pgv);
    let printed = |site: &str, target: usize, expected: [&str; 3]| {
        let site = Site::former(site);
        let found = site.analysis(&set, ScaledTo::Pgv).diagnose(None, [0.2, 5.0]).unwrap();
        let factors = found.targets[target].scale_factors.percentiles;
        for (factor, expected) in factors.into_iter().zip(expected) {
            let decimals = expected.split_once('.').unwrap().1.len();
            assert_eq!(format!("{factor:.decimals$}"), expected);
        }
        assert_eq!(format!("{:.1}", found.stripes[0].effective_events.unwrap()), "9.9");
        let medians = found.targets[target].medians;
        assert_eq!(format!("{:.1} {:.0}", medians.magnitude.unwrap(), medians.vs30_m_s.unwrap()), "6.9 362");
    };
    printed("Aachen", 0, ["0.20", "0.47", "1.5"]);
    printed("Athens", 0, ["0.71", "1.7", "5.4"]);
    printed("Aachen", 2, ["0.03", "0.07", "0.23"]);
}

#[test]
fn a_resample_of_the_set() {
    let Some(pairs) = pairs() else { return };
    let set = record_set(pairs, ScaledTo::Pgv);
    let site = Site::former("Athens");
    let analysis = site.analysis(&set, ScaledTo::Pgv);
    let solver = Solver::new(&analysis, 0.05).unwrap();
    let multiplicities: Vec<u32> = (0..set.len()).map(|record| if record % 2 == 0 { 2 } else { 0 }).collect();
    let mut scratch = Scratch::default();
    let fit = solver.solve(&multiplicities, &[0.0; KNOTS], &mut scratch).unwrap();
    for (found, expected) in fit.exponents.iter().zip([2.5899, 1.3331, 0.3544, -1.0698]) {
        assert!((found - expected).abs() < 0.05, "{fit:?}");
    }
    // from the set's exponents to the same
    let of_set = solver.solve(&set.once(), &[0.0; KNOTS], &mut scratch).unwrap();
    let again = solver.solve(&multiplicities, &of_set.exponents, &mut scratch).unwrap();
    for (found, expected) in again.exponents.iter().zip(fit.exponents) {
        assert!((found - expected).abs() < 1e-5, "{again:?} {fit:?}");
    }
    let mut shares = analysis.own_shares();
    solver.shares(&multiplicities, &fit.exponents, &mut scratch, &mut shares).unwrap();
    let weights = RunWeights::new(analysis.stripes(), &shares).unwrap();
    let after = analysis.diagnose(Some(&weights), [0.2, 5.0]).unwrap();
    let effective = |stripe: &StripeStatistics| stripe.effective_records;
    for (target, expected) in after.targets.iter().zip([49.77, 41.6, 23.96]) {
        assert!((effective(&after.stripes[target.stripe]) / expected - 1.0).abs() < 0.01);
    }
    assert!((after.least_effective.unwrap().records / 22.13 - 1.0).abs() < 0.01);
    let demands = &demands(pairs)[0];
    for (strength, expected) in ONE_BY_ONE.into_iter().zip([0.33435, 0.24196, 0.18515, 0.069013]) {
        let ordinate = RiskCurve::weighted(&demands[strength], &weights).unwrap().exact_ordinate(targets()[0]).unwrap();
        assert!((ordinate.displacement_m / expected - 1.0).abs() < 0.03, "{ordinate:?} {expected}");
    }
}

#[test]
fn twenty_records_of_one_side_are_out_of_reach() {
    let Some(pairs) = pairs() else { return };
    // by PGA q is PGV/PGA: the smallest PGA/PGV are the largest q
    let reach = |site: &str, scaled_to: ScaledTo, smallest_pga_over_pgv: bool| {
        let set: RecordSet = record_set(pairs, scaled_to);
        let site = Site::former(site);
        let analysis = site.analysis(&set, scaled_to);
        let solver = Solver::new(&analysis, 0.05).unwrap();
        let multiplicities = keep(&set, 20, smallest_pga_over_pgv == (scaled_to == ScaledTo::Pgv));
        let reach = solver.reach(&multiplicities).unwrap();
        let fit = solver.solve(&multiplicities, &[0.0; KNOTS], &mut Scratch::default()).unwrap();
        let rms = (fit.residuals.iter().map(|residual| residual * residual).sum::<f64>() / 12.0).sqrt();
        println!("{reach:?}, {} steps, rms {rms}", fit.iterations);
        (reach.set_above, reach.set_below, rms)
    };
    let (above, below, _) = reach("Aachen", ScaledTo::Pga, true);
    assert_eq!((above, below), (12, 0));
    let (above, below, _) = reach("Athens", ScaledTo::Pga, false);
    assert_eq!((above, below), (0, 6));
    let (above, below, _) = reach("Athens", ScaledTo::Pgv, false);
    assert_eq!((above, below), (7, 0));
    let (above, below, rms) = reach("Aachen", ScaledTo::Pga, false);
    assert_eq!((above, below), (0, 0));
    assert!((rms - 0.014).abs() < 0.002, "{rms}");
    let (above, below, _) = reach("Aachen", ScaledTo::Pgv, false);
    assert_eq!((above, below), (0, 0));
}

#[test]
fn a_set_out_of_reach_is_reported() {
    let Some(pairs) = pairs() else { return };
    let whole = record_set(pairs, ScaledTo::Pga);
    let kept = keep(&whole, 20, false);
    let records = whole.records().iter().zip(kept).filter(|(_, count)| *count > 0).map(|(record, _)| *record).collect();
    let set = RecordSet::new(records).unwrap();
    let site = Site::former("Aachen");
    let error = site.analysis(&set, ScaledTo::Pga).repair(&RepairOptions::default()).unwrap_err();
    assert!(matches!(error, ConsistencyError::NoRepair(uplift_consistency::NoRepair::OutOfReach { .. })), "{error}");
}

#[test]
fn the_curves_of_the_original_zones() {
    let Some(pairs) = pairs() else { return };
    for expected in original_zones() {
        compare_site(pairs, &Site::from_project(expected.site), &expected);
    }
}
