//! What to write instead of a key with another unit, a transform that is a list, or a number that is an expression: the
//! reader of TOML names only what it has expected.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::number::number;

/// The key that is known for an unknown one in another unit, with the value in the unit of the key: `box_m = [0.1, 0.2]` for
/// `box_mm = [100, 200]`.
pub(super) fn in_known_unit<'k>(
    unknown: &str,
    known: impl IntoIterator<Item = &'k str>,
    root: &DeTable<'_>,
    at: &Range<usize>,
) -> Option<String> {
    let is_in_centimetres = unknown.split('_').any(|part| part == "cm");
    let mut matching = known.into_iter().filter_map(|key| Some((key, conversion(unknown, key)?)));
    let (first, next) = (matching.next()?, matching.next());
    // Of two keys for a value in centimetres that in millimetres: the number stays as short.
    let (key, convert) = next.filter(|(key, _)| is_in_centimetres && key.contains("mm")).unwrap_or(first);
    let value = converted(value_of_key(root, at)?, convert)?;
    let why = if is_in_centimetres { "centimetres are not read: " } else { "" };
    Some(format!("{why}write {key} = {value}"))
}

/// How a value under one key is converted to the other, if the two differ in one unit alone.
fn conversion(from: &str, to: &str) -> Option<fn(f64) -> f64> {
    let (from, to): (Vec<&str>, Vec<&str>) = (from.split('_').collect(), to.split('_').collect());
    if from.len() != to.len() {
        return None;
    }
    let mut others = from.iter().zip(&to).filter(|(from, to)| from != to);
    let (only, None) = (others.next()?, others.next()) else { return None };
    match only {
        // By 1000, and not by 0.001: the quotient has the digits that a person would write.
        (&"mm", &"m") => Some(|value| value / 1000.0),
        (&"m", &"mm") => Some(|value| value * 1000.0),
        (&"cm", &"mm") => Some(|value| value * 10.0),
        (&"cm", &"m") => Some(|value| value / 100.0),
        (&"deg", &"rad") => Some(f64::to_radians),
        (&"rad", &"deg") => Some(f64::to_degrees),
        _ => None,
    }
}

/// A number, or a list of numbers, in another unit.
fn converted(value: &DeValue<'_>, convert: fn(f64) -> f64) -> Option<String> {
    match value {
        DeValue::Integer(value) => Some(number(convert(value.as_str().parse::<f64>().ok()?))),
        DeValue::Float(value) => Some(number(convert(value.as_str().parse::<f64>().ok()?))),
        DeValue::Array(items) => {
            let items: Option<Vec<String>> =
                items.iter().map(|item| converted(item.get_ref(), convert)).collect();
            Some(format!("[{}]", items?.join(", ")))
        }
        _ => None,
    }
}

fn value_of_key<'v, 't>(table: &'v DeTable<'t>, key: &Range<usize>) -> Option<&'v DeValue<'t>> {
    fn within<'v, 't>(value: &'v DeValue<'t>, key: &Range<usize>) -> Option<&'v DeValue<'t>> {
        match value {
            DeValue::Table(table) => value_of_key(table, key),
            DeValue::Array(items) => items.iter().find_map(|item| within(item.get_ref(), key)),
            _ => None,
        }
    }
    table.iter().find_map(|(name, value)| match value.get_ref() {
        value if name.span() == *key => Some(value),
        value => within(value, key),
    })
}

/// The transform that was meant by a list of numbers, if the value at this place is in one: a table can be read from a list, and
/// then each number would have to be a list.
pub(super) fn transform_for_list(root: &DeTable<'_>, at: &Range<usize>) -> Option<String> {
    root.iter().find_map(|(key, value)| match value.get_ref() {
        DeValue::Array(items) if items.iter().any(|item| item.span() == *at) => {
            let is_transform = key.get_ref() == "tcp" || key.get_ref().contains("_from_");
            let numbers: Vec<&str> = items
                .iter()
                .filter_map(|item| match item.get_ref() {
                    DeValue::Integer(value) => Some(value.as_str()),
                    DeValue::Float(value) => Some(value.as_str()),
                    _ => None,
                })
                .collect();
            let [x, y, z] = numbers[..] else { return None };
            is_transform.then(|| {
                let key = key.get_ref();
                format!("a transform is a table: {key} = {{ xyz_mm = [{x}, {y}, {z}] }}, or xyz_m, with rpy_deg if it turns")
            })
        }
        DeValue::Array(items) => items.iter().find_map(|item| match item.get_ref() {
            DeValue::Table(table) => transform_for_list(table, at),
            _ => None,
        }),
        DeValue::Table(table) => transform_for_list(table, at),
        _ => None,
    })
}

