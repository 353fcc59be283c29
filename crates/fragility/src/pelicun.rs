//! A fragility table of pelicun 3: a row each system and measure, of the counted shares and of the lognormal fits.

use crate::function::without_fit;
use crate::{FragilityFunction, FragilityState};

/// The column by which a table of this kind is known.
pub const PELICUN_COLUMN: &str = "Demand-Type";

/// By how much the probabilities of a multilinear function rise from point to point at least: pelicun rounds them to
/// six digits, and refuses those that do not rise.
const RISE: f64 = 2e-6;
/// The capacities of records that exceed nothing lie beyond the last level; so many times that level, they change no
/// probability at a level by more than this part of it.
const BEYOND: f64 = 1e3;

/// A demand type of pelicun (`pelicun.base.EDP_TYPES`).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PelicunDemand {
    /// Its name in a fragility table.
    pub name: String,
    /// The same in the head of a sample of demands.
    pub acronym: String,
    /// Its unit.
    pub unit: &'static str,
}

/// The demand type that an intensity measure type of `OpenQuake` is, in the same unit; none where there is none.
pub fn pelicun_demand(imt: &str) -> Option<PelicunDemand> {
    let of = |name: String, acronym: String, unit| Some(PelicunDemand { name, acronym, unit });
    match imt {
        "PGV" => of("Peak Ground Velocity".to_owned(), imt.to_owned(), "cmps"),
        "PGA" => of("Peak Ground Acceleration".to_owned(), imt.to_owned(), "g"),
        _ => {
            let period = imt.strip_prefix("SA(")?.strip_suffix(')')?;
            of(format!("Spectral Acceleration|{period}"), format!("SA_{period}"), "g")
        }
    }
}

/// A component of pelicun.
struct Row {
    id: String,
    demand: PelicunDemand,
    incomplete: bool,
    /// Family and parameters of each limit state; none where it has no fit.
    states: Vec<Option<[String; 3]>>,
}

/// A column of a table: its name and its cells.
pub type TextColumn = (String, Vec<String>);

/// The columns of the table, and what they leave out. Demands are taken as they are for direction 1
/// (`Demand-Directional` is 1), so that pelicun does not multiply them. Functions of measures that it does not have are
/// left out.
pub fn pelicun_table(functions: &[FragilityFunction]) -> (Vec<TextColumn>, Vec<String>) {
    let (mut rows, mut notes) = (Vec::new(), Vec::new());
    for FragilityFunction { id, imt, levels, states } in functions {
        let Some(demand) = pelicun_demand(imt) else { continue };
        let counted = |state: &FragilityState| {
            Some(["multilinear_CDF".to_owned(), multilinear(levels, &state.shares), String::new()])
        };
        let fitted = |state: &FragilityState| {
            let fit = state.lognormal?;
            Some(["lognormal".to_owned(), fit.median().to_string(), fit.dispersion().to_string()])
        };
        rows.push(Row::new(id.clone(), &demand, states.iter().map(counted).collect()));
        rows.push(Row::new(format!("{id}_lognormal"), &demand, states.iter().map(fitted).collect()));
        let missing: Vec<&str> =
            states.iter().filter(|state| state.lognormal.is_none()).map(|state| &*state.name).collect();
        notes.extend(without_fit(id, &missing));
    }
    let of = |name: &str, cell: &dyn Fn(&Row) -> String| (name.to_owned(), rows.iter().map(cell).collect());
    let mut columns = vec![
        of("ID", &|row| row.id.clone()),
        of("Incomplete", &|row| u8::from(row.incomplete).to_string()),
        of(PELICUN_COLUMN, &|row| row.demand.name.clone()),
        of("Demand-Unit", &|row| row.demand.unit.to_owned()),
        of("Demand-Offset", &|_| "0".to_owned()),
        of("Demand-Directional", &|_| "1".to_owned()),
    ];
    let most = rows.iter().map(|row| row.states.len()).max().unwrap_or(0);
    for state in 0..most {
        for (place, part) in ["Family", "Theta_0", "Theta_1"].into_iter().enumerate() {
            let cell = |row: &Row| row.states.get(state).and_then(Option::as_ref).map(|own| own[place].clone());
            columns.push(of(&format!("LS{}-{part}", state + 1), &|row| cell(row).unwrap_or_default()));
        }
        columns.push(of(&format!("LS{}-DamageStateWeights", state + 1), &|_| String::new()));
    }
    (columns, notes)
}

