//! The spectra of variants of a study over each other.

use uplift::result::Spectrum;
use uplift::sweep::{SweepReport, VariantReport};
use uplift::text::risk_in_words;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

use super::{DISPLACEMENT, STRENGTH, remark};

/// Lines that a colour of its own tells apart; more are a ramp.
const TOLD_APART: usize = 7;

/// A panel for each measure and site: the spectra of all variants for the rarest risk of each.
pub fn sweep_figure(report: &SweepReport) -> Figure {
    let mut places: Vec<(&'static str, &str, bool)> = Vec::new();
    for (spectrum, repaired_m) in report.variants.iter().flat_map(|variant| variant.spectra.rows()) {
        for repaired in [false, true] {
            let place = (spectrum.measure.label(), spectrum.site, repaired);
            if (!repaired || repaired_m.is_some()) && !places.contains(&place) {
                places.push(place);
            }
        }
    }
    let of = report.variants.len();
    let panel = |&(im, site, repaired): &(&str, &str, bool)| {
        let line = |(step, variant): (usize, &VariantReport)| {
            let (spectrum, repaired_m) = rarest(variant, im, site)?;
            let u_m = if repaired { repaired_m? } else { spectrum.u_m };
            let points = variant.spectra.plain.strengths.iter().copied().zip(u_m.iter().copied()).collect();
            let tone = if of <= TOLD_APART { Tone::Distinct(step) } else { Tone::Shade { step, of } };
            Some(Series::sampled(&variant.name, points, tone))
        };
        let series = report.variants.iter().enumerate().filter_map(line).collect();
        let words = if repaired { ", repaired" } else { "" };
        Panel::lines(format!("{site}, {im}{words}"), Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), series)
    };
    let panels: Vec<Panel> = places.iter().map(panel).collect();
    let risk = report.variants.first().and_then(|variant| {
        let spectra = &variant.spectra.plain;
        Some(risk_in_words(spectra.poes.iter().copied().min_by(f64::total_cmp)?, spectra.years))
    });
    let synthetic = report.variants.iter().any(|variant| variant.synthetic);
    let title = format!("Variants of {}", report.title);
    let risk = risk.unwrap_or_default();
    let caption = format!("Uniform risk spectra of every variant, at its rarest risk ({risk} in the first).");
    Figure::new("comparison", title, caption, panels).with_remark(remark(synthetic))
}

/// The spectrum of a variant by a measure at a site for its smallest probability, with its repaired displacements, m.
fn rarest<'a>(variant: &'a VariantReport, im: &str, site: &str) -> Option<(Spectrum<'a>, Option<&'a [f64]>)> {
    let own = variant.spectra.rows().filter(|(own, _)| own.measure.label() == im && own.site == site);
    own.min_by(|(a, _), (b, _)| a.poe.total_cmp(&b.poe))
}
