//! A table of sets of their own at each level, as `records.at_level` takes it, from what tools of record selection
//! write.

mod known;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use clap::Args;
use polars::prelude::Column;
use serde::Serialize;
use uplift_job::JobError;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::{table_text, write_atomically};
use uplift_job::text::{counted, first_names};
use uplift_job::typed::{Overwriting, number};
use uplift_motion::{IntensityMeasure, SelectedComponent, SelectedRecord, SelectedSet, SelectionTool, read_selection};

use crate::at_level::{RECORD, check_bytes, level_column};
use crate::error::InputsError;
use crate::manifest;
use known::KnownRecords;

/// By how much a level that is given may differ from that of the file, relative: it may be rounded.
const SAME_LEVEL: f64 = 1e-3;

/// Which selections make a table, and where it goes.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct AtLevelOptions {
    /// Selections, one file a level
    #[arg(
        required = true,
        value_name = "FILE",
        help = "Output of the tool, one file per level: haselREC's ..._summary_selection.txt, CS_Selection's \
                Output_File.dat, EzGM's GMR_H1_names.txt or GMR_names.txt (GMR_sf_used.txt lies beside it), Djura's \
                records_....json"
    )]
    pub selections: Vec<PathBuf>,
    /// Manifest with the records, from uplift records import
    #[arg(long, value_name = "SET")]
    pub manifest: PathBuf,
    /// Intensity measure of the selection
    #[arg(
        long,
        value_name = "MEASURE",
        help = "The measure that they were selected for: pgv, pga, sa_1s (SA at 0.5 s is sa_0p5s), ..."
    )]
    pub measure: IntensityMeasure,
    /// Level of each file, cm/s or g (haselREC and Djura name it)
    #[arg(long = "level", value_name = "LEVEL,...", value_delimiter = ',', value_parser = number)]
    pub levels: Vec<f64>,
    /// Count each component as a record (for component = "both")
    #[arg(long)]
    pub both: bool,
    /// Table to write (CSV)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Whether existing files are overwritten.
    #[command(flatten)]
    pub overwriting: Overwriting,
}

/// The set of one level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelSet {
    /// The file it is from.
    pub file: PathBuf,
    /// The tool that wrote it.
    pub tool: String,
    /// The level, in the unit of the measure.
    pub level: f64,
    /// How many records it has.
    pub records: usize,
}

/// What stands in the table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AtLevelReport {
    /// The table.
    pub table: PathBuf,
    /// The measure, as text has it: `SA(1.0)`.
    pub measure: String,
    /// Its unit.
    pub unit: String,
    /// The sets, the lowest level first.
    pub levels: Vec<LevelSet>,
    /// How many records there are in all, each counted once.
    pub records: usize,
    /// What deserves a look.
    pub notes: Vec<String>,
    /// The lines of a study that runs them, TOML.
    pub study_lines: String,
}

