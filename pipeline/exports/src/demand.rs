//! Demands for pelicun: how far each record of a result displaces its oscillators, or a structure, at one intensity.

use polars::prelude::Column;
use uplift_design::limit_stripes;
use uplift_fragility::Stripes;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind, beside};
use uplift_job::table::write_table;
use uplift_job::text::{risk_in_words, rounded};
use uplift_job::typed::all_numbers;
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_study::Repair;
use uplift_uniform_risk::{StoredMeasure, StoredStripes, at_target_risks, measure_index, site_index, strength_index};

use crate::error::ExportsError;
use crate::fragility::measures::pelicun;
use crate::options::ExportOptions;
use crate::report::ExportReport;

/// The first demand, by whose column the table is known: a displacement (`DEC`, Peak Deck Displacement) of system 1 in
/// direction 1, in which components of the [fragility table](crate::fragility) are.
const COLUMN: &str = "1-DEC-1-1";

/// One system under records scaled to the levels of a measure.
struct Displaced {
    name: String,
    levels: Vec<f64>,
    records: Vec<String>,
    /// `[record, level]`, m.
    demands_m: Vec<f64>,
    participation: f64,
}

/// Writes a demand sample of pelicun 3: a row each record, scaled to the intensity that the site exceeds with the
/// probability asked for; a location each system. Between two levels a demand lies on a straight line; where either is
/// infinite, since the record overturns the system, it is that at the higher one.
pub(crate) fn demand(site: &str, options: &ExportOptions, events: &dyn Events) -> Result<ExportReport, ExportsError> {
    let asked = &options.assessment;
    let structure = asked.structure()?;
    if options.risk.poe.len() + options.risk.return_period.len() > 1 {
        return Err(JobError::Usage("--demand: give one probability or return period".to_owned()).into());
    }
    let path = options.output.clone().unwrap_or_else(|| beside(&options.result, "demand.csv"));
    let output = Output::new(&path, OutputKind::Table(COLUMN)).with_result(&options.result);
    outputs::check(&[output], &options.inputs(), options.overwriting.force)?;

    let file = ResultFile::open(&options.result)?;
    file.refuse_records_at_level("a sample of demands has a row each record")?;
    let file = at_target_risks(file, &options.risk)?;
    let stored = StoredStripes::read(&file)?;
    let known = file.measures();
    let measure = known[measure_index(&known, asked.measure)?];
    let intensity = pelicun(measure).ok_or_else(|| {
        JobError::Usage(format!("--demand: pelicun has no {}: choose another with --measure", measure.long_name()))
    })?;
    let site = &stored.sites[site_index("--demand SITE", &stored.sites, site)?];
    let poe = stored.poe_index(None)?;
    let study = file.stored_study()?;
    let rate_per_year = stored.targets_per_year[poe];
    let level = file.site_curve(site, measure)?.im_at_rate_extrapolated(rate_per_year, study.risk.extrapolate)?;
    let systems = match &structure {
        None => oscillators(&stored, measure, &all_numbers(&asked.strength))?,
        Some(structure) => {
            let name = structure.file.file_stem().unwrap_or_default().to_string_lossy();
            let found = limit_stripes(structure, &options.result, &asked.limits(Some(measure)), events)?.into_iter();
            found
                .map(|of| Displaced {
                    name: format!("{name} {}", of.model),
                    levels: of.levels,
                    records: of.records,
                    demands_m: of.demands_m,
                    participation: of.participation,
                })
                .collect()
        }
    };
    let texts = |first: &str, values: &mut dyn Iterator<Item = f64>| {
        std::iter::once(first.to_owned()).chain(values.map(|value| value.to_string())).collect::<Vec<_>>()
    };
    // of one study, all systems have the same
    let records = systems.first().map_or(&[][..], |system| &system.records);
    let index: Vec<String> = std::iter::once("Units".to_owned()).chain(records.iter().cloned()).collect();
    let mut columns = vec![
        Column::new("record".into(), index),
        Column::new(
            format!("1-{}-0-1", intensity.acronym).into(),
            texts(intensity.unit, &mut std::iter::repeat_n(level, records.len())),
        ),
    ];
    let mut overturns = false;
    for (location, system) in (1..).zip(&systems) {
        let demands_m = system.demands_at(level, measure)?;
        overturns |= demands_m.iter().any(|demand_m| demand_m.is_infinite());
        columns.push(Column::new(format!("1-DEC-{location}-1").into(), texts("m", &mut demands_m.into_iter())));
    }
    write_table(&path, &stored.line("demands"), columns)?;
    // `36.91 cm/s, PGV of 2 % in 50 years at Athens; location 1: strength 0.2`
    let locations: Vec<String> =
        (1..).zip(&systems).map(|(location, system)| format!("location {location}: {}", system.name)).collect();
    let (level, unit, label) = (rounded(level, 4), measure.unit(), measure.label());
    let risk = risk_in_words(stored.poes[poe], stored.years);
    let mut words = format!("{level} {unit}, {label} of {risk} at {site}; {}", locations.join(", "));
    if overturns {
        words += "; inf: overturned";
    }
    if study.consistency.repair == Repair::Weights {
        words += "; without the weights of the repair";
    }
    Ok(ExportReport { files: vec![path], notes: vec![words] })
}

