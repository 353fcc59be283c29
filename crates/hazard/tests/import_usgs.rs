//! JSON of the USGS hazard services: the four layouts, and what is refused.

use std::io::Cursor;

use serde_json::{Value, json};
use uplift_hazard::{ComponentDefinition, ExportedCurve, ExportedCurves, HazardError, SiteSelection, Statistic};

fn select(value: &Value, selection: &SiteSelection) -> Result<Vec<ExportedCurve>, HazardError> {
    read(value.to_string(), selection)
}

fn read(text: String, selection: &SiteSelection) -> Result<Vec<ExportedCurve>, HazardError> {
    ExportedCurves::from_reader(Cursor::new(text), "x.json")?.select(selection)
}

fn all(value: &Value) -> Result<Vec<ExportedCurve>, HazardError> {
    select(value, &SiteSelection::All)
}

const XS: [f64; 4] = [0.0025, 0.05, 0.5, 5.0];
const YS: [f64; 4] = [0.35, 0.02, 0.0004, 0.0];

const X_LABEL: &str = "Ground Motion (g)";
const Y_LABEL: &str = "Annual Frequency of Exceedence";

/// As `nshmp-haz-ws` answered.
fn first() -> Value {
    json!({"status": "success", "url": "https://example.org/hazard/E2014/COUS/-118.25/34.05/PGA/760", "response": [
        {"metadata": {
            "edition": {"value": "E2014", "display": "Dynamic: Conterminous U.S. 2014"},
            "latitude": 34.05, "longitude": -118.25,
            "imt": {"value": "PGA", "display": "Peak Ground Acceleration"},
            "vs30": {"value": "760", "display": "760 m/s (B/C boundary)"},
            "xlabel": X_LABEL, "ylabel": Y_LABEL, "xvalues": XS},
         "data": [{"component": "Total", "yvalues": YS}, {"component": "Fault", "yvalues": [0.1, 0.01, 0.0002, 0.0]}]},
        {"metadata": {
            "latitude": 34.05, "longitude": -118.25, "imt": {"value": "SA0P2"}, "vs30": {"value": "760"},
            "xlabel": X_LABEL, "ylabel": Y_LABEL, "xvalues": XS},
         "data": [{"component": "Grid", "yvalues": [0.1]},
                  {"component": "Total", "yvalues": [0.5, 0.1, 0.01, 0.001]}]}]})
}

/// As `nshmp-haz` version 2 answers.
fn second() -> Value {
    json!({"name": "Hazard Service", "status": "success", "url": "https://example.org/hazard/-118.25/34.05/760",
        "request": {"longitude": -118.25, "latitude": 34.05, "vs30": 760.0, "truncate": false, "maxdir": false,
            "imts": ["PGA"]},
        "response": {"metadata": {"server": {}, "xlabel": X_LABEL, "ylabel": Y_LABEL}, "hazardCurves": [
            {"imt": {"display": "PGA", "value": "PGA"}, "data": [
                {"component": "Total", "values": {"xs": XS, "ys": YS}},
                {"component": "Grid", "values": {"xs": XS, "ys": [0.1, 0.01, 0.0002, 0.0]}}]},
            {"imt": {"display": "PGV", "value": "PGV"}, "data": [
                {"component": "Total", "values": {"xs": [1.0, 10.0], "ys": [0.1, 0.01]}}]}]}})
}

/// As the first of version 2 answered.
fn between() -> Value {
    json!({"status": "success", "request": {"longitude": -118.25, "latitude": 34.05, "vs30": 760},
        "response": {"server": {}, "hazards": [
            {"metadata": {"imt": "0.2 s", "xlabel": X_LABEL, "ylabel": Y_LABEL}, "data": [
                {"component": "Total", "values": {"xs": XS, "ys": YS}}]}]}})
}

/// As the service of precomputed curves answered: one curve a place.
fn precomputed() -> Value {
    json!({"status": "success", "response": [{"metadata": {
        "imt": {"value": "PGA"}, "vs30": {"value": "760"}, "xlabel": X_LABEL, "ylabel": Y_LABEL, "xvals": XS},
        "data": [{"latitude": "34.0", "longitude": "-118.0", "yvals": YS},
                 {"latitude": 34.1, "longitude": -118.0, "yvals": YS}]}]})
}

fn check(curve: &ExportedCurve, measure: &str) {
    assert_eq!((curve.curve.measure(), curve.curve.unit()), (measure, "g"));
    assert_eq!((curve.curve.im(), curve.curve.maf()), (&XS[..3], &YS[..3]), "rates are taken as they are");
    assert_eq!((curve.dropped_zeros, curve.dropped_certain), (1, 0));
    assert_eq!((&curve.kind, curve.investigation_years, curve.vs30_m_s), (&Statistic::Mean, None, Some(760.0)));
    assert_eq!(curve.curve.component(), None);
}

