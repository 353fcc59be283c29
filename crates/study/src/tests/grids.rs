use proptest::prelude::*;

use uplift_motion::IntensityMeasure;

use super::super::grid::notation::{self, MOST_GRID_VALUES};
use super::load;

fn values(text: &str) -> Vec<f64> {
    notation::values(text).unwrap()
}

fn strengths(notation: &str) -> Vec<f64> {
    let study = load(&format!("[pgv]\n[strengths]\nvalues = {notation}")).unwrap();
    study.strengths.to_vec()
}

#[test]
fn thresholds_are_the_decimals() {
    let grid = values("0.001:0.001:3");
    assert_eq!(grid.len(), 3000);
    for (value, thousandths) in grid.iter().zip(1..) {
        let decimal = format!("{}.{:03}", thousandths / 1000, thousandths % 1000);
        assert_eq!(*value, decimal.parse::<f64>().unwrap());
    }
}

#[test]
fn levels_are_the_decimals() {
    assert_eq!(values("0.0025:0.0025:0.0225")[2], 0.0075);
    assert_eq!(values("0.025:0.005:0.195")[34], 0.195);
    assert_eq!(values("1:0.5:20")[1], 1.5);
    assert_eq!(values("1e-3:1e-3:5E-3"), [0.001, 0.002, 0.003, 0.004, 0.005]);
}

#[test]
fn strengths_are_the_fractions() {
    let grid = values("0:1/300:1");
    assert_eq!(grid.len(), 301);
    for (value, i) in grid.iter().zip(0..) {
        assert_eq!(*value, f64::from(i) / 300.0);
    }
    assert_eq!(grid[300], 1.0);
}

#[test]
fn one_number() {
    assert_eq!(values("0.0005"), [0.0005]);
    assert_eq!(values(" 1/3 "), [1.0 / 3.0]);
    assert_eq!(values("2:1:2"), [2.0]);
    assert_eq!(values("-1:0.5:1"), [-1.0, -0.5, 0.0, 0.5, 1.0]);
    // More digits than an exact range allows are no trouble for one number.
    assert_eq!(values("0.1000000000000000055511151231257827"), [0.1]);
}

#[test]
fn forms_of_a_grid_agree() {
    let table = strengths("{ start = 0, stop = 1, count = 301 }");
    assert_eq!(table, strengths("\"0:1/300:1\""));
    assert_eq!(strengths("{ start = 0.05, stop = 1.0, count = 20 }"), strengths("\"0.05:0.05:1\""));
    assert_eq!(strengths("[0.25, \"0.5\", \"0.75:0.25:1\"]"), [0.25, 0.5, 0.75, 1.0]);
    assert_eq!(strengths("0.25"), [0.25]);
    assert_eq!(strengths("{ start = 0, stop = 2, count = 3 }"), [0.0, 1.0, 2.0]);
}

#[test]
fn refused() {
    for (text, reason) in [
        ("", "not a number"),
        ("abc", "not a number"),
        ("inf", "not a number"),
        ("nan", "not a number"),
        ("1e400", "not a number"),
        ("0:1", "not a grid"),
        ("0:1:2:3", "not a grid"),
        ("0:0:1", "the step 0"),
        ("0:-1:1", "the step -1"),
        ("1:0.1:0", "stops below"),
        ("0:0.333:1", "misses its stop: after 3 steps it is at 0.999"),
        ("0:1/0:1", "divides by zero"),
        ("0:1e-12:1", "1000000000001 values"),
        ("0:1e-5:1", "100001 values"),
        ("0:1e-30:1", "too many digits"),
        ("0:1e-99999999999:1", "not a number"),
        ("0:1e-2147483648:1", "too many digits"),
        ("0:1:1e2147483647", "too many digits"),
        ("0:123456789012345678901234567890123456789012345:1", "too many digits"),
        ("0:.:1", "not a number"),
        ("0:1_0:20", "not a number"),
        ("0:+-1:2", "not a number"),
        ("0:١:2", "not a number"),
    ] {
        let fault = notation::values(text).unwrap_err();
        assert!(fault.message.contains(reason), "{text}: {}", fault.message);
        assert!(!fault.help.is_empty());
    }
    assert_eq!(values("0:1/99999:1").len(), MOST_GRID_VALUES);
}

