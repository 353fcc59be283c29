//! The design examples in the result file, and the rows of the tables that are read back from there.

use uplift_spectra::{Noisy, RestrainedExample, SolitaryExample};
use uplift_structure::Rule;

use crate::displacement::{Designs, RULES, strength};
use crate::error::UpliftError;
use uplift_labelled::{LabelledError, LabelledReader, LabelledWriter};
use uplift_study::{DesignPlan, Designed, DisplacementStudy, Structures};

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

impl DesignRow {
    /// The value with its range, in words.
    pub fn ranged(&self) -> String {
        let Noisy { value, lowest, highest } = self.noisy;
        if value.is_nan() {
            return "none".to_owned();
        }
        format!("{} [{}, {}]", self.shown(value), self.shown(lowest), self.shown(highest))
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

/// A column of the design examples.
type Value<Example> = fn(&Example) -> Noisy;

fn bounds(noisy: Noisy) -> [f64; 3] {
    [noisy.value, noisy.lowest, noisy.highest]
}

fn write_restrained(writer: &mut LabelledWriter, examples: &[RestrainedExample]) -> Result<(), LabelledError> {
    let columns: [(&str, Value<RestrainedExample>, &str, &str); 5] = [
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
    let columns: [(&str, Value<SolitaryExample>, &str, &str); 4] = [
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
    let axis = |name: &str| reader.axis_text(name);
    let (sets, to, by) = (axis("record_set")?, axis("scaling")?, axis("scaled_by")?);
    let (rules, quantities) = if reader.exists("/design/u_cap_m") {
        let quantities = [
            ("u_cap_m".to_owned(), "u_cap_m", 1.0),
            ("u_dem_TH_m".to_owned(), "u_dem_th_m", 1.0),
            ("u_dem_rule_m".to_owned(), "u_dem_rule_m", 1.0),
            ("error_pct".to_owned(), "error", 100.0),
        ];
        (RULES.map(|rule| Some(words(rule)[1])).to_vec(), quantities)
    } else {
        let of_height = |name: &str| -> Result<String, UpliftError> {
            Ok(format!("u_2H{}_m", reader.attribute_f64("/design", name)?))
        };
        let quantities = [
            ("tan_alpha_design".to_owned(), "tan_alpha", 1.0),
            (of_height("endless_height_m")?, "u_endless_m", 1.0),
            (of_height("height_m")?, "u_block_m", 1.0),
            ("error_pct".to_owned(), "error", 100.0),
        ];
        (vec![None], quantities)
    };
    let ways = to.len() * by.len();
    let columns = quantities
        .into_iter()
        .map(|(quantity, name, factor)| {
            let values = reader.array_f64(&format!("/design/{name}"))?.values;
            if values.len() != sets.len() * ways * rules.len() * BOUNDS.len() {
                return Err(UpliftError::input(format!(
                    "/design/{name} has not the shape of its axes: the file is damaged"
                )));
            }
            let noisy = |bounds: &[f64]| Noisy {
                value: factor * bounds[0],
                lowest: factor * bounds[1],
                highest: factor * bounds[2],
            };
            Ok((quantity, values.chunks_exact(BOUNDS.len()).map(noisy).collect::<Vec<Noisy>>()))
        })
        .collect::<Result<Vec<_>, UpliftError>>()?;
    let mut rows = Vec::new();
    for (set, record_set) in sets.iter().enumerate() {
        for (position, &rule) in rules.iter().enumerate() {
            for (quantity, noisy) in &columns {
                for way in 0..ways {
                    rows.push(DesignRow {
                        record_set: record_set.clone(),
                        scaling: to[way / by.len()].clone(),
                        scaled_by: by[way % by.len()].clone(),
                        rule,
                        quantity: quantity.clone(),
                        noisy: noisy[(set * ways + way) * rules.len() + position],
                    });
                }
            }
        }
    }
    Ok(rows)
}
