//! Type-ahead: keys typed during an evaluation are kept for the next prompt.
//!
//! The terminal is in raw input mode during a session, because in line mode it would process keys such as Ctrl-D or Ctrl-R itself.

/// Guard of the raw input mode. Dropping the guard restores the original mode of the terminal.
pub struct TypedAhead(());

impl TypedAhead {
    pub fn set_mode() -> Self {
        terminal::set_raw_mode();
        Self(())
    }

    pub fn restore_for_program() -> TerminalLease {
        TerminalLease(terminal::restore())
    }
}

/// Guard while another program uses the terminal. Dropping the guard sets the raw input mode again.
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

/// Restores the original mode of the terminal. Must be called before the process ends without dropping the guard.
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
        // Without echo, keys typed ahead appear only at the prompt that reads them.
        held.local_flags -= LocalFlags::ICANON | LocalFlags::IEXTEN | LocalFlags::ECHO;
        held.control_chars[SpecialCharacterIndices::VMIN as usize] = 1;
        held.control_chars[SpecialCharacterIndices::VTIME as usize] = 0;
        if tcsetattr(stdin(), SetArg::TCSANOW, &held).is_ok() {
            *AS_IT_WAS.lock().unwrap_or_else(PoisonError::into_inner) = Some(original);
        }
    }

    pub fn restore() -> bool {
        let original = AS_IT_WAS.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(original) = &original {
            // Restoring fails only for a closed terminal, so the error is ignored.
            let _ = tcsetattr(stdin(), SetArg::TCSANOW, original);
        }
        original.is_some()
    }
}

#[cfg(not(unix))]
mod terminal {
    //! On systems other than Unix, the terminal delivers keys as events, which are not lost between prompts. Therefore the mode is not changed.

    pub fn set_raw_mode() {}

    pub fn restore() -> bool {
        false
    }
}
