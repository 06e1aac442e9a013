//! Checks a tree against the schema: unknown and repeated elements, unknown and missing attributes, and every value. As strict
//! as MuJoCo, which refuses what it does not know, so that a misspelt name is never ignored.

use std::collections::BTreeMap;

use congruent_input::{Diagnostics, hidden_character, known_names};

use super::{
    numbers::{MjNumberKind, fault},
    orientations::one_orientation,
    schema::{MjAttributeType, MjElementRule, MjSchema, SCHEMA},
};
use crate::{
    codes,
    document::{MjAttribute, MjElement},
};

/// Attributes that name things; names are copied into every output.
const NAMES: [&str; 4] = ["name", "class", "childclass", "model"];

/// After so many findings the check stops. Kind: choice; nobody reads more.
const MOST_FINDINGS: usize = 1_000;

/// Checks a whole tree.
pub(crate) fn check(root: &MjElement, diagnostics: &mut Diagnostics) {
    element(root, SCHEMA.root(), diagnostics);
}

fn element(found: &MjElement, rule: &MjElementRule, diagnostics: &mut Diagnostics) {
    for attribute in &found.attributes {
        self::attribute(found, attribute, rule, diagnostics);
    }
    for (key, _) in rule.attributes.iter().filter(|(_, rule)| rule.is_required) {
        if found.attribute(key).is_none() {
            let message = format!("{} lacks the attribute \"{key}\", which is required", found.label());
            diagnostics.push(found.fault(codes::mjcf::MISSING_ATTRIBUTE, message));
        }
    }
    one_orientation(found, diagnostics);
    let mut first: BTreeMap<&str, &MjElement> = BTreeMap::new();
    for child in &found.children {
        if diagnostics.len() > MOST_FINDINGS {
            return;
        }
        let tag = child.tag.as_str();
        let Some(rule) = SCHEMA.child(rule, tag) else {
            let message = format!("<{tag}> is no element of {}", found.label());
            let help = known_names(tag, "elements there", MjSchema::children(rule));
            diagnostics.push(child.fault(codes::mjcf::UNKNOWN_ELEMENT, message).with_help(help));
            continue;
        };
        if matches!(rule.occurs, '?' | '!') && first.insert(tag, child).is_some() {
            let message = format!("{} has <{tag}> twice, at most one is allowed", found.label());
            diagnostics
                .push(child.fault(codes::mjcf::REPEATED_ELEMENT, message).with_help("keep one of the two"));
        }
        placement(found, child, diagnostics);
        element(child, rule, diagnostics);
    }
}

/// The world has no joint, and neither a frame in it; a replicate repeats bodies and geoms, not joints.
fn placement(parent: &MjElement, child: &MjElement, diagnostics: &mut Diagnostics) {
    let is_of_body = ["joint", "freejoint", "inertial"].contains(&child.tag.as_str());
    if is_of_body && ["worldbody", "replicate"].contains(&parent.tag.as_str()) {
        let message = format!("<{}> is not allowed directly in <{}>", child.tag, parent.tag);
        let help = "put it into a <body>";
        diagnostics.push(child.fault(codes::mjcf::PLACEMENT, message).with_help(help));
    }
}

fn attribute(owner: &MjElement, found: &MjAttribute, element: &MjElementRule, diagnostics: &mut Diagnostics) {
    let MjAttribute { key, value, .. } = found;
    let Some(rule) = element.attributes.get(key.as_str()) else {
        // A replicate and an include take any attribute in MuJoCo; what it ignores there is most likely a mistake.
        let message = format!("{} has no attribute \"{key}\"", owner.label());
        let help = if element.attributes.is_empty() {
            "remove it".to_owned()
        } else {
            known_names(key, "attributes", element.attributes.keys().copied())
        };
        diagnostics.push(found.fault(codes::mjcf::UNKNOWN_ATTRIBUTE, message).with_help(help));
        return;
    };
    if NAMES.contains(&key.as_str())
        && let Some(hidden) = hidden_character(value)
    {
        let message = format!("the {key} of {} has the invisible character {hidden:?}", owner.label());
        diagnostics.push(found.fault(codes::mjcf::NAME, message).with_help("type the name again"));
    }
    match &rule.value {
        MjAttributeType::Text => {}
        MjAttributeType::Keyword(words) => {
            if !words.contains(&value.as_str()) {
                let message = format!("{}: {key} is \"{value}\"", owner.label());
                let help = known_names(value, "words", words.iter().copied());
                diagnostics.push(found.fault(codes::mjcf::KEYWORD, message).with_help(help));
            }
        }
        MjAttributeType::Numbers { least, most, kind } => {
            let counts = MjCounts { least: *least, most: *most };
            check_numbers(owner, found, counts, *kind, diagnostics);
        }
    }
}

/// How many numbers an attribute may have.
#[derive(Clone, Copy)]
struct MjCounts {
    least: usize,
    most: usize,
}

fn check_numbers(
    owner: &MjElement,
    found: &MjAttribute,
    counts: MjCounts,
    kind: MjNumberKind,
    diagnostics: &mut Diagnostics,
) {
    let MjAttribute { key, value, .. } = found;
    let mut count = 0;
    for token in value.split_whitespace() {
        count += 1;
        if let Some(fault) = fault(token, kind) {
            let short: String = token.chars().take(40).collect();
            let message = format!("{}: \"{short}\" in {key} {fault}", owner.label());
            diagnostics.push(found.fault(codes::mjcf::NUMBER, message));
            return;
        }
    }
    // MuJoCo takes an empty value for none at all.
    if count == 0 || (counts.least..=counts.most).contains(&count) {
        return;
    }
    let expected = match counts {
        MjCounts { least, most } if least == most => most.to_string(),
        MjCounts { most, .. } => format!("at most {most}"),
    };
    let message = format!("{}: {key} has {count} numbers, expected {expected}", owner.label());
    diagnostics.push(found.fault(codes::mjcf::NUMBER, message));
}
