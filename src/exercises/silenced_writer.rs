//! Writer that can be silenced, so that the attempt cannot print while its judge runs.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[derive(Clone, Default)]
pub struct SilenceSwitch(Arc<AtomicBool>);

impl SilenceSwitch {
    pub fn begin(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub fn wrap(&self, writer: Box<dyn Write + Send>) -> Box<dyn Write + Send> {
        Box::new(SilencedWriter { silence: self.clone(), writer })
    }
}

struct SilencedWriter {
    silence: SilenceSwitch,
    writer: Box<dyn Write + Send>,
}

impl Write for SilencedWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.silence.0.load(Ordering::Relaxed) {
            true => Ok(bytes.len()),
            false => self.writer.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[derive(Clone, Default)]
    struct SilenceState(Arc<Mutex<Vec<u8>>>);

    impl Write for SilenceState {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0.lock().unwrap().extend(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn silenced_writer_discards_output() {
        let (written, silence) = (SilenceState::default(), SilenceSwitch::default());
        let mut writer = silence.wrap(Box::new(written.clone()));
        writer.write_all(b"before").unwrap();
        silence.begin();
        writer.write_all(b"after").unwrap();
        assert_eq!(*written.0.lock().unwrap(), b"before");
    }
}
