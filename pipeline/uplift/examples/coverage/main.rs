//! How often the bands of `uplift bootstrap` hold what they are bands of, by simulation with a known truth:
//!
//! ```sh
//! uplift run configs/europe.toml -o population.h5 --set records.synthetic.pairs=400 --set 'strengths.values=[0.1]'
//! cargo run --workspace --example coverage population.h5 400
//! ```
//!
//! The records of the result stand for the world: sets of 20, 40 and 105 are drawn from them with replacement, as many
//! as the last argument says, and each makes its bands as if it were all there is. Docs/method.md, Section 9, has the
//! table for real and for synthetic records.
#![allow(clippy::print_stdout, unreachable_pub)]

mod simulation;

use simulation::{BANDS, SIZES, coverage};
use uplift::result::{ResultFile, StoredStripes};

const REPLICATES: usize = 200;

fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [result, sets] = &arguments[..] else {
        println!("usage: coverage RESULT.h5 SETS");
        return Ok(());
    };
    let stored = StoredStripes::read(&ResultFile::open(result.as_ref())?)?;
    let counts = coverage(&stored, sets.parse()?, REPLICATES)?;
    println!("bands of 90 %, per cent of them: records in a set, band, held, too low, too high");
    for (size, counts) in SIZES.iter().zip(&counts) {
        for (band, counts) in BANDS.iter().zip(counts) {
            let [held, below, above] = counts.per_cent();
            println!("{size:6} {band:12} {held:6.1} {below:6.1} {above:6.1}");
        }
    }
    Ok(())
}
