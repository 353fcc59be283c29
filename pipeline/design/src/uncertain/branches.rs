//! Branches: every structure that it may be has an answer; these make a band, and its variance is shared out among what
//! is uncertain.

use std::collections::HashMap;

use rayon::prelude::*;
use uplift_bootstrap::{BootstrapError, ResamplingPlan};
use uplift_ida::System;
use uplift_risk::{PooledDemand, RecordSample, RiskCurve};
use uplift_study::Uncertainty;
use uplift_uncertainty::{SobolIndices, sobol_indices, unit_cube};
use uplift_uniform_risk::{Stripes, pooled_demand};

use super::question::{Event, SiteQuestions};
use super::report::{EpistemicResult, Spread, UncertainFinding, VarianceShare};
use crate::certainty::Scatter;
use crate::error::DesignError;

/// Resamples of the rows that errors of indices are made of.
const REPLICATES: usize = 1000;

/// The rows of two samples of all that is uncertain, and those with one group of quantities taken over.
#[derive(Debug)]
pub(super) struct Branches {
    /// Position of each row's system: of the first sample, of the second, and of the first with each group of
    /// quantities from the second, `[sample][row]`.
    systems: Vec<Vec<usize>>,
    /// Numbers between 0 and 1 that choose the hazard's branch in each row of both samples.
    hazard: [Vec<f64>; 2],
    /// The groups of quantities, by their names.
    groups: Vec<String>,
}

/// One answer: which structure, which hazard, which records.
#[derive(Debug, Clone, Copy)]
struct Cell {
    system: usize,
    /// None for the mean.
    hazard: Option<f64>,
    /// None for all.
    sample: Option<usize>,
}

/// The points of both samples, `[sample][row]`: a number for each quantity, and one for the hazard's branch.
pub(super) fn samples(of: &Uncertainty) -> Result<[Vec<Vec<f64>>; 2], DesignError> {
    // one dimension more for the hazard; of both samples
    let factors = of.quantities.len() + 1;
    let points = unit_cube(of.sampling, (of.samples, 2 * factors), of.seed)?;
    let half = |half: usize| {
        points.chunks_exact(2 * factors).map(|row| row[half * factors..(half + 1) * factors].to_vec()).collect()
    };
    Ok([half(0), half(1)])
}

impl Branches {
    /// Draws them: their systems, each once, and which are which.
    pub(super) fn draw(
        of: &Uncertainty,
        realize: &dyn Fn(&[f64]) -> Result<System, DesignError>,
    ) -> Result<(Vec<System>, Self), DesignError> {
        let quantities = of.quantities.len();
        let [first, second] = samples(of)?;
        let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
        let mut systems = Vec::new();
        let mut place = |point: &[f64]| -> Result<usize, DesignError> {
            let system = realize(&point[..quantities])?;
            let identity = system.identity().into_iter().map(f64::to_bits).collect();
            Ok(*known.entry(identity).or_insert_with(|| {
                systems.push(system);
                systems.len() - 1
            }))
        };
        let groups = of.vector.copula().groups();
        let mut samples = Vec::new();
        for points in [&first, &second] {
            samples.push(points.iter().map(|point| place(point)).collect::<Result<Vec<_>, _>>()?);
        }
        for group in groups {
            let with = |(first, second): (&Vec<f64>, &Vec<f64>)| {
                let mut point = first.clone();
                for &quantity in group {
                    point[quantity] = second[quantity];
                }
                place(&point)
            };
            samples.push(first.iter().zip(&second).map(with).collect::<Result<Vec<_>, _>>()?);
        }
        let name = |group: &Vec<usize>| {
            let names: Vec<&str> = group.iter().map(|&place| of.quantities[place].name()).collect();
            names.join(" and ")
        };
        let hazard = [&first, &second].map(|points| points.iter().map(|point| point[quantities]).collect());
        Ok((systems, Self { systems: samples, hazard, groups: groups.iter().map(name).collect() }))
    }

