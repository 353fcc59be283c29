//! `-q`: what was asked for, and nothing else, whatever the command.

use crate::common::{Finished, SmallStudy, repository};
use crate::hazard::{SITES, openquake};

/// Commands whose answer is printed, and those that are told to write files; by their first words.
const ANSWER: [&str; 32] = [
    "run",
    "merge",
    "spectrum",
    "warnings",
    "status",
    "verify",
    "check",
    "response",
    "pulse",
    "library",
    "schema",
    "bootstrap",
    "consistency",
    "influence",
    "measures",
    "design",
    "overturning",
    "risk",
    "target",
    "sweep",
    "table",
    "pushover",
    "protocol",
    "restrainer curve",
    "restrainer design",
    "records list",
    "records show",
    "records select",
    "records at-level",
    "hazard import",
    "hazard show",
    "validate",
];
const FILES: [&str; 7] = ["init", "plot", "report", "export", "records import", "records synthesize", "hazard plot"];

/// Files that are written beside an answer.
const WRITTEN: [&str; 13] = [
    "h.csv",
    "h.svg",
    "b.csv",
    "o.svg",
    "o.csv",
    "k.svg",
    "k.csv",
    "t.csv",
    "variants",
    "rows.csv",
    "validated",
    "pulses/",
    "s.bootstrap",
];

/// The subcommands that a `--help` lists, in groups or in one.
fn listed(help: &str) -> Vec<String> {
    let commands = help.split("Options:").next().unwrap();
    let names = commands.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    names.map(|line| line.split_whitespace().next().unwrap().to_owned()).filter(|name| name != "help").collect()
}

