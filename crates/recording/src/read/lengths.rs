//! Compares the lengths stated inside a message with its size, before the Arrow reader allocates that much
//! memory. Checks nothing but lengths.

use re_chunk::external::arrow::ipc::root_as_message;
use re_log_encoding::external::lz4_flex;
use re_protos::{
    common::v1alpha1::Compression,
    log_msg::v1alpha1::{ArrowMsg, log_msg::Msg},
};

/// The largest compression ratio of LZ4.
const MAX_COMPRESSION_RATIO: u64 = 255;
/// The bytes before the length of an Arrow message.
const CONTINUATION: [u8; 4] = [0xff; 4];

const WRONG_LENGTHS: &str = "its lengths do not match its data";

/// Refuses a message that states a length beyond its data.
pub(super) fn check(message: &Msg) -> Result<(), String> {
    let Msg::ArrowMsg(message) = message else { return Ok(()) };
    let ArrowMsg { payload, uncompressed_size, .. } = message;
    if message.compression() != Compression::Lz4 {
        return check_arrow(payload).ok_or_else(|| WRONG_LENGTHS.to_owned());
    }
    // Checked before decompression, which allocates the stated length at once.
    if *uncompressed_size > (payload.len() as u64).saturating_mul(MAX_COMPRESSION_RATIO) {
        return Err("its stated size is more than its compressed data can hold".to_owned());
    }
    let uncompressed_size = usize::try_from(*uncompressed_size).map_err(|error| error.to_string())?;
    let uncompressed =
        lz4_flex::block::decompress(payload, uncompressed_size).map_err(|error| error.to_string())?;
    check_arrow(&uncompressed).ok_or_else(|| WRONG_LENGTHS.to_owned())
}

/// Reads the lengths of the messages of an Arrow stream; `None` if one exceeds the remaining bytes.
fn check_arrow(mut bytes: &[u8]) -> Option<()> {
    while let Some(mut length) = take(&mut bytes, 4) {
        // Arrow IPC since 0.15: the marker, then the length of the metadata; older streams begin with the length.
        // Length 0 ends the stream.
        if length == CONTINUATION {
            length = take(&mut bytes, 4)?;
        }
        let length = i32::from_le_bytes(length.try_into().ok()?);
        if length == 0 {
            break;
        }
        let message = take(&mut bytes, usize::try_from(length).ok()?)?;
        let message = root_as_message(message).ok()?;
        take(&mut bytes, usize::try_from(message.bodyLength()).ok()?)?;
    }
    Some(())
}

/// The next `length` bytes; `None` if fewer remain.
fn take<'a>(bytes: &mut &'a [u8], length: usize) -> Option<&'a [u8]> {
    let (taken, rest) = bytes.split_at_checked(length)?;
    *bytes = rest;
    Some(taken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_that_no_compression_reaches_is_refused() {
        let compression = Compression::Lz4.into();
        let message = |uncompressed_size| {
            Msg::ArrowMsg(ArrowMsg { compression, uncompressed_size, ..ArrowMsg::default() })
        };
        assert!(check(&message(u64::MAX)).unwrap_err().contains("stated size"));
    }

    #[test]
    fn an_arrow_message_longer_than_the_rest_is_refused() {
        assert_eq!(check_arrow(&[]), Some(()));
        assert_eq!(check_arrow(&[0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0]), Some(()));
        assert_eq!(check_arrow(&[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]), None);
        assert_eq!(check_arrow(&[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff]), None);
    }
}
