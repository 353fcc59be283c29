//! `uplift influence`: which records carry the spectra, and which intensities.

use std::io::Write;

use clap::Args;
use serde_json::json;

use super::Terminal;
use super::result_of::ResultArguments;
use crate::show::shown_path;
use uplift::influence::{Influence, influence as influence_of, level_of_share};
use uplift::influence::{RecordInfluence, influence_path, record_influence, write_influence};
use uplift::result::{ResultFile, StoredStripes, check_target};
use uplift::text::{metres, nearest, per_cent, table};
use uplift::{Array, UpliftError};

/// Strengths at which the risk is taken apart.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

#[derive(Debug, Args)]
pub(super) struct InfluenceArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Records shown for each site
    #[arg(long, value_name = "N", default_value_t = 3)]
    top: usize,
    /// Probability of exceedance shown [default: the smallest]
    #[arg(long)]
    poe: Option<f64>,
    /// Print the rows as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn influence(arguments: &InfluenceArguments, session: &Terminal) -> Result<(), UpliftError> {
    let stored = ResultFile::open(&arguments.result.find(session)?.path)?.stripes()?;
    check_target(&stored.path)?;
    let poe = stored.poe_index(arguments.poe)?;
    let influences =
        stored.measures.iter().map(|measure| influence_of(&stored, measure)).collect::<Result<Vec<_>, _>>()?;
    let shape = [stored.sites.len(), stored.poes.len()];
    let rankings: Vec<Array<2, Vec<RecordInfluence>>> = influences
        .iter()
        .zip(&stored.measures)
        .map(|(influence, measure)| Array::from_fn(shape, |at| record_influence(&stored, measure, influence, at)))
        .collect();
    write_influence(&stored, &influences, &rankings)?;
    let view = View { stored: &stored, influences: &influences, rankings: &rankings, poe, top: arguments.top };
    let mut out = std::io::stdout().lock();
    if arguments.json {
        return view.print_json(&mut out);
    }
    view.print_records(&mut out)?;
    view.print_intensities(&mut out)?;
    if !session.is_quiet() {
        writeln!(out, "\nAll of it: /influence and /disaggregation in {}", shown_path(&stored.path).display())?;
        writeln!(out, "           {}", shown_path(&influence_path(&stored.path)).display())?;
    }
    Ok(())
}

struct View<'a> {
    stored: &'a StoredStripes,
    influences: &'a [Influence],
    rankings: &'a [Array<2, Vec<RecordInfluence>>],
    poe: usize,
    top: usize,
}

impl View<'_> {
    fn name(&self) -> String {
        format!("{} in {} years", per_cent(self.stored.poes[self.poe]), self.stored.years)
    }

    fn print_records(&self, out: &mut impl Write) -> Result<(), UpliftError> {
        let stored = self.stored;
        writeln!(
            out,
            "\nRecords that carry the spectra of {}: change of the ordinates without the record, per cent,\n\
             on average over the strengths that rock, and at most",
            self.name()
        )?;
        let mut rows = Vec::new();
        for (influence, rankings) in self.influences.iter().zip(self.rankings) {
            for (site, name) in stored.sites.iter().enumerate() {
                let ranking = &rankings[[site, self.poe]];
                for (place, entry) in ranking.iter().take(self.top).enumerate() {
                    rows.push(vec![
                        if place == 0 { name.clone() } else { String::new() },
                        influence.measure.label().to_owned(),
                        stored.records[entry.record].clone(),
                        format!("{:+.1}", 100.0 * entry.mean_change),
                        format!("{:+.0}", 100.0 * entry.largest_change),
                        format!("{:.3}", entry.strength),
                    ]);
                }
            }
        }
        if rows.is_empty() {
            writeln!(out, "none: the set has one record, or nothing rocks")?;
            return Ok(());
        }
        writeln!(out, "{}", table(&["site", "im", "record", "average", "at most", "at strength"], &rows))?;
        Ok(())
    }

    fn print_intensities(&self, out: &mut impl Write) -> Result<(), UpliftError> {
        let stored = self.stored;
        writeln!(
            out,
            "\nIntensities that make the risk of {}: levels below which 5, 50 and 95 % of it lie, and its shares outside the stripes",
            self.name()
        )?;
        let mut rows = Vec::new();
        self.each_ordinate(|site, row, measure, strength, ordinate_m, shares| {
            let level = |share: f64| {
                let level = level_of_share(&measure.levels, shares, share);
                if level.is_nan() { "-".to_owned() } else { format!("{level:.3}") }
            };
            let percent = |share: f64| if share.is_nan() { "-".to_owned() } else { format!("{:.1} %", 100.0 * share) };
            rows.push(vec![
                if row == 0 { stored.sites[site].clone() } else { String::new() },
                format!("{}, {}", measure.measure.label(), measure.measure.unit()),
                format!("{strength:.3}"),
                metres(ordinate_m),
                level(0.05),
                level(0.5),
                level(0.95),
                percent(shares[0]),
                percent(shares[shares.len() - 1]),
            ]);
        });
        let header = ["site", "im", "strength", "u, m", "5 %", "50 %", "95 %", "below", "above"];
        writeln!(out, "{}", table(&header, &rows))?;
        Ok(())
    }

    /// Calls `show` with site, row within the site, measure, strength, ordinate and shares.
    fn each_ordinate(&self, mut show: impl FnMut(usize, usize, &uplift::result::StoredMeasure, f64, f64, &[f64])) {
        let stored = self.stored;
        let shown = nearest(&stored.strengths, &SHOWN_STRENGTHS);
        for (influence, measure) in self.influences.iter().zip(&stored.measures) {
            for site in 0..stored.sites.len() {
                for (row, &strength) in shown.iter().enumerate() {
                    let at = [site, self.poe, strength];
                    let shares = influence.shares.block(at);
                    show(site, row, measure, stored.strengths[strength], measure.exact_m[at], shares);
                }
            }
        }
    }

    fn print_json(&self, out: &mut impl Write) -> Result<(), UpliftError> {
        let stored = self.stored;
        let mut records = Vec::new();
        for (influence, rankings) in self.influences.iter().zip(self.rankings) {
            for ([site, poe], ranking) in rankings.blocks() {
                for entry in ranking[0].iter().take(self.top) {
                    records.push(json!({
                        "site": stored.sites[site],
                        "im": influence.measure.label(),
                        "poe": stored.poes[poe],
                        "record": stored.records[entry.record],
                        "mean_change_pct": 100.0 * entry.mean_change,
                        "largest_change_pct": 100.0 * entry.largest_change,
                        "at_strength": entry.strength,
                    }));
                }
            }
        }
        let mut intensities = Vec::new();
        let finite = |value: f64| value.is_finite().then_some(value);
        self.each_ordinate(|site, _, measure, strength, ordinate_m, shares| {
            let level = |share: f64| finite(level_of_share(&measure.levels, shares, share));
            intensities.push(json!({
                "site": stored.sites[site],
                "im": measure.measure.label(),
                "unit": measure.measure.unit(),
                "poe": stored.poes[self.poe],
                "strength": strength,
                "u_m": finite(ordinate_m),
                "level_05": level(0.05),
                "level_50": level(0.5),
                "level_95": level(0.95),
                "share_below_stripes": finite(shares[0]),
                "share_above_stripes": finite(shares[shares.len() - 1]),
            }));
        });
        writeln!(out, "{:#}", json!({ "records": records, "intensities": intensities }))?;
        Ok(())
    }
}
