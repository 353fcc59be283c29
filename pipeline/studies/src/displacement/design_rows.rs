//! The design examples in the result file.

use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::declared::Lengths;
use uplift_result::layout::axis;
use uplift_result::{RESTRAINED_DESIGN, ROUNDING, RULES, SOLITARY_CAPACITY, SOLITARY_DESIGN, VALUES, rule_names};
use uplift_study::{DesignPlan, Designed, DisplacementStudy, Structures};

use super::{Designs, strength};

pub(super) fn write(
    writer: &mut LabelledWriter,
    study: &DisplacementStudy,
    plan: &DesignPlan,
    designs: &Designs,
    lengths: Lengths<'_>,
) -> Result<(), LabelledError> {
    match designs {
        Designs::Restrained(examples) => {
            writer.axis_text(axis::RULE, &RULES.map(|rule| rule_names(rule)[0].to_owned()), "design rule")?;
            let (values, rounding) =
                (examples.iter().map(|own| &own.example), examples.iter().map(|own| &own.rounding));
            RESTRAINED_DESIGN.write_rows(writer, &VALUES, lengths, values.map(Some))?;
            RESTRAINED_DESIGN.write_rows(writer, &ROUNDING, lengths, rounding.map(Some))?;
        }
        Designs::Solitary(examples) => {
            let values = || examples.iter().map(|own| own.as_ref().map(|own| &own.example));
            let rounding = examples.iter().map(|own| own.as_ref().map(|own| &own.rounding));
            SOLITARY_DESIGN.write_rows(writer, &VALUES, lengths, values())?;
            SOLITARY_DESIGN.write_rows(writer, &ROUNDING, lengths, rounding)?;
            SOLITARY_CAPACITY.write_rows(writer, &[], lengths, values())?;
        }
    }
    let group = RESTRAINED_DESIGN.path;
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
