//! Checks an SRDF by itself, and its link and joint names against its robot.

use std::{
    cell::Cell,
    collections::{BTreeMap, BTreeSet},
    sync::Arc,
};

use congruent_description::{
    Robot,
    node::{elements, label, tag},
};
use congruent_input::{Code, Diagnostic, Diagnostics, SourceFile, known_names, xml};
use roxmltree::Node;

use super::{encoding::declared_encoding, srdf_elements::examine_elements, srdf_groups::examine_groups};
use crate::codes;

/// The kind of thing that an attribute refers to by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum ReferenceKind {
    Link,
    Joint,
    Group,
}

impl ReferenceKind {
    const fn code(self) -> &'static Code {
        match self {
            Self::Link => congruent_description::codes::srdf::UNKNOWN_LINK,
            Self::Joint => codes::srdf::UNKNOWN_JOINT,
            Self::Group => codes::srdf::UNKNOWN_GROUP,
        }
    }

    /// The words for several unknown names (after their number), for one, and for the list of known names.
    const fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Link => ("link names are not in the robot", "link of the robot", "links"),
            Self::Joint => ("joint names are not in the robot", "joint of the robot", "joints"),
            Self::Group => ("group names are not defined in this file", "group of this file", "groups"),
        }
    }
}

/// The attributes that are names: the parent (any if it is empty), the element, the attribute, and whether it must be there.
const NAMES: &[(&str, &str, &str, ReferenceKind, bool)] = &[
    ("group", "link", "name", ReferenceKind::Link, true),
    ("group", "joint", "name", ReferenceKind::Joint, true),
    ("group", "chain", "base_link", ReferenceKind::Link, true),
    ("group", "chain", "tip_link", ReferenceKind::Link, true),
    ("group", "group", "name", ReferenceKind::Group, true),
    ("robot", "group_state", "group", ReferenceKind::Group, true),
    ("group_state", "joint", "name", ReferenceKind::Joint, true),
    ("robot", "end_effector", "parent_link", ReferenceKind::Link, true),
    ("robot", "end_effector", "group", ReferenceKind::Group, true),
    ("robot", "end_effector", "parent_group", ReferenceKind::Group, false),
    ("robot", "virtual_joint", "child_link", ReferenceKind::Link, true),
    ("robot", "passive_joint", "name", ReferenceKind::Joint, true),
    ("robot", "link_sphere_approximation", "link", ReferenceKind::Link, true),
    ("robot", "disable_default_collisions", "link", ReferenceKind::Link, true),
    ("robot", "joint_property", "joint_name", ReferenceKind::Joint, true),
    // A missing link of these is reported by `pair`.
    ("robot", "disable_collisions", "link1", ReferenceKind::Link, false),
    ("robot", "disable_collisions", "link2", ReferenceKind::Link, false),
    ("robot", "enable_collisions", "link1", ReferenceKind::Link, false),
    ("robot", "enable_collisions", "link2", ReferenceKind::Link, false),
];

/// The name that the root element of a URDF or an SRDF gives; `None` if the text is not XML or the element has none.
pub fn robot_name(text: &str) -> Option<String> {
    let document = xml::parse(text).ok()?;
    let root = document.root_element();
    root.attribute("name").filter(|_| root.has_tag_name("robot")).map(str::to_owned)
}

/// The findings about an SRDF. Its link and joint names are compared with those of its robot, if the robot is known.
pub fn examine_srdf(source: &Arc<SourceFile>, robot: Option<&Robot>) -> Vec<Diagnostic> {
    let document = match xml::parse(&source.text) {
        Ok(document) => document,
        Err(fault) => return vec![fault.in_file(source)],
    };
    let root = document.root_element();
    let mut found = Diagnostics::default();
    if root.tag_name().name() != "robot" {
        let message =
            format!("the root element is <{}>: an SRDF begins with <robot>", root.tag_name().name());
        found.push(Diagnostic::error(codes::srdf::ROOT, message).at(tag(root)));
    }
    found.extend(robot.and_then(|robot| other_robot(root, robot)));
    found.extend(document.descendants().filter_map(pair));
    found.extend(examine_elements(root));
    found.extend(examine_groups(root, robot));
    let known = KnownNames::new(root, robot);
    for node in document.descendants().filter(Node::is_element) {
        found.extend(known.names(node));
    }
    found.in_file(source).into_iter().chain(declared_encoding(source)).collect()
}

