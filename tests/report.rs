//! `uplift report` and `uplift plot`: what is in them, and what a browser makes of the page.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::GzDecoder;
use uplift_labelled::LabelledReader;

use crate::common::{self, SmallStudy};

/// A result with bands and influence.
fn study() -> SmallStudy {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["bootstrap", "r.h5", "--replicates", "30", "--sizes", "2,4", "-q"]).ok();
    study.uplift(&["influence", "r.h5", "-q"]).ok();
    study
}

const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n";

/// The figures of the page, in its order: the answer, how sure it is, where it comes from, what to compute with.
const ON_PAGE: [&str; 10] = [
    "urs-sites",
    "urs-pgv",
    "urs-pga",
    "bands-together",
    "consistency",
    "hazard",
    "disaggregation-pgv",
    "influence-pgv",
    "risk-pgv",
    "fits",
];
/// Those that are drawn by `uplift plot` alone.
const OTHERS: [&str; 13] = [
    "bands-pgv",
    "bands-pga",
    "initiation",
    "fragility",
    "tails-pgv",
    "tails-pga",
    "disaggregation-pga",
    "influence-pga",
    "risk-pga",
    "surface-pgv",
    "surface-pga",
    "ida",
    "measures",
];

#[test]
fn every_figure_is_drawn() {
    let study = study();
    study.uplift(&["plot", "r.h5", "-q"]).ok();
    let mut powers_of_ten = 0;
    for name in ON_PAGE.into_iter().chain(OTHERS) {
        let svg = std::fs::read_to_string(study.path().join(format!("r.figures/{name}.svg"))).unwrap();
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{name}");
        assert!(svg.contains("synthetic records"), "{name}: synthetic records are named");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
        // formulae are set as such: no 1e-3, no f_up
        let texts: String = svg.split("<text ").skip(1).filter_map(|text| text.split("</text>").next()).collect();
        assert!(!texts.contains("e-") && !texts.contains("_{") && !texts.contains("_up"), "{name}: {texts}");
        powers_of_ten += svg.matches(">10</tspan>").count();
    }
    assert!(powers_of_ten > 0);
    let hazard = std::fs::read_to_string(study.path().join("r.figures/hazard.svg")).unwrap();
    assert!(!hazard.contains("Hazard curves"), "the title is for the caption");
    study.uplift(&["plot", "r.h5", "--only", "hazard", "-o", "titled", "--title", "--format", "both"]).ok();
    let titled = std::fs::read_to_string(study.path().join("titled/hazard.svg")).unwrap();
    assert!(titled.contains("Hazard curves"));
    let image = std::fs::read(study.path().join("titled/hazard.png")).unwrap();
    let said = image.windows(4).position(|name| name == b"pHYs").expect("its resolution");
    assert_eq!(image[said + 4..said + 8], 11_811_u32.to_be_bytes(), "300 dots an inch");
    let one = study.uplift(&["plot", "r.h5", "--only", "urs-pga", "-o", "one", "--width", "single"]).ok();
    assert_eq!(one.stdout.trim(), Path::new("one").join("urs-pga.svg").display().to_string());
    study.uplift(&["plot", "r.h5", "--only", "nonsense"]).fails(2, &["nonsense", "urs-pgv"]);
    study.uplift(&["plot", "absent.h5"]).fails(4, &["absent.h5"]);
}

