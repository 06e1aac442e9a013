//! Masses, inertias, limits and losses that two descriptions write with other digits.
//!
//! Each value is judged by itself: two are one value if they differ by at most half of the last place of the coarser one. Two
//! files that round a value to the same place write the same number, so a last digit that differs is a difference.

use congruent_description::{Inertia, InertiaRounding, Joint, JointKind, JointLimit, Link, Robot};
use congruent_kinematics::PoseError;
use nalgebra::{SMatrix, Vector3};

use crate::digits::MOST;

/// Differences below this share of a value are none of digits. Kind: rounding.
const SAME: f64 = 1e-9;

/// A limit that may be missing.
type LimitField = fn(&mut JointLimit) -> &mut Option<f64>;

/// The limits that may be missing, by name.
const LIMITS: [(&str, LimitField); 5] = [
    ("velocity", |limit| &mut limit.velocity),
    ("effort", |limit| &mut limit.effort),
    ("acceleration", |limit| &mut limit.acceleration),
    ("deceleration", |limit| &mut limit.deceleration),
    ("jerk", |limit| &mut limit.jerk),
];

/// How far frames of links of two files are apart by what their digits leave open.
#[derive(Debug, Clone, Copy, Default)]
pub struct DigitsOfFrames {
    /// The most of any frame.
    pub apart: PoseError,
    /// The most of a frame that was chosen on the axis of its joint, along this axis: it has the rounding of all joints before it.
    pub along_axis_m: f64,
}

/// The other robot with the values of this one where the digits that the two are written with explain the difference, and the
/// names of these values, as `elbow_joint: effort` and `forearm_link: mass`.
///
/// Links and joints are matched by name; those of both must have the same variables, and the same frames up to `of_frames`.
pub fn with_values_within_digits(
    [robot, other]: [&Robot; 2],
    of_frames: DigitsOfFrames,
) -> (Robot, Vec<String>) {
    let mut names = Vec::new();
    let mut same = other.with_joints(|there| {
        let Some(own) = robot.find_joint(&there.name).map(|index| robot.joint(index)) else { return };
        let found = adopt_values(there, own);
        names.extend(found.into_iter().map(|value| format!("{}: {value}", there.name)));
    });
    for there in other.link_indices() {
        let link = other.link(there);
        let Some(own) = robot.find_link(&link.name).map(|index| robot.link(index)) else { continue };
        let joint = other.parent_joint(there).map(|joint| other.joint(joint));
        let along_axis = joint.filter(|joint| !joint.rounding.frame.is_empty());
        let along_axis_m = along_axis
            .map_or_else(Vector3::zeros, |joint| joint.axis_in_joint.abs() * of_frames.along_axis_m);
        if let Some((inertia, found)) = inertia_within_digits([own, link], of_frames.apart, &along_axis_m) {
            same.set_inertia(there, inertia);
            names.extend(found.into_iter().map(|value| format!("{}: {value}", link.name)));
        }
    }
    (same, names)
}

/// Gives a joint the values of another that are the same within the digits; returns their names.
fn adopt_values(there: &mut Joint, own: &Joint) -> Vec<&'static str> {
    if own.kind == JointKind::Fixed || own.kind.is_angular() != there.kind.is_angular() {
        return Vec::new();
    }
    let mut names = Vec::new();
    let mut adopt = |name: &'static str, [value, half]: [f64; 2], other: &mut f64, other_half: f64| {
        if is_rounded_value(value, *other, half.max(other_half)) {
            *other = value;
            names.push(name);
        }
    };
    let (mut half, mut other_half) = (own.value_rounding, there.value_rounding);
    if let (Some(mut limit), Some(other)) = (own.limit, &mut there.limit) {
        adopt("lower", [limit.lower, half.limit.lower], &mut other.lower, other_half.limit.lower);
        adopt("upper", [limit.upper, half.limit.upper], &mut other.upper, other_half.limit.upper);
        for (name, field) in LIMITS {
            let [half, other_half] =
                [&mut half, &mut other_half].map(|of| field(&mut of.limit).unwrap_or_default());
            if let (Some(value), Some(other)) = (*field(&mut limit), field(other)) {
                adopt(name, [value, half], other, other_half);
            }
        }
    }
    adopt("damping", [own.damping, half.damping], &mut there.damping, other_half.damping);
    adopt("friction", [own.friction, half.friction], &mut there.friction, other_half.friction);
    if let (Some(value), Some(other)) = (own.armature, &mut there.armature) {
        adopt("armature", [value, half.armature], other, other_half.armature);
    }
    names
}