/// A warning if the SRDF has another robot name than the URDF.
fn other_robot(root: Node<'_, '_>, robot: &Robot) -> Option<Diagnostic> {
    let name = root.attribute("name").unwrap_or_default();
    (name != robot.name()).then(|| {
        let message =
            format!("the SRDF is for robot \"{name}\", but the URDF is of robot \"{}\"", robot.name());
        Diagnostic::warning(codes::srdf::ROBOT_NAME, message)
            .at(tag(root))
            .with_help("motion planners refuse the two together: give both the same name")
    })
}

/// A warning if a pair of disabled or enabled collisions does not name two different links.
fn pair(node: Node<'_, '_>) -> Option<Diagnostic> {
    let element = node.tag_name().name();
    if !["disable_collisions", "enable_collisions"].contains(&element) {
        return None;
    }
    let [one, other] = ["link1", "link2"].map(|key| node.attribute(key).filter(|name| !name.is_empty()));
    let what = match (one, other) {
        (Some(one), Some(other)) if one == other => format!("the same link twice, \"{one}\""),
        (Some(_), Some(_)) => return None,
        (None, _) => without(node, "link1"),
        (_, None) => without(node, "link2"),
    };
    let verb = if element == "disable_collisions" { "disables" } else { "enables" };
    let warning = Diagnostic::warning(codes::srdf::PAIR, format!("<{element}> has {what}"));
    Some(warning.at(tag(node)).with_help(format!("it {verb} nothing: name two links")))
}

/// "no link1", with the unknown attribute that may have been meant for it.
fn without(node: Node<'_, '_>, key: &str) -> String {
    let other = node.attributes().find(|attribute| !["link1", "link2", "reason"].contains(&attribute.name()));
    match other {
        Some(other) => format!("no {key}, but {}=\"{}\"", other.name(), other.value()),
        None => format!("no {key}"),
    }
}

/// Most unknown names for which similar known names are searched: the time of the search grows with the product of the two
/// numbers.
const MOST_GUESSED: usize = 100;

/// The known names; without a robot there is no entry for links and joints, and these are not checked.
struct KnownNames<'a> {
    names: BTreeMap<ReferenceKind, BTreeSet<&'a str>>,
    /// How many unknown names were found so far.
    unknown: Cell<usize>,
}

impl<'a> KnownNames<'a> {
    fn new(root: Node<'a, 'a>, robot: Option<&'a Robot>) -> Self {
        let of = |element| elements(root, element).filter_map(|node| node.attribute("name"));
        let mut known = BTreeMap::from([(ReferenceKind::Group, of("group").collect::<BTreeSet<&str>>())]);
        if let Some(robot) = robot {
            let links = robot.links().iter().map(|link| link.name.as_str());
            let joints = robot.joints().iter().map(|joint| joint.name.as_str());
            known.insert(ReferenceKind::Link, links.collect());
            known.insert(ReferenceKind::Joint, joints.chain(of("virtual_joint")).collect());
        }
        Self { names: known, unknown: Cell::new(0) }
    }

    /// The findings about the names in the attributes of an element.
    fn names(&self, node: Node<'_, '_>) -> Vec<Diagnostic> {
        let element = node.tag_name().name();
        let parent = node.parent_element().map_or("", |parent| parent.tag_name().name());
        let rules = NAMES.iter().filter(|(within, name, ..)| *name == element && *within == parent);
        let wrong = |&(_, _, attribute, named, is_needed): &(_, _, &str, ReferenceKind, bool)| match node
            .attribute(attribute)
            .filter(|name| !name.is_empty())
        {
            Some(name) => self.unknown(node, attribute, name, named),
            None if is_needed => {
                let message = format!("{} has no {attribute}", described(node));
                Some(Diagnostic::warning(codes::srdf::MISSING_NAME, message).at(tag(node)))
            }
            None => None,
        };
        rules.filter_map(wrong).collect()
    }

