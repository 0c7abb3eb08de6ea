//! Translates terminal events to the keys that the screen uses.

use crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    Letter(char),
    Up,
    Down,
    PageUp,
    PageDown,
    Home,
    End,
    Enter,
    Escape,
    Interrupt,
    Suspend,
    Other,
}

/// Returns the key of a terminal event; `None` if the event is the release of a key.
pub fn key(event: KeyEvent) -> Option<Key> {
    if event.kind == KeyEventKind::Release {
        return None;
    }
    let is_control = event.modifiers.contains(KeyModifiers::CONTROL);
    Some(match event.code {
        KeyCode::Char('c' | 'd') if is_control => Key::Interrupt,
        KeyCode::Char('z') if is_control => Key::Suspend,
        KeyCode::Char(_) if is_control => Key::Other,
        KeyCode::Char(letter) => Key::Letter(letter.to_ascii_lowercase()),
        KeyCode::Up => Key::Up,
        KeyCode::Down => Key::Down,
        KeyCode::PageUp => Key::PageUp,
        KeyCode::PageDown => Key::PageDown,
        KeyCode::Home => Key::Home,
        KeyCode::End => Key::End,
        KeyCode::Enter => Key::Enter,
        KeyCode::Esc => Key::Escape,
        _ => Key::Other,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_c_interrupts_and_letter_keys_ignore_case() {
        let typed = |code, modifiers| key(KeyEvent::new(code, modifiers));
        assert_eq!(typed(KeyCode::Char('c'), KeyModifiers::CONTROL), Some(Key::Interrupt));
        assert_eq!(typed(KeyCode::Char('h'), KeyModifiers::CONTROL), Some(Key::Other));
        assert_eq!(typed(KeyCode::Char('H'), KeyModifiers::SHIFT), Some(Key::Letter('h')));
        let released = KeyEventKind::Release;
        let released = KeyEvent { kind: released, ..KeyEvent::from(KeyCode::Enter) };
        assert_eq!(key(released), None);
    }
}
