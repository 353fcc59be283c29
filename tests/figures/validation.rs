//! Table 6.2 decoded, and what its tests would have seen (docs/validation.md).

use uplift_validation::{Evidence, KolmogorovSmirnov, Resampling, Sample, detectable_factor};

use super::marks::hold;
use crate::common::repository;

/// Dispersion of the power of the document.
const DISPERSION: f64 = 0.7;

#[test]
fn table_6_2_decoded() {
    let reference = std::fs::read_to_string(repository().join("tests/reference/table_6_2.csv")).unwrap();
    let mut computed = Vec::new();
    for line in reference.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [n, k] = [cells[2], cells[3]].map(|cell| cell.parse::<u32>().unwrap());
        let values = |from: f64| Sample::new((0..n).map(|place| f64::from(place) + from).collect()).unwrap();
        let test = KolmogorovSmirnov::of(&values(0.0), &values(f64::from(k) - 0.5));
        let sizes = (n as usize, n as usize);
        let sees = detectable_factor(sizes, DISPERSION, 0.1, Resampling { replicates: 2000, seed: 1 }).unwrap();
        let name = |what: &str| format!("validation.{}.{}.{what}", cells[0], cells[1]);
        computed.push((name("kstest2"), format!("{:.3}", test.p_kstest2)));
        computed.push((name("exact"), format!("{:.3}", test.p_exact)));
        computed.push((name("evidence"), Evidence::of(test.p_exact).words().to_owned()));
        computed.push((name("sees"), format!("{:.2}", sees.unwrap())));
    }
    hold("validation", &computed);
}
