//! Table 4.1 beside ours (docs/comparison.md): 301 strengths, real records.

use std::collections::BTreeMap;
use std::path::Path;

use super::marks::hold;
use super::{quantile, range, with_real_records};
use crate::common::{repository, uplift};

/// Widths `r_90CI` of 2 % in 50 years, per cent, by measure, size and site.
type Widths = BTreeMap<(String, u32, String), f64>;

/// Minutes: 5 million analyses, 54 million resampled ordinates.
#[test]
#[ignore = "minutes: make doc-figures"]
fn widths_of_the_bands() {
    let Some(set) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let widths = |strength_above: &str| -> Widths {
        let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
        let above = format!("bootstrap.strength_above={strength_above}");
        let run = ["run", &study, "-o", "r.h5", "-q", "--set", "risk.maf_surface=false", "--set", &above];
        uplift(folder.path(), &[&run.map(str::to_owned)[..], &set].concat()).ok();
        uplift(folder.path(), &["bootstrap", "r.h5", "-q"]).ok();
        of_table(&folder.path().join("r.table-4-1.csv"))
    };
    let (all, above) = (widths("0"), widths("0.05"));
    let printed = printed();
    let of = |widths: &Widths, im: &str, size: u32| -> String {
        let [low, high] = range(widths.iter().filter(|((i, s, _), _)| i == im && *s == size).map(|(_, width)| *width));
        format!("{low:.0}–{high:.0} %")
    };
    let ratio = |size: u32| {
        let of_size = above.iter().filter(|((im, s, _), _)| im == "PGV" && *s == size);
        quantile(&of_size.map(|(key, width)| width / printed[key]).collect::<Vec<_>>(), 0.5)
    };
    let ratios = range([20, 40, 60, 80, 105].map(ratio));
    let name = |name: &str| format!("table-4-1.{name}");
    hold(
        "table-4-1",
        &[
            (name("pgv-20"), of(&all, "PGV", 20)),
            (name("pgv-105"), of(&all, "PGV", 105)),
            (name("pga-105"), of(&all, "PGA", 105)),
            (name("ratio"), format!("{:.2} to {:.2}", ratios[0], ratios[1])),
        ],
    );
}

fn of_table(path: &Path) -> Widths {
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    rows.filter(|cells| cells[2] == "0.02")
        .map(|cells| {
            let key = (cells[1].to_owned(), cells[4].parse().unwrap(), cells[0].to_owned());
            (key, cells[6].parse().unwrap())
        })
        .collect()
}

fn printed() -> Widths {
    let text = std::fs::read_to_string(repository().join("tests/reference/table_4_1.csv")).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.flat_map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        [("PGV", 3), ("PGA", 5)].map(|(im, column)| {
            ((im.to_owned(), cells[1].parse().unwrap(), cells[0].to_owned()), cells[column].parse().unwrap())
        })
    })
    .collect()
}