#[test]
#[ignore = "long: make test-long"]
fn nothing_but_what_was_asked_for() {
    let study = SmallStudy::new();
    for name in ["block.toml", "column-j.toml", "disc-springs.csv"] {
        std::fs::copy(repository().join("configs/structures").join(name), study.path().join(name)).unwrap();
    }
    std::fs::write(study.path().join("one.txt"), "0\n0.1\n0.4\n-0.3\n0\n").unwrap();
    study.write("library.toml", "[records.synthetic]\npairs = 2\n[block]\nsize_m = 1\nslenderness_rad = 0.1\n");
    study.write("one.csv", "u_m\n0.1\n0.2\n0.4\n");
    study.write("selected.txt", "num source recID scale_factor\n1 - SYN001 1.50\n");
    study.write("export.csv", &openquake("mean", 1.0, &SITES));
    let quiet = |arguments: &str| -> Finished {
        let words: Vec<&str> = arguments.split(' ').chain(["-q"]).collect();
        study.uplift(&words)
    };
    let structure = "block.toml --urs s.h5 --site Here";
    // a shard is no answer yet
    for shard in ["1", "2"] {
        let done = quiet(&format!("run study.toml --shard {shard}/2 -o {shard}.part")).ok();
        assert_eq!((done.stdout, done.stderr), (String::new(), String::new()));
    }
    let mut seen = Vec::new();
    for arguments in [
        "run study.toml -o s.h5",
        "merge study.toml 1.part 2.part -o m.h5",
        "spectrum s.h5",
        "spectrum s.h5 --strength 0.13 --return-period 475 --site Here",
        "warnings s.h5",
        "init first",
        "status s.h5",
        "verify s.h5",
        "check study.toml",
        "response one.txt --strength 0.2 --unit g --dt-s 0.01 --history h.csv --plot h.svg",
        "response one.txt --block --size-m 2 --slenderness 0.2 --unit g --dt-s 0.01 --history b.csv",
        "response --structure block.toml --h1 one.txt --unit g --dt-s 0.01 --history f.csv",
        "pulse -o pulses --frequencies 1:1:3 --accelerations 1:1:3 --half-widths 1:1:3 --sizes-m 1,2 --shape symmetric",
        "library library.toml -o library",
        "bootstrap s.h5",
        "consistency s.h5",
        "influence s.h5",
        "measures s.h5",
        &format!("design {structure}"),
        &format!("overturning {structure} --plot o.svg -o o.csv"),
        &format!("risk {structure} --plot k.svg -o k.csv"),
        &format!("target {structure} --vary size --from 0.1 --to 2 --overturning 2e-4 -o t.csv"),
        "sweep study.toml --over oscillator.restitution=0.9,0.95 -o variants",
        "plot s.h5 --only urs",
        "report s.h5",
        "export s.h5 --csv --json --mat",
        "table s.h5",
        "records synthesize -o set --count 2",
        "records import set -o again.csv",
        "records list again.csv",
        "records show again.csv SYN001",
        "records select again.csv --pga-g 0: -o chosen.csv",
        "records at-level selected.txt --manifest again.csv --measure pgv --level 10 -o levels.csv",
        "validate one.csv one.csv --replicates 10 -o validated.csv --plot validated.svg",
        "pushover block.toml -o rows.csv --plot h.svg",
        "protocol --sets 2 -o sets.csv",
        "restrainer curve column-j.toml -o curve.csv",
        "restrainer design column-j.toml --catalogue disc-springs.csv --capacity-m 0.5 -o stacks.csv",
        "hazard import export.csv -o mine --name here",
        "hazard show here-pgv.csv --unit cm/s --measure PGV",
        "schema structure",
        "hazard plot here-pgv.csv -o h.png --unit cm/s --measure PGV",
    ] {
        let run = quiet(arguments).ok();
        assert_eq!(run.stderr, "", "{arguments}");
        let is = |commands: &[&str]| commands.iter().any(|command| arguments.starts_with(&format!("{command} ")));
        if is(&FILES) {
            assert_eq!(run.stdout, "", "{arguments}");
        } else {
            assert!(is(&ANSWER), "{arguments}");
            assert!(!run.stdout.is_empty(), "{arguments}");
            // no list of the files that were written beside the answer
            for file in WRITTEN {
                assert!(!run.stdout.contains(file), "{arguments}\n{}", run.stdout);
            }
        }
        seen.push(arguments.to_owned());
    }
    // errors are reported
    quiet("run absent.toml").fails(3, &["absent.toml"]);
    // a run and a merge print their table alone, which is that of the result
    let [run, merged] = ["run study.toml -o again.h5", "merge study.toml 1.part 2.part -o merged.h5"];
    let table = quiet("spectrum s.h5").ok().stdout;
    assert_eq!([quiet(run).ok().stdout, quiet(merged).ok().stdout], [table.clone(), table]);
    // a command that is new is here too
    for (above, help) in [
        ("", &["--help"][..]),
        ("records ", &["records", "--help"]),
        ("hazard ", &["hazard", "--help"]),
        ("restrainer ", &["restrainer", "--help"]),
    ] {
        for name in listed(&study.uplift(help).ok().stdout) {
            let command = format!("{above}{name}");
            let known = ANSWER.iter().chain(&FILES).any(|known| *known == command);
            assert!(
                known || ["records", "hazard", "restrainer"].contains(&command.as_str()),
                "{command} is not tried with -q"
            );
            let tried = seen.iter().any(|arguments| arguments.starts_with(&format!("{command} ")));
            assert!(tried || !known, "{command}");
        }
    }
}

/// A verdict or a spectrum that is probably wrong is not told without that word.
#[test]
fn probable_mistakes_are_told_all_the_same() {
    let study = SmallStudy::new();
    let run = ["run", "study.toml", "-o", "g.h5", "-q", "--set", "gravity_m_s2=980.665"];
    for arguments in [&run[..], &["spectrum", "g.h5", "-q"]] {
        let said = study.uplift(arguments).ok().stdout;
        let warnings: Vec<&str> = said.lines().skip_while(|line| *line != "Warnings").skip(1).collect();
        let is_told = |line: &&str| line.contains("mistake? ") || line.contains(" more: ");
        assert!(!warnings.is_empty() && warnings.iter().all(is_told), "{said}");
    }
}
