//! `hazardCurves` of NRML 0.4 and 0.5.
//!
//! # Source
//! NRML schema `hazard_curves.xsd`.

use roxmltree::Node;

use super::super::Statistic;
use super::super::entry::Head;
use super::{Version, attribute, measure, only, optional_number};
use crate::error::{HazardError, Place};
use crate::text::{excerpt, number};

pub(super) const VERSION: Version = Version { curve: "hazardCurve", probabilities: "poEs", levels: "IMLs", head };

/// Longest path through the logic trees, bytes; every curve keeps a copy.
const LONGEST_PATH: usize = 1000;

fn head(group: Node, name: &str, place: &Place) -> Result<Head, HazardError> {
    let row = |reason: String| HazardError::Row { place: place.clone(), reason };
    let attribute = |name: &str| attribute(group, name);
    let required = |name: &str| attribute(name).ok_or_else(|| row(format!("hazardCurves without attribute {name}")));
    let optional_number = |name: &str| optional_number(group, name, place);

    let imt = required("IMT")?;
    let period_s = optional_number("saPeriod")?;
    let damping = optional_number("saDamping")?;
    let measure = measure(imt, period_s, damping).ok_or_else(|| row("IMT SA without saPeriod".to_owned()))?;
    let quantile = optional_number("quantileValue")?;
    let kind = match (attribute("statistics"), quantile) {
        (Some("mean"), _) => Statistic::Mean,
        (Some("quantile"), Some(quantile)) if (0.0..=1.0).contains(&quantile) => Statistic::Quantile(quantile),
        (Some(other), _) => {
            return Err(row(format!(
                "statistics {} is neither mean nor quantile with a quantileValue",
                excerpt(other)
            )));
        }
        (None, _) => match (attribute("sourceModelTreePath"), attribute("gsimTreePath")) {
            (Some(source), Some(gsim)) if source.len() + gsim.len() > LONGEST_PATH => {
                return Err(row(format!("a path of more than {LONGEST_PATH} bytes through the logic trees")));
            }
            (Some(source), Some(gsim)) => Statistic::Branch(format!("{source}~{gsim}")),
            _ => Statistic::Unspecified,
        },
    };
    let levels = only(group, ("hazardCurves", "IMLs"), place)?;
    let years = number(required("investigationTime")?, || place.clone())?;
    super::head(name, (kind, measure, years), levels, place)
}
