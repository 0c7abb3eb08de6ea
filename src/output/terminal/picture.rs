//! Configurations as text: beams as lines; point masses, sliders, joints and supports as characters.

use super::TerminalStyle;
use super::character_grid::{CharacterGrid, TerminalColour};
use super::dots::{ACROSS, CurveStyle, DOWN, Dots};
use crate::output::axis::extent;
use crate::output::canvas::{Area, Point};
use crate::output::number::significant;
use crate::output::plane::{AxisLimits, View};
use crate::output::symbol::PlacedSymbol;
use crate::output::width::columns;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureMark {
    Particle,
    Slider,
    Joint,
    Hinge,
    Clamp,
}

impl PictureMark {
    const ALL: [Self; 5] = [Self::Particle, Self::Slider, Self::Joint, Self::Hinge, Self::Clamp];

    fn symbols(self) -> (char, char, &'static str) {
        match self {
            Self::Particle => ('●', 'O', "particle"),
            Self::Slider => ('◆', 'X', "slider"),
            Self::Joint => ('○', 'o', "joint"),
            Self::Hinge => ('▲', '^', "hinge"),
            Self::Clamp => ('■', '#', "clamp"),
        }
    }
}

/// Largest size of a drawing that counts as zero: as a fraction of the coordinates, and as a length.
const ROUNDING: (f64, f64) = (1e-10, 1e-290);
/// Size of the smallest picture with a frame [columns, lines].
const LEAST: (usize, usize) = (12, 5);
const MARGIN: f64 = 2.0;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConfigurationPicture {
    title: String,
    time: Option<f64>,
    lines: Vec<Vec<Point>>,
    reference_beams: Vec<Vec<Point>>,
    marks: Vec<(PictureMark, Point)>,
    obstacles: Vec<PlacedSymbol>,
    limits: AxisLimits,
}

struct PlaneWindow {
    middle: Point,
    dot: f64,
    last: Point,
}

impl ConfigurationPicture {
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    pub fn time(mut self, time: f64) -> Self {
        self.time = Some(time);
        self
    }

    pub fn line(mut self, points: Vec<Point>) -> Self {
        self.lines.push(points);
        self
    }

    pub fn reference_beam(mut self, points: Vec<Point>) -> Self {
        self.reference_beams.push(points);
        self
    }

    pub fn mark(mut self, mark: PictureMark, at: Point) -> Self {
        self.marks.push((mark, at));
        self
    }

    pub fn obstacle(mut self, placed: PlacedSymbol) -> Self {
        self.obstacles.push(placed);
        self
    }

    /// Sets limits of the axes. Because both axes have the same scale, one of them may show more.
    pub fn limits(mut self, limits: AxisLimits) -> Self {
        self.limits = limits;
        self
    }

    pub fn text(&self, style: &TerminalStyle) -> String {
        let has_frame = style.width >= LEAST.0 && style.height >= LEAST.1;
        let border = usize::from(has_frame);
        let columns = style.width - 2 * border;
        let Some((rows, window)) = self.window(columns, style.height - 2 * border) else {
            return style.glyphs.fit("nothing to draw", style.width);
        };
        let style = style.sized(style.width, rows + 2 * border);
        let mut sheet = CharacterGrid::new(&style);
        let mut dots = Dots::new(columns, rows);
        let (right, bottom) = window.last;
        let area = Area { left: 0.0, top: 0.0, right, bottom };
        for obstacle in &self.obstacles {
            let outline = obstacle.outline(|point| window.place(point), &area);
            dots.curve(outline, CurveStyle::Solid, TerminalColour::Faint);
        }
        let traces = [
            (&self.reference_beams, CurveStyle::Dotted, true),
            (&self.lines, CurveStyle::Solid, false),
        ];
        for (lines, trace, is_ghost) in traces {
            for (index, line) in lines.iter().enumerate() {
                let ink =
                    if is_ghost { TerminalColour::Faint } else { TerminalColour::Series(index) };
                dots.curve(line.iter().map(|&point| window.place(point)), trace, ink);
            }
        }
        for (column, row, mask, ink) in dots.drawn() {
            let glyph = match ink {
                TerminalColour::Faint => style.glyphs.choose(style.glyphs.of_dots(mask), '.'),
                _ => style.glyphs.of_dots(mask),
            };
            sheet.put(border + column, border + row, glyph, ink);
        }
        for (mark, at) in &self.marks {
            let (x, y) = window.place(*at);
            let is_seen = |at: f64, last: f64| (-0.5..=last + 0.5).contains(&at);
            if is_seen(x, window.last.0) && is_seen(y, window.last.1) {
                let (braille, ascii, _) = mark.symbols();
                let (column, row) = (x.round() as usize / ACROSS, y.round() as usize / DOWN);
                let sign = style.glyphs.choose(braille, ascii);
                sheet.put(border + column, border + row, sign, TerminalColour::Plain);
            }
        }
        if has_frame {
            self.draw_frame(&mut sheet, &style, &window);
        }
        sheet.render()
    }

