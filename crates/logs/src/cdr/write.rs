//! Messages in CDR as they are written: little endian, as ROS 2 does; tests write both orders.

/// The order of the bytes of a number.
#[cfg(test)]
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum ByteOrder {
    Little,
    Big,
}

/// A message while it is written, field by field.
pub(crate) struct CdrText {
    pub(crate) bytes: Vec<u8>,
    is_big_endian: bool,
}

/// Bytes before the message: two of them say its encoding. Fields are aligned from behind them on.
const HEAD: usize = 4;

impl Default for CdrText {
    fn default() -> Self {
        Self { bytes: vec![0, 1, 0, 0], is_big_endian: false }
    }
}

impl CdrText {
    #[cfg(test)]
    pub(crate) fn new(order: ByteOrder) -> Self {
        let is_big_endian = order == ByteOrder::Big;
        Self { bytes: vec![0, u8::from(!is_big_endian), 0, 0], is_big_endian }
    }

    /// Begins the next message in the place of this one.
    pub(crate) fn begin(&mut self) {
        self.bytes.truncate(HEAD);
    }

    fn fixed<const N: usize>(&mut self, mut little: [u8; N]) {
        while !(self.bytes.len() - HEAD).is_multiple_of(N) {
            self.bytes.push(0);
        }
        if self.is_big_endian {
            little.reverse();
        }
        self.bytes.extend(little);
    }

    pub(crate) fn byte(&mut self, value: u8) {
        self.fixed([value]);
    }

    pub(crate) fn u32(&mut self, value: u32) {
        self.fixed(value.to_le_bytes());
    }

    pub(crate) fn f64(&mut self, value: f64) {
        self.fixed(value.to_le_bytes());
    }

    /// How many elements follow. No message that fits into memory has more than the largest count.
    pub(crate) fn count(&mut self, elements: usize) {
        self.u32(u32::try_from(elements).unwrap_or(u32::MAX));
    }

    pub(crate) fn text(&mut self, text: &str) {
        self.count(text.len() + 1);
        self.bytes.extend(text.as_bytes());
        self.bytes.push(0);
    }

    pub(crate) fn f64_list(&mut self, values: &[f64]) {
        self.count(values.len());
        for value in values {
            self.f64(*value);
        }
    }

    /// A `std_msgs/Header`.
    pub(crate) fn header(&mut self, stamp_ns: i64, frame: &str) {
        self.u32(u32::try_from(stamp_ns / 1_000_000_000).unwrap_or_default());
        self.u32(u32::try_from(stamp_ns % 1_000_000_000).unwrap_or_default());
        self.text(frame);
    }
}

/// The beginning of a joint state, up to its names.
pub(crate) fn joint_state_text<'a>(
    text: &mut CdrText,
    stamp_ns: i64,
    names: impl ExactSizeIterator<Item = &'a str>,
) {
    text.header(stamp_ns, "");
    text.count(names.len());
    for name in names {
        text.text(name);
    }
}

/// A message of TF with one edge.
#[cfg(test)]
pub(crate) fn transform_text(stamp_ns: i64, frame: &str, child: &str) -> CdrText {
    let mut text = CdrText::new(ByteOrder::Little);
    text.u32(1);
    text.header(stamp_ns, frame);
    text.text(child);
    for at in 0..7 {
        text.f64(f64::from(at));
    }
    text
}
