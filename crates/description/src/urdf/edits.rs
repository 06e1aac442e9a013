//! Corrections of a URDF's `<inertial>`, and of parts of its joints, as changes of its text: unchanged values keep their form.

use congruent_input::{
    TextEdit,
    number::{significant, significant_components},
    rotation_from_rpy_fixed_xyz, rpy_fixed_xyz_rad, xml,
};
use congruent_robot::Inertia;
use nalgebra::Isometry3;
use roxmltree::Node;

use super::{
    UrdfPlaces,
    node::{element, tag},
};

/// A written rotation is kept if it differs by less than this. Unit: rad; kind: rounding of angles.
const SAME_ROTATION_RAD: f64 = 1e-12;

/// The entries of a tensor, by row and column.
const MOMENTS: [(&str, usize, usize); 6] =
    [("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2)];

impl UrdfPlaces {
    /// The edits after which a link has this inertia; none if there is no such link.
    pub fn set_inertia(&self, link: &str, inertia: &Inertia) -> Vec<TextEdit> {
        let Ok(document) = xml::parse(&self.source().text) else { return Vec::new() };
        let Some(link) = self.link(&document, link) else { return Vec::new() };
        let Some(inertial) = element(link, "inertial") else {
            let origin = new_element("origin", &[("xyz", xyz(inertia)), ("rpy", rpy(inertia))]);
            let mass = new_element("mass", &[("value", significant(inertia.mass_kg))]);
            let tensor = new_element("inertia", &moments(inertia));
            return vec![inserted(link, &format!("<inertial>{origin}{mass}{tensor}</inertial>"))];
        };
        let mut edits = Vec::new();
        let mut origin = Vec::new();
        let written = element(inertial, "origin");
        let attribute = |name: &str| written.and_then(|origin| origin.attribute(name));
        let com = inertia.link_from_inertial.translation.vector;
        // Compared by value: a number that is written differently keeps its form.
        if nalgebra::Vector3::from(triple(attribute("xyz"))) != com {
            origin.push(("xyz", xyz(inertia)));
        }
        let rotation = rotation_from_rpy_fixed_xyz(triple(attribute("rpy")));
        // As rotations: several triples of angles are one rotation, and the file's is kept.
        if rotation.angle_to(&inertia.link_from_inertial.rotation) > SAME_ROTATION_RAD {
            origin.push(("rpy", rpy(inertia)));
        }
        set(&mut edits, inertial, "origin", &origin);
        set(&mut edits, inertial, "mass", &changed(inertial, "mass", &[("value", inertia.mass_kg)]));
        let tensor = MOMENTS.map(|(name, row, column)| (name, inertia.tensor_kg_m2[(row, column)]));
        set(&mut edits, inertial, "inertia", &changed(inertial, "inertia", &tensor));
        edits
    }

    /// The edits after which the robot has these elements as well; none if the file is no robot.
    pub fn add_elements(&self, elements: &str) -> Vec<TextEdit> {
        let text = &self.source().text;
        let Some(end) = text.rfind("</robot") else { return Vec::new() };
        vec![TextEdit { span: end..end, text: format!("  {elements}\n") }]
    }

    /// The edits after which a joint has these values of damping and friction; none if there is no such joint.
    pub fn set_joint_dynamics(&self, joint: &str, damping: f64, friction: f64) -> Vec<TextEdit> {
        let Ok(document) = xml::parse(&self.source().text) else { return Vec::new() };
        let Some(joint) = self.joint(&document, joint) else { return Vec::new() };
        let mut edits = Vec::new();
        let values = changed(joint, "dynamics", &[("damping", damping), ("friction", friction)]);
        set(&mut edits, joint, "dynamics", &values);
        edits
    }

    /// The edits after which a part of a joint, such as its `origin`, has these attributes; none if there is no such joint.
    pub fn set_joint_part(
        &self,
        joint: &str,
        part: &str,
        attributes: &[(&'static str, String)],
    ) -> Vec<TextEdit> {
        let Ok(document) = xml::parse(&self.source().text) else { return Vec::new() };
        let Some(joint) = self.joint(&document, joint) else { return Vec::new() };
        let mut edits = Vec::new();
        set(&mut edits, joint, part, attributes);
        edits
    }

    /// The edits after which a joint has this `lower`, `upper`, `effort`, `velocity`, `acceleration`, `deceleration` or `jerk`; none if there is no such joint, or
    /// no such limit, and none for the range of a continuous joint, which has another type.
    pub fn set_joint_limit(&self, joint: &str, limit: &str, value: f64) -> Vec<TextEdit> {
        let Ok(document) = xml::parse(&self.source().text) else { return Vec::new() };
        let Some(joint) = self.joint(&document, joint) else { return Vec::new() };
        let Some(name) = LIMITS.into_iter().find(|name| *name == limit) else { return Vec::new() };
        // A continuous joint ignores them.
        if joint.attribute("type") == Some("continuous") && RANGE.contains(&name) {
            return Vec::new();
        }
        let mut edits = Vec::new();
        set(&mut edits, joint, "limit", &changed(joint, "limit", &[(name, value)]));
        edits
    }
}

/// The ends of a joint's range.
const RANGE: [&str; 2] = ["lower", "upper"];
const LIMITS: [&str; 7] = [RANGE[0], RANGE[1], "effort", "velocity", "acceleration", "deceleration", "jerk"];

type Attribute = (&'static str, String);

/// The attributes of a child element whose value changes; a missing attribute counts as zero.
fn changed(parent: Node<'_, '_>, child: &str, values: &[(&'static str, f64)]) -> Vec<Attribute> {
    let written = element(parent, child);
    let value = |name: &str| written?.attribute(name)?.trim().parse::<f64>().ok();
    let other =
        // `+ 0.0` makes -0 to 0, which the file would otherwise get as a change.
        values.iter().filter(|(name, new)| value(name).unwrap_or(0.0).total_cmp(&(new + 0.0)).is_ne());
    other.map(|(name, new)| (*name, significant(*new))).collect()
}

/// Sets attributes of a child element, which is added if it is missing.
fn set(edits: &mut Vec<TextEdit>, parent: Node<'_, '_>, child: &str, attributes: &[Attribute]) {
    if attributes.is_empty() {
        return;
    }
    let Some(node) = element(parent, child) else {
        edits.push(inserted(parent, &new_element(child, attributes)));
        return;
    };
    for (name, value) in attributes {
        let written = node.attributes().find(|attribute| attribute.name() == *name);
        let end = node.attributes().next_back().map_or(tag(node).end, |last| last.range().end);
        edits.push(written.map_or_else(
            || TextEdit { span: end..end, text: format!(" {name}=\"{value}\"") },
            |attribute| TextEdit { span: attribute.range_value(), text: value.clone() },
        ));
    }
}

fn new_element(name: &str, attributes: &[Attribute]) -> String {
    let attributes: Vec<String> =
        attributes.iter().map(|(name, value)| format!(" {name}=\"{value}\"")).collect();
    format!("<{name}{}/>", attributes.concat())
}

/// A text as the first child of an element.
fn inserted(parent: Node<'_, '_>, text: &str) -> TextEdit {
    let range = parent.range();
    // Before the first child, its line break included, so that what follows keeps its indentation.
    if let Some(child) = parent.first_child() {
        let start = child.range().start;
        return TextEdit { span: start..start, text: text.to_owned() };
    }
    let name = parent.tag_name().name();
    let whole = &parent.document().input_text()[range.clone()];
    if let Some(start) = whole.strip_suffix("/>") {
        let span = range.start + start.trim_end().len()..range.end;
        return TextEdit { span, text: format!(">{text}</{name}>") };
    }
    let start = range.start + whole.find('>').map_or(whole.len(), |at| at + 1);
    TextEdit { span: start..start, text: text.to_owned() }
}

/// Three numbers of an attribute; zeros if they are not written, as URDF has it.
fn triple(written: Option<&str>) -> [f64; 3] {
    let mut numbers = written.unwrap_or_default().split_whitespace().map(|word| word.parse().unwrap_or(0.0));
    std::array::from_fn(|_| numbers.next().unwrap_or(0.0))
}

fn xyz(inertia: &Inertia) -> String {
    significant_components(inertia.link_from_inertial.translation.vector.into()).join(" ")
}

fn rpy(inertia: &Inertia) -> String {
    let turn = Isometry3::from_parts(nalgebra::Translation3::identity(), inertia.link_from_inertial.rotation);
    rpy_fixed_xyz_rad(&turn).map(significant).join(" ")
}

fn moments(inertia: &Inertia) -> Vec<Attribute> {
    MOMENTS.map(|(name, row, column)| (name, significant(inertia.tensor_kg_m2[(row, column)]))).to_vec()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::urdf::parse_urdf;
    use congruent_input::{SourceFile, changed_lines};

    const TEXT: &str = "<robot name='two'>\n<link name='a'/>\n<link name='b'>\n<inertial>\n<mass value='2'/>\n\
        <inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1.0'/>\n</inertial>\n</link>\n<link name='c'/>\n\
        <joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>\n\
        <joint name='k' type='continuous'><parent link='b'/><child link='c'/></joint>\n</robot>\n";

    fn inertia() -> Inertia {
        Inertia {
            mass_kg: 3.0,
            link_from_inertial: Isometry3::new(Vector3::new(0.1, 0.0, -0.25), Vector3::new(0.5, 0.0, 0.0)),
            tensor_kg_m2: Matrix3::new(0.5, 0.1, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0, 1.0),
        }
    }

    fn applied(edits: &[TextEdit]) -> String {
        let mut lines: Vec<String> = TEXT.lines().map(str::to_owned).collect();
        for change in changed_lines(TEXT, edits).into_iter().rev() {
            lines.splice(change.from_line - 1..change.to_line, [change.text]);
        }
        lines.join("\n") + "\n"
    }

    #[test]
    fn a_corrected_inertial_is_read_back() {
        let source = SourceFile { path: "two.urdf".into(), text: TEXT.to_owned(), is_foreign: false };
        let places = UrdfPlaces::new(Arc::new(source));
        for link in ["b", "c"] {
            let text = applied(&places.set_inertia(link, &inertia()));
            let robot = parse_urdf(&text).unwrap_or_else(|found| panic!("{text}\n{found:#?}"));
            let read = robot.link(robot.find_link(link).unwrap()).inertia.unwrap();
            assert_eq!(read.tensor_kg_m2, inertia().tensor_kg_m2, "{text}");
            assert!((read.mass_kg - 3.0).abs() < 1e-15, "{text}");
            let apart = read.link_from_inertial.inverse() * inertia().link_from_inertial;
            assert!(apart.translation.vector.norm() + apart.rotation.angle() < 1e-11, "{text}");
        }
        // What stays keeps its form.
        assert!(applied(&places.set_inertia("b", &inertia())).contains("izz='1.0'"));
        assert_eq!(places.set_inertia("nobody", &inertia()), []);
    }

    #[test]
    fn a_corrected_joint_is_read_back() {
        let source = SourceFile { path: "two.urdf".into(), text: TEXT.to_owned(), is_foreign: false };
        let places = UrdfPlaces::new(Arc::new(source));
        let text = applied(&places.set_joint_dynamics("k", 0.5, 0.25));
        let robot = parse_urdf(&text).unwrap();
        let joint = robot.joint(robot.find_joint("k").unwrap());
        assert_eq!((joint.damping, joint.friction), (0.5, 0.25), "{text}");
        assert_eq!(places.set_joint_dynamics("k", 0.0, 0.0), []);
    }

    #[test]
    fn a_corrected_part_of_a_joint_is_read_back() {
        let text =
            TEXT.replace("name='j' type='continuous'>", "name='j' type='continuous'><origin xyz='1  0 2'/>");
        let places = |text: &str| {
            UrdfPlaces::new(Arc::new(SourceFile {
                path: "two.urdf".into(),
                text: text.to_owned(),
                is_foreign: false,
            }))
        };
        let written = |text: &str, joint, attribute| places(text).joint_attribute(joint, "origin", attribute);
        assert_eq!(written(&text, "j", "xyz").as_deref(), Some("1 0 2"));
        assert_eq!([written(&text, "j", "rpy"), written(&text, "k", "xyz")], [None, None]);
        for joint in ["j", "k"] {
            let values = [("xyz", "3 4 5".to_owned()), ("rpy", "0 0 1".to_owned())];
            let changed =
                congruent_input::edited(&text, &places(&text).set_joint_part(joint, "origin", &values));
            let robot = parse_urdf(&changed).unwrap();
            let pose = robot.joint(robot.find_joint(joint).unwrap()).parent_from_joint;
            assert_eq!(pose.translation.vector, Vector3::new(3.0, 4.0, 5.0), "{changed}");
            assert!((pose.rotation.angle() - 1.0).abs() < 1e-15, "{changed}");
        }
        assert_eq!(places(&text).set_joint_part("nobody", "origin", &[("xyz", "0 0 0".to_owned())]), []);
    }

    #[test]
    fn a_corrected_limit_is_read_back() {
        let text =
            TEXT.replace("name='j' type='continuous'>", "name='j' type='revolute'><limit effort='1'/>");
        let source = SourceFile { path: "two.urdf".into(), text, is_foreign: false };
        let places = UrdfPlaces::new(Arc::new(source));
        let of = |limit, value| places.set_joint_limit("j", limit, value);
        let edits = [of("upper", 1.5), of("effort", 20.0), of("velocity", 3.0)].concat();
        let changed = changed_lines(&places.source().text, &edits);
        let [line] = &changed[..] else { panic!("{changed:?}") };
        assert!(line.text.contains("<limit effort='20.0' upper=\"1.5\" velocity=\"3.0\"/>"), "{}", line.text);
        assert_eq!(places.set_joint_limit("k", "lower", -1.0), [], "a continuous joint has no range");
        assert_eq!(places.set_joint_limit("j", "lower", 0.0), [], "what is not written is zero");
    }
}
