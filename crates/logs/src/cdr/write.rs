//! Writes messages in CDR, for tests.

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum ByteOrder {
    Little,
    Big,
}

pub(crate) struct CdrText {
    pub(crate) bytes: Vec<u8>,
    order: ByteOrder,
}

impl CdrText {
    pub(crate) fn new(order: ByteOrder) -> Self {
        Self { bytes: vec![0, u8::from(order == ByteOrder::Little), 0, 0], order }
    }

    fn fixed<const N: usize>(&mut self, mut little: [u8; N]) {
        while !(self.bytes.len() - 4).is_multiple_of(N) {
            self.bytes.push(0);
        }
        if self.order == ByteOrder::Big {
            little.reverse();
        }
        self.bytes.extend(little);
    }

    pub(crate) fn u32(&mut self, value: u32) {
        self.fixed(value.to_le_bytes());
    }

    pub(crate) fn f64(&mut self, value: f64) {
        self.fixed(value.to_le_bytes());
    }

    pub(crate) fn text(&mut self, text: &str) {
        self.u32(u32::try_from(text.len() + 1).unwrap());
        self.bytes.extend(text.as_bytes());
        self.bytes.push(0);
    }

    pub(crate) fn f64_list(&mut self, values: &[f64]) {
        self.u32(u32::try_from(values.len()).unwrap());
        for value in values {
            self.f64(*value);
        }
    }

    pub(crate) fn header(&mut self, stamp_ns: i64, frame: &str) {
        self.u32(u32::try_from(stamp_ns / 1_000_000_000).unwrap());
        self.u32(u32::try_from(stamp_ns % 1_000_000_000).unwrap());
        self.text(frame);
    }
}

/// The beginning of a joint state, up to its names.
pub(crate) fn joint_state_text(text: &mut CdrText, stamp_ns: i64, names: &[&str]) {
    text.header(stamp_ns, "");
    text.u32(u32::try_from(names.len()).unwrap());
    for name in names {
        text.text(name);
    }
}

/// A message of TF with one edge.
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
