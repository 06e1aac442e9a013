//! Links and joints of the robot that was read, for those of the robot that was written.

use congruent_description::{JointIndex, LinkIndex, Robot};
use congruent_input::Diagnostic;

use crate::{
    codes,
    mjcf::{bodies, keeps_frame},
};

/// Two robots whose links and joints have the same names.
pub(super) struct Matched<'a> {
    pub(super) written: &'a Robot,
    pub(super) found: &'a Robot,
    /// For each link of the written robot that of the found one.
    pub(super) links: Vec<LinkIndex>,
    /// Whether the frame of a link must be the same: that of a link between two joints of an MJCF need not.
    pub(super) is_compared: Vec<bool>,
    /// The moving joints of both.
    pub(super) joints: Vec<(JointIndex, JointIndex)>,
}

impl<'a> Matched<'a> {
    pub(super) fn new(written: &'a Robot, found: &'a Robot) -> Result<Self, Diagnostic> {
        let missing = |what: &str, name: &str| {
            let message = format!("the written text has no {what} \"{name}\" when it is read again");
            Diagnostic::error(codes::write::READ_BACK, message)
        };
        let link = |link: &congruent_description::Link| {
            found.find_link(&link.name).ok_or_else(|| missing("link", &link.name))
        };
        let joint = |&index: &JointIndex| {
            let name = &written.joint(index).name;
            let other = found.find_joint(name).filter(|&joint| found.joint(joint).kind.is_movable());
            Ok((index, other.ok_or_else(|| missing("moving joint", name))?))
        };
        if written.dof() != found.dof() {
            let message = format!(
                "{} joints move when the written text is read again, instead of {}",
                found.dof(),
                written.dof()
            );
            return Err(Diagnostic::error(codes::write::READ_BACK, message));
        }
        let mut is_compared = vec![true; written.links().len()];
        for plan in bodies(written) {
            for above in plan.joints.iter().filter(|joint| !keeps_frame(written, joint)) {
                let child = written.joint(above.index).child;
                is_compared[child.get()] = child == plan.link;
            }
        }
        Ok(Self {
            written,
            found,
            links: written.links().iter().map(link).collect::<Result<_, _>>()?,
            is_compared,
            joints: written.movable_joints().iter().map(joint).collect::<Result<_, Diagnostic>>()?,
        })
    }
}
