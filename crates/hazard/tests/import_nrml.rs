//! NRML: what is read and refused.

use std::fmt::Write;
use std::io::Cursor;

use uplift_hazard::{ExportedCurve, ExportedCurves, HazardError, SiteSelection, Statistic};

fn select(text: impl Into<Vec<u8>>, selection: &SiteSelection) -> Result<Vec<ExportedCurve>, HazardError> {
    ExportedCurves::from_reader(Cursor::new(text.into()), "x.xml")?.select(selection)
}

fn all(text: impl Into<Vec<u8>>) -> Result<Vec<ExportedCurve>, HazardError> {
    select(text, &SiteSelection::All)
}

/// A group of curves with the attributes given; one curve a position and its probabilities.
fn group(attributes: &str, curves: &[(&str, &str)]) -> String {
    let mut text = format!("<hazardCurves {attributes}>\n<IMLs>0.1 0.2\n 0.4</IMLs>\n");
    for (position, poes) in curves {
        writeln!(
            text,
            "<hazardCurve><gml:Point><gml:pos>{position}</gml:pos></gml:Point>\n<poEs>{poes}</poEs></hazardCurve>"
        )
        .unwrap();
    }
    text + "</hazardCurves>\n"
}

fn document(groups: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<nrml xmlns:gml=\"http://www.opengis.net/gml\" \
         xmlns=\"http://openquake.org/xmlns/nrml/0.4\">\n{groups}</nrml>\n"
    )
}

const MEAN: &str = "IMT=\"PGA\" investigationTime=\"50.0\" statistics=\"mean\"";

#[test]
fn several_groups_in_one_document() {
    let sa = "IMT=\"SA\" saPeriod=\"0.025\" saDamping=\"5.0\" investigationTime=\"1\" statistics=\"quantile\" \
              quantileValue=\"0.15\"";
    let branch = "IMT=\"PGV\" investigationTime=\"1\" sourceModelTreePath=\"b1\" gsimTreePath=\"b1_b2\"";
    let curves = [("6.1 50.8", "0.5 0.02 0.001"), ("23.7 38.0", "1 0.25 0.1")];
    let text = document(&(group(MEAN, &curves) + &group(sa, &curves) + &group(branch, &curves[..1])));
    let read = all(text.clone()).unwrap();
    assert_eq!(read.len(), 5);
    let first = &read[0];
    assert_eq!((first.site.longitude_deg, first.site.latitude_deg), (6.1, 50.8));
    assert_eq!((&first.kind, first.investigation_years), (&Statistic::Mean, Some(50.0)));
    assert_eq!((first.curve.measure(), first.curve.unit()), ("PGA", "g"));
    assert_eq!(first.curve.im(), [0.1, 0.2, 0.4]);
    assert_eq!(first.curve.maf()[0], std::f64::consts::LN_2 / 50.0);
    assert_eq!((read[1].dropped_zeros, read[1].dropped_certain), (0, 1));
    assert_eq!((&read[2].kind, read[2].curve.measure()), (&Statistic::Quantile(0.15), "SA(0.025)"));
    assert_eq!((&read[4].kind, read[4].curve.unit()), (&Statistic::Branch("b1~b1_b2".to_owned()), "cm/s"));

    // All curves of the nearest site, and of it alone.
    let near = select(text.clone(), &SiteSelection::Nearest { longitude_deg: 6.0, latitude_deg: 51.0 }).unwrap();
    assert_eq!(near.iter().map(|curve| curve.curve.measure()).collect::<Vec<_>>(), ["PGA", "SA(0.025)", "PGV"]);
    assert!(near.iter().all(|curve| curve.site == first.site && curve.distance_km == near[0].distance_km));
    let message = select(text, &SiteSelection::Name("Athens".to_owned())).unwrap_err().to_string();
    assert!(message.contains("none of its 5 sites has a name"), "{message}");
}

#[test]
fn the_same_document_in_many_dresses() {
    let plain = document(&group(MEAN, &[("6.1 50.8", "0.5 0.02 0.001")]));
    let expected = all(plain.clone()).unwrap();
    for text in [
        format!("\u{feff}{plain}"),
        plain.replace('\n', "\r\n"),
        plain.replace("nrml/0.4", "nrml/0.5"),
        plain.replace("<?xml version=\"1.0\" encoding=\"utf-8\"?>", ""),
        plain.replace("0.5 0.02", "0.5 <!-- two --> 0.02"),
        plain.replace("6.1 50.8", " 6.1\n50.8 -0.1 "),
        plain.replace("gml:", "").replace("xmlns:gml", "xmlns:x"),
        plain.replace(" xmlns=\"http://openquake.org/xmlns/nrml/0.4\"", ""),
    ] {
        assert_eq!(all(text.clone()).unwrap(), expected, "{text}");
    }
    let damped = plain.replace("IMT=\"PGA\"", "IMT=\"SA\" saPeriod=\"1.0\" saDamping=\"10\"");
    assert_eq!(all(damped).unwrap()[0].curve.measure(), "SA(1.0,10.0)");
}

