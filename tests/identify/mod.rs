//! Tests of `identify` and `plan`.

mod planned;
mod recorded;
