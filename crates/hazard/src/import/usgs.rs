//! Hazard curves as the services of the USGS National Seismic Hazard Model answer, in JSON.
//!
//! Four layouts have been in use; their blocks, one a measure, differ in where they say what:
//!
//! | service | blocks | measure | levels | rates |
//! |---|---|---|---|---|
//! | `nshmp-haz-ws` | `response[]` | `metadata.imt.value` | `metadata.xvalues` | `data[].yvalues` |
//! | `hazws/staticcurve` | `response[]` | `metadata.imt.value` | `metadata.xvals` | `data[].yvals`, one a place |
//! | `nshmp-haz` version 2, first | `response.hazards[]` | `metadata.imt` | `data[].values.xs` | `data[].values.ys` |
//! | `nshmp-haz` version 2 | `response.hazardCurves[]` | `imt.value` | `data[].values.xs` | `data[].values.ys` |
//!
//! Of the curves by source type only the component "Total" is read. Values are annual frequencies of exceedance.
//!
//! # Source
//! usgs/nshmp-haz-ws and usgs/nshmp-haz, class `HazardService`.

use std::sync::Arc;

use serde_json::Value;

use super::entry::{Entry, Head};
use super::measure::usgs_measure;
use super::{SitePlace, Statistic, coordinates};
use crate::component::ComponentDefinition;
use crate::declaration::SecondColumn;
use crate::error::{HazardError, Place};
use crate::text::{beginning, excerpt, origin};

/// Most JSON objects: some twenty a measure, one or two a place.
const MOST_OBJECTS: usize = 100_000;
/// Characters of the label of an axis that are looked at, once a block.
const LONGEST_LABEL: usize = 200;

/// Every total curve of the answer, in its order.
pub(super) fn entries(text: &str, name: &str) -> Result<Vec<Entry>, HazardError> {
    let fail = |reason: String| HazardError::File { file: name.to_owned(), reason };
    // Each takes a hundred times the memory of its text.
    if text.matches('{').count() > MOST_OBJECTS {
        return Err(fail(format!("more than {MOST_OBJECTS} objects: not the answer of a USGS hazard service")));
    }
    let root: Value =
        serde_json::from_str(text).map_err(|error| fail(format!("not JSON that can be read: {error}")))?;
    if let Some(status) = root["status"].as_str().filter(|status| !status.eq_ignore_ascii_case("success")) {
        let message = [&root["message"], &root["response"]].into_iter().find_map(Value::as_str).unwrap_or_default();
        let (status, message) = (excerpt(status), excerpt(message));
        return Err(fail(format!("the service answered with status {status}: {message}; ask it again")));
    }
    let response = root.get("response").unwrap_or(&root);
    let blocks = [response, &response["hazardCurves"], &response["hazards"]].into_iter().find_map(Value::as_array);
    let Some(blocks) = blocks.filter(|blocks| !blocks.is_empty()) else {
        return Err(fail("no hazard curves in it; save the whole answer of a USGS hazard service".to_owned()));
    };
    let url = root["url"].as_str().map(|url| format!(", {}", url.trim())).unwrap_or_default();
    let source = origin(&format!("USGS hazard service{url}"));
    let mut entries = Vec::new();
    for block in blocks {
        Answer { file: name, source: &source, root: &root, response, block }.entries(&mut entries)?;
    }
    Ok(entries)
}

/// One block of the answer, and what surrounds it.
struct Answer<'a> {
    file: &'a str,
    source: &'a str,
    root: &'a Value,
    response: &'a Value,
    block: &'a Value,
}

