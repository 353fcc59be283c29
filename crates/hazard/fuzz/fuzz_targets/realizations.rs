#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| uplift_hazard_fuzz::realizations(bytes));
