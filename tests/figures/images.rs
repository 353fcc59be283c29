//! The images of the documents: drawn again and compared as SVG, which depends on no font; `UPDATE_DOCS=1` writes them.

use uplift_plot::{Axis, Figure, Look, Panel, Series, Tone, Width, svg};

use super::base_widths::LITTLE_ELSE;
use super::{ordinates, range};
use crate::common::{repository, uplift};

pub fn compare(name: &str, drawn: &str) {
    let path = repository().join("docs/images").join(name);
    // said of the program that drew it: none of the picture's numbers
    let drawn = without_description(drawn);
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(&path, &drawn).unwrap();
    }
    let held = std::fs::read_to_string(&path).unwrap();
    assert!(held == drawn, "docs/images/{name} is another picture now (UPDATE_DOCS=1 writes it)");
}

/// A drawing without the `<desc>` that names the commit.
fn without_description(svg: &str) -> String {
    match (svg.find("<desc>"), svg.find("</desc>")) {
        (Some(begin), Some(end)) => format!("{}{}", &svg[..begin], &svg[end + "</desc>".len()..]),
        _ => svg.to_owned(),
    }
}

/// The picture of README.md: spectra of 2 % in 50 years by PGV, embedded records, every sixth strength.
#[test]
#[ignore = "long: make test-long"]
fn spectra_of_six_sites() {
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let mut run = vec!["run", &study, "-o", "r.h5", "-q"];
    for setting in ["risk.maf_surface=false", "risk.poe=[0.02]", "strengths.values=0:1/50:1", "pga.levels_g=[0.1, 0.2]"]
    {
        run.extend(["--set", setting]);
    }
    uplift(folder.path(), &run).ok();
    let mut rows = ordinates(&folder.path().join("r.urs.csv"));
    rows.retain(|row| row.im == "PGV");
    // in the order of the curves, from above
    let mut sites: Vec<&str> = rows.iter().map(|row| row.site.as_str()).collect();
    sites.dedup();
    let largest_m = |site: &str| range(rows.iter().filter(|row| row.site == site).map(|row| row.u_m))[1];
    sites.sort_by(|a, b| largest_m(b).total_cmp(&largest_m(a)));
    let line = |(place, site): (usize, &&str)| {
        let points = rows.iter().filter(|row| row.site == *site);
        let name = if *site == "Focsani" { "Focşani" } else { site };
        Series::line(name, points.map(|row| (row.strength, row.u_m)).collect(), Tone::Distinct(place))
    };
    let x = Axis::linear("uplift strength f_up/(m g)").between(0.0, 1.0);
    let panel =
        Panel::lines("", x, Axis::linear("displacement demand, m"), sites.iter().enumerate().map(line).collect());
    let figure = Figure {
        id: "urs".to_owned(),
        title: "Uniform risk spectra, 2 % in 50 years, by PGV".to_owned(),
        caption: String::new(),
        remark: "synthetic records".to_owned(),
        panels: vec![panel],
        columns: 1,
    };
    compare("urs.svg", &svg(&figure, Look { width: Width::Double, title: true }).unwrap().svg);
}

/// The picture of docs/pulses.md.
#[test]
#[ignore = "long: make test-long"]
fn displacement_over_acceleration_and_base_width() {
    let folder = tempfile::tempdir().unwrap();
    uplift(folder.path(), &[&["pulse", "-o", "p", "-q"][..], &LITTLE_ELSE].concat()).ok();
    let drawn = std::fs::read_to_string(folder.path().join("p/by-half-width.svg")).unwrap();
    compare("pulses.svg", &drawn);
}
