//! `uplift measures`: which intensity measure to trust.

use std::io::Write;

use clap::Args;
use serde_json::json;

use super::Terminal;
use super::result_of::ResultArguments;
use crate::show::shown_path;
use uplift::UpliftError;
use uplift::efficiency::{Covariate, Predictor, predictor};
use uplift::efficiency::{covariates, predictors_path, write_predictors};
use uplift::result::{ResultFile, StoredStripes, check_target};
use uplift::text::{nearest, table};

/// Strengths shown.
const SHOWN_STRENGTHS: [f64; 5] = [0.05, 0.1, 0.2, 0.4, 0.8];
/// Below this a slope is hardly chance.
const SIGNIFICANT: f64 = 0.05;

#[derive(Debug, Args)]
pub(super) struct MeasuresArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Print the rows as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn measures(arguments: &MeasuresArguments, session: &Terminal) -> Result<(), UpliftError> {
    let file = ResultFile::open(&arguments.result.find(session)?.path)?;
    let stored = file.stripes()?;
    check_target(&stored.path)?;
    let covariates = covariates(&file.records()?);
    let predictors = stored
        .measures
        .iter()
        .map(|measure| predictor(&stored, measure, &covariates))
        .collect::<Result<Vec<_>, _>>()?;
    write_predictors(&stored, &covariates, &predictors)?;
    let shown = nearest(&stored.strengths, &SHOWN_STRENGTHS);
    let mut out = std::io::stdout().lock();
    if arguments.json {
        return print_json(&mut out, &stored, &covariates, &predictors);
    }
    print_efficiency(&mut out, &stored, &predictors, &shown)?;
    print_sufficiency(&mut out, &stored, &covariates, &predictors, &shown)?;
    if !session.is_quiet() {
        print_reading(&mut out, &stored, &predictors, &shown)?;
        writeln!(out, "\nAll of it: /efficiency and /sufficiency in {}", shown_path(&stored.path).display())?;
        writeln!(out, "           {}", shown_path(&predictors_path(&stored.path)).display())?;
    }
    Ok(())
}

fn number(value: f64, digits: usize) -> String {
    if value.is_finite() { format!("{value:.digits$}") } else { "-".to_owned() }
}

fn print_efficiency(
    out: &mut impl Write,
    stored: &StoredStripes,
    predictors: &[Predictor],
    shown: &[usize],
) -> Result<(), UpliftError> {
    writeln!(
        out,
        "\nEfficiency: scatter (logarithmic) of the displacement at a given level once the structure rocks, of the level at which it\n\
         begins to rock, and the stripes whose scatter does not exist because too many runs overturn"
    )?;
    let mut header = vec!["strength".to_owned()];
    for predictor in predictors {
        let label = predictor.measure.label();
        header.extend([format!("{label} rocking"), "initiation".to_owned(), "undefined".to_owned()]);
    }
    let rows: Vec<Vec<String>> = shown
        .iter()
        .map(|&index| {
            let mut row = vec![format!("{:.3}", stored.strengths[index])];
            for predictor in predictors {
                row.push(number(predictor.rocking[index], 2));
                row.push(number(predictor.initiation[index], 3));
                row.push(format!("{} %", number(100.0 * predictor.undefined[index], 0)));
            }
            row
        })
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    writeln!(out, "{}", table(&header, &rows))?;
    Ok(())
}

