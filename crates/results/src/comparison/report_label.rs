//! Values of a report as people call them: `checks.1.measures.2.worst.value` is the worst orientation of the check agreement.

use congruent_input::{Quantity, SiUnit};
use serde::Deserialize;
use serde_json::{Map, Value as Json};

use crate::report::quantity_words;

/// What a value is, and the unit beside it in the report.
#[derive(Debug, PartialEq)]
pub(super) struct ReportLabel {
    pub(super) words: String,
    pub(super) unit: Option<&'static str>,
}

impl ReportLabel {
    /// The label of a value of a check; `None` for others, whose keys are words.
    pub(super) fn new(report: &Map<String, Json>, keys: &str) -> Option<Self> {
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
}
