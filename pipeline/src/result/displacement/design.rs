//! The design examples in the result file, and the rows of the tables that are read back from there.

use uplift_spectra::{Noisy, RestrainedExample, SolitaryExample};
use uplift_structure::Rule;

use crate::error::UpliftError;
use crate::labelled::{LabelledError, LabelledReader, LabelledWriter};
use crate::stages::{Designs, RULES, strength};
use crate::study::{DesignPlan, Designed, DisplacementStudy, Structures};

/// What a value and its range are called, in their order.
const BOUNDS: [&str; 3] = ["value", "lowest", "highest"];

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
}

/// How a rule is called in the file, and in tables.
fn words(rule: Rule) -> [&'static str; 2] {
    match rule {
        Rule::EqualDisplacement => ["equal displacement", "ED"],
        Rule::EqualEnergy => ["equal energy", "EE"],
    }
}

pub(super) fn write(
    writer: &mut LabelledWriter,
    study: &DisplacementStudy,
    plan: &DesignPlan,
    designs: &Designs,
) -> Result<(), LabelledError> {
    writer.axis_text("bound", &BOUNDS.map(str::to_owned), "a value, and its range over a small sweep")?;
    match designs {
        Designs::Restrained(examples) => {
            writer.axis_text("rule", &RULES.map(|rule| words(rule)[0].to_owned()), "design rule")?;
            write_restrained(writer, examples)?;
        }
        Designs::Solitary(examples) => write_solitary(writer, examples)?,
    }
    let group = "/design";
    writer.attribute(group, "safety_factor", plan.safety_factor)?;
    writer.attribute(group, "percentile", plan.percentile)?;
    writer.attribute(group, "noise_relative", plan.noise_relative)?;
    writer.attribute(group, "noise_points", plan.noise_points as u64)?;
    match (plan.designed, &study.structures) {
        (Designed::Bridge { width_m, height_m }, Structures::Oscillators(family)) => {
            writer.attribute(group, "strength", strength(width_m, height_m))?;
            writer.attribute(group, "uplift_displacement_m", family.uplift_displacement_m[0])?;
            writer.attribute(group, "least_capacity_m", width_m)
        }
        (Designed::Block { height_m, endless_height_m }, _) => {
            writer.attribute(group, "height_m", height_m)?;
            writer.attribute(group, "endless_height_m", endless_height_m)
        }
        (Designed::Bridge { .. }, Structures::Blocks(_)) => Ok(()),
    }
}

fn bounds(noisy: Noisy) -> [f64; 3] {
    [noisy.value, noisy.lowest, noisy.highest]
}