impl Row {
    fn new(id: String, demand: &PelicunDemand, states: Vec<Option<[String; 3]>>) -> Self {
        Self { id, demand: demand.clone(), incomplete: states.iter().any(Option::is_none), states }
    }
}

/// The shares at the levels as a distribution function on straight lines, which rises from 0 at 0 to 1 beyond the
/// levels: "x1,x2,…|y1,y2,…". Where the shares fall from one level to a higher one, their mean stands at both.
fn multilinear(levels: &[f64], shares: &[f64]) -> String {
    let rising = rising(shares);
    let points = rising.len() as f64 + 1.0;
    let tilted = |(place, share): (usize, &f64)| share * (1.0 - RISE * points) + RISE * (place as f64 + 1.0);
    let x = std::iter::once(0.0).chain(levels.iter().copied()).chain(levels.last().map(|last| BEYOND * last));
    let y = std::iter::once(0.0).chain(rising.iter().enumerate().map(tilted)).chain([1.0]);
    let words =
        |values: &mut dyn Iterator<Item = f64>| values.map(|value| value.to_string()).collect::<Vec<_>>().join(",");
    format!("{}|{}", words(&mut { x }), words(&mut { y }))
}

/// The values that never fall and are nearest to these in their squares (pool-adjacent-violators; Barlow et al.,
/// Statistical Inference under Order Restrictions, 1972).
fn rising(values: &[f64]) -> Vec<f64> {
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for &value in values {
        let mut block = (value, 1);
        while let Some((mean, many)) = blocks.pop_if(|before| before.0 > block.0) {
            let all = many + block.1;
            block = ((mean * many as f64 + block.0 * block.1 as f64) / all as f64, all);
        }
        blocks.push(block);
    }
    blocks.into_iter().flat_map(|(mean, many)| std::iter::repeat_n(mean, many)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_are_demands_in_the_same_unit() {
        let of = |imt: &str| pelicun_demand(imt).map(|demand| (demand.name, demand.acronym, demand.unit));
        let found = |name: &str, acronym: &str, unit| Some((name.to_owned(), acronym.to_owned(), unit));
        assert_eq!(of("PGV"), found("Peak Ground Velocity", "PGV", "cmps"));
        assert_eq!(of("SA(1.0)"), found("Spectral Acceleration|1.0", "SA_1.0", "g"));
        assert_eq!((of("CAV"), of("PGD"), of("SA(1.0")), (None, None, None));
    }

    #[test]
    fn a_distribution_function_rises_from_0_to_1() {
        assert_eq!(rising(&[0.0, 0.5, 0.2, 0.2, 1.0]), [0.0, 0.3, 0.3, 0.3, 1.0]);
        let text = multilinear(&[1.0, 2.0, 4.0, 8.0], &[0.0, 0.5, 0.25, 0.75]);
        let (x, y) = text.split_once('|').unwrap();
        assert_eq!(x, "0,1,2,4,8,8000");
        let y: Vec<f64> = y.split(',').map(|value| value.parse().unwrap()).collect();
        assert_eq!((y[0], y[5]), (0.0, 1.0));
        assert!(y.windows(2).all(|two| two[1] - two[0] > 1.5e-6), "{y:?}");
        for (found, expected) in y.iter().zip([0.0, 0.0, 0.375, 0.375, 0.75, 1.0]) {
            assert!((found - expected).abs() < 2e-5, "{y:?}");
        }
        // all exceed it from the first level on
        let all = multilinear(&[1.0, 2.0], &[1.0, 1.0]);
        let y: Vec<f64> = all.split_once('|').unwrap().1.split(',').map(|value| value.parse().unwrap()).collect();
        assert!(y.windows(2).all(|two| two[1] - two[0] > 1.5e-6) && y[1] > 1.0 - 1e-5, "{y:?}");
    }
}
