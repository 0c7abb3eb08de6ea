//! Panics are our mistakes: they are shown as diagnostics that say where, not in Rust's words.

use std::any::Any;
use std::cell::RefCell;
use std::panic;

thread_local! {
    /// Where the last panic of this thread was.
    static PLACE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Lets panics be silent and remember their place; whoever catches one tells of it.
pub fn silence() {
    panic::set_hook(Box::new(|panic| {
        let place = panic.location().map(|place| format!(" ({place})")).unwrap_or_default();
        PLACE.with_borrow_mut(|last| *last = place);
    }));
}

/// What a panic of this thread said, and where it was if panics are [silenced](silence).
pub fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    let text = text.unwrap_or_else(|| "a panic without a message".into());
    format!("{text}{}", PLACE.take())
}
