//! The result of a study of displacement spectra, written as docs/hdf5-layout.md describes it.

use std::collections::BTreeSet;
use std::path::Path;

use uplift_inputs::{NamedSet, RecordSets};
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::layout::{axis as axes, set as layout, spectra};
use uplift_result::{BOUNDS, Origin, Provenance, bounds};
use uplift_spectra::{MotionSet, Noisy};
use uplift_study::{DisplacementStudy, Kind, Structures};

use super::{design_rows as design, printed};
use crate::displacement::{Designs, SetSpectra};
use crate::error::StudiesError;

/// All that a study of displacement spectra computed.
#[derive(Debug)]
pub struct DisplacementOutcome<'a> {
    /// The study.
    pub study: &'a DisplacementStudy,
    /// Its records, in sets.
    pub records: &'a RecordSets,
    /// The motions of each set.
    pub sets: &'a [MotionSet<'a>],
    /// The spectra of each set.
    pub spectra: &'a [SetSpectra],
    /// The printed ordinates of each set with their range over scale factors that differ by rounding, over `[way, line,
    /// percentile, printed abscissa]`, m.
    pub rounding: &'a [Vec<Noisy>],
    /// The design examples, if it has some.
    pub designs: Option<&'a Designs>,
    /// Nonlinear time histories of the spectra.
    pub analyses: u64,
    /// Wall time for these, s.
    pub seconds: f64,
    /// What a reader should know before using the numbers.
    pub warnings: &'a [String],
    /// Where the numbers come from.
    pub provenance: &'a Provenance,
}

