//! Many sites at flat memory.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod cost;

use std::fmt::Write as _;
use std::io::{self, BufReader, Read};

use uplift_hazard::ExportedCurves;

use cost::peak_bytes;

const SITES: usize = 30_000;
const LEVELS: usize = 60;

/// An export that is written while it is read, so that it is nowhere as a whole.
struct Generated {
    site: usize,
    line: Vec<u8>,
    given: usize,
    bytes: usize,
}

fn level(index: usize) -> f64 {
    0.001 * 1.15_f64.powf(index as f64)
}

fn header() -> String {
    let mut text = "# kind='mean', investigation_time=1.0, imt='PGA'\nlon,lat,depth".to_owned();
    (0..LEVELS).for_each(|index| write!(text, ",poe-{:.7}", level(index)).unwrap());
    text + "\n"
}

fn row(site: usize) -> String {
    let mut text = format!("{:.5},{:.5},0.00000", 5.0 + 0.01 * (site % 200) as f64, 40.0 + 0.01 * (site / 200) as f64);
    (0..LEVELS).for_each(|index| write!(text, ",{:.6E}", 0.5 / (1.0 + (40.0 * level(index)).powi(2))).unwrap());
    text + "\n"
}

impl Read for Generated {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.given == self.line.len() && self.site < SITES {
            (self.line, self.given) = (row(self.site).into_bytes(), 0);
            self.site += 1;
        }
        let count = (&self.line[self.given..]).read(into)?;
        self.given += count;
        self.bytes += count;
        Ok(count)
    }
}

#[test]
fn thirty_thousand_sites_take_the_memory_of_one() {
    let generated = Generated { site: 0, line: header().into_bytes(), given: 0, bytes: 0 };
    let before = peak_bytes();
    let curves = ExportedCurves::from_reader(BufReader::new(generated), "generated.csv").unwrap();
    let (mut count, mut sum) = (0, 0.0);
    for curve in curves {
        let curve = curve.unwrap();
        count += 1;
        sum += curve.curve.rate_at(0.05).unwrap();
        assert_eq!(curve.curve.len(), LEVELS);
    }
    assert_eq!(count, SITES);
    // The same curve at every site: 0.5/(1 + 4) as a probability.
    assert!((sum / SITES as f64 / -(-0.1_f64).ln_1p() - 1.0).abs() < 1e-2);
    match (before, peak_bytes()) {
        // As text it has 25 MB, as curves 29 MB; to find repeated sites takes below 2 MB.
        (Some(before), Some(after)) => {
            println!("{} kB more at the peak", (after - before) / 1024);
            assert!(after - before < 6 << 20, "{} bytes", after - before);
        }
        _ => println!("skipped: this system does not say how much memory a process has had"),
    }
}