#[test]
fn what_is_wrong_is_named() {
    let one = |attributes: &str, poes: &str| document(&group(attributes, &[("6.1 50.8", poes)]));
    let good = "0.5 0.02 0.001";
    for (text, expected) in [
        (one(MEAN, "0.5 0.02"), "x.xml, line 6: 2 poEs for 3 IMLs"),
        (one(MEAN, "0.5 x 0.1"), "x.xml, line 6, at PGA = 0.2 g: \"x\" is not a number"),
        (one(MEAN, "0.5 1.2 0.1"), "x.xml, line 6, at PGA = 0.2 g: probability of exceedance 1.2"),
        (one(MEAN, "0.5 0.2 0.2"), "x.xml, line 6, at PGA = 0.4 g: annual rate"),
        (one(MEAN, "0 0 0"), "x.xml, line 6: a hazard curve needs at least 2 points with a positive rate, found 0"),
        (one(MEAN, good).replace("6.1 50.8", "6.1"), "x.xml, line 6: hazardCurve without the longitude and latitude"),
        (one(MEAN, good).replace("6.1 50.8", "6.1 95"), "x.xml, line 6: longitude 6.1, latitude 95 is not a place"),
        (one(MEAN, good).replace("poEs", "poes"), "x.xml, line 6: hazardCurve without poEs"),
        (one(MEAN, good).replace("IMLs", "imls"), "x.xml, line 3: hazardCurves must have one element IMLs"),
        (one("IMT=\"PGA\"", good), "x.xml, line 3: hazardCurves without attribute investigationTime"),
        (one("investigationTime=\"1\"", good), "x.xml, line 3: hazardCurves without attribute IMT"),
        (one("IMT=\"SA\" investigationTime=\"1\"", good), "x.xml, line 3: IMT SA without saPeriod"),
        (one("IMT=\"MMI\" investigationTime=\"1\"", good), "x.xml, line 3: unknown unit of intensity measure \"MMI\""),
        (one(&MEAN.replace("mean", "std"), good), "x.xml, line 3: statistics \"std\" is neither mean nor quantile"),
        (one(&MEAN.replace("mean", "quantile"), good), "x.xml, line 3: statistics \"quantile\" is neither"),
        (
            document(&group(MEAN, &[("6.1 50.8", good), ("6.1 50.8", good)])),
            "x.xml, line 8: the mean curve of PGA at (6.1, 50.8) is there twice, before in line 6",
        ),
        (document(""), "x.xml: no hazardCurve in hazardCurves"),
        (one(MEAN, good).replace("</nrml>", ""), "x.xml: not XML that can be read"),
        (format!("<!DOCTYPE x [<!ENTITY a \"b\">]>{}", group(MEAN, &[])), "x.xml: not XML that can be read"),
    ] {
        let message = all(text.clone()).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{text}: {message}");
        assert!(message.len() < 250, "{message}");
    }
}

/// Documents made to cost much are refused or read in proportion to their size.
#[test]
fn hostile_documents() {
    let deep = "<a>".repeat(400_000);
    assert!(all(deep.clone() + &"</a>".repeat(400_000)).is_err());
    assert!(all(deep).is_err());
    let nodes = format!("<a>{}</a>", "<b/>".repeat(1_100_000));
    assert!(all(nodes).unwrap_err().to_string().contains("not XML that can be read"));
    // What a parser would take gigabytes or hours for.
    let numbered =
        |before: &str, after: &str| (0..200_000).map(|i| format!("{before}{i}{after}")).collect::<Vec<_>>().concat();
    for text in [
        "<".repeat(60 << 20),
        format!("<a{}/>", "=".repeat(60 << 20)),
        format!("<a{}/>", numbered(" b", "=''")),
        format!("<a{}/>", numbered(" b", " =\n\">\"")),
        format!("<a>{}", numbered("<a xmlns:b", "='c'>")),
    ] {
        assert!(all(text).unwrap_err().to_string().starts_with("x.xml: more XML elements"));
    }
    let large = vec![b'<'; (64 << 20) + 1];
    assert!(all(large).unwrap_err().to_string().starts_with("x.xml: larger than 67108864 bytes"));
    let sites: Vec<(String, &str)> =
        (0..20_000).map(|i| (format!("{} 40", 0.001 * f64::from(i)), "0.5 0.2 0.1")).collect();
    let sites: Vec<(&str, &str)> = sites.iter().map(|(position, poes)| (position.as_str(), *poes)).collect();
    assert_eq!(all(document(&group(MEAN, &sites))).unwrap().len(), 20_000);
}

