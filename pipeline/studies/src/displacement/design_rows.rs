//! The design examples in the result file.

use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::declared::Lengths;
use uplift_result::layout::attribute::design as attribute;
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
            axis::RULE.write_texts(writer, &[], &RULES.map(|rule| rule_names(rule)[0].to_owned()))?;
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
    attribute::SAFETY_FACTOR.write(writer, &[], plan.safety_factor)?;
    attribute::PERCENTILE.write(writer, &[], plan.percentile)?;
    attribute::NOISE_RELATIVE.write(writer, &[], plan.noise_relative)?;
    attribute::NOISE_POINTS.write(writer, &[], plan.noise_points as u64)?;
    match (plan.designed, &study.structures) {
        (Designed::Bridge { width_m, height_m }, Structures::Oscillators(family)) => {
            attribute::STRENGTH.write(writer, &[], strength(width_m, height_m))?;
            attribute::UPLIFT_DISPLACEMENT_M.write(writer, &[], family.uplift_displacement_m[0])?;
            attribute::LEAST_CAPACITY_M.write(writer, &[], width_m)
        }
        (Designed::Block { height_m, endless_height_m }, _) => {
            attribute::HEIGHT_M.write(writer, &[], height_m)?;
            attribute::ENDLESS_HEIGHT_M.write(writer, &[], endless_height_m)
        }
        (Designed::Bridge { .. }, Structures::Blocks(_)) => Ok(()),
    }
}
