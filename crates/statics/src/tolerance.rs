//! What small things that nobody meant do to the displacement capacity (a loose nut, a duct without spacer, springs
//! that are softer than ordered, a tendon that is lost).

use crate::columns::RestrainedColumns;
use crate::error::{StaticsError, positive};
use crate::parts::{Parts, Spring};
use crate::path::TendonPath;
use crate::restrainer::Restrainer;

/// By how much springs may be stiffer or softer than their formula.
const STIFFNESS_SHARE: f64 = 0.05;

/// How large the imperfections are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Imperfections {
    /// Elongation that a loose nut lets pass, m.
    pub slack_m: f64,
    /// Prestress that is more than meant, N.
    pub prestress_n: f64,
    /// Distance by which a tendon moves in its duct, m.
    pub duct_gap_m: f64,
    /// Length of the tendon, m.
    pub tendon_length_m: f64,
}

/// Columns with one imperfection.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Tolerance {
    /// The imperfection, in words.
    pub imperfection: String,
    /// Displacement capacity, m; none where the force does not vanish.
    pub capacity_m: Option<f64>,
    /// The same over that without the imperfection, less 1; none where one of the two is none.
    pub change: Option<f64>,
}

impl RestrainedColumns {
    /// Displacement capacities with one imperfection each: springs 5 % stiffer and softer, slack, more prestress, a
    /// tendon that shifts in its duct, and one tendon less. Nothing without a restrainer.
    ///
    /// # Errors
    /// Slack and prestress must be finite and positive, gap and length go with the column.
    pub fn tolerances(&self, imperfections: &Imperfections) -> Result<Vec<Tolerance>, StaticsError> {
        let Some(restrainer) = self.restrainer() else { return Ok(Vec::new()) };
        let Imperfections { slack_m, prestress_n, duct_gap_m, tendon_length_m } = *imperfections;
        positive("slack_m", slack_m, "m")?;
        positive("prestress_n", prestress_n, "N")?;
        let parts = *restrainer.parts();
        let with = |parts: Parts| Ok::<_, StaticsError>(self.clone().with_law(Restrainer::new(parts)?));
        let scaled = |factor: f64| match parts.spring {
            Spring::Rigid => parts,
            Spring::Linear { stiffness_n_m } => {
                Parts { spring: Spring::Linear { stiffness_n_m: factor * stiffness_n_m }, ..parts }
            }
            Spring::Discs(stack) => Parts { spring: Spring::Discs(stack.scaled(factor)), ..parts },
        };
        let exact_m = self.capacity().map(|capacity| capacity.displacement_m);
        let tolerance = |imperfection: String, columns: &Self| {
            let capacity_m = columns.capacity().map(|capacity| capacity.displacement_m);
            let change = capacity_m.zip(exact_m).map(|(with_m, without_m)| with_m / without_m - 1.0);
            Tolerance { imperfection, capacity_m, change }
        };
        let mut found = Vec::new();
        if parts.spring != Spring::Rigid {
            for (sign, word) in [(1.0, "stiffer"), (-1.0, "softer")] {
                let imperfection = format!("springs {:.0} % {word}", 100.0 * STIFFNESS_SHARE);
                found.push(tolerance(imperfection, &with(scaled(1.0 + sign * STIFFNESS_SHARE))?));
            }
        }
        // prestress is what takes the slack up: without it the nut is loose
        let slack = with(Parts { slack_m: parts.slack_m + slack_m, prestress_n: 0.0, ..parts })?;
        found.push(tolerance(format!("a nut loosened by {:.1} mm", 1e3 * slack_m), &slack));
        // one that would press the springs flat is no slip of a wrench
        if let Ok(tight) = with(Parts { slack_m: 0.0, prestress_n: parts.prestress_n + prestress_n, ..parts }) {
            found.push(tolerance(format!("a prestress of {:.1} kN more", 1e-3 * prestress_n), &tight));
        }
        if self.path() == TendonPath::Column && duct_gap_m > 0.0 {
            let path = TendonPath::Shifted { duct_gap_m, tendon_length_m };
            let shifted = self.clone().with_restrainer(restrainer.clone(), path)?.with_restrained(self.restrained())?;
            found.push(tolerance(format!("a tendon that shifts by {:.1} mm in its duct", 1e3 * duct_gap_m), &shifted));
        }
        if matches!(self.path(), TendonPath::Shifted { .. }) {
            let held = self.clone().with_restrainer(restrainer.clone(), TendonPath::Column)?;
            let centred = held.with_restrained(self.restrained())?;
            found.push(tolerance("a spacer that holds the tendon in its axis".to_owned(), &centred));
        }
        let left = self.restrained() - 1;
        let lost = self.clone().with_restrained(left)?;
        found.push(tolerance(format!("one tendon lost, {left} of {} columns held", self.columns()), &lost));
        Ok(found)
    }
}
