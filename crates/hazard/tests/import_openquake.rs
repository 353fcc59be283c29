//! `OpenQuake`'s CSV: what is read, selected and refused.

use std::fmt::Write;
use std::io::{Cursor, Write as _};

use uplift_hazard::{ExportedCurve, ExportedCurves, HazardError, SiteSelection, Statistic, read_export};

const COMMENT: &str =
    "#,,,,,\"generated_by='OpenQuake engine 3.16.0', checksum=1, kind='mean', investigation_time=1.0, imt='PGA'\"\n";

fn select(text: impl Into<Vec<u8>>, selection: &SiteSelection) -> Result<Vec<ExportedCurve>, HazardError> {
    ExportedCurves::from_reader(Cursor::new(text.into()), "x.csv")?.select(selection)
}

fn all(text: impl Into<Vec<u8>>) -> Result<Vec<ExportedCurve>, HazardError> {
    select(text, &SiteSelection::All)
}

fn named(name: &str) -> SiteSelection {
    SiteSelection::Name(name.to_owned())
}

fn nearest(longitude_deg: f64, latitude_deg: f64) -> SiteSelection {
    SiteSelection::Nearest { longitude_deg, latitude_deg }
}

/// Three named sites; the one at sea has no hazard.
fn three_sites() -> String {
    format!(
        "{COMMENT}custom_site_id,lon,lat,depth,poe-0.1000000,poe-0.2000000,poe-0.4000000,poe-0.8000000\n\
         Athens,23.7,38.0,0.0,5.0E-01,2.0E-02,1.0E-03,1.0E-05\n\
         sea,25.0,36.0,0.0,0.0E+00,0.0E+00,0.0E+00,0.0E+00\n\
         athens-2,23.9,38.0,0.0,1.0E+00,2.5E-01,5.0E-02,0.0E+00\n"
    )
}

#[test]
fn rates_come_from_probabilities_in_the_investigation_time() {
    let text = three_sites().replace("=1.0,", "=50.0,");
    let [curve]: [ExportedCurve; 1] = select(text, &named("Athens")).unwrap().try_into().unwrap();
    assert_eq!((curve.site.longitude_deg, curve.site.latitude_deg), (23.7, 38.0));
    assert_eq!(curve.site.name.as_deref(), Some("Athens"));
    assert_eq!((curve.kind, curve.investigation_years), (Statistic::Mean, Some(50.0)));
    assert_eq!((curve.distance_km, curve.vs30_m_s), (None, None));
    assert_eq!((curve.dropped_zeros, curve.dropped_certain), (0, 0));
    let curve = curve.curve;
    assert_eq!((curve.measure(), curve.unit(), curve.im()), ("PGA", "g", &[0.1, 0.2, 0.4, 0.8][..]));
    assert_eq!(curve.maf()[0], std::f64::consts::LN_2 / 50.0);
    assert!((curve.maf()[1] - 0.000_404_05).abs() < 5e-9);
    assert!(curve.source().starts_with("generated_by='OpenQuake engine 3.16.0'"), "{}", curve.source());
    assert_eq!(curve.component(), None);
}

#[test]
fn the_same_export_in_many_dresses() {
    let plain = select(three_sites(), &named("Athens")).unwrap();
    let crlf = three_sites().replace('\n', "\r\n");
    let semicolons = three_sites().replace("'PGA'\"", "'PGA'").replace(',', ";").replace("\"generated", "generated");
    for text in [
        format!("\u{feff}{}", three_sites()),
        crlf,
        three_sites().replace("#,,,,,\"", "\"#,,,,,").replace("Athens", "\"Athens\""),
        three_sites().replace("#,,,,,\"", "# ").replace('\'', "\"\""),
        three_sites().replace("custom_site_id", "site_id").replace("\nsea", "\n\nsea"),
        three_sites().replace("depth", "z1pt0"),
        semicolons,
    ] {
        let read = select(text.clone(), &named("Athens")).unwrap();
        assert_eq!(read[0].curve.maf(), plain[0].curve.maf(), "{text}");
        assert_eq!((&read[0].site, &read[0].kind), (&plain[0].site, &plain[0].kind), "{text}");
    }
}

