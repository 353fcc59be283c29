//! A structure with one of its quantities changed, columns and restrainers with it.

use uplift_structure::Quantity;

use super::Structure;
use super::resolve::{Mistake, ReadStructure};

impl Structure {
    /// The structure with `quantity` at `value`, in its unit, all else kept: other columns have the restrainer of the
    /// file, tendons of another stiffness are linear. None of strength and capacity, which no columns have by
    /// themselves.
    ///
    /// # Errors
    /// Why there is no such structure, in words.
    pub fn varied(&self, quantity: Quantity, value: f64) -> Result<Option<Self>, String> {
        let words = |mistakes: Vec<Mistake>| mistakes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
        let of_structure = |mistakes: Vec<_>| words(mistakes.into_iter().map(Mistake::Structure).collect());
        let Some(description) = quantity.described(&self.description, value).map_err(of_structure)? else {
            return Ok(None);
        };
        let read = ReadStructure {
            description,
            restrainer: None,
            column_shape: self.column_shape,
            f_cd_pa: self.f_cd_pa,
            rest_amplitude_rad: self.rest_amplitude_rad,
            wobbling_restitution: self.wobbling_restitution,
        };
        let mut varied = read.resolve(&self.file).map_err(words)?;
        if let (Some(own), Some(other)) = (self.columns.clone(), &varied.columns)
            && quantity != Quantity::TendonStiffness
        {
            varied.columns = Some(own.with_geometry(*other.geometry()).map_err(|mistake| mistake.to_string())?);
        }
        Ok(Some(Self { text: self.text.clone(), ..varied }))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn structure(width_m: f64, more: &str) -> Structure {
        let text = format!(
            "kind = \"restrained-frame\"\ncolumns = 4\nwidth_m = {width_m}\nheight_m = 5\ncolumn_mass_kg = 2000\n\
             deck_mass_kg = 60000\ncolumn_shape = \"cylinder\"\n{more}"
        );
        Structure::parse(Path::new("footbridge.toml"), text).unwrap()
    }

    const LINEAR: &str = "tendon_stiffness_n_m = 1e6\ntendon_anchorage = \"column\"\n";
    const TABLE: &str = "[restrainer]\nkind = \"tendon\"\ntendon_area_m2 = 300e-6\ntendon_length_m = 5.8\n\
                         tendon_yield_n = 477e3\nanchorage = \"column\"\n";

    #[test]
    fn a_width_is_that_of_another_file() {
        for more in [LINEAR, TABLE] {
            let varied = structure(0.45, more).varied(Quantity::Width, 0.6).unwrap().unwrap();
            let written = structure(0.6, more);
            assert_eq!(varied.columns, written.columns, "{more}");
            let frame = |of: &Structure| of.rocking_frame().unwrap().unwrap();
            assert_eq!(frame(&varied), frame(&written), "{more}");
        }
        assert_eq!(
            structure(0.45, LINEAR).varied(Quantity::Width, 0.6).unwrap().unwrap().system,
            structure(0.6, LINEAR).system
        );
    }

    #[test]
    fn tendons_of_another_stiffness_are_linear() {
        let stiffer = structure(0.45, &LINEAR.replace("1e6", "2e6"));
        for more in [LINEAR, TABLE] {
            let varied = structure(0.45, more).varied(Quantity::TendonStiffness, 2e6).unwrap().unwrap();
            assert_eq!(varied.columns, stiffer.columns);
        }
        // no columns have another strength by itself, and none the width of nothing
        assert_eq!(stiffer.varied(Quantity::Strength, 0.2), Ok(None));
        assert!(stiffer.varied(Quantity::Width, -0.2).unwrap_err().contains("width_m"));
    }
}
