//! Confidence bands of the spectra (Figures 4.8, 4.9, 4.10).

use super::{DISPLACEMENT, FigureSource, STRENGTH};
use uplift::result::MeasureBands;
use uplift::text::risk_in_words;
use uplift_motion::IntensityMeasure;
use uplift_plot::{Axis, Band, Figure, Panel, Series, Tone};

impl FigureSource {
    /// The bands of `measure`.
    pub(super) fn bands_of(&self, measure: IntensityMeasure) -> Option<&MeasureBands> {
        self.bands.as_ref()?.of(measure)
    }

    /// Band and median of one site, probability and size, by position.
    pub(super) fn band(
        &self,
        bands: &MeasureBands,
        at: [usize; 3],
        name: impl Into<String>,
        tone: Tone,
    ) -> (Band, Series) {
        let [lower, median, upper] = bands.limits_m.each_ref().map(|limits| limits.block(at));
        let limits = lower.iter().zip(upper);
        let points = self.stored.strengths.iter().zip(limits).map(|(&eta, (&low, &high))| (eta, low, high)).collect();
        (Band { name: String::new(), points, tone }, self.over_strengths(name, median, tone))
    }
}

pub(super) fn bands(source: &FigureSource) -> Vec<Figure> {
    let Some(stored) = &source.bands else { return Vec::new() };
    let poe = source.rarest();
    let [lower, upper] = stored.level_names();
    let figure = |bands: &MeasureBands| {
        let panel = |site: usize| {
            let title = source.stored.sites[site].clone();
            let mut panel = Panel::lines(title, Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), Vec::new());
            for (size, &records) in stored.sizes.iter().enumerate() {
                let name = format!("{records} records");
                let (band, median) = source.band(bands, [site, poe, size], name, Tone::Distinct(size));
                panel.bands.push(band);
                panel.series.push(median);
            }
            panel
        };
        let caption = format!(
            "Median (lines) and {lower} to {upper} interval (areas) of the spectra of {} over resampled \
             records, for each size of the sample (Fig. 4.8).",
            risk_in_words(source.stored.poes[poe], source.stored.years)
        );
        source.figure(
            format!("bands-{}", bands.measure.key()),
            format!("How sure the spectra are, by {}", bands.measure.label()),
            caption,
            source.sites().map(panel).collect(),
        )
    };
    stored.measures.iter().map(figure).collect()
}

/// Bands of the largest sample by all measures, for one probability.
fn together(source: &FigureSource, poe: usize, y: &Axis, up_to: Option<f64>) -> Option<Vec<Panel>> {
    let stored = source.bands.as_ref().filter(|bands| !bands.measures.is_empty())?;
    let size = stored.largest();
    let panel = |site: usize| {
        let mut panel = Panel::lines(source.stored.sites[site].clone(), Axis::linear(STRENGTH), y.clone(), Vec::new());
        for (index, measure) in source.stored.measures.iter().enumerate() {
            let Some(bands) = stored.of(measure.measure) else { continue };
            let name = measure.measure.label();
            let (mut band, mut line) = source.band(bands, [site, poe, size], name, Tone::Distinct(index));
            if let Some(up_to) = up_to {
                // where the median comes down to that displacement, and on
                let from = line.points.iter().position(|point| point.1 < up_to).unwrap_or(line.points.len());
                line.points.drain(..from);
                band.points.drain(..from);
            }
            panel.bands.push(band);
            panel.series.push(line);
        }
        panel
    };
    Some(source.sites().map(panel).collect())
}

pub(super) fn measures_together(source: &FigureSource) -> Option<Figure> {
    let poe = source.rarest();
    let panels = together(source, poe, &Axis::log(DISPLACEMENT), None)?;
    let caption = format!(
        "Median and interval of the spectra of {} for the largest sample, by each intensity measure \
         (Fig. 4.9): where the areas part, the measures contradict each other.",
        risk_in_words(source.stored.poes[poe], source.stored.years)
    );
    Some(source.figure("bands-together", "The measures side by side", caption, panels))
}

pub(super) fn initiation(source: &FigureSource) -> Option<Figure> {
    let stored = &source.stored;
    let poe = (0..stored.poes.len()).max_by(|&a, &b| stored.poes[a].total_cmp(&stored.poes[b]))?;
    let top = 4.0 * stored.uplift_displacement_m;
    let panels = together(source, poe, &Axis::linear(DISPLACEMENT).between(0.0, top), Some(top))?;
    let caption = format!(
        "Spectra of {} near the uplift displacement of {} m, for the largest sample (Fig. 4.10).",
        risk_in_words(stored.poes[poe], stored.years),
        stored.uplift_displacement_m
    );
    Some(source.figure("initiation", "Where rocking begins", caption, panels))
}