#[test]
fn an_older_export_without_kind_depth_and_names() {
    let text = "# source_model_tree_path=('b1',), gsim_tree_path=('b1',), investigation_time=1.0, imt=\"SA(1.0)\"\n\
                lon,lat,vs30,poe-1,poe-10,poe-100\n-0.1,0.2,760,1,7.69E-02,7.97E-03\n";
    let curve = &all(text).unwrap()[0];
    assert_eq!((&curve.kind, &curve.site.name, curve.vs30_m_s), (&Statistic::Unspecified, &None, Some(760.0)));
    assert_eq!((curve.curve.measure(), curve.curve.unit(), curve.curve.im()), ("SA(1.0)", "g", &[10.0, 100.0][..]));
    assert_eq!(curve.dropped_certain, 1);
}

/// Levels so low that every earthquake exceeds them share one probability: the highest of them has it. One further up
/// is a mistake.
#[test]
fn levels_that_every_earthquake_exceeds_are_one() {
    let export = |poes: &str| {
        let head = "# source_model_tree_path=('b1',), gsim_tree_path=('b1',), investigation_time=1.0, imt=\"PGA\"\n";
        all(format!("{head}lon,lat,poe-0.001,poe-0.002,poe-0.01,poe-0.1,poe-1\n-0.1,0.2,{poes}\n"))
    };
    let curve = &export("1,0.05,0.05,0.01,0.001").unwrap()[0];
    assert_eq!((curve.dropped_certain, curve.dropped_alike, curve.dropped_levels()), (1, 1, 2));
    assert_eq!(curve.curve.im(), [0.01, 0.1, 1.0]);
    let curve = &export("0.05,0.05,0.05,0.01,0.001").unwrap()[0];
    assert_eq!((curve.dropped_alike, curve.curve.im()), (2, &[0.01, 0.1, 1.0][..]));
    assert_eq!(curve.curve.maf()[0], -(-0.05_f64).ln_1p());
    assert!(export("0.06,0.05,0.05,0.01,0.001").unwrap_err().to_string().contains("equals that at"));
    assert!(export("0.05,0.05,0.05,0.05,0.05").is_err());
}

#[test]
fn kinds_and_measures() {
    let read = |kind: &str, imt: &str| {
        let text = three_sites().replace("kind='mean'", kind).replace("imt='PGA'", imt);
        select(text, &named("Athens")).map(|curves| {
            let curve = &curves[0];
            (curve.kind.clone(), curve.curve.measure().to_owned(), curve.curve.unit().to_owned())
        })
    };
    for (kind, expected) in [
        ("kind='quantile-0.15'", Statistic::Quantile(0.15)),
        ("kind='rlz-003'", Statistic::Realization(3)),
        ("kind='rlz-000'", Statistic::Realization(0)),
        ("kind=\"\"mean\"\"", Statistic::Mean),
        ("risk_kind='mean'", Statistic::Unspecified),
    ] {
        assert_eq!(read(kind, "imt='PGA'").unwrap().0, expected, "{kind}");
    }
    for kind in ["kind='std'", "kind='quantile-1.5'", "kind='quantile-NaN'", "kind='rlz--1'", "kind='rlz-99999999999'"]
    {
        let message = read(kind, "imt='PGA'").unwrap_err().to_string();
        assert!(message.starts_with("x.csv, line 1: kind \"") && message.contains("export mean"), "{message}");
    }
    for (imt, measure, unit) in [
        ("imt='PGV'", "PGV", "cm/s"),
        ("imt='SA(0.3)'", "SA(0.3)", "g"),
        ("imt=\"\"SA(0.3,10)\"\"", "SA(0.3,10)", "g"),
        ("imt='AvgSA'", "AvgSA", "g"),
        ("imt=PGA", "PGA", "g"),
    ] {
        assert_eq!(read("", imt).unwrap(), (Statistic::Unspecified, measure.to_owned(), unit.to_owned()), "{imt}");
    }
    let message = read("", "imt='MMI'").unwrap_err().to_string();
    assert!(message.starts_with("x.csv, line 1: unknown unit of intensity measure \"MMI\""), "{message}");
}

