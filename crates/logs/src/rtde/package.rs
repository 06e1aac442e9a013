//! Packages of RTDE: two bytes of length, one of type, the payload; all numbers are big-endian.

use std::io::{self, ErrorKind, Read};

/// Bytes before the payload.
const HEAD: usize = 3;

/// The types of packages that are sent or used.
pub(super) const PROTOCOL_VERSION: u8 = b'V';
pub(super) const SETUP_OUTPUTS: u8 = b'O';
pub(super) const START: u8 = b'S';
pub(super) const PAUSE: u8 = b'P';
pub(super) const DATA: u8 = b'U';

/// A package that was received.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Package {
    pub(super) kind: u8,
    pub(super) payload: Vec<u8>,
}

/// The bytes of a package to send.
pub(super) fn package(kind: u8, payload: &[u8]) -> Vec<u8> {
    let length = u16::try_from(HEAD + payload.len()).expect("what is sent is short");
    [&length.to_be_bytes()[..], &[kind], payload].concat()
}

/// Packages from bytes that come in any parts.
#[derive(Debug, Default)]
pub(super) struct ReceivedPackages {
    received: Vec<u8>,
}

impl ReceivedPackages {
    /// The next package; `None` if it has not come as a whole within the time of the socket: what has come of it is kept.
    ///
    /// # Errors
    /// The connection is closed, or what comes is not RTDE.
    pub(super) fn next(&mut self, input: &mut impl Read) -> io::Result<Option<Package>> {
        loop {
            if let Some(package) = self.take()? {
                return Ok(Some(package));
            }
            let mut part = [0; 4096];
            match input.read(&mut part) {
                Ok(0) => return Err(io::Error::new(ErrorKind::UnexpectedEof, "the robot has closed it")),
                Ok(length) => self.received.extend_from_slice(&part[..length]),
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                    return Ok(None);
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Takes a package out of what was received, if it is there as a whole.
    fn take(&mut self) -> io::Result<Option<Package>> {
        let [high, low, kind, ..] = self.received[..] else { return Ok(None) };
        let length = usize::from(u16::from_be_bytes([high, low]));
        if length < HEAD {
            let message = format!("a package has a length of {length} bytes: this is not RTDE");
            return Err(io::Error::new(ErrorKind::InvalidData, message));
        }
        if self.received.len() < length {
            return Ok(None);
        }
        let payload = self.received[HEAD..length].to_vec();
        self.received.drain(..length);
        Ok(Some(Package { kind, payload }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives one byte at a time, with a pause before each.
    struct Slow<'a>(&'a [u8], bool);

    impl Read for Slow<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.1 = !self.1;
            if self.1 {
                return Err(ErrorKind::WouldBlock.into());
            }
            self.0.read(&mut buffer[..1])
        }
    }

    #[test]
    fn packages_are_whole_however_their_bytes_come() {
        let bytes = [package(START, &[1]), package(DATA, b"abc")].concat();
        let (mut packages, mut input) = (ReceivedPackages::default(), Slow(&bytes, false));
        let mut found = Vec::new();
        let end = loop {
            match packages.next(&mut input) {
                Ok(next) => found.extend(next),
                Err(error) => break error,
            }
        };
        let expected = [(START, &[1][..]), (DATA, b"abc")];
        assert_eq!(found, expected.map(|(kind, payload)| Package { kind, payload: payload.to_vec() }));
        assert_eq!(end.kind(), ErrorKind::UnexpectedEof);
    }

    #[test]
    fn a_length_that_no_package_has_ends_the_connection() {
        let error = ReceivedPackages::default().next(&mut &[0, 2, 85, 0][..]).unwrap_err();
        assert!(error.to_string().contains("2 bytes"), "{error}");
    }
}
