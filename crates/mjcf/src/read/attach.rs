//! `<attach>`: a body, a frame or the whole of another model, under a prefix. What is attached keeps the settings and classes
//! of its own model, and brings along the actuators and equalities that refer to it.

use super::{
    reader::{MjAttachment, MjContext, MjReader},
    tree::MjPending,
};
use crate::{codes, document::MjElement};
use congruent_input::known_names;

/// An element of another model, and the nearest `childclass` around it there.
struct MjFoundPart<'s> {
    element: &'s MjElement,
    class: Option<&'s str>,
}

impl<'s> MjReader<'s, '_> {
    pub(super) fn attached(
        &mut self,
        element: &'s MjElement,
        context: &MjContext<'s>,
        body: usize,
        bodies: &mut Vec<MjPending<'s>>,
    ) -> Option<()> {
        let Some(model) = element.text("model") else {
            let message = "<attach> without `model` copies a part of its own model, which is not read";
            let help = "write the part out, or keep it in a file of its own that <model> in <asset> names";
            self.diagnostics.push(element.fault(codes::mjcf::ATTACH, message).with_help(help));
            return Some(());
        };
        let scope = self.scope(context.attachment);
        let Some(child) = scope.models.get(model) else {
            let message = format!("<attach>: there is no model \"{model}\"");
            let help = known_names(model, "models", scope.models.keys().map(String::as_str));
            self.diagnostics.push(element.fault_at("model", codes::mjcf::ATTACH, message).with_help(help));
            return Some(());
        };
        let outer = &self.attachments[context.attachment];
        let attachment = self.attach(MjAttachment {
            scope: child,
            prefix: format!("{}{}", outer.prefix, element.text("prefix").unwrap_or_default()),
            suffix: format!("{}{}", context.replica, outer.suffix),
        })?;
        let inside = MjContext {
            attachment,
            replica: String::new(),
            class: None,
            body_from_frame: context.body_from_frame,
            frame: context.frame,
            depth: context.depth + 1,
        };
        let wanted = [("body", element.text("body")), ("frame", element.text("frame"))];
        let given: Vec<(&str, &str)> =
            wanted.into_iter().filter_map(|(kind, name)| Some((kind, name?))).collect();
        match given[..] {
            [] => {
                for section in child.root.all("worldbody") {
                    self.contents(section, &inside, body, bodies)?;
                }
            }
            [(kind, name)] => {
                let Some(part) = part(child.root.all("worldbody"), kind, name) else {
                    let message = format!("<attach>: model \"{model}\" has no {kind} \"{name}\"");
                    self.diagnostics.push(element.fault_at(kind, codes::mjcf::ATTACH, message));
                    return Some(());
                };
                let inside = MjContext { class: part.class, ..inside };
                if kind == "body" {
                    bodies.push(MjPending { element: part.element, context: inside });
                } else {
                    self.frame(part.element, &inside, body, bodies)?;
                }
            }
            _ => {
                let message = "<attach> names a body and a frame, at most one of them is allowed";
                self.diagnostics
                    .push(element.fault(codes::mjcf::ATTACH, message).with_help("keep one of them"));
            }
        }
        Some(())
    }
}

/// The body or frame of this name, anywhere below; frames around it do not move it, their classes hold.
fn part<'s>(
    sections: impl Iterator<Item = &'s MjElement>,
    kind: &str,
    name: &str,
) -> Option<MjFoundPart<'s>> {
    let mut open: Vec<MjFoundPart<'s>> =
        sections.map(|element| MjFoundPart { element, class: None }).collect();
    while let Some(MjFoundPart { element, class }) = open.pop() {
        if element.tag == kind && element.name() == Some(name) {
            return Some(MjFoundPart { element, class });
        }
        let class = element.text("childclass").or(class);
        open.extend(element.children.iter().map(|element| MjFoundPart { element, class }));
    }
    None
}
