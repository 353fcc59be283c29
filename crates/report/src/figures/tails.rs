//! What of the risk comes from outside the analysed levels.

use uplift::result::MeasureSpectra;
use uplift::text::{per_cent, risk_in_words};
use uplift_plot::{Axis, Figure, Panel, Tone};
use uplift_risk::TAIL_SHARE_LIMIT;

use super::{FigureSource, STRENGTH};

/// A figure for each measure whose levels should reach further: a panel for each site, lines for each probability over
/// the strengths, per cent.
pub(super) fn tail_shares(source: &FigureSource) -> Vec<Figure> {
    let stored = &source.spectra;
    let figure = |tails: &MeasureSpectra| {
        let panel = |site: usize| {
            let mut series = Vec::new();
            for (poe, &probability) in stored.poes.iter().enumerate() {
                let name = risk_in_words(probability, stored.years);
                let [lower, upper] =
                    [&tails.lower_tail_share, &tails.upper_tail_share].map(|shares| shares.block([site, poe]));
                let outside: Vec<f64> = lower.iter().zip(upper).map(|(lower, upper)| 100.0 * (lower + upper)).collect();
                series.push(source.over_strengths(name, &outside, Tone::Distinct(poe)));
            }
            let y = Axis::linear("share of the risk, %");
            Panel::lines(stored.sites[site].clone(), Axis::linear(STRENGTH), y, series)
        };
        let label = tails.measure.label();
        let caption = format!(
            "Share of the risk from below the first and above the last level of {label}, where nothing was analysed. \
             Above {}, extend the levels.",
            per_cent(TAIL_SHARE_LIMIT)
        );
        let id = format!("tails-{}", tails.measure.key());
        let title = format!("Risk from outside the analysed levels, by {label}");
        source.figure(id, title, caption, source.sites().map(panel).collect())
    };
    let beyond = |tails: &&MeasureSpectra| {
        tails
            .lower_tail_share
            .values()
            .iter()
            .chain(tails.upper_tail_share.values())
            .any(|&share| share > TAIL_SHARE_LIMIT)
    };
    stored.measures.iter().filter(beyond).map(figure).collect()
}
