//! The design example of a result of displacement spectra, as tables and figures show it.

use serde::{Serialize, Serializer};
use uplift_job::Array;
use uplift_job::text::finite;
use uplift_spectra::Noisy;
use uplift_structure::Rule;
use uplift_study::Kind;

use super::file::ResultFile;
use super::layout::{axis, design};
use crate::error::ResultError;

/// The rules that a restrained bridge is designed by, in the order of the results.
pub const RULES: [Rule; 2] = [Rule::EqualDisplacement, Rule::EqualEnergy];

/// What a value and its range are called, in their order.
pub const BOUNDS: [&str; 3] = ["value", "lowest", "highest"];

/// A value and its range, in that order.
pub fn bounds(noisy: Noisy) -> [f64; 3] {
    [noisy.value, noisy.lowest, noisy.highest]
}

/// The design example of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredDesign {
    /// Safety factor.
    pub safety_factor: f64,
    /// Percentile designed for.
    pub percentile: f64,
    /// How far the sweep around an abscissa reaches, relative to it.
    pub noise_relative: f64,
    /// Points of the sweep.
    pub noise_points: u64,
    /// What was designed.
    pub designed: StoredDesigned,
    /// Its values by set, then rule, quantity, scaling and whose peak.
    pub rows: Vec<DesignRow>,
}

/// What was designed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StoredDesigned {
    /// A restrained bridge.
    Bridge,
    /// A block, by the spectrum of an endless one.
    Block {
        /// Height 2H of the block \[m\].
        height_m: f64,
        /// Height 2H of the endless block \[m\].
        endless_height_m: f64,
    },
}

/// A value of a design table.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignRow {
    /// Name of the record set.
    pub record_set: String,
    /// What the motions are scaled to.
    pub scaling: String,
    /// Whose peak meets it.
    pub scaled_by: String,
    /// `ED` or `EE`; none for blocks.
    pub rule: Option<&'static str>,
    /// What it is, as the dissertation's tables in tests/reference call it.
    pub quantity: String,
    /// The value, and its range over the sweep.
    pub noisy: Noisy,
    /// The value, and its range over scale factors that differ by rounding; none in results of before.
    pub rounding: Option<Noisy>,
}

impl DesignRow {
    /// Whether rounding alone changes the value in the digits that are shown.
    pub fn hangs_on_rounding(&self) -> bool {
        self.rounding.is_some_and(|other| other.shows_otherwise(|value| self.shown(value)))
    }

    /// The value with its range, in words; marked where [rounding decides it](Self::hangs_on_rounding).
    pub fn ranged(&self) -> String {
        let Noisy { value, lowest, highest } = self.noisy;
        if value.is_nan() {
            return "none".to_owned();
        }
        let mark = if self.hangs_on_rounding() { "*" } else { "" };
        format!("{}{mark} [{}, {}]", self.shown(value), self.shown(lowest), self.shown(highest))
    }

    /// Where [rounding decides](Self::hangs_on_rounding): which value it is, and from where to where rounding moves it.
    pub fn rounding_words(&self) -> Option<String> {
        let Noisy { lowest, highest, .. } = self.rounding.filter(|_| self.hangs_on_rounding())?;
        let rule = self.rule.map_or_else(String::new, |rule| format!("{rule}, "));
        let Self { quantity, scaling, scaled_by, .. } = self;
        let [lowest, highest] = [lowest, highest].map(|end| self.shown(end));
        Some(format!("{rule}{quantity}, {scaling} by {scaled_by}: {lowest} to {highest}"))
    }

    /// A value of this quantity with as many digits as say something.
    pub fn shown(&self, value: f64) -> String {
        match value {
            f64::INFINITY => "overturns".to_owned(),
            value if self.quantity.ends_with("_pct") => format!("{value:.1}"),
            value if self.quantity.starts_with("tan") => format!("{value:.4}"),
            value => format!("{value:.3}"),
        }
    }
}

impl StoredDesigned {
    /// What the displacement of a block of the height 2H at the design slenderness is called.
    pub fn block_quantity(height_m: f64) -> String {
        format!("u_2H{height_m}_m")
    }
}

/// What a rule is called in the file, and in tables.
pub fn rule_names(rule: Rule) -> [&'static str; 2] {
    match rule {
        Rule::EqualDisplacement => ["equal displacement", "ED"],
        Rule::EqualEnergy => ["equal energy", "EE"],
    }
}

/// A quantity of a design table: its name, its array, and what the array is multiplied by.
type Quantity = (String, &'static str, f64);

impl Serialize for DesignRow {
    /// The value beside its range; null where it does not exist or is infinite.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut row = serializer.serialize_struct("DesignRow", 11)?;
        row.serialize_field("record_set", &self.record_set)?;
        row.serialize_field("scaling", &self.scaling)?;
        row.serialize_field("scaled_by", &self.scaled_by)?;
        row.serialize_field("rule", &self.rule)?;
        row.serialize_field("quantity", &self.quantity)?;
        row.serialize_field("value", &finite(self.noisy.value))?;
        row.serialize_field("lowest", &finite(self.noisy.lowest))?;
        row.serialize_field("highest", &finite(self.noisy.highest))?;
        row.serialize_field("rounding_lowest", &self.rounding.and_then(|rounding| finite(rounding.lowest)))?;
        row.serialize_field("rounding_highest", &self.rounding.and_then(|rounding| finite(rounding.highest)))?;
        row.serialize_field("hangs_on_rounding", &self.hangs_on_rounding())?;
        row.end()
    }
}

