//! What rounding makes of uniform risk ordinates (docs/method.md, section 1.5): the same spectra at neighbouring
//! levels, real records.

use super::marks::hold;
use super::{Ordinate, ordinates, quantile, range, with_real_records};
use crate::common::{repository, uplift};

/// Neighbours on each side, 1e-15 apart: as many as the program itself looks at where it marks.
const NEIGHBOURS: i32 = 4;
/// Levels of configs/europe.toml: first, step and last.
const PGV_CM_S: [[f64; 3]; 3] = [[0.1, 0.1, 0.9], [1.0, 0.5, 20.0], [25.0, 5.0, 200.0]];
const PGA_G: [[f64; 3]; 4] = [[0.001, 1.0, 0.001], [0.0025, 0.0025, 0.0225], [0.025, 0.005, 0.195], [0.2, 0.05, 2.0]];

/// The levels of a grid, each times `factor`, as a study has them.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of steps")]
fn levels(grid: &[[f64; 3]], factor: f64) -> String {
    let of = |&[first, step, last]: &[f64; 3]| {
        let steps = ((last - first) / step).round() as u32;
        (0..=steps).map(move |at| (first + f64::from(at) * step) * factor)
    };
    format!("{:?}", grid.iter().flat_map(of).collect::<Vec<f64>>())
}

/// What is printed of an ordinate, m.
fn shown(u_m: f64) -> String {
    format!("{u_m:.4}")
}

#[test]
#[ignore = "minutes: make doc-figures"]
fn at_neighbouring_levels() {
    let Some(records) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let spectra = |step: i32| -> Vec<Ordinate> {
        let factor = 1.0 + f64::from(step) * 1e-15;
        let set = [
            "risk.maf_surface=false".to_owned(),
            // the first level is the end of the curves
            "risk.extrapolate=loglog".to_owned(),
            "strengths.values=[0.05, 0.1, 0.2, 0.3, 0.4, 0.5]".to_owned(),
            format!("pgv.levels_cm_s={}", levels(&PGV_CM_S, factor)),
            format!("pga.levels_g={}", levels(&PGA_G, factor)),
        ];
        let mut run = ["run", &study, "-o", "r.h5", "-q", "--force"].map(str::to_owned).to_vec();
        run.extend(set.into_iter().flat_map(|set| ["--set".to_owned(), set]));
        run.extend_from_slice(&records);
        uplift(folder.path(), &run).ok();
        ordinates(&folder.path().join("r.urs.csv"))
    };
    let own = spectra(0);
    let others: Vec<Vec<Ordinate>> = (1..=NEIGHBOURS).flat_map(|step| [-step, step]).map(spectra).collect();
    let mut changes = Vec::new();
    let mut otherwise = 0;
    for (place, Ordinate { u_m, .. }) in own.iter().enumerate().filter(|(_, of)| of.u_m.is_finite() && of.u_m > 0.0) {
        let neighbours = || others.iter().map(|other| other[place].u_m);
        changes.push(range(neighbours().map(|other_m| (other_m / u_m - 1.0).abs()))[1]);
        otherwise += u32::from(neighbours().any(|other_m| shown(other_m) != shown(*u_m)));
    }
    let of = |count: u32| format!("{:.0} %", 100.0 * f64::from(count) / changes.len() as f64);
    let per_cent = |change: f64| format!("{:.2} %", 100.0 * change);
    let name = |name: &str| format!("rounding-ordinates.{name}");
    hold(
        "rounding-ordinates",
        &[
            (name("count"), changes.len().to_string()),
            (name("otherwise"), of(otherwise)),
            (name("p90"), per_cent(quantile(&changes, 0.9))),
            (name("p99"), per_cent(quantile(&changes, 0.99))),
            (name("most"), per_cent(range(changes.iter().copied())[1])),
        ],
    );
}
