//! Whether the records bring the site's hazard, as every format takes it, and the spectra of weighted records.

use uplift_result::{Fit, StoredConsistency};

use super::Export;
use super::source::Row;

/// What the records scaled to one measure bring at a site.
pub(super) struct ConsistencyOf<'a> {
    pub(super) of: &'a StoredConsistency,
    pub(super) site: &'a str,
    /// Level that the records bring over the site's, by the probabilities of the study.
    pub(super) ratio: &'a [f64],
    /// Its mean over the rates compared; NaN without a verdict.
    pub(super) bias: f64,
    /// Largest |ln(implied/site)|; NaN without a verdict.
    pub(super) max: f64,
    /// Nothing where there is none.
    pub(super) verdict: Option<&'a str>,
    /// None before a repair; NaN where it failed.
    pub(super) least_effective: Option<f64>,
}

impl Export {
    /// What was found, by the measure that records are scaled to, then site; sites without two hazard curves are left
    /// out.
    pub(super) fn consistencies(&self) -> impl Iterator<Item = ConsistencyOf<'_>> {
        let of_measure = |of| self.spectra.sites.iter().enumerate().filter_map(move |at| consistency_of(of, at));
        self.consistency.iter().flat_map(of_measure)
    }

    /// Whether any spectrum has one of weighted records beside it.
    pub(super) fn has_repaired(&self) -> bool {
        self.rows().any(|row| self.repaired(&row).is_some())
    }

    /// The displacements of weighted records over the strengths, m, and their coefficients; none without a repair.
    pub(super) fn repaired(&self, row: &Row<'_>) -> Option<(&[f64], &Fit)> {
        let is_beside = |of: &&StoredConsistency| of.scaled_to == row.spectrum.measure;
        let of = self.consistency.iter().filter(is_beside).find(|of| of.is_repaired(row.at[0]))?;
        Some((of.u_m.as_ref()?.block(row.at), &of.fits.as_ref()?[row.at]))
    }
}

fn consistency_of<'a>(of: &'a StoredConsistency, (at, site): (usize, &'a String)) -> Option<ConsistencyOf<'a>> {
    let is_known = of.rate_per_year.block([at]).iter().any(|rate| !rate.is_nan());
    is_known.then(|| ConsistencyOf {
        of,
        site,
        ratio: of.ratio.block([at]),
        bias: of.bias[at],
        max: of.max[at],
        verdict: Some(of.verdict[at].as_str()).filter(|verdict| !verdict.is_empty()),
        least_effective: of.least_effective.as_ref().map(|least| least[at]),
    })
}
