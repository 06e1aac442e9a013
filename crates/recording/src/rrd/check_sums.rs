//! Check sums inside a file: whatever becomes of its bytes shows without anything else at hand.
//!
//! The last field of each message, the index at the end included, is a check sum over all bytes since the beginning of
//! the check sum before, or of the file. So every byte counts, those of headers and of check sums as well, and a message
//! that is missing, repeated or in another place breaks the chain. rerun skips fields that it does not know.

use sha2::{Digest, Sha256};

/// Length of a check sum: the first half of a SHA-256.
pub(crate) const SUM: usize = 16;
/// Bytes before a check sum: the key of field 13000000 in protobuf's encoding, and the length of the check sum.
const FIELD: [u8; 5] = [0x82, 0xd4, 0xcb, 0x31, 0x10];
/// Length of the whole field.
pub(crate) const FIELD_AND_SUM: usize = FIELD.len() + SUM;

/// The check sum over all that was added since the one before.
#[derive(Debug, Clone, Default)]
pub(crate) struct CheckSums(Sha256);

impl CheckSums {
    /// Counts bytes that are written.
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// Ends a message with its check sum. Its header must state the length with it.
    pub(crate) fn close(&mut self, message: &mut Vec<u8>) {
        message.extend(FIELD);
        self.0.update(&*message);
        let sum = self.0.finalize_reset();
        // The sum is counted by the next one: this is the chain that a missing message breaks.
        message.extend(&sum[..SUM]);
        self.0.update(&sum[..SUM]);
    }
}

/// Whether a message, or its end, has a check sum.
pub(crate) fn has_sum(message: &[u8]) -> bool {
    message.len().checked_sub(FIELD_AND_SUM).is_some_and(|at| message[at..].starts_with(&FIELD))
}

/// Whether the check sum of a message is that of its bytes with those before it: the check sum before, or the file's
/// header.
pub(crate) fn is_intact(before: &[u8], message: &[u8]) -> bool {
    let Some(at) = message.len().checked_sub(SUM) else { return false };
    let (bytes, sum) = message.split_at(at);
    has_sum(message) && Sha256::new().chain_update(before).chain_update(bytes).finalize()[..SUM] == *sum
}
