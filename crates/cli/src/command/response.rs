//! `uplift response`: one record through one oscillator.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use polars::prelude::Column;
use serde_json::json;
use uplift_motion::{AccelerationUnit, Accelerogram, ReadOptions, STANDARD_GRAVITY_M_S2, read_path};
use uplift_oscillator::{
    EventKind, Excitation, FreeVibration, History, Oscillator, PostUplift, Response, respond, respond_with_history,
};

use super::records::refuse_foreign;
use uplift::UpliftError;
use uplift::result::write_table;
use uplift_plot::Width;
use uplift_report::figures::history_figure;
use uplift_report::write_figure;

#[derive(Debug, Args)]
pub(super) struct ResponseArguments {
    /// Record: PEER AT2, or text with one column (acceleration) or two (time, acceleration)
    record: PathBuf,
    /// Strength: uplift force over weight
    #[arg(long, value_name = "ETA", allow_negative_numbers = true)]
    strength: f64,
    /// Factor on the record
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
    scale: f64,
    /// Displacement at uplift, m
    #[arg(long, default_value_t = 0.0005, value_name = "M", allow_negative_numbers = true)]
    uplift_displacement_m: f64,
    /// Displacement where the restoring force vanishes, m: a negative-stiffness system that can overturn
    #[arg(long, value_name = "M", conflicts_with = "post_uplift_stiffness_per_s2", allow_negative_numbers = true)]
    capacity_m: Option<f64>,
    /// Stiffness after uplift over the mass, 1/s2: a system of positive post-uplift stiffness
    #[arg(long, value_name = "K", allow_negative_numbers = true)]
    post_uplift_stiffness_per_s2: Option<f64>,
    /// Coefficient of restitution at impact
    #[arg(long, default_value_t = 0.95, value_name = "R", allow_negative_numbers = true)]
    restitution: f64,
    /// Acceleration of gravity, m/s2
    #[arg(long, default_value_t = STANDARD_GRAVITY_M_S2, value_name = "G", allow_negative_numbers = true)]
    gravity_m_s2: f64,
    /// Sampling interval of a one-column record, s
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    dt_s: Option<f64>,
    /// Unit of a text record: g, m/s2, cm/s2 or gal
    #[arg(long)]
    unit: Option<AccelerationUnit>,
    /// Which component of a file with several, counted from 1
    #[arg(long, value_name = "N")]
    channel: Option<usize>,
    /// Follow the free vibration after the record for so many seconds
    #[arg(long, default_value_t = 0.0, value_name = "S", allow_negative_numbers = true)]
    free_vibration_s: f64,
    /// Print the response as JSON
    #[arg(long)]
    json: bool,
    /// Write the time history, with uplifts and impacts in their places, to this CSV file
    #[arg(long, value_name = "FILE.csv")]
    history: Option<PathBuf>,
    /// Draw the time history, its impacts marked, as SVG or PNG
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
}

pub(super) fn response(arguments: &ResponseArguments) -> Result<(), UpliftError> {
    let usage = |reason: String| UpliftError::Usage(reason);
    let post_uplift = match (arguments.capacity_m, arguments.post_uplift_stiffness_per_s2) {
        (Some(capacity_m), _) => PostUplift::Negative { capacity_m },
        (None, Some(stiffness_per_s2)) => PostUplift::Positive { stiffness_per_s2 },
        (None, None) => PostUplift::Zero,
    };
    let oscillator = Oscillator::new(
        arguments.strength,
        arguments.gravity_m_s2,
        arguments.uplift_displacement_m,
        arguments.restitution,
        post_uplift,
    )
    .map_err(|error| usage(error.to_string()))?;
    let free_s = arguments.free_vibration_s;
    if !(free_s.is_finite() && free_s >= 0.0) {
        return Err(usage(format!("--free-vibration-s is {free_s}: give seconds, not negative")));
    }
    for (option, path) in [("--history", &arguments.history), ("--plot", &arguments.plot)] {
        if let Some(path) = path
            && let (Ok(target), Ok(record)) = (path.canonicalize(), arguments.record.canonicalize())
            && target == record
        {
            return Err(usage(format!("{option} {} would overwrite the record: give another name", path.display())));
        }
    }
    if let Some(path) = &arguments.history {
        refuse_foreign(path)?;
    }
    if let Some(path) = &arguments.plot
        && !path.extension().is_some_and(|extension| extension == "svg" || extension == "png")
    {
        return Err(usage(format!("--plot {}: give a name that ends in .svg or .png", path.display())));
    }
    let options = ReadOptions {
        dt_s: arguments.dt_s,
        unit: arguments.unit,
        gravity_m_s2: arguments.gravity_m_s2,
        channel: arguments.channel,
        format: None,
    };
    let accelerogram = read_path(&arguments.record, &options).map_err(|error| UpliftError::input(error.to_string()))?;
    let excitation = Excitation::new(accelerogram.dt_s(), accelerogram.acceleration_m_s2())
        .map_err(|error| UpliftError::input(format!("{}: {error}", arguments.record.display())))?
        .scaled(arguments.scale)
        .map_err(|error| usage(error.to_string()))?;
    let after = if free_s > 0.0 { FreeVibration::Seconds(free_s) } else { FreeVibration::None };
    let result = if arguments.history.is_some() || arguments.plot.is_some() {
        let (result, history) = respond_with_history(&oscillator, &excitation, after);
        if let Some(path) = &arguments.history {
            write_history(path, arguments, &history, &excitation)?;
        }
        if let Some(path) = &arguments.plot {
            plot_history(path, arguments, &history, &excitation)?;
        }
        result
    } else {
        respond(&oscillator, &excitation, after)
    };
    print(arguments, &accelerogram, &result)
}

