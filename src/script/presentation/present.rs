//! Display of script values at the prompt.

use std::ops::{Range, RangeInclusive};

use rhai::{Array, Dynamic, FnPtr, INT, Map};

use crate::geometry::Vec2;
use crate::output::{beginning, columns, cut, padded, significant};
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::kind::{Details, Type};

const DIGITS: usize = 10;
const MOST_ITEMS: usize = 8;
const FIRST_ITEMS: usize = 3;
const MOST_KEYS: usize = 12;
const DEEPEST: usize = 4;
const LONGEST_TEXT: usize = 40;
/// Minimum width of the values in summaries [columns].
const LEAST_ROOM: usize = 20;
const MOST_LINES: usize = 200;

/// Formatter of values for a line width.
pub struct Presenter<'a> {
    catalog: &'a Catalog,
    width: usize,
}

/// Line of limited width, beyond which values are not formatted.
struct OutputLine {
    text: String,
    room: usize,
}

impl OutputLine {
    fn new(room: usize) -> Self {
        Self { text: String::new(), room }
    }

    fn write(&mut self, text: &str) {
        self.text.push_str(beginning(text, self.room + 2));
        self.room = self.room.saturating_sub(columns(text));
    }

    fn is_full(&self) -> bool {
        self.room == 0
    }

    fn cut(self, width: usize) -> (String, bool) {
        let shown = cut(&self.text, width, '…');
        let is_whole = shown == self.text;
        (shown, is_whole)
    }
}

/// Formats a value on lines of `width` columns, with up to ten digits. Long arrays and maps are abbreviated.
/// Native values are followed by their summary. The unit value gives an empty text.
pub fn present(catalog: &Catalog, value: &Dynamic, width: usize) -> String {
    Presenter { catalog, width: width.max(20) }.show(value)
}

/// First line of a value, of `width` columns, with abbreviated arrays and maps.
pub fn present_in_a_line(catalog: &Catalog, value: &Dynamic, width: usize) -> String {
    let presenter = Presenter { catalog, width };
    if is_collection(value) {
        return presenter.inline(value, width).0;
    }
    presenter.show(value).lines().next().unwrap_or_default().to_owned()
}

impl Presenter<'_> {
    fn show(&self, value: &Dynamic) -> String {
        if value.read_lock::<()>().is_some() {
            return String::new();
        }
        if let Some(text) = value.read_lock::<rhai::ImmutableString>().filter(|t| t.contains('\n'))
        {
            return self.lines_of(&text);
        }
        if let Some((of, shown)) = self.native(value) {
            return self.with_details(&shown, &of.details(value).unwrap_or_default());
        }
        let (line, is_whole) = self.inline(value, self.width);
        if is_whole {
            return line;
        }
        if let Some(array) =
            value.read_lock::<Array>().filter(|array| array.iter().any(is_collection))
        {
            return self.rows(&array);
        }
        match value.read_lock::<Map>() {
            Some(map) => self.keys(&map),
            None => line,
        }
    }

    fn lines_of(&self, text: &str) -> String {
        let text = text.trim_end_matches('\n');
        let shown: Vec<&str> = text.lines().take(MOST_LINES).collect();
        let count = text.lines().count();
        let rest = (count > MOST_LINES).then(|| format!("\n… ({count} lines)"));
        format!("{}{}", shown.join("\n"), rest.unwrap_or_default())
    }

    fn with_details(&self, shown: &str, details: &Details) -> String {
        let widest = details.iter().map(|(label, _)| columns(label)).max().unwrap_or(0);
        let room = self.width.saturating_sub(widest + 4).max(LEAST_ROOM);
        let mut text = shown.to_owned();
        for (label, value) in details {
            for (number, part) in wrapped(value, room).into_iter().enumerate() {
                let label = if number == 0 { label } else { "" };
                text.push_str(&format!("\n  {}  {part}", padded(label, widest)));
            }
        }
        text
    }

    fn native(&self, value: &Dynamic) -> Option<(Type, String)> {
        let mut types = self.catalog.tables().flat_map(|table| table.types);
        let (of, shown) = types.find_map(|of| Some((*of, of.show(value)?)))?;
        // A vector in an array is written as a point, because brackets denote arrays.
        let vector = value.read_lock::<Vec2>().map(|vector| written(&vector));
        Some((of, vector.unwrap_or(shown)))
    }

    fn inline(&self, value: &Dynamic, width: usize) -> (String, bool) {
        let mut line = OutputLine::new(width);
        self.write(&mut line, value, 0);
        line.cut(width)
    }

    fn write(&self, line: &mut OutputLine, value: &Dynamic, depth: usize) {
        if line.is_full() {
            return;
        }
        if let Some(array) = value.read_lock::<Array>() {
            self.write_array(line, &array, depth);
        } else if let Some(map) = value.read_lock::<Map>() {
            self.write_map(line, &map, depth);
        } else if let Some((of, shown)) = self.native(value) {
            line.write(if shown.contains('\n') { of.name() } else { &shown });
        } else {
            let longest = if depth == 0 { self.width } else { LONGEST_TEXT };
            line.write(&plain(value, longest));
        }
    }

    fn write_array(&self, line: &mut OutputLine, array: &Array, depth: usize) {
        if depth >= DEEPEST && !array.is_empty() {
            return line.write("[…]");
        }
        line.write("[");
        for (number, item) in elided(array).into_iter().enumerate() {
            line.write(if number > 0 { ", " } else { "" });
            match item {
                Some(item) => self.write(line, item, depth + 1),
                None => line.write("…"),
            }
        }
        line.write("]");
        if array.len() > MOST_ITEMS {
            line.write(&format!(" ({})", array.len()));
        }
    }

    fn write_map(&self, line: &mut OutputLine, map: &Map, depth: usize) {
        if depth >= DEEPEST && !map.is_empty() {
            return line.write("#{…}");
        }
        line.write("#{");
        for (number, (key, value)) in map.iter().take(MOST_KEYS).enumerate() {
            line.write(if number > 0 { ", " } else { "" });
            line.write(&format!("{}: ", written_key(key)));
            self.write(line, value, depth + 1);
        }
        if map.len() > MOST_KEYS {
            line.write(", …");
        }
        line.write("}");
    }

    fn rows(&self, array: &Array) -> String {
        let items = elided(array);
        let last = items.len() - 1;
        let row = |(number, item): (usize, Option<&Dynamic>)| {
            let mut line = OutputLine::new(self.width);
            line.write(if number == 0 { "[" } else { " " });
            match item {
                Some(item) => self.write(&mut line, item, 1),
                None => line.write("…"),
            }
            let end = if number == last { "]" } else { "," };
            format!("{}{end}", line.cut(self.width - 1).0)
        };
        let rows: Vec<String> = items.into_iter().enumerate().map(row).collect();
        let count =
            if array.len() > MOST_ITEMS { format!(" ({})", array.len()) } else { "".into() };
        format!("{}{count}", rows.join("\n"))
    }

    fn keys(&self, map: &Map) -> String {
        let mut lines = vec!["#{".to_owned()];
        for (key, value) in map.iter().take(MOST_KEYS) {
            let mut line = OutputLine::new(self.width);
            line.write(&format!("  {}: ", written_key(key)));
            self.write(&mut line, value, 1);
            lines.push(format!("{},", line.cut(self.width - 1).0));
        }
        if map.len() > MOST_KEYS {
            lines.push(format!("  … ({} keys)", map.len()));
        }
        lines.push("}".to_owned());
        lines.join("\n")
    }
}

