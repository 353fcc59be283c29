//! The columns of a structure under their deck, ready to be shaken.

use uplift_frame::{FrameError, RockingFrame};
use uplift_structure::{Kind, Reference};

use super::Structure;

impl Structure {
    /// The columns with flat ends, the deck that they carry, and what holds them (Section 6.2); none for a structure
    /// without such columns.
    ///
    /// # Errors
    /// Masses or a slenderness that no frame has.
    pub fn rocking_frame(&self) -> Option<Result<RockingFrame, FrameError>> {
        let of = &self.description;
        let (column_kg, deck_kg) = match of.kind {
            Kind::Block if of.displacement_of != Some(Reference::Centre) => (of.mass_kg?, 0.0),
            Kind::Frame | Kind::RestrainedFrame => (of.column_mass_kg?, of.deck_mass_kg?),
            _ => return None,
        };
        let columns = self.columns.as_ref()?;
        let shape = self.column_shape;
        let gravity_m_s2 = self.system.conditions().gravity_m_s2();
        let free = RockingFrame::new(*columns.geometry(), columns.columns(), column_kg, deck_kg, shape, gravity_m_s2);
        Some(free.and_then(|free| match columns.restrainer() {
            Some(restrainer) => {
                free.with_restrainer(restrainer.clone(), columns.path())?.with_restrained(columns.restrained())
            }
            None => Ok(free),
        }))
    }
}
