//! Opens files; nothing else in this crate does. Kind and size are checked before the content is read: a pipe that nobody
//! writes to would block its reader, and a huge file would fill the memory. A path that a person names may be a pipe or
//! standard input; a path that a file names may not.

use std::{
    fs::{File, Metadata},
    io::{self, Read},
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
    time::Duration,
};

use super::pseudo::pseudo_folder;
use crate::{
    codes,
    diagnostic::{Diagnostic, SourceFile, line_column},
    nearest::nearest,
};

/// The names of standard input.
const STANDARD_INPUT: [&str; 2] = ["-", "/dev/stdin"];
/// How long to wait for a program that writes to a pipe. Kind: choice; a shell opens its end within milliseconds.
const WRITER_WAIT: Duration = Duration::from_secs(1);
/// Entries of a folder among which a name like the missing one is looked for.
const MOST_ENTRIES: usize = 10_000;

/// The folder of a file; a bare file name is in the current one, and so is what standard input names.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() && !is_standard_input(path) => parent,
        _ => Path::new("."),
    }
}

/// Whether a path means standard input.
pub fn is_standard_input(path: &Path) -> bool {
    STANDARD_INPUT.iter().any(|name| path == Path::new(name))
}

/// The bytes of a regular file of at most `most_bytes`.
pub(super) fn read_regular_bytes(path: &Path, most_bytes: u64) -> Result<Vec<u8>, Diagnostic> {
    read_at_most(open_regular(path, most_bytes)?, path, most_bytes)
}

/// A regular file of at most `most_bytes`. It may grow after this check, so its reader must count the bytes, too.
///
/// # Errors
/// It is a folder, a pipe or a device, does not exist, is too large, or may not be read.
pub fn open_regular(path: &Path, most_bytes: u64) -> Result<File, Diagnostic> {
    let metadata = metadata(path)?;
    if !metadata.is_file() {
        return Err(not_regular(path));
    }
    if let Some(folder) = pseudo_folder(path, &metadata) {
        return Err(made_up(path, folder));
    }
    if metadata.len() > most_bytes {
        return Err(too_large(path, metadata.len(), most_bytes));
    }
    File::open(path).map_err(|error| unreadable(path, &error))
}

/// The first bytes of a regular file as text, at most `bytes` of them.
///
/// # Errors
/// It is not a regular file, or cannot be read.
pub fn head_of(path: &Path, bytes: usize) -> Result<String, Diagnostic> {
    let mut head = Vec::new();
    let file = open_regular(path, u64::MAX)?;
    file.take(bytes as u64).read_to_end(&mut head).map_err(|error| unreadable(path, &error))?;
    Ok(String::from_utf8_lossy(&head).into_owned())
}

/// The bytes of a path that a person names: a regular file, a pipe or standard input.
pub(super) fn read_named_bytes(path: &Path, most_bytes: u64) -> Result<Vec<u8>, Diagnostic> {
    read_at_most(open_named(path, most_bytes)?, path, most_bytes)
}

/// Opens a path that a person names: a regular file of at most `most_bytes`, or a pipe or standard input, whose bytes the
/// reader must count.
pub(super) fn open_named(path: &Path, most_bytes: u64) -> Result<Box<dyn Read>, Diagnostic> {
    if is_standard_input(path) {
        return Ok(Box::new(standard_input(path)?.lock()));
    }
    if is_pipe(&metadata(path)?) {
        return Ok(Box::new(open_pipe(path)?));
    }
    Ok(Box::new(open_regular(path, most_bytes)?))
}

/// Standard input, which can be read once per program.
fn standard_input(path: &Path) -> Result<io::Stdin, Diagnostic> {
    static IS_TAKEN: AtomicBool = AtomicBool::new(false);
    if IS_TAKEN.swap(true, Ordering::Relaxed) {
        let message = format!("{}: another argument has already read standard input", path.display());
        return Err(Diagnostic::error(codes::file::STANDARD_INPUT, message)
            .with_help("give one of the arguments as a file"));
    }
    Ok(io::stdin())
}

#[cfg(unix)]
fn is_pipe(metadata: &Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&metadata.file_type())
}

#[cfg(not(unix))]
fn is_pipe(_: &Metadata) -> bool {
    false
}