#[test]
fn names_select() {
    assert_eq!(select(three_sites(), &named(" athens-2 ")).unwrap()[0].site.longitude_deg, 23.9);
    let message = |name: &str| select(three_sites(), &named(name)).unwrap_err().to_string();
    assert_eq!(message("ATHENS"), "x.csv: no site named \"ATHENS\"; did you mean \"Athens\", \"athens-2\"?");
    assert_eq!(
        message("Paris"),
        "x.csv: no site named \"Paris\"; it names \"Athens\", \"sea\", \"athens-2\" (3 sites)"
    );
    let mut many = three_sites();
    for index in 0..1000 {
        writeln!(many, "town{index},{},40,0,0.5,0.2,0.1,0.05", 0.1 * f64::from(index)).unwrap();
    }
    let message = select(many, &named("Paris")).unwrap_err().to_string();
    assert!(message.ends_with("\"town4\", ... (1003 sites)") && message.len() < 150, "{message}");
    let unnamed = format!("{COMMENT}lon,lat,poe-1,poe-2\n1,2,0.5,0.1\n");
    let message = select(unnamed, &named("Paris")).unwrap_err().to_string();
    assert!(message.ends_with("none of its 1 sites has a name: select by longitude and latitude"), "{message}");
}

#[test]
fn the_nearest_site_comes_with_its_distance() {
    let curves = select(three_sites(), &nearest(23.85, 38.0)).unwrap();
    assert_eq!(curves.len(), 1);
    assert_eq!(curves[0].site.name.as_deref(), Some("athens-2"));
    // 0.05 degrees on the 38th parallel
    let expected_km = 6371.0 * 0.05_f64.to_radians() * 38.0_f64.to_radians().cos();
    assert!((curves[0].distance_km.unwrap() / expected_km - 1.0).abs() < 1e-6);
    assert_eq!((curves[0].dropped_zeros, curves[0].dropped_certain), (1, 1));
    assert_eq!(select(three_sites(), &nearest(23.7, 38.0)).err().map(|error| error.to_string()), None);
    // The other way to count longitudes, and a site exactly there.
    assert_eq!(select(three_sites(), &nearest(23.7 - 360.0, 38.0)).unwrap()[0].site.longitude_deg, 23.7);
    for (longitude, latitude) in [(f64::NAN, 0.0), (0.0, 91.0), (400.0, 0.0), (0.0, f64::INFINITY)] {
        let error = select(three_sites(), &nearest(longitude, latitude)).unwrap_err();
        assert!(matches!(error, HazardError::Argument { .. }), "{error}");
    }
}

#[test]
fn a_site_without_hazard_matters_only_where_it_is_wanted() {
    let message = select(three_sites(), &named("sea")).unwrap_err().to_string();
    assert_eq!(message, "x.csv, line 4: a hazard curve needs at least 2 points with a positive rate, found 0");
    assert!(all(three_sites()).is_err());
    let items: Vec<_> = ExportedCurves::from_reader(Cursor::new(three_sites()), "x.csv").unwrap().collect();
    assert_eq!(items.iter().map(Result::is_ok).collect::<Vec<_>>(), [true, false, true]);
}

