//! Shared output buffer that can be read while a script or session still writes to it.

use std::io::{self, Write};
use std::sync::{Arc, Mutex};

#[derive(Clone, Default)]
pub struct Notepad(Arc<Mutex<Vec<u8>>>);

impl Notepad {
    /// Returns the text that was written since the last call.
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
