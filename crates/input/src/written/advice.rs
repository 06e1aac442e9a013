//! What to write instead of a key with another unit, a transform that is a list, or a number that is an expression: the
//! reader of TOML names only what it has expected.

use std::ops::Range;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::{number::number, serde_message::whole_numbers};

/// The key that is known for an unknown one in another unit, with the value in the unit of the key: `box_m = [0.1, 0.2]` for
/// `box_mm = [100, 200]`.
pub(super) fn in_known_unit<'k>(
    unknown: &str,
    known: impl IntoIterator<Item = &'k str>,
    root: &DeTable<'_>,
    at: &Range<usize>,
) -> Option<String> {
    let unread = unknown.split('_').find_map(name_of_unread_unit);
    let mut matching = known.into_iter().filter_map(|key| Some((key, conversion(unknown, key)?)));
    let (first, next) = (matching.next()?, matching.next());
    // Of two keys for a value in centimetres or inches that in millimetres: the number stays as short.
    let (key, convert) = next.filter(|(key, _)| unread.is_some() && key.contains("mm")).unwrap_or(first);
    let value = converted(value_of_key(root, at)?, convert)?;
    let why = unread.map_or_else(String::new, |unit| format!("{unit} are not read: "));
    Some(format!("{why}write {key} = {value}"))
}

/// The name of a unit that no key has, by the part of a key.
fn name_of_unread_unit(part: &str) -> Option<&'static str> {
    match part {
        "cm" => Some("centimetres"),
        "in" | "inch" | "inches" => Some("inches"),
        _ => None,
    }
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
        (&("in" | "inch" | "inches"), &"mm") => Some(|value| value * 254.0 / 10.0),
        (&("in" | "inch" | "inches"), &"m") => Some(|value| value * 254.0 / 10_000.0),
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

/// What is wrong with a whole number that is too large for its key, with the key and the range; and what to write, if a number
/// of any size may be there.
pub(super) fn for_large_integer(
    message: &str,
    root: &DeTable<'_>,
    at: &Range<usize>,
) -> Option<(String, Option<String>)> {
    let expected = message.rsplit_once(", expected ").map_or("", |(_, expected)| expected);
    // A number that is too large for any type has a message without the expected one.
    let is_beyond_all = message == TOO_LARGE_FOR_TOML || message.contains("` as ");
    let (key, value) = integer_at(root, at).filter(|(_, value)| !value.starts_with('-') || is_beyond_all)?;
    let [least, most] = match whole_numbers(expected) {
        Some(range) if is_beyond_all || message.starts_with("invalid value: ") => range,
        None if is_beyond_all => [i64::MIN.to_string(), u64::MAX.to_string()],
        _ => return None,
    };
    let help = matches!(expected, "f64" | "f32" | "").then(|| {
        format!("if {key} need not be a whole number, write a point: {key} = {}.0", value.replace('_', ""))
    });
    Some((format!("{key} = {value} is outside the range of whole numbers, {least} to {most}"), help))
}

/// What the `toml` crate says of an integer that fits in no type.
const TOO_LARGE_FOR_TOML: &str = "integer number overflowed";

/// The integer at this place as it is written, and its key, or that of the list that it is in.
fn integer_at<'v>(root: &'v DeTable<'_>, at: &Range<usize>) -> Option<(&'v str, &'v str)> {
    fn within<'v>(
        key: &'v str,
        value: &'v Spanned<DeValue<'_>>,
        at: &Range<usize>,
    ) -> Option<(&'v str, &'v str)> {
        match value.get_ref() {
            DeValue::Integer(integer) if value.span() == *at => Some((key, integer.as_str())),
            DeValue::Array(items) => items.iter().find_map(|item| within(key, item, at)),
            DeValue::Table(table) => integer_at(table, at),
            _ => None,
        }
    }
    root.iter().find_map(|(key, value)| within(key.get_ref(), value, at))
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
        check("d_inch = 11.5", "d_mm", Some("inches are not read: write d_mm = 292.1"));
        check("a_in = 2", "a_m", Some("inches are not read: write a_m = 0.0508"));
    }

    #[test]
    fn a_whole_number_that_is_too_large_has_key_value_and_range() {
        #[derive(Debug, serde::Deserialize)]
        #[expect(dead_code, reason = "what is read is not looked at")]
        struct Written {
            seed: Option<u64>,
            count: Option<u32>,
            a_m: Option<f64>,
        }
        let check = |text: &str, expected: &str, help: Option<&str>| {
            let table = DeTable::parse(text).unwrap();
            let root = table.get_ref().clone();
            let error =
                <Written as serde::Deserialize>::deserialize(toml::Deserializer::from(table)).unwrap_err();
            let found = for_large_integer(error.message(), &root, &error.span().unwrap());
            let (message, advice) = found.unwrap_or_default();
            assert_eq!(
                (message.as_str(), advice.as_deref()),
                (expected, help),
                "{text}: {}",
                error.message()
            );
        };
        let outside = "is outside the range of whole numbers, ";
        let large = "99999999999999999999999";
        check(
            &format!("seed = {large}"),
            &format!("seed = {large} {outside}0 to 18446744073709551615"),
            None,
        );
        check("count = 4294967296", &format!("count = 4294967296 {outside}0 to 4294967295"), None);
        let point = format!("if a_m need not be a whole number, write a point: a_m = {large}.0");
        check(
            &format!("a_m = {large}"),
            &format!("a_m = {large} {outside}-9223372036854775808 to 18446744073709551615"),
            Some(&point),
        );
        // No type has 41 digits.
        let huge = format!("{large}999999999999999999");
        let point = format!("if seed need not be a whole number, write a point: seed = {huge}.0");
        check(
            &format!("seed = {huge}"),
            &format!("seed = {huge} {outside}-9223372036854775808 to 18446744073709551615"),
            Some(&point),
        );
        check("seed = -1", "", None);
        check("seed = 1.5", "", None);
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
