//! Values of a report as people call them: `checks.1.measures.2.worst.value` is the worst orientation of the check agreement,
//! `actuators.2.largest_effort` the largest effort of the second joint.

use congruent_input::{Quantity, SiUnit};
use serde::Deserialize;
use serde_json::{Map, Value as Json};

use crate::report::quantity_words;

/// Units as the keys of reports and the columns of tables end with them; of two that fit the longer one is first.
pub(super) const UNITS: [(&str, &str); 7] = [
    ("_rad_s", "rad/s"),
    ("_n_m", "N m"),
    ("_m_s", "m/s"),
    ("_rad", "rad"),
    ("_m", "m"),
    ("_n", "N"),
    ("_s", "s"),
];

/// What a value is, and the unit beside it in the report.
#[derive(Debug, PartialEq)]
pub(super) struct ReportLabel {
    pub(super) words: String,
    pub(super) unit: Option<&'static str>,
}

impl ReportLabel {
    /// The label of a value; `None` for one whose key is a word.
    pub(super) fn new(report: &Map<String, Json>, keys: &str) -> Option<Self> {
        Self::of_check(report, keys).or_else(|| Self::of_part(report, keys))
    }

    /// The label of a value of another part than the checks: `actuator of elbow_joint: largest effort`.
    fn of_part(report: &Map<String, Json>, keys: &str) -> Option<Self> {
        let (part, below) = keys.split_once('.').unwrap_or((keys, ""));
        let numbered = below.split_once('.').filter(|(number, _)| number.parse::<usize>().is_ok());
        let (whole, entry, below) = match numbered {
            Some((number, below)) => {
                let entry = entry(report.get(part)?, number)?;
                (entry_name(part, number, entry), Some(entry), below)
            }
            None => (part.replace('_', " "), None, below),
        };
        // Names of joints keep their underscores.
        let (path, joint) = below.split_once("q.").unwrap_or((below, ""));
        let end = without_unit(path.trim_end_matches('.')).replace(['_', '.'], " ");
        let words: Vec<String> = [whole, end].into_iter().filter(|part| !part.is_empty()).collect();
        let there = if joint.is_empty() { String::new() } else { format!(", {joint} there") };
        let words = words.join(": ") + &there;
        let unit = entry.filter(|_| EFFORTS.contains(&path)).and_then(|entry| entry.get("unit"));
        let unit = unit.and_then(|unit| Some(SiUnit::deserialize(unit).ok()?.symbol()));
        (words != keys).then_some(Self { words, unit })
    }

    /// The label of a value of a check.
    fn of_check(report: &Map<String, Json>, keys: &str) -> Option<Self> {
        let mut keys = keys.splitn(5, '.');
        let "checks" = keys.next()? else { return None };
        let number = keys.next()?;
        let check = entry(report.get("checks")?, number)?;
        let kind = check.get("check")?.as_str()?;
        let (part, second, rest) = (keys.next()?, keys.next(), keys.next());
        let name = format!("check {number} ({kind})");
        let measure = match (part, second) {
            ("measures", Some(number)) => entry(check.get(part)?, number)?,
            ("nearest_that_changes", Some(_)) => entry(check.get("measures")?, "1")?,
            _ => return Some(Self { words: format!("{name}: {}", part.replace('_', " ")), unit: None }),
        };
        let unit = SiUnit::deserialize(measure.get("unit")?).ok()?.symbol();
        let quantity = quantity_words(Quantity::deserialize(measure.get("quantity")?).ok()?);
        let (moment, key) = match (part, rest) {
            ("measures", Some(rest)) => rest.split_once('.').unwrap_or(("", rest)),
            _ => (part, second?),
        };
        let moment = match moment {
            "" => String::new(),
            "worst" => ", worst value".to_owned(),
            other => format!(", {}", other.replace('_', " ")),
        };
        let (end, unit) = match key.strip_prefix("q.") {
            Some(joint) => (format!(", {joint} there"), None),
            None => match key {
                "value" => (String::new(), Some(unit)),
                "limit" => (", limit".to_owned(), Some(unit)),
                "time_s" => (", time".to_owned(), Some("s")),
                "subject" => (", where".to_owned(), None),
                other => (format!(", {}", other.replace('_', " ")), None),
            },
        };
        Some(Self { words: format!("{name}: {quantity}{moment}{end}"), unit })
    }
}

