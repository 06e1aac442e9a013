//! What is inside a body: mass, joints, geoms.

use congruent_description::{Geometry, Inertia, Joint, Robot, Shape};
use nalgebra::{Isometry3, Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};

use super::{assets::Assets, plan::PlannedJoint};
use crate::{
    urdf::color_text,
    xml_text::{Attributes, XmlText},
};

/// Position and orientation; what is the identity is left out.
pub(super) fn pose(attributes: Attributes, pose: &Isometry3<f64>) -> Attributes {
    let attributes = attributes.numbers("pos", pose.translation.vector.iter().copied());
    if pose.rotation == UnitQuaternion::identity() {
        return attributes;
    }
    let [x, y, z, w]: [f64; 4] = pose.rotation.coords.into();
    attributes.numbers("quat", [w, x, y, z])
}

pub(super) fn write_inertia(text: &mut XmlText, inertia: &Inertia) {
    let (turn, moments) = principal(&inertia.tensor_kg_m2);
    let mut body_from_axes = inertia.link_from_inertial;
    body_from_axes.rotation *= turn;
    let mass = pose(Attributes::default(), &body_from_axes).number("mass", inertia.mass_kg);
    text.element("inertial", mass.numbers("diaginertia", moments.iter().copied()));
}

/// The principal axes of a tensor and its moments about them, which a body can have: MuJoCo compares their sums without a
/// tolerance, so rounding below 1e-12 of the largest is taken off. It would iterate to the axes of `fullinertia` itself.
fn principal(tensor: &Matrix3<f64>) -> (UnitQuaternion<f64>, Vector3<f64>) {
    let is_diagonal = [(0, 1), (0, 2), (1, 2)].into_iter().all(|at| tensor[at] == 0.0);
    let (turn, mut moments) = if is_diagonal {
        (UnitQuaternion::identity(), tensor.diagonal())
    } else {
        let largest = tensor.amax();
        let SymmetricEigen { mut eigenvectors, eigenvalues } = SymmetricEigen::new(tensor / largest);
        // A basis of determinant -1 is no rotation; an axis may point in either direction.
        if eigenvectors.determinant() < 0.0 {
            eigenvectors.column_mut(0).neg_mut();
        }
        let turn = Rotation3::from_matrix_unchecked(eigenvectors);
        (UnitQuaternion::from_rotation_matrix(&turn), eigenvalues * largest)
    };
    moments = moments.map(|moment| moment.max(0.0));
    let largest = moments.imax();
    let others = moments[(largest + 1) % 3] + moments[(largest + 2) % 3];
    moments[largest] = moments[largest].min(others);
    (turn, moments)
}

pub(super) fn write_joint(text: &mut XmlText, planned: &PlannedJoint, robot: &Robot) {
    let joint: &Joint = robot.joint(planned.index);
    let kind = if joint.kind.is_angular() { "hinge" } else { "slide" };
    let axis = planned.body_from_joint.rotation * joint.axis_in_joint.into_inner();
    let mut attributes = Attributes::default().text("name", &joint.name).text("type", kind);
    if planned.body_from_joint.translation.vector != Vector3::zeros() && joint.kind.is_angular() {
        attributes = attributes.numbers("pos", planned.body_from_joint.translation.vector.iter().copied());
    }
    attributes = attributes.numbers("axis", axis.iter().copied());
    let is_range = |&(lower, upper): &(f64, f64)| lower.is_finite() && upper.is_finite();
    if let Some((lower, upper)) = joint.position_range().filter(is_range) {
        attributes = attributes.numbers("range", [lower, upper]);
    }
    let loss = |value: f64| (value != 0.0).then_some(value);
    attributes = attributes.optional("damping", loss(joint.damping));
    attributes = attributes.optional("frictionloss", loss(joint.friction));
    text.element("joint", attributes.optional("armature", joint.armature.and_then(loss)));
}

pub(super) fn write_geom(text: &mut XmlText, class: &str, shape: &Shape, assets: &Assets) {
    let attributes = Attributes::default().text("class", class);
    let attributes = match &shape.geometry {
        Geometry::Box { size_m } => {
            attributes.text("type", "box").numbers("size", size_m.iter().map(|side| side / 2.0))
        }
        Geometry::Cylinder { radius_m, length_m } => {
            attributes.text("type", "cylinder").numbers("size", [*radius_m, length_m / 2.0])
        }
        Geometry::Sphere { radius_m } => attributes.text("type", "sphere").number("size", *radius_m),
        Geometry::Ellipsoid { semi_axes_m } => {
            attributes.text("type", "ellipsoid").numbers("size", semi_axes_m.iter().copied())
        }
        Geometry::Mesh(mesh) => {
            let Some(name) = assets.name(mesh) else { return };
            attributes.text("type", "mesh").text("mesh", name)
        }
    };
    let mut attributes = pose(attributes, &shape.link_from_shape);
    if let Some(color) = shape.color_rgba {
        attributes = attributes.text("rgba", &color_text(color));
    }
    text.element("geom", attributes);
}