/// Writes the table of the sets that were selected for the levels of a measure.
///
/// # Errors
/// Files that cannot be read, records that the manifest lacks or has twice, levels that are not known: all at once; a
/// table that would overwrite something.
pub fn at_level(options: &AtLevelOptions) -> Result<AtLevelReport, InputsError> {
    let AtLevelOptions { selections, levels, measure, .. } = options;
    if !levels.is_empty() && levels.len() != selections.len() {
        let (levels, files) = (counted(levels.len(), "level"), counted(selections.len(), "file"));
        return Err(JobError::Usage(format!("{levels} for {files}: give --level one of each, in their order")).into());
    }
    if let Some(level) = levels.iter().find(|level| !(level.is_finite() && **level > 0.0)) {
        return Err(JobError::Usage(format!("--level is {level}: give numbers above 0, in {}", measure.unit())).into());
    }
    if !measure.can_be_scaled_to() {
        return Err(JobError::Usage(format!("no record can be scaled to a {measure}: give another --measure")).into());
    }
    let mut inputs = vec![options.manifest.clone()];
    inputs.extend(selections.iter().cloned());
    inputs.extend(manifest::record_files(&options.manifest));
    outputs::check(&[Output::new(&options.output, OutputKind::Manifest)], &inputs, options.overwriting.force)?;

    let known = KnownRecords::new(manifest::read(&options.manifest, None).map_err(JobError::Inputs)?);
    let mut mistakes = Vec::new();
    let mut sets = Vec::new();
    for (index, file) in selections.iter().enumerate() {
        match read_selection(file, *measure) {
            Ok(set) => match level_of(&set, file, levels.get(index).copied(), *measure) {
                Ok(level) => sets.push((file, level, set)),
                Err(mistake) => mistakes.push(mistake),
            },
            Err(error) => mistakes.push(error.to_string()),
        }
    }
    sets.sort_by(|(_, one, _), (_, other, _)| one.total_cmp(other));
    for pair in sets.windows(2).filter(|pair| pair[0].1 == pair[1].1) {
        let (one, other, level) = (pair[0].0.display(), pair[1].0.display(), pair[0].1);
        mistakes.push(format!("{one} and {other} both have the level {level} {}: give one of them", measure.unit()));
    }
    let mut rows = Rows::default();
    for (file, level, set) in &sets {
        mistakes.extend(rows.add(set, file, *level, &known, options));
    }
    if !mistakes.is_empty() {
        return Err(JobError::Inputs(mistakes).into());
    }
    rows.write(options, &sets)?;
    let level_set = |(file, level, set): &(&PathBuf, f64, SelectedSet)| LevelSet {
        file: (*file).clone(),
        tool: set.tool.to_string(),
        level: *level,
        records: set.records.len(),
    };
    let levels: Vec<LevelSet> = sets.iter().map(level_set).collect();
    Ok(AtLevelReport {
        table: options.output.clone(),
        measure: measure.to_string(),
        unit: measure.unit().to_owned(),
        records: rows.records.iter().collect::<BTreeSet<_>>().len(),
        notes: rows.notes(),
        study_lines: study_lines(options, &levels, rows.of_components),
        levels,
    })
}

/// The level of a set: what the file says, or what is given.
fn level_of(set: &SelectedSet, file: &Path, given: Option<f64>, measure: IntensityMeasure) -> Result<f64, String> {
    let (name, tool, unit) = (file.display(), set.tool, measure.unit());
    match (given, set.level) {
        (Some(given), Some(said)) if (given / said - 1.0).abs() > SAME_LEVEL => {
            Err(format!("{name}: {tool} says that it was selected for {said} {unit}, and --level is {given} {unit}"))
        }
        (Some(given), _) => Ok(given),
        (None, Some(said)) => Ok(said),
        (None, None) => Err(format!(
            "{name}: {tool} does not write the {measure} that it was selected for: give --level, in {unit}, for each \
             file in their order"
        )),
    }
}

#[derive(Debug, Default)]
struct Rows {
    records: Vec<String>,
    levels: Vec<f64>,
    factors: Vec<String>,
    /// Whether some are components of pairs.
    of_components: bool,
    /// How many components are known by a number of the tool alone.
    numbered: usize,
    /// How many series are scaled already.
    scaled_already: usize,
}

