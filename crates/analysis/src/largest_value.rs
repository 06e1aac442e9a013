//! The largest number of a robot and its states: the likely cause where a computed torque is not finite.

use std::ops::Range;

use congruent_configurations::JointStateList;
use congruent_description::{Robot, RobotDescription};

/// The largest value of masses, inertias, friction and states, what it is and where the URDF says it.
pub fn largest_value(
    description: &RobotDescription,
    robot: &Robot,
    states: &JointStateList,
) -> (String, f64, Option<Range<usize>>) {
    let mut all: Vec<(String, f64, PlaceOf<'_>)> = Vec::new();
    for link in robot.links() {
        let Some(inertia) = &link.inertia else { continue };
        let com = inertia.link_from_inertial.translation.vector.amax();
        let values = [
            ("mass", inertia.mass_kg, "mass"),
            ("centre of mass", com, "origin"),
            ("inertia", inertia.tensor_kg_m2.amax(), "inertia"),
        ];
        let of_link = |(what, value, part)| {
            (format!("link \"{}\": {what}", link.name), value, PlaceOf::Inertial(&link.name, part))
        };
        all.extend(values.map(of_link));
    }
    for joint in robot.joints() {
        let values = [("damping", joint.damping), ("friction", joint.friction)];
        let of_joint = |(what, value)| {
            (format!("joint \"{}\": {what}", joint.name), value, PlaceOf::Dynamics(&joint.name))
        };
        all.extend(values.map(of_joint));
    }
    for (at, state) in states.iter().enumerate() {
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let [v, a, tau] = [&state.qd, &state.qdd, &state.tau].map(|values| largest(values));
        let named = [("\"v\"", v), ("\"a\"", a), ("\"tau\"", tau)];
        all.extend(named.map(|(what, value)| (format!("state {}: {what}", at + 1), value, PlaceOf::State)));
    }
    let largest = all.into_iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let Some((what, value, place)) = largest else { return ("no value".to_owned(), 0.0, None) };
    // Of this one alone: the file is parsed for each place.
    let span = description.places.urdf.as_ref().and_then(|places| match place {
        PlaceOf::Inertial(link, part) => places.inertial_part(link, part),
        PlaceOf::Dynamics(joint) => places.joint_dynamics(joint),
        PlaceOf::State => None,
    });
    (what, value, span)
}

/// Where a value is written.
enum PlaceOf<'a> {
    /// An element of the inertial of a link.
    Inertial(&'a str, &'a str),
    /// The losses of a joint.
    Dynamics(&'a str),
    /// A state of the caller.
    State,
}