#[test]
fn what_is_no_hazard_curve_is_named() {
    let values = |values: &str| format!("{COMMENT}lon,lat,depth,poe-0.1,poe-0.2,poe-0.4\n23.7,38,0,{values}\n");
    for (text, expected) in [
        (values("0.5,0.2,0.2"), "x.csv, line 3, at PGA = 0.4 g: annual rate 0.223143551314209"),
        (values("0.5,0.2,0.3"), "x.csv, line 3, at PGA = 0.4 g: annual rate 0.356674943938732"),
        (values("1.5,0.2,0.1"), "x.csv, line 3, at PGA = 0.1 g: probability of exceedance 1.5 has no annual rate"),
        (values("0.5,1,0.1"), "x.csv, line 3, at PGA = 0.2 g: probability of exceedance 1 has no annual rate"),
        (values("0.5,-0.1,0.1"), "x.csv, line 3, at PGA = 0.2 g: probability of exceedance -0.1 has no annual rate"),
        (values("0.5,0,0.1"), "x.csv, line 3, at PGA = 0.2 g: zero here, but x.csv, line 3, at PGA = 0.4 g has 0.1"),
        (values("0.5,nan,0.1"), "x.csv, line 3, at PGA = 0.2 g: \"nan\" is not a finite number"),
        (values("0.5,,0.1"), "x.csv, line 3, at PGA = 0.2 g: \"\" is not a number"),
        (values("0.5,0.1"), "x.csv, line 3: 5 columns where the column names are 6; export the file again"),
        (values("0.5,0.2,0.1,0.05"), "x.csv, line 3: 7 columns where the column names are 6"),
        (values("0.5,0.2,0.1").replace("23.7,", "?,"), "x.csv, line 3: \"?\" is not a number"),
        (
            values("0.5,0.2,0.1").replace("23.7,38", "38,123.7"),
            "x.csv, line 3: longitude 38, latitude 123.7 is not a place",
        ),
        (
            format!("{COMMENT}lon,lat,poe-1,poe-2\n1,2,0.5,0.1\n3,4,0.5,0.1\n1,2,0.4,0.1\n"),
            "x.csv, line 5: the mean curve of PGA at (1, 2) is there twice, before in line 3; remove one of them",
        ),
        (
            format!("{COMMENT}lon,lat,poe-2,poe-1\n1,2,0.5,0.1\n"),
            "x.csv, line 3, at PGA = 1 g: intensity 1 g does not exceed 2 g at x.csv, line 3, at PGA = 2 g",
        ),
        (format!("{COMMENT}lon,lat,poe-0,poe-1\n1,2,0.5,0.1\n"), "x.csv, line 3, at PGA = 0 g: intensity [g] is 0"),
    ] {
        let message = all(text.clone()).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{text}: {message}");
    }
    let flat = all(values("0.5,0.2,0.2")).unwrap_err().to_string();
    assert!(flat.contains("x.csv, line 3, at PGA = 0.2 g; rates must fall"), "{flat}");
    let twice = format!("{COMMENT}name,lon,lat,poe-1,poe-2\na,1,2,0.5,0.1\na,3,4,0.5,0.1\n");
    for selection in [named("a"), nearest(1.0, 2.0)] {
        let result = select(twice.replace("3,4", "1,2"), &selection).map(|curves| curves.len());
        assert!(matches!(result, Err(HazardError::DuplicateSite { .. })), "{result:?}");
    }
    // One name at two places is no repetition in a list of all, but no selection either.
    assert_eq!(all(twice.clone()).unwrap().len(), 2);
    assert!(matches!(select(twice, &named("a")), Err(HazardError::DuplicateSite { .. })));
}

