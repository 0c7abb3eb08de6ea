//! Something to write on, whose writing can be read while the other hand still holds it.

use std::io::{self, Write};
use std::sync::{Arc, Mutex};

/// What a script or a session prints, or tells the user.
#[derive(Clone, Default)]
pub struct Notepad(Arc<Mutex<Vec<u8>>>);

impl Notepad {
    /// All that was written since it was last taken.
    pub fn take(&self) -> String {
        let written = std::mem::take(&mut *self.0.lock().unwrap());
        String::from_utf8_lossy(&written).into_owned()
    }
}

impl Write for Notepad {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