#[test]
fn four_layouts() {
    for (answer, measures, longitude, latitude) in [
        (first(), &["PGA", "SA(0.2)"][..], -118.25, 34.05),
        (second(), &["PGA", "PGV"], -118.25, 34.05),
        (between(), &["SA(0.2)"], -118.25, 34.05),
        (precomputed(), &["PGA", "PGA"], -118.0, 34.0),
    ] {
        let read = all(&answer).unwrap();
        assert_eq!(read.iter().map(|curve| curve.curve.measure()).collect::<Vec<_>>(), measures);
        check(&read[0], measures[0]);
        assert_eq!((read[0].site.longitude_deg, read[0].site.latitude_deg), (longitude, latitude));
    }
    let read = all(&first()).unwrap();
    assert_eq!(read[1].curve.maf(), [0.5, 0.1, 0.01, 0.001]);
    assert!(read[0].curve.source().ends_with("https://example.org/hazard/E2014/COUS/-118.25/34.05/PGA/760"));
    let read = all(&second()).unwrap();
    assert_eq!((read[1].curve.unit(), read[1].curve.im()), ("cm/s", &[1.0, 10.0][..]));
    let near = SiteSelection::Nearest { longitude_deg: -118.0, latitude_deg: 34.09 };
    let near = select(&precomputed(), &near).unwrap();
    assert_eq!((near.len(), near[0].site.latitude_deg), (1, 34.1));
    assert!((near[0].distance_km.unwrap() - 1.112).abs() < 0.001);
    // A response alone, without what surrounds it.
    assert_eq!(all(&first()["response"]).unwrap().len(), 2);
}

#[test]
fn levels_scaled_to_the_direction_of_the_maximum_say_so() {
    let mut answer = second();
    answer["request"]["maxdir"] = json!(true);
    assert!(all(&answer).unwrap().iter().all(|curve| curve.curve.component() == Some(ComponentDefinition::RotD100)));
}

#[test]
fn what_is_wrong_is_named() {
    let changed = |pointer: &str, value: Value| {
        let mut answer = second();
        *answer.pointer_mut(pointer).unwrap() = value;
        all(&answer).unwrap_err().to_string()
    };
    let total = "/response/hazardCurves/0/data/0";
    let xs = format!("{total}/values/xs");
    let ys = format!("{total}/values/ys");
    for (message, expected) in [
        (changed("/status", json!("error")), "x.json: the service answered with status \"error\": \"\"; ask it again"),
        (changed("/response", json!({})), "x.json: no hazard curves in it"),
        (changed("/response", json!("busy")), "x.json: no hazard curves in it"),
        (changed("/response/hazardCurves", json!([])), "x.json: no hazard curves in it"),
        (changed("/response/hazardCurves/0", json!(7)), "x.json: a block: it does not say its measure"),
        (
            changed("/response/hazardCurves/0/imt/value", json!("CAV")),
            "x.json, \"CAV\": unknown unit of intensity measure \"CAV\"",
        ),
        (changed("/response/hazardCurves/0/data", json!([])), "x.json: \"PGA\": no curve of the component \"Total\""),
        (changed(&format!("{total}/component"), json!("Slab")), "x.json: \"PGA\": no curve of the component \"Total\""),
        (changed("/response/hazardCurves/0/data/1/component", json!("total")), "x.json: \"PGA\": several curves of"),
        (changed(&xs, json!(null)), "x.json: \"PGA\": no levels (xs, xvalues)"),
        (changed(&xs, json!([0.1, 0.2])), "x.json: \"PGA\": 4 rates for 2 levels"),
        (
            changed(&ys, json!([0.1, 0.05, null, 0.01])),
            "x.json: \"PGA\": one of the rates (ys, yvalues) is not a number",
        ),
        (
            changed(&ys, json!([0.1, 0.05, "NaN", 0.01])),
            "x.json: \"PGA\": one of the rates (ys, yvalues) is not a number",
        ),
        (changed(&ys, json!([0.1, 0.05, 0.05, 0.01])), "x.json, at PGA = 0.5 g: annual rate 0.05 1/yr equals that at"),
        (changed(&ys, json!([0.1, 0.0, 0.05, 0.01])), "x.json, at PGA = 0.05 g: zero here"),
        (changed(&ys, json!([0.1, 0.05, -0.1, -0.2])), "x.json, at PGA = 0.5 g: annual rate [1/yr] is -0.1"),
        (changed(&ys, json!([0, 0, 0, 0])), "x.json, PGA: a hazard curve needs at least 2 points"),
        (changed("/request/latitude", json!(null)), "x.json: \"PGA\": no longitude and latitude"),
        (changed("/request/latitude", json!(-118)), "x.json, \"PGA\": longitude -118.25, latitude -118 is not a place"),
        (
            changed("/response/metadata/xlabel", json!("Ground Motion (m/s2)")),
            "x.json, \"PGA\": the file says unit \"Ground Motion (m/s2)\", but g is declared",
        ),
        (
            changed("/response/metadata/ylabel", json!("Probability in 50 years")),
            "x.json, \"PGA\": the file says rates \"Probability in 50 years\", but annual frequency of exceedance",
        ),
        (
            changed("/response/hazardCurves/1", second()["response"]["hazardCurves"][0].clone()),
            "x.json, PGA: the mean curve of PGA at (-118.25, 34.05) is there twice; remove one of them",
        ),
    ] {
        assert!(message.starts_with(expected), "{message}");
    }
    for text in ["{", "[1", "{\"response\": 1e999}", "[]", "[[]]", "{}", "{\"response\":[null]}"] {
        let message = read(text.to_owned(), &SiteSelection::All).unwrap_err().to_string();
        assert!(message.starts_with("x.json: ") && message.len() < 200, "{text}: {message}");
    }
    let large = " ".repeat(1 << 23) + "{}";
    assert!(read(format!("{{{large}"), &SiteSelection::All).unwrap_err().to_string().contains("larger than 8388608"));
    let deep = "[".repeat(1_000_000);
    assert!(read(deep, &SiteSelection::All).unwrap_err().to_string().contains("recursion limit"));
}