/// A document of NRML 0.3: fields of curves with what is common to them beside.
fn old_document(processing: &str, fields: &str) -> String {
    format!(
        "<?xml version='1.0'?>\n<nrml xmlns:gml=\"http://www.opengis.net/gml\" \
         xmlns=\"http://openquake.org/xmlns/nrml/0.3\" gml:id=\"n\">\n<hazardResult gml:id=\"r\">\n\
         <config><hazardProcessing {processing}/></config>\n{fields}</hazardResult>\n</nrml>\n"
    )
}

/// A field with the attributes given, its measure, and a curve at each position.
fn field(attributes: &str, imt: &str, curves: &[(&str, &str)]) -> String {
    let mut text = format!("<hazardCurveField gml:id=\"f\" {attributes}>\n<IML IMT=\"{imt}\">0.1 0.2 0.4</IML>\n");
    for (position, poe) in curves {
        writeln!(
            text,
            "<HCNode gml:id=\"h\">\n<site><gml:Point srsName=\"epsg:4326\"><gml:pos>{position}</gml:pos></gml:Point>\
             </site>\n<hazardCurve><poE>{poe}</poE></hazardCurve></HCNode>"
        )
        .unwrap();
    }
    text + "</hazardCurveField>\n"
}

#[test]
fn fields_of_version_0_3() {
    let curves = [("6.1 50.8", "0.5 0.02 0.001"), ("23.7 38.0", "0.9 0.25 0.1")];
    let fields = field("statistics=\"mean\"", "PGA", &curves)
        + &field("statistics=\"quantile\" quantileValue=\"0.16\"", "SA[0.2s]", &curves[..1])
        + &field("statistics=\"median\"", "SA", &curves[..1])
        + &field("endBranchLabel=\"1_1\"", "PGA", &curves[..1]);
    let processing = "investigationTimeSpan=\"50.0\" IDmodel=\"m\" saPeriod=\"1\" saDamping=\"5\"";
    let read = all(old_document(processing, &fields)).unwrap();
    let kinds: Vec<(&str, &Statistic)> = read.iter().map(|curve| (curve.curve.measure(), &curve.kind)).collect();
    assert_eq!(
        kinds,
        [
            ("PGA", &Statistic::Mean),
            ("PGA", &Statistic::Mean),
            ("SA(0.2)", &Statistic::Quantile(0.16)),
            ("SA(1.0)", &Statistic::Quantile(0.5)),
            ("PGA", &Statistic::Branch("1_1".to_owned())),
        ]
    );
    assert_eq!((read[1].site.longitude_deg, read[1].site.latitude_deg), (23.7, 38.0));
    assert_eq!(read[0].investigation_years, Some(50.0));
    assert_eq!(read[0].curve.im(), [0.1, 0.2, 0.4]);
    assert_eq!(read[0].curve.maf()[0], std::f64::consts::LN_2 / 50.0);
    // the same numbers in the newer version are the same curve
    let newer = all(document(&group(MEAN, &curves[..1]))).unwrap();
    assert_eq!(read[0].curve.maf(), newer[0].curve.maf());
}

#[test]
fn fields_that_do_not_say_enough() {
    let curve = [("6.1 50.8", "0.5 0.02 0.001")];
    let plain = field("statistics=\"mean\"", "PGA", &curve);
    let time = "investigationTimeSpan=\"50\"";
    for (processing, fields, expected) in [
        ("IDmodel=\"m\"", plain.clone(), "hazardProcessing without investigationTimeSpan"),
        (time, plain.replace(" IMT=\"PGA\"", ""), "IML without attribute IMT"),
        (time, plain.replace("IML", "IMLs"), "hazardCurveField must have one element IML"),
        (time, plain.replace("\"PGA\"", "\"SA\""), "IMT SA without saPeriod"),
        (time, plain.replace("\"PGA\"", "\"SA[x]\""), "SA[x]"),
        (time, plain.replace("\"mean\"", "\"mode\""), "statistics \"mode\" is neither mean, median nor quantile"),
        (time, plain.replace("<poE>", "<poEs>").replace("</poE>", "</poEs>"), "HCNode without poE"),
        (time, plain.replace("6.1 50.8", ""), "HCNode without the longitude and latitude"),
        (time, plain.replace("0.5 0.02", "0.02"), "2 poE for 3 levels"),
        (time, plain.replace("HCNode", "Node"), "no HCNode in a hazardCurveField"),
    ] {
        let message = all(old_document(processing, &fields)).unwrap_err().to_string();
        assert!(message.contains(expected), "{expected}: {message}");
    }
    let lone = plain.clone();
    let message = all(format!("<nrml xmlns:gml=\"g\">{lone}</nrml>")).unwrap_err().to_string();
    assert!(message.contains("no hazardProcessing"), "{message}");
}
