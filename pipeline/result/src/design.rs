//! The design example of a result of displacement spectra, as tables and figures show it.

use serde::{Serialize, Serializer};
use uplift_job::Array;
use uplift_job::text::finite;
use uplift_spectra::{Noisy, RestrainedExample, SolitaryExample};
use uplift_structure::Rule;
use uplift_study::Kind;

use super::declared::{Group, Names, Quantity, group};
use super::file::ResultFile;
use super::layout::attribute::{Attribute, design as attribute};
use super::layout::axis::{BOUND, RECORD_SET, RULE, SCALED_BY, SCALING};
use super::layout::names::named;
use crate::error::ResultError;

/// The rules that a restrained bridge is designed by, in the order of the results.
pub const RULES: [Rule; 2] = [Rule::EqualDisplacement, Rule::EqualEnergy];

/// What a value and its range are called, in their order.
pub const BOUNDS: [&str; 3] = ["value", "lowest", "highest"];

/// A value and its range, in that order.
pub fn bounds(noisy: Noisy) -> [f64; 3] {
    [noisy.value, noisy.lowest, noisy.highest]
}

group! {
    /// The design of a restrained bridge, a row each; of [`VALUES`], or of what [`ROUNDING`] does to them.
    pub const RESTRAINED_DESIGN: RestrainedExample = "/design";
    "u_dem_zs_m<rounding>" [RECORD_SET, SCALING, SCALED_BY, RULE, BOUND] Made "m"
        "demand on the zero-stiffness system<rounded>" ("oscillators: demand on the zero-stiffness system")
        = |of, at| bounds(of.zero_stiffness_m)[at];
    "u_cap_m<rounding>" [RECORD_SET, SCALING, SCALED_BY, RULE, BOUND] Made "m" "designed capacity (Eq. 3.15)<rounded>"
        as "u_cap_m"
        = |of, at| bounds(of.capacity_m)[at];
    "u_dem_th_m<rounding>" [RECORD_SET, SCALING, SCALED_BY, RULE, BOUND] Made "m"
        "demand on the designed system by time histories<rounded>" as "u_dem_TH_m"
        = |of, at| bounds(of.time_history_m)[at];
    "u_dem_rule_m<rounding>" [RECORD_SET, SCALING, SCALED_BY, RULE, BOUND] Made "m"
        "demand on the designed system by the rule<rounded>" as "u_dem_rule_m"
        = |of, at| bounds(of.rule_m)[at];
    "error<rounding>" [RECORD_SET, SCALING, SCALED_BY, RULE, BOUND] Made "1"
        "(rule - time histories)/time histories<rounded>" as "error_pct"
        = |of, at| bounds(of.error)[at];
}

group! {
    /// The same of a block.
    pub const SOLITARY_DESIGN: SolitaryExample = RESTRAINED_DESIGN.path;
    "tan_alpha<rounding>" [RECORD_SET, SCALING, SCALED_BY, BOUND] Made "1" "design slenderness tan(alpha_D)<rounded>"
        ("blocks: design slenderness; NaN where the capacity line meets no demand")
        as "tan_alpha_design"
        = |of, at| bounds(of.design_tangent)[at];
    "u_endless_m<rounding>" [RECORD_SET, SCALING, SCALED_BY, BOUND] Made "m"
        "displacement of the endless block there<rounded>" as "<endless>"
        = |of, at| bounds(of.endless_m)[at];
    "u_block_m<rounding>" [RECORD_SET, SCALING, SCALED_BY, BOUND] Made "m"
        "displacement of the block itself there<rounded>" as "<block>"
        = |of, at| bounds(of.block_m)[at];
    "error<rounding>" [RECORD_SET, SCALING, SCALED_BY, BOUND] Made "1" "(endless - block)/block<rounded>"
        as "error_pct"
        = |of, at| bounds(of.error)[at];
}

group! {
    /// Capacities of the designed blocks.
    pub const SOLITARY_CAPACITY: SolitaryExample = RESTRAINED_DESIGN.path;
    "capacity_m" [RECORD_SET, SCALING, SCALED_BY] Made "m" "width 2b of the designed block, its capacity"
        = |of, _at| of.capacity_m;
}

