//! What was meant by a value that is not a number in TOML: one with a decimal comma, or with its unit behind it.

/// A value that a person reads as a number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NumberMistake {
    /// The value as it is written: `302,5`, `90°`.
    pub(super) written: String,
    /// What is wrong with it.
    pub(super) message: String,
    /// What to write.
    pub(super) help: String,
}

/// Units that are written behind numbers, with the ending of the keys that have it, if there are such keys.
const UNITS: [(&str, &str); 18] = [
    // Longer ones first: `mm` begins as `m` does.
    ("degrees", "deg"),
    ("degree", "deg"),
    ("deg", "deg"),
    ("\u{b0}", "deg"),
    // The ordinal indicator and the ring, which keyboards have in place of the degree sign.
    ("\u{ba}", "deg"),
    ("\u{2da}", "deg"),
    ("rad", "rad"),
    ("mm", "mm"),
    ("cm", ""),
    ("um", ""),
    ("kg", "kg"),
    ("g", "g"),
    ("m/s^2", "m_s2"),
    ("m/s2", "m_s2"),
    ("m/s", "m_s"),
    ("m", "m"),
    ("s", "s"),
    ("in", ""),
];

impl NumberMistake {
    /// The mistake in what follows `key =`; `None` if it is not a number with a comma or a unit.
    pub(super) fn in_value(key: &str, value: &str) -> Option<Self> {
        let value = value.trim_start();
        let number = number_at_start(value)?;
        let rest = &value[number.len()..];
        Self::decimal_comma(key, number, rest).or_else(|| Self::unit(key, number, rest))
    }

    /// `270,5`: a digit follows the comma, and no key.
    fn decimal_comma(key: &str, whole: &str, rest: &str) -> Option<Self> {
        let fraction = rest.strip_prefix(',')?;
        let digits = fraction.len() - fraction.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (fraction, behind) = fraction.split_at(digits);
        let ends = behind.trim_start_matches([' ', '\t']);
        let is_end = ends.is_empty() || ends.starts_with([',', '}', ']', '#', '\n', '\r']);
        if digits == 0 || !is_end || whole.contains(['.', 'e', 'E']) {
            return None;
        }
        let written = format!("{whole},{fraction}");
        Some(Self {
            message: format!("{written} is not a number: use a point for decimals"),
            help: format!("write {key} = {whole}.{fraction}"),
            written,
        })
    }

    /// `90°`, `302 mm`.
    fn unit(key: &str, number: &str, rest: &str) -> Option<Self> {
        let behind = rest.trim_start_matches([' ', '\t']);
        let spaces = rest.len() - behind.len();
        let (unit, ending) = UNITS.into_iter().find(|(unit, _)| {
            let after = behind.strip_prefix(unit).and_then(|after| after.chars().next());
            behind.starts_with(unit) && after.is_none_or(|after| !after.is_alphanumeric() && after != '_')
        })?;
        let written = format!("{number}{}{unit}", &rest[..spaces]);
        let what = if unit.chars().all(char::is_alphabetic) && unit.is_ascii() { unit } else { "the sign" };
        let what = if what == "the sign" && unit.contains('/') { unit } else { what };
        let (stem, own) = key.rsplit_once('_').unwrap_or((key, ""));
        let is_own = UNITS.iter().any(|(_, known)| !known.is_empty() && *known == own);
        let help = if is_own && own == ending {
            format!("write {number} without {what}: the unit is in the key, {key} = {number}")
        } else if ending.is_empty() {
            format!("write a number without {what}: the unit is in the key")
        } else {
            let stem = if is_own { stem } else { key };
            format!("write {number} without {what}: the unit is in the key, {stem}_{ending} = {number}")
        };
        Some(Self { message: format!("{written} is not a number"), help, written })
    }
}

