//! What the displacement at uplift and the restitution do to spectra (docs/design-rules.md).

use std::collections::BTreeMap;

use super::marks::hold;
use super::{Ordinate, ordinates, quantile, range, with_real_records};
use crate::common::{repository, uplift};

const STRENGTHS: [f64; 5] = [0.05, 0.1, 0.2, 0.3, 0.5];
/// Rows of the table: name, key of the oscillator, value.
const ROWS: [(&str, &str, f64); 6] = [
    ("2-mm", UPLIFT, 0.002),
    ("5-mm", UPLIFT, 0.005),
    ("20-mm", UPLIFT, 0.02),
    ("0.85", RESTITUTION, 0.85),
    ("0.90", RESTITUTION, 0.9),
    ("0.98", RESTITUTION, 0.98),
];
/// Displacements at uplift of structures, mm, and the demands over them that are told apart.
const OF_STRUCTURES_MM: [f64; 6] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0];
const DEMANDS: [(&str, [f64; 2]); 3] =
    [("above-100", [100.0, f64::INFINITY]), ("20-50", [20.0, 50.0]), ("5-10", [5.0, 10.0])];

const UPLIFT: &str = "oscillator.uplift_displacement_m";
const RESTITUTION: &str = "oscillator.restitution";

/// Ordinates by site, measure, probability and strength, m.
type Spectra = BTreeMap<(String, String, String, String), f64>;

/// The six sites with `settings` of the oscillator and options `more`.
fn spectra(settings: &[(&str, f64)], more: &[String]) -> Spectra {
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let mut run = ["run", &study, "-o", "r.h5", "-q", "--set", "risk.maf_surface=false"].map(str::to_owned).to_vec();
    run.extend(["--set".to_owned(), format!("strengths.values={STRENGTHS:?}")]);
    run.extend(settings.iter().flat_map(|(key, value)| ["--set".to_owned(), format!("{key}={value}")]));
    run.extend_from_slice(more);
    uplift(folder.path(), &run).ok();
    let key =
        |Ordinate { site, im, poe, strength, u_m }: Ordinate| ((site, im, poe.to_string(), strength.to_string()), u_m);
    ordinates(&folder.path().join("r.urs.csv")).into_iter().map(key).collect()
}

/// Ordinates over those of `base` by PGV, 2 % in 50 years, at the six sites.
fn ratios(spectra: &Spectra, base: &Spectra, strength: f64) -> Vec<f64> {
    let wanted = |(_, im, poe, of): &(String, String, String, String)| {
        im == "PGV" && poe == "0.02" && *of == strength.to_string()
    };
    base.iter().filter(|(key, _)| wanted(key)).map(|(key, base_m)| spectra[key] / base_m).collect()
}

/// Three digits at most, and no more than a ratio of chaotic responses deserves.
fn short(ratio: f64) -> String {
    match ratio {
        _ if ratio < 2.0 => format!("{ratio:.2}"),
        _ if ratio < 10.0 => format!("{ratio:.1}"),
        _ => format!("{ratio:.0}"),
    }
}

fn name(name: &str) -> String {
    format!("own-oscillator.{name}")
}

/// A minute: sixteen runs of five strengths.
#[test]
#[ignore = "minutes: make doc-figures"]
fn of_real_records() {
    let Some(records) = with_real_records() else { return };
    let base = spectra(&[], &records);
    let mut computed = Vec::new();
    for strength in STRENGTHS {
        let of_strength =
            base.iter().filter(|((_, im, poe, of), _)| im == "PGV" && poe == "0.02" && *of == strength.to_string());
        let metres = |u_m: f64| if u_m < 0.01 { format!("{u_m:.3}") } else { format!("{u_m:.2}") };
        let [low, high] = range(of_strength.map(|(_, u_m)| *u_m)).map(metres);
        computed.push((name(&format!("ordinate.{strength}")), format!("{low}–{high}")));
    }
    let mut medians = BTreeMap::new();
    for (row, key, value) in ROWS {
        let other = spectra(&[(key, value)], &records);
        for strength in STRENGTHS {
            let ratios = ratios(&other, &base, strength);
            assert_eq!(ratios.len(), 6);
            let ([low, high], median) = (range(ratios.iter().copied()), quantile(&ratios, 0.5));
            medians.entry(row).or_insert_with(Vec::new).push(median);
            let cell = format!("{} ({}–{})", short(median), short(low), short(high));
            computed.push((name(&format!("{row}.{strength}")), cell));
        }
    }
    let [[_, least], [most, _]] = ["0.90", "0.98"].map(|row| range(medians[row].iter().copied()));
    assert!(least < 1.0 && most > 1.0, "the restitution matters at every strength");
    for row in ["0.90", "0.98"] {
        let changes = range(medians[row].iter().map(|median| 100.0 * (median - 1.0).abs()));
        computed.push((name(&format!("{row}.change")), format!("{:.0} to {:.0} %", changes[0], changes[1])));
    }
    let own: Vec<(f64, Spectra)> =
        OF_STRUCTURES_MM.map(|mm| (mm / 1e3, spectra(&[(UPLIFT, mm / 1e3)], &records))).into();
    for (demand, [from, to]) in DEMANDS {
        let within = |uplift_m: f64, u_m: f64| u_m.is_finite() && from * uplift_m < u_m && u_m <= to * uplift_m;
        let ratios: Vec<f64> = (own.iter())
            .flat_map(|(uplift_m, own)| {
                base.iter().filter(|(_, u_m)| within(*uplift_m, **u_m)).map(|(key, u_m)| own[key] / u_m)
            })
            .collect();
        let [low, median, high] = [0.05, 0.5, 0.95].map(|level| format!("{:.2}", quantile(&ratios, level)));
        computed.push((name(demand), format!("{median} (90 % of them {low} to {high})")));
    }
    hold("own-oscillator", &computed);
}

#[test]
#[ignore = "long: make test-long"]
fn of_the_embedded_records() {
    let base = spectra(&[], &[]);
    let [flexible, lossless] = [(UPLIFT, 0.005), (RESTITUTION, 0.98)].map(|setting| spectra(&[setting], &[]));
    let median = |other: &Spectra, strength: f64| format!("{:.2}", quantile(&ratios(other, &base, strength), 0.5));
    let name = |name: &str| format!("own-oscillator-embedded.{name}");
    hold(
        "own-oscillator-embedded",
        &[
            (name("5-mm.0.1"), median(&flexible, 0.1)),
            (name("5-mm.0.2"), median(&flexible, 0.2)),
            (name("0.98.0.1"), median(&lossless, 0.1)),
        ],
    );
}