/// Opening blocks until a program writes to the pipe, so another thread opens it; after `WRITER_WAIT` the thread is abandoned,
/// since a blocked open cannot be cancelled.
fn open_pipe(path: &Path) -> Result<File, Diagnostic> {
    let (sender, receiver) = mpsc::channel();
    let pipe: PathBuf = path.to_owned();
    std::thread::spawn(move || sender.send(File::open(pipe)));
    let opened = receiver.recv_timeout(WRITER_WAIT).map_err(|_| {
        let message = format!("{} is a named pipe, and no program writes to it", path.display());
        Diagnostic::error(codes::file::NO_WRITER, message)
    })?;
    opened.map_err(|error| unreadable(path, &error))
}

fn metadata(path: &Path) -> Result<Metadata, Diagnostic> {
    let metadata = std::fs::metadata(path).map_err(|error| unreadable(path, &error))?;
    if metadata.is_dir() {
        let message = format!("{} is a directory, not a file", path.display());
        return Err(
            Diagnostic::error(codes::file::DIRECTORY, message).with_help("give the name of a file in it")
        );
    }
    Ok(metadata)
}

fn read_at_most(from: impl Read, path: &Path, most_bytes: u64) -> Result<Vec<u8>, Diagnostic> {
    let mut bytes = Vec::new();
    from.take(most_bytes.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|error| unreadable(path, &error))?;
    let length = bytes.len() as u64;
    if length > most_bytes { Err(too_large(path, length, most_bytes)) } else { Ok(bytes) }
}

fn not_regular(path: &Path) -> Diagnostic {
    let message = format!("{} is not a regular file but a pipe, socket or device", path.display());
    Diagnostic::error(codes::file::NOT_REGULAR, message)
}

fn made_up(path: &Path, folder: &str) -> Diagnostic {
    let message = format!(
        "{} is a file of {folder}, whose content the system makes up while it is read: it is not opened",
        path.display()
    );
    Diagnostic::error(codes::file::NOT_REGULAR, message)
        .with_help("save its content as a file, and give that")
}

pub(super) fn too_large(path: &Path, length: u64, most_bytes: u64) -> Diagnostic {
    let message = format!("{} is too large: {length} bytes, the limit is {most_bytes}", path.display());
    Diagnostic::error(codes::file::TOO_LARGE, message)
}

/// Why a file cannot be read, by the reason of the system.
pub fn unreadable(path: &Path, error: &io::Error) -> Diagnostic {
    let name = path.display();
    match error.kind() {
        io::ErrorKind::NotFound => not_found(path, ""),
        io::ErrorKind::PermissionDenied => {
            Diagnostic::error(codes::file::PERMISSION, format!("{name}: permission denied"))
        }
        _ => Diagnostic::error(codes::file::UNREADABLE, format!("{name} cannot be read: {error}")),
    }
}

/// That a path does not exist, or that it is or goes through a link to something that does not.
pub fn absence(path: &Path) -> String {
    let name = path.display();
    match broken_link(path) {
        Some((link, target)) if link == path => {
            format!("{name} is a link to {}, which does not exist", target.display())
        }
        Some((link, target)) => {
            let [link, target] = [link, &target].map(Path::display);
            format!("{name} does not exist: {link} is a link to {target}, which does not exist")
        }
        None => format!("{name} does not exist"),
    }
}

/// The link on a path whose target is missing, and the target as it is written in the link.
fn broken_link(path: &Path) -> Option<(&Path, PathBuf)> {
    let mut missing = path.ancestors().filter(|part| !part.exists());
    missing.find_map(|part| Some((part, std::fs::read_link(part).ok()?)))
}

/// A missing file, with the name in its folder that is most like it as help; `named` is how another file names it, as
/// `urdf = "a.urdf": `.
pub fn not_found(path: &Path, named: &str) -> Diagnostic {
    let fault = Diagnostic::error(codes::file::NOT_FOUND, format!("{named}{}", absence(path)));
    if broken_link(path).is_some() {
        return fault.with_help("let the link name a file that exists, or give that file itself");
    }
    // A shell passes a pattern that matches nothing on as it is.
    let is_pattern = path.as_os_str().to_string_lossy().contains(['*', '?']);
    if is_pattern {
        return fault.with_help("no file matches this pattern: the shell has passed it on as it is");
    }
    match similar(path) {
        Some(similar) => fault.with_help(format!("did you mean {}?", similar.display())),
        None => fault,
    }
}