/// Oscillators of the `strengths` by one measure.
fn oscillators(
    stored: &StoredStripes,
    measure: IntensityMeasure,
    strengths: &[f64],
) -> Result<Vec<Displaced>, ExportsError> {
    if strengths.is_empty() {
        return Err(JobError::Usage("--demand: give --strength, or --structure".to_owned()).into());
    }
    let measures = stored.measures.iter().filter(|of| of.measure == measure);
    let displaced = |(of, &strength): (&StoredMeasure, &f64)| {
        let place = strength_index(&stored.strengths, strength)?;
        let stripes = of.stripes(place)?;
        Ok(Displaced {
            name: format!("strength {}", stored.strengths[place]),
            levels: of.levels.clone(),
            records: stored.records.clone(),
            demands_m: (0..stripes.record_count()).flat_map(|record| stripes.record(record).to_vec()).collect(),
            participation: 1.0,
        })
    };
    measures.flat_map(|of| strengths.iter().map(move |strength| (of, strength))).map(displaced).collect()
}

impl Displaced {
    /// Displacement of each record at a `level`, m.
    fn demands_at(&self, level: f64, measure: IntensityMeasure) -> Result<Vec<f64>, ExportsError> {
        let stripes = Stripes::new(&self.levels, &self.demands_m)?;
        let above = self.levels.partition_point(|&own| own < level);
        let Some(&upper) = self.levels.get(above) else {
            let (unit, last) = (measure.unit(), self.levels.last().copied().unwrap_or_default());
            return Err(JobError::Usage(format!(
                "--demand: the intensity asked for, {} {level:.4} {unit}, is above the last level, {last} {unit}: ask \
                 for a more frequent one, or run the study to higher levels",
                measure.label()
            ))
            .into());
        };
        let lower = above.checked_sub(1).map_or(0.0, |below| self.levels[below]);
        let share = (level - lower) / (upper - lower);
        let at = |record| {
            let curve = stripes.record(record);
            let from_m = above.checked_sub(1).map_or(0.0, |below| curve[below]);
            let to_m = curve[above];
            self.participation
                * if to_m.is_finite() && from_m.is_finite() { from_m + share * (to_m - from_m) } else { to_m }
        };
        Ok((0..stripes.record_count()).map(at).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn demands_lie_on_straight_lines_between_levels() {
        let inf = f64::INFINITY;
        let demands_m = vec![0.0, 0.4, 1.0, 0.1, 0.3, inf];
        let system = Displaced {
            name: String::new(),
            levels: vec![1.0, 2.0, 4.0],
            records: Vec::new(),
            demands_m,
            participation: 1.5,
        };
        let at = |level: f64| system.demands_at(level, IntensityMeasure::Pgv).unwrap();
        for (found, expected) in [(at(0.5), [0.0, 0.075]), (at(1.5), [0.3, 0.3]), (at(2.0), [0.6, 0.45])] {
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?}, {expected:?}");
        }
        assert_eq!(at(3.0)[1], inf);
        assert!((at(3.0)[0] - 1.05).abs() < 1e-15);
        assert!(system.demands_at(4.1, IntensityMeasure::Pgv).unwrap_err().to_string().contains("last level, 4 cm/s"));
    }
}
