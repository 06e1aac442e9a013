//! `congruent watch`: streams of a UR5e that are judged while they come.

mod answers;
mod corpus;
mod rtde;
mod violations;

use std::fmt::Write;

use serde_json::Value;

use crate::support::published_table::UR5E_JOINTS;

/// Positions on a slow swing.
fn swing(time_s: f64) -> [f64; 6] {
    let mean = [0.3, -1.2, 1.4, -0.9, 1.1, 0.2];
    std::array::from_fn(|joint| {
        let phase = 0.7 * f64::from(u8::try_from(joint).unwrap());
        mean[joint] + 0.3 * (0.8 * time_s + phase).sin()
    })
}

/// A line with joint positions.
fn line(time_s: f64, q: [f64; 6]) -> String {
    let mut named = String::new();
    for (name, q) in UR5E_JOINTS.iter().zip(q) {
        let _ = write!(named, ", \"{name}\": {q}");
    }
    format!("{{\"time_s\": {time_s}, \"q\": {{{}}}}}", named.trim_start_matches(", "))
}

/// Times from a begin on, at a rate.
fn times(from_s: f64, rate_hz: u32, count: u32) -> impl Iterator<Item = f64> {
    // In ns, as a stream has them.
    (0..count).map(move |at| (((from_s + f64::from(at) / f64::from(rate_hz)) * 1e9).round()) / 1e9)
}

/// The documents of an answer that are of a kind.
fn of_kind<'a>(documents: &'a [Value], kind: &str) -> Vec<&'a Value> {
    documents.iter().filter(|document| document["kind"] == kind).collect()
}

/// The documents of an answer.
#[track_caller]
fn documents(text: &str) -> Vec<Value> {
    let document =
        |line| serde_json::from_str(line).unwrap_or_else(|error| panic!("no JSON: {error}\n{line}"));
    text.lines().map(document).collect()
}
