//! The time history of one run, its impacts marked.

use uplift::response::{BlockHistory, HistoryRow, ResponseHistory};
use uplift_block::Moment;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

/// Points over time, s.
type Points = Vec<(f64, f64)>;

/// Ground acceleration above, displacement with the impacts and the uplift displacement below.
///
/// * `title` — of the figure
/// * `uplift_displacement_m` — displacement at uplift, m
pub fn history_figure(title: &str, history: &ResponseHistory, uplift_displacement_m: f64) -> Figure {
    let of = |event: Option<&str>| -> Points {
        let rows = history.rows.iter().filter(|row| row.event == event);
        rows.map(|row| (row.time_s, row.displacement_m)).collect()
    };
    figure(
        title,
        "Ground acceleration and displacement. Dots: impacts; dashed: displacement at uplift.",
        ground(&history.ground_acceleration_m_s2, history.dt_s),
        ("displacement", "displacement, m", of(None)),
        of(Some(HistoryRow::AFTER_IMPACT)),
        ("uplift displacement", uplift_displacement_m),
    )
}

/// The same of a block: its rotation, with the slenderness, rad.
pub fn block_history_figure(title: &str, history: &BlockHistory, slenderness_rad: f64) -> Figure {
    let of = |is_wanted: fn(Moment) -> bool| -> Points {
        let rows = history.rows.iter().filter(|row| is_wanted(row.moment));
        rows.map(|row| (row.time_s, row.rotation_rad)).collect()
    };
    figure(
        title,
        "Ground acceleration and rotation. Dots: impacts; dashed: slenderness, above which a block overturns without \
         ground motion.",
        ground(&history.ground_acceleration_m_s2, history.dt_s),
        ("rotation", "rotation, rad", of(|moment| !matches!(moment, Moment::BeforeImpact | Moment::AfterImpact))),
        of(|moment| moment == Moment::AfterImpact),
        ("slenderness", slenderness_rad),
    )
}

fn ground(acceleration_m_s2: &[f64], dt_s: f64) -> Points {
    acceleration_m_s2.iter().enumerate().map(|(index, &a)| (index as f64 * dt_s, a)).collect()
}

/// * `moved` — name, axis and points of what moves
/// * `limit` — name and value of the dashed lines
fn figure(
    title: &str,
    caption: &str,
    ground: Points,
    moved: (&str, &str, Points),
    impacts: Points,
    limit: (&str, f64),
) -> Figure {
    let (name, axis, points) = moved;
    let end_s = points.last().map_or(1.0, |&(time_s, _)| time_s);
    let time = || Axis::linear("time, s").between(0.0, end_s);
    let boundary = |sign: f64, name: &str| {
        let at = sign * limit.1;
        Series::line(name, vec![(0.0, at), (end_s, at)], Tone::Distinct(2))
    };
    let panel = |y: &str, series: Vec<Series>| Panel::lines("", time(), Axis::linear(y), series);
    let moved = vec![
        Series::line(name, points, Tone::Distinct(0)),
        boundary(1.0, limit.0),
        boundary(-1.0, ""),
        Series::dots("impacts", impacts, Tone::Distinct(1)),
    ];
    let ground = vec![Series::line("ground acceleration", ground, Tone::Faint)];
    let panels = vec![panel("ground acceleration, m/s²", ground), panel(axis, moved)];
    Figure { columns: 1, ..Figure::new("history", title, caption, panels) }
}
