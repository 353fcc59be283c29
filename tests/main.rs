//! The built program from end to end: whole studies from the command line, what they leave, what is said to mistakes.
//!
//! One program, so that everything is linked once. Its tests run side by side: each has a folder of its own
//! ([`common::SmallStudy`]), and one that stops a run at a moment waits for a sign of that moment, not for a time.
#![allow(clippy::unwrap_used, clippy::print_stdout, unreachable_pub)]

mod common;

mod alarms;
mod archives;
mod asked;
mod at_level;
mod at_level_consistency;
mod block_response;
mod bootstrap;
mod consistency;
mod damage;
mod design;
mod directions;
mod displacement_figures;
mod displacement_resume;
mod displacement_spectra;
mod epistemic;
mod exports;
mod figures;
mod findings;
mod first_hour;
mod fragility;
mod frame_response;
mod frame_risk;
mod hazard;
mod instructions;
mod joint_bands;
mod levels;
mod library;
mod limits;
mod measures;
mod mistakes;
mod outputs;
mod overturning;
mod progress;
mod pulse;
mod pushover;
mod python;
mod quiet;
mod records;
mod repaired_bands;
mod report;
mod response;
mod result_file;
mod resume;
mod rounding;
mod run;
mod schema;
mod selections;
mod shake_table;
mod site_table;
mod site_table_repair;
mod spectrum;
mod spreadsheets;
mod structure_resume;
mod study_uncertainty;
mod sweep;
mod table_4_2;
mod target;
mod texts;
mod torture_files;
mod uncertainty;
mod validate;
mod words;
