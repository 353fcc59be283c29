//! Spectra of the embedded set beside those of real records (docs/synthetic-motions.md).

use super::marks::hold;
use super::{ordinates, quantile, range, with_real_records};
use crate::common::{repository, uplift};

/// Ordinates of 2 % in 50 years, embedded set over real set, over the six sites.
#[test]
#[ignore = "long: make test-long"]
fn spectra_of_the_embedded_set_over_real_ones() {
    let Some(real) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let spectra = |records: &[String]| {
        let run = ["run", &study, "-o", "r.h5", "-q", "--force", "--set", "risk.maf_surface=false", "--set"]
            .map(str::to_owned);
        let strengths = ["strengths.values=[0.05, 0.1, 0.2, 0.3, 0.5]".to_owned()];
        uplift(folder.path(), &[&run[..], &strengths, records].concat()).ok();
        ordinates(&folder.path().join("r.urs.csv"))
    };
    let (embedded, real) = (spectra(&[]), spectra(&real));
    let mut computed = Vec::new();
    // where a structure rocks much
    for im in ["PGV", "PGA"] {
        let both = embedded.iter().zip(&real);
        let rocking = both.filter(|(row, _)| row.im == im && row.strength < 0.21 && (row.poe - 0.02).abs() < 1e-9);
        let ratios: Vec<f64> = rocking.map(|(ours, real)| ours.u_m / real.u_m).collect();
        computed.push((format!("embedded-set.{im}.median"), format!("{:.2}", quantile(&ratios, 0.5))));
    }
    for (im, strength) in ["PGV", "PGA"].into_iter().flat_map(|im| [0.05, 0.1, 0.2, 0.3, 0.5].map(|eta| (im, eta))) {
        let both = embedded
            .iter()
            .zip(&real)
            .filter(|(row, _)| row.im == im && (row.strength - strength).abs() < 1e-9 && (row.poe - 0.02).abs() < 1e-9);
        let [low, high] = range(both.map(|(ours, real)| ours.u_m / real.u_m));
        computed.push((format!("embedded-set.{im}.{strength}"), format!("{low:.2}–{high:.2}")));
    }
    hold("embedded-set", &computed);
}
