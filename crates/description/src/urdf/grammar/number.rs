//! Numbers in attributes, token by token: `urdf-rs` drops a vector's tokens that are not numbers.

/// What is wrong with `text` as `count` numbers separated by white space; `None` if nothing is.
///
/// Rust's parser takes infinities and `1e400` for numbers; no robot has such values.
pub(super) fn fault(text: &str, count: usize) -> Option<String> {
    let tokens: Vec<&str> = text.split_whitespace().collect();
    if let Some(fault) = tokens.iter().find_map(|token| token_fault(token)) {
        return Some(fault);
    }
    let found = tokens.len();
    let numbers = if count == 1 { "number" } else { "numbers" };
    (found != count).then(|| format!("expected {count} {numbers}, found {found}"))
}

fn token_fault(token: &str) -> Option<String> {
    match token.parse::<f64>() {
        Ok(number) if number.is_finite() => None,
        // 1e999 parses as infinity; "inf" and "nan" are written on purpose.
        Ok(_) if token.contains(|c: char| c.is_ascii_digit()) => {
            Some(format!("\"{token}\" is out of range: it is not finite in double precision"))
        }
        Ok(_) => Some(format!("\"{token}\" is not a finite number")),
        Err(_) if token.replace(',', ".").parse::<f64>().is_ok() => {
            Some(format!("\"{token}\" is not a number: use a point for decimals"))
        }
        Err(_) => Some(format!("\"{token}\" is not a number")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, count: usize, expected: Option<&str>) {
        assert_eq!(fault(text, count).as_deref(), expected, "{text}");
    }

    #[test]
    fn every_token_counts() {
        check(" -0.5 \n", 1, None);
        check("0 1e-3 +2.", 3, None);
        check("0 0.4", 3, Some("expected 3 numbers, found 2"));
        check("", 1, Some("expected 1 number, found 0"));
        check("0 0 0 0", 3, Some("expected 3 numbers, found 4"));
        check("0,1 0 0 0.4", 3, Some("\"0,1\" is not a number: use a point for decimals"));
        check("1.3kg", 1, Some("\"1.3kg\" is not a number"));
        check("0x10", 1, Some("\"0x10\" is not a number"));
        check("nan", 1, Some("\"nan\" is not a finite number"));
        check("-inf", 1, Some("\"-inf\" is not a finite number"));
        check("1e400", 1, Some("\"1e400\" is out of range: it is not finite in double precision"));
    }
}
