//! What a structure file says, judged: the structure, or the mistakes of its description and its restrainer.

use std::path::Path;

use uplift_statics::{Parts, RestrainedColumns, Restrainer, StaticsError, TendonPath};
use uplift_structure::{Anchorage, Kind, Reference, StructureDescription, StructureError};

use super::restrainer::ReadRestrainer;
use super::{ColumnShape, Structure};
use crate::reading::{Finding, Origin, Table};
use crate::warning::Warning;

/// A mistake of the description, or of its restrainer.
#[derive(Debug, thiserror::Error)]
pub(super) enum Mistake {
    #[error(transparent)]
    Structure(StructureError),
    #[error(transparent)]
    Restrainer(StaticsError),
}

impl Mistake {
    /// The mistake with its place; none where its cause is among those `found`.
    pub(super) fn finding(&self, document: &Table, found: &[Finding]) -> Option<Finding> {
        let table = |of: &Table, key: &str| of.get(key).and_then(|entry| entry.node.table()).cloned();
        let restrainer = || table(document, "restrainer");
        let (keys, places) = match self {
            Self::Structure(mistake) => (mistake.keys(), vec![(String::new(), document.clone())]),
            Self::Restrainer(mistake) => {
                let stopper = restrainer().and_then(|within| table(&within, "stopper"));
                let mut places = Vec::new();
                // a key of the stopper may have the name of one of the restrainer: then it is the stopper's gap or rods
                places.extend(stopper.map(|within| ("restrainer.stopper.".to_owned(), within)));
                places.extend(restrainer().map(|within| ("restrainer.".to_owned(), within)));
                places.push((String::new(), document.clone()));
                (mistake.keys(), places)
            }
        };
        let told = |key: &&str| {
            places.iter().any(|(path, _)| found.iter().any(|finding| finding.key == format!("{path}{key}")))
        };
        if keys.iter().any(told) {
            return None;
        }
        let place = keys.iter().find_map(|key| places.iter().find_map(|(_, within)| within.get(key)));
        let header = matches!(self, Self::Restrainer(_)).then(|| document.get("restrainer")).flatten();
        let origin = place
            .map(|entry| entry.node.origin.clone())
            .or(header.map(|entry| entry.key_origin.clone()))
            .unwrap_or(Origin::Study);
        Some(Finding { key: String::new(), origin, message: self.to_string(), help: None })
    }
}

/// Everything that a file says, before it is judged.
pub(super) struct ReadStructure {
    pub(super) description: StructureDescription,
    pub(super) restrainer: Option<ReadRestrainer>,
    pub(super) column_shape: ColumnShape,
    pub(super) f_cd_pa: Option<f64>,
    pub(super) rest_amplitude_rad: Option<f64>,
    pub(super) wobbling_restitution: Option<f64>,
}

impl ReadStructure {
    pub(super) fn resolve(mut self, file: &Path) -> Result<Structure, Vec<Mistake>> {
        let mut mistakes = Vec::new();
        let held = self.restrainer.as_ref().and_then(|restrainer| restrainer.description).map(|of| of.resolve());
        let held = match held.transpose() {
            Ok(held) => held.flatten(),
            Err(found) => {
                mistakes.extend(found.into_iter().map(Mistake::Restrainer));
                None
            }
        };
        let mut columns = None;
        if self.restrainer.is_some() {
            // a stiffness that passes until the law has one
            self.description.tendon_stiffness_n_m = Some(0.0);
            self.description.tendon_anchorage = Some(match held.as_ref().map(|(_, path)| path) {
                Some(TendonPath::Foundation) => Anchorage::Foundation,
                _ => Anchorage::Column,
            });
            match held.and_then(|held| self.restrained(held)).transpose() {
                Ok(Some((held, stiffness_n_m))) => {
                    columns = Some(held);
                    self.description.tendon_stiffness_n_m = Some(stiffness_n_m);
                }
                Ok(None) => {}
                Err(mistake) => mistakes.push(Mistake::Restrainer(mistake)),
            }
        }
        let system = self.description.resolve();
        let block = self.description.rotating_block();
        let (system, block) = match (system, block) {
            (Ok(system), Ok(block)) if mistakes.is_empty() => (system, block),
            (system, block) => {
                let found = system.err().or(block.err().map(|mistake| vec![mistake]));
                mistakes.extend(found.into_iter().flatten().map(Mistake::Structure));
                return Err(mistakes);
            }
        };
        let columns = match columns {
            None => self.linearly_restrained().map_err(|mistake| vec![Mistake::Restrainer(mistake)])?,
            columns => columns,
        };
        Ok(Structure {
            file: file.to_owned(),
            text: String::new(),
            warnings: self.description.unlikely().iter().map(Warning::unlikely).collect(),
            description: self.description,
            system,
            block,
            columns,
            column_shape: self.column_shape,
            f_cd_pa: self.f_cd_pa,
            rest_amplitude_rad: self.rest_amplitude_rad,
            wobbling_restitution: self.wobbling_restitution,
            uncertainty: None,
        })
    }

    /// The columns with their restrainer, and the stiffness of the equivalent linear one; none where the columns
    /// themselves are not yet right.
    fn restrained(
        &self,
        (restrainer, path): (Restrainer, TendonPath),
    ) -> Option<Result<(RestrainedColumns, f64), StaticsError>> {
        let free = self.free_columns()?;
        let held = free.and_then(|free| free.with_restrainer(restrainer, path));
        Some(held.and_then(|held| {
            let stiffness_n_m = held.equivalent_stiffness_n_m()?;
            Ok((held, stiffness_n_m))
        }))
    }

    /// Columns of a free frame, of one with a linear restrainer, or the one column that a block is; none for what has
    /// no columns.
    fn linearly_restrained(&self) -> Result<Option<RestrainedColumns>, StaticsError> {
        let Some(free) = self.free_columns().transpose()? else { return Ok(None) };
        match (self.description.tendon_stiffness_n_m, self.description.tendon_anchorage) {
            (Some(stiffness_n_m), Some(anchorage)) => {
                let path = match anchorage {
                    Anchorage::Foundation => TendonPath::Foundation,
                    Anchorage::Column => TendonPath::Column,
                };
                free.with_restrainer(Restrainer::new(Parts::linear(stiffness_n_m))?, path).map(Some)
            }
            _ => Ok(Some(free)),
        }
    }

    /// The columns without restrainers: `P` is the share of the deck's weight. A block is one column that carries
    /// nothing. None for another structure, and where a number is missing.
    fn free_columns(&self) -> Option<Result<RestrainedColumns, StaticsError>> {
        let of = &self.description;
        let gravity_m_s2 = of.gravity_m_s2.unwrap_or(uplift_oscillator::STANDARD_GRAVITY_M_S2);
        let geometry = of.geometry().ok()?;
        let (columns, deck_kg, column_kg) = match of.kind {
            Kind::Block if of.displacement_of != Some(Reference::Centre) => (1, 0.0, of.mass_kg?),
            Kind::Frame | Kind::RestrainedFrame => {
                (of.columns.filter(|&columns| columns > 0)?, of.deck_mass_kg?, of.column_mass_kg?)
            }
            _ => return None,
        };
        let top_load_n = deck_kg * gravity_m_s2 / f64::from(columns);
        Some(RestrainedColumns::new(geometry, columns, top_load_n, column_kg * gravity_m_s2))
    }
}
