//! Corrections that are safe: after them a file means the same, or what was refused before has the one meaning that was
//! left. Whatever needs a decision is no correction but a finding.

use std::ops::Range;

use nalgebra::Vector3;
use roxmltree::Node;

use crate::{
    edits::TextEdit,
    urdf::{
        Misspelt, misspellings,
        node::{element, elements, label},
    },
    xml,
};

/// A correction of one place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SafeFix {
    /// The code of the finding that it answers.
    pub code: &'static str,
    /// What it does.
    pub about: String,
    /// The changes, none of which overlap.
    pub edits: Vec<TextEdit>,
}

/// The safe corrections of a URDF; none if it is no XML.
pub fn safe_fixes(urdf: &str) -> Vec<SafeFix> {
    let Ok(document) = xml::parse(urdf) else { return Vec::new() };
    let root = document.root_element();
    if root.tag_name().name() != "robot" {
        return Vec::new();
    }
    let mut fixes: Vec<SafeFix> = misspellings(root)
        .into_iter()
        .map(|found| SafeFix {
            code: found.code,
            about: format!("{}: \"{}\" is written \"{}\"", found.owner, found.written, found.meant),
            edits: names(urdf, &found.place, &found.written)
                .into_iter()
                .map(|span| TextEdit { span, text: found.meant.to_owned() })
                .collect(),
        })
        .filter(|fix| !fix.edits.is_empty())
        .collect();
    for joint in elements(root, "joint") {
        fixes.extend(unit_axis(joint));
        fixes.extend(no_range(urdf, joint));
    }
    fixes
}

/// Where a name that is misspelt stands in an element: the name of an attribute, or both tags of an element.
fn names(text: &str, place: &Misspelt<'_>, written: &str) -> Vec<Range<usize>> {
    match place {
        Misspelt::Attribute(range) => std::iter::once(range.start..range.start + written.len()).collect(),
        Misspelt::Element(node) => {
            let range = node.range();
            let start = range.start + 1..range.start + 1 + written.len();
            let closing = text[range.clone()].rfind("</").map(|at| range.start + at + 2);
            // Without a closing tag of its own, the last one inside is a child's.
            let end =
                closing.map(|at| at..at + written.len()).filter(|end| text.get(end.clone()) == Some(written));
            let is_closed = !text[range].trim_end().ends_with("/>");
            match (end, is_closed) {
                (Some(end), true) => vec![start, end],
                (None, true) => Vec::new(),
                (_, false) => vec![start],
            }
        }
    }
}

/// Normalises the axis of a joint, which its reader does anyway.
fn unit_axis(joint: Node<'_, '_>) -> Option<SafeFix> {
    const IS_ONE: f64 = 1e-6;
    let is_moving = joint.attribute("type").is_some_and(|kind| kind != "fixed");
    let axis = element(joint, "axis").filter(|_| is_moving)?;
    let written = axis.attributes().find(|attribute| attribute.name() == "xyz")?;
    let numbers: Option<Vec<f64>> =
        written.value().split_whitespace().map(|number| number.parse().ok()).collect();
    let [x, y, z] = numbers?[..] else { return None };
    let vector = Vector3::new(x, y, z);
    let length = vector.norm();
    // Axes that overflow or vanish are refused, and need a decision.
    if !(length.is_finite() && length > f64::MIN_POSITIVE) || (length - 1.0).abs() <= IS_ONE {
        return None;
    }
    let unit = vector / length;
    let text = unit.iter().map(|entry| (entry + 0.0).to_string()).collect::<Vec<_>>().join(" ");
    Some(SafeFix {
        code: "urdf::axis",
        about: format!("{}: the axis has length 1", label(joint)),
        edits: vec![TextEdit { span: written.range_value(), text }],
    })
}

/// Takes the range of a continuous joint away, which every reader ignores.
fn no_range(text: &str, joint: Node<'_, '_>) -> Option<SafeFix> {
    let limit = element(joint, "limit").filter(|_| joint.attribute("type") == Some("continuous"))?;
    let is_zero = |value: &str| value.trim().parse::<f64>().is_ok_and(|value| value == 0.0);
    let range = limit.attributes().filter(|attribute| ["lower", "upper"].contains(&attribute.name()));
    if range.clone().all(|attribute| is_zero(attribute.value())) {
        return None;
    }
    let with_space = |range: Range<usize>| {
        let before = text[..range.start].trim_end().len();
        TextEdit { span: before..range.end, text: String::new() }
    };
    Some(SafeFix {
        code: "urdf::limit",
        about: format!("{}: a continuous joint has no range", label(joint)),
        edits: range.map(|attribute| with_space(attribute.range())).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edits::edited;

    const URDF: &str = "<robot name='r'><link name='a'/><link name='b'>
<colision><orgin xyz='0 0 1'/><geometry><box size='1 1 1'/></geometry></colision></link>
<joint name='j' type='continuous'><parent link='a'/><child link='b'/>
<orgin xyz='0 0 1'></orgin><axis xyz='0 3 4'/><limit lower='-1'
 upper='1' efort='3' velocity='2'/></joint></robot>";

    #[test]
    fn corrections_are_small_and_the_file_is_clean_after_them() {
        let edits: Vec<TextEdit> = safe_fixes(URDF).into_iter().flat_map(|fix| fix.edits).collect();
        let fixed = edited(URDF, &edits);
        for part in [
            "<collision><origin xyz='0 0 1'/><geometry><box size='1 1 1'/></geometry></collision>",
            "<origin xyz='0 0 1'></origin><axis xyz='0 0.6 0.8'/><limit effort='3' velocity='2'/>",
        ] {
            assert!(fixed.contains(part), "{fixed}");
        }
        assert_eq!(safe_fixes(&fixed), []);
        assert!(safe_fixes("<robot").is_empty() && safe_fixes("<sdf/>").is_empty());
    }

    #[test]
    fn what_needs_a_decision_is_left_alone() {
        let wrong = "<robot name='r'><joint name='j' type='revolute'><axis xyz='0 0 0'/>\
                     <limit lower='2' upper='1'/><limit lowr='1' lower='0'/></joint></robot>";
        assert_eq!(safe_fixes(wrong), []);
    }
}
