//! How often 90 % bands hold what they are bands of, where the truth is known: `make coverage`, some minutes.
//!
//! Real records (both components of each, `UPLIFT_RECORDS` or `../shared/records`) and synthetic ones of other seeds
//! stand for the world. Sets of 20, 40 and 105 are drawn from them with replacement, and each makes its bands as if it
//! were all there is: of six sites, three probabilities, six strengths, by PGV and PGA; of the width by which a frame
//! meets four targets; and of the rate at which it overturns by a lognormal fragility. docs/confidence-bands.md has the
//! table. Arguments: the number of sets, then parts (records, values, lognormal, earthquakes) and sizes of sets.
#![allow(clippy::print_stdout, unreachable_pub)]

mod lognormal;
mod sets;
mod tally;
mod values;

use std::path::PathBuf;

use sets::{Failed, Population, Tallies};
use uplift::{RunOptions, Silent, load_study};

/// Sets of each size, where no other number is given.
const SETS: usize = 200;
/// Records in a set.
const SIZES: [u32; 3] = [20, 40, 105];
/// Earthquakes in a set.
const EARTHQUAKES: [u32; 6] = [3, 5, 10, 15, 27, 54];

fn main() -> Result<(), Failed> {
    let mut given = std::env::args().skip(1);
    let sets = given.next().map_or(Ok(SETS), |given| given.parse())?;
    let (sizes, parts): (Vec<String>, Vec<String>) = given.partition(|given| given.parse::<u32>().is_ok());
    let sizes = sizes.iter().map(|size| size.parse()).collect::<Result<Vec<u32>, _>>()?;
    let asked = Asked { sets, parts, sizes: if sizes.is_empty() { SIZES.to_vec() } else { sizes } };
    let folder = std::env::var_os("UPLIFT_RECORDS").map_or_else(|| PathBuf::from("../shared/records"), PathBuf::from);
    let manifest = folder.join("manifest.csv");
    if manifest.is_file() {
        let manifest = manifest.canonicalize()?;
        let real = population(&[format!("records.manifest={}", manifest.display()), "records.component=both".into()])?;
        println!("{} real records", real.stored.records.len());
        measure(&real, &asked)?;
    } else {
        println!("skipped: no real records (set UPLIFT_RECORDS to a folder with a manifest.csv)");
    }
    let synthetic = population(&["records.synthetic.pairs=400".into(), "records.synthetic.seed=7".into()])?;
    println!("\n{} synthetic records", synthetic.stored.records.len());
    measure(&synthetic, &asked)
}

/// What is to be measured.
struct Asked {
    /// Sets of each size.
    sets: usize,
    /// All where none are named.
    parts: Vec<String>,
    /// Records in a set.
    sizes: Vec<u32>,
}

/// Prints the parts asked for; synthetic records are of no earthquake.
fn measure(population: &Population, Asked { sets, parts, sizes }: &Asked) -> Result<(), Failed> {
    let is_asked = |part: &str| parts.is_empty() || parts.iter().any(|own| own == part);
    if is_asked("records") {
        print(population, &population.records(sizes, *sets)?, "records");
    }
    if is_asked("values") {
        print(population, &population.values(sizes, *sets)?, "records");
    }
    if is_asked("lognormal") {
        print(population, &population.lognormal(sizes, *sets)?, "records");
    }
    if is_asked("earthquakes") && population.shares_earthquakes() {
        print(population, &population.earthquakes(&EARTHQUAKES, *sets)?, "earthquakes");
    }
    Ok(())
}

/// The study of six sites with these records, run once.
fn population(records: &[String]) -> Result<Population, Failed> {
    let study_file = PathBuf::from("configs/europe.toml");
    let strengths = "strengths.values=[0.05, 0.1, 0.2, 0.3, 0.5, 0.8]".to_owned();
    let overrides = [records, &[strengths, "risk.maf_surface=false".to_owned()]].concat();
    let study = load_study(&study_file, &overrides)?;
    let folder = tempfile::tempdir()?;
    let output = folder.path().join("population.h5");
    let options = RunOptions {
        study_file,
        output: Some(output.clone()),
        command: "coverage".to_owned(),
        overrides,
        ..RunOptions::default()
    };
    uplift::run(&study, &options, &Silent)?;
    Population::open(&output)
}

fn print(population: &Population, tallies: &Tallies, drawn: &str) {
    let rare = population.rare();
    println!(
        "\n{drawn:>11} band                    held, %   unsafe   above   no band   cells of 2 and 10 % below 82 %"
    );
    for ((band, size), tally) in tallies {
        println!("{size:11} {band:21} {}", tally.line(&rare));
        if (band.starts_with("plain") || band.starts_with("repaired")) && !band.ends_with("percentile") {
            let stored = &population.stored;
            for ([im, site, poe, strength], held) in tally.worst(&rare, 3) {
                println!(
                    "{:11} least: {held} at {} by {}, {} % in 50 years, strength {}",
                    "",
                    stored.sites[site],
                    stored.measures[im].measure.label(),
                    100.0 * stored.poes[poe],
                    stored.strengths[strength]
                );
            }
        }
    }
}
