//! A panic is a mistake of withy: who catches it tells of it in its own words and says where it was, not in Rust's words.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};

thread_local! {
    /// Where the last panic of this thread was.
    static PLACE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Lets panics be silent and remember their place; whoever [catches](caught) one tells of it.
pub fn silence() {
    panic::set_hook(Box::new(|panic| {
        let place = panic.location().map(|place| format!(" ({place})")).unwrap_or_default();
        PLACE.with_borrow_mut(|last| *last = place);
    }));
}

/// Does some work and catches its panic.
///
/// What the work was changing is as the panic left it: the caller lets go of it, or knows that it may be used.
///
/// # Errors
/// What the panic said, and where it was if panics are [silenced](silence).
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
    fn a_panic_is_caught_with_its_words() {
        assert_eq!(caught(|| 3), Ok(3));
        let lost = 2;
        assert_eq!(caught(|| panic!("lost {lost}")), Err::<(), _>("lost 2".to_owned()));
        assert_eq!(caught(|| panic!("lost")), Err::<(), _>("lost".to_owned()));
    }
}
