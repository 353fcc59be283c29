//! The result of a study: the one that is there if it is the study's, else the study is run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use uplift_labelled::LabelledError;
use uplift_study::{AnyStudy, UniformRiskStudy};

use crate::checkpoint::{motion_key, oscillator_key};
use crate::error::UpliftError;
use crate::events::Events;
use crate::inputs::{read_hazard, read_records};
use crate::result::{Provenance, open_result};
use crate::run::{RunOptions, run};

/// Sections of a study on which its stripes and spectra do not depend.
const WITHOUT_INFLUENCE: [&str; 3] = ["title", "bootstrap", "output"];

/// The result file of `study`; a study without one is run.
///
/// # Errors
/// Inputs that cannot be used; as [`run`].
pub fn result_of(study: &UniformRiskStudy, options: &RunOptions, events: &dyn Events) -> Result<PathBuf, UpliftError> {
    let path = options.result_file(&study.output.file);
    if path.exists() && is_result_of(study, path)? {
        events.remark("result", &format!("{} is that of the study", path.display()));
    } else {
        events.remark("result", &format!("{} is made first", path.display()));
        run(&AnyStudy::UniformRisk(Box::new(study.clone())), options, events)?;
    }
    Ok(path.to_owned())
}

/// Whether the file at `path` holds the stripes and spectra of `study`, made of the same records and hazard curves.
fn is_result_of(study: &UniformRiskStudy, path: &Path) -> Result<bool, UpliftError> {
    let Ok(reader) = open_result(path) else { return Ok(false) };
    let own = study.to_toml().map_err(|error| UpliftError::input(error.to_string()))?;
    let kept = reader.attribute_text("/", "study_toml")?;
    let (Some(own), Some(kept)) = (what_counts(&own), what_counts(&kept)) else { return Ok(false) };
    if own != kept {
        return Ok(false);
    }
    let (hazard, _) = read_hazard(study)?;
    let records = read_records(study)?;
    let provenance = Provenance::new(&RunOptions::default(), &records, &hazard);
    let kept: Option<BTreeMap<String, String>> =
        serde_json::from_str(&reader.attribute_text("/", "input_checksums")?).ok();
    if kept != Some(provenance.input_checksums) {
        return Ok(false);
    }
    // what a manifest says of its files counts too: the motions themselves, what they are scaled by, what is known of them
    let same = || -> Result<bool, LabelledError> {
        let motions: Vec<String> = records.records.iter().map(|record| motion_key(&record.accelerogram)).collect();
        let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
        let number = |key: &str| records.records.iter().map(|record| record.number(key)).collect::<Vec<f64>>();
        let mut same = reader.array_text("/records/motion_sha256")?.values == motions
            && bits(reader.array_f64("/records/pga_g")?.values)
                == bits(records.records.iter().map(|r| r.pga_g).collect())
            && bits(reader.array_f64("/records/pgv_cm_s")?.values)
                == bits(records.records.iter().map(|r| r.pgv_cm_s).collect());
        for key in ["magnitude", "rrup_km", "vs30"] {
            same &= bits(reader.array_f64(&format!("/records/{key}"))?.values) == bits(number(key));
        }
        for measure in &study.measures {
            let group = format!("/ida/{}", measure.measure.key());
            same &= reader.attribute_text(&group, "oscillator_key")? == oscillator_key(study);
        }
        Ok(same)
    };
    Ok(same().unwrap_or(false))
}

fn what_counts(study_toml: &str) -> Option<toml::Table> {
    let mut table: toml::Table = toml::from_str(study_toml).ok()?;
    for section in WITHOUT_INFLUENCE {
        table.remove(section);
    }
    Some(table)
}