#[test]
fn a_report_is_one_file_without_a_network() {
    let study = study();
    study.uplift(&["run", "study.toml", "-o", "other.h5", "-q", "--set", "title=\"<b>second</b>\""]).ok();
    study.uplift(&["report", "r.h5", "other.h5", "-o", "both.html", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("both.html")).unwrap();
    let places = ON_PAGE.map(|name| page.find(&format!("id=\"r1-{name}\"")).unwrap_or_else(|| panic!("{name}")));
    assert!(places.is_sorted(), "{places:?}");
    assert!(OTHERS.iter().all(|name| !page.contains(&format!("id=\"r1-{name}\""))));
    // no bootstrap, no figure of its bands
    assert!(page.contains("id=\"r2-urs-pgv\"") && !page.contains("id=\"r2-bands-together\""));
    for word in ["r1-displacements", "r1-table-4-2", "r1-records", "study.toml", "SHA-256", ">Warnings<"] {
        assert!(page.contains(word), "{word}");
    }
    assert!(page.contains("&lt;b&gt;second") && !page.contains("<b>second"), "text of the study is text");
    // the studies differ by their titles alone, which name them; one figure has both
    assert!(page.contains("<h2 id=\"r2-title\">&lt;b&gt;second") && page.contains("id=\"all-together\""));
    assert_eq!(page.matches("Synthetic records:</strong> not for design").count(), 2, "once for each result");
    study.uplift(&["report", "r.h5", "other.h5", "-o", "again.html", "-q"]).ok();
    assert_eq!(std::fs::read(study.path().join("again.html")).unwrap(), page.as_bytes(), "the same bytes again");
    let addresses: Vec<&str> =
        page.split("http").skip(1).filter(|rest| !rest.starts_with("://www.w3.org/2000/svg")).collect();
    assert!(addresses.iter().all(|rest| rest.starts_with("-equiv")), "{addresses:.40?}");
    assert!(page.len() < 5 << 20);

    study.uplift(&["report", "r.h5", "-o", "r.h5"]).fails(2, &["html"]);
    study.uplift(&["report", "absent.h5"]).fails(4, &["absent.h5"]);
    study.uplift(&["report"]).fails(2, &["RESULT"]);
}

/// What the built page of the calculator has that a report looks for.
const CALCULATOR: &str = "<p title=\"a&amp;b\">/*</p>\n<script id=\"module\" type=\"text/plain\">AAAA</script>\n\
     <script id=\"stripes\" type=\"text/plain\">BBBB</script>";

#[test]
fn a_report_embeds_the_calculator_with_the_stripes_of_its_result() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.write("built.html", CALCULATOR);
    study.uplift(&["export", "r.h5", "--web", "-q"]).ok();
    let exported = std::fs::read_to_string(study.path().join("r.web.json")).unwrap();
    let read = || std::fs::read_to_string(study.path().join("r.html")).unwrap();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let plain = read();
    assert!(!plain.contains("<iframe") && !plain.contains("wasm") && !plain.contains("blob:"));
    study.uplift(&["report", "r.h5", "--explore", "built.html", "-q"]).ok();
    let page = read();
    let embedded = page.split_once("<iframe").unwrap().1.split_once("srcdoc=\"").unwrap().1.split_once('"').unwrap().0;
    let embedded = embedded.replace("&quot;", "\"").replace("&amp;", "&");
    let (before, after) = CALCULATOR.split_once("BBBB").unwrap();
    let packed = embedded.strip_prefix(before).unwrap().strip_suffix(after).unwrap();
    let mut stripes = String::new();
    GzDecoder::new(&*STANDARD.decode(packed).unwrap()).read_to_string(&mut stripes).unwrap();
    assert_eq!(stripes, exported.trim_end());
    assert!(page.contains("href=\"#explore\"") && page.contains("'wasm-unsafe-eval'"));
    study.uplift(&["report", "r.h5", "--explore", "built.html", "-q"]).ok();
    assert_eq!(read(), page, "the same bytes again");

    // what is not the built page: another page, the source of the page, a report, none; the report stays
    study.write("source.html", &CALCULATOR.replace("BBBB", "/*STRIPES*/"));
    study.write("empty.html", "");
    std::fs::copy(study.path().join("r.html"), study.path().join("live.html")).unwrap();
    for wrong in ["source.html", "empty.html", "live.html", "r.h5", "absent.html"] {
        study.uplift(&["report", "r.h5", "--explore", wrong]).fails(4, &[wrong, "make web", "web/dist/index.html"]);
    }
    assert_eq!(read(), page);
    study.uplift(&["report", "r.h5", "r.h5", "--explore", "built.html"]).fails(2, &["one result"]);
    study.uplift(&["report", "r.h5", "--explore", "built.html", "-o", "built.html"]).fails(2, &["built.html"]);
    assert_eq!(std::fs::read_to_string(study.path().join("built.html")).unwrap(), CALCULATOR);
}

