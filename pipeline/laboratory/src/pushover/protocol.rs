//! Loading protocols (Figure 5.11), by themselves and with columns under them.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_statics::{CyclicState, LoadingProtocol, ProtocolPoint, RestrainedColumns};

use super::report::CyclicReport;
use super::tables;
use crate::error::LaboratoryError;

/// Points in a quarter of a cycle of columns under a protocol.
const PARTS: u32 = 40;

/// A protocol as asked for.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ProtocolOptions {
    /// The protocol.
    #[arg(skip)]
    pub protocol: LoadingProtocol,
    /// Points in a quarter of a cycle
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub parts: u32,
    /// Write drift over time
    #[arg(short = 'o', long = "output", value_name = "FILE.csv")]
    pub table: Option<PathBuf>,
    /// Whether an existing file there is overwritten.
    #[arg(skip)]
    pub force: bool,
}

/// A protocol in numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProtocolReport {
    /// Amplitudes of the sets, as drift ratios.
    pub amplitudes: Vec<f64>,
    /// Duration, s.
    pub duration_s: f64,
    /// The history.
    #[serde(skip)]
    pub history: Vec<ProtocolPoint>,
    /// The files written.
    pub files: Vec<PathBuf>,
}

/// Computes a loading protocol, and writes its history where that is asked for.
///
/// # Errors
/// A history of too many points; a table that would replace something else or cannot be written.
pub fn protocol(options: &ProtocolOptions, events: &dyn Events) -> Result<ProtocolReport, LaboratoryError> {
    if let Some(table) = &options.table {
        let nothing: [&Path; 0] = [];
        outputs::check(&[Output::new(table, OutputKind::Table(tables::PROTOCOL_COLUMN))], &nothing, options.force)?;
    }
    let mut report = ProtocolReport {
        amplitudes: options.protocol.amplitudes(),
        duration_s: options.protocol.duration_s(),
        history: options.protocol.history(options.parts)?,
        files: Vec::new(),
    };
    if let Some(table) = &options.table {
        events.writing_into(table.parent().unwrap_or(Path::new("")));
        tables::write_protocol(&options.protocol, &report.history, table)?;
        report.files.push(table.clone());
    }
    Ok(report)
}

impl CyclicReport {
    pub(super) fn new(columns: &RestrainedColumns, protocol: LoadingProtocol) -> Result<Self, LaboratoryError> {
        let states = columns.under(&protocol.history(PARTS)?)?;
        let largest = |value: fn(&CyclicState) -> f64| states.iter().map(value).fold(0.0, f64::max);
        Ok(Self {
            amplitudes: protocol.amplitudes(),
            duration_s: protocol.duration_s(),
            largest_force_n: largest(|state| state.force_n.map_or(0.0, f64::abs)),
            largest_tendon_n: largest(|state| state.tendon_n),
            dissipated_j: states.last().map_or(0.0, |state| state.dissipated_j),
            states,
        })
    }
}