    fn window(&self, columns: usize, rows: usize) -> Option<(usize, PlaneWindow)> {
        let points = || {
            let lines = self.lines.iter().chain(&self.reference_beams).flatten().copied();
            let all = lines.chain(self.marks.iter().map(|(_, at)| *at));
            all.filter(|(x, y)| x.is_finite() && y.is_finite())
        };
        if columns == 0 || rows == 0 {
            return None;
        }
        let bodies = View::of(points(), &self.limits);
        let obstacles: Vec<Point> =
            self.obstacles.iter().flat_map(|obstacle| obstacle.shown_points(&bodies)).collect();
        let points = || points().chain(obstacles.iter().copied());
        let fit_x = extent(points().map(|point| point.0))?;
        let fit_y = extent(points().map(|point| point.1))?;
        let (left, right) = self.limits.x.unwrap_or(fit_x);
        let (low, high) = self.limits.y.unwrap_or(fit_y);
        let (wide, tall) = (right - left, high - low);
        let room = |characters: usize, dots: usize| {
            ((characters * dots) as f64 - 1.0 - 2.0 * MARGIN).max(1.0)
        };
        let dot = (wide / room(columns, ACROSS)).max(tall / room(rows, DOWN));
        let size = [left, right, low, high].map(f64::abs).into_iter().fold(0.0, f64::max);
        let is_point = wide.max(tall) <= (ROUNDING.0 * size).max(ROUNDING.1);
        let dot = match is_point {
            true if size > ROUNDING.1 / ROUNDING.0 => 0.1 * size / room(columns, ACROSS),
            true => 1.0 / room(columns, ACROSS),
            false => dot,
        };
        let needed = ((tall / dot + 2.0 * MARGIN + 1.0) / DOWN as f64).ceil() as usize;
        let rows = needed.clamp(LEAST.1.min(rows + 2).saturating_sub(2).max(1), rows);
        let last = Dots::new(columns, rows).last();
        let middle = (0.5 * left + 0.5 * right, 0.5 * low + 0.5 * high);
        Some((rows, PlaneWindow { middle, dot, last }))
    }

    fn draw_frame(&self, sheet: &mut CharacterGrid, style: &TerminalStyle, window: &PlaneWindow) {
        let glyphs = style.glyphs;
        let (level, upright) = glyphs.choose(('─', '│'), ('-', '|'));
        let corners = glyphs.choose(['┌', '┐', '└', '┘'], ['+'; 4]);
        let (last_column, last_row) = (style.width - 1, style.height - 1);
        for column in 0..style.width {
            sheet.put(column, 0, level, TerminalColour::Plain);
            sheet.put(column, last_row, level, TerminalColour::Plain);
        }
        for row in 0..style.height {
            sheet.put(0, row, upright, TerminalColour::Plain);
            sheet.put(last_column, row, upright, TerminalColour::Plain);
        }
        let places = [(0, 0), (last_column, 0), (0, last_row), (last_column, last_row)];
        for ((column, row), corner) in places.into_iter().zip(corners) {
            sheet.put(column, row, corner, TerminalColour::Plain);
        }
        let time = self.time.map(|time| format!("t = {}", significant(time, 6)));
        let [x, y] = window.edges().map(|ends| ends.map(|end| significant(end, 3)));
        let edges = format!("x {} … {}  y {} … {}", x[0], x[1], y[0], y[1]);
        self.write_into(sheet, style, 0, &self.title, &time.unwrap_or_default());
        self.write_into(sheet, style, last_row, &edges, &self.signs(style));
    }

