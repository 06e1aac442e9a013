//! Mistakes with the frame of parameters (another frame, or only its axes), and mistakes with the rotation of the inertial frame.

use congruent_kinematics::{Pose, rotation_exp, rotation_log};
use nalgebra::Matrix3;

use super::common_mistake::CommonMistake;
use crate::{
    diagnosis::{
        cause_names::{DynamicsCause, MISSING_THERE},
        hypothesis::{Change, DynamicsHypothesis, DynamicsPlace, FaultySide},
    },
    model::{DynamicsModel, Frames, Inertial},
    thresholds::ZERO_VALUE,
};

/// Which parameters are given in the other frame, and the cause for that.
#[derive(Clone, Copy)]
struct FrameMistake {
    cause: DynamicsCause,
    parameters: MisplacedParameters,
    /// Whether only the axes are those of the other frame, not the origin.
    axes_only: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum MisplacedParameters {
    Com,
    Tensor,
    Both,
}

const KINDS: [FrameMistake; 5] = [
    FrameMistake { cause: DynamicsCause::ComFrame, parameters: MisplacedParameters::Com, axes_only: false },
    FrameMistake { cause: DynamicsCause::ComAxes, parameters: MisplacedParameters::Com, axes_only: true },
    FrameMistake {
        cause: DynamicsCause::InertialFrame,
        parameters: MisplacedParameters::Both,
        axes_only: false,
    },
    FrameMistake {
        cause: DynamicsCause::InertialAxes,
        parameters: MisplacedParameters::Both,
        axes_only: true,
    },
    FrameMistake {
        cause: DynamicsCause::InertiaAxes,
        parameters: MisplacedParameters::Tensor,
        axes_only: true,
    },
];

pub(super) fn mistakes(frames: &Frames, faulty: FaultySide) -> Vec<CommonMistake<'_>> {
    let mut mistakes = Vec::new();
    for other in &frames.others {
        for kind in KINDS {
            let mistake = CommonMistake::at_link(kind.cause, other.name.clone(), move |link, parameters| {
                let link_from_frame = other.link_from_frame[link].as_ref()?;
                Some(kind.apply(faulty, link_from_frame, parameters))
            });
            mistakes.push(mistake.with_details_at_links(&other.names_at_links));
        }
    }
    mistakes.extend(rotations(faulty));
    mistakes
}

impl FrameMistake {
    fn apply(self, faulty: FaultySide, link_from_frame: &Pose, parameters: &Inertial) -> Inertial {
        let mut moved = match faulty {
            // Values written in the frame are moved into the link. What was built wrongly took right values for
            // values of the frame: the inverse.
            FaultySide::Candidate => *link_from_frame,
            FaultySide::Reference => link_from_frame.inverse(),
        };
        if self.axes_only {
            moved.translation = nalgebra::Vector3::zeros();
        }
        let mut parameters = *parameters;
        // The tensor is about the centre of mass: a shift of the frame does not change it, only its axes.
        if self.parameters != MisplacedParameters::Tensor {
            parameters.com_m = moved.rotation * parameters.com_m + moved.translation;
        }
        if self.parameters != MisplacedParameters::Com {
            parameters.link_from_axes = moved.rotation * parameters.link_from_axes;
        }
        parameters
    }
}

/// The rotation of a link's inertial frame in the other description, if the file has none or another one. `None` if the
/// parameters are given in a frame other than the link's: then the rotation is not that of an `<origin>`.
pub(super) fn rotation_of_reference(
    model: &DynamicsModel,
    reference: &DynamicsModel,
    link: usize,
) -> Option<DynamicsHypothesis> {
    let there = reference.frames.find_link(model.frames.link_name(link))?;
    let (written, there) = (model.inertials[link].as_ref()?, reference.inertials[there].as_ref()?);
    let is_of_entry = model.frames.others.iter().any(|other| other.is_links_own_at(link));
    if is_of_entry || (written.link_from_axes - there.link_from_axes).amax() <= ZERO_VALUE {
        return None;
    }
    let (cause, detail) = match [written, there].map(has_rotation) {
        [false, _] => (DynamicsCause::RpyMissing, ""),
        [true, false] => (DynamicsCause::Rpy, MISSING_THERE),
        [true, true] => (DynamicsCause::Rpy, ""),
    };
    let turned = Inertial { link_from_axes: there.link_from_axes, ..*written };
    Some(DynamicsHypothesis::new(
        cause,
        detail,
        DynamicsPlace::Links(vec![link]),
        Change::Links(vec![(link, turned)]),
    ))
}

fn has_rotation(parameters: &Inertial) -> bool {
    (parameters.link_from_axes - Matrix3::identity()).amax() > ZERO_VALUE
}

fn rotations<'a>(faulty: FaultySide) -> Vec<CommonMistake<'a>> {
    let turned =
        |parameters: &Inertial, link_from_axes: Matrix3<f64>| Inertial { link_from_axes, ..*parameters };
    let mut mistakes = vec![
        CommonMistake::at_link(DynamicsCause::RpyInverted, "", move |_, parameters| {
            has_rotation(parameters).then(|| turned(parameters, parameters.link_from_axes.transpose()))
        }),
        CommonMistake::at_link(DynamicsCause::RpyTwice, "", move |_, parameters| {
            let turn = parameters.link_from_axes;
            let changed = match faulty {
                // Half of the rotation vector is the rotation that, applied twice, gives the one in the file.
                FaultySide::Candidate => rotation_exp(&(rotation_log(&turn) * 0.5)),
                FaultySide::Reference => turn * turn,
            };
            has_rotation(parameters).then(|| turned(parameters, changed))
        }),
    ];
    // A rotation that the file lacks cannot be restored without free parameters or the other description.
    if faulty == FaultySide::Reference {
        mistakes.push(CommonMistake::at_link(DynamicsCause::RpyMissing, "", move |_, parameters| {
            has_rotation(parameters).then(|| turned(parameters, Matrix3::identity()))
        }));
    }
    mistakes
}
