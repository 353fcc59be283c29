//! Confidence bands of the spectra (Figures 4.8, 4.9, 4.10).

use super::{DISPLACEMENT, FigureSource, STRENGTH};
use uplift::Array;
use uplift::result::MeasureBands;
use uplift::text::risk_in_words;
use uplift_motion::IntensityMeasure;
use uplift_plot::{Axis, Band, Figure, Panel, Series, Tone};

/// Limits and medians of bands, each `[site, poe, size, strength]`, m.
type Limits = [Array<4>; 3];

impl FigureSource {
    /// The band of the plain spectrum by `measure` at a site and probability, by position: of the truth, and in results
    /// of before between percentiles.
    pub(super) fn band_of_set(&self, measure: IntensityMeasure, [site, poe]: [usize; 2], tone: Tone) -> Option<Band> {
        let stored = self.bands.as_ref()?;
        let own = stored.by_measure(measure)?;
        let [lower_m, upper_m] = match (&own.inferred, &own.plain.limits_m) {
            (Some(inferred), _) => inferred.truth_m.each_ref(),
            (None, [lower_m, _, upper_m]) => [lower_m, upper_m],
        }
        .map(|limit_m| limit_m.block([site, poe, stored.place_of_set(self.stored.records.len())]));
        Some(self.between(lower_m, upper_m, tone))
    }

    /// Band and median of one site, probability and size, by position.
    pub(super) fn band(
        &self,
        limits_m: &Limits,
        at: [usize; 3],
        name: impl Into<String>,
        tone: Tone,
    ) -> (Band, Series) {
        let [lower, median, upper] = limits_m.each_ref().map(|limits| limits.block(at));
        (self.between(lower, upper, tone), self.over_strengths(name, median, tone))
    }
}

/// Which spectra bands are of.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Of {
    /// Those of records that count alike.
    Plain,
    /// Those of weighted records.
    Repaired,
}

impl Of {
    fn limits(self, bands: &MeasureBands) -> Option<&Limits> {
        match self {
            Self::Plain => Some(&bands.plain.limits_m),
            Self::Repaired => Some(&bands.repaired.as_ref()?.bands.limits_m),
        }
    }

    /// What the names of its figures end with.
    fn ending(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Repaired => "-repaired",
        }
    }

    fn spectra(self) -> &'static str {
        match self {
            Self::Plain => "spectra",
            Self::Repaired => "repaired spectra",
        }
    }
}

pub(super) fn bands(source: &FigureSource) -> Vec<Figure> {
    let Some(stored) = &source.bands else { return Vec::new() };
    let poe = source.rarest();
    let [lower, upper] = stored.level_names();
    let figure = |bands: &MeasureBands, of: Of| {
        let limits_m = of.limits(bands)?;
        let panel = |site: usize| {
            let title = source.stored.sites[site].clone();
            let mut panel = Panel::lines(title, Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), Vec::new());
            for (size, &records) in stored.sizes.iter().enumerate() {
                let name = format!("{records} records");
                let (band, median) = source.band(limits_m, [site, poe, size], name, Tone::Distinct(size));
                panel.bands.push(band);
                panel.series.push(median);
            }
            panel
        };
        let anew = if of == Of::Repaired { " Every resample has its own weights." } else { "" };
        let caption = format!(
            "Median (lines) and {lower} to {upper} interval (areas) of the {} of {} over {}, by the size of the \
             resample (Fig. 4.8).{anew}",
            of.spectra(),
            risk_in_words(source.stored.poes[poe], source.stored.years),
            stored.drawn_words()
        );
        Some(source.figure(
            format!("bands-{}{}", bands.measure.key(), of.ending()),
            format!("Confidence bands of the {} by {}, by number of records", of.spectra(), bands.measure.label()),
            caption,
            source.sites().map(panel).collect(),
        ))
    };
    let of_measure = |bands| [Of::Plain, Of::Repaired].into_iter().filter_map(move |of| figure(bands, of));
    stored.measures.iter().flat_map(of_measure).collect()
}

/// Bands of the largest sample by all measures, for one probability.
///
/// - `up_to`: the largest displacement, m, of an axis in millimetres; none for one in metres.
fn together(source: &FigureSource, of: Of, poe: usize, y: &Axis, up_to: Option<f64>) -> Option<Vec<Panel>> {
    let stored = source.bands.as_ref()?;
    if !stored.measures.iter().any(|bands| of.limits(bands).is_some()) {
        return None;
    }
    let size = stored.largest();
    let panel = |site: usize| {
        let mut panel = Panel::lines(source.stored.sites[site].clone(), Axis::linear(STRENGTH), y.clone(), Vec::new());
        for (index, measure) in source.stored.measures.iter().enumerate() {
            let Some(limits_m) = stored.by_measure(measure.measure).and_then(|bands| of.limits(bands)) else {
                continue;
            };
            let name = measure.measure.label();
            let (mut band, mut line) = source.band(limits_m, [site, poe, size], name, Tone::Distinct(index));
            if let Some(up_to) = up_to {
                // where the median comes down to that displacement, and on
                let from = line.points.iter().position(|point| point.1 < up_to).unwrap_or(line.points.len());
                line.points.drain(..from);
                band.points.drain(..from);
                line.points.iter_mut().for_each(|point| point.1 *= 1e3);
                band.points.iter_mut().for_each(|point| (point.1, point.2) = (1e3 * point.1, 1e3 * point.2));
            }
            panel.bands.push(band);
            panel.series.push(line);
        }
        panel
    };
    Some(source.sites().map(panel).collect())
}

/// The measures side by side, and so again where repaired spectra have bands.
pub(super) fn measures_together(source: &FigureSource) -> Vec<Figure> {
    let poe = source.rarest();
    let figure = |of: Of| {
        let panels = together(source, of, poe, &Axis::log(DISPLACEMENT), None)?;
        let title = match of {
            Of::Plain => "Spectra by each intensity measure",
            Of::Repaired => "Repaired spectra by each intensity measure",
        };
        let caption = format!(
            "Medians and intervals of the {} of {} over resamples (Fig. 4.9).",
            of.spectra(),
            risk_in_words(source.stored.poes[poe], source.stored.years)
        );
        Some(source.figure(format!("bands-together{}", of.ending()), title, caption, panels))
    };
    [Of::Plain, Of::Repaired].into_iter().filter_map(figure).collect()
}

pub(super) fn initiation(source: &FigureSource) -> Option<Figure> {
    let stored = &source.stored;
    let poe = (0..stored.poes.len()).max_by(|&a, &b| stored.poes[a].total_cmp(&stored.poes[b]))?;
    let top = 4.0 * stored.uplift_displacement_m;
    let y = Axis::linear("displacement u_{max}, mm").between(0.0, 1e3 * top);
    let panels = together(source, Of::Plain, poe, &y, Some(top))?;
    // where the medians stay above, there is nothing to see
    if panels.iter().flat_map(|panel| &panel.series).all(|line| line.points.is_empty()) {
        return None;
    }
    let caption = format!(
        "Spectra of {} near the uplift displacement of {} mm (Fig. 4.10).",
        risk_in_words(stored.poes[poe], stored.years),
        1e3 * stored.uplift_displacement_m
    );
    Some(source.figure("initiation", "Where rocking begins", caption, panels))
}
