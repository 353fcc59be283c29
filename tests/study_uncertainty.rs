//! Studies of oscillators that are not known exactly: `[uncertainty]` in a study file.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::common::{SMALL_STUDY, SmallStudy, array, same_bits};

const STRENGTHS: usize = 10;
const LEVELS: usize = 5;
const CELLS: usize = STRENGTHS * LEVELS;

/// Everything scatters; a capacity, so that some overturn.
fn scattering(kind: &str, count: &str) -> String {
    format!(
        "[oscillator]\ncapacity_m = 0.5\n[uncertainty]\nkind = \"{kind}\"\n{count}\n\
         [uncertainty.strength]\ndistribution = \"lognormal\"\ncoefficient_of_variation = 0.2\n\
         [uncertainty.restitution]\ndistribution = \"triangular\"\nlower = 0.8\nupper = 0.99\n\
         [uncertainty.uplift_displacement_m]\ndistribution = \"lognormal\"\npercentiles = [[5, 0.0003], [95, 0.002]]\n\
         [uncertainty.capacity_m]\ndistribution = \"normal\"\ncoefficient_of_variation = 0.1\n\
         [[uncertainty.correlation]]\nbetween = [\"strength\", \"capacity_m\"]\ncoefficient = 0.5\n"
    )
}

fn study(more: &str) -> SmallStudy {
    SmallStudy::with(&SMALL_STUDY.replace("[strengths]", &format!("{more}[strengths]")))
}

fn run(study: &SmallStudy, result: &str, more: &[&str]) -> PathBuf {
    study.uplift(&[&["run", "study.toml", "-o", result, "-q"], more].concat()).ok();
    study.path().join(result)
}

/// The study of one structure: number, factor on the strengths, restitution, displacement at uplift, capacity.
fn only(structure: &[f64]) -> Vec<String> {
    let [factor, restitution, uplift_m, capacity_m] = *structure else { panic!("{structure:?}") };
    let strengths = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8].map(|strength| (factor * strength).to_string());
    [
        format!("strengths.values=[{}]", strengths.join(",")),
        format!("oscillator.restitution={restitution}"),
        format!("oscillator.uplift_displacement_m={uplift_m}"),
        format!("oscillator.capacity_m={capacity_m}"),
    ]
    .into_iter()
    .flat_map(|setting| ["--set".to_owned(), setting])
    .collect()
}

/// What the structures of a result have, `[record]`.
fn structures(result: &Path) -> Vec<Vec<f64>> {
    let columns = ["strength_factor", "restitution", "uplift_displacement_m", "capacity_m"]
        .map(|name| array(result, &format!("/records/{name}")));
    (0..columns[0].len()).map(|record| columns.iter().map(|column| column[record]).collect()).collect()
}

/// A study with the structure of [`only`] in place of uncertain ones.
fn of_only(structure: &[f64], result: &str) -> (SmallStudy, PathBuf) {
    let study = study("[oscillator]\ncapacity_m = 0.5\n");
    let settings = only(structure);
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    let path = run(&study, result, &settings);
    (study, path)
}

#[test]
fn what_does_not_scatter_keeps_every_bit() {
    let plain = study("[oscillator]\nrestitution = 0.9\n");
    let plain = array(&run(&plain, "r.h5", &[]), "/ida/pgv/edp_m");
    for kind in ["epistemic", "aleatory"] {
        for (mean, restitution) in [("", "0.9"), ("mean = 0.9\n", "0.95")] {
            let same = study(&format!(
                "[oscillator]\nrestitution = {restitution}\n[uncertainty]\nkind = \"{kind}\"\n\
                 [uncertainty.restitution]\ndistribution = \"normal\"\ncoefficient_of_variation = 0\n{mean}"
            ));
            let found = run(&same, "r.h5", &[]);
            assert!(same_bits(&plain, &array(&found, "/ida/pgv/edp_m")), "{kind} {mean}");
        }
    }
}

/// Each record shakes the structures that the result says, and every run is that of a study of that structure alone.
#[test]
fn runs_are_those_of_each_structure_by_itself() {
    let uncertain = study(&scattering("aleatory", "draws = 3"));
    let result = run(&uncertain, "r.h5", &[]);
    let peaks = array(&result, "/ida/pgv/edp_m");
    let structures = structures(&result);
    assert_eq!((structures.len(), peaks.len()), (12, 12 * CELLS));
    assert_eq!(array_u32(&result, "/records/structure"), [1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3]);
    // no two are alike
    let mut restitutions: Vec<u64> = structures.iter().map(|of| of[1].to_bits()).collect();
    restitutions.sort_unstable();
    restitutions.dedup();
    assert_eq!(restitutions.len(), 12);
    for record in [0, 4, 11] {
        let (_folder, alone) = of_only(&structures[record], "one.h5");
        let alone = array(&alone, "/ida/pgv/edp_m");
        let motion = record / 3;
        assert!(same_bits(&peaks[record * CELLS..][..CELLS], &alone[motion * CELLS..][..CELLS]), "record {record}");
    }
}