/// The text of `page` between two marks, its tags left out.
fn text_between(page: &str, from: &str, to: &str) -> String {
    let part = page.split_once(from).unwrap_or_else(|| panic!("{from}")).1.split_once(to).unwrap().0;
    let words = part.split('<').map(|piece| piece.split_once('>').map_or(piece, |(_, text)| text));
    words.collect::<String>().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_report_leads_with_the_answer() {
    let study = study();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    let order = [
        "id=\"r1-urs-sites\"",
        "id=\"r1-summary\"",
        "class=\"alarms\"",
        "id=\"r1-urs-pgv\"",
        "id=\"r1-displacements\"",
    ];
    let places: Vec<usize> = order.iter().map(|mark| page.find(mark).unwrap_or_else(|| panic!("{mark}"))).collect();
    assert!(places.is_sorted(), "{places:?}");
    assert!(page.contains("<title>small – Here, There</title>"), "{page:.900}");
    let warnings = text_between(&page, "class=\"alarms\"", "class=\"more\"");
    assert_eq!(["mistake?:", "caution:", "note:"].map(|word| warnings.matches(word).count()).iter().sum::<usize>(), 3);
    // the first row says what the file has: the ordinates of the rarest probability and their bands of the truth
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let strengths = reader.axis::<f64>("strength").unwrap();
    let poes = reader.axis::<f64>("poe").unwrap();
    let sizes = reader.array::<f64>("/bootstrap/pgv/truth_lower_m").unwrap().shape[2];
    let rarest = (0..poes.len()).min_by(|&a, &b| poes[a].total_cmp(&poes[b])).unwrap();
    let next = (0..strengths.len())
        .min_by(|&a, &b| (strengths[a] - 0.1).abs().total_cmp(&(strengths[b] - 0.1).abs()))
        .unwrap();
    let value = |array: &str, row: usize| reader.array::<f64>(array).unwrap().values[row * strengths.len() + next];
    let table = page.split_once("id=\"r1-summary\">").unwrap().1.split_once("</tbody>").unwrap().0;
    let row: Vec<&str> = table.split_once("<tr><td>Here</td>").unwrap().1.split("</td>").collect();
    let shown = row[0].split_once('>').unwrap().1;
    let (u_m, band) = shown.strip_suffix(')').unwrap().split_once(" (").unwrap();
    let (lower, upper) = band.split_once('–').unwrap();
    let of_set = (rarest + 1) * sizes - 1;
    let expected = [
        (u_m, value("/urs/pgv/u_m", rarest)),
        (lower, value("/bootstrap/pgv/truth_lower_m", of_set)),
        (upper, value("/bootstrap/pgv/truth_upper_m", of_set)),
    ];
    for (shown, expected) in expected {
        assert!((shown.parse::<f64>().unwrap() / expected - 1.0).abs() < 0.06, "{row:?}: {expected}");
    }
}

/// The words of `page` that its reader sees at first, and those that are folded, without those in figures.
fn words(page: &str) -> [usize; 2] {
    let (mut drawn, mut folds, mut words) = (0, 0, [0, 0]);
    for piece in page.split_once("<body>").unwrap().1.split('<') {
        let (tag, text) = piece.split_once('>').unwrap_or((piece, ""));
        match tag.split_whitespace().next().unwrap_or_default() {
            "svg" | "script" => drawn += 1,
            "/svg" | "/script" => drawn -= 1,
            "details" | "/summary" => folds += 1,
            "/details" | "summary" => folds -= 1,
            _ => {}
        }
        words[usize::from(folds > 0)] += if drawn == 0 { text.split_whitespace().count() } else { 0 };
    }
    words
}

/// The page of six sites with all that is added to a result.
#[test]
fn a_report_of_six_sites_is_brief() {
    let study = crate::words::six_sites();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["consistency", "r.h5", "--repair", "-q"]).ok();
    study.uplift(&["bootstrap", "r.h5", "--replicates", "20", "-q"]).ok();
    study.uplift(&["influence", "r.h5", "-q"]).ok();
    study.write("block.toml", BLOCK);
    study.uplift(&["design", "block.toml", "--urs", "r.h5", "--site", "Baden", "-q"]).ok();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    let [open, folded] = words(&page);
    println!("{open} words open, {folded} folded");
    assert!((300..=800).contains(&open) && (1000..=2000).contains(&(open + folded)), "{open} and {folded} words");
    // what reproduces the result is saved as files: the study, and the checksums by the names of the inputs
    let saved = |name: &str| {
        let link = page.split_once(&format!("download=\"{name}\" href=\"data:text/plain;base64,")).unwrap().1;
        String::from_utf8(STANDARD.decode(link.split_once('"').unwrap().0).unwrap()).unwrap()
    };
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    assert_eq!(saved("study.toml"), reader.attribute::<String>("/", "study_toml").unwrap());
    assert!(saved("SHA256SUMS").lines().any(|line| line.ends_with("  hazard Aachen PGV")), "{}", saved("SHA256SUMS"));
}

