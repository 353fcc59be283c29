//! The table `[uncertainty]` of a structure file.

use std::path::Path;

use uplift_structure::UncertainQuantity;
use uplift_uncertainty::{Family, Sampling};

use super::load_structure;
use crate::{AnyStudy, Place, Structure, Study, UncertaintyKind};

const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 7.0\nmass_kg = 9000\n";

fn mistakes(uncertainty: &str) -> Vec<String> {
    let error = load_structure(&format!("{BLOCK}{uncertainty}")).unwrap_err();
    error.mistakes().iter().map(ToString::to_string).collect()
}

#[test]
fn the_example() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/structures/uncertain-pier.toml");
    let structure = Structure::load(&file).unwrap();
    let of = structure.uncertainty.unwrap();
    assert_eq!(
        (of.kind, of.sampling, of.samples, of.draws, of.seed),
        (UncertaintyKind::Epistemic, Sampling::Sobol, 64, 10, 1)
    );
    assert_eq!(of.quantities, UncertainQuantity::ALL);
    let [strength, restitution, uplift, capacity] = of.vector.distributions() else { panic!("{of:?}") };
    // the median of a lognormal quantity of mean m is m/√(1 + δ²)
    let median = structure.system.strength() / (1.0 + 0.06_f64 * 0.06).sqrt();
    assert!((strength.quantile(0.5) / median - 1.0).abs() < 1e-9);
    assert_eq!(restitution.family(), Some(Family::Triangular));
    assert!((uplift.quantile(0.95) - 0.012).abs() < 1e-9 && (uplift.quantile(0.5) - 0.006).abs() < 1e-9);
    assert!((capacity.quantile(0.5) - 1.2 / (1.0 + 0.06_f64 * 0.06).sqrt()).abs() < 1e-9);
    // in the order of the quantities
    assert_eq!(of.vector.copula().groups(), [vec![0, 3], vec![1], vec![2]]);
}

#[test]
fn a_key_of_the_other_kind_is_refused() {
    for (kind, key, other) in [("epistemic", "draws", "aleatory"), ("aleatory", "samples", "epistemic")] {
        let found = mistakes(&format!(
            "[uncertainty]\nkind = \"{kind}\"\n{key} = 9\n[uncertainty.strength]\ndistribution = \"normal\"\n\
             coefficient_of_variation = 0.1\n"
        ));
        assert_eq!(found, [format!("uncertainty.{key}: {key} belongs to kind = \"{other}\"")]);
    }
}

#[test]
fn a_structure_without_the_table_is_certain() {
    assert_eq!(load_structure(BLOCK).unwrap().uncertainty, None);
}

/// All of them at once, beside those of the structure itself.
#[test]
fn every_mistake_is_reported() {
    let found = mistakes(
        "mass_t = 9\n[uncertainty]\nkind = \"random\"\nsamples = 60\n[uncertainty.strength]\n\
         coefficient_of_variation = 0.1\n[uncertainty.restitution]\ndistribution = \"normal\"\n\
         coefficient_of_variation = 0.1\n[uncertainty.capacity_m]\ndistribution = \"lognormal\"\nlower = 0.1\n\
         [uncertainty.uplift_displacement_m]\ndistribution = \"normal\"\nmean = 0.0005\n\
         coefficient_of_variation = 1.5\n[uncertainty.width_m]\nmean = 1\n",
    );
    for what in [
        "mass_t: unknown key `mass_t`",
        "uncertainty.kind: unknown kind: the text \"random\"",
        "uncertainty.samples: Sobol' points fill a range evenly only in powers of two, and 60 is none",
        "uncertainty.strength.distribution: how is it distributed?",
        "uncertainty.restitution.mean: its mean is missing",
        "uncertainty.capacity_m: one of its limits is missing",
        "uncertainty.capacity_m: only a uniform and a triangular distribution have limits",
        "uncertainty.uplift_displacement_m: uplift displacement cannot be distributed so: 25 % of it is outside",
        "uncertainty.width_m: unknown section `width_m`",
    ] {
        assert!(found.iter().any(|told| told.starts_with(what)), "{what}: {found:#?}");
    }
    assert_eq!(found.len(), 9, "{found:#?}");
}

