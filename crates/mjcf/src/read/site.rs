//! Sites: named frames of a body.

use super::{
    attributes::MjAttributes,
    geom::from_to,
    names::MjNamed,
    orientation::MjWrittenPose,
    reader::{MjContext, MjReader},
};
use crate::{
    codes,
    document::MjElement,
    model::{MjName, MjSite},
};

impl<'s> MjReader<'s, '_> {
    pub(super) fn site(&mut self, element: &'s MjElement, context: &MjContext<'s>, body: usize) {
        let attributes = MjAttributes::with_class(element, self.class(element, context));
        let settings = &self.scope(context.attachment).settings;
        let pose = MjWrittenPose::read(&attributes, settings, self.diagnostics).isometry();
        let pose = match attributes.find("fromto") {
            None => pose,
            Some(found) => {
                let ends = from_to(&found.array([0.0; 6]).value);
                let message = format!("{}: the points of fromto are the same", element.label());
                let ends = ends.ok_or_else(|| found.attribute.fault(codes::mjcf::GEOM, message));
                self.diagnostics.keep(ends).map_or(pose, |ends| ends.pose)
            }
        };
        let index = self.model.sites.len();
        let name = self.named(MjNamed::Site, element, context, index);
        let number = index - self.model.bodies[body].sites.start + 1;
        let owner = &self.model.bodies[body].name;
        self.model.sites.push(MjSite {
            name: MjName {
                is_written: name.is_some(),
                text: name.unwrap_or_else(|| format!("site {number} of {owner}")),
            },
            body,
            body_from_site: context.body_from_frame * pose,
            place: element.place(),
        });
    }
}
