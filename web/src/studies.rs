//! The study that gives the spectrum of the page when `uplift run` reads it, with the hazard curves that it names.

use serde_json::{Value, json};
use toml::{Table, Value as Toml};
use uplift_study::RecordSource;

use crate::calculator::{Answer, At, refused};
use crate::stripes::Stripes;

/// The files, by name: `study.toml` and a table for each hazard curve of the site.
pub(crate) fn files(stripes: &Stripes, at: &At) -> Answer<Value> {
    let (site, risk) = (stripes.site(&at.site)?, stripes.risk(at)?);
    let mut study: Table = stripes.study_text.parse().map_err(refused)?;
    study.remove("output");
    study.insert("title".to_owned(), format!("{}, from the calculator in the browser", at.site).into());
    let mut own = Table::new();
    own.insert("name".to_owned(), at.site.as_str().into());
    let mut files = serde_json::Map::new();
    let stem: String =
        at.site.chars().map(|letter| if letter.is_alphanumeric() { letter } else { '-' }).collect::<String>();
    for curve in &site.curves {
        let key = curve.measure.key();
        let name = format!("{stem}-{key}.csv");
        own.insert(key.to_owned(), name.as_str().into());
        files.insert(name, curve.curve.to_csv(&[format!("site: {}", at.site)]).into());
    }
    study.insert("sites".to_owned(), Toml::Array(vec![own.into()]));
    for of in &stripes.measures {
        if site.curves.iter().all(|curve| curve.measure != of.measure) {
            study.remove(of.measure.key());
        }
    }
    if let Some(Toml::Table(of)) = study.get_mut("risk") {
        of.insert("poe".to_owned(), Toml::Array(vec![risk.poe.into()]));
        of.insert("years".to_owned(), risk.years.into());
        of.insert("extrapolate".to_owned(), site.extrapolate.key().into());
    }
    let is_made = matches!(stripes.study.records.source, RecordSource::Synthetic { .. });
    if let Some(rows) = &stripes.manifest {
        // the program reads the files that were dropped, from the folder of the study
        let head = "record_id,file_h1,channel_h1,file_h2,channel_h2,unit,dt_s\n";
        files.insert("records.csv".to_owned(), format!("{head}{rows}").into());
        let records = Table::from_iter([("manifest".to_owned(), Toml::from("records.csv"))]);
        study.insert("records".to_owned(), records.into());
    }
    let text = toml::to_string(&study).map_err(refused)?;
    files.insert("study.toml".to_owned(), text.into());
    Ok(json!({ "files": files, "runs_as_it_is": is_made || stripes.manifest.is_some() }))
}
