//! Plans carried out with a checkpoint, for every kind of study and every question asked of a result.
//!
//! | module | what is in it |
//! |---|---|
//! | `work` | plans with their labels, and the carrying out of them |
//! | `shard` | the work shared among machines, and the joining of it |
//! | `result_job` | work that is asked of a finished result |
//!
//! A job makes its plans, puts them into a [`Work`], opens the checkpoint that goes with it, and has it carried out:
//! what is known is not computed again, every finished row goes to the checkpoint, and a stop ends with what is in it.

mod result_job;
mod shard;
mod work;

use shard::shard_ending;
pub use shard::{MOST_SHARDS, SHARD, ShardReport, carry_out_shard, hold, join, run_shard, shard_path};
pub use work::{Analysed, LabelledPlan, Work, rate, seconds};
