//! Materials that shapes refer to and that the file does not define.

use std::collections::BTreeSet;

use congruent_description::{RobotDescription, node::tag};
use congruent_input::{Diagnostic, Diagnostics, known_names, xml};

use crate::codes;

/// Warnings of materials that have neither a colour nor a texture anywhere in the file: every viewer then chooses a colour of
/// its own.
pub fn undefined_materials(description: &RobotDescription) -> Vec<Diagnostic> {
    let Some(places) = &description.places.urdf else { return Vec::new() };
    let Ok(document) = xml::parse(&places.source().text) else { return Vec::new() };
    let (defined, named): (Vec<_>, Vec<_>) = document
        .descendants()
        .filter(|node| node.has_tag_name("material"))
        .filter_map(|node| Some((node, node.attribute("name").filter(|name| !name.is_empty())?)))
        // A material with a colour or texture defines its name, an empty one refers to it.
        .partition(|(node, _)| node.children().any(|child| child.is_element()));
    let defined: BTreeSet<&str> = defined.into_iter().map(|(_, name)| name).collect();
    let mut found = Diagnostics::default();
    for (node, name) in named.into_iter().filter(|(_, name)| !defined.contains(name)) {
        let warning =
            Diagnostic::warning(codes::urdf::MATERIAL, format!("material \"{name}\" is not defined"))
                .one_of("materials are named that are not defined", name)
                .with_help(known_names(name, "materials", defined.iter().copied()));
        found.push(warning.at(tag(node)));
    }
    found.in_file(places.source())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use congruent_description::parse_robot;
    use congruent_input::SourceFile;

    #[test]
    fn a_material_is_defined_anywhere_in_the_file() {
        let findings = |material: &str| {
            let visual = |material: &str| {
                format!("<visual><geometry><box size='1 1 1'/></geometry>{material}</visual>")
            };
            let colour = "<color rgba='0 0 1 1'/>";
            let text = format!(
                "<robot name='r'><material name='steel'>{colour}</material><link name='a'>{}{}{}</link></robot>",
                visual(material),
                visual(&format!("<material name='blue'>{colour}</material>")),
                visual(&format!("<material name=''>{colour}</material>")),
            );
            let source = Arc::new(SourceFile { path: "r.urdf".into(), text, is_foreign: false });
            let found = undefined_materials(&parse_robot(None, &source).unwrap());
            found.into_iter().map(|found| found.message).collect::<Vec<_>>()
        };
        for defined in ["", "<material name='steel'/>", "<material name='blue'/>", "<material name=''/>"] {
            assert_eq!(findings(defined), [""; 0], "{defined}");
        }
        assert_eq!(findings("<material name='stele'/>"), ["material \"stele\" is not defined"]);
    }
}
