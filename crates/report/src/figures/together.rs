//! One spectrum of several results in one figure.

use uplift::text::risk_in_words;
use uplift_plot::{Axis, Figure, Panel, Tone, share_y};

use super::{DISPLACEMENT, FigureSource, STRENGTH};

/// The spectra of the rarest probability that all results have, a panel for each of their common sites and a line for
/// each result; none where they have no measure, probability or site in common.
///
/// * `results` — each with the name of its lines
pub(crate) fn together(results: &[(&str, &FigureSource)]) -> Option<Figure> {
    let ((_, first), others) = results.split_first()?;
    let everywhere = |has: &dyn Fn(&FigureSource) -> bool| others.iter().all(|(_, source)| has(source));
    let spectra = &first.spectra;
    let measure = spectra.measures.iter().map(|of| of.measure).find(|&m| everywhere(&|of| of.u_m(m).is_some()))?;
    let years = spectra.years;
    let poe_of = |of: &FigureSource, poe: f64| {
        let same = of.spectra.years.to_bits() == years.to_bits();
        of.spectra.poes.iter().position(|known| same && (known - poe).abs() < 1e-9)
    };
    let common = spectra.poes.iter().copied().filter(|&poe| everywhere(&|of| poe_of(of, poe).is_some()));
    let poe = common.min_by(f64::total_cmp)?;
    let site_of = |of: &FigureSource, site: &str| of.spectra.sites.iter().position(|known| known == site);
    let shown =
        first.sites().map(|site| &spectra.sites[site]).filter(|site| everywhere(&|of| site_of(of, site).is_some()));
    let panel = |site: &String| {
        let line = |(index, (name, of)): (usize, &(&str, &FigureSource))| {
            let at = [site_of(of, site)?, poe_of(of, poe)?];
            Some(of.over_strengths(*name, of.u_m(measure)?.block(at), Tone::Distinct(index)))
        };
        let series = results.iter().enumerate().filter_map(line).collect();
        Panel::lines(site, Axis::linear(STRENGTH), Axis::log(DISPLACEMENT), series)
    };
    let mut panels: Vec<Panel> = shown.map(panel).collect();
    if panels.is_empty() {
        return None;
    }
    share_y(&mut panels);
    let title = format!("Spectra of {} by {}", risk_in_words(poe, years), measure.label());
    let remark = results.iter().map(|(_, of)| of.remark).find(|remark| !remark.is_empty()).unwrap_or_default();
    Some(Figure::new("together", title, "The same spectrum of every result.", panels).with_remark(remark))
}
