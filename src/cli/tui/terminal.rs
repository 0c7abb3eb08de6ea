//! The terminal while it is watched: a screen of its own, keys without Enter, and everything as it was afterwards.

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

/// The size where the terminal does not tell [columns, rows].
const USUAL: (u16, u16) = (80, 24);

/// Whether the terminal is held.
static HELD: AtomicBool = AtomicBool::new(false);

/// Whether a person sits at both ends of the program, at a terminal that can draw.
pub fn is_there() -> bool {
    let can_draw = std::env::var_os("TERM").is_none_or(|name| name != "dumb");
    stdin().is_terminal() && stdout().is_terminal() && can_draw
}

/// The terminal while `withy learn watch` draws on it; it is given back when this is dropped.
pub struct RawTerminal {
    colours: Colours,
    drawn: Vec<u8>,
    size: (usize, usize),
}

impl RawTerminal {
    /// Takes the terminal, to draw on it.
    ///
    /// # Errors
    /// When the terminal refuses what is needed.
    pub fn take() -> io::Result<Self> {
        hold()?;
        let style = TerminalStyle::of_environment(|name| std::env::var(name).ok());
        Ok(Self { colours: style.colours, drawn: Vec::new(), size: (0, 0) })
    }

    /// The columns and rows of the terminal now.
    pub fn size(&self) -> (usize, usize) {
        let told = terminal::size().ok().filter(|(columns, rows)| *columns > 0 && *rows > 0);
        let (columns, rows) = told.unwrap_or(USUAL);
        (usize::from(columns), usize::from(rows))
    }

    /// Shows lines on the terminal, all at once; nothing is written where they are there already.
    ///
    /// # Errors
    /// When the terminal cannot be written to.
    pub fn show(&mut self, lines: &[ScreenLine], size: (usize, usize)) -> io::Result<()> {
        let mut drawing = Vec::new();
        queue!(drawing, BeginSynchronizedUpdate)?;
        for (row, line) in (0..).zip(lines) {
            // Each line is written over what was there, so that nothing flickers.
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

    /// The next key, if one comes before so much time has passed or the size has changed.
    ///
    /// # Errors
    /// When the terminal cannot be read.
    pub fn key(&self, patience: Duration) -> io::Result<Option<Key>> {
        if !event::poll(patience)? {
            return Ok(None);
        }
        Ok(match event::read()? {
            Event::Key(event) => key(event),
            _ => None,
        })
    }

    /// Gives the terminal back, stops the process until it is told to go on, and takes the terminal again.
    ///
    /// # Errors
    /// As [`take`](Self::take).
    pub fn rest(&mut self) -> io::Result<()> {
        give_back();
        #[cfg(unix)]
        nix::sys::signal::raise(nix::sys::signal::Signal::SIGTSTP)?;
        self.size = (0, 0);
        hold()
    }
}

impl Drop for RawTerminal {
    fn drop(&mut self) {
        give_back();
    }
}

fn hold() -> io::Result<()> {
    terminal::enable_raw_mode()?;
    HELD.store(true, Ordering::Relaxed);
    execute!(stdout(), EnterAlternateScreen, Hide)
}

/// Gives the terminal back as it was, if it is held; also for code that ends the process without unwinding.
pub fn give_back() {
    if HELD.swap(false, Ordering::Relaxed) {
        // A terminal that is gone needs nothing back.
        let _ = execute!(stdout(), Show, LeaveAlternateScreen);
        let _ = terminal::disable_raw_mode();
    }
}
