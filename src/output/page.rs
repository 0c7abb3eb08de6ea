//! Panels, and pages of panels in a grid.

use super::{
    OutputError,
    canvas::{Align, Area, Canvas},
    colour::INK,
    figure::Figure,
    fonts,
    frame::Margins,
};

pub trait Panel {
    /// Preferred size as a separate picture [pixels].
    fn size(&self) -> (f64, f64);

    /// Preferred size on a page with several rows and columns [pixels], smaller than that of a separate picture.
    fn size_among(&self, rows: usize, columns: usize) -> (f64, f64) {
        let (width, height) = self.size();
        let width = if columns > 1 { width * SIZE_IN_COLUMNS.0 } else { width };
        let height = match (rows, columns) {
            (..=1, ..=1) => height,
            (..=1, _) => height * SIZE_IN_COLUMNS.1,
            _ => height * HEIGHT_IN_ROWS,
        };
        (width, height)
    }

    /// Space around the plot, for a panel of the given size [pixels].
    fn margins(&self, width: f64, height: f64) -> Margins;

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area);

    fn figure(&self) -> Result<Figure, OutputError> {
        self.figure_of(self.size())
    }

    /// Panel as a separate picture with the given size [pixels].
    fn figure_of(&self, (width, height): (f64, f64)) -> Result<Figure, OutputError> {
        let area = Area { left: 0.0, top: 0.0, right: width.ceil(), bottom: height.ceil() };
        let mut canvas = Canvas::default();
        self.draw(&mut canvas, &area, &self.margins(width, height).inside(&area));
        Figure::new(canvas, (width, height))
    }

    #[cfg(test)]
    fn save(&self, path: impl AsRef<std::path::Path>) -> Result<(), OutputError>
    where
        Self: Sized,
    {
        self.figure()?.save(path)
    }
}

/// Height of a panel on a page with several rows, as a fraction of the height of a separate picture.
const HEIGHT_IN_ROWS: f64 = 0.6;
/// Width and height of a panel in a single row of several columns, as fractions of the width and the height of a separate picture.
const SIZE_IN_COLUMNS: (f64, f64) = (0.72, 0.85);
const TITLE: f64 = 18.0;

#[derive(Default)]
pub struct Page {
    title: String,
    columns: usize,
    panels: Vec<Box<dyn Panel>>,
}

impl Page {
    pub fn column() -> Self {
        Self::grid(1)
    }

    pub fn row() -> Self {
        Self::grid(usize::MAX)
    }

    pub fn grid(columns: usize) -> Self {
        Self { title: String::new(), columns: columns.max(1), panels: Vec::new() }
    }

    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    pub fn panel(mut self, panel: impl Panel + 'static) -> Self {
        self.panels.push(Box::new(panel));
        self
    }

    fn tracks(&self) -> (Vec<f64>, Vec<f64>) {
        let columns = self.columns.min(self.panels.len()).max(1);
        let rows = self.panels.len().div_ceil(columns);
        let mut tracks = (vec![0f64; columns], vec![0f64; rows]);
        for (index, panel) in self.panels.iter().enumerate() {
            let (width, height) = panel.size_among(rows, columns);
            let (column, row) = (index % columns, index / columns);
            tracks.0[column] = tracks.0[column].max(width.ceil());
            tracks.1[row] = tracks.1[row].max(height.ceil());
        }
        tracks
    }

    fn title_height(&self) -> f64 {
        if self.title.is_empty() { 0.0 } else { TITLE + 22.0 }
    }

    fn common_margins(&self, track: usize, index_of: impl Fn(usize) -> usize) -> Margins {
        let (widths, heights) = self.tracks();
        let members = self.panels.iter().enumerate().filter(|(index, _)| index_of(*index) == track);
        members
            .map(|(index, panel)| {
                panel.margins(widths[index % widths.len()], heights[index / widths.len()])
            })
            .fold(Margins::default(), Margins::widest)
    }
}

impl Panel for Page {
    fn size(&self) -> (f64, f64) {
        let (widths, heights) = self.tracks();
        (
            widths.iter().sum::<f64>().max(100.0),
            (heights.iter().sum::<f64>() + self.title_height()).max(100.0),
        )
    }

    fn margins(&self, _width: f64, _height: f64) -> Margins {
        Margins { top: self.title_height(), ..Margins::default() }
    }

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let (widths, heights) = self.tracks();
        let room = area.width() - 28.0;
        let size = fonts::shrunk(&self.title, TITLE, room);
        let title = fonts::fit(&self.title, size, room);
        canvas.text(
            &title,
            ((area.left + area.right) / 2.0, area.top + 16.0 + TITLE * 0.8),
            size,
            Align::Middle,
            INK,
        );

        let across = plot.width() / widths.iter().sum::<f64>().max(1.0);
        let down = plot.height() / heights.iter().sum::<f64>().max(1.0);
        let columns = widths.len();
        for (index, panel) in self.panels.iter().enumerate() {
            let (column, row) = (index % columns, index / columns);
            let left = plot.left + across * widths[..column].iter().sum::<f64>();
            let top = plot.top + down * heights[..row].iter().sum::<f64>();
            let cell = Area {
                left,
                top,
                right: left + across * widths[column],
                bottom: top + down * heights[row],
            };
            let upright = self.common_margins(column, |index| index % columns);
            let level = self.common_margins(row, |index| index / columns);
            let margins = Margins {
                left: upright.left,
                right: upright.right,
                top: level.top,
                bottom: level.bottom,
            };
            panel.draw(canvas, &cell, &margins.inside(&cell));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::chart::{LineChart, Series};

    fn chart(size: f64) -> LineChart {
        LineChart::new("chart").series(Series::new("x", vec![(0.0, 0.0), (1.0, size)]))
    }

    #[test]
    fn panels_of_a_column_share_width_and_margins() {
        let page = Page::column().title("both").panel(chart(1.0)).panel(chart(1.23456e4));
        let figure = page.figure().unwrap();
        assert_eq!(figure.size(), (900, 40 + 2 * 336));
        let shared = page.common_margins(0, |_| 0);
        assert_eq!(shared.left, chart(1.23456e4).margins(900.0, 336.0).left);
    }

    #[test]
    fn rows_grids_and_empty_pages_have_the_expected_size() {
        assert_eq!(
            Page::row().panel(chart(1.0)).panel(chart(2.0)).figure().unwrap().size(),
            (1296, 476)
        );
        let grid = Page::grid(2).panel(chart(1.0)).panel(chart(2.0)).panel(chart(3.0));
        assert_eq!(grid.figure().unwrap().size(), (1296, 672));
        assert_eq!(Page::column().figure().unwrap().size(), (100, 100));
        assert!(Page::grid(0).panel(grid).figure().is_ok(), "pages stand on pages");
    }
}
