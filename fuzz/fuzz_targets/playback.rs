//! Fuzzes the reader of `a table that a motion plays`.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| congruent_fuzz::read_everything(congruent_fuzz::Kind::Playback, bytes));