fn wrapped(text: &str, room: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut used = 0;
    for word in text.split(' ').flat_map(|word| pieces(word, room)) {
        let length = columns(&word);
        if used > 0 && used + 1 + length > room {
            lines.push(word);
            used = length;
        } else if let Some(line) = lines.last_mut() {
            let gap = if used > 0 { " " } else { "" };
            line.push_str(&format!("{gap}{word}"));
            used += gap.len() + length;
        }
    }
    lines
}

fn pieces(word: &str, room: usize) -> Vec<String> {
    let mut rest = word;
    let mut pieces = Vec::new();
    while !rest.is_empty() {
        let least = rest.chars().next().map_or(0, char::len_utf8);
        let (piece, behind) = rest.split_at(beginning(rest, room).len().max(least));
        pieces.push(piece.to_owned());
        rest = behind;
    }
    pieces
}

fn elided(array: &Array) -> Vec<Option<&Dynamic>> {
    if array.len() <= MOST_ITEMS {
        return array.iter().map(Some).collect();
    }
    array[..FIRST_ITEMS].iter().map(Some).chain([None, array.last()]).collect()
}

fn is_collection(value: &Dynamic) -> bool {
    value.read_lock::<Array>().is_some() || value.read_lock::<Map>().is_some()
}

fn written(vector: &Vec2) -> String {
    format!("({}, {})", significant(vector.x, DIGITS), significant(vector.y, DIGITS))
}

fn written_key(key: &str) -> String {
    let is_name = key.starts_with(|first: char| first.is_alphabetic() || first == '_')
        && key.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
    if is_name { key.to_owned() } else { format!("{key:?}") }
}

fn plain(value: &Dynamic, longest: usize) -> String {
    // Shared values, such as variables captured by closures, must be locked for reading.
    let value = value.flatten_clone();
    if let Ok(x) = value.as_float() {
        return significant(x, DIGITS);
    }
    if let Some(text) = value.read_lock::<rhai::ImmutableString>() {
        return match text.char_indices().nth(longest) {
            Some((end, _)) => format!("{:?}…", &text[..end]),
            None => format!("{:?}", text.as_str()),
        };
    }
    if let Some(function) = value.read_lock::<FnPtr>() {
        let name = function.fn_name();
        return if name.contains('$') { "function".into() } else { format!("function {name}") };
    }
    if let Some(range) = value.read_lock::<Range<INT>>() {
        return format!("{}..{}", range.start, range.end);
    }
    if let Some(range) = value.read_lock::<RangeInclusive<INT>>() {
        return format!("{}..={}", range.start(), range.end());
    }
    if let Ok(letter) = value.as_char() {
        return format!("{letter:?}");
    }
    if value.is_int() || value.is_bool() {
        return value.to_string();
    }
    match value.is_unit() {
        true => "()".into(),
        false => value.type_name().rsplit("::").next().unwrap_or_default().to_owned(),
    }
}
