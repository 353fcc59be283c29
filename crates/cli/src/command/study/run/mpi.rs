//! `uplift run` under `mpirun`: every rank computes one shard of the analyses, and the first joins them.
//!
//! The ranks share nothing but the file system. MPI says who they are, lets the first wait for the others, and ends all
//! when one fails (one with a bug ends itself, for the launcher to notice): the shards are then as those of any run
//! that stopped, and the same command goes on from there.

use std::time::Duration;

use ::mpi::Threading;
use ::mpi::topology::SimpleCommunicator;
use ::mpi::traits::{Communicator, CommunicatorCollectives};
use uplift::analysis::shard_path;
use uplift::events::Events;
use uplift::{JobError, UpliftError, run_shard};
use uplift_ida::Shard;

use super::RunArguments;
use crate::command::arguments::run_options;
use crate::error::CommandError;
use crate::show::{print_json, print_run};
use crate::terminal::Terminal;

/// What the starters of ranks tell them: Open MPI, `PMIx` (Slurm among others), and PMI (MPICH, Intel MPI, Slurm).
const STARTED_BY: [&str; 3] = ["OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"];
/// How often a rank that waits for the others looks whether they are there.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// Carries out a run as one of several ranks; none where this program was not started as such.
pub(super) fn run(arguments: &RunArguments, terminal: &Terminal) -> Option<Result<(), CommandError>> {
    // without one of these MPI would be a world of one, at the price of starting it
    STARTED_BY.iter().find(|name| std::env::var_os(name).is_some())?;
    let (universe, _) = ::mpi::initialize_with_threading(Threading::Funneled)?;
    let world = universe.world();
    let [index, count] = [world.rank(), world.size()].map(|number| u64::try_from(number).unwrap_or_default());
    if count < 2 {
        return None;
    }
    let shard = Shard { index, count };
    match run_rank(arguments, &world, shard, terminal) {
        done @ (Ok(()) | Err(CommandError::OutputClosed)) => Some(done),
        // a stop is sent to all ranks, and one says so
        Err(error @ CommandError::Uplift(_)) if error.exit_code() == CommandError::STOPPED => {
            if index == 0 {
                terminal.tell_error(&error);
            }
            std::process::exit(error.exit_code().into())
        }
        // the others would wait for this rank for ever: it ends them
        Err(error) => {
            terminal.set_interruption_message(format!("rank {index} of {count} has ended the run"));
            let host = ::mpi::environment::processor_name().unwrap_or_default();
            terminal.say(&format!("uplift: rank {index} of {count} on {host} ends the run:"));
            terminal.tell_error(&error);
            world.abort(error.exit_code().into())
        }
    }
}

/// The part of one rank, and for the first all that comes after the analyses.
fn run_rank(
    arguments: &RunArguments,
    world: &SimpleCommunicator,
    shard: Shard,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    let first = shard.index == 0;
    // the first looks before the others do, so that a mistake is said once
    if !first {
        wait(world, terminal)?;
    }
    if arguments.shard.is_some() {
        return Err(CommandError::Usage("each rank takes its own shard: leave --shard out under mpirun".to_owned()));
    }
    let study = arguments.study.load_any()?;
    let options = run_options(&arguments.study, arguments.output.clone(), arguments.overwriting.force);
    let path = options.result_file(&study.output().file).to_owned();
    let own = terminal.with_quiet(!first);
    if first {
        uplift::check_inputs(&study, &options, &own)?;
        wait(world, terminal)?;
    }
    let threads = rayon::current_num_threads();
    // said now, since a launcher that ends the ranks may no longer listen to them
    own.say(&format!(
        "ranks    {}, this one with {threads} threads; finished rows are kept, and the same command resumes",
        shard.count
    ));
    let file = shard_path(&path, shard);
    let rows = run_shard(&study, &file, shard, Some(&path), &own)?.rows;
    wait(world, terminal).map_err(|_| {
        UpliftError::from(JobError::Paused { what: "analysis rows", done: rows, total: rows, path: file })
    })?;
    if !first {
        return Ok(());
    }

    let files: Vec<_> = (0..shard.count).map(|index| shard_path(&path, Shard { index, ..shard })).collect();
    let report = uplift::merge(&study, &files, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_run(&report, terminal) }?;
    for file in &files {
        let _ = std::fs::remove_file(file);
    }
    Ok(())
}

/// Waits until all ranks are here, without a core for it.
fn wait(world: &SimpleCommunicator, terminal: &Terminal) -> Result<(), CommandError> {
    let mut all_here = world.immediate_barrier();
    loop {
        match all_here.test() {
            Ok(_) => return Ok(()),
            Err(not_yet) => all_here = not_yet,
        }
        if terminal.cancelled() {
            // the program ends here; a request must not be dropped before it is complete
            std::mem::forget(all_here);
            return Err(CommandError::Uplift(JobError::Interrupted.into()));
        }
        std::thread::sleep(LOOK_EVERY);
    }
}
