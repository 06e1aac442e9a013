//! The third rung: why two explanations cannot be told apart. Nothing is guessed: only explanations
//! that leave equally little are asked about.

use nalgebra::Vector3;

use super::{
    diagnosis::{Explanation, Part},
    hypothesis::{Case, Cause, Place},
};
use crate::twist::Twist;

/// Axes whose angle has a smaller sine are parallel.
const PARALLEL: f64 = 1e-6;

/// A freedom by which two explanations are one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gauge {
    /// A turn of the base about the first axis is the first joint's zero.
    BaseAndFirstZero,
    /// A turn of the tool about the last axis is the last joint's zero.
    ToolAndLastZero,
    /// Along parallel axes only the sum of the offsets matters.
    ParallelOffsets,
    /// A flipped axis with a flipped sign is the same joint.
    FlipAndSign,
    /// The same figures, blamed in another place.
    SameEffect,
}

impl Gauge {
    /// The sentence for people.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::BaseAndFirstZero => "turning the base about the first axis is the first joint's zero",
            Self::ToolAndLastZero => {
                "moving the tool along or about the last axis is the last row's own figure"
            }
            Self::ParallelOffsets => "along parallel axes only the sum of the offsets matters",
            Self::FlipAndSign => "a joint that turns the other way about a flipped axis is the same joint",
            Self::SameEffect => "both make the models agree everywhere",
        }
    }
}

/// The freedom by which `other` says the same as `named`.
pub(super) fn gauge(case: &Case, named: &Explanation, other: &Explanation) -> Gauge {
    let all = || named.parts.iter().chain(&other.parts);
    let has = |cause| all().any(|part| part.cause == cause);
    if has(Cause::Base) && all().any(|part| rows(part).contains(&0)) {
        return Gauge::BaseAndFirstZero;
    }
    let last = case.suspect.rows.len().saturating_sub(1);
    if has(Cause::Tool) && all().any(|part| rows(part).contains(&last)) {
        return Gauge::ToolAndLastZero;
    }
    let blamed: Vec<usize> = all().flat_map(rows).collect();
    if !blamed.is_empty() && has(Cause::Parameter) && are_parallel(case, &blamed) {
        return Gauge::ParallelOffsets;
    }
    if has(Cause::AxisFlipped) { Gauge::FlipAndSign } else { Gauge::SameEffect }
}

fn rows(part: &Part) -> Vec<usize> {
    match &part.place {
        Place::Rows(rows) | Place::Entries(_, rows) => rows.clone(),
        _ => Vec::new(),
    }
}

/// Whether the joints of these rows turn or shift along one direction at position zero.
fn are_parallel(case: &Case, rows: &[usize]) -> bool {
    let screws = case.reference.screws();
    let direction = |&row: &usize| -> Option<Vector3<f64>> {
        let Twist { angular, linear } = screws.twists_in_base.get(case.suspect.rows[row].joint)?;
        if angular.norm() > PARALLEL { Some(angular.normalize()) } else { linear.try_normalize(PARALLEL) }
    };
    let directions: Option<Vec<Vector3<f64>>> = rows.iter().map(direction).collect();
    directions.is_some_and(|all| all.iter().all(|each| each.cross(&all[0]).norm() < PARALLEL))
}
