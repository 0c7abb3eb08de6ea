//! Type-ahead: keys typed during an evaluation are kept for the next prompt.
//!
//! A terminal in line mode would process keys such as Ctrl-D or Ctrl-R between two prompts, instead of keeping them.
//! The terminal is therefore in raw input mode during the whole session, in which Ctrl-C and Ctrl-Z keep their meaning.

/// Guard that keeps the terminal in raw input mode. Dropping the guard restores the original mode.
pub struct TypedAhead(());

impl TypedAhead {
    /// Switches the terminal to raw input mode. After a failure, the terminal is unchanged.
    pub fn set_mode() -> Self {
        terminal::set_raw_mode();
        Self(())
    }

    pub fn restore_for_program() -> TerminalLease {
        TerminalLease(terminal::restore())
    }
}

/// Guard for the time in which another program uses the terminal. Dropping the guard sets the raw input mode again.
pub struct TerminalLease(bool);

impl Drop for TerminalLease {
    fn drop(&mut self) {
        if self.0 {
            terminal::set_raw_mode();
        }
    }
}

impl Drop for TypedAhead {
    fn drop(&mut self) {
        restore();
    }
}

/// Restores the original mode of the terminal. Code that ends the process without dropping guards must call this function.
pub fn restore() {
    terminal::restore();
}

#[cfg(unix)]
mod terminal {
    use std::io::stdin;
    use std::sync::{Mutex, PoisonError};

    use nix::sys::termios::{
        LocalFlags, SetArg, SpecialCharacterIndices, Termios, tcgetattr, tcsetattr,
    };

    static AS_IT_WAS: Mutex<Option<Termios>> = Mutex::new(None);

    pub fn set_raw_mode() {
        let Ok(original) = tcgetattr(stdin()) else { return };
        let mut held = original.clone();
        // Without echo, keys that are typed ahead appear only once, at the prompt that reads them.
        held.local_flags -= LocalFlags::ICANON | LocalFlags::IEXTEN | LocalFlags::ECHO;
        held.control_chars[SpecialCharacterIndices::VMIN as usize] = 1;
        held.control_chars[SpecialCharacterIndices::VTIME as usize] = 0;
        if tcsetattr(stdin(), SetArg::TCSANOW, &held).is_ok() {
            *AS_IT_WAS.lock().unwrap_or_else(PoisonError::into_inner) = Some(original);
        }
    }

    /// Restores the original mode of the terminal. Returns true if the mode had been changed.
    pub fn restore() -> bool {
        let original = AS_IT_WAS.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(original) = &original {
            // Restoring fails only if the terminal has been closed, so the error is ignored.
            let _ = tcsetattr(stdin(), SetArg::TCSANOW, original);
        }
        original.is_some()
    }
}

#[cfg(not(unix))]
mod terminal {
    //! Systems other than Unix: keys are events, so that no key is lost between prompts.

    pub fn set_raw_mode() {}

    pub fn restore() -> bool {
        false
    }
}