/// The decimal number that a text begins with.
fn number_at_start(text: &str) -> Option<&str> {
    let unsigned = text.trim_start_matches(['-', '+']);
    let digits = unsigned.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    let end = text.len() - digits.len();
    // 2e-3, but not the e of another word.
    let exponent = digits.strip_prefix(['e', 'E']).map(|power| {
        let digits = power.trim_start_matches(['-', '+']);
        (
            power.len() - digits.len(),
            digits.len() - digits.trim_start_matches(|c: char| c.is_ascii_digit()).len(),
        )
    });
    let end = match exponent {
        Some((sign, digits @ 1..)) => end + 1 + sign + digits,
        _ => end,
    };
    let number = &text[..end];
    number.bytes().any(|byte| byte.is_ascii_digit()).then_some(number)
}

/// The mistake in a line of a text that is no TOML, with its place in the line: of the assignments in it the first that
/// has one.
pub(super) fn mistake_in_line(line: &str) -> Option<(usize, NumberMistake)> {
    /// Nobody types a longer line, and each assignment looks at all of the line before it.
    const LONGEST: usize = 4000;
    if line.len() > LONGEST {
        return None;
    }
    line.match_indices('=').find_map(|(at, _)| {
        let key = line[..at].trim_end().rsplit([',', '{', ' ', '\t']).next()?;
        let value = &line[at + 1..];
        let spaces = value.len() - value.trim_start().len();
        let is_key = !key.is_empty() && key.bytes().all(|c| c.is_ascii_alphanumeric() || b"_-.".contains(&c));
        // A text in quotes is a comment or a name, and no assignment.
        let is_quoted = line[..at].matches('"').count() % 2 == 1 || line[..at].contains('#');
        (is_key && !is_quoted).then_some(())?;
        Some((at + 1 + spaces, NumberMistake::in_value(key, value)?))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn is(line: &str, written: &str, message: &str, help: &str) {
        let (at, found) = mistake_in_line(line).unwrap_or_else(|| panic!("nothing in {line}"));
        assert_eq!(&line[at..at + found.written.len()], written, "{line}");
        assert_eq!((found.message.as_str(), found.help.as_str()), (message, help), "{line}");
    }

    #[test]
    fn a_decimal_comma_is_named() {
        let message = "302,5 is not a number: use a point for decimals";
        is("d_mm = 302,5", "302,5", message, "write d_mm = 302.5");
        is("    { joint = \"a\", d_mm = 302,5, theta_deg = 0 },", "302,5", message, "write d_mm = 302.5");
        is("{ a_mm = 1, d_mm = 302,5 }", "302,5", message, "write d_mm = 302.5");
        let negative = "-0,05 is not a number: use a point for decimals";
        is("a_mm = -0,05 # typed", "-0,05", negative, "write a_mm = -0.05");
    }

    #[test]
    fn a_unit_behind_a_number_is_named() {
        let sign = "write 90 without the sign: the unit is in the key, alpha_deg = 90";
        is("{ alpha_deg = 90\u{b0}, d_mm = 1 }", "90\u{b0}", "90\u{b0} is not a number", sign);
        let unit = "write 302 without mm: the unit is in the key, d_mm = 302";
        is("{ d_mm = 302 mm }", "302 mm", "302 mm is not a number", unit);
        is("d = 302mm", "302mm", "302mm is not a number", unit);
        let other = "write 0.302 without m: the unit is in the key, d_m = 0.302";
        is("d_mm = 0.302m", "0.302m", "0.302m is not a number", other);
        let without = "write a number without cm: the unit is in the key";
        is("d_mm = 30.2cm", "30.2cm", "30.2cm is not a number", without);
    }

    #[test]
    fn what_is_a_number_or_a_text_is_left_alone() {
        for line in [
            "d_mm = 302, theta_deg = 1",
            "xyz_m = [1,5]",
            "d_m = 2e-3",
            "name = \"a = 302,5\"",
            "# d_mm = 302,5",
            "d_mm = x",
            "d_mm = 302,5 = 1",
            "d_mm = 302many",
        ] {
            assert_eq!(mistake_in_line(line), None, "{line}");
        }
    }
}
