//! Values in CDR, in both byte orders. Lengths that a message claims are compared with the bytes that it has before anything
//! is allocated for them.

/// Why a message cannot be decoded.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub(crate) enum CdrFault {
    /// It ends inside a value.
    #[error("it ends after {length} bytes, inside a value")]
    Short {
        /// Its length.
        length: usize,
    },
    /// Its first two bytes are of no known representation.
    #[error("its first two bytes are {0:#06x}, which is neither little- nor big-endian CDR")]
    Representation(u16),
    /// It is a frame of zstd.
    #[error("it is compressed by zstd on its own")]
    Compressed,
    /// A length is larger than what follows.
    #[error("it claims {claimed} entries, and {bytes} bytes follow")]
    Length {
        /// The claim.
        claimed: u32,
        /// What follows.
        bytes: usize,
    },
    /// A list is longer than any of a robot.
    #[error("it claims {claimed} entries, the limit is {MOST_ENTRIES}")]
    TooMany {
        /// The claim.
        claimed: usize,
    },
    /// A text is not UTF-8.
    #[error("a name in it is not UTF-8")]
    NotUtf8,
}

/// Most names of a message, and most edges of TF. Kind: choice; a chunk of zeros would be a list of millions that have no bytes.
const MOST_ENTRIES: usize = 10_000;
/// First bytes of a frame of zstd, which a message has that rosbag2 compressed on its own.
const ZSTD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
/// Bytes of the encapsulation, from which alignment is counted.
const ENCAPSULATION: usize = 4;

/// A message that is read value by value.
pub(crate) struct CdrReader<'a> {
    /// The bytes behind the encapsulation.
    body: &'a [u8],
    at: usize,
    is_big_endian: bool,
}

impl<'a> CdrReader<'a> {
    /// A message with its encapsulation.
    pub(crate) fn new(message: &'a [u8]) -> Result<Self, CdrFault> {
        let short = CdrFault::Short { length: message.len() };
        let head: [u8; ENCAPSULATION] = *message.first_chunk().ok_or(short)?;
        if head == ZSTD {
            return Err(CdrFault::Compressed);
        }
        let is_big_endian = match u16::from_be_bytes([head[0], head[1]]) {
            0 => true,
            1 => false,
            other => return Err(CdrFault::Representation(other)),
        };
        Ok(Self { body: &message[ENCAPSULATION..], at: 0, is_big_endian })
    }

    fn rest(&self) -> usize {
        self.body.len() - self.at
    }

    fn bytes(&mut self, count: usize) -> Result<&'a [u8], CdrFault> {
        let short = CdrFault::Short { length: self.body.len() + ENCAPSULATION };
        let found = self.body.get(self.at..self.at.saturating_add(count)).ok_or(short)?;
        self.at += count;
        Ok(found)
    }

    /// Goes to the next multiple of `size`; values are aligned to their own size.
    fn align(&mut self, size: usize) {
        self.at = self.at.next_multiple_of(size).min(self.body.len());
    }

    fn fixed<const N: usize>(&mut self) -> Result<[u8; N], CdrFault> {
        self.align(N);
        let mut value = [0; N];
        value.copy_from_slice(self.bytes(N)?);
        if self.is_big_endian {
            value.reverse();
        }
        Ok(value)
    }

    pub(crate) fn u32(&mut self) -> Result<u32, CdrFault> {
        Ok(u32::from_le_bytes(self.fixed()?))
    }

    pub(crate) fn i32(&mut self) -> Result<i32, CdrFault> {
        Ok(i32::from_le_bytes(self.fixed()?))
    }

    pub(crate) fn f64(&mut self) -> Result<f64, CdrFault> {
        Ok(f64::from_le_bytes(self.fixed()?))
    }

    pub(crate) fn f64s<const N: usize>(&mut self) -> Result<[f64; N], CdrFault> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.f64()?;
        }
        Ok(values)
    }

    /// The length of a list whose entries have at least `least_bytes`.
    fn count(&mut self, least_bytes: usize) -> Result<usize, CdrFault> {
        let claimed = self.u32()?;
        let count = usize::try_from(claimed).unwrap_or(usize::MAX);
        if count.saturating_mul(least_bytes) > self.rest() {
            return Err(CdrFault::Length { claimed, bytes: self.rest() });
        }
        Ok(count)
    }

    /// The length of a list of names or edges, which take more memory than bytes in the message.
    pub(crate) fn entry_count(&mut self, least_bytes: usize) -> Result<usize, CdrFault> {
        let claimed = self.count(least_bytes)?;
        if claimed > MOST_ENTRIES { Err(CdrFault::TooMany { claimed }) } else { Ok(claimed) }
    }

    /// A text; its length counts the 0 at its end, which some writers leave out.
    pub(crate) fn text(&mut self) -> Result<&'a str, CdrFault> {
        let length = self.count(1)?;
        let bytes = self.bytes(length)?;
        let bytes = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        std::str::from_utf8(bytes).map_err(|_| CdrFault::NotUtf8)
    }

    pub(crate) fn f64_list(&mut self) -> Result<Vec<f64>, CdrFault> {
        let count = self.count(size_of::<f64>())?;
        if count == 0 {
            // Only an entry is aligned, and there is none.
            return Ok(Vec::new());
        }
        self.align(size_of::<f64>());
        let bytes = self.bytes(count * size_of::<f64>())?;
        let number = |bytes: &[u8]| {
            let mut value = [0; size_of::<f64>()];
            value.copy_from_slice(bytes);
            if self.is_big_endian { f64::from_be_bytes(value) } else { f64::from_le_bytes(value) }
        };
        Ok(bytes.chunks_exact(size_of::<f64>()).map(number).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_claimed_length_is_an_error_before_it_is_an_allocation() {
        let bomb = [0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 1, 2];
        let read = |message| CdrReader::new(message).unwrap();
        let claimed = CdrFault::Length { claimed: u32::MAX, bytes: 2 };
        assert_eq!(read(&bomb).f64_list().unwrap_err(), claimed);
        assert_eq!(read(&bomb).text().unwrap_err(), claimed);
    }

    #[test]
    fn names_without_a_letter_are_limited() {
        let claimed = MOST_ENTRIES + 1;
        let mut names = vec![0, 1, 0, 0];
        names.extend(u32::try_from(claimed).unwrap().to_le_bytes());
        names.resize(names.len() + 4 * claimed, 0);
        assert_eq!(CdrReader::new(&names).unwrap().entry_count(4), Err(CdrFault::TooMany { claimed }));
    }

    #[test]
    fn both_byte_orders_and_their_alignment() {
        let little = [0, 1, 0, 0, 2, 0, 0, 0, b'a', 0, 9, 9, 7, 0, 0, 0];
        let mut reader = CdrReader::new(&little).unwrap();
        assert_eq!((reader.text().unwrap(), reader.u32().unwrap()), ("a", 7));
        let big = [0, 0, 0, 0, 0, 0, 0, 1, 9, 9, 9, 9, 0x3f, 0xf0, 0, 0, 0, 0, 0, 0];
        assert_eq!(CdrReader::new(&big).unwrap().f64_list().unwrap(), [1.0]);
    }

    #[test]
    fn what_is_no_cdr_is_refused() {
        let fault = |message: &[u8]| CdrReader::new(message).err();
        assert_eq!(fault(&ZSTD), Some(CdrFault::Compressed));
        assert_eq!(fault(&[0, 3, 0, 0]), Some(CdrFault::Representation(3)));
        assert_eq!(fault(&[0]), Some(CdrFault::Short { length: 1 }));
    }
}