/// Whether two values differ, by half of a last place at most: `half` is that of the coarser one.
pub fn is_rounded_value(value: f64, other: f64, half: f64) -> bool {
    let off = (value - other).abs();
    off > SAME * value.abs().max(other.abs()) && off <= MOST * half
}

/// The inertia of the second link with the parts of the first one's that are the same within the digits, and their names; `None` if
/// there are none. The frames of the two are apart by `of_frames` at most, and by `along_axis_m` along the axis of their joint.
pub fn inertia_within_digits(
    [own, there]: [&Link; 2],
    of_frames: PoseError,
    along_axis_m: &Vector3<f64>,
) -> Option<(Inertia, Vec<&'static str>)> {
    let ((here, mut inertia), mut names) = (own.inertia.zip(there.inertia)?, Vec::new());
    let most = coarser(&own.inertia_rounding, &there.inertia_rounding);
    if is_rounded_value(here.mass_kg, inertia.mass_kg, most.mass_kg) {
        inertia.mass_kg = here.mass_kg;
        names.push("mass");
    }
    let [from, to] = [&here, &inertia].map(|of| of.link_from_inertial.translation);
    let shift_m = of_frames.position_m + of_frames.orientation_rad * from.vector.norm();
    if are_rounded(&from.vector, &to.vector, &(most.com_m.add_scalar(shift_m) + along_axis_m)) {
        inertia.link_from_inertial.translation = from;
        names.push("centre of mass");
    } else if from != to && (from.vector - to.vector).amax() <= SAME * from.vector.amax() {
        // A point that was computed and written with twelve digits is the point.
        inertia.link_from_inertial.translation = from;
    }
    let [own, other] = [&here, &inertia].map(Inertia::tensor_in_link);
    let turned = 2.0 * of_frames.orientation_rad * own.norm();
    if (own - other).amax() <= SAME * own.amax().max(other.amax()) {
        // Equal, in whatever axes: nothing is rounded.
    } else if are_rounded(&own, &other, &most.tensor_kg_m2.add_scalar(turned)) {
        inertia.link_from_inertial.rotation = here.link_from_inertial.rotation;
        inertia.tensor_kg_m2 = here.tensor_kg_m2;
        names.push("inertia");
    } else if are_rounded(&here.tensor_kg_m2, &inertia.tensor_kg_m2, &most.tensor_kg_m2) {
        // Only the axes differ then, as without the rotation of an inertial frame.
        inertia.tensor_kg_m2 = here.tensor_kg_m2;
        names.push("moments of inertia");
    }
    (Some(inertia) != there.inertia).then_some((inertia, names))
}

/// Whether entries differ, each by half of a last place at most.
fn are_rounded<const R: usize, const C: usize>(
    own: &SMatrix<f64, R, C>,
    other: &SMatrix<f64, R, C>,
    most: &SMatrix<f64, R, C>,
) -> bool {
    let (off, same) = ((own - other).abs(), SAME * own.amax().max(other.amax()));
    off.amax() > same && off.iter().zip(most.iter()).all(|(off, most)| *off <= MOST * most + same)
}

fn coarser(own: &InertiaRounding, other: &InertiaRounding) -> InertiaRounding {
    InertiaRounding {
        mass_kg: own.mass_kg.max(other.mass_kg),
        com_m: own.com_m.sup(&other.com_m),
        tensor_kg_m2: own.tensor_kg_m2.sup(&other.tensor_kg_m2),
    }
}

#[cfg(test)]
mod tests {
    use congruent_description::{MappedJoint, parse_urdf};

    use super::*;

    /// An arm with these texts of a mass, a coordinate of the centre of mass, an angle of the inertial frame, a moment, an effort
    /// and an end of the range.
    fn arm([mass, com, yaw, ixx, effort, upper]: [&str; 6]) -> Robot {
        let text = format!(
            "<robot name='r'><link name='base'/><link name='arm'><inertial><mass value='{mass}'/>\
             <origin xyz='{com} 0 0' rpy='0 0 {yaw}'/>\
             <inertia ixx='{ixx}' iyy='0.0345' izz='0.0612' ixy='0' ixz='0' iyz='0'/></inertial></link>\
             <joint name='j' type='revolute'><parent link='base'/><child link='arm'/>\
             <limit lower='-1.2345' upper='{upper}' effort='{effort}' velocity='2'/></joint></robot>"
        );
        parse_urdf(&text).unwrap()
    }

