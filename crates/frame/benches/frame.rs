//! Planar and wobbling frames under a synthetic pair, in the scale of the shaking table and in the prototype's.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use uplift_frame::{ColumnShape, GroundMotion, Model, Options, RockingFrame, TableLevel, demands, respond};
use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{Accelerogram, ReadOptions, read_path};
use uplift_statics::{DiscDimensions, DiscSpring, DiscStack, Parts, Restrainer, Stopper, TendonPath};
use uplift_structure::Geometry;

/// The frame of the shaking table, its lengths times `scale`.
fn frame(shape: ColumnShape, scale: f64) -> RockingFrame {
    let column = Geometry::from_width_and_height(0.197 * scale, 1.45 * scale).unwrap();
    RockingFrame::new(column, 4, 124.4 * scale.powi(3), 9435.0 * scale.powi(3), shape, 9.81).unwrap()
}

fn linear(shape: ColumnShape, scale: f64) -> RockingFrame {
    let restrainer = Restrainer::new(Parts::linear(1720e3 * scale * scale)).unwrap();
    frame(shape, scale).with_restrainer(restrainer, TendonPath::Column).unwrap()
}

/// Disc springs, stoppers and a tendon that shifts in its duct.
fn everything(shape: ColumnShape) -> RockingFrame {
    let disc = DiscSpring::new(DiscDimensions {
        outer_diameter_m: 0.125,
        inner_diameter_m: 0.061,
        thickness_m: 0.006,
        cone_height_m: 0.0036,
        reduced_thickness_m: None,
    });
    let stopper = Some(Stopper { gap_m: 0.015, stiffness_n_m: 20e6, yield_n: Some(54e3) });
    let parts = Parts { stopper, ..Parts::discs(DiscStack::new(disc.unwrap(), 10, 1).unwrap(), 13_318e3) };
    let path = TendonPath::Shifted { duct_gap_m: 0.0087, tendon_length_m: 2.134 };
    frame(shape, 1.0).with_restrainer(Restrainer::new(parts).unwrap(), path).unwrap()
}

/// Leaves the frame of lengths times `scale` with its pair and its displacement to `dop853.py`.
fn leave(title: &str, scale: f64, [x, y]: [&Accelerogram; 2], displacement_m: f64) {
    let case = serde_json::json!({
        "title": title,
        "width_m": 0.197 * scale,
        "height_m": 1.45 * scale,
        "columns": 4,
        "column_mass_kg": 124.4 * scale.powi(3),
        "deck_mass_kg": 9435.0 * scale.powi(3),
        "stiffness_n_m": 1720e3 * scale * scale,
        "gravity_m_s2": 9.81,
        "dt_s": x.dt_s(),
        "x_m_s2": x.acceleration_m_s2(),
        "y_m_s2": y.acceleration_m_s2(),
        "displacement_m": displacement_m,
    });
    std::fs::write(concat!(env!("CARGO_TARGET_TMPDIR"), "/frame_bench.json"), case.to_string()).unwrap();
}

/// A pair of synthetic records, or of real ones: `UPLIFT_PAIR` names two files, separated by a comma.
fn pair() -> (String, [Accelerogram; 2]) {
    if let Ok(files) = std::env::var("UPLIFT_PAIR") {
        let read = |file: &str| read_path(Path::new(file), &ReadOptions::default()).unwrap();
        let (x, y) = files.split_once(',').unwrap();
        return ("real".to_owned(), [read(x), read(y)]);
    }
    let pair = generate(&SyntheticSetOptions { pairs: 1, ..SyntheticSetOptions::default() }).unwrap().remove(0);
    ("synthetic".to_owned(), [pair.h1.clone(), pair.h2.clone()])
}

fn records(criterion: &mut Criterion) {
    let (name, [x, y]) = pair();
    let mut group = criterion.benchmark_group("frame");
    for (scale, level_m_s) in [(1.0, 0.25), (5.0, 0.25 * 5.0_f64.sqrt())] {
        let level = TableLevel::new(5.0 / scale, level_m_s).unwrap();
        let ([x, y], _) = level.pair([&x, &y]).unwrap().unwrap();
        let ground = GroundMotion::pair(&x, &y);
        let mut run = |what: &str, frame: &RockingFrame, model: Model| {
            let found = respond(frame, &ground, model, &Options::default()).unwrap();
            let title = format!(
                "{what}, {name} pair of {:.1} s at dt {:.5}, U {:.3} m",
                x.duration_s(),
                x.dt_s(),
                found.displacement.value
            );
            if what == "wobbling, linear" {
                leave(&title, scale, [&x, &y], found.displacement.value);
            }
            group.bench_function(title, |bencher| {
                bencher.iter(|| respond(black_box(frame), &ground, model, &Options::default()).unwrap());
            });
        };
        run("planar, linear", &linear(ColumnShape::Rectangle, scale), Model::Planar);
        run("wobbling, linear", &linear(ColumnShape::Cylinder, scale), Model::Wobbling);
        if scale == 1.0 {
            run("planar, everything", &everything(ColumnShape::Rectangle), Model::Planar);
            run("wobbling, everything", &everything(ColumnShape::Cylinder), Model::Wobbling);
        }
    }
    group.finish();
}

/// The demand at 24 levels, as a fragility needs it.
fn levels(criterion: &mut Criterion) {
    let (name, [x, y]) = pair();
    let level = TableLevel::new(1.0, 0.25 * 5.0_f64.sqrt()).unwrap();
    let ([x, y], _) = level.pair([&x, &y]).unwrap().unwrap();
    let scaled: Vec<[Accelerogram; 2]> =
        (1..=24).map(|level| [&x, &y].map(|component| component.scaled(f64::from(level) / 12.0).unwrap())).collect();
    let grounds: Vec<GroundMotion<'_>> = scaled.iter().map(|[x, y]| GroundMotion::pair(x, y)).collect();
    let mut group = criterion.benchmark_group("demands");
    for (what, shape, model) in
        [("planar", ColumnShape::Rectangle, Model::Planar), ("wobbling", ColumnShape::Cylinder, Model::Wobbling)]
    {
        let frame = linear(shape, 5.0);
        group.bench_function(format!("{what}, linear, {name} pair at 24 levels"), |bencher| {
            bencher.iter(|| demands(black_box(&frame), &grounds, model, &Options::default()));
        });
        group.bench_function(format!("{what}, linear, {name} pair at 24 levels, one by one"), |bencher| {
            let one = |ground| respond(black_box(&frame), ground, model, &Options::default());
            bencher.iter(|| grounds.iter().map(one).collect::<Vec<_>>());
        });
    }
    group.finish();
}

criterion_group!(benches, records, levels);
criterion_main!(benches);
