//! Compares the lengths stated inside a message with its size, before the Arrow reader allocates that much
//! memory. Checks nothing but lengths.

use re_chunk::external::arrow::ipc::root_as_message;
use re_log_encoding::{Decodable, Encodable, MessageHeader, MessageKind, external::lz4_flex};

/// The largest compression ratio of LZ4.
const MAX_COMPRESSION_RATIO: usize = 255;
/// Field numbers of rerun's `ArrowMsg`, and its number for LZ4.
const COMPRESSION: u64 = 2;
const UNCOMPRESSED_LENGTH: u64 = 3;
const PAYLOAD: u64 = 5;
const LZ4: u64 = 2;
/// The bytes before the length of an Arrow message.
const CONTINUATION: [u8; 4] = [0xff; 4];

const WRONG_LENGTHS: &str = "its lengths do not match its data";

/// Refuses a message that states a length beyond its data.
pub(super) fn check(message: &dyn Encodable) -> Result<(), String> {
    let mut bytes = Vec::new();
    message.to_rrd_bytes(&mut bytes).map_err(|error| error.to_string())?;
    let (header, body) =
        bytes.split_at_checked(MessageHeader::ENCODED_SIZE_BYTES).ok_or("its header is missing")?;
    let header = MessageHeader::from_rrd_bytes(header).map_err(|error| error.to_string())?;
    if header.kind != MessageKind::ArrowMsg {
        return Ok(());
    }
    let ArrowMessage { is_compressed, uncompressed_length, payload } =
        ArrowMessage::read(body).ok_or(WRONG_LENGTHS)?;
    if !is_compressed {
        return check_arrow(payload).ok_or_else(|| WRONG_LENGTHS.to_owned());
    }
    // Checked before decompression, which allocates the stated length at once.
    if uncompressed_length > payload.len().saturating_mul(MAX_COMPRESSION_RATIO) {
        return Err("its stated size is more than its compressed data can hold".to_owned());
    }
    let uncompressed =
        lz4_flex::block::decompress(payload, uncompressed_length).map_err(|error| error.to_string())?;
    check_arrow(&uncompressed).ok_or_else(|| WRONG_LENGTHS.to_owned())
}

/// The fields of rerun's message that state lengths, and the payload.
#[derive(Debug, PartialEq, Eq)]
struct ArrowMessage<'a> {
    is_compressed: bool,
    uncompressed_length: usize,
    payload: &'a [u8],
}

impl<'a> ArrowMessage<'a> {
    fn read(mut bytes: &'a [u8]) -> Option<Self> {
        let mut fields = Self { is_compressed: false, uncompressed_length: 0, payload: &[] };
        while !bytes.is_empty() {
            let key = varint(&mut bytes)?;
            // Protobuf: the low three bits are the type of encoding, the others the number of the field.
            let (field, wire_type) = (key >> 3, key & 7);
            match wire_type {
                0 => {
                    let value = varint(&mut bytes)?;
                    match field {
                        COMPRESSION => fields.is_compressed = value == LZ4,
                        UNCOMPRESSED_LENGTH => fields.uncompressed_length = usize::try_from(value).ok()?,
                        _ => {}
                    }
                }
                2 => {
                    let length = usize::try_from(varint(&mut bytes)?).ok()?;
                    let value = take(&mut bytes, length)?;
                    if field == PAYLOAD {
                        fields.payload = value;
                    }
                }
                1 => _ = take(&mut bytes, 8)?,
                5 => _ = take(&mut bytes, 4)?,
                _ => return None,
            }
        }
        Some(fields)
    }
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

/// A number of variable length, seven bits in a byte, the lowest first.
fn varint(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    // At most ten bytes: a number that does not end is refused instead of read on.
    for shift in (0..64).step_by(7) {
        let byte = take(bytes, 1)?[0];
        value |= u64::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            return Some(value);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_found_among_others() {
        // Field 1 as bytes, 2 = LZ4, 3 = 300, 5 as bytes, 7 = true.
        let bytes = [0x0a, 2, 9, 9, 0x10, 2, 0x18, 0xac, 0x02, 0x2a, 3, 1, 2, 3, 0x38, 1];
        let found = ArrowMessage::read(&bytes).unwrap();
        assert_eq!(
            found,
            ArrowMessage { is_compressed: true, uncompressed_length: 300, payload: &[1, 2, 3] }
        );
        assert_eq!(ArrowMessage::read(&bytes[..10]), None, "a field is cut off");
        assert_eq!(ArrowMessage::read(&[0xff; 12]), None, "a number never ends");
    }

    #[test]
    fn an_arrow_message_longer_than_the_rest_is_refused() {
        assert_eq!(check_arrow(&[]), Some(()));
        assert_eq!(check_arrow(&[0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0]), Some(()));
        assert_eq!(check_arrow(&[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]), None);
        assert_eq!(check_arrow(&[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff]), None);
    }
}
