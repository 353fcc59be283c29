//! Which intensities make the risk, and which records carry the spectra: what `uplift influence` has found.

use uplift::Array;
use uplift::influence::rank_records;
use uplift::result::{StoredInfluence, StoredMeasure};
use uplift::text::{nearest, risk_in_words};
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};

use super::{FigureSource, STRENGTH};

/// Strengths whose risk is taken apart.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];
/// Records that are named.
const NAMED: usize = 4;

impl FigureSource {
    /// The influence on each measure's spectra, with its stripes.
    pub(crate) fn influences(&self) -> impl Iterator<Item = (&StoredInfluence, &StoredMeasure)> {
        let stripes = |of: &StoredInfluence| self.stored.measures.iter().find(|known| known.measure == of.measure);
        self.influence.iter().filter_map(move |influence| Some((influence, stripes(influence)?)))
    }
}

/// The share of the risk from below each level, for the rarest probability: sums of shares need no bins of one width.
pub(super) fn disaggregation(source: &FigureSource) -> Vec<Figure> {
    let stored = &source.stored;
    let poe = source.rarest();
    let shown = nearest(&stored.strengths, &SHOWN_STRENGTHS);
    let figure = |(influence, _): (&StoredInfluence, &StoredMeasure)| {
        let panel = |site: usize| {
            let line = |(index, &strength): (usize, &usize)| {
                let shares = influence.shares.block([site, poe, strength]);
                let mut below = 0.0;
                let sums = shares.iter().map(|share| {
                    below += 100.0 * share;
                    below
                });
                // a bin reaches up to where the next begins; the last has no end, and no point
                let points = influence.bins[1..].iter().copied().zip(sums).collect();
                let name = format!("η = {:.2}", stored.strengths[strength]);
                Series::sampled(name, points, Tone::Distinct(index))
            };
            let x = Axis::linear(format!("{}, {}", influence.measure.label(), influence.measure.unit()));
            let y = Axis::linear("risk from below, %").between(0.0, 100.0);
            Panel::lines(stored.sites[site].clone(), x, y, shown.iter().enumerate().map(line).collect())
        };
        let label = influence.measure.label();
        let caption = format!(
            "Share of the risk at {} from below a level of {label}; the rest is from above the last level.",
            risk_in_words(stored.poes[poe], stored.years)
        );
        let id = format!("disaggregation-{}", influence.measure.key());
        let title = format!("Intensity levels that make up the risk, by {label}");
        source.figure(id, title, caption, source.sites().map(panel).collect())
    };
    source.influences().map(figure).collect()
}

/// How the spectrum of the rarest probability changes without each record; the same records are named at all sites.
pub(super) fn influence(source: &FigureSource) -> Vec<Figure> {
    let stored = &source.stored;
    let poe = source.rarest();
    let figure = |(influence, measure): (&StoredInfluence, &StoredMeasure)| {
        let without_m = influence.without_m.as_ref()?;
        let named = most_influential(source, measure, without_m);
        let panel = |site: usize| {
            let full_m = measure.exact_m.block([site, poe]);
            let change = |record: usize| -> Vec<f64> {
                let pairs = without_m.block([site, poe, record]).iter().zip(full_m);
                let rocks = |full_m: f64| full_m.is_finite() && full_m > stored.uplift_displacement_m;
                pairs.map(|(&own, &full)| if rocks(full) { 100.0 * (own / full - 1.0) } else { f64::NAN }).collect()
            };
            let others = stored.units.firsts().filter(|record| !named.contains(record));
            let grey = others.map(|record| source.over_strengths("", &change(record), Tone::Faint));
            let mut series: Vec<Series> = grey.map(|line| Series { marks: Marks::None, ..line }).collect();
            let line = |(index, &record): (usize, &usize)| {
                source.over_strengths(stored.units.name(record), &change(record), Tone::Distinct(index))
            };
            series.extend(named.iter().enumerate().map(line));
            let y = Axis::linear("change of u_{max}, %");
            Panel::lines(stored.sites[site].clone(), Axis::linear(STRENGTH), y, series)
        };
        let label = influence.measure.label();
        let caption = format!(
            "Change of the spectrum of {risk} without one {one}.",
            one = if stored.units.are_records() { "record" } else { "pair" },
            risk = risk_in_words(stored.poes[poe], stored.years)
        );
        let id = format!("influence-{}", influence.measure.key());
        let title = format!("Influence of single records, by {label}");
        Some(source.figure(id, title, caption, source.sites().map(panel).collect()))
    };
    source.influences().filter_map(figure).collect()
}

/// Positions of the records that change the spectrum of some site most on average, the most influential first.
fn most_influential(source: &FigureSource, measure: &StoredMeasure, without_m: &Array<4>) -> Vec<usize> {
    let mut largest = vec![0.0_f64; source.stored.records.len()];
    for site in source.sites() {
        for of in rank_records(&source.stored, &measure.exact_m, without_m, [site, source.rarest()]) {
            largest[of.record] = largest[of.record].max(of.mean_change.abs());
        }
    }
    let mut order: Vec<usize> = source.stored.units.firsts().collect();
    order.sort_by(|&a, &b| largest[b].total_cmp(&largest[a]));
    order.truncate(NAMED);
    order
}
