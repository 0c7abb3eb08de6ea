//! Completed pictures, and their file formats.

use std::path::Path;

use super::{OutputError, canvas::Canvas, png, svg};

const SIDES: std::ops::RangeInclusive<f64> = 100.0..=8000.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureKind {
    Svg,
    Png,
}

impl PictureKind {
    pub fn of(path: &Path) -> Result<Self, OutputError> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            Some(other) => {
                Err(OutputError::PictureKind { path: path.into(), ending: format!("'.{other}'") })
            }
            None => Err(OutputError::PictureKind { path: path.into(), ending: "missing".into() }),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    canvas: Canvas,
    width: u32,
    height: u32,
}

impl Figure {
    /// Creates a picture from `canvas` with the given size [pixels], rounded up to whole pixels.
    pub fn new(canvas: Canvas, (width, height): (f64, f64)) -> Result<Self, OutputError> {
        if !SIDES.contains(&width) || !SIDES.contains(&height) {
            return Err(OutputError::PictureSize { width, height });
        }
        Ok(Self { canvas, width: width.ceil() as u32, height: height.ceil() as u32 })
    }

    /// Width and height of the picture [pixels].
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    pub fn to_svg(&self) -> Result<String, OutputError> {
        svg::paint(&self.canvas, self.width, self.height)
    }

    pub fn to_png(&self) -> Result<Vec<u8>, OutputError> {
        png::paint(&self.canvas, self.width, self.height)
    }

    pub(super) fn to_pixels(&self) -> Result<Vec<u8>, OutputError> {
        png::pixels(&self.canvas, self.width, self.height)
    }

    #[cfg(test)]
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), OutputError> {
        let path = path.as_ref();
        match PictureKind::of(path)? {
            PictureKind::Svg => super::files::write_atomic(path, self.to_svg()?.as_bytes()),
            PictureKind::Png => super::files::write_atomic(path, &self.to_png()?),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_picture_extensions_are_rejected_with_the_allowed_ones() {
        let home = tempfile::tempdir().unwrap();
        let figure = Figure::new(Canvas::default(), (100.0, 100.0)).unwrap();
        let message = figure.save(home.path().join("energy.pdf")).unwrap_err().to_string();
        assert!(
            message.contains("energy.pdf': the file extension is '.pdf'; use '.svg'"),
            "{message}"
        );
        assert!(figure.save("energy").unwrap_err().to_string().contains("extension is missing"));
        figure.save(home.path().join("ENERGY.PNG")).unwrap();
        figure.save(home.path().join("new/energy.svg")).unwrap();
    }

    #[test]
    fn invalid_picture_sizes_are_rejected() {
        for size in [(0.0, 300.0), (f64::NAN, 300.0), (300.0, 1e9)] {
            assert!(matches!(
                Figure::new(Canvas::default(), size),
                Err(OutputError::PictureSize { .. })
            ));
        }
    }
}