impl ResultFile {
    /// The design example of a result of displacement spectra; none where the study has none.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn design(&self) -> Result<Option<StoredDesign>, ResultError> {
        self.require(Kind::Displacement)?;
        if !self.reader.exists(design::GROUP) {
            return Ok(None);
        }
        let number = |name: &str| self.reader.attribute_f64(design::GROUP, name);
        let designed = if self.reader.exists(&design::array("u_cap_m")) {
            StoredDesigned::Bridge
        } else {
            StoredDesigned::Block { height_m: number("height_m")?, endless_height_m: number("endless_height_m")? }
        };
        Ok(Some(StoredDesign {
            safety_factor: number("safety_factor")?,
            percentile: number("percentile")?,
            noise_relative: number("noise_relative")?,
            noise_points: self.reader.attribute_u64(design::GROUP, "noise_points")?,
            designed,
            rows: self.design_rows(designed)?,
        }))
    }

    fn design_rows(&self, designed: StoredDesigned) -> Result<Vec<DesignRow>, ResultError> {
        let (sets, to) = (self.reader.axis_text(axis::RECORD_SET)?, self.reader.axis_text(axis::SCALING)?);
        let by = self.reader.axis_text(axis::SCALED_BY)?;
        let (rules, quantities): (Vec<Option<&'static str>>, [Quantity; 4]) = match designed {
            StoredDesigned::Bridge => (
                RULES.map(|rule| Some(rule_names(rule)[1])).to_vec(),
                [
                    ("u_cap_m".to_owned(), "u_cap_m", 1.0),
                    ("u_dem_TH_m".to_owned(), "u_dem_th_m", 1.0),
                    ("u_dem_rule_m".to_owned(), "u_dem_rule_m", 1.0),
                    ("error_pct".to_owned(), "error", 100.0),
                ],
            ),
            StoredDesigned::Block { height_m, endless_height_m } => (
                vec![None],
                [
                    ("tan_alpha_design".to_owned(), "tan_alpha", 1.0),
                    (StoredDesigned::block_quantity(endless_height_m), "u_endless_m", 1.0),
                    (StoredDesigned::block_quantity(height_m), "u_block_m", 1.0),
                    ("error_pct".to_owned(), "error", 100.0),
                ],
            ),
        };
        let mut axes = vec![(axis::RECORD_SET, sets.len()), (axis::SCALING, to.len()), (axis::SCALED_BY, by.len())];
        axes.extend((rules.len() > 1).then_some((axis::RULE, rules.len())));
        axes.push((axis::BOUND, BOUNDS.len()));
        let mut columns = Vec::new();
        let read = |path: &str| -> Result<Array<5>, ResultError> {
            let values = self.checked(path, self.reader.array_f64(path)?, &axes)?;
            // [set, scaling, scaled_by, rule, bound]
            Array::new([sets.len(), to.len(), by.len(), rules.len(), BOUNDS.len()], values)
                .map_err(|error| self.damaged(format!("{path}: {error}")))
        };
        for (quantity, name, factor) in quantities {
            let rounding = design::rounding(name);
            let rounding = if self.reader.exists(&rounding) { Some(read(&rounding)?) } else { None };
            columns.push((quantity, factor, read(&design::array(name))?, rounding));
        }
        let mut rows = Vec::new();
        for (set, record_set) in sets.iter().enumerate() {
            for (position, &rule) in rules.iter().enumerate() {
                for (quantity, factor, values, rounding) in &columns {
                    let noisy = |values: &Array<5>, place: [usize; 4]| {
                        let [value, lowest, highest] = [0, 1, 2].map(|bound| factor * values.block(place)[bound]);
                        Noisy { value, lowest, highest }
                    };
                    for (scaling, scaling_name) in to.iter().enumerate() {
                        for (scaled_by, scaled_by_name) in by.iter().enumerate() {
                            let place = [set, scaling, scaled_by, position];
                            rows.push(DesignRow {
                                record_set: record_set.clone(),
                                scaling: scaling_name.clone(),
                                scaled_by: scaled_by_name.clone(),
                                rule,
                                quantity: quantity.clone(),
                                noisy: noisy(values, place),
                                rounding: rounding.as_ref().map(|values| noisy(values, place)),
                            });
                        }
                    }
                }
            }
        }
        Ok(rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(value: f64, lowest: f64, highest: f64) -> DesignRow {
        DesignRow {
            record_set: String::new(),
            scaling: String::new(),
            scaled_by: String::new(),
            rule: None,
            quantity: "u_dem_TH_m".to_owned(),
            noisy: Noisy { value, lowest: 0.04, highest: 0.05 },
            rounding: Some(Noisy { value, lowest, highest }),
        }
    }

    #[test]
    fn a_value_is_marked_where_rounding_changes_its_digits() {
        assert_eq!(row(0.0444, 0.0436, 0.0444).ranged(), "0.044 [0.040, 0.050]");
        assert_eq!(row(0.0444, 0.0181, 0.0444).ranged(), "0.044* [0.040, 0.050]");
        assert_eq!(row(0.0444, 0.0444, f64::INFINITY).ranged(), "0.044* [0.040, 0.050]");
        assert_eq!(row(f64::NAN, f64::NAN, f64::NAN).ranged(), "none");
        assert_eq!(row(0.0444, 0.0436, 0.0444).rounding_words(), None);
        assert_eq!(row(0.0444, 0.0181, 0.0444).rounding_words().as_deref(), Some("u_dem_TH_m,  by : 0.018 to 0.044"));
        let earlier = DesignRow { rounding: None, ..row(0.0444, 0.0, 1.0) };
        assert_eq!(earlier.ranged(), "0.044 [0.040, 0.050]");
    }
}
