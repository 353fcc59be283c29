//! How many bands hold what they are bands of, with the standard error of the share.

use std::collections::BTreeMap;

/// A cell: measure, site, probability, strength, by their positions.
pub type Cell = [usize; 4];

/// A cell of fewer bands is not looked at by itself.
const FEWEST: u32 = 30;

/// Bands that hold the truth, lie below it (the unsafe side) and above it.
#[derive(Debug, Default, Clone, Copy)]
struct Counts([u32; 3]);

impl Counts {
    fn see(&mut self, [lower_m, upper_m]: [f64; 2], truth_m: f64) {
        let which = if truth_m > upper_m { 1 } else { 2 * usize::from(truth_m < lower_m) };
        self.0[which] += 1;
    }

    fn add(&mut self, other: Self) {
        self.0.iter_mut().zip(other.0).for_each(|(own, other)| *own += other);
    }

    fn all(self) -> u32 {
        self.0.iter().sum()
    }

    fn share(self, which: usize) -> f64 {
        f64::from(self.0[which]) / f64::from(self.all())
    }
}

/// The bands of one kind and size, of many drawn sets. The cells of a set belong together, sets are independent.
#[derive(Debug, Default, Clone)]
pub struct Tally {
    by_set: BTreeMap<usize, Counts>,
    by_cell: BTreeMap<Cell, Counts>,
    refused: u32,
}

impl Tally {
    /// The band of a drawn set.
    pub fn see(&mut self, (set, cell): (usize, Cell), limits_m: [f64; 2], truth_m: f64) {
        let mut own = Counts::default();
        own.see(limits_m, truth_m);
        self.by_set.entry(set).or_default().add(own);
        self.by_cell.entry(cell).or_default().add(own);
    }

    /// A drawn set without a band.
    pub fn refuse(&mut self) {
        self.refused += 1;
    }

    /// Those of other cells or sets besides.
    pub fn join(&mut self, other: Self) {
        other.by_set.into_iter().for_each(|(set, own)| self.by_set.entry(set).or_default().add(own));
        other.by_cell.into_iter().for_each(|(cell, own)| self.by_cell.entry(cell).or_default().add(own));
        self.refused += other.refused;
    }

    /// Per cent of the bands that hold the truth with its standard error, lie below and above it; the sets that had no
    /// band; cells of `rare` probabilities of which fewer than 82 % are held, and how many there are.
    pub fn line(&self, rare: &[usize]) -> String {
        let all = self.by_set.values().fold(Counts::default(), |mut all, own| {
            all.add(*own);
            all
        });
        let of_sets: Vec<f64> = self.by_set.values().map(|own| own.share(0)).collect();
        let n = of_sets.len() as f64;
        let mean = of_sets.iter().sum::<f64>() / n;
        let variance = of_sets.iter().map(|own| (own - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let cells = self.rare_cells(rare);
        format!(
            "{:5.1} ± {:.1} {:7.1} {:7.1} {:8} {:6} of {}",
            100.0 * all.share(0),
            100.0 * (variance / n).sqrt(),
            100.0 * all.share(1),
            100.0 * all.share(2),
            self.refused,
            cells.iter().filter(|(_, held)| *held < 82.0).count(),
            cells.len()
        )
    }

    /// The cells of `rare` probabilities that are held least, with per cent and its standard error of so many bands.
    pub fn worst(&self, rare: &[usize], count: usize) -> Vec<(Cell, String)> {
        let mut cells = self.rare_cells(rare);
        cells.sort_by(|a, b| a.1.total_cmp(&b.1));
        cells.truncate(count);
        let with_error = |(cell, held): (Cell, f64)| {
            let bands = self.by_cell[&cell].all();
            let error = (held * (100.0 - held) / f64::from(bands)).sqrt();
            (cell, format!("{held:.0} ± {error:.0} % of {bands}"))
        };
        cells.into_iter().map(with_error).collect()
    }

    /// The cells of `rare` probabilities with bands enough, with per cent that are held.
    fn rare_cells(&self, rare: &[usize]) -> Vec<(Cell, f64)> {
        let is_seen = |(cell, own): &(&Cell, &Counts)| rare.contains(&cell[2]) && own.all() >= FEWEST;
        self.by_cell.iter().filter(is_seen).map(|(cell, own)| (*cell, 100.0 * own.share(0))).collect()
    }
}
