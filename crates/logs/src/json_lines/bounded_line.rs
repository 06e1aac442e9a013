//! Lines of a stream, of which none takes more memory than a message may.

use std::io::{self, BufRead, Read};

/// Most bytes of a line: a message of a thousand joints has half of it. The lines that wait to be judged take at most 8192 times as much.
const MOST_BYTES: usize = 1 << 17;

/// What a line is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LineLength {
    /// It is in the buffer.
    Whole,
    /// It is longer than a message may be; its beginning is in the buffer.
    TooLong,
    /// There is none: the stream has ended.
    End,
}

/// Reads the next line into the buffer, without its end.
///
/// # Errors
/// The stream cannot be read.
pub(super) fn read_line(input: &mut impl BufRead, buffer: &mut Vec<u8>) -> io::Result<LineLength> {
    buffer.clear();
    let most = MOST_BYTES as u64;
    let read = input.by_ref().take(most).read_until(b'\n', buffer)?;
    if read == 0 {
        return Ok(LineLength::End);
    }
    if buffer.last() == Some(&b'\n') {
        buffer.pop();
        return Ok(LineLength::Whole);
    }
    if read < MOST_BYTES {
        // The last line, which nobody has ended.
        return Ok(LineLength::Whole);
    }
    skip_to_end_of_line(input)?;
    Ok(LineLength::TooLong)
}

fn skip_to_end_of_line(input: &mut impl BufRead) -> io::Result<()> {
    loop {
        let part = input.fill_buf()?;
        let (length, is_end) = match part.iter().position(|byte| *byte == b'\n') {
            Some(at) => (at + 1, true),
            None => (part.len(), part.is_empty()),
        };
        input.consume(length);
        if is_end {
            return Ok(());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_is_skipped_and_the_next_one_is_read() {
        let text = ["short", &"x".repeat(2 * MOST_BYTES), "last"].join("\n");
        let (mut input, mut buffer) = (text.as_bytes(), Vec::new());
        let mut next = || (read_line(&mut input, &mut buffer).unwrap(), buffer.len());
        assert_eq!(next(), (LineLength::Whole, 5));
        assert_eq!(next(), (LineLength::TooLong, MOST_BYTES));
        assert_eq!(next(), (LineLength::Whole, 4));
        assert_eq!(next(), (LineLength::End, 0));
    }
}
