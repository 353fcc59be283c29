//! Stripes against single runs, on any number of threads, in shards, and gone on with.

mod blocks;
mod cells;
mod directions;
mod frames;
mod real_records;
mod stripes;