#[test]
fn a_report_shows_hazard_consistency() {
    let study = SmallStudy::repaired();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    assert!(page.contains("Athens &amp;lt; 1") && !page.contains("Athens &lt; 1"), "text of the study is text");
    let ids: Vec<&str> = page.split(" id=\"").skip(1).map(|rest| rest.split_once('"').unwrap().0).collect();
    let distinct: std::collections::BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(ids.len(), distinct.len(), "{ids:?}");
    // a line each measure and site, its numbers those of the file
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let bias = reader.array::<f64>("/consistency/pgv/pga_bias").unwrap().values;
    let table = page.split_once("id=\"r1-consistency-table\"").unwrap().1.split_once("</tbody>").unwrap().0;
    let rows: Vec<Vec<&str>> = table.split("<tr><td>").skip(1).map(|row| row.split("</td>").collect()).collect();
    let cell = |row: usize, column: usize| rows[row][column].rsplit('>').next().unwrap();
    assert_eq!(rows.len(), 4);
    assert_eq!([1, 2, 3].map(|column| cell(1, column)), ["PGV", "PGA", "inconsistent"]);
    assert_eq!(cell(1, 7), format!("{:.2}", bias[1]), "{table}");
    assert_eq!(cell(0, 9), "–", "it could not be repaired");
    assert_eq!(cell(1, 9), "23", "as uplift consistency says");
    // below the row of the repaired site is that of the weighted records, for either measure
    let all = text_between(&page, "id=\"r1-displacements\">", "</tbody>");
    assert_eq!(all.matches(", repaired").count(), 2, "{all}");
    let summary = page.split_once("id=\"r1-summary\">").unwrap().1.split_once("</tbody>").unwrap().0;
    let repaired = summary.split("<tr><td>").find(|row| row.contains(", repaired")).unwrap();
    let u_m = reader.array::<f64>("/consistency/pgv/u_m").unwrap();
    assert_eq!(u_m.dims, ["site", "poe", "strength"]);
    let said = repaired.split("</td>").nth(1).unwrap().rsplit('>').next().unwrap();
    // the second site, 2 %, the second strength
    let expected = u_m.values[3 * 4 + 1];
    let (said, band) = said.split_once(' ').expect("a number and its band");
    assert!((said.parse::<f64>().unwrap() / expected - 1.0).abs() < 0.06, "{said}: {expected}");
    assert!(band.starts_with('(') && band.contains('–'), "{band}");

    // so does a page of other probabilities
    study.uplift(&["report", "r.h5", "-o", "asked.html", "--poe", "0.02,0.05,0.3", "-q"]).ok();
    let asked = std::fs::read_to_string(study.path().join("asked.html")).unwrap();
    assert!(asked.contains("id=\"r1-consistency\""));
    assert_eq!(text_between(&asked, "id=\"r1-displacements\">", "</tbody>").matches(", repaired").count(), 2);
}

#[test]
fn the_figure_of_consistency_has_what_there_is() {
    let study = SmallStudy::repaired();
    study.uplift(&["plot", "r.h5", "--only", "consistency", "-q"]).ok();
    let svg = std::fs::read_to_string(study.path().join("r.figures/consistency.svg")).unwrap();
    for words in ["hazard curve of the site", "scaled records", "weighted records", "rates compared"] {
        assert!(svg.contains(words), "{words}");
    }
    assert_eq!(svg.matches("scaled to PG").count(), 4, "a panel each site and measure");
    assert!(svg.contains("PGA, g") && svg.contains("PGV, cm/s") && !svg.contains("NaN"));
    // what was not repaired has no line of weighted records
    study.uplift(&["run", "study.toml", "-o", "plain.h5", "-q", "--set", "consistency.repair=\"none\""]).ok();
    study.uplift(&["plot", "plain.h5", "--only", "consistency", "-q"]).ok();
    let plain = std::fs::read_to_string(study.path().join("plain.figures/consistency.svg")).unwrap();
    assert!(plain.contains("scaled records") && !plain.contains("weighted"));
    // and no figure shows repaired spectra
    study.uplift(&["plot", "r.h5", "--only", "urs-pgv", "-q"]).ok();
    study.uplift(&["plot", "plain.h5", "--only", "urs-pgv", "-q"]).ok();
    let read = |folder: &str| std::fs::read_to_string(study.path().join(folder).join("urs-pgv.svg")).unwrap();
    assert!(read("r.figures").contains("repaired") && !read("plain.figures").contains("repaired"));
}

