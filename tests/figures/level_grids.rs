//! What the first levels of a study do to its ordinates (docs/method.md, section 6).

use super::marks::hold;
use super::{ordinates, quantile, range, with_real_records};
use crate::common::{repository, uplift};

const STRENGTHS: &str = "strengths.values=0.05:0.05:1";
/// Levels from the foot of the curves on that hold all others: 579 and 395.
const DENSE: [&str; 2] = [
    "pgv.levels_cm_s=[\"0.1:0.05:20\", \"21:1:200\"]",
    "pga.levels_g=[\"0.001:0.00025:0.03\", \"0.0325:0.0025:0.2\", \"0.205:0.005:0.5\", \"0.51:0.01:2\"]",
];
const CHAPTER_4: &str = "pgv.levels_cm_s=[\"1:0.5:20\", \"25:5:200\"]";

/// What one record of 105 at the first level of Chapter 4 weighs at Athens, 1/yr: half of what lies between the foot of
/// the curve and the second level.
#[test]
fn one_record_at_the_first_level() {
    let text = std::fs::read_to_string(repository().join("hazard/athens/pgv.csv")).unwrap();
    let points: Vec<[f64; 2]> = (text.lines())
        .filter_map(|line| line.split_once(',').and_then(|(im, maf)| Some([im.parse().ok()?, maf.parse().ok()?])))
        .collect();
    let second: f64 = 1.5;
    let next = points.iter().position(|[im, _]| *im > second).unwrap();
    let [[im_a, maf_a], [im_b, maf_b]] = [points[next - 1], points[next]];
    let slope = (maf_b / maf_a).ln() / (im_b / im_a).ln();
    let weight = 0.5 * (points[0][1] - maf_a * (second / im_a).powf(slope)) / 105.0;
    hold("levels-at-athens", &[("levels-at-athens.one-record".to_owned(), format!("{weight:.4}"))]);
}

/// Minutes: 2 x 2 million analyses.
#[test]
#[ignore = "minutes: make doc-figures"]
fn ordinates_over_those_of_dense_levels() {
    let Some(real) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let mut computed = Vec::new();
    for (set, records) in [("synthetic", &[][..]), ("real", &real[..])] {
        // one result in one place: what the dense levels hold is not computed again
        let spectra = |levels: &[&str]| {
            let surface = "risk.maf_surface=false";
            let run = ["run", &study, "-o", "r.h5", "-q", "--force", "--set", surface, "--set", STRENGTHS];
            let mut run = run.map(str::to_owned).to_vec();
            run.extend_from_slice(records);
            run.extend(levels.iter().flat_map(|levels| ["--set".to_owned(), (*levels).to_owned()]));
            uplift(folder.path(), &run).ok();
            ordinates(&folder.path().join("r.urs.csv"))
        };
        let dense = spectra(&DENSE);
        for (levels, coarse) in [("default", spectra(&[])), ("chapter-4", spectra(&[CHAPTER_4]))] {
            for (im, poe) in ["PGV", "PGA"].into_iter().flat_map(|im| [0.02, 0.1, 0.5].map(|poe| (im, poe))) {
                if (im, levels) == ("PGA", "chapter-4") {
                    continue; // the default
                }
                let both = dense.iter().zip(&coarse).filter(|(_, ours)| ours.im == im && ours.poe == poe);
                let ratios: Vec<f64> = both
                    .inspect(|(dense, ours)| assert!(dense.site == ours.site && dense.strength == ours.strength))
                    .filter(|(dense, _)| dense.u_m > 0.0)
                    .map(|(dense, ours)| ours.u_m / dense.u_m)
                    .collect();
                let [median, low, high] = [0.5, 0.05, 0.95].map(|level| quantile(&ratios, level));
                let most = range(ratios)[1];
                let name = format!("levels.{set}.{levels}.{}.{}", im.to_lowercase(), 100.0 * poe);
                computed.push((name, format!("{median:.2} ({low:.2}–{high:.2}, {most:.2})")));
            }
        }
    }
    hold("levels", &computed);
}
