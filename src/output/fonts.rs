//! Text in the font DejaVu Sans, which is embedded so that pictures do not depend on installed fonts.
//! Coordinates [pixels] start at the left end of the baseline; `x` increases to the right and `y` downwards.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, GlyphId, Outline, OutlineCurve, OutlinedGlyph, PxScale};

use super::canvas::Point;
use crate::elementary::{hypot, square};

const LONGEST: usize = 400;

/// Largest distance between a curve and the polyline that replaces it [pixels].
const FLATNESS: f64 = 0.03;

/// Embedded font. If it could not be loaded, pictures would have no text.
static FACE: LazyLock<Option<FontRef<'static>>> =
    LazyLock::new(|| FontRef::try_from_slice(dejavu::sans::regular()).ok());

/// Width of `text` at `size` pixels per em [pixels].
pub fn width(text: &str, size: f64) -> f64 {
    set(text, size).1
}

/// Size at which `text` fits into the width `room` [pixels]. The size is at most `size` and at least 60 % of it.
pub fn shrunk(text: &str, size: f64, room: f64) -> f64 {
    const SMALLEST: f64 = 0.6;
    // The slight reduction of the size keeps a text of exactly the available width from becoming too long by rounding.
    const ROUNDING: f64 = 1.0 - 1e-9;
    let wanted = width(text, size);
    if wanted <= room { size } else { size * (ROUNDING * room / wanted).max(SMALLEST) }
}

pub fn fit(text: &str, size: f64, room: f64) -> String {
    if text.chars().count() <= LONGEST && width(text, size) <= room {
        return text.into();
    }
    let mut kept: Vec<char> = text.chars().take(LONGEST).collect();
    loop {
        let shortened = kept.iter().collect::<String>().trim_end().to_string() + "…";
        if kept.is_empty() || width(&shortened, size) <= room {
            return shortened;
        }
        kept.pop();
    }
}

pub fn lines(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.chars().take(LONGEST).collect::<String>().split(' ') {
        let joined = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if width(&joined, size) <= room {
            line = joined;
            continue;
        }
        lines.extend((!line.is_empty()).then(|| std::mem::take(&mut line)));
        for letter in word.chars() {
            if !line.is_empty() && width(&format!("{line}{letter}"), size) > room {
                lines.push(std::mem::take(&mut line));
            }
            line.push(letter);
        }
    }
    lines.extend((!line.trim().is_empty()).then_some(line));
    lines
}

pub fn glyphs(text: &str, size: f64) -> Vec<OutlinedGlyph> {
    let Some(face) = FACE.as_ref() else { return Vec::new() };
    let scale = PxScale::from((f64::from(face.height_unscaled()) * per_unit(face, size)) as f32);
    let place =
        |(id, x): (GlyphId, f64)| id.with_scale_and_position(scale, ab_glyph::point(x as f32, 0.0));
    set(text, size).0.into_iter().filter_map(|glyph| face.outline_glyph(place(glyph))).collect()
}

pub fn outlines(text: &str, size: f64) -> Vec<Vec<Vec<Point>>> {
    let Some(face) = FACE.as_ref() else { return Vec::new() };
    let per_unit = per_unit(face, size);
    let outline = |(id, x): (GlyphId, f64)| {
        let place =
            |p: ab_glyph::Point| (x + f64::from(p.x) * per_unit, -f64::from(p.y) * per_unit);
        face.outline(id).map(|outline| contours(&outline, place))
    };
    set(text, size).0.into_iter().filter_map(outline).collect()
}

fn set(text: &str, size: f64) -> (Vec<(GlyphId, f64)>, f64) {
    let Some(face) = FACE.as_ref() else { return (Vec::new(), 0.0) };
    let per_unit = per_unit(face, size);
    let mut line = Vec::new();
    let mut x = 0.0;
    let mut last = None;
    for c in text.chars().filter(|c| !c.is_control()).take(LONGEST) {
        let id = face.glyph_id(c);
        x += last.map_or(0.0, |last| f64::from(face.kern_unscaled(last, id)) * per_unit);
        line.push((id, x));
        x += f64::from(face.h_advance_unscaled(id)) * per_unit;
        last = Some(id);
    }
    (line, x)
}

