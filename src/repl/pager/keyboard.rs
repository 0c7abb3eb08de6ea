//! Single keys, without waiting for the end of a line.

use std::io;

/// What was pressed on the keyboard of a pager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pressed {
    /// A key was pressed: the byte that it sends, or a part of it.
    Byte(u8),
    /// Ctrl-C was pressed.
    Interrupt,
    /// Nothing is pressed any more: the keyboard's input has ended.
    End,
}

/// A keyboard: where the keys of a pager come from.
pub trait Keyboard {
    /// Waits for the next key of the keyboard.
    ///
    /// # Errors
    /// When the terminal fails.
    fn read(&mut self, was_interrupted: &dyn Fn() -> bool) -> io::Result<Pressed>;

    /// The bytes that a key has sent after an escape character, which may be none.
    ///
    /// # Errors
    /// When the terminal fails.
    fn rest_of_sequence(&mut self) -> io::Result<Vec<u8>>;
}

pub use of_system::{KeyboardTerminal, keys_wait};

#[cfg(unix)]
mod of_system {
    use std::io::{self, stdin};
    use std::os::fd::AsFd;

    use nix::errno::Errno;
    use nix::poll::{PollFd, PollFlags, PollTimeout, poll};
    use nix::unistd::read;

    use super::{Keyboard, Pressed};

    /// So often it is looked whether Ctrl-C was pressed [ms].
    const WATCHFUL: u8 = 50;
    /// So soon the rest of a sequence comes [ms].
    const SOON: u8 = 30;

    /// The terminal that is typed at. Between two prompts it hands keys on as they are.
    pub struct KeyboardTerminal(());

    impl KeyboardTerminal {
        /// The terminal that is typed at, if there is one.
        pub fn open() -> Option<Self> {
            Some(Self(()))
        }
    }

    /// Whether keys wait at the terminal that were typed before.
    pub fn keys_wait() -> bool {
        has_keys(0).unwrap_or(false)
    }

    fn has_keys(milliseconds: u8) -> io::Result<bool> {
        let input = stdin();
        let mut asked = [PollFd::new(input.as_fd(), PollFlags::POLLIN)];
        match poll(&mut asked, PollTimeout::from(milliseconds)) {
            Ok(count) => Ok(count > 0),
            Err(Errno::EINTR) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }

    /// Past the buffer of the standard library, which would keep keys from the prompt.
    fn next() -> io::Result<Pressed> {
        let mut byte = [0];
        match read(stdin(), &mut byte) {
            Ok(0) => Ok(Pressed::End),
            Ok(_) => Ok(Pressed::Byte(byte[0])),
            Err(error) => Err(error.into()),
        }
    }

    impl Keyboard for KeyboardTerminal {
        fn read(&mut self, was_interrupted: &dyn Fn() -> bool) -> io::Result<Pressed> {
            loop {
                if was_interrupted() {
                    return Ok(Pressed::Interrupt);
                }
                if has_keys(WATCHFUL)? {
                    return next();
                }
            }
        }

        fn rest_of_sequence(&mut self) -> io::Result<Vec<u8>> {
            let mut rest = Vec::new();
            while has_keys(SOON)? {
                match next()? {
                    Pressed::Byte(byte) => rest.push(byte),
                    _ => break,
                }
                // A letter or a tilde ends it; the first one only begins it.
                let is_end = rest.len() > 1
                    && rest.last().is_some_and(|last| last.is_ascii_alphabetic() || *last == b'~');
                if is_end {
                    break;
                }
            }
            Ok(rest)
        }
    }
}

#[cfg(not(unix))]
mod of_system {
    //! No single keys there: texts are printed as they are, unless there is a program for them.

    use std::io;

    use super::{Keyboard, Pressed};

    /// The terminal that is typed at, on a system where none is known.
    pub struct KeyboardTerminal(());

    impl KeyboardTerminal {
        /// No terminal: this system has none that is known.
        pub fn open() -> Option<Self> {
            None
        }
    }

    /// Whether keys wait at the terminal: not that anybody knew on this system.
    pub fn keys_wait() -> bool {
        false
    }

    impl Keyboard for KeyboardTerminal {
        fn read(&mut self, _: &dyn Fn() -> bool) -> io::Result<Pressed> {
            Ok(Pressed::End)
        }

        fn rest_of_sequence(&mut self) -> io::Result<Vec<u8>> {
            Ok(Vec::new())
        }
    }
}
