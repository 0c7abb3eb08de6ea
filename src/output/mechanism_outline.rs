//! Outlines of rigid bodies, and symbols of supports and joints, in pictures of section forces and strains.

use super::{
    canvas::{Area, Canvas, Point},
    colour::INK,
    frame::Frame,
    plane::{AxisLimits, View},
    symbol::PlacedSymbol,
};

const OUTLINE: f64 = 1.6;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct MechanismOutline {
    pub bodies: Vec<Vec<Point>>,
    pub symbols: Vec<PlacedSymbol>,
}

impl MechanismOutline {
    pub(super) fn view(
        &self,
        points: impl Iterator<Item = Point> + Clone,
        limits: &AxisLimits,
    ) -> View {
        let bodies = self.bodies.iter().flatten().copied();
        PlacedSymbol::view(&self.symbols, points.chain(bodies), limits)
    }

    pub(super) fn draw_obstacles(&self, canvas: &mut Canvas, frame: &Frame, plot: &Area) {
        PlacedSymbol::draw_obstacles(&self.symbols, canvas, frame, plot);
    }

    pub(super) fn draw(&self, canvas: &mut Canvas, frame: &Frame, plot: &Area) {
        for run in self.bodies.iter().flat_map(|body| frame.curve(plot, body)) {
            canvas.line(run, OUTLINE, INK);
        }
        self.symbols.iter().for_each(|symbol| symbol.draw(canvas, frame, plot));
    }
}
