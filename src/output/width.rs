//! Width of a text in a terminal [columns]: sum of the widths of its characters (Unicode Standard Annex #11, East Asian Width).

use unicode_width::UnicodeWidthChar;

/// Number of columns of a character; zero for control characters, including tabs.
pub fn columns_of(letter: char) -> usize {
    letter.width().unwrap_or(0)
}

pub fn columns(text: &str) -> usize {
    text.chars().map(columns_of).sum()
}

pub fn beginning(text: &str, most: usize) -> &str {
    let mut taken = 0;
    let beyond = text.char_indices().find(|(_, letter)| {
        taken += columns_of(*letter);
        taken > most
    });
    beyond.map_or(text, |(end, _)| &text[..end])
}

pub fn cut(text: &str, most: usize, mark: char) -> String {
    match beginning(text, most) {
        whole if whole.len() == text.len() => text.to_owned(),
        _ if most == 0 => String::new(),
        _ => format!("{}{mark}", beginning(text, most - columns_of(mark))),
    }
}

pub fn padded(text: &str, width: usize) -> String {
    // Formatting in Rust is not used, because it counts characters instead of columns and is limited to a width of 65 535.
    format!("{text}{}", " ".repeat(width.saturating_sub(columns(text))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn character_widths_equal_those_of_terminals() {
        for (text, width) in [("arm", 3), ("梁", 2), ("e\u{301}", 1), ("ξ → 10⁻¹²…", 10), ("", 0)]
        {
            assert_eq!(columns(text), width, "{text}");
        }
    }

    #[test]
    fn texts_are_cut_and_padded_by_display_width() {
        assert_eq!(cut("漢字の梁", 8, '…'), "漢字の梁");
        assert_eq!(cut("漢字の梁", 7, '…'), "漢字の…");
        assert_eq!(cut("漢字の梁", 6, '…'), "漢字…");
        assert_eq!((cut("ab", 1, '~'), cut("ab", 0, '~')), ("~".into(), String::new()));
        assert_eq!(padded("梁", 4), "梁  ");
        assert_eq!(padded("long", 2), "long");
    }
}