fn array_u32(result: &Path, name: &str) -> Vec<u32> {
    uplift_labelled::LabelledReader::open(result).unwrap().array::<u32>(name).unwrap().values
}

/// One structure for each record: another one for each.
#[test]
#[ignore = "long: make test-long"]
fn one_draw_is_another_structure_for_each_record() {
    for component in ["h1", "both"] {
        let uncertain = study(&scattering("aleatory", "draws = 1"));
        let set = format!("records.component={component}");
        let result = run(&uncertain, "r.h5", &["--set", &set]);
        let structures = structures(&result);
        let records = if component == "both" { 8 } else { 4 };
        assert_eq!(structures.len(), records);
        assert!((1..records).all(|record| structures[record][1].to_bits() != structures[record - 1][1].to_bits()));
        if component == "h1" {
            let (_folder, alone) = of_only(&structures[3], "one.h5");
            let [all, alone] = [&result, &alone].map(|result| array(result, "/ida/pgv/edp_m"));
            assert!(same_bits(&all[3 * CELLS..], &alone[3 * CELLS..]));
        }
        uncertain.uplift(&["measures", "r.h5", "-q"]).ok();
    }
    // two components with two structures each are four records of a pair
    let both = study(&scattering("aleatory", "draws = 2"));
    let result = run(&both, "r.h5", &["--set", "records.component=both"]);
    both.uplift(&["bootstrap", "r.h5", "--replicates", "20", "--sizes", "16", "-q"]).ok();
    let drawn = array_u32(&result, "/bootstrap/multiplicity");
    assert!(drawn.chunks(4).all(|of_pair| of_pair.iter().all(|times| *times == of_pair[0])));
    for ask in [&["report", "r.h5", "-q"][..], &["export", "r.h5", "--csv", "-q"]] {
        both.uplift(ask).ok();
    }
    both.uplift(&["measures", "r.h5"]).fails(4, &["oscillators are uncertain", "for one structure"]);
}

