//! Positions in the Language Server Protocol: lines and UTF-16 columns, counted from 0.

use std::iter;
use std::ops::Range;

use gen_lsp_types as lsp;

/// Starts of the lines of a text [bytes]. Lines end with `\n`, `\r\n` or `\r`.
fn line_starts(text: &str) -> impl Iterator<Item = usize> {
    let bytes = text.as_bytes();
    let ends = bytes.iter().enumerate().filter(|(at, byte)| match byte {
        b'\n' => true,
        b'\r' => bytes.get(at + 1) != Some(&b'\n'),
        _ => false,
    });
    iter::once(0).chain(ends.map(|(at, _)| at + 1))
}

pub fn position(text: &str, offset: usize) -> lsp::Position {
    let offset = text.floor_char_boundary(offset);
    let starts = line_starts(text).take_while(|start| *start <= offset);
    let (line, start) = starts.enumerate().last().unwrap_or_default();
    let character = text[start..offset].encode_utf16().count();
    lsp::Position { line: line as u32, character: character as u32 }
}

pub fn range(text: &str, part: Range<usize>) -> lsp::Range {
    lsp::Range { start: position(text, part.start), end: position(text, part.end) }
}

pub fn offset(text: &str, at: lsp::Position) -> usize {
    let Some(start) = line_starts(text).nth(at.line as usize) else { return text.len() };
    let line = text[start..].split(['\n', '\r']).next().unwrap_or_default();
    let mut units = 0;
    for (inside, letter) in line.char_indices() {
        if units >= at.character as usize {
            return start + inside;
        }
        units += letter.len_utf16();
    }
    start + line.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_utf16_units_and_accept_all_line_endings() {
        let text = "ä = 1;\r\n\"𝛏\" + b\rc\n";
        for (part, line, character) in
            [("ä", 0, 0), ("=", 0, 2), ("\"𝛏", 1, 0), ("𝛏", 1, 1), ("b", 1, 7), ("c", 2, 0)]
        {
            let byte = text.find(part).unwrap();
            let at = lsp::Position { line, character };
            assert_eq!((position(text, byte), offset(text, at)), (at, byte), "{part}");
        }
        assert_eq!(position(text, text.len()), lsp::Position { line: 3, character: 0 });
    }

    #[test]
    fn positions_outside_the_text_are_clamped() {
        let at = |line, character| offset("ab\r\n𝛏", lsp::Position { line, character });
        assert_eq!((at(0, 9), at(7, 0), at(1, 1), at(1, u32::MAX)), (2, 8, 8, 8));
        assert_eq!(position("ξ", 1), position("ξ", 0));
        assert_eq!(position("", 5), lsp::Position::default());
    }
}