impl DisplacementOutcome<'_> {
    /// Names of the axes that tell lines of a spectrum apart.
    pub(super) fn line_axes(&self) -> &'static [&'static str] {
        match self.study.structures {
            Structures::Oscillators(_) => &[axes::UPLIFT_DISPLACEMENT, axes::CAPACITY],
            Structures::Blocks(_) => &[axes::HEIGHT],
        }
    }

    /// Name of the axis of a spectrum's abscissa.
    pub(super) fn abscissa_axis(&self) -> &'static str {
        match self.study.structures {
            Structures::Oscillators(_) => axes::STRENGTH,
            Structures::Blocks(_) => axes::SLENDERNESS,
        }
    }

    /// Name of the axis of those abscissae at which a run prints its spectra.
    pub(super) fn printed_axis(&self) -> &'static str {
        match self.study.structures {
            Structures::Oscillators(_) => axes::PRINTED_STRENGTH,
            Structures::Blocks(_) => axes::PRINTED_SLENDERNESS,
        }
    }

    /// The axes of an array of all sets, lines being told apart.
    pub(super) fn dims(&self, last: &[&'static str]) -> Vec<&'static str> {
        [&[axes::RECORD_SET, axes::SCALING, axes::SCALED_BY], self.line_axes(), last].concat()
    }
}

/// Write `outcome` to `path`, atomically: an earlier file survives a failure.
///
/// # Errors
/// Whatever keeps the file from being written, a full disk for instance.
pub fn write_displacements(path: &Path, outcome: &DisplacementOutcome<'_>) -> Result<(), StudiesError> {
    let mut writer = LabelledWriter::create(path)?;
    write_root(&mut writer, outcome)?;
    write_axes(&mut writer, outcome)?;
    write_spectra(&mut writer, outcome)?;
    let mut taken = BTreeSet::new();
    for ((set, motions), spectra) in outcome.records.sets.iter().zip(outcome.sets).zip(outcome.spectra) {
        let axis = axes::motion(&set.name, &mut taken);
        write_set(&mut writer, outcome, set, motions, spectra, &axis)?;
    }
    if let (Some(designs), Some(plan)) = (outcome.designs, &outcome.study.design) {
        design::write(&mut writer, outcome.study, plan, designs)?;
    }
    writer.finish()?;
    Ok(())
}

fn write_root(writer: &mut LabelledWriter, outcome: &DisplacementOutcome<'_>) -> Result<(), StudiesError> {
    let DisplacementOutcome { study, records, .. } = outcome;
    let study_toml = study.to_toml()?;
    let origin = Origin {
        title: &study.title,
        study_toml: &study_toml,
        gravity_m_s2: study.gravity_m_s2,
        record_set: &records.description,
        synthetic: records.synthetic,
        warnings: outcome.warnings,
        provenance: outcome.provenance,
    };
    origin.write(writer)?;
    writer.attribute("/", "kind", Kind::Displacement.key())?;
    let structure = match study.structures {
        Structures::Oscillators(_) => "oscillator",
        Structures::Blocks(_) => "block",
    };
    writer.attribute("/", "structure", structure)?;
    Ok(())
}

fn write_axes(writer: &mut LabelledWriter, outcome: &DisplacementOutcome<'_>) -> Result<(), LabelledError> {
    let study = outcome.study;
    let names: Vec<String> = outcome.records.sets.iter().map(|set| set.name.clone()).collect();
    writer.axis_text(axes::RECORD_SET, &names, "record set")?;
    let to: Vec<String> = study.scaling.to.iter().map(ToString::to_string).collect();
    writer.axis_text(axes::SCALING, &to, "what motions are scaled to, a multiple of the set's median peak")?;
    let by: Vec<String> = study.scaling.by.iter().map(|by| by.key().to_owned()).collect();
    writer.axis_text(axes::SCALED_BY, &by, "whose peak is scaled")?;
    match &study.structures {
        Structures::Oscillators(family) => {
            let uplift = &family.uplift_displacement_m;
            writer.axis_f64(axes::UPLIFT_DISPLACEMENT, uplift, "m", "displacement at uplift u_up")?;
            let long_name = "displacement capacity u_cap, infinite for zero post-uplift stiffness";
            writer.axis_f64(axes::CAPACITY, &family.capacity_m, "m", long_name)?;
            writer.axis_f64(axes::STRENGTH, &family.strengths, "1", "uplift strength f_up/(m g)")?;
        }
        Structures::Blocks(family) => {
            writer.axis_f64(axes::HEIGHT, &family.height_m, "m", "height 2H of the block")?;
            writer.axis_f64(axes::SLENDERNESS, &family.slendernesses, "1", "slenderness tan(alpha)")?;
        }
    }
    let abscissae = study.structures.abscissa();
    let shown: Vec<f64> = printed(abscissae).into_iter().map(|at| abscissae[at]).collect();
    let long_name = format!("{} at which a run prints its spectra", outcome.abscissa_axis());
    writer.axis_f64(outcome.printed_axis(), &shown, "1", &long_name)?;
    writer.axis_f64(axes::PERCENTILE, &study.percentiles, "%", "percentile over the motions of a set")?;
    writer.axis_text(axes::BOUND, &BOUNDS.map(str::to_owned), "a value, and its range over a small sweep")
}

fn write_spectra(writer: &mut LabelledWriter, outcome: &DisplacementOutcome<'_>) -> Result<(), LabelledError> {
    let of = |values: fn(&SetSpectra) -> &[f64]| -> Vec<f64> {
        outcome.spectra.iter().flat_map(|spectra| values(spectra).iter().copied()).collect()
    };
    let abscissa = outcome.abscissa_axis();
    let long_name = "percentile of the peak displacements, infinite where it falls on an overturned structure";
    let dims = outcome.dims(&[axes::PERCENTILE, abscissa]);
    writer.array_f64(spectra::U_M, &dims, &of(|spectra| &spectra.percentile_m), "m", long_name)?;
    let long_name = "share of the motions under which the structure overturns";
    writer.array_f64(
        spectra::OVERTURNED,
        &outcome.dims(&[abscissa]),
        &of(|spectra| &spectra.overturned),
        "1",
        long_name,
    )?;
    let long_name = format!("largest {abscissa} at which the percentile is infinite");
    let critical = of(|spectra| &spectra.critical);
    writer.array_f64(spectra::CRITICAL, &outcome.dims(&[axes::PERCENTILE]), &critical, "1", &long_name)?;
    let long_name = "printed percentile of the peak displacements, with scale factors some 1e-15 smaller and larger";
    let rounding: Vec<f64> = outcome.rounding.iter().flatten().flat_map(|&noisy| bounds(noisy)).collect();
    let dims = outcome.dims(&[axes::PERCENTILE, outcome.printed_axis(), axes::BOUND]);
    writer.array_f64(spectra::U_M_ROUNDING, &dims, &rounding, "m", long_name)?;
    writer.attribute(spectra::GROUP, "analyses", outcome.analyses)?;
    writer.attribute(spectra::GROUP, "seconds", outcome.seconds)
}

fn write_set(
    writer: &mut LabelledWriter,
    outcome: &DisplacementOutcome<'_>,
    set: &NamedSet,
    motions: &MotionSet<'_>,
    spectra: &SetSpectra,
    axis: &str,
) -> Result<(), LabelledError> {
    let group = layout::group(&set.name);
    let path = |name: &str| layout::array(&set.name, name);
    let ids: Vec<String> = motions.motions().iter().map(|motion| motion.id.clone()).collect();
    writer.axis_text(axis, &ids, "component of a record")?;

    let mut dims = vec![axes::SCALING, axes::SCALED_BY];
    writer.array_f64(&path("factor"), &[dims[0], dims[1], axis], &spectra.factors, "1", "factor on the motion")?;
    dims.extend(outcome.line_axes());
    dims.extend([outcome.abscissa_axis(), axis]);
    let long_name = "peak displacement, infinite where overturned";
    writer.array_f64(&path("u_m"), &dims, &spectra.displacement_m, "m", long_name)?;

    let dims = &[axis];
    let peak = |value: fn(&uplift_spectra::Motion<'_>) -> f64| motions.motions().iter().map(value).collect::<Vec<_>>();
    let peaks = [
        ("pga_g", peak(|motion| motion.pga_g), "g", "PGA of the component, unscaled"),
        ("pgv_cm_s", peak(|motion| motion.pgv_cm_s), "cm/s", "PGV of the component, unscaled"),
        ("record_pga_g", peak(|motion| motion.record_pga_g), "g", "PGA of the record, geometric mean"),
        ("record_pgv_cm_s", peak(|motion| motion.record_pgv_cm_s), "cm/s", "PGV of the record, geometric mean"),
        ("dt_s", peak(|motion| motion.accelerogram.dt_s()), "s", "sampling interval"),
    ];
    for (name, values, unit, long_name) in peaks {
        writer.array_f64(&path(name), dims, &values, unit, long_name)?;
    }
    let samples: Vec<u32> =
        (motions.motions().iter()).map(|motion| u32::try_from(motion.accelerogram.len()).unwrap_or(u32::MAX)).collect();
    writer.array_u32(&path("samples"), dims, &samples, "1", "number of samples")?;

    // two motions a record
    let records = || outcome.records.of(set).flat_map(|record| [(record, 0), (record, 1)]);
    let text = |key: &str| -> Vec<String> {
        records().map(|(record, _)| record.pair.metadata.get(key).cloned().unwrap_or_default()).collect()
    };
    let number = |key: &str| -> Vec<f64> { records().map(|(record, _)| record.number(key)).collect() };
    let names: Vec<String> = records().map(|(record, _)| record.pair.id.clone()).collect();
    let component: Vec<String> = records().map(|(_, which)| format!("h{}", which + 1)).collect();
    let checksum: Vec<String> = records().map(|(record, which)| record.checksums[which].clone()).collect();
    for (name, values, long_name) in [
        ("record", names, "record"),
        ("component", component, "horizontal component"),
        ("event", text("event"), "earthquake"),
        ("station", text("station"), "recording station"),
        ("checksum", checksum, "SHA-256 of the component"),
    ] {
        writer.array_text(&path(name), dims, &values, long_name)?;
    }
    for (name, unit, long_name) in [
        ("magnitude", "1", "moment magnitude"),
        ("rrup_km", "km", "closest distance to the rupture"),
        ("vs30", "m/s", "mean shear-wave velocity of the upper 30 m"),
    ] {
        writer.array_f64(&path(name), dims, &number(name), unit, long_name)?;
    }
    writer.attribute(&group, "records", set.members.len() as u64)?;
    writer.attribute(&group, "tag", set.tag.as_str())?;
    writer.attribute(&group, "median_pga_g", motions.median_pga_g())?;
    writer.attribute(&group, "median_pgv_cm_s", motions.median_pgv_cm_s())
}
