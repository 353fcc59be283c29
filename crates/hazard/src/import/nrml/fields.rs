//! `hazardCurveField` of NRML 0.3: what the first `OpenQuake` wrote and the hazard services of EFEHR answer.
//!
//! The levels stand in `IML` with the measure as its attribute, a curve in `HCNode`, and the time of the probabilities
//! in `hazardProcessing` beside the fields, with period and damping of a spectral acceleration.
//!
//! # Source
//! NRML schema 0.3, elements `hazardResult` and `hazardCurveField`; notebooks that read the services of EFEHR (Efehr
//! hazard notebooks of the SEHR group) for the words of the measure and of the statistics.

use roxmltree::Node;

use super::super::Statistic;
use super::super::entry::Head;
use super::{Version, attribute, is, measure, only, optional_number};
use crate::error::{HazardError, Place};
use crate::text::excerpt;

pub(super) const VERSION: Version = Version { curve: "HCNode", probabilities: "poE", levels: "levels", head };

/// Longest label of a branch, bytes; every curve keeps a copy.
const LONGEST_LABEL: usize = 1000;

fn head(field: Node, name: &str, place: &Place) -> Result<Head, HazardError> {
    let row = |reason: String| HazardError::Row { place: place.clone(), reason };
    let levels = only(field, ("hazardCurveField", "IML"), place)?;
    let imt = attribute(levels, "IMT").ok_or_else(|| row("IML without attribute IMT".to_owned()))?;
    let processing = processing(field)
        .ok_or_else(|| row("no hazardProcessing, which says the years of the probabilities".to_owned()))?;
    let optional_number = |name: &str| optional_number(processing, name, place);
    let years = optional_number("investigationTimeSpan")?.ok_or_else(|| {
        row("hazardProcessing without investigationTimeSpan: write the years of the probabilities there".to_owned())
    })?;
    let (imt, period_s) = with_period(imt, optional_number("saPeriod")?);
    let measure = measure(imt, period_s, optional_number("saDamping")?)
        .ok_or_else(|| row("IMT SA without saPeriod in hazardProcessing".to_owned()))?;
    let kind = statistic(field, place)?;
    super::head(name, (kind, measure, years), levels, place)
}

/// How the curves of the result were computed: beside the field, or in the `config` beside it.
fn processing<'a, 'input>(field: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
    let beside = field.parent()?.children().filter(Node::is_element).take(super::NEAR);
    let mut near = beside.flat_map(|node| std::iter::once(node).chain(node.children().take(super::NEAR)));
    near.find(|node| is(*node, "hazardProcessing"))
}

/// The measure and period of `SA[0.2s]`, as the services of EFEHR call it; else as they are.
fn with_period(imt: &str, period_s: Option<f64>) -> (&str, Option<f64>) {
    let within = imt.strip_prefix("SA[").and_then(|rest| rest.strip_suffix("s]"));
    match within.and_then(|period| period.parse::<f64>().ok()) {
        Some(period_s) if period_s.is_finite() && period_s > 0.0 => ("SA", Some(period_s)),
        _ => (imt, period_s),
    }
}

/// What the curves are over the logic tree.
fn statistic(field: Node, place: &Place) -> Result<Statistic, HazardError> {
    let row = |reason: String| HazardError::Row { place: place.clone(), reason };
    let quantile = optional_number(field, "quantileValue", place)?;
    match (attribute(field, "statistics"), quantile) {
        (Some("mean" | "arithmetic"), _) => Ok(Statistic::Mean),
        (Some("median"), _) => Ok(Statistic::Quantile(0.5)),
        (Some("quantile" | "ordinal"), Some(quantile)) if (0.0..=1.0).contains(&quantile) => {
            Ok(Statistic::Quantile(quantile))
        }
        (Some(other), _) => {
            Err(row(format!("statistics {} is neither mean, median nor quantile with a quantileValue", excerpt(other))))
        }
        (None, _) => match attribute(field, "endBranchLabel") {
            Some(label) if label.len() > LONGEST_LABEL => {
                Err(row(format!("an endBranchLabel of more than {LONGEST_LABEL} bytes")))
            }
            Some(label) => Ok(Statistic::Branch(label.to_owned())),
            None => Ok(Statistic::Unspecified),
        },
    }
}
