//! What a series of a recording is, in words and with its unit: entity paths have neither.

use congruent_results::comparison::ScalarLabel;

use super::summary::RecordingSummary;

/// The label of a series by its path; the report in `summary` says which joints turn.
///
/// # Examples
/// `/agreement/orientation/tool0` is "orientation error of tool0" in rad.
pub fn label(path: &str, summary: &RecordingSummary) -> ScalarLabel {
    // A name of a file is one part, with its slashes and spaces escaped.
    let parts: Vec<String> = parts(path);
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    let named = |words: String, unit| ScalarLabel { joint: None, words: Some(words), unit };
    match parts[..] {
        ["agreement", "worst", quantity] => {
            named(format!("{quantity}, largest error of all links, as a power of ten"), None)
        }
        ["agreement", "position", link] => named(error("position", link), Some("m")),
        ["agreement", "orientation", link] => named(error("orientation", link), Some("rad")),
        ["clearance", "minimum"] => named("smallest distance".to_owned(), Some("m")),
        ["clearance", pair] => named(format!("distance {pair}"), Some("m")),
        ["zone", "distance", zone] => named(format!("distance from zone {zone}"), Some("m")),
        ["joint", quantity, joint] => ScalarLabel {
            joint: Some(joint.to_owned()),
            words: Some(format!("{} of {joint}", quantity.replace('_', " "))),
            unit: unit_of_joint(quantity, joint, summary),
        },
        ["joint_limit", quantity, joint, side] => named(
            format!("{side} limit of {} of {joint}", quantity.replace('_', " ")),
            unit_of_joint(quantity, joint, summary),
        ),
        _ => ScalarLabel::default(),
    }
}

fn error(quantity: &str, link: &str) -> String {
    if link == "tolerance" {
        format!("tolerance of the {quantity}")
    } else {
        format!("{quantity} error of {link}")
    }
}

/// The parts of a path without the signs that escape a slash or a space.
fn parts(path: &str) -> Vec<String> {
    let (mut parts, mut part, mut is_escaped) = (Vec::new(), String::new(), false);
    for sign in path.trim_start_matches('/').chars() {
        match sign {
            '\\' if !is_escaped => is_escaped = true,
            '/' if !is_escaped => parts.push(std::mem::take(&mut part)),
            sign => {
                part.push(sign);
                is_escaped = false;
            }
        }
    }
    parts.push(part);
    parts
}

/// The unit of a quantity of a joint, by the unit of its effort in the report; `None` if the report does not have the joint.
fn unit_of_joint(quantity: &str, joint: &str, summary: &RecordingSummary) -> Option<&'static str> {
    let actuators = summary.report.as_ref()?.get("actuators")?.as_array()?;
    let of = actuators.iter().find(|of| of.get("joint").and_then(|name| name.as_str()) == Some(joint))?;
    let turns = of.get("unit")?.as_str()? == "N m";
    match quantity {
        "effort" => Some(if turns { "N m" } else { "N" }),
        quantity if quantity.ends_with("velocity") => Some(if turns { "rad/s" } else { "m/s" }),
        quantity if quantity.ends_with("position") || quantity == "deviation" => {
            Some(if turns { "rad" } else { "m" })
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_slashes_and_spaces_are_one_part() {
        assert_eq!(
            parts(r"/agreement/worst/position\ tolerance"),
            ["agreement", "worst", "position tolerance"]
        );
        assert_eq!(parts(r"/joint/effort/left\/elbow"), ["joint", "effort", "left/elbow"]);
    }
}
