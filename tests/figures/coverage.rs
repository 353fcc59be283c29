//! How often bands hold what they are bands of (docs/method.md, Section 9): sets drawn from real and from synthetic
//! records, which stand for the world.

use uplift::result::{ResultFile, StoredStripes};

use self::simulation::{BANDS, SIZES, coverage};
use super::marks::hold;
use crate::common::{real_records, repository, uplift};

mod simulation;

/// Sets of each size.
const DRAWN: usize = 400;
/// Resamples of each, for the percentile and BCa.
const REPLICATES: usize = 200;
/// Synthetic pairs that stand for the world.
const SYNTHETIC_PAIRS: usize = 400;

/// Minutes: 1200 sets from each population, two sites, twelve strengths and measures, three probabilities.
#[test]
#[ignore = "minutes: make doc-figures"]
fn of_sets_drawn_from_all_records() {
    let Some(records) = real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = std::fs::read_to_string(repository().join("configs/europe.toml")).unwrap();
    // two of its sites
    let (head, sites) = study.split_once("[[sites]]").unwrap();
    let (sites, rest) = sites.split_once("# The fit").unwrap();
    let kept: Vec<&str> = sites.split("[[sites]]").take(2).collect();
    let hazard = format!("{}/hazard", repository().display());
    let text = format!("{head}[[sites]]{}# The fit{rest}", kept.join("[[sites]]")).replace("../hazard", &hazard);
    std::fs::write(folder.path().join("two.toml"), text).unwrap();
    let real = format!("records.manifest={}", records.join("manifest.csv").display());
    let synthetic = format!("records.synthetic.pairs={SYNTHETIC_PAIRS}");
    let mut figures = Vec::new();
    for (name, source) in [("real", &real), ("synthetic", &synthetic)] {
        let strengths = "strengths.values=[0.05, 0.1, 0.2, 0.3, 0.5, 0.8]";
        let set = ["risk.maf_surface=false", strengths, source];
        let mut run = vec!["run", "two.toml", "-o", "r.h5", "-q", "--force"];
        run.extend(set.iter().flat_map(|set| ["--set", *set]));
        uplift(folder.path(), &run).ok();
        let stored = StoredStripes::read(&ResultFile::open(&folder.path().join("r.h5")).unwrap()).unwrap();
        if name == "real" {
            figures.push(("coverage.records".to_owned(), stored.records.len().to_string()));
        }
        let counts = coverage(&stored, DRAWN, REPLICATES).unwrap();
        for (size, counts) in SIZES.iter().zip(&counts) {
            for (band, counts) in BANDS.iter().zip(counts) {
                let [held, below, above] = counts.per_cent();
                let shares = format!("{held:.1} ({below:.1}, {above:.1})");
                figures.push((format!("coverage.{name}.{band}.{size}"), shares));
            }
        }
    }
    hold("coverage", &figures);
}