impl Answer<'_> {
    fn entries(&self, entries: &mut Vec<Entry>) -> Result<(), HazardError> {
        let Some(name) = self.in_block("imt").and_then(|imt| plain(imt).as_str()) else {
            return Err(self.fail("a block", "it does not say its measure (imt)"));
        };
        let here = excerpt(name);
        let place = || Place::Level(format!("{}, {here}", self.file));
        let (measure, unit) = usgs_measure(name, place)?;
        self.check_labels(&here, unit)?;
        for data in self.totals(&here)? {
            let numbers = |found: Option<&Value>, what: &str| {
                let values = found.and_then(Value::as_array).ok_or_else(|| self.fail(&here, &format!("no {what}")))?;
                let numbers: Option<Vec<f64>> = values.iter().map(finite).collect();
                numbers.ok_or_else(|| self.fail(&here, &format!("one of the {what} is not a number")))
            };
            let of_data = |keys: [&str; 2]| keys.into_iter().find_map(|key| data.get(key));
            let metadata = &self.block["metadata"];
            let xs = data["values"].get("xs").or(of_data(["xvalues", "xvals"]));
            let xs = xs.or(metadata.get("xvalues")).or(metadata.get("xvals"));
            let levels = numbers(xs, "levels (xs, xvalues)")?;
            let rates = numbers(data["values"].get("ys").or(of_data(["yvalues", "yvals"])), "rates (ys, yvalues)")?;
            if levels.len() != rates.len() {
                let reason = format!("{} rates for {} levels; save the answer again", rates.len(), levels.len());
                return Err(self.fail(&here, &reason));
            }
            let known = |key: &str| data.get(key).or(self.in_surroundings(key)).map(plain).and_then(finite);
            let (Some(longitude), Some(latitude)) = (known("longitude"), known("latitude")) else {
                return Err(self.fail(&here, "no longitude and latitude; save the whole answer of the service"));
            };
            let (longitude_deg, latitude_deg) = coordinates(longitude, latitude, place)?;
            let head = Head {
                file: self.file.to_owned(),
                measure: measure.clone(),
                unit,
                kind: Statistic::Mean,
                content: SecondColumn::AnnualRate,
                years: None,
                levels,
                source: self.source.to_owned(),
                // Asked to, the service scales its levels to the direction of the maximum.
                component: (self.root["request"]["maxdir"] == true).then_some(ComponentDefinition::RotD100),
            };
            entries.push(Entry {
                head: Arc::new(head),
                line: None,
                site: SitePlace { name: None, longitude_deg, latitude_deg },
                vs30_m_s: known("vs30"),
                values: Ok(rates),
            });
        }
        Ok(())
    }

    /// The curves of all sources together.
    fn totals(&self, here: &str) -> Result<Vec<&Value>, HazardError> {
        let data = self.block["data"].as_array().map(Vec::as_slice).unwrap_or_default();
        let component = |curve: &Value| curve["component"].as_str().map(str::to_ascii_lowercase);
        if !data.is_empty() && data.iter().all(|curve| curve.get("component").is_none()) {
            // One curve a place, of all sources.
            return Ok(data.iter().collect());
        }
        let totals: Vec<&Value> = data.iter().filter(|curve| component(curve).as_deref() == Some("total")).collect();
        match totals[..] {
            [_] => Ok(totals),
            [] => Err(self.fail(here, "no curve of the component \"Total\"; save the whole answer of the service")),
            _ => Err(self.fail(here, "several curves of the component \"Total\"; keep one")),
        }
    }

    /// Refuses levels and rates that name another unit than the ones known; the label of PGV names g regardless.
    fn check_labels(&self, here: &str, unit: &str) -> Result<(), HazardError> {
        let label = |key: &str| Some(beginning(self.in_surroundings(key)?.as_str()?, LONGEST_LABEL));
        let contradiction = |what, found: &str, declared: &str| {
            let place = Place::Level(format!("{}, {here}", self.file));
            Err(HazardError::Contradiction { place, what, found: excerpt(found), declared: declared.to_owned() })
        };
        match (label("xlabel"), label("ylabel")) {
            (Some(x), _) if unit == "g" && x.contains('(') && !x.contains("(g)") => contradiction("unit", x, "g"),
            (_, Some(y)) if !y.to_ascii_lowercase().contains("annual") => {
                contradiction("rates", y, "annual frequency of exceedance")
            }
            _ => Ok(()),
        }
    }

    fn in_block(&self, key: &str) -> Option<&Value> {
        self.block.get(key).or(self.block["metadata"].get(key))
    }

    fn in_surroundings(&self, key: &str) -> Option<&Value> {
        self.in_block(key).or(self.response["metadata"].get(key)).or(self.root["request"].get(key))
    }

    fn fail(&self, here: &str, reason: &str) -> HazardError {
        HazardError::File { file: self.file.to_owned(), reason: format!("{here}: {reason}") }
    }
}

/// The value of a parameter, which the service may describe as `{"value": ..., "display": ...}`.
fn plain(parameter: &Value) -> &Value {
    parameter.get("value").unwrap_or(parameter)
}

/// A number, which may stand in quotes.
fn finite(value: &Value) -> Option<f64> {
    let number = value.as_f64().or_else(|| value.as_str()?.trim().parse().ok());
    number.filter(|number| number.is_finite())
}