/// Values of an actuator in its unit.
const EFFORTS: [&str; 2] = ["largest_effort", "effort_limit"];

/// What an entry of a list is called: by its joint or link, or by its number and kind.
fn entry_name(list: &str, number: &str, entry: &Json) -> String {
    let one = list.strip_suffix('s').unwrap_or(list).replace('_', " ");
    let text = |key: &str| entry.get(key).and_then(Json::as_str);
    match (text("joint"), text("link").filter(|_| list == "links"), text("kind")) {
        (Some(joint), ..) => format!("{one} of {joint}"),
        (None, Some(link), _) => format!("link {link}"),
        (None, None, Some(kind)) => format!("{one} {number} ({kind})"),
        (None, None, None) => format!("{one} {number}"),
    }
}

/// A key without the unit at its end: `step` for `step_s`.
fn without_unit(key: &str) -> &str {
    UNITS.into_iter().find_map(|(end, _)| key.strip_suffix(end)).unwrap_or(key)
}

/// An entry of a list by its number, from 1.
fn entry<'a>(list: &'a Json, number: &str) -> Option<&'a Json> {
    list.get(number.parse::<usize>().ok()?.checked_sub(1)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_has_check_quantity_and_unit() {
        let report = serde_json::json!({ "checks": [{ "check": "agreement", "status": "fail",
            "measures": [{ "quantity": "position", "unit": "m", "limit": 1e-9, "worst": { "value": 0.1 } }] }] });
        let report = report.as_object().unwrap();
        let label = |keys: &str| ReportLabel::new(report, keys).map(|label| (label.words, label.unit));
        let of = |words: &str, unit| Some((words.to_owned(), unit));
        let value = label("checks.1.measures.1.worst.value");
        assert_eq!(value, of("check 1 (agreement): position, worst value", Some("m")));
        let joint = label("checks.1.measures.1.worst.q.arm.elbow");
        assert_eq!(joint, of("check 1 (agreement): position, worst value, arm.elbow there", None));
        assert_eq!(label("checks.1.measures.1.limit"), of("check 1 (agreement): position, limit", Some("m")));
        assert_eq!(label("checks.1.status"), of("check 1 (agreement): status", None));
        assert_eq!([label("seed"), label("checks.2.status")], [None, None]);
    }

    #[test]
    fn a_value_of_another_part_has_words_too() {
        let report = serde_json::json!({ "seed": 7, "exit_code": 0, "simulation": { "step_s": 0.001 },
            "actuators": [{ "joint": "elbow_joint", "largest_effort": 8.1, "at_effort_limit": 0.0, "unit": "N m" }],
            "motions": [{ "kind": "move_joints", "starts_s": 0.8 }],
            "links": [{ "link": "tool0", "source": "urdf" }],
            "stopped": { "time_s": 1.0, "q": { "wrist_1_joint": 0.5 } } });
        let check = |keys: &str, words: &str, unit: Option<&str>| {
            let found = ReportLabel::new(report.as_object().unwrap(), keys).unwrap();
            assert_eq!((found.words.as_str(), found.unit), (words, unit), "{keys}");
        };
        check("actuators.1.largest_effort", "actuator of elbow_joint: largest effort", Some("N m"));
        check("actuators.1.at_effort_limit", "actuator of elbow_joint: at effort limit", None);
        check("motions.1.starts_s", "motion 1 (move_joints): starts", None);
        check("links.1.source", "link tool0: source", None);
        check("simulation.step_s", "simulation: step", None);
        check("exit_code", "exit code", None);
        check("stopped.q.wrist_1_joint", "stopped, wrist_1_joint there", None);
    }
}
