//! Animated PNG files, which browsers and Markdown viewers can play.
//!
//! All frames share a palette of the 256 most frequent colours. Other colours are replaced by the nearest palette colour.

use std::collections::BTreeMap;

use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, FilterType};

use super::{OutputError, figure::Figure};

const MOST_COLOURS: usize = 256;
const MOST_PIXELS: f64 = 2e9;

type Rgb = [u8; 3];
type Pixels = Vec<u8>;

pub struct Animation<'a> {
    pub frames: usize,
    pub frames_per_second: u16,
    pub draw: &'a dyn Fn(usize) -> Result<Figure, OutputError>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Region {
    left: u32,
    top: u32,
    width: u32,
    height: u32,
}

impl Animation<'_> {
    /// Bytes of the file. Viewers repeat the animation endlessly, or show only the first frame if they do not support animations.
    pub fn to_png(&self) -> Result<Vec<u8>, OutputError> {
        let (width, height) = (self.draw)(0)?.size();
        let pixels = f64::from(width) * f64::from(height) * self.frames as f64;
        if pixels > MOST_PIXELS {
            return Err(OutputError::TooManyPixels { frames: self.frames, width, height });
        }
        let palette = self.palette()?;
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, width, height);
        encoder.set_color(ColorType::Indexed);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Best);
        // PNG filters are useless for palette indices, whose differences have no meaning.
        encoder.set_filter(FilterType::NoFilter);
        encoder.set_palette(palette.colours.concat());
        encoder.set_animated(self.frames as u32, 0).map_err(refused)?;
        encoder.set_frame_delay(1, self.frames_per_second).map_err(refused)?;
        encoder.set_blend_op(BlendOp::Source).map_err(refused)?;
        encoder.set_dispose_op(DisposeOp::None).map_err(refused)?;
        let mut writer = encoder.write_header().map_err(refused)?;
        let mut before: Option<Pixels> = None;
        for frame in 0..self.frames {
            let now = palette.indices(&(self.draw)(frame)?.to_pixels()?);
            let region = match &before {
                None => Region { left: 0, top: 0, width, height },
                Some(before) => changed(before, &now, width),
            };
            if before.is_some() {
                writer.set_frame_position(0, 0).map_err(refused)?;
                writer.set_frame_dimension(region.width, region.height).map_err(refused)?;
                writer.set_frame_position(region.left, region.top).map_err(refused)?;
            }
            writer.write_image_data(&cut(&now, width, region)).map_err(refused)?;
            before = Some(now);
        }
        writer.finish().map_err(refused)?;
        Ok(bytes)
    }

    fn palette(&self) -> Result<Palette, OutputError> {
        let mut counts: BTreeMap<Rgb, u64> = BTreeMap::new();
        for frame in 0..self.frames {
            let pixels = (self.draw)(frame)?.to_pixels()?;
            // Runs of equal pixels are counted together, because most neighbouring pixels are equal.
            for run in pixels.as_chunks().0.chunk_by(|a: &Rgb, b| a == b) {
                *counts.entry(run[0]).or_default() += run.len() as u64;
            }
        }
        let mut colours: Vec<(Rgb, u64)> = counts.iter().map(|(of, count)| (*of, *count)).collect();
        colours.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        colours.truncate(MOST_COLOURS);
        let colours: Vec<Rgb> = colours.into_iter().map(|(colour, _)| colour).collect();
        let near = |of: &Rgb| {
            let distances =
                colours.iter().enumerate().map(|(index, other)| (distance(*of, *other), index));
            (*of, distances.min().map_or(0, |(_, index)| index as u8))
        };
        Ok(Palette { nearest: counts.keys().map(near).collect(), colours })
    }
}

fn distance(a: Rgb, b: Rgb) -> u32 {
    a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
}

struct Palette {
    colours: Vec<Rgb>,
    nearest: BTreeMap<Rgb, u8>,
}

impl Palette {
    fn indices(&self, pixels: &[u8]) -> Pixels {
        let runs = pixels.as_chunks().0.chunk_by(|a: &Rgb, b| a == b);
        let index = |colour: &Rgb| self.nearest.get(colour).copied().unwrap_or(0);
        runs.flat_map(|run| std::iter::repeat_n(index(&run[0]), run.len())).collect()
    }
}

/// Bounding box of the difference between two frames; one pixel for equal frames, because the box must not be empty.
fn changed(before: &[u8], now: &[u8], width: u32) -> Region {
    let columns = width as usize;
    let (mut left, mut right) = (columns, 0);
    let (mut top, mut bottom) = (usize::MAX, 0);
    for (row, (old, new)) in before.chunks_exact(columns).zip(now.chunks_exact(columns)).enumerate()
    {
        let differs = |column: &usize| old[*column] != new[*column];
        if let Some(first) = (0..columns).find(differs) {
            let last = (0..columns).rev().find(differs).unwrap_or(first);
            (left, right) = (left.min(first), right.max(last));
            (top, bottom) = (top.min(row), row);
        }
    }
    match top {
        usize::MAX => Region { left: 0, top: 0, width: 1, height: 1 },
        _ => Region {
            left: left as u32,
            top: top as u32,
            width: (right - left + 1) as u32,
            height: (bottom - top + 1) as u32,
        },
    }
}