proptest! {
    /// Any decimal range is what parsing each decimal gives.
    #[test]
    fn decimal_ranges(start in -100_000_i64..100_000, step in 1_i64..1000, count in 0_i64..200, places in 0_u32..7) {
        let scale = 10_i64.pow(places);
        let decimal = |scaled: i64| {
            let (sign, size) = (if scaled < 0 { "-" } else { "" }, scaled.abs());
            let (places, whole, part) = (places as usize, size / scale, size % scale);
            if places == 0 { format!("{sign}{size}") } else { format!("{sign}{whole}.{part:0places$}") }
        };
        let text = format!("{}:{}:{}", decimal(start), decimal(step), decimal(start + count * step));
        let grid = values(&text);
        prop_assert_eq!(i64::try_from(grid.len()).unwrap(), count + 1);
        for (value, i) in grid.iter().zip(0..) {
            prop_assert_eq!(*value, decimal(start + i * step).parse::<f64>().unwrap());
        }
    }

    /// A table of start, stop and count hits both ends with as many values.
    #[test]
    fn tables(start in 0_u32..1000, span in 1_u32..1000, count in 2_i64..500) {
        let (start, stop) = (f64::from(start) / 8.0, f64::from(start + span) / 8.0);
        let grid = values(&notation::equal_steps(start, stop, count).unwrap());
        prop_assert_eq!(i64::try_from(grid.len()).unwrap(), count);
        prop_assert_eq!(grid[0], start);
        prop_assert_eq!(*grid.last().unwrap(), stop);
    }

    /// Nothing written as a grid panics, hangs, or gives more values than allowed.
    #[test]
    fn any_text(text in "[0-9.:/eE+ -]{0,30}|\\PC{0,12}") {
        if let Ok(grid) = notation::values(&text) {
            prop_assert!(grid.len() <= MOST_GRID_VALUES && grid.iter().all(|value| value.is_finite()));
        }
    }
}

#[test]
fn default_levels_cut_to_a_curve() {
    use super::super::MeasurePlan;
    let within = |measure, least, most| MeasurePlan::default_within(measure, least, most).map(|plan| plan.line());
    let pgv = |least, most| within(IntensityMeasure::Pgv, least, most);
    assert_eq!(pgv(0.1, 300.0), None);
    assert_eq!(
        pgv(0.1, 174.3).as_deref(),
        Some("pgv.levels_cm_s = [\"0.1:0.1:0.9\", \"1:0.5:20\", \"25:5:170\", 174.3]")
    );
    assert_eq!(
        pgv(0.25, 200.0).as_deref(),
        Some("pgv.levels_cm_s = [0.25, \"0.3:0.1:0.9\", \"1:0.5:20\", \"25:5:200\"]")
    );
    assert_eq!(pgv(1.7, 200.0).as_deref(), Some("pgv.levels_cm_s = [1.7, \"2:0.5:20\", \"25:5:200\"]"));
    assert_eq!(pgv(500.0, 600.0), None);
    // what a conversion leaves of an end is no level, and none lies outside the curve
    let ends = |least, most| pgv(least, most).map(|line| line.replace("pgv.levels_cm_s = ", ""));
    assert_eq!(ends(0.1, 0.57 * 100.0).as_deref(), Some("[\"0.1:0.1:0.9\", \"1:0.5:20\", \"25:5:55\", 56.9999]"));
    assert_eq!(ends(0.1, 1.15 * 100.0).as_deref(), Some("[\"0.1:0.1:0.9\", \"1:0.5:20\", \"25:5:110\", 114.999]"));
    assert_eq!(ends(0.1, 1.1 * 100.0).as_deref(), Some("[\"0.1:0.1:0.9\", \"1:0.5:20\", \"25:5:110\"]"));
    // a single one of a range is a level, too
    assert_eq!(ends(0.85, 27.0).as_deref(), Some("[0.85, 0.9, \"1:0.5:20\", 25, 27]"));
    for hundredths in 50..200 {
        let (least, most) = (f64::from(hundredths) / 100.0 * 0.3, f64::from(hundredths) / 100.0 * 100.0);
        let plan = MeasurePlan::default_within(IntensityMeasure::Pgv, least, most).unwrap();
        assert!(plan.levels.iter().all(|level| (least..=most).contains(level)), "{least} {most} {plan:?}");
        assert!(plan.levels[0] < least * 1.000_01 && *plan.levels.last().unwrap() > most * 0.999_98, "{plan:?}");
    }
    let line = within(IntensityMeasure::Pga, 0.00233, 1.997).unwrap();
    assert_eq!(
        line,
        "pga.levels_g = [0.00233, \"0.0025:0.0025:0.0225\", \"0.025:0.005:0.195\", \"0.2:0.05:1.95\", 1.997]"
    );
    // what is suggested is a grid that a study takes
    let study = load(&line).unwrap();
    let [plan] = &study.measures[..] else { panic!("one measure") };
    let cut = MeasurePlan::default_within(IntensityMeasure::Pga, 0.00233, 1.997).unwrap();
    // and then they are the study's own
    assert_eq!((plan.measure, &plan.levels, plan.is_cut), (cut.measure, &cut.levels, !cut.is_cut));
    assert!(!plan.is_default() && load("[pga]\n").unwrap().measures[0].is_default());
}

#[test]
fn grids_on_the_command_line() {
    use super::super::{Grid, GridError};
    let parse = |text: &str| text.parse::<Grid>().map(|grid| grid.to_vec());
    assert_eq!(parse("2"), Ok(vec![2.0]));
    assert_eq!(parse("0.5, 1:1/4:1.5 ,3").as_deref(), Ok(&[0.5, 1.0, 1.25, 1.5, 3.0][..]));
    let told = |text: &str| parse(text).map_err(|error: GridError| error.to_string()).unwrap_err();
    assert!(told("1,2,2").contains("2 follows 2, but a grid must increase: sort the values"));
    assert!(told("1,,2").contains("\"\" is not a number") && told("").contains("is not a number"));
    assert!(told("0:1e-9:1").contains("at most 100000 values"));
}