#[test]
fn mistakes_stand_where_their_keys_do() {
    let text = format!(
        "{BLOCK}[uncertainty]\nsamples = 20\n[uncertainty.restitution]\ndistribution = \"triangular\"\nlower = 0.9\n\
         upper = 0.97\nmode = 0.5\n"
    );
    let error = load_structure(&text).unwrap_err();
    for (line, key) in [(6, "samples"), (11, "restitution.mode")] {
        let found = error.mistakes().iter().find(|found| found.key == format!("uncertainty.{key}")).unwrap();
        assert!(matches!(found.place, Place::File { line: at, .. } if at == line), "{found:?}");
        assert!(found.help.as_ref().is_some_and(|help| !help.contains("velocity after an impact")), "{found:?}");
    }
}

#[test]
fn what_does_not_go_together_is_refused() {
    let strength = "[uncertainty.strength]\ndistribution = \"normal\"\ncoefficient_of_variation = 0.1\n";
    let capacity = "[uncertainty.capacity_m]\ndistribution = \"normal\"\ncoefficient_of_variation = 0.1\n";
    let pair = |between: &str, coefficient: &str| {
        format!("{strength}{capacity}[[uncertainty.correlation]]\nbetween = [{between}]\ncoefficient = {coefficient}\n")
    };
    for (text, what) in [
        ("[uncertainty]\n".to_owned(), "nothing here is uncertain"),
        (format!("{strength}mean = 0.1\npercentiles = [[5, 1], [95, 2]]\n"), "its scatter is given twice"),
        ("[uncertainty.strength]\ndistribution = \"normal\"\n".to_owned(), "nothing says how uncertain it is"),
        (pair("\"strength\", \"capacity_m\"", "1.0"), "the value is 1"),
        (pair("\"strength\", \"strength\"", "0.5"), "correlation of strength with strength: name two"),
        (pair("\"strength\", \"restitution\"", "0.5"), "restitution is not uncertain"),
        (pair("\"uplift_displacement_m\", \"restitution\"", "0.5"), "uplift_displacement_m and restitution are not"),
        // a quantity that is told to be wrong is not told to be missing
        (pair("\"strength\", \"capacity_m\"", "0.5").replacen("normal", "norm", 1), "norm"),
        (pair("\"strength\"", "0.5"), "1 quantities"),
        (
            "[uncertainty.restitution]\ndistribution = \"normal\"\nmean = 0\ncoefficient_of_variation = 0.1\n"
                .to_owned(),
            "the mean is 0: it must be other than 0",
        ),
        (
            "[uncertainty.restitution]\ndistribution = \"uniform\"\nmean = 0.95\ncoefficient_of_variation = 0.1\n"
                .to_owned(),
            "it reaches from 0.7855 to 1.115, but",
        ),
        (
            "[uncertainty.strength]\ndistribution = \"uniform\"\nlower = 0.1\nmode = 0.2\nupper = 0.3\n".to_owned(),
            "a uniform distribution has no mode",
        ),
        (
            "[uncertainty.restitution]\ndistribution = \"uniform\"\nlower = 0.9\nupper = 1.1\n".to_owned(),
            "it reaches from 0.9 to 1.1, but the possible range is 0 to 1",
        ),
        (
            "[uncertainty.strength]\ndistribution = \"normal\"\npercentiles = [[95, 0.1], [5, 0.2]]\n".to_owned(),
            "give two that rise together",
        ),
    ] {
        let found = mistakes(&text);
        assert!(found.len() == 1 && found[0].contains(what), "{what}: {found:#?}");
    }
    let stays = "kind = \"restrained-frame\"\ncolumns = 4\nwidth_m = 0.2\nheight_m = 1.6\ncolumn_mass_kg = 100\n\
                 deck_mass_kg = 9000\ntendon_stiffness_n_m = 1e8\ntendon_anchorage = \"foundation\"\n";
    let error = load_structure(&format!("{stays}{capacity}")).unwrap_err();
    assert!(error.mistakes()[0].to_string().contains("does not fall after uplift"), "{error:?}");
}

