//! The stripes of a result for the page of `make web`, which reads spectra off them as this program does.

use std::path::PathBuf;

use serde_json::{Value, json};
use uplift_alarms::{Scope, alarms_of};
use uplift_job::text::finite;
use uplift_result::ResultFile;
use uplift_uniform_risk::{QuotedUnits, StoredStripes};

use super::source::provenance_of;
use crate::error::ExportsError;

/// What the page takes for such a file, and which version of it.
const FORMAT: &str = "uplift-web-1";

/// The stripes, hazard curves and warnings of `file` as one JSON object; a peak that is infinite is null.
///
/// The study is without sites and without the place of its result, since no path of this machine means anything on
/// another.
///
/// # Errors
/// A file that is damaged or of another kind; levels with records of their own, structures that are not known exactly.
pub(super) fn web(file: &ResultFile) -> Result<Value, ExportsError> {
    file.refuse_records_at_level("the page scales each record to every level")?;
    let stripes = StoredStripes::read(file)?;
    let (head, mut study) = (file.head()?, file.stored_study()?);
    let units = QuotedUnits::of_measures(file)?;
    let name = file.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
    let measure = |(of, units): (&uplift_uniform_risk::StoredMeasure, QuotedUnits)| {
        json!({
            "im": of.measure.key(),
            "levels": of.levels,
            "band_of": units.of,
            "units": units.records,
            "peaks_m": of.edp_m.values().iter().map(|peak_m| finite(*peak_m)).collect::<Vec<_>>(),
        })
    };
    let mut sites = Vec::new();
    for (index, site) in stripes.sites.iter().enumerate() {
        let mut curves = Vec::new();
        for of in &stripes.measures {
            let curve = file.site_curve(site, of.measure)?;
            let scope = Scope { site: Some(index), measure: Some(of.measure), ..Scope::default() };
            curves.push(json!({
                "im": of.measure.key(),
                "unit": curve.unit(),
                "source": curve.source(),
                "levels": curve.im(),
                "maf_per_year": curve.maf(),
                "alarms": alarms_of(file, &scope)?,
            }));
        }
        sites.push(json!({ "name": site, "curves": curves }));
    }
    study.sites.clear();
    study.site_table = None;
    study.output.file = PathBuf::from(&name);
    Ok(json!({
        "format": FORMAT,
        "provenance": provenance_of(&head, &name),
        "record_set": head.record_set,
        "synthetic": head.synthetic,
        "records": stripes.records,
        "study": study.to_toml().map_err(|error| file.damaged(error))?,
        "sites": sites,
        "measures": stripes.measures.iter().zip(units).map(measure).collect::<Vec<_>>(),
    }))
}
