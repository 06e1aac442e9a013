//! Fuzzes the reader of `OBJ meshes`.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| congruent_fuzz::read_everything(congruent_fuzz::Kind::Obj, bytes));