/// Numbers that are probably in another unit are used, and asked about with their line.
#[test]
fn likely_slips_are_asked_about() {
    let warnings = |text: &str| -> Vec<String> {
        load_structure(&format!("{BLOCK}{text}")).unwrap().warnings.iter().map(|warning| warning.what.clone()).collect()
    };
    let quantity = |key: &str, rest: &str| format!("[uncertainty.{key}]\ndistribution = \"lognormal\"\n{rest}\n");
    for (text, starts) in [
        (
            quantity("strength", "coefficient_of_variation = 6"),
            "line 7, uncertainty.strength.coefficient_of_variation is 6",
        ),
        (
            quantity("uplift_displacement_m", "percentiles = [[5, 0.003], [95, 12]]"),
            "line 7, uncertainty.uplift_displacement_m.percentiles[1][1] is 12 m",
        ),
        (
            quantity("strength", "percentiles = [[5, 8], [95, 12]]"),
            "line 7, uncertainty.strength.percentiles[0][1] is 8;",
        ),
        (
            quantity("capacity_m", "mean = 800\ncoefficient_of_variation = 0.1"),
            "line 7, uncertainty.capacity_m.mean is 800 m",
        ),
        (
            quantity("strength", "percentiles = [[0.05, 0.1], [0.95, 0.12]]"),
            "line 7, uncertainty.strength.percentiles are those of 0.05 and 0.95 %; were shares meant?",
        ),
    ] {
        let found = warnings(&text);
        assert!(found.iter().any(|told| told.starts_with(starts)), "{starts}: {found:#?}");
    }
    assert_eq!(warnings(&quantity("strength", "coefficient_of_variation = 0.06")), Vec::<String>::new());
    // a file that is refused for such a number says so
    let text = quantity("restitution", "percentiles = [[5, 90], [95, 97]]");
    let error = load_structure(&format!("{BLOCK}{text}")).unwrap_err();
    assert!(error.mistakes()[0].to_string().contains("percentiles[0][1] is 90; usual is"), "{error:?}");
}

/// A mean far from what the structure has is asked about; where the file does not say what it has, there is nothing to
/// be far from.
#[test]
fn a_mean_far_from_the_structure_raises_a_warning() {
    let warnings = |text: &str| -> Vec<String> {
        load_structure(text).unwrap().warnings.iter().map(|warning| warning.what.clone()).collect()
    };
    let mean = |key: &str, mean: f64| {
        format!("[uncertainty.{key}]\ndistribution = \"lognormal\"\nmean = {mean}\ncoefficient_of_variation = 0.1\n")
    };
    let own = load_structure(BLOCK).unwrap().system.strength();
    for (factor, words) in [(10.0, "10 times the "), (0.1, "a 10th of the ")] {
        let found = warnings(&format!("{BLOCK}{}", mean("strength", factor * own)));
        let starts = "line 7, uncertainty.strength.mean is ";
        assert!(found.len() == 1 && found[0].starts_with(starts) && found[0].contains(words), "{found:#?}");
    }
    assert_eq!(warnings(&format!("{BLOCK}{}", mean("strength", 2.0 * own))), Vec::<String>::new());
    let uplift = mean("uplift_displacement_m", 0.006);
    assert_eq!(warnings(&format!("{BLOCK}{uplift}")), Vec::<String>::new());
    let found = warnings(&format!("{BLOCK}uplift_displacement_m = 0.0005\n{uplift}"));
    assert!(found[0].contains("12 times the 0.0005 m that the structure has"), "{found:#?}");
}

/// A study file that says all that can be uncertain, and what of it is reported again in its result.
#[test]
fn an_uncertain_study_is_written_and_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("study.toml");
    for (kind, count) in [("epistemic", "samples = 16"), ("aleatory", "draws = 4")] {
        let text = format!(
            "[oscillator]\ncapacity_m = 0.5\n[pgv]\n[uncertainty]\nkind = \"{kind}\"\nsampling = \"latin-hypercube\"\n\
             {count}\nseed = 7\n[uncertainty.strength]\ndistribution = \"lognormal\"\ncoefficient_of_variation = 0.2\n\
             [uncertainty.restitution]\ndistribution = \"triangular\"\nlower = 0.8\nupper = 0.99\nmode = 0.9\n\
             [uncertainty.uplift_displacement_m]\ndistribution = \"lognormal\"\n\
             percentiles = [[5, 0.0003], [95, 0.002]]\n[uncertainty.capacity_m]\ndistribution = \"normal\"\n\
             mean = 0.45\ncoefficient_of_variation = 0.1\n[[uncertainty.correlation]]\n\
             between = [\"capacity_m\", \"strength\"]\ncoefficient = 0.5\n"
        );
        std::fs::write(&file, text).unwrap();
        let own = Study::load(&file, &[]).unwrap();
        let written = own.to_toml().unwrap();
        let AnyStudy::UniformRisk(again) = Study::stored(&written).unwrap() else { panic!() };
        assert_eq!(own.uncertainty, again.uncertainty, "{written}");
        assert_eq!(own.uncertainty.as_ref().unwrap().quantities, UncertainQuantity::ALL);
    }
}