    fn write_into(
        &self,
        sheet: &mut CharacterGrid,
        style: &TerminalStyle,
        row: usize,
        left: &str,
        right: &str,
    ) {
        let room = style.width - 6;
        let right = style.glyphs.typeset(right);
        let beside = if right.is_empty() { 0 } else { columns(&right) + 3 };
        let wanted = columns(&style.glyphs.typeset(left));
        let is_room = beside + wanted.min(room / 2) <= room;
        let left = style.glyphs.fit(left, if is_room { room - beside } else { room });
        if !left.trim().is_empty() {
            sheet.write(2, row, &format!(" {left} "), TerminalColour::Plain);
        }
        if is_room && !right.is_empty() {
            sheet.write(
                style.width - 1 - beside,
                row,
                &format!(" {right} "),
                TerminalColour::Plain,
            );
        }
    }

    fn signs(&self, style: &TerminalStyle) -> String {
        let used =
            PictureMark::ALL.into_iter().filter(|mark| self.marks.iter().any(|(m, _)| m == mark));
        let named = used.map(|mark| {
            let (braille, ascii, name) = mark.symbols();
            format!("{} {name}", style.glyphs.choose(braille, ascii))
        });
        named.collect::<Vec<_>>().join("  ")
    }
}

impl PlaneWindow {
    fn place(&self, (x, y): Point) -> Point {
        let far = |value: f64, middle: f64| (value - middle) / self.dot;
        (0.5 * self.last.0 + far(x, self.middle.0), 0.5 * self.last.1 - far(y, self.middle.1))
    }

