//! Keys typed while an input is evaluated wait for the next prompt, every one of them.
//!
//! Between two prompts a terminal assembles lines itself, and acts on some keys: an early Ctrl-D or Ctrl-R would be gone. So it
//! is told for the whole session to hand keys on as they are. Ctrl-C and Ctrl-Z keep their meaning.

/// Holds the terminal, so that keys typed ahead are kept, as long as it lives, and then gives it back as it was.
pub struct TypedAhead(());

impl TypedAhead {
    /// Holds the terminal that is typed at. One that cannot be held is left as it is.
    pub fn keep() -> Self {
        terminal::take();
        Self(())
    }

    /// Gives the terminal to another program as it was, for as long as the result lives, if it is held at all.
    pub fn lend() -> TerminalLease {
        TerminalLease(terminal::give_back())
    }
}

/// A guard that lasts while another program has the terminal.
pub struct TerminalLease(bool);

impl Drop for TerminalLease {
    fn drop(&mut self) {
        if self.0 {
            terminal::take();
        }
    }
}

impl Drop for TypedAhead {
    fn drop(&mut self) {
        give_back();
    }
}

/// Gives the terminal back as it was; for code that ends the process without unwinding.
pub fn give_back() {
    terminal::give_back();
}

#[cfg(unix)]
mod terminal {
    use std::io::stdin;
    use std::sync::{Mutex, PoisonError};

    use nix::sys::termios::{
        LocalFlags, SetArg, SpecialCharacterIndices, Termios, tcgetattr, tcsetattr,
    };

    static AS_IT_WAS: Mutex<Option<Termios>> = Mutex::new(None);

    pub fn take() {
        let Ok(original) = tcgetattr(stdin()) else { return };
        let mut held = original.clone();
        // Without echo: keys that wait are shown once, at the prompt that reads them.
        held.local_flags -= LocalFlags::ICANON | LocalFlags::IEXTEN | LocalFlags::ECHO;
        held.control_chars[SpecialCharacterIndices::VMIN as usize] = 1;
        held.control_chars[SpecialCharacterIndices::VTIME as usize] = 0;
        if tcsetattr(stdin(), SetArg::TCSANOW, &held).is_ok() {
            *AS_IT_WAS.lock().unwrap_or_else(PoisonError::into_inner) = Some(original);
        }
    }

    /// Gives the terminal back as it was; whether it was held.
    pub fn give_back() -> bool {
        let original = AS_IT_WAS.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(original) = &original {
            // A terminal that is gone needs nothing back.
            let _ = tcsetattr(stdin(), SetArg::TCSANOW, original);
        }
        original.is_some()
    }
}

#[cfg(not(unix))]
mod terminal {
    //! Keys are events there, and none is lost.

    pub fn take() {}

    pub fn give_back() -> bool {
        false
    }
}
