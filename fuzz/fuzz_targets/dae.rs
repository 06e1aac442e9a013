//! Fuzzes the reader of `COLLADA meshes`.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| congruent_fuzz::read_everything(congruent_fuzz::Kind::Dae, bytes));
