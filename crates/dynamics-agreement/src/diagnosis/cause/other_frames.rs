//! Parameters in the frame, or only in the axes, of another frame; and slips with the rotation of the inertial frame.

use congruent_kinematics::{Pose, rotation_exp, rotation_log};
use nalgebra::Matrix3;

use super::slip::Slip;
use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        hypothesis::{Change, FaultySide, Hypothesis, Place},
    },
    side::{Frames, Inertial, Side},
    thresholds::ZERO_VALUE,
};

/// Parameters in the other frame.
#[derive(Clone, Copy)]
struct Wrong {
    cause: DynamicsCause,
    parameters: Parameters,
    /// Only the axes, not the origin.
    axes_only: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum Parameters {
    Com,
    Tensor,
    Both,
}

const KINDS: [Wrong; 5] = [
    Wrong { cause: DynamicsCause::ComFrame, parameters: Parameters::Com, axes_only: false },
    Wrong { cause: DynamicsCause::ComAxes, parameters: Parameters::Com, axes_only: true },
    Wrong { cause: DynamicsCause::InertialFrame, parameters: Parameters::Both, axes_only: false },
    Wrong { cause: DynamicsCause::InertialAxes, parameters: Parameters::Both, axes_only: true },
    Wrong { cause: DynamicsCause::InertiaAxes, parameters: Parameters::Tensor, axes_only: true },
];

pub(super) fn slips(frames: &Frames, faulty: FaultySide) -> Vec<Slip<'_>> {
    let mut slips = Vec::new();
    for other in &frames.others {
        for kind in KINDS {
            let slip = Slip::at_link(kind.cause, other.name.clone(), move |link, parameters| {
                let link_from_frame = other.link_from_frame[link].as_ref()?;
                Some(kind.apply(faulty, link_from_frame, parameters))
            });
            slips.push(slip.with_details_at_links(&other.names_at_links));
        }
    }
    slips.extend(rotations(faulty));
    slips
}

impl Wrong {
    fn apply(self, faulty: FaultySide, link_from_frame: &Pose, parameters: &Inertial) -> Inertial {
        let mut moved = match faulty {
            FaultySide::Candidate => *link_from_frame,
            FaultySide::Reference => link_from_frame.inverse(),
        };
        if self.axes_only {
            moved.translation = nalgebra::Vector3::zeros();
        }
        let mut parameters = *parameters;
        if self.parameters != Parameters::Tensor {
            parameters.com_m = moved.rotation * parameters.com_m + moved.translation;
        }
        if self.parameters != Parameters::Com {
            parameters.link_from_axes = moved.rotation * parameters.link_from_axes;
        }
        parameters
    }
}

/// The rotation of a link's inertial frame that the other description has: left out in the file, or another one. `None`
/// if the parameters are in a frame that is not the link's: then it is no rotation of an `<origin>`.
pub(super) fn rotation_of_reference(side: &Side, reference: &Side, link: usize) -> Option<Hypothesis> {
    let there = reference.frames.find_link(side.frames.link_name(link))?;
    let (written, there) = (side.inertials[link].as_ref()?, reference.inertials[there].as_ref()?);
    let is_of_entry = side.frames.others.iter().any(|other| other.is_links_own_at(link));
    if is_of_entry || (written.link_from_axes - there.link_from_axes).amax() <= ZERO_VALUE {
        return None;
    }
    let cause = if has_rotation(written) { DynamicsCause::Rpy } else { DynamicsCause::RpyMissing };
    let turned = Inertial { link_from_axes: there.link_from_axes, ..*written };
    Some(Hypothesis::new(cause, "", Place::Links(vec![link]), Change::Links(vec![(link, turned)])))
}

fn has_rotation(parameters: &Inertial) -> bool {
    (parameters.link_from_axes - Matrix3::identity()).amax() > ZERO_VALUE
}

fn rotations<'a>(faulty: FaultySide) -> Vec<Slip<'a>> {
    let turned =
        |parameters: &Inertial, link_from_axes: Matrix3<f64>| Inertial { link_from_axes, ..*parameters };
    let mut slips = vec![
        Slip::at_link(DynamicsCause::RpyInverted, "", move |_, parameters| {
            has_rotation(parameters).then(|| turned(parameters, parameters.link_from_axes.transpose()))
        }),
        Slip::at_link(DynamicsCause::RpyTwice, "", move |_, parameters| {
            let turn = parameters.link_from_axes;
            let changed = match faulty {
                FaultySide::Candidate => rotation_exp(&(rotation_log(&turn) * 0.5)),
                FaultySide::Reference => turn * turn,
            };
            has_rotation(parameters).then(|| turned(parameters, changed))
        }),
    ];
    // A rotation that is missing in the file cannot be put back without numbers, or those of the other description.
    if faulty == FaultySide::Reference {
        slips.push(Slip::at_link(DynamicsCause::RpyMissing, "", move |_, parameters| {
            has_rotation(parameters).then(|| turned(parameters, Matrix3::identity()))
        }));
    }
    slips
}
