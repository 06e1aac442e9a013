//! The command `congruent`.
fn main() {}
