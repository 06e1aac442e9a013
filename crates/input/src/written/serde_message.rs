//! What serde says of a value of another type, in the words of a person who writes files.

use super::number_mistake::NumberMistake;

/// A message such as `invalid type: string "270", expected f64` as `must be a number, not the text "270"`; other messages stay
/// as they are. With it, what to do, if that is clear.
pub fn in_words(message: &str) -> (String, Option<String>) {
    let said = message.strip_prefix("invalid type: ").or_else(|| message.strip_prefix("invalid value: "));
    let Some((found, expected)) = said.and_then(|said| said.rsplit_once(", expected ")) else {
        return (message.to_owned(), None);
    };
    let is_number = expected_number(expected).is_some();
    let is_quoted_number = found
        .strip_prefix("string \"")
        .and_then(|text| text.strip_suffix('"'))
        .is_some_and(|text| text.trim().parse::<f64>().is_ok());
    // As reports write a pair of links: "link_4--link_6".
    let pair = found
        .strip_prefix("string \"")
        .and_then(|text| text.strip_suffix('"')?.split_once("--"))
        .filter(|_| expected == "an array of length 2");
    let help = match pair {
        Some((first, second)) => Some(format!("write [\"{first}\", \"{second}\"]")),
        None if is_number && is_quoted_number => Some("write it without quotes".to_owned()),
        None if is_number => quoted_mistake(found),
        None => None,
    };
    (format!("must be {}, not {}", expected_in_words(expected), found_in_words(found)), help)
}

/// What to write for a text that is nearly a number: `"302,5"`, `"302 mm"`.
fn quoted_mistake(found: &str) -> Option<String> {
    let text = found.strip_prefix("string \"")?.strip_suffix('"')?.trim();
    let mistake = NumberMistake::in_value("", text).filter(|mistake| mistake.written == text)?;
    let has_comma = mistake.written.contains(',');
    let comma = || format!("write {} without quotes: use a point for decimals", text.replace(',', "."));
    Some(if has_comma { comma() } else { "write the number alone: the unit is in the key".to_owned() })
}

fn expected_number(expected: &str) -> Option<&'static str> {
    Some(match expected {
        "f64" | "f32" => "a number",
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number that is not negative",
        _ => return None,
    })
}

/// The whole numbers that are allowed where serde expects this type, the smallest and the largest.
pub(super) fn whole_numbers(expected: &str) -> Option<[String; 2]> {
    Some(match expected {
        "u8" => [u8::MIN.to_string(), u8::MAX.to_string()],
        "u16" => [u16::MIN.to_string(), u16::MAX.to_string()],
        "u32" => [u32::MIN.to_string(), u32::MAX.to_string()],
        "u64" | "usize" => [u64::MIN.to_string(), u64::MAX.to_string()],
        "i8" => [i8::MIN.to_string(), i8::MAX.to_string()],
        "i16" => [i16::MIN.to_string(), i16::MAX.to_string()],
        "i32" => [i32::MIN.to_string(), i32::MAX.to_string()],
        "i64" | "isize" => [i64::MIN.to_string(), i64::MAX.to_string()],
        _ => return None,
    })
}

fn expected_in_words(expected: &str) -> String {
    if let Some(number) = expected_number(expected) {
        return number.to_owned();
    }
    match expected {
        "a string" | "string" => "a text in quotes".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "a list, [...]".to_owned(),
        "a map" => "a table of keys and values".to_owned(),
        other => match other.strip_prefix("an array of length ") {
            Some(length) => format!("a list of {length} values"),
            None if other.starts_with("struct ") => "a table of keys and values".to_owned(),
            None => other.to_owned(),
        },
    }
}

fn found_in_words(found: &str) -> String {
    // serde writes the kind before the value: string "a", integer `3`, floating point `0.5`, boolean `true`.
    if let Some(text) = found.strip_prefix("string ") {
        return format!("the text {text}");
    }
    for kind in ["integer ", "floating point ", "boolean "] {
        if let Some(value) = found.strip_prefix(kind) {
            return value.split('`').find(|part| !part.is_empty()).unwrap_or_default().to_owned();
        }
    }
    match found {
        "sequence" => "a list".to_owned(),
        "map" => "a table".to_owned(),
        "null" | "unit value" => "nothing".to_owned(),
        other => other.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_said_in_words() {
        let check = |message: &str, words: &str, help: Option<&str>| {
            assert_eq!(in_words(message), (words.to_owned(), help.map(str::to_owned)));
        };
        check(
            "invalid type: string \"270\", expected f64",
            "must be a number, not the text \"270\"",
            Some("write it without quotes"),
        );
        check(
            "invalid type: string \"a, expected b\", expected f64",
            "must be a number, not the text \"a, expected b\"",
            None,
        );
        check(
            "invalid type: floating point `1.5`, expected u64",
            "must be a whole number that is not negative, not 1.5",
            None,
        );
        check(
            "invalid value: integer `-1`, expected usize",
            "must be a whole number that is not negative, not -1",
            None,
        );
        check(
            "invalid type: integer `99999999999999999999` as i128, expected f64",
            "must be a number, not 99999999999999999999",
            None,
        );
        check("invalid type: integer `3`, expected a string", "must be a text in quotes, not 3", None);
        check(
            "invalid type: map, expected an array of length 3",
            "must be a list of 3 values, not a table",
            None,
        );
        check(
            "invalid type: sequence, expected struct Written",
            "must be a table of keys and values, not a list",
            None,
        );
        check(
            "invalid type: string \"link_4--link_6\", expected an array of length 2",
            "must be a list of 2 values, not the text \"link_4--link_6\"",
            Some("write [\"link_4\", \"link_6\"]"),
        );
        check(
            "invalid type: string \"302,5\", expected f64",
            "must be a number, not the text \"302,5\"",
            Some("write 302.5 without quotes: use a point for decimals"),
        );
        check(
            "invalid type: string \"302 mm\", expected f64",
            "must be a number, not the text \"302 mm\"",
            Some("write the number alone: the unit is in the key"),
        );
        check("duplicate key", "duplicate key", None);
    }
}
