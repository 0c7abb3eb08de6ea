//! Painter of PNG files with anti-aliasing: pixels are mixed with the colour of a shape by the fraction that it covers.
//!
//! Lines are painted here, because thick lines and polygons of the library plotters have ragged edges.
//! A line of half width `r` covers the fraction `r + ½ − d` of a pixel at the distance `d` from its nearest segment.

use plotters::prelude::{BitMapBackend, DrawingBackend, RGBColor};
use plotters::style::Color;

use super::{
    OutputError,
    canvas::{Area, Canvas, Point, Shape, Text, TextDirection},
    colour::{Colour, WHITE},
    fonts,
};
use crate::elementary::hypot;

pub fn paint(canvas: &Canvas, width: u32, height: u32) -> Result<Vec<u8>, OutputError> {
    encode(&pixels(canvas, width, height)?, width, height).map_err(refused)
}

pub fn pixels(canvas: &Canvas, width: u32, height: u32) -> Result<Vec<u8>, OutputError> {
    let Colour(paper, ..) = WHITE;
    let mut pixels = vec![paper; width as usize * height as usize * 3];
    {
        let mut sheet = PngPage {
            backend: BitMapBackend::with_buffer(&mut pixels, (width, height)),
            width,
            height,
        };
        canvas.shapes().iter().try_for_each(|shape| sheet.paint(shape))?;
    }
    Ok(pixels)
}

fn encode(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Best);
    encoder.write_header()?.write_image_data(pixels)?;
    Ok(bytes)
}

fn refused(error: impl std::fmt::Display) -> OutputError {
    OutputError::Paint { reason: error.to_string() }
}

struct PngPage<'a> {
    backend: BitMapBackend<'a>,
    width: u32,
    height: u32,
}

impl PngPage<'_> {
    fn paint(&mut self, shape: &Shape) -> Result<(), OutputError> {
        match shape {
            Shape::Line { points, width, colour } => self.line(points, width / 2.0, *colour),
            Shape::Disc { centre, radius, colour } => self.line(&[*centre], *radius, *colour),
            Shape::Fill { area, colour } => self.fill(*area, *colour),
            Shape::Text(text) => self.text(text),
        }
    }

    fn line(&mut self, points: &[Point], radius: f64, colour: Colour) -> Result<(), OutputError> {
        let mut cover = PixelCoverage::around(points, radius + 1.0, self.width, self.height);
        match points {
            [dot] => cover.piece(*dot, *dot, radius),
            _ => points.windows(2).for_each(|pair| cover.piece(pair[0], pair[1], radius)),
        }
        let lit = cover.amounts.iter().enumerate().filter(|&(_, &amount)| amount > 0.0);
        for (index, &amount) in lit {
            let (row, column) = (index / cover.columns, index % cover.columns);
            self.mix((cover.left + column) as i32, (cover.top + row) as i32, amount, colour)?;
        }
        Ok(())
    }

    fn fill(&mut self, area: Area, colour: Colour) -> Result<(), OutputError> {
        let whole = |x: f64, limit: u32| x.round().clamp(0.0, f64::from(limit)) as i32;
        for y in whole(area.top, self.height)..whole(area.bottom, self.height) {
            for x in whole(area.left, self.width)..whole(area.right, self.width) {
                self.mix(x, y, 1.0, colour)?;
            }
        }
        Ok(())
    }

    fn text(&mut self, text: &Text) -> Result<(), OutputError> {
        let start = (text.start.0.round() as i32, text.start.1.round() as i32);
        for glyph in fonts::glyphs(&text.text, text.size) {
            let corner = glyph.px_bounds().min;
            let mut covered = Vec::new();
            glyph.draw(|x, y, amount| {
                covered.push((corner.x as i32 + x as i32, corner.y as i32 + y as i32, amount))
            });
            for (x, y, amount) in covered {
                let (x, y) = match text.direction {
                    TextDirection::Level => (start.0 + x, start.1 + y),
                    TextDirection::Upwards => (start.0 + y, start.1 - x - 1),
                };
                self.mix(x, y, amount, text.colour)?;
            }
        }
        Ok(())
    }

    fn mix(
        &mut self,
        x: i32,
        y: i32,
        amount: f32,
        Colour(r, g, b): Colour,
    ) -> Result<(), OutputError> {
        if x < 0 || y < 0 || x >= self.width as i32 || y >= self.height as i32 || amount <= 0.0 {
            return Ok(());
        }
        let colour = RGBColor(r, g, b).mix(f64::from(amount.min(1.0)));
        self.backend.draw_pixel((x, y), colour.to_backend_color()).map_err(refused)
    }
}

