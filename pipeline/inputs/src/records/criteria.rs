//! The quantities by which records are chosen, as options of a command.

use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches, value_parser};
use uplift_study::{CRITERIA, Criterion, Range, RecordSelection};

const HEADING: &str = "Which records (ranges such as 6.5:7.5, 6.5: or :7.5)";
const PULSE_LIKE: &str = "pulse_like";

/// The records that are chosen: an option for each of the [`CRITERIA`]; all where none is given.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Criteria(pub RecordSelection);

impl Args for Criteria {
    fn augment_args(command: Command) -> Command {
        let option = |key: &'static str| Arg::new(key).long(key.replace('_', "-")).help_heading(HEADING);
        let of = |criterion: Criterion| {
            option(criterion.key).value_name("RANGE").value_parser(range).help(criterion.words())
        };
        let pulse_like = option(PULSE_LIKE).value_name("BOOL").value_parser(value_parser!(bool));
        command.args(CRITERIA.map(of)).arg(pulse_like.help("Velocity pulse (Shahi and Baker 2014): true or false"))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for Criteria {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let of = |criterion: Criterion| Some((criterion, *matches.get_one(criterion.key)?));
        let ranges = CRITERIA.into_iter().filter_map(of).collect();
        Ok(Self(RecordSelection { ranges, pulse_like: matches.get_one(PULSE_LIKE).copied() }))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// Reads `6.5:7.5`, `6.5:` or `:7.5`.
///
/// # Errors
/// Other text, with what to write.
pub fn range(text: &str) -> Result<Range, String> {
    Range::parse(text).ok_or_else(|| format!("write {}, the smaller number first", Range::ACCEPTED))
}