    fn edges(&self) -> [[f64; 2]; 2] {
        let ends = |middle: f64, dots: f64| {
            [-1.0, 1.0].map(|side| {
                let end = middle + side * 0.5 * dots * self.dot;
                if end.abs() < 1e-9 * dots * self.dot { 0.0 } else { end }
            })
        };
        [ends(self.middle.0, self.last.0), ends(self.middle.1, self.last.1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::terminal::{Colours, Glyphs};
    use proptest::prelude::*;

    const PLAIN: TerminalStyle =
        TerminalStyle { glyphs: Glyphs::Braille, colours: Colours::None, width: 40, height: 12 };

    fn picture() -> ConfigurationPicture {
        ConfigurationPicture::new("rod")
            .time(2.5)
            .reference_beam(vec![(0.0, 0.0), (4.0, 0.0)])
            .line(vec![(0.0, 0.0), (3.0, 2.0)])
            .mark(PictureMark::Hinge, (0.0, 0.0))
            .mark(PictureMark::Particle, (3.0, 2.0))
    }

    #[test]
    fn braille_picture_equals_the_reference() {
        let expected = [
            "┌─ rod ────────────────────── t = 2.5 ─┐",
            "│                          ⢀●          │",
            "│                       ⢀⡠⠒⠁           │",
            "│                    ⢀⡠⠒⠁              │",
            "│                 ⢀⡠⠒⠁                 │",
            "│              ⢀⡠⠒⠁                    │",
            "│            ⡠⠔⠁                       │",
            "│         ⡠⠔⠉                          │",
            "│      ⡠⠔⠉                             │",
            "│   ⡠⠔⠉                                │",
            "│ ▲⠉⠂⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂⠐ ⠂ │",
            "└─ x -0.143 … 4.14  y -0.114 … 2.11 ───┘",
        ];
        assert_eq!(picture().text(&PLAIN).lines().collect::<Vec<_>>(), expected);
    }

    #[test]
    fn ascii_picture_equals_the_reference() {
        let style = TerminalStyle { glyphs: Glyphs::Ascii, width: 44, ..PLAIN };
        let expected = [
            "+- rod -------------------------- t = 2.5 -+",
            "|                            _O            |",
            "|                         _.-'             |",
            "|                      _.-'                |",
            "|                   _.-'                   |",
            "|                _.-'                      |",
            "|              .-'                         |",
            "|           .-'                            |",
            "|        .-'                               |",
            "|     .-'                                  |",
            "|   ^'.. .. .. .. .. .. .. .. .. .. .. .   |",
            "+- x -0.371 ... 4.37  y -0.114 ... 2.11 ---+",
        ];
        assert_eq!(picture().text(&style).lines().collect::<Vec<_>>(), expected);
    }

    #[test]
    fn wall_below_a_beam_is_drawn() {
        let symbol = crate::output::symbol::Symbol::Wall;
        let floor = PlacedSymbol { symbol, at: (9.0, -0.5), direction: (0.0, 1.0) };
        let text = picture().obstacle(floor).text(&PLAIN);
        let lines: Vec<&str> = text.lines().collect();
        let longest = |line: &&str| line.chars().filter(|letter| *letter == '⠒').count() > 30;
        assert_eq!(lines.iter().filter(|line| longest(line)).count(), 1, "{text}");
        assert!(lines[lines.len() - 1].contains("y -0.6"), "{text}");
    }

    #[test]
    fn both_axes_of_a_picture_have_equal_scales() {
        let circle = (0..=360).map(|angle| f64::from(angle).to_radians().sin_cos()).collect();
        let picture = ConfigurationPicture::new("").line(circle);
        let (rows, window) = picture.window(60, 15).unwrap();
        let (right, top) = (window.place((1.0, 0.0)), window.place((0.0, 1.0)));
        let (left, bottom) = (window.place((-1.0, 0.0)), window.place((0.0, -1.0)));
        assert_eq!(rows, 15);
        assert!((right.0 - left.0 - (bottom.1 - top.1)).abs() < 1e-9);
        assert!(right.0 - left.0 > 50.0, "{left:?} {right:?}");
    }

    #[test]
    fn flat_picture_needs_few_lines() {
        let flat = ConfigurationPicture::new("flat").line(vec![(0.0, 0.0), (10.0, 0.0)]);
        assert_eq!(flat.text(&PLAIN).lines().count(), 5);
        assert_eq!(ConfigurationPicture::new("none").text(&PLAIN), "nothing to draw");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn picture_of_any_data_fits_any_size(
            line in prop::collection::vec((number(), number()), 0..6),
            ghost in prop::collection::vec((number(), number()), 0..4),
            mark in (number(), number()),
            title in ".{0,30}",
            width in 0usize..90, height in 0usize..30,
        ) {
            for glyphs in [Glyphs::Braille, Glyphs::Ascii] {
                let style = TerminalStyle { glyphs, width, height, ..PLAIN };
                let picture = ConfigurationPicture::new(title.clone()).time(mark.0)
                    .line(line.clone()).reference_beam(ghost.clone()).mark(PictureMark::Slider, mark);
                let text = picture.text(&style);
                prop_assert!(text.lines().count() <= height.max(1));
                prop_assert!(text.lines().all(|line| line.chars().count() <= width), "{text}");
                prop_assert!(glyphs == Glyphs::Braille || text.is_ascii(), "{text}");
            }
        }
    }

    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            Just(0.0),
            Just(f64::NAN),
            Just(1e308),
            Just(-1e308),
            Just(1e-300),
            proptest::num::f64::ANY,
            -10.0..10.0
        ]
    }
}
