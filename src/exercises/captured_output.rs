//! Captures the output of an attempt up to a maximum length.

use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use serde::{Deserialize, Serialize};

/// Maximum length of the captured output [bytes].
const MOST: usize = 1 << 14;

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CapturedOutput {
    pub lines: Vec<String>,
    pub further_lines: usize,
}

#[derive(Clone, Default)]
pub struct CaptureWriter(Arc<Mutex<CapturedText>>);

#[derive(Default)]
struct CapturedText {
    text: Vec<u8>,
    further_lines: usize,
}

impl CaptureWriter {
    pub fn captured(&self) -> CapturedOutput {
        let captured = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&captured.text);
        CapturedOutput {
            lines: text.lines().map(str::to_owned).collect(),
            further_lines: captured.further_lines,
        }
    }
}

impl Write for CaptureWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut captured = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (kept, rest) = bytes.split_at(bytes.len().min(MOST - captured.text.len()));
        captured.text.extend(kept);
        captured.further_lines += rest.iter().filter(|byte| **byte == b'\n').count();
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
    fn captured_output_keeps_the_first_lines_and_counts_the_rest() {
        let writer = CaptureWriter::default();
        let mut writer = writer.clone();
        for _ in 0..MOST {
            writer.write_all(b"1\n").unwrap();
        }
        let captured = writer.captured();
        assert_eq!((captured.lines.len(), captured.further_lines), (MOST / 2, MOST / 2));
        assert!(captured.lines.iter().all(|line| line == "1"));
    }
}
