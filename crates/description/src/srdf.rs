//! SRDF: the pairs of links that are excluded from collision checking.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::Arc,
};

use congruent_input::{Capability, Diagnostic, SourceFile, known_names, xml};
use congruent_robot::{LinkIndex, Robot};

use crate::codes;

/// Size limit of an SRDF, bytes.
pub(crate) const SRDF_BYTES: u64 = 16 << 20;

/// The pairs that `<disable_collisions>` names, the smaller index first, and the findings about the file.
pub(crate) fn parse(
    source: &Arc<SourceFile>,
    robot: &Robot,
) -> (BTreeSet<(LinkIndex, LinkIndex)>, Vec<Diagnostic>) {
    let mut pairs = BTreeSet::new();
    let document = match xml::parse(&source.text) {
        Ok(document) => document,
        Err(fault) => return (pairs, vec![fault.needed_by(Some(Capability::Clearance)).in_file(source)]),
    };
    let mut diagnostics = Vec::new();
    let links: BTreeMap<&str, LinkIndex> =
        robot.link_indices().map(|index| (robot.link(index).name.as_str(), index)).collect();
    for node in document.descendants().filter(|node| node.has_tag_name("disable_collisions")) {
        let mut link = |key: &str| {
            let name = node.attribute(key).unwrap_or_default();
            links.get(name).copied().or_else(|| {
                let message = format!("<disable_collisions>: {key} \"{name}\" is not a link of the robot");
                let diagnostic = Diagnostic::warning(codes::srdf::UNKNOWN_LINK, message)
                    .one_of("names in <disable_collisions> are not links of the robot", name)
                    .at(node.range())
                    .with_help(known_names(name, "links", links.keys().copied()));
                diagnostics.push(diagnostic.in_file(source));
                None
            })
        };
        if let (Some(one), Some(other)) = (link("link1"), link("link2")) {
            pairs.insert((one.min(other), one.max(other)));
        }
    }
    (pairs, diagnostics)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (usize, Vec<String>) {
        let urdf = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'>\
                    <parent link='a'/><child link='b'/></joint></robot>";
        let robot = crate::parse_urdf(urdf).unwrap();
        let source = Arc::new(SourceFile { path: "r.srdf".into(), text: text.to_owned(), is_foreign: false });
        let (pairs, diagnostics) = parse(&source, &robot);
        (pairs.len(), diagnostics.into_iter().map(|found| found.message).collect())
    }

    #[test]
    fn pairs_are_unordered_and_unknown_links_are_warned_of() {
        let (pairs, diagnostics) = read(
            "<robot name='r'><disable_collisions link1='a' link2='b' reason='Adjacent'/>\
             <disable_collisions link1='b' link2='a'/><disable_collisions link1='a' link2='c'/></robot>",
        );
        assert_eq!(pairs, 1);
        assert_eq!(diagnostics, ["<disable_collisions>: link2 \"c\" is not a link of the robot"]);
        assert_eq!(read("<robot>").0, 0);
    }
}