fn print_sufficiency(
    out: &mut impl Write,
    stored: &StoredStripes,
    covariates: &[Covariate],
    predictors: &[Predictor],
    shown: &[usize],
) -> Result<(), UpliftError> {
    writeln!(
        out,
        "\nSufficiency: p-value of the trend of a record's mean residual with what the record is (below {SIGNIFICANT}, marked *: the measure\n\
         leaves something out), one observation a record"
    )?;
    if covariates.is_empty() {
        writeln!(out, "nothing is known of the records: give magnitude and rrup_km in the manifest")?;
        return Ok(());
    }
    let mut header = vec!["strength".to_owned()];
    for predictor in predictors {
        for covariate in covariates {
            header.push(format!("{} {}", predictor.measure.label(), covariate.key));
        }
    }
    let rows: Vec<Vec<String>> = shown
        .iter()
        .map(|&index| {
            let mut row = vec![format!("{:.3}", stored.strengths[index])];
            for lines in predictors.iter().flat_map(|predictor| &predictor.lines) {
                row.push(lines[index].as_ref().map_or_else(
                    || "-  ".to_owned(),
                    |line| {
                        let mark = if line.p_value < SIGNIFICANT { '*' } else { ' ' };
                        let p_value =
                            if line.p_value < 0.001 { "<0.001".to_owned() } else { format!("{:.3}", line.p_value) };
                        format!("{p_value} {mark}")
                    },
                ));
            }
            row
        })
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    writeln!(out, "{}", table(&header, &rows))?;
    Ok(())
}

fn print_reading(
    out: &mut impl Write,
    stored: &StoredStripes,
    predictors: &[Predictor],
    shown: &[usize],
) -> Result<(), UpliftError> {
    writeln!(out, "\nIn words:")?;
    if let [first, second] = predictors {
        for (what, of) in [
            (
                "the displacement of a rocking structure",
                (|predictor| &predictor.rocking) as fn(&Predictor) -> &Vec<f64>,
            ),
            ("the onset of rocking", |predictor| &predictor.initiation),
        ] {
            let wins: Vec<bool> = shown
                .iter()
                .filter(|&&index| of(first)[index].is_finite() && of(second)[index].is_finite())
                .map(|&index| of(first)[index] < of(second)[index])
                .collect();
            let count = wins.iter().filter(|&&win| win).count();
            let (a, b) = (first.measure.label(), second.measure.label());
            let said = match count {
                _ if wins.is_empty() => format!("for {what} the stripes do not tell which is more efficient"),
                all if all == wins.len() => format!("{a} is the more efficient for {what}, at every strength shown"),
                0 => format!("{b} is the more efficient for {what}, at every strength shown"),
                some => format!(
                    "{a} is the more efficient for {what} at {some} of the {} strengths shown, {b} at the others",
                    wins.len()
                ),
            };
            writeln!(out, "  {said}")?;
        }
    }
    writeln!(
        out,
        "  a measure serves a risk analysis only if hazard curves of it can be had: for PGV and PGA ground motion models and maps exist"
    )?;
    if stored.records.len() < 30 {
        writeln!(out, "  with {} records a p-value finds only strong trends", stored.records.len())?;
    }
    Ok(())
}

fn print_json(
    out: &mut impl Write,
    stored: &StoredStripes,
    covariates: &[Covariate],
    predictors: &[Predictor],
) -> Result<(), UpliftError> {
    let finite = |value: f64| value.is_finite().then_some(value);
    let mut rows = Vec::new();
    for predictor in predictors {
        for (index, &strength) in stored.strengths.iter().enumerate() {
            let trends: serde_json::Map<String, serde_json::Value> = covariates
                .iter()
                .zip(&predictor.lines)
                .map(|(covariate, lines)| {
                    let line = lines[index].as_ref();
                    let trend = json!({
                        "slope": line.map(|line| line.slope),
                        "p_value": line.and_then(|line| finite(line.p_value)),
                        "r_squared": line.and_then(|line| finite(line.r_squared)),
                    });
                    (covariate.key.to_owned(), trend)
                })
                .collect();
            rows.push(json!({
                "im": predictor.measure.label(),
                "strength": strength,
                "dispersion_rocking": finite(predictor.rocking[index]),
                "undefined_share": finite(predictor.undefined[index]),
                "dispersion_initiation": finite(predictor.initiation[index]),
                "trends": trends,
            }));
        }
    }
    writeln!(out, "{:#}", serde_json::Value::Array(rows))?;
    Ok(())
}
