//! Keyframes, and sections that are not read.

use super::{attributes::MjAttributes, names::MjNamed, reader::MjReader};
use crate::{
    codes,
    model::{MjKeyframe, MjWritten},
};

impl MjReader<'_, '_> {
    /// The keyframes of the main model. Those of an attached model give the positions of that model alone, and are reported.
    pub(super) fn keyframes(&mut self, attachment: usize) {
        for element in self.scope(attachment).root.in_sections("keyframe") {
            if attachment > 0 {
                let message = format!("{} of an attached model is not read", element.label());
                let found = element.warning(codes::mjcf::UNSUPPORTED, message);
                self.diagnostics
                    .push(found.one_of("keyframes of attached models are not read", element.label()));
                continue;
            }
            let name = self.name_of(MjNamed::Keyframe, element, attachment, "");
            let positions = MjAttributes::own(element)
                .find("qpos")
                .map(|found| MjWritten { value: found.numbers(), place: Some(found.place()) });
            let expected = self.model.positions();
            if let Some(found) =
                positions.as_ref().map(|found| found.value.len()).filter(|&found| found != expected)
            {
                let message = format!(
                    "{}: qpos has {found} numbers, the model has {expected} positions",
                    element.label()
                );
                let help = "one for a hinge or slide, four for a ball joint, seven for a free joint";
                let fault = element.fault_at("qpos", codes::mjcf::KEYFRAME, message);
                self.diagnostics.push(fault.with_help(help));
            }
            self.model.keyframes.push(MjKeyframe { name, positions });
        }
    }

    /// Reports bodies that bend.
    pub(super) fn unread_sections(&mut self, attachment: usize) {
        let root = &self.scope(attachment).root;
        for element in root.in_sections("deformable").filter(|child| child.tag == "flex") {
            self.unread(element);
        }
    }
}
