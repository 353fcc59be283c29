//! The time history of one run, its impacts marked.

use uplift::response::{HistoryRow, ResponseHistory};
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};

/// Ground acceleration above, displacement with the impacts and the uplift displacement below.
///
/// * `title` — of the figure
/// * `uplift_displacement_m` — displacement at uplift, m
pub fn history_figure(title: &str, history: &ResponseHistory, uplift_displacement_m: f64) -> Figure {
    let samples = || history.rows.iter().filter(|row| row.event.is_none());
    let end_s = samples().next_back().map_or(1.0, |sample| sample.time_s);
    let time = || Axis::linear("time, s").between(0.0, end_s);
    let ground = history
        .ground_acceleration_m_s2
        .iter()
        .enumerate()
        .map(|(index, &a)| (index as f64 * history.dt_s, a))
        .collect();
    let displacement = samples().map(|sample| (sample.time_s, sample.displacement_m)).collect();
    let impacts = history
        .rows
        .iter()
        .filter(|row| row.event == Some(HistoryRow::AFTER_IMPACT))
        .map(|row| (row.time_s, row.displacement_m))
        .collect();
    let boundary = |sign: f64, name: &str| {
        Series::line(
            name,
            vec![(0.0, sign * uplift_displacement_m), (end_s, sign * uplift_displacement_m)],
            Tone::Distinct(2),
        )
    };
    let panel = |y: &str, series: Vec<Series>| Panel::lines("", time(), Axis::linear(y), series);
    Figure {
        id: "history".to_owned(),
        title: title.to_owned(),
        caption: "Ground acceleration and the displacement it causes; dots are impacts, dashed lines the displacement \
                  at uplift."
            .to_owned(),
        remark: String::new(),
        panels: vec![
            panel("ground acceleration, m/s²", vec![Series::line("ground acceleration", ground, Tone::Faint)]),
            panel(
                "displacement, m",
                vec![
                    Series::line("displacement", displacement, Tone::Distinct(0)),
                    boundary(1.0, "uplift displacement"),
                    boundary(-1.0, ""),
                    Series { name: "impacts".to_owned(), points: impacts, tone: Tone::Distinct(1), marks: Marks::Only },
                ],
            ),
        ],
        columns: 1,
    }
}
