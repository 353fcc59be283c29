//! The stripes of a result for the page of `make web`, which reads spectra off them as this program does.

use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::{Compression, GzBuilder};
use serde_json::json;
use uplift_alarms::{Scope, alarms_of};
use uplift_atomic_file::{io_error, read_file};
use uplift_job::JobError;
use uplift_job::alarm::name_result;
use uplift_job::text::{finite, typed};
use uplift_result::ResultFile;
use uplift_uniform_risk::{QuotedUnits, StoredMeasure, StoredStripes};
use uplift_web_stripes::{FORMAT, WebCurve, WebMeasure, WebSite, WebStripes};

use super::source::provenance_of;
use crate::error::ExportsError;

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
    let packed = packed.write_all(json!(web(file)?).to_string().as_bytes()).and_then(|()| packed.finish());
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

/// The stripes, hazard curves and warnings of `file`; no path of this machine means anything on another.
///
/// # Errors
/// A file that is damaged or of another kind; levels with records of their own, structures that are not known exactly.
pub(super) fn web(file: &ResultFile) -> Result<WebStripes, ExportsError> {
    file.refuse_records_at_level("the page scales each record to every level")?;
    let stripes = StoredStripes::read(file)?;
    let (head, mut study) = (file.head()?, file.stored_study()?);
    let units = QuotedUnits::from_file(file)?;
    let name = file.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
    let measure = |(of, units): (&StoredMeasure, QuotedUnits)| WebMeasure {
        im: of.measure.key().to_owned(),
        levels: of.levels.clone(),
        band_of: <&str>::from(units.of).to_owned(),
        units: units.records,
        peaks_m: of.edp_m.values().iter().map(|peak_m| finite(*peak_m)).collect(),
    };
    let named = |mut alarms| {
        name_result(&mut alarms, &typed(&name));
        alarms
    };
    let mut sites = Vec::new();
    for (index, site) in stripes.sites.iter().enumerate() {
        let mut curves = Vec::new();
        for of in &stripes.measures {
            let curve = file.site_curve(site, of.measure)?;
            let scope = Scope { site: Some(index), measure: Some(of.measure), ..Scope::default() };
            curves.push(WebCurve {
                im: of.measure.key().to_owned(),
                unit: curve.unit().to_owned(),
                source: curve.source().to_owned(),
                levels: curve.im().to_vec(),
                maf_per_year: curve.maf().to_vec(),
                alarms: named(json!(alarms_of(file, &scope)?)),
            });
        }
        sites.push(WebSite { name: site.clone(), curves });
    }
    study.sites.clear();
    study.site_table = None;
    study.output.file = PathBuf::from(&name);
    Ok(WebStripes {
        format: FORMAT.to_owned(),
        provenance: provenance_of(&head, &name),
        study: study.to_toml().map_err(|error| file.damaged(error))?,
        sites,
        measures: stripes.measures.iter().zip(units).map(measure).collect(),
        record_set: head.record_set,
        synthetic: head.synthetic,
        records: stripes.records,
    })
}
