//! Keeps a panic inside. The Arrow reader panics on some spoilt bytes instead of refusing them,
//! and a file that somebody else spoilt must not end the program or fill its error output.

use std::{
    cell::Cell,
    panic::{self, AssertUnwindSafe},
    sync::Once,
};

thread_local! {
    static IS_SHIELDED: Cell<bool> = const { Cell::new(false) };
}

/// Does the work; a panic in it is an error, and nothing is printed.
pub(super) fn shielded<T>(work: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    static INSTALL: Once = Once::new();
    INSTALL.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if !IS_SHIELDED.get() {
                before(panic);
            }
        }));
    });
    let before = IS_SHIELDED.replace(true);
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    IS_SHIELDED.set(before);
    result.unwrap_or_else(|_| Err("its bytes make no sense".to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error() {
        assert_eq!(shielded(|| Ok(1)), Ok(1));
        assert!(shielded::<()>(|| panic!("never seen")).is_err());
        assert!(!IS_SHIELDED.get());
    }
}