fn print(arguments: &ResponseArguments, accelerogram: &Accelerogram, result: &Response) -> Result<(), UpliftError> {
    let mut out = std::io::stdout().lock();
    let scale = arguments.scale.abs();
    let (pga_g, pgv_cm_s, pgd_m) = (
        scale * accelerogram.pga_m_s2() / arguments.gravity_m_s2,
        scale * accelerogram.pgv_m_s() * 100.0,
        scale * accelerogram.pgd_m(),
    );
    if arguments.json {
        let finite = |value: f64| value.is_finite().then_some(value);
        let json = json!({
            "record": arguments.record,
            "samples": accelerogram.len(),
            "dt_s": accelerogram.dt_s(),
            "scale": arguments.scale,
            "pga_g": pga_g,
            "pgv_cm_s": pgv_cm_s,
            "pgd_m": pgd_m,
            "strength": arguments.strength,
            "uplift_displacement_m": arguments.uplift_displacement_m,
            "capacity_m": arguments.capacity_m,
            "post_uplift_stiffness_per_s2": arguments.post_uplift_stiffness_per_s2,
            "restitution": arguments.restitution,
            "gravity_m_s2": arguments.gravity_m_s2,
            "free_vibration_s": arguments.free_vibration_s,
            "peak_displacement_m": finite(result.peak_displacement_m),
            "time_of_peak_s": if result.overturned { None } else { finite(result.time_of_peak_s) },
            "impacts": result.impacts,
            "uplifts": result.uplifts,
            "overturned": result.overturned,
            "end_displacement_m": finite(result.end_displacement_m),
            "end_velocity_m_s": finite(result.end_velocity_m_s),
        });
        writeln!(out, "{json:#}")?;
        return Ok(());
    }
    writeln!(
        out,
        "record    {}: {} samples every {} s, scaled by {}",
        arguments.record.display(),
        accelerogram.len(),
        accelerogram.dt_s(),
        arguments.scale
    )?;
    writeln!(out, "          PGA {pga_g:.4} g, PGV {pgv_cm_s:.3} cm/s, PGD {pgd_m:.5} m")?;
    writeln!(out, "system    strength {}, uplift at {} m", arguments.strength, arguments.uplift_displacement_m)?;
    if result.overturned {
        writeln!(out, "response  overturned, after {:.3} s and {} impacts", result.time_of_peak_s, result.impacts)?;
    } else {
        writeln!(
            out,
            "response  peak displacement {:.6} m at {:.4} s, {} uplifts, {} impacts",
            result.peak_displacement_m, result.time_of_peak_s, result.uplifts, result.impacts
        )?;
    }
    for (name, path) in [("history", &arguments.history), ("figure", &arguments.plot)] {
        if let Some(path) = path {
            writeln!(out, "{name:<9} {}", path.display())?;
        }
    }
    Ok(())
}

/// The time history as a figure.
fn plot_history(
    path: &Path,
    arguments: &ResponseArguments,
    history: &History,
    excitation: &Excitation<'_>,
) -> Result<(), UpliftError> {
    let record = arguments.record.file_name().unwrap_or_default().to_string_lossy();
    let title = format!("{record} times {}, strength {}", arguments.scale, arguments.strength);
    let figure = history_figure(&title, excitation, history, arguments.uplift_displacement_m);
    write_figure(&figure, Width::Double, path)
}

/// Samples and events in the order of time; an impact has two rows, before and after.
fn write_history(
    path: &Path,
    arguments: &ResponseArguments,
    history: &History,
    excitation: &Excitation<'_>,
) -> Result<(), UpliftError> {
    let (mut time, mut u, mut v, mut ground, mut event) = (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut events = history.events.iter().peekable();
    let last_s = excitation.duration_s();
    let acceleration_at = |time_s: f64| {
        let a = excitation.acceleration_m_s2();
        let position = time_s / excitation.dt_s();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the record")]
        let index = (position.round() as usize).min(a.len() - 1);
        if time_s > last_s * (1.0 + 1e-12) {
            0.0
        } else if (position - index as f64).abs() < 1e-6 {
            excitation.scale() * a[index]
        } else {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the record")]
            let before = (position as usize).min(a.len() - 2);
            let part = position - before as f64;
            excitation.scale() * (a[before] + part * (a[before + 1] - a[before]))
        }
    };
    for sample in &history.samples {
        while let Some(passed) = events.next_if(|passed| passed.time_s <= sample.time_s) {
            let mut row = |velocity: f64, word: &'static str| {
                time.push(passed.time_s);
                u.push(passed.displacement_m);
                v.push(velocity);
                ground.push(acceleration_at(passed.time_s));
                event.push(Some(word));
            };
            match passed.kind {
                EventKind::Uplift => row(passed.velocity_after_m_s, "uplift"),
                EventKind::Impact => {
                    row(passed.velocity_before_m_s, "before impact");
                    row(passed.velocity_after_m_s, "after impact");
                }
            }
        }
        time.push(sample.time_s);
        u.push(sample.displacement_m);
        v.push(sample.velocity_m_s);
        ground.push(acceleration_at(sample.time_s));
        event.push(None);
    }
    let line = format!(
        "uplift {} ({}); record {}, scale {}, strength {}, uplift displacement {} m",
        uplift::VERSION,
        uplift::COMMIT,
        arguments.record.display(),
        arguments.scale,
        arguments.strength,
        arguments.uplift_displacement_m
    );
    let columns = vec![
        Column::new("time_s".into(), time),
        Column::new("displacement_m".into(), u),
        Column::new("velocity_m_s".into(), v),
        Column::new("ground_acceleration_m_s2".into(), ground),
        Column::new("event".into(), event),
    ];
    write_table(path, &line, columns)
}
