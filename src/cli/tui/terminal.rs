//! Alternate screen and raw mode of the terminal for `withy learn watch`.

use std::io::{self, IsTerminal, Write, stdin, stdout};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crossterm::cursor::{Hide, MoveTo, Show};
use crossterm::event::{self, Event};
use crossterm::style::Print;
use crossterm::terminal::{
    self, BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen,
};
use crossterm::{execute, queue};

use super::keys::{Key, key};
use super::line::ScreenLine;
use crate::output::{Colours, TerminalStyle};

/// Terminal size [columns, rows] if the terminal does not report it.
const USUAL: (u16, u16) = (80, 24);

/// True while the terminal is in raw mode and must be restored before the process ends.
static HELD: AtomicBool = AtomicBool::new(false);

pub fn is_there() -> bool {
    let can_draw = std::env::var_os("TERM").is_none_or(|name| name != "dumb");
    stdin().is_terminal() && stdout().is_terminal() && can_draw
}

/// Terminal in raw mode. Dropping this value restores the previous mode.
pub struct RawTerminal {
    colours: Colours,
    drawn: Vec<u8>,
    size: (usize, usize),
}

impl RawTerminal {
    pub fn enter() -> io::Result<Self> {
        enter_raw_mode()?;
        let style = TerminalStyle::of_environment(|name| std::env::var(name).ok());
        Ok(Self { colours: style.colours, drawn: Vec::new(), size: (0, 0) })
    }

    pub fn size(&self) -> (usize, usize) {
        let size = terminal::size().ok().filter(|(columns, rows)| *columns > 0 && *rows > 0);
        let (columns, rows) = size.unwrap_or(USUAL);
        (usize::from(columns), usize::from(rows))
    }

    /// Draws all lines in one write, or nothing if the screen has not changed.
    pub fn show(&mut self, lines: &[ScreenLine], size: (usize, usize)) -> io::Result<()> {
        let mut drawing = Vec::new();
        queue!(drawing, BeginSynchronizedUpdate)?;
        for (row, line) in (0..).zip(lines) {
            // Each line is overwritten without being cleared first, to avoid flicker.
            let drawn = line.drawn(self.colours);
            queue!(drawing, MoveTo(0, row), Print(drawn), Clear(ClearType::UntilNewLine))?;
        }
        if lines.len() < size.1 {
            let row = u16::try_from(lines.len()).unwrap_or(u16::MAX);
            queue!(drawing, MoveTo(0, row), Clear(ClearType::FromCursorDown))?;
        }
        queue!(drawing, EndSynchronizedUpdate)?;
        if self.size != size {
            queue!(stdout(), Clear(ClearType::All))?;
        } else if drawing == self.drawn {
            return Ok(());
        }
        self.size = size;
        let mut out = stdout();
        out.write_all(&drawing)?;
        out.flush()?;
        self.drawn = drawing;
        Ok(())
    }

    /// Waits for a key; `None` after `timeout`, or if another event arrives, such as a change of the window size.
    pub fn key(&self, timeout: Duration) -> io::Result<Option<Key>> {
        if !event::poll(timeout)? {
            return Ok(None);
        }
        Ok(match event::read()? {
            Event::Key(event) => key(event),
            _ => None,
        })
    }

    /// Restores the terminal, suspends the process, and switches to raw mode again when the process continues.
    pub fn suspend(&mut self) -> io::Result<()> {
        restore();
        #[cfg(unix)]
        nix::sys::signal::raise(nix::sys::signal::Signal::SIGTSTP)?;
        self.size = (0, 0);
        enter_raw_mode()
    }
}

impl Drop for RawTerminal {
    fn drop(&mut self) {
        restore();
    }
}

fn enter_raw_mode() -> io::Result<()> {
    terminal::enable_raw_mode()?;
    HELD.store(true, Ordering::Relaxed);
    execute!(stdout(), EnterAlternateScreen, Hide)
}

/// Restores the terminal if it is in raw mode. Must be called before the process ends without unwinding.
pub fn restore() {
    if HELD.swap(false, Ordering::Relaxed) {
        // Restoring fails only for a closed terminal, so the error is ignored.
        let _ = execute!(stdout(), Show, LeaveAlternateScreen);
        let _ = terminal::disable_raw_mode();
    }
}
