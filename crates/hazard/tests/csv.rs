//! Tables as they come, and what is said about those that cannot be used.

use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use uplift_hazard::{
    ComponentDefinition, CsvCurve, CsvOptions, Declared, HazardCurve, HazardError, SecondColumn, read_csv, read_path,
};

fn read(text: &str) -> Result<CsvCurve, HazardError> {
    read_csv(text, "site.csv", &CsvOptions::new("PGV", "cm/s"))
}

fn message(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

#[test]
fn the_same_table_in_many_dresses() {
    let plain = read("iml,maf\n1,0.2\n2,0.1\n").unwrap().curve;
    assert_eq!((plain.im(), plain.maf()), (&[1.0, 2.0][..], &[0.2, 0.1][..]));
    assert_eq!((plain.measure(), plain.unit(), plain.source()), ("PGV", "cm/s", "site.csv"));
    for text in [
        "\u{feff}iml,maf\r\n1,0.2\r\n2,0.1\r\n",
        "iml,maf\r1,0.2\r2,0.1",
        "IML ; MAF\n\n 1 ; 0.2 \n2;0.1\n\n",
        "pgv_cm_s\tafe\n1\t2e-1\n2\t1e-1",
        "PGV [cm/s], MAF [1/yr]\n1, 0.2\n2, 0.1",
        "PGV cm/s,annual rate\n1,0.2\n2,0.1",
        "maf,im\n0.2,1\n0.1,2",
        "iml;maf\r\n1,0;0,2\r\n2;1,0E-1\r\n",
        "\u{feff}\"iml\"\t\"maf\"\n\"1,000\"\t\"0,2\"\n2\t0,100",
        "\"iml\",\"maf\"\n\"1\",\"0.2\"\n2,0.1,,,",
        "im rate\n1 0.2\n2   0.1",
    ] {
        assert_eq!(read(text).unwrap().curve, plain, "{text:?}");
    }
}

#[test]
fn comments_become_the_source() {
    let curve =
        read("# site: X; IM: PGV [cm/s], geometric mean\n#second\niml,maf\n1,0.2\n# late\n2,0.1\n").unwrap().curve;
    assert_eq!(curve.source(), "site: X; IM: PGV [cm/s], geometric mean\nsecond\nlate");
}

#[test]
fn probabilities_need_their_period() {
    let text = "iml,poe\n1,0.5\n2,0.02\n";
    assert_eq!(
        message(text),
        "site.csv, line 2: probabilities of exceedance need the years that they refer to: \"PoE in 50 years\" as the \
         column's name, or years = 50 beside the curve in the study"
    );
    let options = CsvOptions { years: Some(50.0), ..CsvOptions::new("PGV", "cm/s") };
    let curve = read_csv(text, "site.csv", &options).unwrap().curve;
    assert_eq!(curve.maf()[0], std::f64::consts::LN_2 / 50.0);
    assert!((curve.maf()[1] - 0.000_404_05).abs() < 5e-9);
    // the head may say it, and must not say another one
    let head = text.replace("iml,poe", "PGV (cm/s),PoE in 50 years");
    assert_eq!(read_csv(&head, "site.csv", &CsvOptions::new("PGV", "cm/s")).unwrap().curve.maf(), curve.maf());
    let other = CsvOptions { years: Some(1.0), ..CsvOptions::new("PGV", "cm/s") };
    let contradiction = read_csv(&head, "site.csv", &other).unwrap_err().to_string();
    assert!(contradiction.contains("line 1") && contradiction.contains("50 years"), "{contradiction}");
    let options = CsvOptions { years: Some(-1.0), ..CsvOptions::new("PGV", "cm/s") };
    assert!(matches!(read_csv(text, "site.csv", &options), Err(HazardError::Argument { .. })));
}

#[test]
fn a_table_without_names_needs_a_declaration() {
    let text = "1,0.2\n2,0.1\n";
    assert!(message(text).contains("site.csv, line 1: no column names before the first numbers"));
    let with = |second_column| CsvOptions {
        second_column: Some(second_column),
        years: Some(1.0),
        ..CsvOptions::new("PGV", "cm/s")
    };
    let rates = read_csv(text, "site.csv", &with(SecondColumn::AnnualRate)).unwrap().curve;
    assert_eq!(rates.maf(), [0.2, 0.1]);
    let poes = read_csv(text, "site.csv", &with(SecondColumn::Probability)).unwrap().curve;
    assert_eq!(poes.maf()[0], -(-0.2_f64).ln_1p());
    let against =
        read_csv("iml,poe\n1,0.2\n2,0.1", "site.csv", &with(SecondColumn::AnnualRate)).unwrap_err().to_string();
    assert_eq!(
        against,
        "site.csv, line 1: the file says second column probabilities of exceedance, but annual rates is declared; \
         correct the one that is wrong"
    );
}

#[test]
fn return_periods_are_annual_rates_written_otherwise() {
    for name in ["return_period", "Return period [years]", "Tr", "return_period_yr"] {
        let text = format!("iml,{name}\n1,10\n2,475\n3,2475\n");
        let declared = CsvOptions { second_column: Some(SecondColumn::AnnualRate), ..CsvOptions::new("PGV", "cm/s") };
        for options in [CsvOptions::new("PGV", "cm/s"), declared] {
            let curve = read_csv(&text, "site.csv", &options).unwrap().curve;
            assert_eq!(curve.maf(), [0.1, 1.0 / 475.0, 1.0 / 2475.0], "{name}");
        }
    }
    assert!(message("iml,return_period\n1,10\n2,0\n").contains("line 3: the return period is 0: write years above"));
    assert!(message("iml,return_period\n1,475\n2,10\n").contains("site.csv"), "they must rise");
    assert!(message("iml,return_period_days\n1,475\n2,10\n").contains("return_period (years)"));
}

#[test]
fn rows_without_information_are_dropped_and_counted() {
    let read = read("iml,maf\n1,0.2\n2,0.1\n3,0\n4,0.0\n5,0e0\n").unwrap();
    assert_eq!((read.curve.len(), read.dropped_zeros, read.dropped_certain), (2, 3, 0));
    let options = CsvOptions { years: Some(1.0), ..CsvOptions::new("PGV", "cm/s") };
    let read = read_csv("iml,poe\n1,1\n2,1.000000\n3,0.9\n4,0.5\n5,0\n", "site.csv", &options).unwrap();
    assert_eq!((read.curve.im(), read.dropped_zeros, read.dropped_certain), (&[3.0, 4.0][..], 1, 2));

    assert_eq!(
        message("iml,maf\n1,0.2\n2,0\n3,0.1\n"),
        "site.csv, line 3: zero here, but site.csv, line 4 has 0.1 again; only zeros at the end can be dropped, so \
         correct or remove this row"
    );
    assert!(message("iml,maf\n1,0\n2,0\n").contains("at least 2 points with a positive rate, found 0"));
    let certain_later = read_csv("iml,poe\n1,0.9\n2,1\n3,0.5\n", "site.csv", &options).unwrap_err().to_string();
    assert!(
        certain_later.starts_with("site.csv, line 3: probability of exceedance 1 has no annual rate"),
        "{certain_later}"
    );
    let per_cent = read_csv("iml,poe\n1,90\n2,50\n", "site.csv", &options).unwrap_err().to_string();
    assert!(per_cent.ends_with("divide by 100 if these are per cent, or name the column maf if they are annual rates"));
    assert!(read_csv("iml,poe\n1,0.9\n2,-0.1\n", "site.csv", &options).unwrap_err().to_string().contains("line 3"));
}

#[test]
fn contradictions_name_both_sides() {
    assert_eq!(
        message("# IM: PGV [m/s], geometric mean\niml,maf\n1,0.2\n2,0.1\n"),
        "site.csv, line 1: the file says unit \"m/s\", but \"cm/s\" is declared; correct the one that is wrong"
    );
    assert_eq!(
        message("iml,maf\n1,0.2\n2,0.1\n# IM: PGA [g]"),
        "site.csv, line 4: the file says measure \"PGA\", but \"PGV\" is declared; correct the one that is wrong"
    );
    assert!(message("pgv_m_s,maf\n1,0.2\n2,0.1\n").contains("unit \"m_s\", but \"cm/s\""));
    assert!(message("pga,maf\n1,0.2\n2,0.1\n").contains("measure \"pga\", but \"PGV\""));
    // The same unit in another spelling is no contradiction.
    assert!(read("# IM: pgv [cm s-1]\niml_cm_s,maf\n1,0.2\n2,0.1\n").is_ok());
}

#[test]
fn every_broken_line_is_named() {
    for (text, expected) in [
        (
            "iml,maf\n0,1,0,2\n",
            "site.csv, line 2: 4 columns where 2 are expected; if these are decimal commas, write decimal points",
        ),
        (
            "iml;maf\n0,1;0.2\n",
            "site.csv: line 2: 0,1 has a decimal comma, and 0.2 (line 2) a decimal point: write one of them throughout",
        ),
        ("iml;maf\n1,500;3\n", "site.csv: line 2: 1,500 may be 1.500 or 1500: write decimal points"),
        ("iml,maf\n1,0.2\n2,x\n", "site.csv, line 3: \"x\" is not a number"),
        ("iml,maf\n1,0.2\n2,nan\n", "site.csv, line 3: \"nan\" is not a finite number"),
        ("iml,maf\n1,0.2\n2\n", "site.csv, line 3: 1 column where 2 are expected; keep one column"),
        ("lon,lat,depth,poe-0.1,poe-0.2\n", "site.csv, line 1: 5 columns where 2 are expected; keep one column"),
        (
            "iml,sigma\n1,0.2\n",
            "site.csv, line 1: column name \"sigma\" is not known: write e.g. \"PGV [cm/s],PoE in 50 years\"; for",
        ),
        ("PGV [cm/s]\n1\n2\n", "site.csv: one column: two are needed, the intensity and its rate or probability"),
        ("1\n2\n", "site.csv: one column: two are needed"),
        (
            "iml,maf\n0,1,0,2\n0,2,0,1\n0,3,0,05\n",
            "site.csv, line 2: 4 columns where 2 are expected; if these are decimal commas, write decimal points, or \
             semicolons between the columns; and 2 more lines",
        ),
        (
            "iml,maf\n1,1\n2,1\n",
            "site.csv, line 3: annual rate 1 1/yr equals that at site.csv, line 2; rates must fall. These \
             look like probabilities. Name the column `PoE in 50 years`",
        ),
        ("maf,poe\n1,0.2\n", "site.csv, line 1: columns \"maf\" and \"poe\": one must hold levels"),
        ("iml,maf\n1,0.2\n1,0.1\n", "site.csv, line 3: intensity 1 cm/s does not exceed 1 cm/s at site.csv, line 2"),
        ("iml,maf\n\n1,0.2\n# c\n2,0.2\n", "site.csv, line 5: annual rate 0.2 1/yr equals that at site.csv, line 3"),
        ("iml,maf\n1,0.2\n2,-0.1\n", "site.csv, line 3: annual rate [1/yr] is -0.1"),
        ("iml,maf\n1,0.2\n", "site.csv: a hazard curve needs at least 2 points"),
        ("", "site.csv: a hazard curve needs at least 2 points with a positive rate, found 0"),
        ("# only a comment", "site.csv: a hazard curve needs at least 2 points"),
    ] {
        let message = message(text);
        assert!(message.starts_with(expected), "{text:?}: {message}");
    }
}

#[test]
fn messages_stay_short_and_printable() {
    let long = format!("iml,maf\n1,{}\u{7}\n", "x".repeat(100_000));
    assert!(message(&long).len() < 150);
    assert!(message("iml,maf\n1,\u{1b}[31m\n").contains("\\u{1b}"));
    assert!(message(&format!("iml,maf\n{}\n", "1,".repeat(100_000))).contains("more than 8 columns"));
}

/// A name of many underscores is gone through once, not once an underscore.
#[test]
fn long_names_are_refused_soon() {
    let begin = Instant::now();
    let long = "_".repeat(4_000_000);
    for text in [format!("# im: a{long}\niml,maf\n"), format!("a{long},maf\n1,0.2\n2,0.1\n")] {
        assert!(message(&text).len() < 250);
        assert_eq!(Declared::in_table(&text).1, None);
    }
    assert!(begin.elapsed() < Duration::from_secs(10), "{:?}", begin.elapsed());
}

#[test]
fn files_that_cannot_be_read() {
    let options = CsvOptions::new("PGV", "cm/s");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let error = read_path(&folder.join("missing.csv"), &options).unwrap_err().to_string();
    assert!(error.contains("missing.csv: there is no such file"), "{error}");
    assert!(read_path(folder, &options).unwrap_err().to_string().contains("not a file"));
    let file = std::env::temp_dir().join(format!("uplift-hazard-{}.csv", std::process::id()));
    std::fs::write(&file, b"iml,maf\n1,0.2\n2,0.1 \xff\n").unwrap();
    let latin = read_path(&file, &options);
    std::fs::write(&file, vec![b'\n'; (4 << 20) + 1]).unwrap();
    let large = read_path(&file, &options);
    std::fs::write(&file, b"iml,maf\n1,0.2\n2,0.1\n").unwrap();
    let good = read_path(&file, &options);
    std::fs::remove_file(&file).unwrap();
    assert!(latin.unwrap_err().to_string().ends_with("not UTF-8 text; save it as \"CSV UTF-8\""));
    assert!(large.unwrap_err().to_string().contains("larger than 4194304 bytes"));
    assert_eq!(good.unwrap().curve.len(), 2);
}

#[test]
fn the_component_is_what_the_comments_say() {
    let component =
        |comments: &str| read(&format!("{comments}\niml,maf\n1,0.2\n2,0.1\n")).map(|read| read.curve.component());
    for (comments, expected) in [
        ("# site: X; IM: PGV [cm/s], geometric mean (GMRotI50), rock", Some(ComponentDefinition::GmRotI50)),
        ("# IM: PGV [cm/s], geometric mean", Some(ComponentDefinition::GeometricMean)),
        ("# component: RotD50", Some(ComponentDefinition::RotD50)),
        ("# IM: PGV, RotD100\n# horizontal component: RotD100", Some(ComponentDefinition::RotD100)),
        ("# site: X; larger, near the coast", None),
        ("", None),
    ] {
        assert_eq!(component(comments).unwrap(), expected, "{comments}");
    }
    assert_eq!(
        component("# IM: PGV, RotD50\n# component: larger").unwrap_err().to_string(),
        "site.csv, line 2: the file says component larger component, but RotD50 is declared; correct the one that is \
         wrong"
    );
}

#[test]
fn files_packed_with_gzip() {
    let folder = tempfile::tempdir().unwrap();
    let pack = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        let file = std::fs::File::create(&path).unwrap();
        let mut packed = flate2::write::GzEncoder::new(file, flate2::Compression::best());
        packed.write_all(text).unwrap();
        packed.finish().unwrap();
        path
    };
    let options = CsvOptions::new("PGV", "cm/s");
    let path = pack("pgv.csv.gz", b"iml,maf\n1,0.2\n2,0.1\n");
    assert_eq!(read_path(&path, &options).unwrap().curve.maf(), [0.2, 0.1]);
    // Unpacked it is too large, however small it lies on the disk.
    let path = pack("large.csv.gz", &vec![b'\n'; 64 << 20]);
    assert!(path.metadata().unwrap().len() < 1 << 20);
    assert!(read_path(&path, &options).unwrap_err().to_string().contains("larger than 4194304 bytes"));
    std::fs::write(&path, b"\x1f\x8b\x08").unwrap();
    assert!(read_path(&path, &options).unwrap_err().to_string().contains("cannot be read"));
}

