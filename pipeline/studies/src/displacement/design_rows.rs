//! The design examples in the result file.

use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::layout::{axis, design};
use uplift_result::{RULES, bounds, rule_names};
use uplift_spectra::{Noisy, RestrainedExample, SolitaryExample};
use uplift_study::{DesignPlan, Designed, DisplacementStudy, Structures};

use super::{Designs, Doubted, strength};

pub(super) fn write(
    writer: &mut LabelledWriter,
    study: &DisplacementStudy,
    plan: &DesignPlan,
    designs: &Designs,
) -> Result<(), LabelledError> {
    match designs {
        Designs::Restrained(examples) => {
            writer.axis_text(axis::RULE, &RULES.map(|rule| rule_names(rule)[0].to_owned()), "design rule")?;
            write_restrained(writer, examples)?;
        }
        Designs::Solitary(examples) => write_solitary(writer, examples)?,
    }
    let group = design::GROUP;
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

/// What the second array of a quantity is: the value, and its range over scale factors that differ by rounding.
const ROUNDED: &str = "with scale factors some 1e-15 smaller and larger";

fn write_restrained(writer: &mut LabelledWriter, examples: &[Doubted<RestrainedExample>]) -> Result<(), LabelledError> {
    let columns: [(&str, Value<RestrainedExample>, &str, &str); 5] = [
        ("u_dem_zs_m", |example| example.zero_stiffness_m, "m", "demand on the zero-stiffness system"),
        ("u_cap_m", |example| example.capacity_m, "m", "designed capacity (Eq. 3.15)"),
        ("u_dem_th_m", |example| example.time_history_m, "m", "demand on the designed system by time histories"),
        ("u_dem_rule_m", |example| example.rule_m, "m", "demand on the designed system by the rule"),
        ("error", |example| example.error, "1", "(rule - time histories)/time histories"),
    ];
    for (name, value, unit, long_name) in columns {
        let values: Vec<f64> = examples.iter().flat_map(|doubted| bounds(value(&doubted.example))).collect();
        let dims = [axis::RECORD_SET, axis::SCALING, axis::SCALED_BY, axis::RULE, axis::BOUND];
        writer.array_f64(&design::array(name), &dims, &values, unit, long_name)?;
        let values: Vec<f64> = examples.iter().flat_map(|doubted| bounds(value(&doubted.rounding))).collect();
        writer.array_f64(&design::rounding(name), &dims, &values, unit, &format!("{long_name}, {ROUNDED}"))?;
    }
    Ok(())
}

fn write_solitary(
    writer: &mut LabelledWriter,
    examples: &[Option<Doubted<SolitaryExample>>],
) -> Result<(), LabelledError> {
    const NONE: Noisy = Noisy { value: f64::NAN, lowest: f64::NAN, highest: f64::NAN };
    let columns: [(&str, Value<SolitaryExample>, &str, &str); 4] = [
        ("tan_alpha", |example| example.design_tangent, "1", "design slenderness tan(alpha_D)"),
        ("u_endless_m", |example| example.endless_m, "m", "displacement of the endless block there"),
        ("u_block_m", |example| example.block_m, "m", "displacement of the block itself there"),
        ("error", |example| example.error, "1", "(endless - block)/block"),
    ];
    let dims = [axis::RECORD_SET, axis::SCALING, axis::SCALED_BY, axis::BOUND];
    for (name, value, unit, long_name) in columns {
        let bounds_of = |of: fn(&Doubted<SolitaryExample>) -> &SolitaryExample| -> Vec<f64> {
            examples.iter().flat_map(|doubted| bounds(doubted.as_ref().map_or(NONE, |it| value(of(it))))).collect()
        };
        writer.array_f64(&design::array(name), &dims, &bounds_of(|doubted| &doubted.example), unit, long_name)?;
        let long_name = format!("{long_name}, {ROUNDED}");
        writer.array_f64(&design::rounding(name), &dims, &bounds_of(|doubted| &doubted.rounding), unit, &long_name)?;
    }
    let width_m: Vec<f64> =
        examples.iter().map(|doubted| doubted.as_ref().map_or(f64::NAN, |it| it.example.capacity_m)).collect();
    writer.array_f64(
        &design::array("capacity_m"),
        &dims[..3],
        &width_m,
        "m",
        "width 2b of the designed block, its capacity",
    )
}
