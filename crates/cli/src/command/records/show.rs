//! `uplift records show`: one record, or what a file holds.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use uplift_motion::{Accelerogram, Combination, Orientation, ReadOptions, RecordPair, Recording, read_record_file};

use super::{CommandError, FileArguments};
use uplift::import::{PairMeasures, warnings_of_pair};
use uplift::inputs::manifest;
use uplift::inputs::pairs::read_component;

#[derive(Debug, Args)]
pub(super) struct ShowArguments {
    /// Manifest of a record set, or a record file
    #[arg(value_name = "SET|FILE")]
    input: PathBuf,
    /// Name of a record of the manifest
    record: Option<String>,
    #[command(flatten)]
    files: FileArguments,
}

pub(super) fn show(arguments: &ShowArguments) -> Result<(), CommandError> {
    let fail = |error: uplift_motion::MotionError| CommandError::input(error.to_string());
    let FileArguments { format, unit, dt_s, gravity_m_s2 } = arguments.files;
    let mut out = std::io::stdout().lock();
    let Some(id) = &arguments.record else {
        if arguments.input.extension().is_some_and(|extension| extension == "csv")
            && manifest::read(&arguments.input, None).is_ok()
        {
            return Err(CommandError::Usage(format!(
                "{} is a manifest: name one of its records too; uplift records list shows them",
                arguments.input.display()
            )));
        }
        let options = ReadOptions { format, channel: None, dt_s, unit, gravity_m_s2 };
        let file = read_record_file(&arguments.input, &options).map_err(fail)?;
        writeln!(out, "{}: {} format, {} component(s)", arguments.input.display(), file.format, file.recordings.len())?;
        for (index, recording) in file.recordings.iter().enumerate() {
            writeln!(out, "\ncomponent {}", index + 1)?;
            show_component(&mut out, recording, gravity_m_s2)?;
        }
        return Ok(());
    };
    let rows = manifest::read(&arguments.input, None).map_err(uplift::UpliftError::Inputs)?;
    let Some(row) = rows.into_iter().find(|row| row.id == *id) else {
        return Err(CommandError::input(format!(
            "{} has no record {id:?}; uplift records list shows its records",
            arguments.input.display()
        )));
    };
    let component = |file: &manifest::ComponentFile| -> Result<Recording, CommandError> {
        let (format, channel) = (row.format, file.channel);
        let options = ReadOptions { format, channel, dt_s: row.dt_s, unit: row.unit, gravity_m_s2 };
        read_component(file, &options)
            .map(|(recording, _)| recording)
            .map_err(|reason| CommandError::input(format!("record {id}: {reason}")))
    };
    let [one, other] = [component(&row.components[0])?, component(&row.components[1])?];
    writeln!(out, "record {id}")?;
    for (key, value) in &row.metadata {
        writeln!(out, "  {key:<24}{value}")?;
    }
    for (name, recording, file) in [("h1", &one, &row.components[0]), ("h2", &other, &row.components[1])] {
        writeln!(out, "\n{name}: {}", file.path.display())?;
        show_component(&mut out, recording, gravity_m_s2)?;
    }
    let pair = RecordPair {
        id: id.clone(),
        h1: one.accelerogram,
        h2: other.accelerogram,
        metadata: std::collections::BTreeMap::new(),
    };
    let measures = PairMeasures::of(&pair, gravity_m_s2, true);
    writeln!(out, "\nboth")?;
    for (combination, peaks) in Combination::ALL.iter().zip(&measures.peaks) {
        if let Some([pga_g, pgv_cm_s]) = peaks {
            writeln!(out, "  {:<24}PGA {pga_g:.4} g, PGV {pgv_cm_s:.3} cm/s", combination.key())?;
        }
    }
    if let Some(pulse) = &measures.pulse {
        let word = if pulse.is_pulse_like { format!("yes, {:.2} s", pulse.period_s) } else { "no".to_owned() };
        writeln!(out, "  {:<24}{word} (indicator {:.2})", "velocity pulse", pulse.indicator)?;
    } else if measures.pulse_like == Some(false) {
        writeln!(out, "  {:<24}no (too weak for one)", "velocity pulse")?;
    }
    for warning in warnings_of_pair(&pair, [&one.description, &other.description], &measures, gravity_m_s2) {
        writeln!(out, "warning: {}", warning.text)?;
    }
    Ok(())
}

fn show_component(out: &mut impl Write, recording: &Recording, gravity_m_s2: f64) -> std::io::Result<()> {
    let Recording { accelerogram: motion, description } = recording;
    let number = |value: Option<f64>, unit: &str| value.map(|value| format!("{value} {unit}").trim().to_owned());
    let direction = description.orientation.map(|orientation| match orientation {
        Orientation::Azimuth(degrees) => format!("{degrees}° from north"),
        Orientation::Horizontal(number) => format!("horizontal {number}"),
        Orientation::Vertical => "vertical".to_owned(),
    });
    for (key, value) in [
        ("event", description.event.clone()),
        ("event time", description.event_time.clone()),
        ("magnitude", number(description.magnitude, "")),
        ("epicentral distance", number(description.epicentral_distance_km, "km")),
        ("rupture distance", number(description.rupture_distance_km, "km")),
        ("station", description.station.clone()),
        ("place", description.station_name.clone()),
        ("Vs30", number(description.vs30_m_s, "m/s")),
        ("sensor", description.sensor.clone()),
        ("channel", description.channel.clone()),
        ("direction", direction),
        ("high-pass corner", number(description.low_cut_hz, "Hz")),
        ("processing", description.unprocessed.then(|| "none: raw data".to_owned())),
    ] {
        if let Some(value) = value {
            writeln!(out, "  {key:<24}{value}")?;
        }
    }
    let lines = [
        ("samples", format!("{} at {} s, {:.3} s", motion.len(), motion.dt_s(), motion.duration_s())),
        ("PGA", format!("{:.5} g", motion.pga_m_s2() / gravity_m_s2)),
        ("PGV", format!("{:.4} cm/s", 100.0 * motion.pgv_m_s())),
        ("PGD", format!("{:.4} cm", 100.0 * motion.pgd_m())),
        ("Arias intensity", format!("{:.4} m/s", motion.arias_intensity_m_s(gravity_m_s2))),
        ("CAV", format!("{:.4} m/s", Accelerogram::cumulative_absolute_velocity_m_s(motion))),
        ("D5-75, D5-95", format!("{:.2} s, {:.2} s", motion.d5_75_s(), motion.d5_95_s())),
        ("velocity at the end", format!("{:.4} cm/s", 100.0 * motion.residual_velocity_m_s())),
    ];
    for (key, value) in lines {
        writeln!(out, "  {key:<24}{value}")?;
    }
    Ok(())
}