#[test]
fn what_a_table_says_of_itself() {
    let named = |measure: Option<&str>, unit: Option<&str>| (measure.map(str::to_owned), unit.map(str::to_owned));
    let (pgv, cm_per_s) = (Some("PGV"), Some("cm/s"));
    for (text, measure, unit) in [
        ("# IM: PGV [cm/s], geometric mean\niml,maf\n1,2\n", pgv, cm_per_s),
        ("pgv_cm_s;maf\n1;2\n", pgv, cm_per_s),
        ("\u{feff}PGV [cm/s],poe\n1,2\n", pgv, cm_per_s),
        ("iml,maf\n1,0.2\n", None, None),
        ("# IM: PGV\niml,maf\n1,0.2\n", pgv, None),
        ("PGV,rate\n1,0.2\n", pgv, None),
        // units that nothing is measured in
        ("[cm/s],maf\n1,0.2\n", None, None),
        ("__cm_s,maf\n1,0.2\n", None, None),
        ("", None, None),
    ] {
        assert_eq!(Declared::in_table(text), named(measure, unit), "{text}");
    }
}

#[test]
fn what_is_written_is_read_to_the_bit() {
    let levels: Vec<f64> = (1..40).map(|i| f64::from(i) / 3.0).collect();
    let rates: Vec<f64> = levels.iter().map(|x| 0.1 / (x * x)).collect();
    let curve =
        HazardCurve::new("PGV", "cm/s", "x", levels, rates).unwrap().with_component(Some(ComponentDefinition::RotD50));
    let text = curve.to_csv(&["site: A; somewhere".to_owned(), "two\nlines".to_owned()]);
    let read = read_csv(&text, "written", &CsvOptions::new("PGV", "cm/s")).unwrap().curve;
    assert_eq!((read.im(), read.maf(), read.component()), (curve.im(), curve.maf(), curve.component()));
    assert_eq!(read.source(), "site: A; somewhere\ntwo\nlines\nIM: PGV [cm/s]; component: RotD50");
    // Levels of RotD100 are those of RotD50 times a ratio, at the same rates.
    let converted = read.converted(1.2, ComponentDefinition::RotD100).unwrap();
    assert_eq!(converted.im()[0], curve.im()[0] * 1.2);
    assert_eq!(converted.maf(), curve.maf());
    assert_eq!(converted.component(), Some(ComponentDefinition::RotD100));
    assert!(read.converted(0.0, ComponentDefinition::RotD100).is_err());
}
