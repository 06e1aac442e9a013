//! Fuzzes the reader of MJCF files.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| congruent_fuzz::read_everything(congruent_fuzz::Kind::Mjcf, bytes));