/// The path in the same folder whose name is most like this one's.
fn similar(path: &Path) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    let entries = std::fs::read_dir(folder_of(path)).ok()?.take(MOST_ENTRIES).filter_map(Result::ok);
    let mut names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    // The file system lists a folder in any order; sorted, the same folder always gives the same suggestion.
    names.sort();
    nearest(name, names.iter().map(String::as_str)).map(|name| path.with_file_name(name))
}

/// The text of a file of at most `most_bytes`, without a byte order mark. `path` is what a person names: a
/// regular file, a pipe, or `-` for standard input, which can be read once.
///
/// # Errors
/// The file cannot be read or is no UTF-8 text; the fault comes with as much of the text as is
/// needed to show its place.
pub fn read_text(path: &Path, most_bytes: u64) -> Result<Arc<SourceFile>, Diagnostic> {
    decode_text(path, &read_named_bytes(path, most_bytes)?)
}

/// The text of a file with these bytes, without a byte order mark.
pub(super) fn decode_text(path: &Path, bytes: &[u8]) -> Result<Arc<SourceFile>, Diagnostic> {
    let source =
        |text: &str| Arc::new(SourceFile { path: path.to_owned(), text: text.to_owned(), is_foreign: false });
    match decode(bytes) {
        Ok(text) => Ok(source(text)),
        Err(refused) => {
            let (fault, readable) = *refused;
            Err(fault.in_file(&source(readable)))
        }
    }
}

/// What is wrong with bytes that are no text, and the text up to there.
pub(super) type NotText<'a> = Box<(Diagnostic, &'a str)>;

/// UTF-8 without its byte order mark, or what is wrong and the text up to there.
pub(super) fn decode(bytes: &[u8]) -> Result<&str, NotText<'_>> {
    valid_text(without_mark(bytes).map_err(|fault| Box::new((fault.at(0..0), "")))?, 0)
}

/// UTF-8 without NUL that follows this number of lines.
pub(super) fn valid_text(bytes: &[u8], lines_before: usize) -> Result<&str, NotText<'_>> {
    let (good, bad) = match std::str::from_utf8(bytes) {
        Ok(text) => (text, None),
        Err(error) => {
            let (good, bad) = bytes.split_at(error.valid_up_to());
            (std::str::from_utf8(good).unwrap_or_default(), Some(bad))
        }
    };
    let end = good.find('\0').unwrap_or(good.len());
    let line = lines_before + line_column(good, end).0;
    let fault = match bad {
        _ if end < good.len() => nul(line),
        Some(rest) => not_utf8(rest, line),
        None => return Ok(good),
    };
    Err(Box::new((fault.at(end..end), &good[..end])))
}

/// The help of messages about a text in another encoding.
const AS_UTF8: &str = "save the file as UTF-8";
/// The first bytes of an MCAP.
const MCAP: &[u8] = b"\x89MCAP";
/// Bytes among which a file that is not text has a NUL. Kind: choice.
const BINARY_WITHIN: usize = 512;

/// The bytes of a text without its byte order mark; refuses an empty file and one that begins with a UTF-16 mark.
fn without_mark(bytes: &[u8]) -> Result<&[u8], Diagnostic> {
    if bytes.is_empty() {
        return Err(Diagnostic::error(codes::file::EMPTY, "the file is empty"));
    }
    if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
        let fault = Diagnostic::error(codes::file::UTF16, "the file is UTF-16, UTF-8 is expected");
        return Err(fault.with_help(AS_UTF8));
    }
    Ok(bytes.strip_prefix(&[0xEF, 0xBB, 0xBF]).unwrap_or(bytes))
}

fn nul(line: usize) -> Diagnostic {
    Diagnostic::error(codes::file::NUL, format!("NUL byte at line {line}: the file is not text"))
}

