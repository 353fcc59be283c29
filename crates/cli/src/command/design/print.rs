//! The design as an engineer reads it, and as a program does.

use std::io::Write;

use serde_json::{Value, json};
use uplift_spectra::Noisy;
use uplift_structure::{Check, Demand, Rule, relative_error};

use super::Design;
use crate::command::structure::{capacity_m, finite, lines, risk_cells, risk_json, short, structure_json};
use crate::error::CommandError;
use crate::show::shown_path;
use uplift::structure::DemandNoise;
use uplift::text::{per_cent, table};

/// A displacement; infinite where the structure overturns.
fn metres(value_m: f64) -> String {
    if value_m.is_infinite() { "overturns".to_owned() } else { format!("{value_m:.4}") }
}

fn name(rule: Rule) -> &'static str {
    match rule {
        Rule::EqualDisplacement => "equal displacement",
        Rule::EqualEnergy => "equal energy",
    }
}

fn key(rule: Rule) -> &'static str {
    match rule {
        Rule::EqualDisplacement => "equal-displacement",
        Rule::EqualEnergy => "equal-energy",
    }
}

impl Design<'_> {
    pub(super) fn print(&self, out: &mut impl Write) -> Result<(), CommandError> {
        for line in lines(self.structure, Some(self.restitution)) {
            writeln!(out, "{line}")?;
        }
        let (source, risk) = (self.source, &self.source.study.risk);
        writeln!(
            out,
            "demand     {} by {}, {} in {} years: {:.4e} per year",
            source.sites[self.site],
            self.measure.measure().label(),
            per_cent(risk.poe[self.poe]),
            risk.years,
            self.target_per_year
        )?;
        writeln!(out, "           {}, {}", shown_path(&source.path).display(), source.record_set)?;
        for note in &self.notes {
            writeln!(out, "note       {note}")?;
        }
        self.print_demands(out)?;
        self.print_rules(out)?;
        self.print_risk(out)?;
        self.print_noise(out)
    }

    /// Displacements of the structure, from the spectrum and exact.
    fn print_demands(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let factor = self.structure.system.participation();
        let strength = self.structure.system.spectral_strength_at(self.source.study.gravity_m_s2);
        let mut rows = Vec::new();
        let mut row = |what: String, demand_m: f64| {
            rows.push(vec![what, metres(demand_m / factor), metres(demand_m)]);
        };
        if let Some(reading) = &self.reading {
            let (a, b) = reading.between;
            let between = if a < b { format!(", between {a:.4} and {b:.4}") } else { String::new() };
            row(format!("zero stiffness, spectrum at strength {strength:.4}{between}"), factor * reading.ordinate_m);
        }
        if let Some(exact) = &self.exact {
            row("zero stiffness, exact".to_owned(), exact.of_spectrum_m);
            if exact.zero_stiffness_m.to_bits() != exact.of_spectrum_m.to_bits() {
                row("zero stiffness, exact, uplift and impacts of the structure".to_owned(), exact.zero_stiffness_m);
            }
            row("the structure itself, exact".to_owned(), exact.structure.displacement_m);
        }
        if rows.is_empty() {
            writeln!(out, "\nThere is no demand to show.")?;
            return Ok(());
        }
        let times = format!("times {factor:.4}, m");
        writeln!(out, "\n{}", table(&["demand", "oscillator, m", &times], &rows))?;
        Ok(())
    }

    fn print_rules(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let Some(rules) = &self.rules else {
            writeln!(
                out,
                "\nThe rules of equal displacement and equal energy do not apply: the force rises after uplift, and there is no capacity\nto exceed. The demand on the structure itself is the one above."
            )?;
            return Ok(());
        };
        let Some(exact) = &self.exact else { return self.print_checks(out) };
        let error =
            |demand_m: f64| shown_error(relative_error(demand_m, exact.structure.displacement_m).unwrap_or(f64::NAN));
        let cells = |check: Option<&Check>| match check.map(|check| check.demand.displacement_m()) {
            Some(demand_m) => [metres(demand_m), error(demand_m)],
            None => ["-".to_owned(), "-".to_owned()],
        };
        let rows: Vec<Vec<String>> = rules
            .iter()
            .map(|outcome| {
                let mut row = vec![name(outcome.rule).to_owned()];
                row.extend(cells(outcome.from_spectrum.as_ref()));
                row.extend(cells(outcome.from_exact.as_ref()));
                row
            })
            .collect();
        let header = ["rule", "from the spectrum, m", "error", "from the exact demand, m", "error of the rule"];
        writeln!(out, "\n{}", table(&header, &rows))?;
        self.print_checks(out)
    }

    /// Required capacity and verdict.
    fn print_checks(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let mut rows = Vec::new();
        for outcome in self.rules.iter().flatten() {
            let Some(check) = outcome.check() else { continue };
            if let Demand::Overturns { largest_zero_stiffness_demand_m } = check.demand {
                writeln!(
                    out,
                    "\nThe rule of {} says that the structure overturns: the demand at zero stiffness, {:.4} m, is beyond the {largest_zero_stiffness_demand_m:.4} m{} that its capacity allows.",
                    name(outcome.rule),
                    check.zero_stiffness_demand_m,
                    if outcome.rule == Rule::EqualEnergy { " (Eq. 3.14)" } else { "" }
                )?;
            }
            let infinite = check.capacity_m.is_infinite();
            rows.push(vec![
                name(outcome.rule).to_owned(),
                metres(check.demand.displacement_m()),
                format!("{:.4}", check.required_capacity_m),
                if infinite { "infinite".to_owned() } else { format!("{:.4}", check.capacity_m) },
                if infinite { "-".to_owned() } else { format!("{:+.4}", check.margin_m()) },
                if infinite { "-".to_owned() } else { format!("{:.2}", check.safety_factor()) },
                if check.is_satisfied() { "satisfied" } else { "NOT satisfied" }.to_owned(),
            ]);
        }
        if rows.is_empty() {
            return Ok(());
        }
        let tendons = self.rules.iter().flatten().filter_map(|outcome| {
            let stiffness_n_m = self.tendon_stiffness_n_m(outcome.check()?)?;
            let told = if stiffness_n_m > 0.0 { format!("{} N/m", short(stiffness_n_m)) } else { "none".to_owned() };
            Some(format!("{told} ({})", name(outcome.rule)))
        });
        let tendons: Vec<String> = tendons.collect();
        let header =
            ["rule", "demand, m", "required capacity, m", "capacity, m", "margin, m", "safety factor", "verdict"];
        writeln!(
            out,
            "\nRequired capacity with a safety factor of {} (Eq. 3.15)\n{}",
            self.safety_factor,
            table(&header, &rows)
        )?;
        if !tendons.is_empty() {
            writeln!(out, "Tendons that give the required capacity, each: {}", tendons.join(", "))?;
        }
        Ok(())
    }

    /// Stiffness of each tendon that would give the required capacity, N/m; none for a structure without tendons, or without a demand.
    fn tendon_stiffness_n_m(&self, check: &Check) -> Option<f64> {
        self.structure.description.tendon_stiffness_for_capacity_n_m(check.required_capacity_m).ok()?
    }

    fn print_risk(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let Some(exact) = &self.exact else { return Ok(()) };
        let Some(capacity_m) = capacity_m(&self.structure.system) else { return Ok(()) };
        let mut rows = Vec::new();
        let mut row = |what: String, risk| {
            let mut cells = vec![what];
            cells.extend(risk_cells(risk));
            rows.push(cells);
        };
        if let Some(risk) = &exact.beyond_capacity {
            row(format!("u > {capacity_m:.4} m, the capacity"), risk);
        }
        row("overturning".to_owned(), &exact.overturning);
        let in_years = format!("in {} years", self.source.study.risk.years);
        let header = ["the structure itself", "per year", &in_years, "return period, years"];
        writeln!(out, "\n{}", table(&header, &rows))?;
        if exact.structure.displacement_m.is_infinite() {
            writeln!(
                out,
                "\nThe structure overturns more often than the target of {:.4e} per year: there is no displacement that meets it.",
                self.target_per_year
            )?;
        }
        Ok(())
    }

    /// What of these numbers is noise.
    fn print_noise(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let Some(DemandNoise { structure_m, rule_errors, beyond_capacity_per_year, overturning_per_year }) =
            self.exact.map(|exact| exact.noise)
        else {
            return Ok(());
        };
        let per_year = |value: f64| if value == 0.0 { "never".to_owned() } else { format!("{value:.3e}") };
        let mut rows = Vec::new();
        let mut row = |what: String, noisy: Noisy, shown: &dyn Fn(f64) -> String| {
            rows.push(vec![what, shown(noisy.value), shown(noisy.lowest), shown(noisy.highest)]);
        };
        row("demand on the structure, m".to_owned(), structure_m, &metres);
        for (errors, outcome) in rule_errors.into_iter().zip(&self.rules) {
            for (error, outcome) in errors.into_iter().zip(outcome) {
                row(format!("error of {}", name(outcome.rule)), error, &shown_error);
            }
        }
        if let Some(beyond) = beyond_capacity_per_year {
            row("u > capacity, per year".to_owned(), beyond, &per_year);
            row("overturning, per year".to_owned(), overturning_per_year, &per_year);
        }
        let header = ["within 1 % of the strength", "here", "lowest", "highest"];
        writeln!(out, "\n{}", table(&header, &rows))?;
        Ok(())
    }

    pub(super) fn json(&self) -> Value {
        let (source, risk) = (self.source, &self.source.study.risk);
        let check = |check: &Check| {
            json!({
                "zero_stiffness_demand_m": check.zero_stiffness_demand_m,
                "demand_m": finite(check.demand.displacement_m()),
                "overturns": check.demand.displacement_m().is_infinite(),
                "error": self.exact.and_then(|exact| {
                    relative_error(check.demand.displacement_m(), exact.structure.displacement_m).and_then(finite)
                }),
                "required_capacity_m": check.required_capacity_m,
                "required_tendon_stiffness_n_m": self.tendon_stiffness_n_m(check),
                "margin_m": finite(check.margin_m()),
                "safety_factor": finite(check.safety_factor()),
                "satisfied": check.is_satisfied(),
            })
        };
        let rules: Vec<Value> = self
            .rules
            .iter()
            .flatten()
            .map(|outcome| {
                json!({
                    "rule": key(outcome.rule),
                    "from_spectrum": outcome.from_spectrum.as_ref().map(check),
                    "from_exact": outcome.from_exact.as_ref().map(check),
                })
            })
            .collect();
        let factor = self.structure.system.participation();
        json!({
            "structure": structure_json(self.structure, Some(self.restitution)),
            "result": source.path,
            "record_set": source.record_set,
            "synthetic": source.synthetic,
            "site": source.sites[self.site],
            "im": self.measure.measure().label(),
            "poe": risk.poe[self.poe],
            "years": risk.years,
            "target_per_year": self.target_per_year,
            "required_safety_factor": self.safety_factor,
            "spectrum": self.reading.map(|reading| json!({
                "between_strengths": [reading.between.0, reading.between.1],
                "ordinate_m": reading.ordinate_m,
                "zero_stiffness_demand_m": factor * reading.ordinate_m,
            })),
            "exact": self.exact.map(|exact| json!({
                "analyses": exact.analyses,
                "zero_stiffness_demand_of_spectrum_m": finite(exact.of_spectrum_m),
                "zero_stiffness_demand_m": finite(exact.zero_stiffness_m),
                "demand_m": finite(exact.structure.displacement_m),
                "overturns": exact.structure.displacement_m.is_infinite(),
                "lower_tail_share": exact.structure.lower_tail_share,
                "upper_tail_share": exact.structure.upper_tail_share,
                "beyond_capacity": exact.beyond_capacity.as_ref().map(risk_json),
                "overturning": risk_json(&exact.overturning),
                "within_one_percent_of_strength": {
                    "demand_m": noise_json(exact.noise.structure_m),
                    "rule_errors": exact.noise.rule_errors.map(|[displacement, energy]| json!({
                        key(Rule::EqualDisplacement): noise_json(displacement),
                        key(Rule::EqualEnergy): noise_json(energy),
                    })),
                    "beyond_capacity_per_year": exact.noise.beyond_capacity_per_year.map(noise_json),
                    "overturning_per_year": noise_json(exact.noise.overturning_per_year),
                },
            })),
            "rules": rules,
            "notes": self.notes,
        })
    }
}

/// An error in words; NaN where there is none.
fn shown_error(error: f64) -> String {
    match error {
        _ if error.is_nan() => "-".to_owned(),
        _ if error.is_infinite() => "too safe".to_owned(),
        _ => format!("{:+.1} %", 100.0 * error),
    }
}

/// A range for programs: a bound is null where it is infinite, or where there is none.
fn noise_json(noisy: Noisy) -> Value {
    json!({ "value": finite(noisy.value), "lowest": finite(noisy.lowest), "highest": finite(noisy.highest) })
}
