//! What to know before the numbers of a structure are used: alarms of the result, of its own file, of its own risks.

use uplift_alarms::{OwnRisk, Scope, alarms_of_inputs, of_structure};
use uplift_job::alarm::Alarm;
use uplift_result::ResultFile;
use uplift_study::Structure;
use uplift_uniform_risk::{EventRisk, SpectraOfResult};

use crate::error::DesignError;

/// The alarms of curves and records within `scope`, and of the structure's file; not ranked yet.
///
/// # Errors
/// A file that is damaged, or without sites.
pub(super) fn alarms_of_job(
    file: &ResultFile,
    scope: &Scope,
    structure: &Structure,
) -> Result<Vec<Alarm>, DesignError> {
    let mut alarms = alarms_of_inputs(file, scope)?;
    alarms.extend(of_structure(structure));
    Ok(alarms)
}

/// How many runs a risk was counted among.
#[derive(Debug, Clone, Copy)]
pub(super) struct RunCounts {
    pub(super) records: usize,
    pub(super) pairs: usize,
    /// To how many pairs that count alike these amount.
    pub(super) effective_pairs: f64,
}

impl RunCounts {
    /// Of pairs that count alike.
    pub(super) fn alike(records: usize, pairs: usize) -> Self {
        Self { records, pairs, effective_pairs: pairs as f64 }
    }
}

/// A risk of the structure at a `site`, in the form in which alarms look at it.
pub(super) fn own_risk(
    (event, risk): (&str, EventRisk),
    site: &str,
    measure: &SpectraOfResult,
    counts: RunCounts,
) -> OwnRisk {
    let levels = &measure.plan.levels;
    let RunCounts { records, pairs, effective_pairs } = counts;
    OwnRisk {
        subject: format!("{event}, {site}, {}", measure.measure().label()),
        risk,
        measure: measure.measure(),
        levels: (levels[0], levels[levels.len() - 1]),
        records,
        pairs,
        effective_pairs,
    }
}