/// All records shake the same structures: each has its spectrum, and the frequency of all is the mean of theirs.
#[test]
#[ignore = "long: make test-long"]
fn structures_are_branches() {
    let uncertain = study(&scattering("epistemic", "samples = 8"));
    let ran = uncertain.uplift(&["run", "study.toml", "-o", "r.h5", "--json", "-q"]).ok();
    let told: Value = serde_json::from_str(&ran.stdout).unwrap();
    let result = uncertain.path().join("r.h5");
    let structures = structures(&result);
    assert!((8..32).all(|record| structures[record] == structures[record % 8]));
    let of_structure = array(&result, "/uncertainty/pgv/Here/u_m");
    let poes = array(&result, "/urs/pgv/u_m").len() / (2 * STRENGTHS);
    let block = poes * STRENGTHS;
    assert_eq!(of_structure.len(), 8 * block);
    let mut mean_rates = vec![0.0; array(&result, "/risk/pgv/maf_per_year").len()];
    for (number, structure) in structures[..8].iter().enumerate() {
        let (_folder, alone) = of_only(structure, "one.h5");
        let spectra = array(&alone, "/urs/pgv/u_m");
        assert!(same_bits(&of_structure[number * block..][..block], &spectra[..block]), "structure {number}");
        for (mean, rate) in mean_rates.iter_mut().zip(array(&alone, "/risk/pgv/maf_per_year")) {
            *mean += rate / 8.0;
        }
    }
    let rates = array(&result, "/risk/pgv/maf_per_year");
    assert!(rates.iter().zip(&mean_rates).all(|(all, mean)| (all - mean).abs() <= 1e-12 * mean.abs()));
    // mean and fractiles, in the file and as told
    let [low, mean, high] =
        ["u05_m", "mean_m", "u95_m"].map(|name| array(&result, &format!("/uncertainty/pgv/Here/{name}")));
    for place in 0..block {
        let mut ranked: Vec<f64> = (0..8).map(|number| of_structure[number * block + place]).collect();
        let sum: f64 = ranked.iter().sum();
        ranked.sort_by(f64::total_cmp);
        assert_eq!((low[place], high[place]), (ranked[0], ranked[7]));
        assert!(mean[place] == sum / 8.0 || (mean[place] - sum / 8.0).abs() <= 1e-15 * sum);
    }
    let first = &told["structure_spread"][0];
    assert_eq!((first["site"].as_str(), first["im"].as_str()), (Some("Here"), Some("PGV")));
    assert_eq!(
        first["poe"].as_f64(),
        uplift_labelled::LabelledReader::open(&result).unwrap().axis::<f64>("poe").unwrap().first().copied()
    );
    let numbers: Vec<f64> = first["mean_m"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
    let finite: Vec<f64> = mean[..STRENGTHS].iter().copied().filter(|mean| mean.is_finite()).collect();
    assert!(finite.len() > 5 && same_bits(&numbers, &finite), "{first}");
    let details = uncertain.uplift(&["run", "study.toml", "-o", "again.h5", "--details"]).ok().stdout;
    let (_, spread) =
        details.split_once("\nSpread over the possible structures").unwrap_or_else(|| panic!("{details}"));
    // the first row of strength 0.4 is of the rarest probability
    let row = spread.lines().find(|line| line.starts_with("Here") && line.contains("  0.400  ")).unwrap();
    let cells: Vec<&str> = row.split_whitespace().rev().take(3).collect();
    let shown = |value_m: f64| if value_m.is_finite() { format!("{value_m:.4}") } else { "censored".to_owned() };
    assert_eq!(cells, [high[5], mean[5], low[5]].map(shown), "{spread}");
    // on the page, with a figure, and in the exports
    uncertain.uplift(&["report", "r.h5", "-q"]).ok();
    uncertain.uplift(&["export", "r.h5", "--json", "--csv", "--mat", "--xlsx", "-q"]).ok();
    let read = |name: &str| std::fs::read_to_string(uncertain.path().join(name)).unwrap();
    let page = read("r.html");
    let cell = format!("{:.4} to {:.4}", low[2], high[2]);
    assert!(page.contains("Spectra over the possible structures, by PGV") && page.contains(&cell), "{cell}");
    // structures are no observations
    uncertain.uplift(&["plot", "r.h5", "--only", "measures"]).fails(2, &["no figure is called measures"]);
    let json: Value = serde_json::from_str(&read("r.json")).unwrap();
    let spread = &json["spectra"][0]["spread_over_structure"];
    for (name, values) in [("u05_m", &low), ("mean_m", &mean), ("u95_m", &high)] {
        let told: Vec<f64> = spread[name].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
        let finite: Vec<f64> = values[..STRENGTHS].iter().copied().filter(|value| value.is_finite()).collect();
        assert!(same_bits(&told, &finite), "{name}");
    }
    let csv = read("r.spectra.csv");
    assert!(csv.contains(",mean_structure_m,u05_structure_m,u16_structure_m,"), "{csv}");
}

#[test]
#[ignore = "long: make test-long"]
fn threads_shards_and_earlier_results_change_no_bit() {
    for (kind, count) in [("aleatory", "draws = 2"), ("epistemic", "samples = 8")] {
        let uncertain = study(&scattering(kind, count));
        let whole = array(&run(&uncertain, "r.h5", &["--threads", "1"]), "/ida/pga/edp_m");
        for (shard, part) in [("1/2", "one"), ("2/2", "two")] {
            uncertain.uplift(&["run", "study.toml", "-o", part, "-q", "--threads", "2", "--shard", shard]).ok();
        }
        uncertain.uplift(&["merge", "study.toml", "one", "two", "-o", "s.h5", "-q"]).ok();
        let merged = uncertain.path().join("s.h5");
        assert!(same_bits(&whole, &array(&merged, "/ida/pga/edp_m")), "{kind}");
        let again = |setting: &str| -> Value {
            let ask = ["run", "study.toml", "-o", "r.h5", "-q", "--json", "--force", "--set", setting];
            uncertain.uplift(&ask).json()
        };
        assert_eq!(again("title=another")["measures"][0]["analyses_computed"], 0, "{kind}");
        // other structures are other runs
        let other = again("uncertainty.seed=2");
        assert_eq!(other["measures"][0]["analyses_computed"], other["measures"][0]["analyses"], "{kind}");
        uncertain.uplift(&["verify", "r.h5"]).ok();
    }
}

/// What a pair tells is reported once: it is drawn, and left out, with all the structures that it shakes.
#[test]
fn structures_stay_with_their_pair() {
    let uncertain = study(&scattering("epistemic", "samples = 8"));
    let result = run(&uncertain, "r.h5", &[]);
    uncertain.uplift(&["bootstrap", "r.h5", "--replicates", "30", "--sizes", "16,32", "-q"]).ok();
    let drawn = array_u32(&result, "/bootstrap/multiplicity");
    assert_eq!(drawn.len(), 2 * 30 * 32);
    assert!(drawn.chunks(8).all(|of_pair| of_pair.iter().all(|times| *times == of_pair[0])));
    // without the last pair the spectrum is that of a study without it
    uncertain.uplift(&["influence", "r.h5", "-q"]).ok();
    let without = array(&result, "/influence/pgv/u_without_m");
    let fewer = run(&uncertain, "fewer.h5", &["--set", "records.first=3"]);
    let fewer = array(&fewer, "/urs/pgv/u_m");
    let poes = fewer.len() / (2 * STRENGTHS);
    for (place, ordinates) in fewer.chunks(STRENGTHS).enumerate() {
        let (site, poe) = (place / poes, place % poes);
        for record in 24..32 {
            let at = ((site * poes + poe) * 32 + record) * STRENGTHS;
            assert!(same_bits(&without[at..][..STRENGTHS], ordinates), "{site} {poe} {record}");
        }
    }
    let table = std::fs::read_to_string(uncertain.path().join("r.influence.csv")).unwrap();
    let of = |name: &str| table.lines().filter(|line| line.contains(name)).count();
    assert!(of("SYN004") > 0 && of("SYN004:") == 0, "{table}");
}

/// A structure is shaken once by each motion, whatever the structures of the spectra: its answers are the same.
#[test]
fn structures_of_their_own_files_are_shaken_once_a_motion() {
    let uncertain = study(&scattering("epistemic", "samples = 8"));
    let plain = study("[oscillator]\ncapacity_m = 0.5\n");
    let answers: Vec<Value> = [&uncertain, &plain]
        .into_iter()
        .map(|study| {
            run(study, "r.h5", &[]);
            study.write(
                "block.toml",
                "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\nrestitution = 0.95\n",
            );
            let asked = study.uplift(&["overturning", "block.toml", "--urs", "r.h5", "--json", "-q"]).ok();
            let told: Value = serde_json::from_str(&asked.stdout).unwrap();
            told["overturning"].clone()
        })
        .collect();
    assert!(answers[0][0]["sites"][0]["per_year"].as_f64().is_some_and(|rate| rate > 0.0), "{}", answers[0]);
    assert_eq!(answers[0], answers[1]);
}

#[test]
fn mistakes_are_reported_at_once() {
    let uncertain = study(
        "[uncertainty]\nkind = \"aleatory\"\nsamples = 8\n[uncertainty.strength]\ndistribution = \"normal\"\n\
         mean = 0.3\ncoefficient_of_variation = 0.1\n[uncertainty.capacity_m]\ndistribution = \"normal\"\n\
         coefficient_of_variation = 0.1\n",
    );
    let words = [
        "3 mistakes",
        "uncertainty.samples: samples belongs to kind = \"epistemic\"",
        "a study has many strengths, and each scatters about its own value",
        "no displacement capacity: the force does not fall after uplift",
    ];
    uncertain.uplift(&["check", "study.toml"]).fails(3, &words);
    // used, and asked about
    let slip = study(
        "[uncertainty]\nsamples = 8\n[uncertainty.uplift_displacement_m]\ndistribution = \"lognormal\"\n\
         coefficient_of_variation = 6\n",
    );
    let check = slip.uplift(&["check", "study.toml"]).ok();
    assert!(
        check.stdout.contains("uncertainty.uplift_displacement_m.coefficient_of_variation is 6"),
        "{}",
        check.stdout
    );
    // what cannot be is cut off, and said
    let cut = "[uncertainty]\nsamples = 8\n[uncertainty.restitution]\ndistribution = \"normal\"\n\
        coefficient_of_variation = 0.05\n";
    let check = study(cut).uplift(&["check", "study.toml", "--details"]).ok();
    assert!(check.stdout.contains("14.6 % of the restitution are outside the possible range"), "{}", check.stdout);
    let many = study(&scattering("epistemic", "samples = 4096"));
    many.uplift(&["check", "study.toml", "--set", "records.synthetic.pairs=20", "--set", "records.first=20"])
        .fails(4, &["4096 structures under each of 20 records are 81920", "use fewer structures"]);
}