    fn unknown(
        &self,
        node: Node<'_, '_>,
        attribute: &str,
        name: &str,
        named: ReferenceKind,
    ) -> Option<Diagnostic> {
        let known = self.names.get(&named).filter(|known| !known.contains(name))?;
        self.unknown.set(self.unknown.get() + 1);
        let (several, one, all) = named.words();
        let message = format!("{}: {attribute} \"{name}\" is not a {one}", described(node));
        let warning = Diagnostic::warning(named.code(), message).one_of(several, name).at(tag(node));
        let has_guess = self.unknown.get() <= MOST_GUESSED;
        Some(if has_guess {
            warning.with_help(known_names(name, all, known.iter().copied()))
        } else {
            warning
        })
    }
}

/// `<chain> in group "arm"`.
fn described(node: Node<'_, '_>) -> String {
    let element = node.tag_name().name();
    match node.parent_element().filter(|parent| parent.tag_name().name() != "robot") {
        Some(parent) => format!("<{element}> in {}", label(parent)),
        None => format!("<{element}>"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const URDF: &str = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'>\
                        <parent link='a'/><child link='b'/></joint></robot>";

    fn examined(text: &str, robot: Option<&Robot>) -> Vec<String> {
        let source = Arc::new(SourceFile { path: "r.srdf".into(), text: text.to_owned(), is_foreign: false });
        examine_srdf(&source, robot).into_iter().map(|found| found.message).collect()
    }

    #[test]
    fn an_srdf_is_examined_by_itself() {
        let whole = "<robot name='r'><disable_collisions link1='a' link2='b'/></robot>";
        assert_eq!(examined(whole, None), [""; 0]);
        for (text, message) in [
            ("<robot><disable_collisions link1='a' link2='a'/></robot>", "the same link twice, \"a\""),
            ("<robot><disable_collisions link1='a'/></robot>", "no link2"),
            ("<robot><disable_collisions link1='a' link='b'/></robot>", "no link2, but link=\"b\""),
            (
                "<robot><group_state name='home' group='arm'/></robot>",
                "group \"arm\" is not a group of this file",
            ),
            ("<robot><end_effector name='e' group='g'/></robot>", "<end_effector> has no parent_link"),
            ("<semantics/>", "the root element is <semantics>"),
            ("<robot>", "unexpected end of file"),
        ] {
            assert!(examined(text, None)[0].contains(message), "{:?}", examined(text, None));
        }
    }

    #[test]
    fn names_are_those_of_the_robot() {
        let robot = congruent_description::parse_urdf(URDF).unwrap();
        let of = |inside: &str| examined(&format!("<robot name='r'>{inside}</robot>"), Some(&robot));
        let good = "<virtual_joint name='v' child_link='a' parent_frame='world' type='fixed'/>\
                    <group name='arm'><joint name='v'/><joint name='j'/><chain base_link='a' tip_link='b'/></group>\
                    <group name='all'><group name='arm'/><link name='b'/></group>\
                    <group_state name='home' group='arm'><joint name='j' value='0'/></group_state>\
                    <end_effector name='e' parent_link='b' group='all' parent_group='arm'/>\
                    <passive_joint name='j'/><disable_collisions link1='a' link2='b' reason='Adjacent'/>";
        assert_eq!(of(good), [""; 0]);
        for (from, to, message) in [
            (
                "tip_link='b'",
                "tip_link='c'",
                "<chain> in group \"arm\": tip_link \"c\" is not a link of the robot",
            ),
            ("<joint name='j'/>", "<joint name='k'/>", "<joint> in group \"arm\": name \"k\" is not a joint"),
            (
                "<group name='arm'/>",
                "<group name='amr'/>",
                "<group> in group \"all\": name \"amr\" is not a group",
            ),
            ("parent_link='b'", "parent_link='x'", "<end_effector>: parent_link \"x\" is not a link"),
            ("link2='b'", "link2='x'", "<disable_collisions>: link2 \"x\" is not a link of the robot"),
            ("<passive_joint name='j'/>", "<passive_joint name='x'/>", "\"x\" is not a joint of the robot"),
            ("<joint name='j' value", "<joint name='i' value", "<joint> in group_state \"home\": name \"i\""),
        ] {
            assert!(good.contains(from), "{from}");
            let found = of(&good.replacen(from, to, 1));
            assert!(found.len() == 1 && found[0].contains(message), "{to}: {found:?}");
        }
        let other = examined("<robot name='q'/>", Some(&robot));
        assert_eq!(other, ["the SRDF is for robot \"q\", but the URDF is of robot \"r\""]);
    }
}