/// `rest` are the bytes from the first one on that is no UTF-8.
fn not_utf8(rest: &[u8], line: usize) -> Diagnostic {
    let byte = rest.first().copied().unwrap_or_default();
    let message = format!("byte 0x{byte:02X} at line {line} is not UTF-8");
    // Letters of another encoding have no NUL beside them, as pictures and archives have.
    let is_text = !rest.iter().take(BINARY_WITHIN).any(|&byte| byte == 0);
    let found = Diagnostic::error(codes::file::NOT_UTF8, message);
    found.with_help(if is_text {
        AS_UTF8
    } else if rest.starts_with(MCAP) {
        "the file is a log: `congruent describe LOG` says what is in it, and `congruent check ROBOT --against LOG` compares a \
         robot with the description that was recorded"
    } else {
        "the file is not text: a URDF, an MJCF or a TOML file is expected"
    })
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
    fn without_a_limit_all_is_read() {
        let read = |most_bytes| read_at_most(&b"abc"[..], Path::new("a"), most_bytes);
        assert_eq!(read(u64::MAX).unwrap(), b"abc");
        assert_eq!(read(3).unwrap(), b"abc");
        assert!(read(2).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_nothing_is_named_as_such() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("arm.urdf");
        std::os::unix::fs::symlink("gone/arm.urdf", &link).unwrap();
        let found = read_regular_bytes(&link, 9).unwrap_err();
        assert_eq!(
            found.message,
            format!("{} is a link to gone/arm.urdf, which does not exist", link.display())
        );
        assert!(!found.help.unwrap().contains("did you mean"));
        let (below, gone) = (link.join("robot.toml"), folder.path().join("none"));
        assert!(
            absence(&below).ends_with("is a link to gone/arm.urdf, which does not exist"),
            "{}",
            absence(&below)
        );
        assert!(absence(&gone).ends_with("none does not exist"));
    }

    #[test]
    fn kind_and_size_come_first() {
        let folder = tempfile::tempdir().unwrap();
        let code = |path: &Path, most| read_regular_bytes(path, most).unwrap_err().code.name;
        assert_eq!(code(folder.path(), 9), "file::directory");
        assert_eq!(code(&folder.path().join("none"), 9), "file::not_found");
        let file = folder.path().join("file");
        std::fs::write(&file, [0; 10]).unwrap();
        assert_eq!(code(&file, 9), "file::too_large");
        assert_eq!(read_regular_bytes(&file, 10).unwrap().len(), 10);
    }

    #[test]
    #[cfg(unix)]
    fn a_device_is_not_opened() {
        assert_eq!(read_text(Path::new("/dev/zero"), 9).unwrap_err().code.name, "file::not_regular");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_file_of_proc_is_not_opened() {
        for path in ["/proc/kmsg", "/proc/version"].map(Path::new) {
            for fault in [read_text(path, 9).unwrap_err(), head_of(path, 9).unwrap_err()] {
                assert_eq!(fault.code.name, "file::not_regular");
                assert!(fault.message.contains("is a file of /proc, whose content"), "{fault:?}");
            }
        }
    }

    #[test]
    #[cfg(unix)]
    fn a_pipe_is_read_if_a_person_names_it_and_if_a_program_writes_to_it() {
        let folder = tempfile::tempdir().unwrap();
        let make = |name: &str| {
            let pipe = folder.path().join(name);
            assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
            pipe
        };
        let (silent, pipe) = (make("silent"), make("pipe"));
        assert_eq!(read_text(&silent, 9).unwrap_err().code.name, "file::no_writer");
        assert_eq!(read_regular_bytes(&pipe, 9).unwrap_err().code.name, "file::not_regular");
        assert_eq!(head_of(&silent, 9).unwrap_err().code.name, "file::not_regular");
        let to = pipe.clone();
        let writer = std::thread::spawn(move || std::fs::write(to, "written"));
        assert_eq!(read_text(&pipe, 9).unwrap().text, "written");
        writer.join().unwrap().unwrap();
    }

    #[test]
    fn a_missing_file_is_answered_with_the_name_most_like_it() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("ur5e.toml"), "a").unwrap();
        let help = |name: &str| read_text(&folder.path().join(name), 9).unwrap_err().help;
        assert!(help("ur5.toml").unwrap().ends_with("ur5e.toml?"));
        assert_eq!(help("panda"), None);
    }
}
