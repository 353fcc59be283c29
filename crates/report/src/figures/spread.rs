//! Spectra over what is not known: weighted hazard curves, possible structures.

use super::{DISPLACEMENT, FigureSource, STRENGTH};
use uplift::result::{SpreadOver, StoredSpread};
use uplift::text::risk_in_words;
use uplift_motion::IntensityMeasure;
use uplift_plot::{Axis, Figure, Panel, Tone};

/// A figure for each measure and each of what is not known.
pub(super) fn spreads(source: &FigureSource) -> Vec<Figure> {
    let (spectra, sites) = (&source.spectra, source.sites());
    let panel = |spread: &StoredSpread| {
        let title = spectra.sites[spread.site].clone();
        let mut panel = Panel::lines(title, Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), Vec::new());
        for (poe, &probability) in spectra.poes.iter().enumerate() {
            let tone = Tone::Distinct(poe);
            let [mean, lower, .., upper] = spread.limits_m(poe);
            panel.bands.push(source.between(lower, upper, tone));
            panel.series.push(source.over_strengths(risk_in_words(probability, spectra.years), mean, tone));
        }
        panel
    };
    let figure = |measure: IntensityMeasure, over: SpreadOver| {
        let is_of = |of: &&StoredSpread| of.measure == measure && of.over == over && sites.contains(&of.site);
        let panels: Vec<Panel> = source.spreads.iter().filter(is_of).map(panel).collect();
        let caption = format!(
            "Mean (lines) and 5 to 95 % fractiles (areas) of the spectra over the {}. The uncertainty of the records \
             is not included.",
            over.words()
        );
        let title = format!("Spectra over the {}, by {}", over.words(), measure.label());
        (!panels.is_empty())
            .then(|| source.figure(format!("spread-{}-{}", over.key(), measure.key()), title, caption, panels))
    };
    let measures = spectra.measures.iter().map(|of| of.measure);
    measures.flat_map(|measure| SpreadOver::ALL.map(|over| figure(measure, over))).flatten().collect()
}
