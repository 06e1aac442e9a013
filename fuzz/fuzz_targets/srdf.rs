//! Fuzzes the reader of `robot.srdf`.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| congruent_fuzz::read_everything(congruent_fuzz::Kind::Srdf, bytes));
