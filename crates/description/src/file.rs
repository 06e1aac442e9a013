//! Opens files; nothing else in this crate does. Kind and size are checked before the content is read: a
//! pipe would block its reader, and a huge file would fill the memory.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
    sync::Arc,
};

use crate::diagnostic::{Diagnostic, SourceFile, line_column};

/// The bytes of a regular file of at most `most_bytes`.
pub(crate) fn read_bytes(path: &Path, most_bytes: u64) -> Result<Vec<u8>, Diagnostic> {
    let name = path.display();
    let unreadable = |error: io::Error| match error.kind() {
        io::ErrorKind::NotFound => Diagnostic::error("file::not_found", format!("{name} does not exist")),
        io::ErrorKind::PermissionDenied => {
            Diagnostic::error("file::permission", format!("{name}: permission denied"))
        }
        _ => Diagnostic::error("file::unreadable", format!("{name} cannot be read: {error}")),
    };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(Diagnostic::error("file::directory", format!("{name} is a directory, not a file")));
    }
    if !metadata.is_file() {
        let message = format!("{name} is not a regular file but a pipe, socket or device");
        return Err(Diagnostic::error("file::not_regular", message));
    }
    // One byte more than allowed is asked for: the file may have grown since its size was read.
    let mut bytes = Vec::new();
    if metadata.len() <= most_bytes {
        let file = File::open(path).map_err(unreadable)?;
        file.take(most_bytes + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    }
    let length = metadata.len().max(bytes.len() as u64);
    if length > most_bytes {
        let message = format!("{name} is too large: {length} bytes, the limit is {most_bytes}");
        return Err(Diagnostic::error("file::too_large", message));
    }
    Ok(bytes)
}

/// The text of a regular file of at most `most_bytes`, without a byte order mark.
///
/// # Errors
/// The file cannot be read or is no UTF-8 text; the fault comes with as much of the text as is
/// needed to show its place.
pub fn read_text(path: &Path, most_bytes: u64) -> Result<Arc<SourceFile>, Diagnostic> {
    let source = |text: &str| Arc::new(SourceFile { path: path.to_owned(), text: text.to_owned() });
    let bytes = read_bytes(path, most_bytes)?;
    match decode(&bytes) {
        Ok(text) => Ok(source(text)),
        Err(refused) => {
            let (fault, readable) = *refused;
            Err(fault.in_file(&source(readable)))
        }
    }
}

/// UTF-8 without its byte order mark, or what is wrong and the text up to there.
fn decode(bytes: &[u8]) -> Result<&str, Box<(Diagnostic, &str)>> {
    let refused = |code, message: String, readable, help: Option<&str>| {
        let end = str::len(readable);
        let fault = Diagnostic::error(code, message).at(end..end);
        Box::new((Diagnostic { help: help.map(str::to_owned), ..fault }, readable))
    };
    let as_utf8 = Some("save the file as UTF-8");
    if bytes.is_empty() {
        return Err(refused("file::empty", "the file is empty".to_owned(), "", None));
    }
    if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
        let message = "the file is UTF-16, UTF-8 is expected".to_owned();
        return Err(refused("file::utf16", message, "", as_utf8));
    }
    let bytes = bytes.strip_prefix(&[0xEF, 0xBB, 0xBF]).unwrap_or(bytes);
    let (good, bad) = match std::str::from_utf8(bytes) {
        Ok(text) => (text, None),
        Err(error) => {
            let (good, bad) = bytes.split_at(error.valid_up_to());
            (std::str::from_utf8(good).unwrap_or_default(), bad.first())
        }
    };
    if let Some(at) = good.find('\0') {
        let (line, _) = line_column(good, at);
        let message = format!("NUL byte at line {line}: the file is not text");
        return Err(refused("file::nul", message, &good[..at], None));
    }
    let Some(byte) = bad else { return Ok(good) };
    let (line, _) = line_column(good, good.len());
    let message = format!("byte 0x{byte:02X} at line {line} is not UTF-8");
    Err(refused("file::not_utf8", message, good, as_utf8))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(bytes: &[u8], expected: Result<&str, &str>) {
        let found = decode(bytes).map_err(|refused| refused.0.message);
        assert_eq!(found.as_ref().map(|text| *text).map_err(String::as_str), expected);
    }

    #[test]
    fn text_is_utf8() {
        check(b"a\n\xC3\xA9", Ok("a\né"));
        check(b"\xEF\xBB\xBFa", Ok("a"));
        check(b"", Err("the file is empty"));
        check(b"\xFF\xFEa\0", Err("the file is UTF-16, UTF-8 is expected"));
        check(b"a\nb\0", Err("NUL byte at line 2: the file is not text"));
        check(b"a\n\nb\xE9c", Err("byte 0xE9 at line 3 is not UTF-8"));
        check(b"a\0\nb\xE9c", Err("NUL byte at line 1: the file is not text"));
    }

    #[test]
    fn kind_and_size_come_first() {
        let folder = tempfile::tempdir().unwrap();
        let code = |path: &Path, most| read_bytes(path, most).unwrap_err().code;
        assert_eq!(code(folder.path(), 9), "file::directory");
        assert_eq!(code(&folder.path().join("none"), 9), "file::not_found");
        let file = folder.path().join("file");
        std::fs::write(&file, [0; 10]).unwrap();
        assert_eq!(code(&file, 9), "file::too_large");
        assert_eq!(read_bytes(&file, 10).unwrap().len(), 10);
    }

    #[test]
    #[cfg(unix)]
    fn a_device_is_not_opened() {
        assert_eq!(read_bytes(Path::new("/dev/zero"), 9).unwrap_err().code, "file::not_regular");
    }
}
