#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| uplift_motion_fuzz::read_selection(bytes));