#[test]
fn several_results_are_named_by_what_differs() {
    let study = study();
    study.uplift(&["run", "study.toml", "-o", "bouncing.h5", "-q", "--set", "oscillator.restitution=0.9"]).ok();
    study.uplift(&["report", "r.h5", "bouncing.h5", "-o", "both.html", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("both.html")).unwrap();
    let title = |key: &str| text_between(&page, &format!("id=\"{key}-title\">"), "</h2>");
    assert_eq!([title("r1"), title("r2")], ["oscillator.restitution = 0.95", "oscillator.restitution = 0.9"]);
    let rows = text_between(&page, "id=\"differences\">", "</tbody>");
    assert!(rows.ends_with("oscillator.restitution0.950.9"), "{rows}");
    let legend = text_between(&page, "id=\"all-together\">", "</p>");
    assert!(legend.contains("oscillator.restitution = 0.9"), "{legend}");
}

#[test]
#[ignore = "long: make test-long"]
fn exports_hold_what_the_result_holds() {
    // names that a comment, a formula, a cell or an encoding could break at
    let text = common::SMALL_STUDY.replace("\"Here\"", "\"=1+1, Zürich\"").replace("\"There\"", "\"#1\"");
    let study = SmallStudy::with(&text);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["bootstrap", "r.h5", "--replicates", "30", "--sizes", "2,4", "-q"]).ok();
    study.uplift(&["export", "r.h5", "--csv", "--json", "--mat", "--xlsx"]).ok();
    study.uplift(&["export", "r.h5"]).fails(2, &["--csv", "--xlsx"]);
    study.uplift(&["export", "r.h5", "--mat", "-o", "r.h5"]).fails(2, &["r.h5", ".mat"]);
    study.uplift(&["export", "study.toml", "--mat"]).fails(4, &["study.toml"]);
    let Some(python) = common::python() else { return };
    let output = Command::new(python)
        .arg(common::repository().join("tests/python/read_export.py"))
        .args(["r.h5", "r.spectra.csv", "r.json", "r.mat", "r.xlsx"])
        .current_dir(study.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn an_export_is_the_same_bytes_whenever_it_is_made() {
    let study = study();
    let made = || -> Vec<Vec<u8>> {
        study.uplift(&["export", "r.h5", "--csv", "--json", "--mat", "--xlsx"]).ok();
        let names = ["r.spectra.csv", "r.spectra.csv-metadata.json", "r.json", "r.mat", "r.xlsx"];
        names.map(|name| std::fs::read(study.path().join(name)).unwrap()).into()
    };
    let first = made();
    assert!(first == made());
    // no clock is in the archive: time and date of its first file are the beginning of 1980
    assert_eq!((&first[4][..4], &first[4][10..14]), (&b"PK\x03\x04"[..], &[0, 0, 0x21, 0][..]));
}

/// The browser, if there is one: `UPLIFT_CHROMIUM`, else `chromium` on the path.
fn browser() -> Option<PathBuf> {
    let named = std::env::var_os("UPLIFT_CHROMIUM").map(PathBuf::from);
    let browser = named.unwrap_or_else(|| PathBuf::from("chromium"));
    if Command::new(&browser).arg("--version").output().is_ok_and(|output| output.status.success()) {
        return Some(browser);
    }
    assert!(std::env::var_os("CI").is_none(), "CI needs a browser: install chromium");
    println!("skipped: no browser (install chromium or set UPLIFT_CHROMIUM)");
    None
}

/// What the browser writes about the page at `path`: to standard output and as its log.
fn browse(browser: &Path, path: &Path, arguments: &[&str]) -> (String, String) {
    let profile = tempfile::tempdir().unwrap();
    let output = Command::new(browser)
        .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--hide-scrollbars"])
        .args(["--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=3000"])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .args(arguments)
        .arg(format!("file://{}", path.canonicalize().unwrap().display()))
        .output()
        .unwrap();
    (String::from_utf8_lossy(&output.stdout).into_owned(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Hovers over the first panel of the spectra, walks with the arrow keys, sorts a table, and leaves what it saw in the
/// page.
const PROBE: &str = r"<script>
const plot = document.querySelector('#r1-urs-pgv .plot');
const svg = plot.querySelector('svg');
const place = JSON.parse(document.querySelector('#r1-urs-pgv script').textContent)[0].place;
plot.scrollIntoView();
const box = svg.getBoundingClientRect(), zoom = box.width / svg.viewBox.baseVal.width;
const at = (pair, share) => (pair[0] + share * (pair[1] - pair[0])) * zoom;
const middle = { clientX: box.left + at(place.x_pixels, 0.5), clientY: box.top + at(place.y_pixels, 0.5) };
plot.dispatchEvent(new PointerEvent('pointermove', middle));
document.body.dataset.hover = document.getElementById('tip').textContent;
plot.dispatchEvent(new PointerEvent('pointerleave'));
plot.dispatchEvent(new PointerEvent('pointerdown', middle));
document.body.dataset.tap = document.getElementById('tip').hidden;
plot.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight' }));
document.body.dataset.keys = document.querySelector('#r1-urs-pgv .reading').textContent;
const table = document.querySelector('#r1-table-4-2 table');
const column = [...table.querySelectorAll('th')].findIndex(head => head.textContent.startsWith('c0'));
table.querySelectorAll('th')[column].querySelector('button').click();
document.body.dataset.sorted = [...table.tBodies[0].rows].map(row => row.cells[column].textContent).join(' ');
document.body.dataset.wide = document.documentElement.scrollWidth > innerWidth;
document.body.dataset.figures = document.querySelectorAll('figure .plot').length;
document.querySelectorAll('details').forEach(details => { details.open = true; });
const panels = [...document.querySelectorAll('#r1-urs-pgv .panel')].map(panel => panel.getBoundingClientRect());
document.body.dataset.stacked = panels.length > 1 && panels.every((box, at) => !at || box.top >= panels[at - 1].bottom);
const scrolled = document.querySelector('#r1-displacements .scroll');
document.body.dataset.scrolled = scrolled.scrollWidth > scrolled.clientWidth;
document.body.dataset.tables = document.querySelectorAll('.block > .scroll table').length;
</script>";

#[test]
#[ignore = "long: make test-long"]
fn a_browser_reads_the_report() {
    let Some(browser) = browser() else { return };
    let study = study();
    // a structure's bands are a figure without values to read off
    study.write("block.toml", BLOCK);
    study.uplift(&["design", "block.toml", "--urs", "r.h5", "--site", "Here", "-q"]).ok();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = study.path().join("r.html");
    let shots = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report");
    std::fs::create_dir_all(&shots).unwrap();
    for (name, size) in [("desktop", "1280,4000"), ("phone", "420,3000")] {
        let shot = shots.join(format!("{name}.png"));
        let _ = std::fs::remove_file(&shot);
        let (_, log) =
            browse(&browser, &page, &[&format!("--window-size={size}"), &format!("--screenshot={}", shot.display())]);
        assert!(std::fs::metadata(&shot).unwrap().len() > 20_000, "{log}");
        println!("screenshot: {}", shot.display());
    }

    let text = std::fs::read_to_string(&page).unwrap();
    study.write("probed.html", &text.replace("</body>", &format!("{PROBE}</body>")));
    let (dom, log) = browse(&browser, &study.path().join("probed.html"), &["--window-size=420,900", "--dump-dom"]);
    // errors, warnings and blocked requests all go to the console
    assert!(!log.contains("CONSOLE"), "{log}");
    let body = &dom[dom.find("<body").unwrap_or_default()..];
    let body = &body[..body.find('>').unwrap_or_default()];
    let said = |name: &str| {
        let start = body.find(&format!("data-{name}=\"")).unwrap_or_else(|| panic!("{name} is not in {body}"));
        body[start..].split('"').nth(1).unwrap().to_owned()
    };
    let hover = said("hover");
    assert!(hover.contains("Here: ") && hover.contains("uplift strength") && hover.contains("2 %: "), "{hover}");
    assert_eq!(said("tap"), "false", "a finger reads values off too");
    let keys = said("keys");
    assert!(keys.contains("Here: ") && keys != hover, "{keys}");
    let sorted: Vec<f64> = said("sorted").split_whitespace().filter_map(|cell| cell.parse().ok()).collect();
    assert!(sorted.len() > 3 && sorted.is_sorted(), "{sorted:?}");
    assert_eq!(said("wide"), "false", "a phone scrolls up and down only");
    assert_eq!(said("figures"), ON_PAGE.len().to_string());
    assert_eq!((said("stacked"), said("scrolled")), ("true".to_owned(), "true".to_owned()), "on a phone");
    assert_eq!(said("tables"), "7");
}
