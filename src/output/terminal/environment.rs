//! Style of a terminal, determined from environment variables.

use super::{Colours, Glyphs, TerminalStyle};

/// Terminal size [columns, lines] if the terminal does not report it.
const USUAL: (usize, usize) = (80, 24);

const WIDTHS: (usize, usize) = (20, 240);
const HEIGHTS: (usize, usize) = (8, 60);

const FREE_LINES: usize = 3;

impl TerminalStyle {
    /// Style of a terminal from its environment variables, whose values `variable` returns.
    ///
    /// Colours are not used if `NO_COLOR` is set and not empty, or if `TERM` is `dumb` or not set.
    /// Braille characters are used for UTF-8, unless `TERM` is `dumb` or `linux` (the console, whose font lacks them).
    /// The character set is given by `LC_ALL`, otherwise `LC_CTYPE`, otherwise `LANG`; the size by `COLUMNS` and `LINES`.
    pub fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Self {
        let given = |name: &str| variable(name).filter(|value| !value.is_empty());
        let terminal = given("TERM").unwrap_or_default();
        let characters = given("LC_ALL").or_else(|| given("LC_CTYPE")).or_else(|| given("LANG"));
        let characters = characters.unwrap_or_default().to_lowercase();
        let knows_utf8 = characters.contains("utf-8") || characters.contains("utf8");
        let is_plain = given("NO_COLOR").is_some() || matches!(&*terminal, "" | "dumb");
        let has_no_braille = !knows_utf8 || matches!(&*terminal, "dumb" | "linux");
        let number = |name: &str| given(name)?.trim().parse::<usize>().ok().filter(|n| *n > 0);
        let (columns, lines) =
            (number("COLUMNS").unwrap_or(USUAL.0), number("LINES").unwrap_or(USUAL.1));
        let style = Self {
            glyphs: if has_no_braille { Glyphs::Ascii } else { Glyphs::Braille },
            colours: if is_plain { Colours::None } else { Colours::Ansi },
            width: USUAL.0,
            height: USUAL.1,
        };
        style.on_terminal(columns, lines)
    }

    #[must_use]
    pub(crate) fn on_terminal(self, columns: usize, lines: usize) -> Self {
        let height = lines.saturating_sub(FREE_LINES).clamp(HEIGHTS.0, HEIGHTS.1);
        self.sized(columns.clamp(WIDTHS.0, WIDTHS.1), height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn style(variables: &[(&str, &str)]) -> TerminalStyle {
        let value = |name: &str| variables.iter().find(|(other, _)| *other == name);
        TerminalStyle::of_environment(|name| value(name).map(|(_, value)| (*value).to_owned()))
    }

    fn abilities(variables: &[(&str, &str)]) -> (Glyphs, Colours) {
        let style = style(variables);
        (style.glyphs, style.colours)
    }

    #[test]
    fn glyphs_and_colours_follow_the_terminal_environment() {
        use {Colours::*, Glyphs::*};
        let modern = ("TERM", "xterm-256color");
        assert_eq!(abilities(&[modern, ("LANG", "en_GB.UTF-8")]), (Braille, Ansi));
        assert_eq!(abilities(&[modern, ("LC_CTYPE", "C.utf8")]), (Braille, Ansi));
        assert_eq!(abilities(&[("TERM", "linux"), ("LANG", "C.UTF-8")]), (Ascii, Ansi));
        assert_eq!(abilities(&[("TERM", "dumb"), ("LANG", "C.UTF-8")]), (Ascii, None));
        assert_eq!(abilities(&[modern]), (Ascii, Ansi));
        assert_eq!(abilities(&[("LANG", "C.UTF-8")]), (Braille, None));
    }

    #[test]
    fn first_nonempty_locale_variable_selects_the_glyphs() {
        let lang = ("LANG", "C.UTF-8");
        assert_eq!(abilities(&[("LC_ALL", "C"), lang]).0, Glyphs::Ascii);
        assert_eq!(abilities(&[("LC_ALL", ""), ("LC_CTYPE", ""), lang]).0, Glyphs::Braille);
    }

    #[test]
    fn nonempty_no_color_variable_disables_colours() {
        let modern = ("TERM", "xterm");
        assert_eq!(abilities(&[modern, ("NO_COLOR", "1")]).1, Colours::None);
        assert_eq!(abilities(&[modern, ("NO_COLOR", "")]).1, Colours::Ansi);
    }

    #[test]
    fn terminal_sizes_are_limited_to_a_valid_range() {
        let size = |columns, lines| {
            let style = style(&[("COLUMNS", columns), ("LINES", lines)]);
            (style.width, style.height)
        };
        assert_eq!(size("100", "40"), (100, 37));
        assert_eq!(size("", "many"), (80, 21));
        assert_eq!(size("0", "1"), (80, 8));
        assert_eq!(size("99999", "99999"), (240, 60));
    }
}
