//! Whether the records bring the site's hazard of the measure that they are not scaled to.

use uplift::result::StoredConsistency;
use uplift_plot::{Axis, Band, Figure, Panel, Series, Tone};

use super::FigureSource;
use super::spectra::RATE;

/// How far the axes go beyond the rates and levels compared, a factor.
const MARGIN: f64 = 1.6;

/// One figure, a panel for each site and each measure that records are scaled to: the annual rate over the level of the
/// other measure; none where nothing could be compared.
pub(super) fn consistency(source: &FigureSource) -> Option<Figure> {
    let by_measure = source.consistency.iter().map(|of| source.sites().filter_map(|site| panel(source, of, site)));
    let panels: Vec<Panel> = by_measure.flatten().collect();
    let caption = "Right of the hazard curve the records are too strong for the site, left of it too weak.";
    (!panels.is_empty()).then(|| source.figure("consistency", "Hazard consistency of the record set", caption, panels))
}

/// What the records scaled to one measure bring at a site; none where nothing was compared.
fn panel(source: &FigureSource, of: &StoredConsistency, site: usize) -> Option<Panel> {
    let rates = of.rate_per_year.block([site]);
    let lines = [
        ("hazard curve of the site", Some(&of.site_level), Tone::Distinct(4)),
        ("scaled records", Some(&of.implied_level), Tone::Distinct(1)),
        ("weighted records", of.repaired_level.as_ref(), Tone::Thin(5)),
    ];
    let line = |(name, levels, tone): (&str, Option<&uplift::Array<2>>, Tone)| {
        let points = levels?.block([site]).iter().copied().zip(rates.iter().copied());
        let points: Vec<(f64, f64)> = points.filter(|(level, rate)| level.is_finite() && rate.is_finite()).collect();
        (!points.is_empty()).then(|| Series::line(name, points, tone))
    };
    let lines: Vec<Series> = lines.into_iter().filter_map(line).collect();
    let points = || lines.iter().flat_map(|line| line.points.iter().copied());
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::INFINITY, 0.0_f64), |(least, largest), value: f64| (least.min(value), largest.max(value)))
    };
    let ((left, right), (low, high)) = (ends(&mut points().map(|at| at.0)), ends(&mut points().map(|at| at.1)));
    if lines.is_empty() {
        return None;
    }
    let (left, right) = (left / MARGIN, right * MARGIN);
    let series = source.targets((left, right), Tone::Faint).chain(lines).collect();
    let (scaled_to, other) = (of.scaled_to, of.other);
    let title = format!("{}, scaled to {}", source.stored.sites[site], scaled_to.label());
    let x = Axis::log(format!("{}, {}", other.label(), other.unit())).between(left, right);
    let y = Axis::log(RATE).between(low / MARGIN, high * MARGIN);
    let points = vec![(left, low, high), (right, low, high)];
    let bands = vec![Band { name: "rates compared".to_owned(), points, tone: Tone::Faint }];
    Some(Panel { bands, ..Panel::lines(title, x, y, series) })
}
