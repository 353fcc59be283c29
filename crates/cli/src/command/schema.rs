//! `uplift schema`: the keys of files, for editors.

use std::io::Write;

use clap::{Args, ValueEnum};
use uplift_study::{library_schema, structure_schema, study_schema};

use crate::error::CommandError;
use crate::terminal::output;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    uplift schema > study.schema.json\n  \
    uplift schema structure > structure.schema.json")]
pub(crate) struct SchemaArguments {
    /// Kind of file
    #[arg(value_enum, default_value = "study")]
    of: Files,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Files {
    /// Studies, of any kind
    Study,
    /// Structures
    Structure,
    /// Libraries of rocking response
    Library,
}

/// Prints the schema.
pub(crate) fn schema(arguments: &SchemaArguments) -> Result<(), CommandError> {
    let schema = match arguments.of {
        Files::Study => study_schema(),
        Files::Structure => structure_schema(),
        Files::Library => library_schema(),
    };
    writeln!(output(), "{schema:#}")?;
    Ok(())
}
