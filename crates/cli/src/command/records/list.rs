//! `uplift records list`: the records of a manifest.

use std::io::Write;

use clap::Args;
use uplift_motion::{IntensityMeasure, RecordPair, STANDARD_GRAVITY_M_S2, geometric_mean};

use super::{CommandError, SetArguments, Terminal};
use uplift::text::table;

#[derive(Debug, Args)]
pub(super) struct ListArguments {
    #[command(flatten)]
    set: SetArguments,
}

pub(super) fn list(arguments: &ListArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let (pairs, count) = arguments.set.read(terminal)?;
    let mut rows = Vec::new();
    for (pair, _) in &pairs {
        let peaks = arguments.set.intensity.peaks_of(pair).map_err(|error| CommandError::input(error.to_string()))?;
        let [pga_g, pgv_cm_s] = [IntensityMeasure::Pga, IntensityMeasure::Pgv]
            .map(|measure| measure.of_peaks(peaks, STANDARD_GRAVITY_M_S2));
        let duration_s = geometric_mean(pair.h1.d5_75_s(), pair.h2.d5_75_s());
        rows.push(vec![
            pair.id.clone(),
            said(pair, "event"),
            said(pair, "magnitude"),
            if pair.metadata.contains_key("rrup_km") { said(pair, "rrup_km") } else { said(pair, "repi_km") },
            said(pair, "vs30"),
            format!("{pga_g:.3}"),
            format!("{pgv_cm_s:.2}"),
            format!("{duration_s:.1}"),
            said(pair, "pulse_like"),
        ]);
    }
    let header = ["record", "event", "M", "R [km]", "Vs30 [m/s]", "PGA [g]", "PGV [cm/s]", "D5-75 [s]", "pulse"];
    let mut out = std::io::stdout().lock();
    writeln!(out, "{}", table(&header, &rows))?;
    writeln!(out, "\n{} of {count} records; PGA and PGV: {}", rows.len(), arguments.set.intensity.long_name())?;
    Ok(())
}

fn said(pair: &RecordPair, key: &str) -> String {
    pair.metadata.get(key).cloned().unwrap_or_else(|| "-".to_owned())
}
