//! The motion of a frame: path of its deck in plan, drift, base shear over drift, tendons (Figures 6.14 to 6.16).

use uplift::response::{FrameHistoryRow, FrameResponseReport, FrameRun};
use uplift_frame::Model;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

/// Points over time or along a path.
type Points = Vec<(f64, f64)>;

/// What a line shows of a run: x and y of a row, given the mass of the deck (kg) and the height of the columns (m).
type Of = fn(&FrameHistoryRow, f64, f64) -> (f64, f64);

const DRIFT_X: Of = |row, _, height_m| (row.state.time_s, 100.0 * row.state.displacement_x_m / height_m);
const DRIFT_Y: Of = |row, _, height_m| (row.state.time_s, 100.0 * row.state.displacement_y_m / height_m);
/// The deck pushes against its acceleration.
const LOOP_X: Of = |row, deck_kg, height_m| {
    (100.0 * row.state.displacement_x_m / height_m, -1e-3 * deck_kg * row.state.deck_acceleration_x_m_s2)
};
const LOOP_Y: Of = |row, deck_kg, height_m| {
    (100.0 * row.state.displacement_y_m / height_m, -1e-3 * deck_kg * row.state.deck_acceleration_y_m_s2)
};
const TENDON: Of = |row, _, _| (row.state.time_s, 1e-3 * row.state.tendon_n);

/// The response of a frame; without histories its panels are empty.
pub fn frame_figure(report: &FrameResponseReport) -> Figure {
    let records: Vec<String> = (report.components.iter())
        .map(|of| of.shaken_by.record.file_name().unwrap_or_default().to_string_lossy().into_owned())
        .collect();
    let scale = report.components.first().map_or(1.0, |of| of.shaken_by.scale);
    let wobbles = report.model == Model::Wobbling;
    let mut panels: Vec<Panel> = report.runs.iter().filter(|_| wobbles).map(plan).collect();
    let time = || Axis::linear("time, s");
    panels.push(Panel::lines("", time(), Axis::linear("drift, %"), lines(report, [DRIFT_X, DRIFT_Y], Tone::Distinct)));
    panels.push(Panel::lines(
        "",
        Axis::linear("drift, %"),
        Axis::linear("base shear, kN"),
        lines(report, [LOOP_X, LOOP_Y], Tone::Thin),
    ));
    if report.runs.iter().any(|run| run.peak_tendon_n.is_some()) {
        let of_run = |(index, run): (usize, &FrameRun)| {
            let name = if wobbles { "tendon".to_owned() } else { format!("tendon, under {}", run.under) };
            Series::line(name, points(report, run, TENDON), Tone::Thin(if wobbles { 2 } else { index }))
        };
        let tendons = report.runs.iter().enumerate().map(of_run).collect();
        panels.push(Panel::lines("", time(), Axis::linear("force of a tendon, kN"), tendons));
    }
    let (path, torsion) = if wobbles {
        ("The path of the deck in plan, ", " Torsion is outside the model.")
    } else {
        ("In the plane of each component, ", "")
    };
    let caption = format!(
        "{path}drift of the columns over time, base shear of the deck over drift, and the force of a tendon (Fig. 6.14 \
         to 6.16).{torsion}"
    );
    Figure::new("frame", format!("{} under {} times {scale}", report.name, records.join(" and ")), caption, panels)
}

fn points(report: &FrameResponseReport, run: &FrameRun, of: Of) -> Points {
    let rows = run.history.iter().flat_map(|history| &history.rows);
    rows.map(|row| of(row, report.deck_mass_kg, report.height_m)).collect()
}

/// Along h1 and along h2: of one run where it wobbles, of two runs in the plane of each.
fn lines(report: &FrameResponseReport, [x, y]: [Of; 2], tone: fn(usize) -> Tone) -> Vec<Series> {
    let line =
        |name: String, run: &FrameRun, of: Of, index: usize| Series::line(name, points(report, run, of), tone(index));
    match (report.model, report.runs.as_slice()) {
        (Model::Wobbling, [run, ..]) => {
            vec![line("along h1".to_owned(), run, x, 0), line("along h2".to_owned(), run, y, 1)]
        }
        (_, runs) => {
            let numbered = runs.iter().enumerate();
            numbered.map(|(index, run)| line(format!("under {}", run.under), run, x, index)).collect()
        }
    }
}

/// The path of the deck in plan, on equal axes, with its farthest point.
fn plan(run: &FrameRun) -> Panel {
    let rows = run.history.iter().flat_map(|history| &history.rows);
    let path: Points = rows.map(|row| (row.state.displacement_x_m, row.state.displacement_y_m)).collect();
    let largest_m = path.iter().map(|(x, y)| x.abs().max(y.abs())).fold(0.0, f64::max);
    let reach_m = if largest_m > 0.0 { 1.1 * largest_m } else { 1.0 };
    let farthest = path.iter().max_by(|one, other| one.0.hypot(one.1).total_cmp(&other.0.hypot(other.1)));
    let series = vec![
        Series::dots("farthest", farthest.copied().into_iter().collect(), Tone::Distinct(3)),
        Series::line("path of the deck", path, Tone::Thin(2)),
    ];
    let axis = |label: &str| Axis::linear(label).between(-reach_m, reach_m);
    Panel::lines("", axis("displacement along h1, m"), axis("displacement along h2, m"), series)
}
