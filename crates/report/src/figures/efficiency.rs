//! Which intensity measure to trust: dispersion and trends.

use super::{FigureSource, STRENGTH};
use uplift::UpliftError;
use uplift::efficiency::{covariates, efficiency_by};
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

pub(super) fn efficiency(source: &FigureSource) -> Result<Figure, UpliftError> {
    let stored = &source.stored;
    let covariates = covariates(&source.records);
    let panel = |title: &str, y: Axis| Panel::lines(title, Axis::linear(STRENGTH), y, Vec::new());
    let mut panels = vec![
        panel("rocking structures", Axis::linear("dispersion of ln u")),
        panel("onset of rocking", Axis::linear("dispersion of ln level")),
    ];
    for covariate in &covariates {
        let name = match covariate.key {
            "ln_rrup" => "distance",
            "ln_duration" => "duration",
            key => key,
        };
        panels.push(panel(&format!("trend with {name}"), Axis::log("p-value")));
    }
    for (index, measure) in stored.measures.iter().enumerate() {
        let found = efficiency_by(stored, measure, &covariates)?;
        let label = measure.measure.label();
        let tone = Tone::Distinct(index);
        panels[0].series.push(source.over_strengths(label, &found.own.rocking, tone));
        panels[1].series.push(source.over_strengths(label, &found.own.initiation, tone));
        for (panel, trend) in panels[2..].iter_mut().zip(&found.own.trends) {
            // NaN where there is no line
            let values: Vec<f64> = trend.p_value.iter().map(|p_value| p_value.clamp(1e-6, 1.0)).collect();
            panel.series.push(source.over_strengths(label, &values, tone));
        }
    }
    let ends = [stored.strengths.first(), stored.strengths.last()].into_iter().flatten();
    let limit: Vec<(f64, f64)> = ends.map(|&strength| (strength, 0.05)).collect();
    for panel in &mut panels[2..] {
        panel.series.push(Series::line("p = 0.05", limit.clone(), Tone::Distinct(2)));
    }
    let caption = "Efficiency: dispersion of the displacement of rocking structures at an intensity level, and of the \
                   level at which rocking begins; less is better. Sufficiency: p-values of the trend of the residuals \
                   with magnitude, distance and duration; below 0.05 the intensity measure is not sufficient.";
    Ok(source.figure("measures", "Efficiency and sufficiency of the intensity measures", caption, panels))
}