    const EXACT: [&str; 6] = ["3.76123", "0.123456", "1.57079632679", "0.0456789", "10.26", "2.96706"];

    fn rounded(at: usize, text: &'static str) -> [&'static str; 6] {
        let mut texts = EXACT;
        texts[at] = text;
        texts
    }

    /// Whether the other has the own values then, whichever of the two is written with fewer digits.
    fn names(texts: [&str; 6]) -> Vec<String> {
        let (own, other) = (arm(EXACT), arm(texts));
        let (same, names) = with_values_within_digits([&own, &other], DigitsOfFrames::default());
        if !names.is_empty() {
            assert_eq!(same.links()[1].inertia, own.links()[1].inertia);
            assert_eq!(same.joints()[0].limit, own.joints()[0].limit);
        }
        assert_eq!(
            with_values_within_digits([&other, &own], DigitsOfFrames::default()).1,
            names,
            "the other way round"
        );
        names
    }

    #[test]
    fn values_with_fewer_digits_are_the_same_values() {
        for (at, text, name) in [
            (0, "3.76", "arm: mass"),
            (1, "0.1235", "arm: centre of mass"),
            (2, "1.5708", "arm: inertia"),
            (3, "0.0457", "arm: inertia"),
            (4, "10.3", "j: effort"),
            (5, "2.967", "j: upper"),
        ] {
            assert_eq!(names(rounded(at, text)), [name], "{text}");
        }
        assert_eq!(names(EXACT), [""; 0], "equal values are not named");
    }

    /// The same tensor in turned axes: whatever the digits allow, nothing of it is adopted in other axes.
    #[test]
    fn an_equal_tensor_in_other_axes_stays() {
        let own = arm(["3", "0.1", "0", "0.05", "10", "2"]);
        let mut other = own.clone();
        let mut inertia = own.links()[1].inertia.unwrap();
        let turn = nalgebra::UnitQuaternion::from_euler_angles(0.3, -0.5, 0.7);
        let turned = turn.to_rotation_matrix();
        inertia.link_from_inertial.rotation *= turn;
        inertia.tensor_kg_m2 = turned.matrix().transpose() * inertia.tensor_kg_m2 * turned.matrix();
        other.set_inertia(other.find_link("arm").unwrap(), inertia);
        let (same, names) = with_values_within_digits([&own, &other], DigitsOfFrames::default());
        assert_eq!(names, [""; 0]);
        assert_eq!(same, other);
    }

    /// A frame that was chosen on its axis has the rounding of all joints before it, along this axis alone.
    #[test]
    fn a_frame_that_was_chosen_shifts_the_centre_of_mass_along_its_axis() {
        let (own, other) = (arm(EXACT), arm(rounded(1, "0.124456")));
        let chosen = other.with_joints(|joint| joint.rounding.frame = crate::free_frame(&Vector3::zeros()));
        let names = |other: &Robot, along_axis_m: f64| {
            let of_frames = DigitsOfFrames { along_axis_m, ..DigitsOfFrames::default() };
            with_values_within_digits([&own, other], of_frames).1
        };
        // The axis of a URDF that gives none is x.
        assert_eq!(names(&chosen, 2e-3), ["arm: centre of mass"]);
        assert_eq!(names(&chosen, 5e-4), [""; 0], "1 mm is more");
        assert_eq!(names(&other, 2e-3), [""; 0], "the frame is that of the file");
    }

    #[test]
    fn a_last_place_that_is_off_is_a_difference() {
        for (at, text) in [
            (0, "3.77"),
            (1, "0.1236"),
            (2, "1.5711"),
            (3, "0.0459"),
            (4, "10.4"),
            (5, "2.968"),
            (0, "4"),
            (4, "10"),
        ] {
            assert_eq!(names(rounded(at, text)), [""; 0], "{text}");
        }
    }

    #[test]
    fn an_end_of_a_range_keeps_its_digits_in_the_other_direction() {
        let other = arm(EXACT);
        let joint = other.movable_joints()[0];
        let mapped = MappedJoint { joint, name: "j".to_owned(), is_flipped: true, offset: 0.0 };
        let there = other.in_variables(&[mapped]);
        let limit = there.joints()[0].value_rounding.limit;
        assert!(limit.lower < 1e-5 && limit.upper > 1e-5, "5e-6 of 2.96706 and 5e-5 of -1.2345: {limit:?}");
    }
}
