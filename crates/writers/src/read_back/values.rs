//! Inertias, limits, losses, couplings and shapes, each difference with what it is about.

use std::collections::BTreeMap;

use congruent_description::{Inertia, Joint, Link, Shape};
use congruent_input::Diagnostic;
use nalgebra::{Matrix3, Vector3};

use super::{matched::Matched, poses::larger};
use crate::{codes, shape};

/// The largest difference of each kind, with the part that has it.
#[derive(Debug, Default)]
pub(super) struct Differences(BTreeMap<&'static str, (f64, String)>);

impl Differences {
    pub(super) fn compare_all(&mut self, matched: &Matched<'_>) {
        let Matched { written, found, links, is_compared, joints } = matched;
        for ((ours, theirs), _) in written.links().iter().zip(links).zip(is_compared).filter(|(_, is)| **is) {
            let theirs = found.link(*theirs);
            self.inertia(ours, theirs);
            for (ours_of, theirs_of) in
                [(&ours.visuals, &theirs.visuals), (&ours.collisions, &theirs.collisions)]
            {
                self.note("shapes", shapes_apart(theirs_of, ours_of), || format!("link \"{}\"", ours.name));
            }
        }
        for &(ours, theirs) in joints {
            let [a, b] = [written.joint(ours), found.joint(theirs)];
            let master = |robot: &congruent_description::Robot, joint: &Joint| {
                joint.mimic.map(|mimic| robot.joint(mimic.master).name.clone())
            };
            let has_same_master = master(written, a) == master(found, b);
            let off = if has_same_master { terms_apart(a, b) } else { f64::INFINITY };
            self.note("terms", off, || format!("joint \"{}\"", a.name));
        }
    }

    /// Mass and inertia relative to the largest value of the link, the centre of mass in metres.
    fn inertia(&mut self, ours: &Link, theirs: &Link) {
        let [a, b] = [ours, theirs].map(|link| InertiaInLink::of(link.inertia.as_ref()));
        let name = || format!("link \"{}\"", ours.name);
        self.note("masses", relative(a.mass_kg, b.mass_kg), name);
        self.note("centres", (a.center - b.center).norm() / a.center.norm().max(1.0), name);
        let largest = a.tensor.amax().max(b.tensor.amax());
        let off = if largest > 0.0 { (a.tensor - b.tensor).amax() / largest } else { 0.0 };
        self.note("inertias", off, name);
    }

    /// Keeps a difference if it is the largest of its kind.
    pub(super) fn note(&mut self, kind: &'static str, value: f64, of: impl Fn() -> String) {
        let worst = self.0.entry(kind).or_default();
        if larger(worst.0, value).to_bits() != worst.0.to_bits() {
            *worst = (value, of());
        }
    }

    pub(super) fn largest(&self, kind: &'static str) -> f64 {
        self.0.get(kind).map_or(0.0, |worst| worst.0)
    }

    /// The error of the first kind that differs by more than the limit; one that is not a number does.
    pub(super) fn beyond(&self, limit: f64) -> Option<Diagnostic> {
        let (kind, (value, of)) = self.0.iter().find(|(_, (value, _))| value.is_nan() || *value > limit)?;
        let message = format!(
            "the written text is not the same robot when it is read again: {kind} of {of} differ by {value:.1e}, limit {limit:e}"
        );
        Some(Diagnostic::error(codes::write::READ_BACK, message).with_help("nothing is written"))
    }
}

/// Mass, centre of mass and tensor about it in the axes of the link; all zero for a link without.
struct InertiaInLink {
    mass_kg: f64,
    center: Vector3<f64>,
    tensor: Matrix3<f64>,
}

impl InertiaInLink {
    fn of(inertia: Option<&Inertia>) -> Self {
        let is_some = |of: &&Inertia| of.mass_kg > 0.0 || of.tensor_kg_m2.amax() > 0.0;
        let Some(inertia) = inertia.filter(is_some) else {
            return Self { mass_kg: 0.0, center: Vector3::zeros(), tensor: Matrix3::zeros() };
        };
        Self {
            mass_kg: inertia.mass_kg,
            center: inertia.link_from_inertial.translation.vector,
            tensor: inertia.tensor_in_link(),
        }
    }
}

/// Difference relative to the larger of two numbers.
fn relative(a: f64, b: f64) -> f64 {
    if a.to_bits() == b.to_bits() { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()).max(f64::MIN_POSITIVE) }
}

fn relative_of_options(a: Option<f64>, b: Option<f64>) -> f64 {
    match (a, b) {
        (Some(a), Some(b)) => relative(a, b),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    }
}

/// The largest relative difference of kind, range, speed, effort, acceleration, jerk, losses and ratio. A joint without a range is continuous in an
/// MJCF, whatever its source calls it.
fn terms_apart(a: &Joint, b: &Joint) -> f64 {
    let limit = |joint: &Joint| {
        joint
            .limit
            .map_or([None; 5], |of| [of.velocity, of.effort, of.acceleration, of.deceleration, of.jerk])
    };
    let finite =
        |joint: &Joint| joint.position_range().filter(|(low, high)| low.is_finite() && high.is_finite());
    let (range_a, range_b) = (finite(a).unzip(), finite(b).unzip());
    let (mimic_a, mimic_b) = (a.mimic, b.mimic);
    let pairs = [
        (range_a.0, range_b.0),
        (range_a.1, range_b.1),
        (Some(a.damping), Some(b.damping)),
        (Some(a.friction), Some(b.friction)),
        // An MJCF states 0 where a URDF states nothing.
        (Some(a.armature.unwrap_or(0.0)), Some(b.armature.unwrap_or(0.0))),
        (mimic_a.map(|of| of.multiplier), mimic_b.map(|of| of.multiplier)),
        (mimic_a.map(|of| of.offset), mimic_b.map(|of| of.offset)),
    ];
    let is_same_motion = a.kind.is_angular() == b.kind.is_angular();
    let off = pairs
        .into_iter()
        .chain(limit(a).into_iter().zip(limit(b)))
        .map(|(a, b)| relative_of_options(a, b))
        .fold(0.0, larger);
    if is_same_motion { off } else { f64::INFINITY }
}

fn shapes_apart(found: &[Shape], expected: &[Shape]) -> f64 {
    if found.len() != expected.len() {
        return f64::INFINITY;
    }
    let pairs = found.iter().zip(expected);
    pairs.map(|(found, expected)| shape::difference_m(found, expected)).fold(0.0, larger)
}