#[test]
fn a_file_that_is_no_export_is_refused() {
    let header = "lon,lat,depth,poe-0.1,poe-0.2\n1,2,0,0.5,0.1\n";
    for (text, expected) in [
        (String::new(), "x.csv: empty"),
        ("\u{feff}\n \n".to_owned(), "x.csv: empty"),
        (COMMENT.to_owned(), "x.csv: no hazard curve in it"),
        (format!("{COMMENT}lon,lat,poe-1,poe-2\n"), "x.csv: no hazard curve in it"),
        (header.to_owned(), "x.csv: the comment line before the column names does not say measure and period"),
        (
            format!("# kind='mean', imt='PGA'\n{header}"),
            "x.csv: the comment line before the column names does not say inv",
        ),
        (
            format!("# investigation_time=1.0\n{header}"),
            "x.csv: the comment line before the column names does not say the",
        ),
        (format!("# investigation_time=one, imt='PGA'\n{header}"), "x.csv, line 1: \"one\" is not a number"),
        (format!("# investigation_time=0, imt='PGA'\n{header}"), "period [yr] is 0"),
        ("iml,maf\n1,0.2\n2,0.1\n".to_owned(), "x.csv, line 1: no columns \"poe-...\": not an OpenQuake export"),
        // The first lines of realizations_1.csv, which the engine writes beside the curves.
        (
            "#,,\"generated_by='OpenQuake engine 3.26.2', checksum=1\"\n\
             rlz_id,branch_path,weight\n0,AA~A,1.8000001e-01\n"
                .to_owned(),
            "x.csv, line 2: the realizations of a logic tree with their weights, no hazard curves",
        ),
        (format!("{COMMENT}lon,lat,0.1~PGA\n1,2,0.3\n"), "x.csv, line 2: no columns \"poe-...\""),
        (format!("{COMMENT}lon,lat,poe-PGA-0.1\n1,2,0.3\n"), "x.csv, line 2: column \"poe-PGA-0.1\": no level"),
        (format!("{COMMENT}lon,lon,poe-0.1\n1,2,0.3\n"), "x.csv, line 2: columns lon and lat must be there once"),
        ("x".repeat((1 << 20) + 1), "x.csv, line 1: a line longer than 1048576 bytes"),
    ] {
        let message = all(text).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{message}");
        assert!(message.len() < 250 && !message.contains('\u{1b}'), "{message}");
    }
    let latin = [three_sites().as_bytes(), b"\xff\n"].concat();
    let items: Vec<_> = ExportedCurves::from_reader(Cursor::new(latin), "x.csv").unwrap().collect();
    assert_eq!(items.len(), 4, "the iteration ends with the unreadable line");
    assert!(items[3].as_ref().unwrap_err().to_string().starts_with("x.csv, line 6: not UTF-8"));
}

#[test]
fn gzip_is_unpacked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("curves.csv.gz");
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    packed.write_all(three_sites().as_bytes()).unwrap();
    let packed = packed.finish().unwrap();
    std::fs::write(&path, &packed).unwrap();
    let read = read_export(&path, &named("Athens")).unwrap();
    assert_eq!(read, select(three_sites(), &named("Athens")).unwrap());
    assert_eq!(read, select(packed.clone(), &named("Athens")).unwrap());
    std::fs::write(&path, &packed[..packed.len() / 2]).unwrap();
    let message = read_export(&path, &named("Athens")).unwrap_err().to_string();
    assert!(message.contains("curves.csv.gz: cannot be read: "), "{message}");
    let message = read_export(folder.path(), &SiteSelection::All).unwrap_err().to_string();
    assert!(message.contains("not a file"), "{message}");
    let message = read_export(&folder.path().join("missing"), &SiteSelection::All).unwrap_err().to_string();
    assert!(message.contains("missing: there is no such file"), "{message}");
}

#[test]
fn sites_are_gone_through_whether_or_not_they_have_hazard() {
    let mut curves = ExportedCurves::from_reader(Cursor::new(three_sites()), "x.csv").unwrap();
    let mut sites = Vec::new();
    while let Some(site) = curves.next_site() {
        sites.push(site.unwrap());
    }
    let names: Vec<_> = sites.iter().map(|site| site.site.name.as_deref().unwrap()).collect();
    assert_eq!(names, ["Athens", "sea", "athens-2"]);
    assert!(sites.iter().all(|site| (site.measure.as_str(), &site.kind) == ("PGA", &Statistic::Mean)));
    assert_eq!(sites[1].curve.as_ref().unwrap_err().to_string().matches("line 4").count(), 1);
    assert_eq!(sites[0].curve.as_ref().ok(), select(three_sites(), &named("Athens")).unwrap().first());
    // 0.2 degrees of longitude at 38° north
    assert!((sites[0].site.distance_km(23.9, 38.0) - 17.524).abs() < 1e-3);
    // a row that cannot be read belongs to no site
    let cut = three_sites().replace(",1.0E-03,1.0E-05", "");
    let mut curves = ExportedCurves::from_reader(Cursor::new(cut), "x.csv").unwrap();
    assert!(matches!(curves.next_site(), Some(Err(HazardError::Row { .. }))));
    assert!(curves.next_site().unwrap().is_ok());
}
