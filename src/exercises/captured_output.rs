//! Captured output of an attempt, limited in length.

use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use serde::{Deserialize, Serialize};

/// Maximum captured length [bytes].
const MOST: usize = 1 << 14;

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CapturedOutput {
    pub lines: Vec<String>,
    pub further_lines: usize,
}

/// A writer that keeps the beginning of the output and counts the rest. Clones share the buffer.
#[derive(Clone, Default)]
pub struct CaptureWriter(Arc<Mutex<CapturedText>>);

#[derive(Default)]
struct CapturedText {
    text: Vec<u8>,
    further_lines: usize,
}

impl CaptureWriter {
    /// Output captured so far.
    pub fn captured(&self) -> CapturedOutput {
        let heard = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&heard.text);
        CapturedOutput {
            lines: text.lines().map(str::to_owned).collect(),
            further_lines: heard.further_lines,
        }
    }
}

impl Write for CaptureWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut heard = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (kept, rest) = bytes.split_at(bytes.len().min(MOST - heard.text.len()));
        heard.text.extend(kept);
        heard.further_lines += rest.iter().filter(|byte| **byte == b'\n').count();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_beginning_is_kept_and_the_rest_counted() {
        let ear = CaptureWriter::default();
        let mut writer = ear.clone();
        for _ in 0..MOST {
            writer.write_all(b"1\n").unwrap();
        }
        let heard = ear.captured();
        assert_eq!((heard.lines.len(), heard.further_lines), (MOST / 2, MOST / 2));
        assert!(heard.lines.iter().all(|line| line == "1"));
    }
}