fn cut(pixels: &[u8], width: u32, region: Region) -> Pixels {
    let rows = pixels.chunks_exact(width as usize).skip(region.top as usize);
    let columns = region.left as usize..(region.left + region.width) as usize;
    rows.take(region.height as usize).flat_map(|row| &row[columns.clone()]).copied().collect()
}

fn refused(error: impl std::fmt::Display) -> OutputError {
    OutputError::Paint { reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::canvas::Canvas;
    use crate::output::colour::{INK, hue};

    fn disc(frame: usize) -> Result<Figure, OutputError> {
        let mut canvas = Canvas::default();
        canvas.line([(0.0, 20.0), (120.0, 20.0)], 1.0, INK);
        canvas.disc((20.0 + 10.0 * frame as f64, 60.0), 6.0, hue(0));
        Figure::new(canvas, (120.0, 100.0))
    }

    #[test]
    fn animation_frames_equal_the_drawn_pictures() {
        let bytes = Animation { frames: 5, frames_per_second: 20, draw: &disc }.to_png().unwrap();
        let mut decoder = png::Decoder::new(bytes.as_slice());
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        assert_eq!(reader.info().animation_control().unwrap().num_frames, 5);
        let mut shown = vec![0; 120 * 100 * 3];
        for frame in 0..5 {
            let mut pixels = vec![0; reader.output_buffer_size()];
            reader.next_frame(&mut pixels).unwrap();
            let part = *reader.info().frame_control().unwrap();
            assert_eq!((part.delay_num, part.delay_den), (1, 20));
            let (left, top, wide) =
                (part.x_offset as usize, part.y_offset as usize, part.width as usize);
            for (row, line) in pixels.chunks_exact(3 * wide).take(part.height as usize).enumerate()
            {
                let at = ((top + row) * 120 + left) * 3;
                shown[at..at + 3 * wide].copy_from_slice(line);
            }
            let drawn = disc(frame).unwrap().to_pixels().unwrap();
            let off = shown.iter().zip(&drawn).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
            assert!(off == 0, "frame {frame} is off by {off}");
            assert!(frame == 0 || part.width < 30, "only what changes is kept: {part:?}");
        }
    }

    #[test]
    fn animation_accepts_a_small_frame_region_followed_by_a_large_one() {
        let jumps = |frame: usize| {
            let mut canvas = Canvas::default();
            for (index, column) in [20.0, 110.0].into_iter().enumerate() {
                let radius = if frame > index { 6.0 } else { 3.0 };
                canvas.disc((column, 60.0), radius, hue(0));
            }
            if frame > 2 {
                canvas.line([(0.0, 20.0), (120.0, 20.0)], 1.0, INK);
            }
            Figure::new(canvas, (120.0, 100.0))
        };
        let animation = Animation { frames: 4, frames_per_second: 20, draw: &jumps };
        assert!(animation.to_png().is_ok(), "{:?}", animation.to_png().err());
    }

    #[test]
    fn palette_keeps_the_most_frequent_colours() {
        let many = |frame: usize| {
            let mut canvas = Canvas::default();
            for column in 0..100u8 {
                let colour =
                    crate::output::colour::Colour(column * 2, 255 - column, (frame * 80) as u8);
                let (left, top) = (f64::from(column), 20.0);
                let bottom = if column == 7 { 90.0 } else { 60.0 };
                let area = crate::output::canvas::Area { left, top, right: left + 1.0, bottom };
                canvas.fill(area, colour);
            }
            Figure::new(canvas, (120.0, 100.0))
        };
        let animation = Animation { frames: 3, frames_per_second: 10, draw: &many };
        let palette = animation.palette().unwrap();
        assert_eq!((palette.colours.len(), palette.colours[0]), (MOST_COLOURS, [255; 3]));
        assert_eq!(palette.nearest.len(), 301);
        assert!(palette.colours.contains(&[14, 248, 160]), "it is met more than others");
        let pixels = many(1).unwrap().to_pixels().unwrap();
        for (pixel, index) in pixels.as_chunks().0.iter().zip(palette.indices(&pixels)) {
            let near = palette.colours[index as usize];
            assert!(distance(*pixel, near) <= 100 * 100, "{pixel:?} is shown as {near:?}");
        }
        assert!(animation.to_png().is_ok());
    }

    #[test]
    fn animation_with_too_many_pixels_is_rejected() {
        let animation = Animation { frames: 1_000_000, frames_per_second: 10, draw: &disc };
        let message = animation.to_png().unwrap_err().to_string();
        assert!(message.contains("1000000 frames of 120 by 100"), "{message}");
    }
}
