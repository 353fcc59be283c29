//! Reference cases of rocking columns and frames, anyone's: reads a file of them, computes each anew and prints what
//! does not agree.
//!
//! ```sh
//! cargo run -p uplift-frame --example frames_cases FILE.json
//! ```
//!
//! The file is an object with any of these lists, SI units and radians; see `tests/data`:
//!
//! | list | a case |
//! |---|---|
//! | `statics` | columns with a restrainer as in a structure file, expected `scalars` and `points` |
//! | `discs` | a disc spring, expected forces at deflections |
//! | `planar`, `wobbling` | a frame, its restrainer, the ground's motion and the start; expected peaks and end |
//! | `validation` | `measured` and `computed` peaks; expected statistics |
//! | `cases` | a frame by R, α and γ, in kN, m and Mg, that wobbles freely: shaken ones are left out |
//! | `shake_table` | a pair of records; expected factor and PGA for 0.335 m/s in a scale of 1:5 |
//!
//! Records that cases name are looked for below the folder of the environment variable `UPLIFT_RECORDS`. A case may
//! have its own tolerance; else it is 1e-9, relative, and 1e-12 for discs. Each line of output is
//! `case quantity: ours | expected | tolerance`; the last says how many cases agree. Exit code 1 if one does not.
#![allow(clippy::print_stdout)]

use std::process::ExitCode;

use cases::{Verdict, verdicts};

#[path = "frames_cases/cases.rs"]
mod cases;

fn main() -> ExitCode {
    let Some(file) = std::env::args().nth(1) else {
        println!("which file? cargo run -p uplift-frame --example frames_cases FILE.json");
        return ExitCode::from(2);
    };
    let text = match std::fs::read_to_string(&file) {
        Ok(text) => text,
        Err(error) => {
            println!("{file}: {error}");
            return ExitCode::from(2);
        }
    };
    let verdicts = match verdicts(&text) {
        Ok(verdicts) => verdicts,
        Err(error) => {
            println!("{file}: {error}");
            return ExitCode::from(2);
        }
    };
    let failed = |verdict: &&Verdict| !verdict.differences.is_empty();
    for verdict in verdicts.iter().filter(failed) {
        for difference in &verdict.differences {
            println!("{} {difference}", verdict.id);
        }
    }
    let agree = verdicts.iter().filter(|verdict| verdict.differences.is_empty()).count();
    println!("{agree} of {} cases", verdicts.len());
    if agree == verdicts.len() && agree > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
