//! Safe corrections of a URDF: after them the file means the same, or a part that was refused gets its only possible
//! meaning. What needs a decision is not corrected but reported as a finding.

use std::ops::Range;

use congruent_description::{
    Misspelt, misspellings,
    node::{element, elements, label},
};
use congruent_input::{Code, TextEdit, xml};
use nalgebra::Vector3;
use roxmltree::Node;

/// A correction of one finding, as changes of the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SafeFix {
    /// The code of the finding that it corrects.
    pub code: &'static Code,
    /// What the correction does, as one line for people.
    pub about: String,
    /// The changes of the text, as byte ranges that do not overlap.
    pub edits: Vec<TextEdit>,
}

/// The safe corrections of a URDF; none if the text is not XML or its root is not `<robot>`.
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
            about: format!("{}: rename \"{}\" to \"{}\"", found.owner, found.written, found.meant),
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

/// The byte ranges of a misspelt name: the name of an attribute, or the names in both tags of an element.
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
            // No edit at all rather than one of two tags: the file would not be XML any more.
            match (end, is_closed) {
                (Some(end), true) => vec![start, end],
                (None, true) => Vec::new(),
                (_, false) => vec![start],
            }
        }
    }
}

/// Normalises the axis of a joint, as every reader of this workspace does when it loads the file.
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
    // A zero axis has no direction and an overflowing one no length: both are errors that need a decision. Within IS_ONE
    // the axis was written with few digits, and rewriting it would only make the difference longer.
    if !(length.is_finite() && length > f64::MIN_POSITIVE) || (length - 1.0).abs() <= IS_ONE {
        return None;
    }
    let unit = vector / length;
    // `+ 0.0` turns -0 into 0; the shortest digits that read back as the same number.
    let text = unit.iter().map(|entry| (entry + 0.0).to_string()).collect::<Vec<_>>().join(" ");
    Some(SafeFix {
        code: congruent_description::codes::urdf::AXIS,
        about: format!("{}: normalise the axis to length 1", label(joint)),
        edits: vec![TextEdit { span: written.range_value(), text }],
    })
}

/// Removes the range of a continuous joint, which every reader ignores.
fn no_range(text: &str, joint: Node<'_, '_>) -> Option<SafeFix> {
    let limit = element(joint, "limit").filter(|_| joint.attribute("type") == Some("continuous"))?;
    let is_zero = |value: &str| value.trim().parse::<f64>().is_ok_and(|value| value == 0.0);
    let range = limit.attributes().filter(|attribute| ["lower", "upper"].contains(&attribute.name()));
    // Exporters write zeros for "none" (see `urdf/joint.rs`): these raise no warning, so there is nothing to correct.
    if range.clone().all(|attribute| is_zero(attribute.value())) {
        return None;
    }
    let with_space = |range: Range<usize>| {
        // The space before the attribute goes with it.
        let before = text[..range.start].trim_end().len();
        TextEdit { span: before..range.end, text: String::new() }
    };
    Some(SafeFix {
        code: congruent_description::codes::urdf::LIMIT,
        about: format!("{}: remove lower and upper, which a continuous joint ignores", label(joint)),
        edits: range.map(|attribute| with_space(attribute.range())).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use congruent_input::edited;

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
