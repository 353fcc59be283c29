//! How often bootstrap bands hold what they are bands of (docs/limits.md): sets drawn from all real records, which
//! stand for the world.

use rayon::prelude::*;
use uplift::result::{ResultFile, StoredMeasure, StoredStripes};
use uplift_bootstrap::{Band, Replicates, ResamplingPlan};
use uplift_fragility::Stripes;
use uplift_risk::PooledDemand;

use super::marks::hold;
use crate::common::{real_records, repository, uplift};

const SIZES: [u32; 3] = [20, 40, 105];
/// Sets of each size.
const DRAWN: usize = 400;
const REPLICATES: usize = 200;
const CONFIDENCE: f64 = 0.9;

/// Whether the ordinate lies below, within and above bands, and how many bands.
#[derive(Default, Clone, Copy)]
struct Counts {
    below: u32,
    above: u32,
    bands: u32,
}

impl Counts {
    fn and(self, other: Self) -> Self {
        Self { below: self.below + other.below, above: self.above + other.above, bands: self.bands + other.bands }
    }

    fn per_cent(self, count: u32) -> f64 {
        100.0 * f64::from(count) / f64::from(self.bands)
    }
}

/// The bands of the records that `multiplicities` draw, at all sites and probabilities of a measure and strength.
fn of_set(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    strength: usize,
    (multiplicities, resamples): (&[u32], &ResamplingPlan),
) -> Counts {
    let rows = multiplicities.iter().enumerate().flat_map(|(record, &times)| {
        let row = measure.edp_m.block([record, strength]);
        (0..times).flat_map(move |_| row.iter().copied())
    });
    let demand = PooledDemand::new(&Stripes::new(&measure.levels, &rows.collect::<Vec<_>>()).unwrap()).unwrap();
    let sites: Vec<_> = measure.weights.iter().collect();
    let replicates = Replicates::of(&demand, &sites, &stored.targets_per_year, resamples).unwrap();
    let mut counts = Counts::default();
    for site in 0..sites.len() {
        for poe in 0..stored.poes.len() {
            let mut sorted = replicates.ordinates_m(site, poe, 0).to_vec();
            sorted.sort_unstable_by(f64::total_cmp);
            let band = Band::percentile(&sorted, CONFIDENCE);
            let true_m = measure.exact_m[[site, poe, strength]];
            counts.bands += 1;
            counts.below += u32::from(true_m < band.lower_m);
            counts.above += u32::from(true_m > band.upper_m);
        }
    }
    counts
}

/// A minute or two: 1200 sets, eight strengths and measures, 200 resamples of each.
#[test]
#[ignore = "minutes: make doc-figures"]
fn of_sets_drawn_from_all_records() {
    let Some(records) = real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let manifest = format!("records.manifest={}", records.join("manifest.csv").display());
    let mut run = vec!["run", &study, "-o", "r.h5", "-q", "--set", &manifest];
    let set = ["risk.maf_surface=false", "strengths.values=[0.05, 0.1, 0.2, 0.3]", "risk.poe=[0.02, 0.1]"];
    run.extend(set.iter().flat_map(|set| ["--set", set]));
    uplift(folder.path(), &run).ok();
    let stored = ResultFile::open(&folder.path().join("r.h5")).unwrap().stripes().unwrap();
    let all = stored.records.len();
    let drawn = ResamplingPlan::draw(all, &SIZES, DRAWN, 1).unwrap();
    let places: Vec<(usize, usize)> = (0..stored.measures.len())
        .flat_map(|measure| (0..stored.strengths.len()).map(move |at| (measure, at)))
        .collect();
    let of_size = |(position, size): (usize, u32)| -> Counts {
        let sets = drawn.multiplicities();
        let sets: Vec<&[u32]> = sets.chunks(all).skip(position * DRAWN).take(DRAWN).collect();
        let of_one = |(number, set): (usize, &&[u32])| {
            let resamples = ResamplingPlan::draw(size as usize, &[size], REPLICATES, 2 + number as u64).unwrap();
            let of_place = |&(measure, strength): &(usize, usize)| {
                of_set(&stored, &stored.measures[measure], strength, (set, &resamples))
            };
            places.iter().map(of_place).fold(Counts::default(), Counts::and)
        };
        sets.par_iter().enumerate().map(of_one).reduce(Counts::default, Counts::and)
    };
    let counts: Vec<Counts> = SIZES.into_iter().enumerate().map(of_size).collect();
    let three = |share: &dyn Fn(&Counts) -> f64| {
        let [small, middle, large] = [0, 1, 2].map(|size| format!("{:.0}", share(&counts[size])));
        format!("{small}, {middle} and {large} %")
    };
    let name = |name: &str| format!("coverage.{name}");
    hold(
        "coverage",
        &[
            (name("records"), all.to_string()),
            (name("held"), three(&|of| of.per_cent(of.bands - of.below - of.above))),
            (name("above"), three(&|of| of.per_cent(of.above))),
            (name("below"), three(&|of| of.per_cent(of.below))),
        ],
    );
}
