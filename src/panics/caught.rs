//! Catches panics, which are internal errors, and returns their message and location.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};

thread_local! {
    static PLACE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Suppresses Rust's output of panics. Code that [catches](caught) a panic must report it.
pub fn silence() {
    panic::set_hook(Box::new(|panic| {
        let place = panic.location().map(|place| format!(" ({place})")).unwrap_or_default();
        PLACE.with_borrow_mut(|last| *last = place);
    }));
}

/// Calls `work` and catches its panics.
///
/// After a panic, the caller must discard data that `work` modifies, because they may be inconsistent.
///
/// # Errors
/// Returns the message of the panic, with its location if panics are [silenced](silence).
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    panic::catch_unwind(AssertUnwindSafe(work)).map_err(|panic| message(&*panic))
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    let text = text.unwrap_or("a panic without a message");
    format!("{text}{}", PLACE.take())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn caught_panic_returns_its_message() {
        assert_eq!(caught(|| 3), Ok(3));
        let lost = 2;
        assert_eq!(caught(|| panic!("lost {lost}")), Err::<(), _>("lost 2".to_owned()));
        assert_eq!(caught(|| panic!("lost")), Err::<(), _>("lost".to_owned()));
    }
}