    /// Bands and shares, `[site, asked]`, of oscillators with the factor from them to the structure.
    pub(super) fn findings(
        &self,
        (systems, participation): (&[System], f64),
        seed: u64,
        (stripes, sites): (&Stripes, &[SiteQuestions<'_>]),
        scatter: &Scatter,
    ) -> Result<Vec<UncertainFinding>, DesignError> {
        let rows = self.hazard[0].len();
        let plan = resampling(scatter, 2 * rows, seed)?;
        let samples = plan.as_ref().map_or(&[][..], |plan| plan.samples());
        let columns = self.columns(!samples.is_empty());
        let answers = Answers { systems, participation, stripes, sites, samples };
        let values = answers.all(&columns)?;
        let asked: Vec<(&SiteQuestions<'_>, Event)> =
            sites.iter().flat_map(|site| site.asked.iter().map(move |(event, _)| (site, *event))).collect();
        let finding = |(place, (site, event)): (usize, &(&SiteQuestions<'_>, Event))| {
            let column = |column: usize| -> Vec<f64> { values[column].iter().map(|of_cell| of_cell[place]).collect() };
            let mut factors: Vec<(String, usize)> =
                self.groups.iter().enumerate().map(|(group, name)| (name.clone(), 4 + group)).collect();
            let after = 4 + self.groups.len();
            if !site.hazard.branches.is_empty() {
                factors.push(("hazard".to_owned(), after));
            }
            if !samples.is_empty() {
                let drawn = if scatter.earthquakes.is_some() { "records, by earthquake" } else { "records" };
                factors.push((drawn.to_owned(), after + 1));
            }
            let (a, b) = (column(2), column(3));
            let mixed: Vec<Vec<f64>> = factors.iter().map(|(_, place)| column(*place)).collect();
            let indices = sobol_indices(&a, &b, &mixed, (REPLICATES, seed))?;
            let no_shares = indices.is_none().then(|| no_shares(*event, (&a, &b), &mixed));
            Ok(UncertainFinding::Epistemic(EpistemicResult {
                by_structure: Spread::from_values([column(0), column(1)].concat()),
                by_all: Spread::from_values([a, b].concat()),
                shares: ranked(&factors, indices.as_deref().unwrap_or_default()),
                no_shares,
            }))
        };
        asked.iter().enumerate().map(finding).collect()
    }

    /// What is computed, `[column][row]`: both samples with all records and the mean hazard; both with their own; the
    /// first with each group, with the hazard and with the records of the second.
    fn columns(&self, is_resampled: bool) -> Vec<Vec<Cell>> {
        let rows = 0..self.hazard[0].len();
        let drawn = |row: usize, sample: usize| is_resampled.then_some(row + sample * self.hazard[0].len());
        let column = |of: &dyn Fn(usize) -> Cell| rows.clone().map(of).collect::<Vec<Cell>>();
        let own = |systems: usize, hazard: usize, sample: usize| {
            column(&|row| Cell {
                system: self.systems[systems][row],
                hazard: Some(self.hazard[hazard][row]),
                sample: drawn(row, sample),
            })
        };
        let alone =
            |systems: usize| column(&|row| Cell { system: self.systems[systems][row], hazard: None, sample: None });
        let groups = (2..self.systems.len()).map(|group| own(group, 0, 0));
        let before = [alone(0), alone(1), own(0, 0, 0), own(1, 1, 1)];
        before.into_iter().chain(groups).chain([own(0, 1, 0), own(0, 0, 1)]).collect()
    }
}

struct Answers<'a> {
    systems: &'a [System],
    participation: f64,
    stripes: &'a Stripes,
    sites: &'a [SiteQuestions<'a>],
    samples: &'a [RecordSample],
}

impl Answers<'_> {
    /// The answers of all cells, `[column][row][site, asked]`. Each system is sorted once, and the answers do not
    /// depend on the order in which they are computed.
    fn all(&self, columns: &[Vec<Cell>]) -> Result<Vec<Vec<Vec<f64>>>, DesignError> {
        let systems = self.systems.len();
        let mut of_system: Vec<Vec<(usize, usize)>> = vec![Vec::new(); systems];
        for (column, cells) in columns.iter().enumerate() {
            for (row, cell) in cells.iter().enumerate() {
                of_system[cell.system].push((column, row));
            }
        }
        let answer = |system: usize| -> Result<Vec<Vec<f64>>, DesignError> {
            let demand = pooled_demand(self.stripes, system)?;
            of_system[system].iter().map(|&(column, row)| self.cell(&demand, columns[column][row])).collect()
        };
        let found = (0..systems).into_par_iter().map(answer).collect::<Result<Vec<_>, _>>()?;
        let mut values: Vec<Vec<Vec<f64>>> = columns.iter().map(|cells| vec![Vec::new(); cells.len()]).collect();
        for (places, found) in of_system.iter().zip(found) {
            for (&(column, row), found) in places.iter().zip(found) {
                values[column][row] = found;
            }
        }
        Ok(values)
    }

    /// The answers of one cell, `[site, asked]`.
    fn cell(&self, demand: &PooledDemand, cell: Cell) -> Result<Vec<f64>, DesignError> {
        let mut answers = Vec::new();
        for site in self.sites {
            let weights = cell.hazard.map_or(site.hazard.mean, |number| site.hazard.at(number));
            let curve = match cell.sample {
                Some(sample) => RiskCurve::resampled(demand, weights, &self.samples[sample])?,
                None => RiskCurve::new(demand, weights)?,
            };
            for (event, _) in &site.asked {
                answers.push(match (event, event.threshold_m(&self.systems[cell.system])) {
                    (Event::Demand(target_per_year), _) => {
                        self.participation * curve.exact_ordinate(*target_per_year)?.displacement_m
                    }
                    (_, Some(threshold_m)) => curve.mean_annual_frequency(threshold_m)?,
                    // what has no capacity does not exceed it
                    (_, None) => 0.0,
                });
            }
        }
        Ok(answers)
    }
}

/// Draws of the records, one a row of both samples: earthquakes with all their records where they are known, else
/// pairs; none of a single one.
fn resampling(scatter: &Scatter, rows: usize, seed: u64) -> Result<Option<ResamplingPlan>, DesignError> {
    let units = scatter.coarsest();
    let records = units.iter().map(Vec::len).sum();
    let mut unit_of = vec![0; records];
    for (unit, of_unit) in units.iter().enumerate() {
        for &record in of_unit {
            unit_of[record] = unit;
        }
    }
    let size = u32::try_from(records).unwrap_or(u32::MAX);
    match ResamplingPlan::draw_events(&unit_of, &[size], rows, seed) {
        Err(BootstrapError::OneEvent) => Ok(None),
        plan => Ok(Some(plan?)),
    }
}

/// The factors with their shares, the largest total first.
fn ranked(factors: &[(String, usize)], indices: &[SobolIndices]) -> Vec<VarianceShare> {
    let share = |((factor, _), of): (&(String, usize), &SobolIndices)| VarianceShare {
        factor: factor.clone(),
        first_order: of.first_order.value,
        first_order_error: of.first_order.standard_error,
        total: of.total.value,
        total_error: of.total.standard_error,
    };
    let mut shares: Vec<VarianceShare> = factors.iter().zip(indices).map(share).collect();
    shares.sort_by(|a, b| b.total.total_cmp(&a.total));
    shares
}

/// Why a variance is not shared out.
fn no_shares(event: Event, (a, b): (&[f64], &[f64]), mixed: &[Vec<f64>]) -> String {
    let all = || a.iter().chain(b).chain(mixed.iter().flatten());
    let infinite = all().filter(|value| value.is_infinite()).count();
    match event {
        Event::Demand(_) if infinite > 0 => format!(
            "in {infinite} of {} samples the structure overturns more often than the target rate, and has no demand: \
             its variance is not finite",
            all().count()
        ),
        _ if all().all(|value| *value == 0.0) => "no run shows it".to_owned(),
        _ => "it does not vary".to_owned(),
    }
}
