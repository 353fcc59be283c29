#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| -> libfuzzer_sys::Corpus {
    uplift_hazard_fuzz::export(bytes, |begin| begin == b'<')
});
