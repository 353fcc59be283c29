//! What the hazard curves of the repository say of themselves (docs/hazard.md, hazard/README.md).

use uplift_hazard::{CsvOptions, HazardCurve, rate_from_probability, read_path};

use super::marks::hold;
use super::range;
use crate::common::repository;

const SITES: [&str; 6] = ["aachen", "athens", "baden", "focsani", "montreux", "perugia"];
const MEASURES: [(&str, &str); 2] = [("PGV", "cm/s"), ("PGA", "g")];

fn curve(folder: &str, (measure, unit): (&str, &str)) -> HazardCurve {
    let file = repository().join("hazard").join(folder).join(format!("{}.csv", measure.to_lowercase()));
    read_path(&file, &CsvOptions::new(measure, unit)).unwrap().curve
}

/// Levels at 50, 10 and 2 % in 50 years.
fn levels(curve: &HazardCurve) -> [f64; 3] {
    [0.5, 0.1, 0.02].map(|poe| curve.im_at_rate(rate_from_probability(poe, 50.0).unwrap()).unwrap())
}

/// Every `step`-th point of a curve, with its last.
fn thinned(curve: &HazardCurve, step: usize) -> HazardCurve {
    let points: Vec<_> = curve.points().collect();
    let kept = || points.iter().enumerate().filter(|(place, _)| place % step == 0 || place + 1 == points.len());
    let (im, maf) = kept().map(|(_, point)| (point.im, point.maf)).unzip();
    HazardCurve::new(curve.measure(), curve.unit(), "thinned", im, maf).unwrap()
}

/// Largest relative change, per cent, of the levels, and of the frequencies above 1e-5 a year.
fn changes(step: usize) -> [f64; 2] {
    let (mut of_levels, mut of_rates) = (Vec::new(), Vec::new());
    for (site, measure) in SITES.into_iter().flat_map(|site| MEASURES.map(|measure| (site, measure))) {
        let full = curve(site, measure);
        let few = thinned(&full, step);
        of_levels.extend(levels(&full).iter().zip(levels(&few)).map(|(full, few)| 100.0 * (few / full - 1.0).abs()));
        let above = full.points().filter(|point| point.maf > 1e-5);
        of_rates.extend(above.map(|point| 100.0 * (few.rate_at(point.im).unwrap() / point.maf - 1.0).abs()));
    }
    [range(of_levels)[1], range(of_rates)[1]]
}

#[test]
fn of_the_repository() {
    let mut computed = Vec::new();
    for (step, left) in [(2, 30), (3, 20), (6, 10)] {
        let [levels, rates] = changes(step);
        computed.push((format!("curves.levels-{left}"), format!("{levels:.1} %")));
        computed.push((format!("curves.rates-{left}"), format!("{rates:.0} %")));
    }
    let ratios = |variant: &str, site: &str, measure| {
        let [other, own] = [variant, site].map(|folder| levels(&curve(folder, measure)));
        [0, 1, 2].map(|poe| other[poe] / own[poe])
    };
    let [lower, higher] = range(ratios("athens/variants/without-inslab", "athens", MEASURES[0]));
    let lower_by = format!("{:.0} to {:.0} %", 100.0 * (1.0 - higher), 100.0 * (1.0 - lower));
    computed.push(("curves.without-inslab".to_owned(), lower_by));
    let [lower, higher] = range(ratios("focsani/variants/deep-parker-2020", "focsani", MEASURES[1]));
    computed.push(("curves.deep".to_owned(), format!("{lower:.1} to {higher:.1}")));
    hold("curves", &computed);
}