impl Rows {
    /// Adds the records of a set; what is wrong with them.
    fn add(
        &mut self,
        set: &SelectedSet,
        file: &Path,
        level: f64,
        known: &KnownRecords,
        options: &AtLevelOptions,
    ) -> Vec<String> {
        let name = file.display();
        let place = if set.tool == SelectionTool::Djura { "record" } else { "line" };
        let (mut missing, mut mistakes) = (Vec::new(), Vec::new());
        let mut seen: BTreeMap<String, usize> = BTreeMap::new();
        for record in &set.records {
            let SelectedRecord { position, name: selected, .. } = record;
            // series that EzGM wrote are found beside its lists, if they were imported
            let scaled = (set.tool == SelectionTool::EzGm).then(|| known.beside(file, selected)).flatten();
            let found = match &scaled {
                Some(found) => vec![found.clone()],
                None => known.find(selected, record.component),
            };
            let found = match found.as_slice() {
                [] => {
                    missing.push(format!("{selected} ({place} {position})"));
                    continue;
                }
                [found] => found,
                several => {
                    mistakes.push(format!(
                        "{name}, {place} {position}: {selected} is {} in the manifest: leave all but one out of it",
                        first_names(several)
                    ));
                    continue;
                }
            };
            self.of_components |= options.both || record.component != SelectedComponent::Pair;
            self.numbered += usize::from(matches!(record.component, SelectedComponent::Numbered(_)));
            self.scaled_already += usize::from(scaled.is_some());
            let factor = if scaled.is_some() { "1" } else { &record.factor };
            let ids = if options.both && record.component == SelectedComponent::Pair {
                vec![format!("{found}:h1"), format!("{found}:h2")]
            } else {
                vec![found.clone()]
            };
            for id in ids {
                if let Some(before) = seen.insert(id.clone(), *position) {
                    mistakes.push(format!(
                        "{name}, {place} {position}: {id} is in {place} {before} already: leave one of them out"
                    ));
                }
                self.records.push(id);
                self.levels.push(level);
                self.factors.push(factor.to_owned());
            }
        }
        if !missing.is_empty() {
            mistakes.push(format!(
                "{name}: {} of {} are not in {}: {}: import them, too",
                missing.len(),
                counted(set.records.len(), "record"),
                options.manifest.display(),
                first_names(&missing)
            ));
        }
        mistakes
    }

    fn write(&self, options: &AtLevelOptions, sets: &[(&PathBuf, f64, SelectedSet)]) -> Result<(), InputsError> {
        let AtLevelOptions { measure, output, .. } = options;
        let tools: BTreeSet<String> = sets.iter().map(|(_, _, set)| set.tool.to_string()).collect();
        let tools = tools.into_iter().collect::<Vec<_>>().join(", ");
        let (mark, levels) = (outputs::mark(), counted(sets.len(), "level"));
        let line = format!("{mark}, records at {levels} of {measure} as selected by {tools}");
        let columns = vec![
            Column::new(RECORD.into(), &self.records),
            Column::new(level_column(*measure).into(), &self.levels),
            Column::new("factor".into(), &self.factors),
        ];
        let content = table_text(output, &line, columns)?;
        // what a study would refuse is not written
        check_bytes(&content, output, *measure).map_err(JobError::Inputs)?;
        Ok(write_atomically(output, &content)?)
    }

    fn notes(&self) -> Vec<String> {
        let numbered = (self.numbered > 0).then(|| {
            format!(
                "{} named only by 1 or 2 of the tool's database, taken for h1 and h2 of the manifest: compare the \
                 order of their files",
                counted(self.numbered, "component")
            )
        });
        let scaled = (self.scaled_already > 0).then(|| {
            format!("{} from EzGM's own series, which are scaled already: their factor is 1", self.scaled_already)
        });
        numbered.into_iter().chain(scaled).collect()
    }
}

/// The sections of a study.
fn study_lines(options: &AtLevelOptions, levels: &[LevelSet], of_components: bool) -> String {
    let text = |path: &Path| toml::Value::from(path.display().to_string());
    let mut lines = vec![
        "[records]".to_owned(),
        format!("manifest = {}", text(&options.manifest)),
        format!("at_level = {}", text(&options.output)),
    ];
    if of_components {
        lines.push("component = \"both\"".to_owned());
    }
    let levels: Vec<String> = levels.iter().map(|set| set.level.to_string()).collect();
    let (section, key) = uplift_study::levels_place(options.measure);
    lines.push(format!("\n[{section}]\n{key} = [{}]\n", levels.join(", ")));
    lines.join("\n")
}