/// Names of the arrays of designs that hold values with their range over the sweep.
pub const VALUES: [(&str, &str); 2] = [("<rounding>", ""), ("<rounded>", "")];
/// Names of those that hold the same values with their range over scale factors that differ by rounding; absent in
/// earlier results.
pub const ROUNDING: [(&str, &str); 2] =
    [("<rounding>", "_rounding"), ("<rounded>", ", with scale factors some 1e-15 smaller and larger")];

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
    /// The value, and its range over scale factors that differ by rounding; none in older results.
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

/// A quantity of the table over `[set, scaling, scaled_by, rule, bound]`.
struct DesignColumn {
    quantity: String,
    /// What the stored values are multiplied by.
    factor: f64,
    values: Array<5>,
    /// None in older results.
    rounding: Option<Array<5>>,
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
        if !self.reader.exists(RESTRAINED_DESIGN.path) {
            return Ok(None);
        }
        let number = |attribute: &Attribute<f64>| attribute.read(&self.reader, &[]);
        let designed = if RESTRAINED_DESIGN.is_in(self, &VALUES) {
            StoredDesigned::Bridge
        } else {
            StoredDesigned::Block {
                height_m: number(&attribute::HEIGHT_M)?,
                endless_height_m: number(&attribute::ENDLESS_HEIGHT_M)?,
            }
        };
        Ok(Some(StoredDesign {
            safety_factor: number(&attribute::SAFETY_FACTOR)?,
            percentile: number(&attribute::PERCENTILE)?,
            noise_relative: number(&attribute::NOISE_RELATIVE)?,
            noise_points: attribute::NOISE_POINTS.read(&self.reader, &[])?,
            designed,
            rows: self.design_rows(designed)?,
        }))
    }

    /// The quantities that the design table of `group` has, with `heights` in their names.
    fn design_columns<T: 'static>(
        &self,
        group: &Group<T>,
        heights: Names<'_>,
        lengths: [(&str, usize); 5],
    ) -> Result<Vec<DesignColumn>, ResultError> {
        let read = |name: &str, names: Names<'_>| {
            let values = group.read_floats(name, self, names, &lengths)?;
            Array::new(lengths.map(|(_, length)| length), values).map_err(|error| self.damaged(error))
        };
        let is_rounded = group.is_in(self, &ROUNDING);
        let column = |stored: &Quantity<T>| {
            let quantity = named(stored.exported_name(), heights).into_owned();
            Ok(DesignColumn {
                factor: if quantity.ends_with("_pct") { 100.0 } else { 1.0 },
                quantity,
                values: read(stored.name, &VALUES)?,
                rounding: is_rounded.then(|| read(stored.name, &ROUNDING)).transpose()?,
            })
        };
        group.exported().map(column).collect()
    }

    fn design_rows(&self, designed: StoredDesigned) -> Result<Vec<DesignRow>, ResultError> {
        let [sets, to, by] = [RECORD_SET, SCALING, SCALED_BY].map(|axis| self.reader.axis::<String>(axis.name));
        let (sets, to, by) = (sets?, to?, by?);
        let rules = match designed {
            StoredDesigned::Bridge => RULES.map(|rule| Some(rule_names(rule)[1])).to_vec(),
            StoredDesigned::Block { .. } => vec![None],
        };
        let ways = [(RECORD_SET.name, sets.len()), (SCALING.name, to.len()), (SCALED_BY.name, by.len())];
        let lengths = [ways[0], ways[1], ways[2], (RULE.name, rules.len()), (BOUND.name, BOUNDS.len())];
        let columns = match designed {
            StoredDesigned::Bridge => self.design_columns(&RESTRAINED_DESIGN, &[], lengths)?,
            StoredDesigned::Block { height_m, endless_height_m } => {
                let [endless, block] = [endless_height_m, height_m].map(StoredDesigned::block_quantity);
                self.design_columns(&SOLITARY_DESIGN, &[("<endless>", &endless), ("<block>", &block)], lengths)?
            }
        };
        let mut rows = Vec::new();
        for (set, record_set) in sets.iter().enumerate() {
            for (position, &rule) in rules.iter().enumerate() {
                for DesignColumn { quantity, factor, values, rounding } in &columns {
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
