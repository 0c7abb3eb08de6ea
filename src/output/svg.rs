//! Painter of SVG files, based on the library plotters. Text is converted to outlines, so that no fonts are needed.
//! Because the coordinates of plotters are integers, the picture is drawn on a grid of [`GRID`] steps per pixel.

use plotters::prelude::{DrawingBackend, RGBColor, SVGBackend, ShapeStyle};

use super::{
    OutputError,
    canvas::{Canvas, Point, Shape, Text, TextDirection},
    colour::{Colour, WHITE},
    fonts,
};

const GRID: f64 = 20.0;

pub fn paint(canvas: &Canvas, width: u32, height: u32) -> Result<String, OutputError> {
    let mut body = String::new();
    let size = (width * GRID as u32, height * GRID as u32);
    let mut backend = SVGBackend::with_string(&mut body, size);
    let paper = style(WHITE, 1);
    backend.draw_rect((0, 0), (size.0 as i32, size.1 as i32), &paper, true).map_err(refused)?;
    for shape in canvas.shapes() {
        paint_shape(&mut backend, shape)?;
    }
    backend.present().map_err(refused)?;
    drop(backend);

    let opening = opening(size);
    let drawn =
        body.strip_prefix(&opening).ok_or_else(|| refused("the document begins otherwise"))?;
    Ok(head(canvas, width, height, size) + drawn.replace(" opacity=\"1\"", "").as_str())
}

fn opening(grid: (u32, u32)) -> String {
    let mut empty = String::new();
    drop(SVGBackend::with_string(&mut empty, grid));
    empty.truncate(empty.rfind(END).unwrap_or(0));
    empty
}

const END: &str = "</svg>";

fn head(canvas: &Canvas, width: u32, height: u32, grid: (u32, u32)) -> String {
    let texts: Vec<String> = canvas.shapes().iter().filter_map(text_of).collect();
    let title = texts.first().cloned().unwrap_or_default();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {} {}\" \
         role=\"img\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
         <title>{title}</title>\n<desc>{}</desc>\n",
        grid.0,
        grid.1,
        texts.join(" | "),
    )
}

fn text_of(shape: &Shape) -> Option<String> {
    let Shape::Text(Text { text, .. }) = shape else { return None };
    let text = text.replace(char::is_control, " ");
    Some(text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;"))
}

fn refused(error: impl std::fmt::Display) -> OutputError {
    OutputError::Paint { reason: error.to_string() }
}

fn paint_shape(backend: &mut SVGBackend<'_>, shape: &Shape) -> Result<(), OutputError> {
    match shape {
        Shape::Line { points, width, colour } => {
            // A dot is a line whose second point equals its first point.
            let end = points.last().filter(|_| points.len() == 1);
            backend.draw_path(
                points.iter().chain(end).copied().map(on_grid),
                &style(*colour, steps(*width)),
            )
        }
        Shape::Disc { centre, radius, colour } => {
            backend.draw_circle(on_grid(*centre), steps(*radius), &style(*colour, 1), true)
        }
        Shape::Fill { area, colour } => {
            let corners = (on_grid((area.left, area.top)), on_grid((area.right, area.bottom)));
            backend.draw_rect(corners.0, corners.1, &style(*colour, 1), true)
        }
        Shape::Text(text) => fonts::outlines(&text.text, text.size).iter().try_for_each(|glyph| {
            backend.fill_polygon(one_polygon(glyph, text), &style(text.colour, 1))
        }),
    }
    .map_err(refused)
}

/// Combines the contours of a glyph to one polygon, by bridges of zero width from the first contour.
fn one_polygon(contours: &[Vec<Point>], text: &Text) -> Vec<(i32, i32)> {
    let home = contours.first().and_then(|contour| contour.first());
    let walk = contours
        .iter()
        .enumerate()
        .flat_map(|(index, contour)| contour.iter().chain(home.filter(|_| index > 0)));
    let mut polygon: Vec<(i32, i32)> = walk.map(|&(x, y)| on_grid(placed((x, y), text))).collect();
    polygon.dedup();
    polygon
}

fn placed((x, y): Point, text: &Text) -> Point {
    match text.direction {
        TextDirection::Level => (text.start.0 + x, text.start.1 + y),
        TextDirection::Upwards => (text.start.0 + y, text.start.1 - x),
    }
}

fn on_grid((x, y): Point) -> (i32, i32) {
    ((x * GRID).round() as i32, (y * GRID).round() as i32)
}

fn steps(pixels: f64) -> u32 {
    (pixels * GRID).round().max(1.0) as u32
}

fn style(Colour(r, g, b): Colour, stroke_width: u32) -> ShapeStyle {
    ShapeStyle { color: RGBColor(r, g, b).into(), filled: true, stroke_width }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{canvas::Align, colour::INK};

    #[test]
    fn svg_text_is_drawn_as_outlines_with_a_description() {
        let mut canvas = Canvas::default();
        canvas.text("a < b", (10.0, 20.0), 12.0, Align::Start, INK);
        let svg = paint(&canvas, 100, 50).unwrap();
        assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\" viewBox=\"0 0 2000 1000\""));
        assert!(svg.contains("<title>a &lt; b</title>"), "{svg}");
        assert!(svg.contains("<polygon") && !svg.contains("<text"));
        assert!(svg.ends_with("</svg>\n"));
    }

    #[test]
    fn svg_dot_is_a_line_with_two_equal_ends() {
        let mut canvas = Canvas::default();
        canvas.line([(1.0, 2.0)], 2.0, INK);
        assert!(paint(&canvas, 100, 50).unwrap().contains("points=\"20,40 20,40 \""));
    }
}
