//! What all fuzz targets share: the readers, opened once for each process.

mod readers;

use std::cell::OnceCell;

pub use readers::{Kind, Readers};

thread_local! {
    static READERS: OnceCell<Readers> = const { OnceCell::new() };
}

/// Gives the bytes to the reader of a kind of file. It may refuse them; it must not panic, hang or fill the memory.
pub fn read_everything(kind: Kind, bytes: &[u8]) {
    READERS.with(|readers| readers.get_or_init(Readers::new).read_everything(kind, bytes));
}