/// The number that was meant by an expression such as `pi/2` at this place of a text that is no TOML.
pub(super) fn for_expression(text: &str, at: usize) -> Option<String> {
    let line_start = text.get(..at)?.rfind('\n').map_or(0, |end| end + 1);
    let before = text[line_start..at].rfind('=')?;
    let (key, rest) = text[line_start..].split_at(before);
    let key = key.rsplit([',', '{', ' ']).find(|word| !word.is_empty())?;
    let value = rest[1..].split(['\n', ',', '}', '#']).next()?.trim();
    if !value.contains("pi") && !value.contains("PI") {
        return None;
    }
    let meant = multiple_of_pi(value).and_then(|factor| match key.rsplit('_').next() {
        Some("deg") => Some(number(180.0 * factor)),
        Some("rad") => Some(number(std::f64::consts::PI * factor)),
        _ => None,
    });
    let meant = meant.map_or_else(|| "write the number".to_owned(), |meant| format!("{key} = {meant}"));
    Some(format!("TOML has no expressions such as {value}: {meant}"))
}

/// The factor of `-pi/2`, `2*pi/3` and their like.
fn multiple_of_pi(value: &str) -> Option<f64> {
    let value: String = value.to_lowercase().replace("math.", "").replace("np.", "").replace(' ', "");
    let (factor, divisor) = value.split_once("pi")?;
    let factor = match factor.trim_end_matches('*') {
        "" => 1.0,
        "-" => -1.0,
        factor => factor.parse().ok()?,
    };
    let divisor = match divisor {
        "" => 1.0,
        divisor => divisor.strip_prefix('/')?.parse().ok()?,
    };
    Some(factor / divisor)
}

#[cfg(test)]
mod tests {
    use toml::de::DeTable;

    use super::*;

    #[test]
    fn a_value_is_converted_to_the_unit_of_the_key() {
        let check = |text: &str, known: &str, expected: Option<&str>| {
            let root = DeTable::parse(text).unwrap();
            let key = text.split(' ').next().unwrap();
            let found = in_known_unit(key, [known], root.get_ref(), &(0..key.len()));
            assert_eq!(found.as_deref(), expected, "{text}");
        };
        check("box_mm = [100, 100, 200.5]", "box_m", Some("write box_m = [0.1, 0.1, 0.2005]"));
        check("speed_mm_s = 250", "speed_m_s", Some("write speed_m_s = 0.25"));
        check("turn_deg = 180", "turn_rad", Some("write turn_rad = 3.141592653589793"));
        check("box_mm = \"wide\"", "box_m", None);
        check("box_cm = 10", "box_m", Some("centimetres are not read: write box_m = 0.1"));
        check("d_cm = 26.7", "d_mm", Some("centimetres are not read: write d_mm = 267.0"));
    }

    #[test]
    fn an_expression_is_computed() {
        let check = |text: &str, expected: Option<&str>| {
            let at = text.find("pi").unwrap_or_default();
            assert_eq!(for_expression(text, at).as_deref(), expected, "{text}");
        };
        let half = "TOML has no expressions such as pi/2: alpha_deg = 90.0";
        check("a = 1\nalpha_deg = pi/2", Some(half));
        check("row = { a_m = 1, alpha_deg = pi/2 }", Some(half));
        check(
            "alpha_rad = -2*pi/4 # a quarter",
            Some("TOML has no expressions such as -2*pi/4: alpha_rad = -1.5707963267948966"),
        );
        check("alpha_deg = pi+1", Some("TOML has no expressions such as pi+1: write the number"));
        check("alpha_deg = x", None);
    }
}