struct PixelCoverage {
    left: usize,
    top: usize,
    columns: usize,
    rows: usize,
    amounts: Vec<f32>,
}

impl PixelCoverage {
    fn around(points: &[Point], reach: f64, width: u32, height: u32) -> Self {
        let span = |pick: fn(&Point) -> f64, limit: u32| {
            let low = points.iter().map(pick).fold(f64::INFINITY, f64::min) - reach;
            let high = points.iter().map(pick).fold(f64::NEG_INFINITY, f64::max) + reach;
            let whole = |x: f64| x.clamp(0.0, f64::from(limit)) as usize;
            (whole(low.floor()), whole(high.ceil()))
        };
        let ((left, right), (top, bottom)) = (span(|p| p.0, width), span(|p| p.1, height));
        let (columns, rows) = (right - left, bottom - top);
        Self { left, top, columns, rows, amounts: vec![0.0; columns * rows] }
    }

    fn piece(&mut self, a: Point, b: Point, radius: f64) {
        let reach = radius + 0.5;
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let square = dx * dx + dy * dy;
        let rows = clip(a.1.min(b.1) - reach, a.1.max(b.1) + reach, self.top, self.rows);
        for row in rows {
            let y = (self.top + row) as f64 + 0.5;
            let (mut low, mut high) = (a.0.min(b.0), a.0.max(b.0));
            if dy != 0.0 {
                let crossing = a.0 + (y - a.1) * dx / dy;
                let spread = reach * (square.sqrt() / dy.abs());
                low = low.max(crossing - spread);
                high = high.min(crossing + spread);
            }
            for column in clip(low - reach, high + reach, self.left, self.columns) {
                let x = (self.left + column) as f64 + 0.5;
                let along = ((x - a.0) * dx + (y - a.1) * dy) / square;
                let along = if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 };
                let distance = hypot(x - a.0 - along * dx, y - a.1 - along * dy);
                let amount = (reach - distance).clamp(0.0, 1.0).min(2.0 * radius) as f32;
                let held = &mut self.amounts[row * self.columns + column];
                *held = held.max(amount);
            }
        }
    }
}

fn clip(low: f64, high: f64, first: usize, count: usize) -> std::ops::Range<usize> {
    let whole = |x: f64| (x - first as f64).clamp(0.0, count as f64) as usize;
    whole(low.floor())..whole(high.ceil())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::colour::INK;

    fn painted(canvas: &Canvas) -> Vec<u8> {
        let bytes = paint(canvas, 20, 20).unwrap();
        let mut reader = png::Decoder::new(bytes.as_slice()).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size()];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    }

    #[test]
    fn painted_line_covers_the_expected_area() {
        for end in [(15.0, 5.0), (15.0, 15.0), (8.0, 15.0)] {
            let mut canvas = Canvas::default();
            canvas.line([(5.0, 5.0), end], 2.0, Colour(0, 0, 0));
            let dark: f64 =
                painted(&canvas).iter().step_by(3).map(|&v| 1.0 - f64::from(v) / 255.0).sum();
            let area = 2.0 * (end.0 - 5.0f64).hypot(end.1 - 5.0) + std::f64::consts::PI;
            assert!((dark / area - 1.0).abs() < 0.05, "{dark} against {area}");
        }
    }

    #[test]
    fn shapes_outside_the_picture_are_clipped() {
        let mut canvas = Canvas::default();
        canvas.line([(-1e9, 5.0), (1e9, 5.0), (5.0, -1e9)], 2.0, INK);
        canvas.disc((-50.0, 300.0), 10.0, INK);
        canvas.fill(Area { left: -5.0, top: -5.0, right: 1.0, bottom: 1e6 }, INK);
        canvas.text("beyond", (18.0, 2.0), 12.0, crate::output::canvas::Align::Start, INK);
        assert_eq!(painted(&canvas)[..3], [INK.0, INK.1, INK.2]);
    }
}
