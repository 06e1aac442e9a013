//! A body that the robot file declares by its own entry, in the frame of its link.

use congruent_description::{DeclaredInertial, InertialFrame, InertialPoint, Robot};
use congruent_dynamics_agreement::Inertial;
use congruent_kinematics::Pose;
use nalgebra::{Matrix3, Vector3};

use super::model_frames::AtZero;

/// A declared body in the frame of the link that its joint carries.
#[derive(Debug, Clone)]
pub(super) struct DeclaredBody {
    pub(super) joint: usize,
    pub(super) link: usize,
    pub(super) link_from_frame: Pose,
    frame: InertialFrame,
    pub(super) about: InertialPoint,
    /// Declared parameters; those that are not declared are zero here.
    pub(super) parameters: Inertial,
    pub(super) has_com: bool,
    pub(super) has_tensor: bool,
}

impl DeclaredBody {
    pub(super) fn new(declared: &DeclaredInertial, zero: &AtZero, robot: &Robot) -> Self {
        let link = robot.joint(declared.joint).child.get();
        let link_from_frame = match declared.frame {
            InertialFrame::Link => Pose::identity(),
            InertialFrame::Dh(frame) => zero.link_from_dh(link, frame),
        };
        let mut in_frame = Inertial {
            mass_kg: declared.mass_kg,
            com_m: declared.com_m.unwrap_or_else(Vector3::zeros),
            link_from_axes: Matrix3::identity(),
            tensor_kg_m2: declared.tensor_kg_m2.unwrap_or_else(Matrix3::zeros),
        };
        // Parallel axes (Steiner): the tensor about the centre of mass is that about the frame minus m (c.c I - c
        // c^T).
        if declared.about == InertialPoint::Frame && declared.tensor_kg_m2.is_some() {
            in_frame.tensor_kg_m2 -= in_frame.shift();
        }
        Self {
            joint: robot.coordinate(declared.joint).expect("checked to move"),
            link,
            link_from_frame,
            frame: declared.frame,
            about: declared.about,
            parameters: Inertial {
                com_m: link_from_frame.rotation * in_frame.com_m + link_from_frame.translation,
                link_from_axes: link_from_frame.rotation,
                ..in_frame
            },
            has_com: declared.com_m.is_some(),
            has_tensor: declared.tensor_kg_m2.is_some(),
        }
    }

    /// Whether its frame is one of the table.
    pub(super) fn is_in_table(&self) -> bool {
        self.frame != InertialFrame::Link
    }

    /// Parameters as they are written.
    pub(super) fn written(&self) -> Inertial {
        self.about_point(&self.in_frame(&self.parameters))
    }

    /// Parameters of the link in the frame of the entry.
    pub(super) fn in_frame(&self, parameters: &Inertial) -> Inertial {
        let frame_from_link = self.link_from_frame.inverse();
        Inertial {
            com_m: frame_from_link.rotation * parameters.com_m + frame_from_link.translation,
            link_from_axes: frame_from_link.rotation * parameters.link_from_axes,
            ..*parameters
        }
    }

    /// Parameters in the frame of the entry with the tensor in its axes and about the point of the entry.
    pub(super) fn about_point(&self, in_frame: &Inertial) -> Inertial {
        let mut tensor_kg_m2 = in_frame.tensor_in_link();
        if self.about == InertialPoint::Frame {
            tensor_kg_m2 += in_frame.shift();
        }
        Inertial { link_from_axes: Matrix3::identity(), tensor_kg_m2, ..*in_frame }
    }
}