fn per_unit(face: &FontRef<'static>, size: f64) -> f64 {
    size / f64::from(face.units_per_em().unwrap_or(2048.0))
}

fn contours(outline: &Outline, place: impl Fn(ab_glyph::Point) -> Point) -> Vec<Vec<Point>> {
    let mut contours: Vec<Vec<Point>> = Vec::new();
    let mut pen = None;
    for curve in &outline.curves {
        let (from, to) = match *curve {
            OutlineCurve::Line(a, b)
            | OutlineCurve::Quad(a, _, b)
            | OutlineCurve::Cubic(a, _, _, b) => (a, b),
        };
        if pen != Some(from) {
            contours.push(vec![place(from)]);
        }
        pen = Some(to);
        if let Some(contour) = contours.last_mut() {
            if let OutlineCurve::Quad(a, b, c) = *curve {
                bend(contour, place(a), place(b), place(c));
            }
            contour.push(place(to));
        }
    }
    contours
}

fn bend(contour: &mut Vec<Point>, a: Point, b: Point, c: Point) {
    let sag = hypot(a.0 - 2.0 * b.0 + c.0, a.1 - 2.0 * b.1 + c.1) / 4.0;
    let pieces = (sag / FLATNESS).sqrt().ceil().clamp(1.0, 8.0) as usize;
    for piece in 1..pieces {
        let t = piece as f64 / pieces as f64;
        let blend =
            |a: f64, b: f64, c: f64| square(1.0 - t) * a + 2.0 * t * (1.0 - t) * b + t * t * c;
        contour.push((blend(a.0, b.0, c.0), blend(a.1, b.1, c.1)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn font_contains_all_characters_of_labels() {
        let face = FACE.as_ref().unwrap();
        for c in "aZ09−×⁻⁰¹²³⁴⁵⁶⁷⁸⁹≤…αβγκλωΔäö·".chars() {
            assert_ne!(face.glyph_id(c), GlyphId(0), "{c}");
        }
    }

    #[test]
    fn letter_with_a_hole_has_two_contours_of_opposite_orientation() {
        let glyphs = outlines("o", 100.0);
        let turn = |contour: &Vec<Point>| -> f64 {
            contour.windows(2).map(|pair| pair[0].0 * pair[1].1 - pair[1].0 * pair[0].1).sum()
        };
        assert_eq!(glyphs.len(), 1);
        assert_eq!(glyphs[0].len(), 2);
        assert!(turn(&glyphs[0][0]) * turn(&glyphs[0][1]) < 0.0);
    }

    #[test]
    fn wrapped_lines_fit_and_contain_all_words() {
        let text = "drift of energy, momenta and gap of the flying spaghetti";
        assert_eq!(lines(text, 12.0, 1000.0), [text]);
        let broken = lines(text, 12.0, 120.0);
        assert!(broken.len() > 2 && broken.iter().all(|line| width(line, 12.0) <= 120.0));
        assert_eq!(broken.join(" "), text);
        assert_eq!(lines(&"x".repeat(100), 12.0, 120.0).concat(), "x".repeat(100));
        assert!(lines("", 12.0, 120.0).is_empty());
    }

    #[test]
    fn long_texts_are_shortened_to_the_available_width() {
        assert_eq!(fit("energy", 12.0, 100.0), "energy");
        let short = fit(&"very long ".repeat(1000), 12.0, 100.0);
        assert!(short.ends_with('…') && width(&short, 12.0) <= 100.0, "{short}");
        assert_eq!(fit("x", 12.0, -1.0), "…");
        assert_eq!(width("\n\t", 12.0), 0.0);
    }
}
