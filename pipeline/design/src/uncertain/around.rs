//! The structures that one may be while a search varies it: what scatters is to the varied structure as it is to the
//! one that the file describes.

use uplift_ida::System;
use uplift_structure::EquivalentSystem;
use uplift_study::{Structure, Uncertainty, UncertaintyKind};

use super::{branches, draws, realized};
use crate::error::DesignError;

/// Structures around every value of a search. They are drawn once: two values differ by the value alone.
#[derive(Debug)]
pub(crate) struct Around<'a> {
    structure: &'a Structure,
    pub(crate) of: &'a Uncertainty,
    restitution: f64,
    /// Points of the unit cube: one a branch; or those of each record, one record after the other.
    points: Vec<Vec<f64>>,
    /// Structures that shake under a record.
    pub(crate) per_record: usize,
}

impl<'a> Around<'a> {
    /// Around `structure`, whose impacts keep `restitution` of the velocity where that is known, under so many records;
    /// none where its file says that all is known.
    pub(crate) fn from_structure(
        structure: &'a Structure,
        restitution: f64,
        records: usize,
    ) -> Result<Option<Self>, DesignError> {
        let Some(of) = &structure.uncertainty else { return Ok(None) };
        let points = match of.kind {
            // structures that are all alike are one, with the very bits of the structure as described
            _ if of.is_known() => vec![vec![0.5; of.quantities.len()]],
            UncertaintyKind::Epistemic => branches::samples(of)?.concat(),
            UncertaintyKind::Aleatory => draws::points(of, records, &structure.file)?,
        };
        let around = Self { structure, of, restitution, per_record: points.len(), points };
        let per_record = if around.is_of_each_record() { around.per_record / records } else { around.per_record };
        Ok(Some(Self { per_record, ..around }))
    }

    /// Whether each record shakes structures of its own.
    pub(crate) fn is_of_each_record(&self) -> bool {
        self.of.kind == UncertaintyKind::Aleatory && !self.of.is_known()
    }

    /// The oscillators of `varied`: one a branch; or those of each record, one record after the other.
    pub(crate) fn systems(&self, varied: &EquivalentSystem) -> Result<Vec<System>, DesignError> {
        let system = |point: &Vec<f64>| realized((self.structure, varied), self.of, self.restitution, point);
        self.points.iter().map(system).collect()
    }

    /// The number between 0 and 1 that chooses the hazard curve which goes with a branch; none where structures are not
    /// branches.
    pub(crate) fn hazard_number(&self, branch: usize) -> Option<f64> {
        self.points[branch].get(self.of.quantities.len()).copied()
    }
}
