//! Reading of single keys, without waiting for the end of a line.

use std::io;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pressed {
    Byte(u8),
    Interrupt,
    End,
}

pub trait Keyboard {
    fn read(&mut self, was_interrupted: &dyn Fn() -> bool) -> io::Result<Pressed>;

    fn rest_of_sequence(&mut self) -> io::Result<Vec<u8>>;
}

pub use of_system::{KeyboardTerminal, has_pending_keys};

#[cfg(unix)]
mod of_system {
    use std::io::{self, stdin};
    use std::os::fd::AsFd;

    use nix::errno::Errno;
    use nix::poll::{PollFd, PollFlags, PollTimeout, poll};
    use nix::unistd::read;

    use super::{Keyboard, Pressed};

    /// Interval at which Ctrl-C is checked [ms].
    const POLLING_INTERVAL: u8 = 50;
    /// Waiting time for the rest of an escape sequence [ms].
    const ESCAPE_TIMEOUT: u8 = 30;

    pub struct KeyboardTerminal(());

    impl KeyboardTerminal {
        pub fn open() -> Option<Self> {
            Some(Self(()))
        }
    }

    pub fn has_pending_keys() -> bool {
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

    /// Reads a byte without the buffer of the standard library, which would keep keys that belong to the prompt.
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
                if has_keys(POLLING_INTERVAL)? {
                    return next();
                }
            }
        }

        fn rest_of_sequence(&mut self) -> io::Result<Vec<u8>> {
            let mut rest = Vec::new();
            while has_keys(ESCAPE_TIMEOUT)? {
                match next()? {
                    Pressed::Byte(byte) => rest.push(byte),
                    _ => break,
                }
                // A letter or a tilde ends an escape sequence, except as the first byte of the sequence.
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
    //! Single keys cannot be read on systems other than Unix; texts are printed without pages unless a pager program is set.

    use std::io;

    use super::{Keyboard, Pressed};

    pub struct KeyboardTerminal(());

    impl KeyboardTerminal {
        /// Returns `None`, because single keys can be read only on Unix.
        pub fn open() -> Option<Self> {
            None
        }
    }

    /// Returns false, because waiting keys can be detected only on Unix.
    pub fn has_pending_keys() -> bool {
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
