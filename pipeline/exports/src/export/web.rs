//! The stripes of a result for the page of `make web`, which reads spectra off them as this program does.

use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::{Compression, GzBuilder};
use serde_json::{Value, json};
use uplift_alarms::{Scope, alarms_of};
use uplift_atomic_file::{io_error, read_file};
use uplift_job::JobError;
use uplift_job::text::finite;
use uplift_result::ResultFile;
use uplift_uniform_risk::{QuotedUnits, StoredStripes};

use super::source::provenance_of;
use crate::error::ExportsError;

/// What the page takes for such a file, and which version of it.
const FORMAT: &str = "uplift-web-1";
/// The largest page, bytes: ten times that of the embedded records.
const LARGEST_PAGE_BYTES: u64 = 64 << 20;

/// The calculator's `page` of `make web` with the stripes, hazard curves and warnings of `file` in place of its own.
///
/// # Errors
/// As `uplift export --web`; a page that cannot be read or is not the built one.
pub fn calculator(file: &ResultFile, page: &Path) -> Result<String, ExportsError> {
    let refused = |what: String| JobError::input(format!("{what}; run `make web` and give web/dist/index.html"));
    let read = read_file(page, LARGEST_PAGE_BYTES).map_err(|error| refused(error.to_string()))?;
    let built = String::from_utf8(read).ok().filter(|built| part(built, "module").is_some());
    let built = built.and_then(|built| Some((part(&built, "stripes")?, built)));
    let (place, mut built) =
        built.ok_or_else(|| refused(format!("{}: not the built page of the calculator", page.display())))?;
    let mut packed = GzBuilder::new().write(Vec::new(), Compression::best());
    let packed = packed.write_all(web(file)?.to_string().as_bytes()).and_then(|()| packed.finish());
    let packed = packed.map_err(io_error(page, "pack the stripes")).map_err(JobError::from)?;
    built.replace_range(place, &STANDARD.encode(packed));
    Ok(built)
}

/// Where the calculator's `page` has the packed part `id`; none if the part is absent or was never put in.
fn part(page: &str, id: &str) -> Option<Range<usize>> {
    let (_, rest) = page.split_once(&format!("<script id=\"{id}\" type=\"text/plain\">"))?;
    let (packed, _) = rest.split_once("</script>")?;
    let is_packed = |byte: u8| byte.is_ascii_alphanumeric() || b"+/=".contains(&byte);
    let start = page.len() - rest.len();
    (!packed.is_empty() && packed.bytes().all(is_packed)).then_some(start..start + packed.len())
}

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
    let units = QuotedUnits::from_file(file)?;
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
