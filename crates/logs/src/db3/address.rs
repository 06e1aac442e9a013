//! How a database is opened without changing anything: its address for SQLite.

use std::{
    ffi::OsString,
    fmt::Write,
    io,
    path::{Path, absolute},
};

/// What SQLite keeps beside a database of which a part is not yet in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pending {
    /// Messages that were written and are not yet in the database.
    Log,
    /// What a change has replaced that did not end, since the recorder died.
    Journal,
}

/// The address of a database that is only read.
///
/// `immutable` reads without locks, so that a recorder which is still at work loses nothing, and without the files `-shm` and `-wal`,
/// which could not be made in a folder that is read-only. It would hide the messages that are in a `-wal`.
pub(super) fn read_only_address(path: &Path) -> io::Result<String> {
    let mut address = "file://".to_owned();
    let whole = absolute(path)?;
    let bytes = whole.as_os_str().as_encoded_bytes();
    // `C:\bag.db3` of Windows is `/C:/bag.db3` in an address.
    if !bytes.starts_with(b"/") {
        address.push('/');
    }
    for &byte in bytes {
        match byte {
            b'\\' if cfg!(windows) => address.push('/'),
            b'/' | b':' | b'-' | b'.' | b'_' => address.push(byte.into()),
            _ if byte.is_ascii_alphanumeric() => address.push(byte.into()),
            // Writing to a text cannot fail.
            _ => drop(write!(address, "%{byte:02X}")),
        }
    }
    address.push_str("?mode=ro");
    if pending(path).is_none() {
        address.push_str("&immutable=1");
    }
    Ok(address)
}

/// What is beside the database.
pub(super) fn pending(path: &Path) -> Option<Pending> {
    let is_there = |ending: &str| {
        let mut beside = OsString::from(path);
        beside.push(ending);
        Path::new(&beside).metadata().is_ok_and(|file| file.len() > 0)
    };
    [("-wal", Pending::Log), ("-journal", Pending::Journal)]
        .into_iter()
        .find_map(|(ending, pending)| is_there(ending).then_some(pending))
}
