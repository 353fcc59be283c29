//! The engine's own exports behind the project's curves, and files of old engines.

use std::path::{Path, PathBuf};

use uplift_hazard::{
    CsvOptions, ExportedCurve, HazardCurve, SiteSelection, Statistic, read_export, read_path, read_realization_weights,
};

/// Curves as the engine exported them, where they are at hand.
fn exports() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/hazard");
    if folder.join("openquake").is_dir() {
        return Some(folder);
    }
    println!("skipped: the exports of the engine are not there");
    None
}

fn all(file: &Path) -> Vec<ExportedCurve> {
    read_export(file, &SiteSelection::All).unwrap()
}

/// The largest relative deviation of levels and rates of two curves of the same length.
fn deviation(a: &HazardCurve, b: &HazardCurve) -> f64 {
    assert_eq!((a.measure(), a.unit(), a.len()), (b.measure(), b.unit(), b.len()));
    let pairs = a.im().iter().zip(b.im()).chain(a.maf().iter().zip(b.maf()));
    pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn every_two_column_curve_is_its_export() {
    let Some(folder) = exports() else {
        return;
    };
    let mut compared = 0;
    for file in std::fs::read_dir(folder.join("openquake")).unwrap().map(|entry| entry.unwrap().path()) {
        let name = file.file_name().unwrap().to_string_lossy().into_owned();
        let Some((site, rest)) =
            name.split_once("_hazard_curve-mean-").filter(|_| file.extension() == Some("csv".as_ref()))
        else {
            continue;
        };
        let measure = rest.split('_').next().unwrap();
        let table = match site {
            "AthensA" => folder.join(format!("variants/Athens_A_{measure}.csv")),
            site => folder.join(format!("{site}_{measure}.csv")),
        };
        let unit = if measure == "PGV" { "cm/s" } else { "g" };
        let table = read_path(&table, &CsvOptions::new(measure, unit)).unwrap();
        let [export]: [ExportedCurve; 1] = all(&file).try_into().unwrap();
        // The tables have six digits.
        assert!(deviation(&export.curve, &table.curve) < 6e-6, "{name}");
        assert_eq!((&export.kind, export.investigation_years), (&Statistic::Mean, Some(1.0)));
        assert_eq!(export.dropped_certain, 0);
        // Sixty levels were asked for.
        assert_eq!(export.curve.len() + export.dropped_zeros, 60);
        compared += 1;
    }
    assert_eq!(compared, 14);
}

#[test]
fn nrml_holds_what_the_csv_holds() {
    let Some(folder) = exports() else {
        return;
    };
    let folder = folder.join("openquake");
    for measure in ["PGA", "PGV"] {
        let nrml = folder.join(format!("HANDWRITTEN_hazard_curve-mean-{measure}.nrml.xml"));
        for (site, number, longitude_deg, latitude_deg) in
            [("Aachen", 8, 6.0839, 50.7753), ("Athens", 10, 23.7275, 37.9838)]
        {
            let csv = all(&folder.join(format!("{site}_hazard_curve-mean-{measure}_{number}.csv")));
            let nrml = read_export(&nrml, &SiteSelection::Nearest { longitude_deg, latitude_deg }).unwrap();
            assert_eq!((csv.len(), nrml.len()), (1, 1));
            assert_eq!(csv[0].site, nrml[0].site);
            assert!(nrml[0].distance_km.unwrap() < 1e-6);
            // Probabilities have seven digits in both; levels above 10 have eight in one and more in the other.
            assert_eq!(csv[0].curve.maf(), nrml[0].curve.maf());
            assert!(deviation(&csv[0].curve, &nrml[0].curve) < 5e-8);
        }
    }
}

/// Values printed in these files, turned into rates by hand: -ln(1 - 0.0106745) and so on.
#[test]
fn nrml_of_old_engines() {
    let Some(folder) = exports() else {
        return;
    };
    let folder = folder.join("openquake/nrml_samples_old_engine");
    for (file, kind, first_poe, points) in [
        ("classical_case_11_expected_mean.xml", Statistic::Mean, 1.067_446_017e-2_f64, 3),
        ("classical_case_12_expected_hazard_curves.xml", Statistic::Branch("b1~b1_b2".to_owned()), 7.516_647_288e-1, 3),
        (
            "hazard_curve-smltp_b1-gsimltp_b1-PGA_0363964b1d.xml",
            Statistic::Branch("b1~b1".to_owned()),
            4.596_293_576e-1,
            3,
        ),
    ] {
        let [curve]: [ExportedCurve; 1] = all(&folder.join(file)).try_into().unwrap();
        assert_eq!((curve.kind, curve.curve.len()), (kind, points), "{file}");
        assert_eq!((curve.curve.measure(), curve.curve.im()[0]), ("PGA", 0.1));
        assert_eq!(curve.curve.maf()[0], -(-first_poe).ln_1p());
    }
}

#[test]
fn the_curves_of_the_project_name_their_component() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../hazard/athens/pgv.csv");
    let curve = read_path(&file, &CsvOptions::new("PGV", "cm/s")).unwrap().curve;
    assert_eq!(curve.component(), Some("GMRotI50".parse().unwrap()));
    // What is converted keeps it.
    assert_eq!(curve.in_unit("m/s", 9.81).unwrap().component(), curve.component());
}

#[test]
fn weights_of_realizations() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("realizations_1.csv");
    let read = |text: &str| {
        std::fs::write(&file, text).unwrap();
        read_realization_weights(&file)
    };
    let comment = "#,,\"generated_by='OpenQuake engine 3.13.0'\"\n";
    let good = format!("{comment}rlz_id,branch_path,weight\n0,AA~AB,2.5E-01\n2,\"A,C~AB\",5.0E-01\n1,AB~AB,2.5E-01\n");
    for text in [good.clone(), good.replace("rlz_id", "ordinal").replace('\n', "\r\n"), format!("\u{feff}{good}")] {
        let weights = read(&text).unwrap();
        assert_eq!(weights.keys().copied().collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!((weights[&2].branch_path.as_str(), weights[&2].weight), ("A,C~AB", 0.5));
    }
    // Twelve equal weights with seven digits add up to 1.0000008.
    let twelve: Vec<String> = (0..12).map(|i| format!("\n{i:02},{i}~0,8.333334E-02")).collect();
    assert_eq!(read(&format!("rlz_id,branch_path,weight{}", twelve.concat())).unwrap().len(), 12);
    for (text, expected) in [
        (good.replace("5.0E-01", "4.0E-01"), ": the weights of its 3 realizations add up to 0.9, not to 1"),
        (String::new(), ": the weights of its 0 realizations add up to"),
        (good.replace("\n1,", "\n0,"), ", line 5: realization 0 is there twice"),
        (good.replace("\n1,", "\n-1,"), ", line 5: \"-1\" is not the number of a realization"),
        (good.replace("weight", "w"), ", line 2: the columns rlz_id, branch_path and weight must be there"),
        (good.replace(",5.0E-01", ""), ", line 4: only 2 columns"),
        (good.replace("5.0E-01", "nan"), ", line 4: \"nan\" is not a finite number"),
        (good.replace("5.0E-01", "-0.5"), ", line 4: weight -0.5 of realization 2 must be above 0"),
    ] {
        let message = read(&text).unwrap_err().to_string();
        let message = message.strip_prefix(&file.display().to_string()).unwrap();
        assert!(message.starts_with(expected), "{message}");
    }
}