/// Name of an array, what of an example it holds, unit and long name.
type ArrayOf<T> = (&'static str, fn(&T) -> Noisy, &'static str, &'static str);

fn write_restrained(writer: &mut LabelledWriter, examples: &[RestrainedExample]) -> Result<(), LabelledError> {
    let columns: [ArrayOf<RestrainedExample>; 5] = [
        ("u_dem_zs_m", |example| example.zero_stiffness_m, "m", "demand on the zero-stiffness system"),
        ("u_cap_m", |example| example.capacity_m, "m", "designed capacity (Eq. 3.15)"),
        ("u_dem_th_m", |example| example.time_history_m, "m", "demand on the designed system by time histories"),
        ("u_dem_rule_m", |example| example.rule_m, "m", "demand on the designed system by the rule"),
        ("error", |example| example.error, "1", "(rule - time histories)/time histories"),
    ];
    for (name, value, unit, long_name) in columns {
        let values: Vec<f64> = examples.iter().flat_map(|example| bounds(value(example))).collect();
        let dims = ["record_set", "scaling", "scaled_by", "rule", "bound"];
        writer.array_f64(&format!("/design/{name}"), &dims, &values, unit, long_name)?;
    }
    Ok(())
}

fn write_solitary(writer: &mut LabelledWriter, examples: &[Option<SolitaryExample>]) -> Result<(), LabelledError> {
    const NONE: Noisy = Noisy { value: f64::NAN, lowest: f64::NAN, highest: f64::NAN };
    let columns: [ArrayOf<SolitaryExample>; 4] = [
        ("tan_alpha", |example| example.design_tangent, "1", "design slenderness tan(alpha_D)"),
        ("u_endless_m", |example| example.endless_m, "m", "displacement of the endless block there"),
        ("u_block_m", |example| example.block_m, "m", "displacement of the block itself there"),
        ("error", |example| example.error, "1", "(endless - block)/block"),
    ];
    let dims = ["record_set", "scaling", "scaled_by", "bound"];
    for (name, value, unit, long_name) in columns {
        let noisy = |example: &Option<SolitaryExample>| bounds(example.as_ref().map_or(NONE, value));
        let values: Vec<f64> = examples.iter().flat_map(noisy).collect();
        writer.array_f64(&format!("/design/{name}"), &dims, &values, unit, long_name)?;
    }
    let width_m: Vec<f64> =
        examples.iter().map(|example| example.as_ref().map_or(f64::NAN, |example| example.capacity_m)).collect();
    writer.array_f64("/design/capacity_m", &dims[..3], &width_m, "m", "width 2b of the designed block, its capacity")
}

/// The design tables of a result, by set, then rule, quantity, scaling and whose peak; none without a design.
///
/// # Errors
/// A file that is damaged.
pub fn read_design(reader: &LabelledReader) -> Result<Vec<DesignRow>, UpliftError> {
    if !reader.exists("/design") {
        return Ok(Vec::new());
    }
    let table = Table::read(reader)?;
    let mut rows = Vec::new();
    let restrained = reader.exists("/design/u_cap_m");
    let tables: Vec<(Option<Rule>, Vec<Column>)> = if restrained {
        let columns = || -> Result<Vec<Column>, UpliftError> {
            [
                ("u_cap_m", "u_cap_m", 1.0),
                ("u_dem_TH_m", "u_dem_th_m", 1.0),
                ("u_dem_rule_m", "u_dem_rule_m", 1.0),
                ("error_pct", "error", 100.0),
            ]
            .into_iter()
            .map(|(quantity, name, factor)| table.column(reader, quantity.to_owned(), name, &|_| factor))
            .collect()
        };
        RULES.iter().map(|&rule| Ok((Some(rule), columns()?))).collect::<Result<_, UpliftError>>()?
    } else {
        let width_m = reader.array_f64("/design/capacity_m")?.values;
        let height = |name: &str| reader.attribute_f64("/design", name);
        let over_2b = |way: usize| 1.0 / width_m.get(way).copied().unwrap_or(f64::NAN);
        let columns = vec![
            table.column(reader, "tan_alpha_design".to_owned(), "tan_alpha", &|_| 1.0)?,
            table.column(reader, format!("u_over_2b_2H{}", height("endless_height_m")?), "u_endless_m", &over_2b)?,
            table.column(reader, format!("u_over_2b_2H{}", height("height_m")?), "u_block_m", &over_2b)?,
            table.column(reader, "error_pct".to_owned(), "error", &|_| 100.0)?,
        ];
        vec![(None, columns)]
    };
    for (set, record_set) in table.sets.iter().enumerate() {
        for (rule, (name, columns)) in tables.iter().enumerate() {
            for column in columns {
                for (to, scaling) in table.to.iter().enumerate() {
                    for (by, scaled_by) in table.by.iter().enumerate() {
                        let way = (set * table.to.len() + to) * table.by.len() + by;
                        rows.push(DesignRow {
                            record_set: record_set.clone(),
                            scaling: scaling.clone(),
                            scaled_by: scaled_by.clone(),
                            rule: name.map(|rule| words(rule)[1]),
                            quantity: column.quantity.clone(),
                            noisy: column.noisy[way * tables.len() + rule],
                        });
                    }
                }
            }
        }
    }
    Ok(rows)
}

/// The axes of the design arrays.
struct Table {
    sets: Vec<String>,
    to: Vec<String>,
    by: Vec<String>,
}

/// A quantity over `[set, to, by]`, and the rule where there are some.
struct Column {
    quantity: String,
    noisy: Vec<Noisy>,
}

impl Table {
    fn read(reader: &LabelledReader) -> Result<Self, UpliftError> {
        let axis = |name: &str| reader.axis_text(name);
        Ok(Self { sets: axis("record_set")?, to: axis("scaling")?, by: axis("scaled_by")? })
    }

    /// The array `name`, multiplied by the `factor` of each way of scaling.
    fn column(
        &self,
        reader: &LabelledReader,
        quantity: String,
        name: &str,
        factor: &dyn Fn(usize) -> f64,
    ) -> Result<Column, UpliftError> {
        let array = reader.array_f64(&format!("/design/{name}"))?;
        let ways = self.sets.len() * self.to.len() * self.by.len();
        let rules = array.values.len() / (BOUNDS.len() * ways.max(1));
        if array.values.len() != ways * rules.clamp(1, RULES.len()) * BOUNDS.len() {
            return Err(UpliftError::input(format!(
                "/design/{name} has not the shape of its axes: the file is damaged"
            )));
        }
        let noisy = array.values.chunks_exact(BOUNDS.len()).enumerate().map(|(place, bounds)| {
            let factor = factor(place / rules);
            Noisy { value: factor * bounds[0], lowest: factor * bounds[1], highest: factor * bounds[2] }
        });
        Ok(Column { quantity, noisy: noisy.collect() })
    }
}
