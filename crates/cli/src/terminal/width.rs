//! The width of the terminal.

use std::{
    io::{self, IsTerminal},
    sync::OnceLock,
};

use congruent::text::layout::NARROWEST;

/// The columns of the terminal that shows the answer; `None` in a pipe.
pub(crate) fn columns() -> Option<usize> {
    static COLUMNS: OnceLock<Option<usize>> = OnceLock::new();
    *COLUMNS.get_or_init(|| {
        let is_shown = io::stdout().is_terminal();
        let (width, _) = is_shown.then(|| terminal_size::terminal_size_of(io::stdout()))??;
        Some(usize::from(width.0).max(NARROWEST))
    })
}
