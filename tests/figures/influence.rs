//! What single records weigh by PGA (docs/comparison.md): real records.

use std::fmt::Write as _;

use super::marks::hold;
use super::{range, with_real_records};
use crate::common::{repository, uplift};

/// The long, strong Chi-Chi motions of the set that is compared.
const STATIONS: [&str; 2] = ["TCU107", "TCU109"];

#[test]
#[ignore = "long: make test-long"]
fn of_long_strong_motions() {
    let Some(set) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let run = ["run", &study, "-o", "r.h5", "-q", "--set", "risk.maf_surface=false"].map(str::to_owned);
    let strengths = ["--set", "strengths.values=0.05:0.05:1"].map(str::to_owned);
    uplift(folder.path(), &[&run[..], &strengths, &set].concat()).ok();
    uplift(folder.path(), &["influence", "r.h5", "-q"]).ok();
    let table = std::fs::read_to_string(folder.path().join("r.influence.csv")).unwrap();
    // site, im, poe, years, record, mean and largest change in per cent
    let rows: Vec<Vec<&str>> = table.lines().skip(2).map(|line| line.split(',').collect()).collect();
    let mut said = String::new();
    for (place, station) in STATIONS.into_iter().enumerate() {
        let of_station = rows.iter().filter(|row| row[1] == "PGA" && row[2] == "0.02" && row[4].contains(station));
        let largest: Vec<f64> = of_station.map(|row| row[6].parse().unwrap()).collect();
        assert_eq!(largest.len(), 6, "{station}");
        let [most, least] = range(largest).map(|percent| -percent);
        let separator = if place == 0 { "" } else { ", " };
        write!(said, "{separator}{station} {least:.0} to {most:.0} %").unwrap();
    }
    hold("influence", &[("influence.lowers".to_owned(), said)]);
}
