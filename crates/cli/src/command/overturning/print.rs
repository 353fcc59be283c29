//! Overturning as an engineer reads it, and as a program does.

use std::io::Write;

use serde_json::{Value, json};

use super::Overturning;
use crate::command::structure::{lines, risk_cells, risk_json, structure_json};
use crate::error::CommandError;
use crate::show::shown_path;
use uplift::structure::{Collapse, Model};
use uplift::text::table;

impl Overturning<'_> {
    pub(super) fn print(&self, out: &mut impl Write) -> Result<(), CommandError> {
        for line in lines(self.structure, None) {
            writeln!(out, "{line}")?;
        }
        for (model, origin) in &self.models {
            match model {
                Model::Oscillator(oscillator) => {
                    writeln!(out, "oscillator restitution {} ({origin})", oscillator.restitution())?;
                }
                Model::Block(block) => writeln!(
                    out,
                    "block      rotates as a block of R = {:.4} m and slenderness {:.4} rad; restitution {:.4} ({origin})",
                    block.size_m(),
                    block.slenderness_rad(),
                    block.restitution()
                )?,
            }
        }
        writeln!(out, "records    {}, {}", shown_path(&self.source.path).display(), self.source.record_set)?;
        for note in &self.notes {
            writeln!(out, "note       {note}")?;
        }
        self.print_fragility(out)?;
        self.print_risk(out)
    }

    fn print_fragility(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let mut rows = Vec::new();
        for (measure, found) in &self.found {
            for (found, (model, _)) in found.iter().zip(&self.models) {
                let level = |wanted: &dyn Fn(u32, u32) -> bool| {
                    let count = found.counts.iter().find(|count| wanted(count.exceedances, count.trials));
                    count.map_or_else(|| "-".to_owned(), |count| count.level.to_string())
                };
                let at_last = found.counts.last().map_or(0, |count| count.exceedances);
                let fit = found.fit.as_ref().ok().map(|fit| fit.fragility);
                rows.push(vec![
                    format!("{}, {}", measure.measure().label(), measure.measure().unit()),
                    model.name().to_owned(),
                    level(&|overturned, _| overturned > 0),
                    level(&|overturned, records| 2 * overturned >= records),
                    format!("{at_last} of {}", self.records),
                    fit.map_or_else(|| "-".to_owned(), |fit| format!("{:.4}", fit.median())),
                    fit.map_or_else(|| "-".to_owned(), |fit| format!("{:.4}", fit.dispersion())),
                ]);
            }
        }
        let header = ["measure", "model", "first overturns", "half overturn", "at the last level", "theta", "beta"];
        writeln!(
            out,
            "\nCollapse fragility: levels at which the first and half of the records overturn the structure, and the lognormal curve of maximum\n\
             likelihood beside them\n{}",
            table(&header, &rows)
        )?;
        Ok(())
    }

    fn print_risk(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let mut rows = Vec::new();
        for (index, &site) in self.sites.iter().enumerate() {
            let mut name = self.source.sites[site].clone();
            for (measure, found) in &self.found {
                for (found, (model, _)) in found.iter().zip(&self.models) {
                    let risk = &found.risks[index];
                    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
                    let mut row =
                        vec![std::mem::take(&mut name), measure.measure().label().to_owned(), model.name().to_owned()];
                    row.extend(risk_cells(risk));
                    row.extend([
                        found
                            .fitted
                            .as_ref()
                            .map_or_else(|| "-".to_owned(), |fitted| format!("{:.3e}", fitted[index].per_year)),
                        percent(risk.lower_tail_share),
                        percent(risk.upper_tail_share),
                    ]);
                    rows.push(row);
                }
            }
        }
        let in_years = format!("in {} years", self.source.study.risk.years);
        let header = ["site", "im", "model", "per year", &in_years, "return period", "lognormal", "below", "above"];
        writeln!(
            out,
            "\nRisk of overturning: from the counted shares; with the lognormal curve in their place; and what of the first comes from below and\n\
             above the analysed levels\n{}",
            table(&header, &rows)
        )?;
        Ok(())
    }

    pub(super) fn print_json(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let models: Vec<Value> = self
            .models
            .iter()
            .map(|(model, origin)| {
                let size = match model {
                    Model::Oscillator(_) => None,
                    Model::Block(block) => Some((block.size_m(), block.slenderness_rad())),
                };
                json!({
                    "model": model.name(),
                    "restitution": model.restitution(),
                    "restitution_from": origin,
                    "size_m": size.map(|(size_m, _)| size_m),
                    "slenderness_rad": size.map(|(_, slenderness_rad)| slenderness_rad),
                })
            })
            .collect();
        let of = |found: &Collapse, model: &Model, measure: &uplift::result::SpectraOfResult| {
            let fit = found.fit.as_ref().ok();
            let sites: Vec<Value> = self
                .sites
                .iter()
                .enumerate()
                .map(|(index, &site)| {
                    let mut risk = risk_json(&found.risks[index]);
                    risk["site"] = json!(self.source.sites[site]);
                    risk["lognormal_per_year"] = json!(found.fitted.as_ref().map(|fitted| fitted[index].per_year));
                    risk
                })
                .collect();
            json!({
                "im": measure.measure().label(),
                "unit": measure.measure().unit(),
                "model": model.name(),
                "levels": found.counts.iter().map(|count| count.level).collect::<Vec<_>>(),
                "overturned": found.counts.iter().map(|count| count.exceedances).collect::<Vec<_>>(),
                "records": self.records,
                "theta": fit.map(|fit| fit.fragility.median()),
                "beta": fit.map(|fit| fit.fragility.dispersion()),
                "log_likelihood": fit.map(|fit| fit.log_likelihood),
                "sites": sites,
            })
        };
        let fragilities: Vec<Value> = self
            .found
            .iter()
            .flat_map(|(measure, found)| {
                found.iter().zip(&self.models).map(move |(found, (model, _))| of(found, model, measure))
            })
            .collect();
        let json = json!({
            "structure": structure_json(self.structure, None),
            "result": self.source.path,
            "record_set": self.source.record_set,
            "synthetic": self.source.synthetic,
            "years": self.source.study.risk.years,
            "models": models,
            "overturning": fragilities,
            "notes": self.notes,
        });
        writeln!(out, "{json:#}")?;
        Ok(())
    }
}
