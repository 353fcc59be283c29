//! Confidence bands of the spectra (Figures 4.8, 4.9, 4.10).

use super::{FigureSource, STRENGTH};
use uplift::UpliftError;
use uplift::text::per_cent;
use uplift_plot::{Axis, Band, Figure, Panel, Tone};

/// The bands of one measure over `[site, poe, size, strength]`, m.
struct StoredBands {
    sizes: Vec<u32>,
    limits_m: [Vec<f64>; 3],
    names: [String; 2],
}

impl FigureSource {
    fn bands(&self, key: &str) -> Result<Option<StoredBands>, UpliftError> {
        let group = format!("/bootstrap/{key}");
        if !self.reader.exists(&group) {
            return Ok(None);
        }
        // the limits are named after their levels, and sort by them
        let names: Vec<String> = self
            .reader
            .children(&group)?
            .into_iter()
            .filter(|name| name.starts_with('u') && name.ends_with("_m") && name.as_str() != "u50_m")
            .collect();
        let [lower, upper] = &names[..] else { return Ok(None) };
        let read = |name: &str| self.reader.array_f64(&format!("{group}/{name}")).map(|array| array.values);
        let limits_m = [read(lower)?, read("u50_m")?, read(upper)?];
        let level = |name: &str| {
            let digits = name.trim_start_matches('u').trim_end_matches("_m").replace('_', ".");
            format!("{} %", digits.trim_start_matches('0'))
        };
        let names = [level(lower), level(upper)];
        let sizes = self.reader.axis_u32("sample_size")?;
        let stored = &self.stored;
        let expected = stored.sites.len() * stored.poes.len() * sizes.len() * stored.strengths.len();
        if limits_m.iter().any(|limits| limits.len() != expected) {
            return Err(UpliftError::input(format!(
                "{}: {group} is damaged: run the bootstrap again",
                stored.path.display()
            )));
        }
        Ok(Some(StoredBands { sizes, limits_m, names }))
    }

    /// Band and median of one site, probability and size.
    fn band(
        &self,
        bands: &StoredBands,
        (site, poe, size): (usize, usize, usize),
        name: &str,
        tone: Tone,
    ) -> (Band, Vec<f64>) {
        let strengths = self.stored.strengths.len();
        let start = ((site * self.stored.poes.len() + poe) * bands.sizes.len() + size) * strengths;
        let [lower, median, upper] = bands.limits_m.each_ref().map(|limits| &limits[start..start + strengths]);
        let points = self
            .stored
            .strengths
            .iter()
            .zip(lower.iter().zip(upper))
            .map(|(&eta, (&low, &high))| (eta, low, high))
            .collect();
        (Band { name: name.to_owned(), points, tone }, median.to_vec())
    }
}

pub(super) fn bands(source: &FigureSource) -> Result<Vec<Figure>, UpliftError> {
    let stored = &source.stored;
    let poe = source.rarest();
    let mut figures = Vec::new();
    for measure in &stored.measures {
        let Some(bands) = source.bands(measure.measure.key())? else { continue };
        let panels = source
            .sites()
            .map(|site| {
                let mut panel = Panel::lines(
                    stored.sites[site].clone(),
                    Axis::linear(STRENGTH),
                    Axis::log("displacement, m"),
                    Vec::new(),
                );
                for (size, &records) in bands.sizes.iter().enumerate() {
                    let name = format!("{records} records");
                    let (band, median) = source.band(&bands, (site, poe, size), "", Tone::Distinct(size));
                    panel.bands.push(band);
                    panel.series.push(source.over_strengths(name, &median, Tone::Distinct(size)));
                }
                panel
            })
            .collect();
        let label = measure.measure.label();
        let caption = format!(
            "Median (lines) and {} to {} interval (areas) of the spectra of {} in {} years over resampled records, for each size of the sample (Fig. 4.8).",
            bands.names[0],
            bands.names[1],
            per_cent(stored.poes[poe]),
            stored.years
        );
        figures.push(source.figure(
            format!("bands-{}", measure.measure.key()),
            format!("How sure the spectra are, by {label}"),
            caption,
            panels,
        ));
    }
    Ok(figures)
}

/// Bands of the largest sample by all measures, for one probability.
fn together(
    source: &FigureSource,
    poe: usize,
    y: &Axis,
    up_to: Option<f64>,
) -> Result<Option<Vec<Panel>>, UpliftError> {
    let stored = &source.stored;
    let mut panels: Vec<Panel> = source
        .sites()
        .map(|site| Panel::lines(stored.sites[site].clone(), Axis::linear(STRENGTH), y.clone(), Vec::new()))
        .collect();
    let mut found = 0;
    for (index, measure) in stored.measures.iter().enumerate() {
        let Some(bands) = source.bands(measure.measure.key())? else { continue };
        found += 1;
        let size = (0..bands.sizes.len()).max_by_key(|&size| bands.sizes[size]).unwrap_or_default();
        for (site, panel) in panels.iter_mut().enumerate() {
            let (mut band, median) = source.band(&bands, (site, poe, size), "", Tone::Distinct(index));
            let mut line = source.over_strengths(measure.measure.label(), &median, Tone::Distinct(index));
            if let Some(up_to) = up_to {
                // where the median comes down to that displacement, and on
                let from = line.points.iter().position(|point| point.1 < up_to).unwrap_or(line.points.len());
                line.points.drain(..from);
                band.points.drain(..from);
            }
            panel.bands.push(band);
            panel.series.push(line);
        }
    }
    Ok((found > 0).then_some(panels))
}

pub(super) fn measures_together(source: &FigureSource) -> Result<Option<Figure>, UpliftError> {
    let poe = source.rarest();
    let Some(panels) = together(source, poe, &Axis::log("displacement, m"), None)? else { return Ok(None) };
    let caption = format!(
        "Median and interval of the spectra of {} in {} years for the largest sample, by each intensity measure (Fig. 4.9): where the areas part, the measures contradict each other.",
        per_cent(source.stored.poes[poe]),
        source.stored.years
    );
    Ok(Some(source.figure("bands-together", "The measures side by side", caption, panels)))
}

pub(super) fn initiation(source: &FigureSource) -> Result<Option<Figure>, UpliftError> {
    let stored = &source.stored;
    let Some(poe) = (0..stored.poes.len()).max_by(|&a, &b| stored.poes[a].total_cmp(&stored.poes[b])) else {
        return Ok(None);
    };
    let top = 4.0 * stored.uplift_displacement_m;
    let Some(panels) = together(source, poe, &Axis::linear("displacement, m").between(0.0, top), Some(top))? else {
        return Ok(None);
    };
    let caption = format!(
        "Spectra of {} in {} years near the uplift displacement of {} m, for the largest sample (Fig. 4.10).",
        per_cent(stored.poes[poe]),
        stored.years,
        stored.uplift_displacement_m
    );
    Ok(Some(source.figure("initiation", "Where rocking begins", caption, panels)))
}
