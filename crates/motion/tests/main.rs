//! Record files of every layout, the measures of their motions, and pulses.

mod formats_cosmos_csmip;
mod formats_esm_knet;
mod golden;
mod pulse;
mod readers;
mod selection;
