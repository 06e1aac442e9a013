//! Turns a panic into an error. The readers of Arrow and Parquet panic on some corrupt bytes instead of returning an error,
//! and a corrupt file must neither end the program nor fill its error output.

use std::{
    cell::Cell,
    panic::{self, AssertUnwindSafe},
    sync::Once,
};

thread_local! {
    static IS_CAUGHT: Cell<bool> = const { Cell::new(false) };
}

/// The result of `work`; a panic in it becomes an error and prints nothing. Only for readers of other crates.
///
/// # Errors
/// The error of `work`, or "its data are corrupt" after a panic.
pub fn catch_panic<T>(work: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    static INSTALL: Once = Once::new();
    INSTALL.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if !IS_CAUGHT.get() {
                before(panic);
            }
        }));
    });
    // Restored instead of cleared, so that nested calls work; per thread, so that panics of other threads are still printed.
    let before = IS_CAUGHT.replace(true);
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    IS_CAUGHT.set(before);
    result.unwrap_or_else(|_| Err("its data are corrupt".to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error() {
        assert_eq!(catch_panic(|| Ok(1)), Ok(1));
        assert!(catch_panic::<()>(|| panic!("never seen")).is_err());
        assert!(!IS_CAUGHT.get());
    }
}
