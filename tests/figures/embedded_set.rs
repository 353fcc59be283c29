//! The embedded record set beside real records: the motions, and what they make of an oscillator
//! (docs/synthetic-motions.md). Real ones: those that `with_real_records` takes.

use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{Accelerogram, IntensityMeasure, RecordPair, STANDARD_GRAVITY_M_S2, geometric_mean, scale_factor};
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, respond};

use super::marks::hold;
use super::{quantile, real_pairs};

type Measure<'a> = &'a dyn Fn(&RecordPair) -> f64;
/// Name in marks, decimals, measure.
type Row = (&'static str, usize, Box<dyn Fn(&RecordPair) -> f64>);

fn pgv_over_pga(pair: &RecordPair) -> f64 {
    let of = |measure: IntensityMeasure| measure.pair_value(pair, STANDARD_GRAVITY_M_S2);
    of(IntensityMeasure::Pgv) / of(IntensityMeasure::Pga)
}

fn mean_of(measure: fn(&Accelerogram) -> f64) -> impl Fn(&RecordPair) -> f64 {
    move |pair| geometric_mean(measure(&pair.h1), measure(&pair.h2))
}

fn quantiles(set: &[RecordPair], measure: Measure<'_>) -> [f64; 5] {
    let values: Vec<f64> = set.iter().map(measure).filter(|value| value.is_finite()).collect();
    [0.05, 0.25, 0.5, 0.75, 0.95].map(|level| quantile(&values, level))
}

/// Rows of the first table.
fn measures() -> [Row; 8] {
    let meta = |key: &'static str| move |pair: &RecordPair| pair.metadata[key].parse().unwrap_or(f64::NAN);
    let peak = |measure: IntensityMeasure| move |pair: &RecordPair| measure.pair_value(pair, STANDARD_GRAVITY_M_S2);
    [
        ("pgv-over-pga", 0, Box::new(pgv_over_pga)),
        ("d5-75", 1, Box::new(mean_of(Accelerogram::d5_75_s))),
        ("d5-95", 1, Box::new(mean_of(Accelerogram::d5_95_s))),
        ("pga", 2, Box::new(peak(IntensityMeasure::Pga))),
        ("pgv", 0, Box::new(peak(IntensityMeasure::Pgv))),
        ("magnitude", 1, Box::new(meta("magnitude"))),
        ("rrup", 0, Box::new(meta("rrup_km"))),
        ("vs30", 0, Box::new(meta("vs30"))),
    ]
}

/// Standard deviation in ln of a component's peak about the geometric mean of its pair.
fn scatter(set: &[RecordPair], peak: fn(&Accelerogram) -> f64) -> f64 {
    let squares: f64 = set.iter().map(|pair| (peak(&pair.h1) / peak(&pair.h2)).ln().powi(2)).sum();
    0.5 * (squares / set.len() as f64).sqrt()
}

fn statistics(source: &str, set: &[RecordPair]) -> Vec<(String, String)> {
    let row = |(name, digits, measure): &Row| {
        let printed = quantiles(set, measure).map(|value| format!("{value:.digits$}"));
        (format!("{source}.{name}"), printed.join(" / "))
    };
    measures().iter().map(row).collect()
}

/// Peaks of first components at a strength and level, m: 16, 50 and 84 %.
fn demands_m(set: &[RecordPair], strength: f64, measure: IntensityMeasure, level: f64) -> [f64; 3] {
    let oscillator = Oscillator::zsbe(strength).unwrap();
    let peak_m = |pair: &RecordPair| {
        let scale = scale_factor(level, measure.pair_value(pair, STANDARD_GRAVITY_M_S2)).unwrap();
        let excitation = Excitation::new(pair.h1.dt_s(), pair.h1.acceleration_m_s2()).unwrap();
        respond(&oscillator, &excitation.scaled(scale).unwrap(), FreeVibration::FirstPeak).peak_displacement_m
    };
    let peaks_m: Vec<f64> = set.iter().map(peak_m).collect();
    [0.16, 0.5, 0.84].map(|level| quantile(&peaks_m, level))
}

/// Rows of the second table.
const ROWS: [(f64, IntensityMeasure, f64); 5] = [
    (0.1, IntensityMeasure::Pgv, 30.0),
    (0.3, IntensityMeasure::Pgv, 60.0),
    (0.5, IntensityMeasure::Pgv, 30.0),
    (0.1, IntensityMeasure::Pga, 0.3),
    (0.3, IntensityMeasure::Pga, 0.6),
];

fn three(values_m: [f64; 3]) -> String {
    let value = |value: f64| if value < 0.01 { format!("{value:.4}") } else { format!("{value:.3}") };
    values_m.map(value).join(" / ")
}

#[test]
#[ignore = "long: make test-long"]
fn the_embedded_set() {
    let set = generate(&SyntheticSetOptions::default()).unwrap();
    let mut computed = statistics("embedded", &set);
    let [pga, pgv] = [Accelerogram::pga_m_s2, Accelerogram::pgv_m_s].map(|peak| scatter(&set, peak));
    let [shortest, .., longest] = quantiles(&set, &pgv_over_pga);
    let candidate: u64 = set[104].metadata["event"].rsplit(' ').next().unwrap().parse().unwrap();
    computed.extend([
        ("embedded.scatter".to_owned(), format!("{pga:.2} and {pgv:.2}")),
        ("embedded.spread".to_owned(), format!("{:.1}", longest / shortest)),
        ("embedded.candidates".to_owned(), (candidate + 1).to_string()),
        ("embedded.long".to_owned(), format!("{:.0} s", quantiles(&set, &mean_of(Accelerogram::d5_95_s))[4])),
    ]);
    for (row, (strength, measure, level)) in ROWS.into_iter().enumerate() {
        let demands_m = demands_m(&set, strength, measure, level);
        computed.push((format!("embedded.demand-{}", row + 1), three(demands_m)));
    }
    hold("embedded", &computed);
}

#[test]
#[ignore = "long: make test-long"]
fn real_records_beside_it() {
    let Some(real) = real_pairs() else { return };
    let set = generate(&SyntheticSetOptions::default()).unwrap();
    let mut computed = statistics("real", &real);
    let [[ours_low, _, ours, _, ours_high], [low, _, median, _, high]] =
        [&set, &real].map(|set| quantiles(set, &pgv_over_pga));
    let [shaking, real_shaking] = [&set, &real].map(|set| quantiles(set, &mean_of(Accelerogram::d5_95_s))[2]);
    let below = |ours: f64, real: f64| format!("{:.0} %", 100.0 * (1.0 - ours / real));
    assert!(ours_low > 0.0);
    computed.extend([
        ("real.spread".to_owned(), format!("{:.1}", high / low)),
        ("real.median-below".to_owned(), below(ours, median)),
        ("real.tail-below".to_owned(), below(ours_high, high)),
        ("real.shorter".to_owned(), below(shaking, real_shaking)),
    ]);
    for (row, (strength, measure, level)) in ROWS.into_iter().enumerate() {
        let [ours_m, real_m] = [&set, &real].map(|set| demands_m(set, strength, measure, level));
        let ratio = ours_m[1] / real_m[1];
        computed.push((format!("real.demand-{}", row + 1), three(real_m)));
        computed.push((format!("real.ratio-{}", row + 1), format!("{ratio:.2}")));
    }
    hold("real", &computed);
}

/// Minutes on a busy machine: three sets of 500 pairs.
#[test]
#[ignore = "minutes: make doc-figures"]
fn the_choices_it_is_made_with() {
    let options = SyntheticSetOptions { pairs: 500, ..SyntheticSetOptions::default() };
    let sets =
        [options, SyntheticSetOptions { dt_s: 0.005, ..options }, SyntheticSetOptions { corner_hz: 0.2, ..options }]
            .map(|options| generate(&options).unwrap());
    let median = |set: &[RecordPair], measure: Measure<'_>| quantiles(set, measure)[2];
    let measures = measures();
    let [coarse, fine, cornered] = &sets;
    let changes = ["pga", "pgv", "d5-95", "pgv-over-pga"].map(|wanted| {
        let (_, _, measure) = measures.iter().find(|(name, _, _)| *name == wanted).unwrap();
        (median(fine, measure) / median(coarse, measure) - 1.0).abs()
    });
    let pgd_m = mean_of(Accelerogram::pgd_m);
    let [pga, pgv] = [Accelerogram::pga_m_s2, Accelerogram::pgv_m_s].map(|peak| scatter(coarse, peak));
    let name = |name: &str| format!("embedded-choices.{name}");
    let from_to = |measure: Measure<'_>, digits: usize| {
        format!("from {:.digits$} to {:.digits$}", median(coarse, measure), median(cornered, measure))
    };
    hold(
        "embedded-choices",
        &[
            (name("time-step"), format!("{:.1} %", 100.0 * super::range(changes)[1])),
            (name("corner.pgv-over-pga"), from_to(&pgv_over_pga, 0)),
            (name("corner.pgd"), from_to(&pgd_m, 2)),
            (name("scatter"), format!("{pga:.2} and {pgv:.2}")),
        ],
    );
}
