//! Symbols of mechanics: supports, motors, joints, sliders, loads, springs, dampers and obstacles.

mod obstacle;
mod symbol_frame;

use symbol_frame::SymbolFrame;

use super::{
    canvas::{Area, Canvas, Point},
    colour::INK,
    curve,
    frame::Frame,
    link::{LINK, Link},
    plane::{AxisLimits, View},
};

use crate::elementary::hypot;

/// White space kept around the centre of a symbol so that the symbol is not cut off at the border of the picture [pixels].
const ROOM: f64 = 20.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    Hinge,
    /// Support that fixes position and angle. The symbol points along the beam, away from the support.
    Clamp,
    /// Support that fixes the position along the direction of the symbol, which points away from the ground.
    Roller,
    /// Support that fixes the angle and one component of the position.
    Guided,
    /// Support that fixes only the angle.
    HeldAngle,
    Motor,
    Carriage,
    Joint,
    RigidJoint,
    Slider,
    Force,
    LineForce,
    /// Moment, counter-clockwise if the direction of the symbol points to the right, and clockwise if it points to the left.
    Moment,
    /// Spring from the point of the symbol to the end of the direction vector.
    Spring,
    /// Damper from the point of the symbol to the end of the direction vector.
    Damper,
    /// Segment of a tendon, from the point of the symbol to the end of the direction vector.
    Tendon,
    TorsionSpring,
    /// Straight boundary of the ground. The direction of the symbol is the outer normal.
    Wall,
    /// Disc that is fixed to the ground. The length of the direction of the symbol is the radius.
    Disc,
}

impl Symbol {
    pub fn is_constraint(self) -> bool {
        use Symbol::{Clamp, Guided, HeldAngle, Hinge, Joint, RigidJoint, Roller, Slider};
        matches!(self, Hinge | Clamp | Roller | Guided | HeldAngle | Joint | RigidJoint | Slider)
    }

    pub fn is_obstacle(self) -> bool {
        matches!(self, Self::Wall | Self::Disc)
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Hinge => "hinge",
            Self::Clamp => "clamp",
            Self::Roller => "roller",
            Self::Guided => "guided",
            Self::HeldAngle => "held_angle",
            Self::Motor => "motor",
            Self::Carriage => "carriage",
            Self::Joint => "joint",
            Self::RigidJoint => "rigid_joint",
            Self::Slider => "slider",
            Self::Force => "force",
            Self::LineForce => "line_force",
            Self::Moment => "moment",
            Self::Spring => "spring",
            Self::Damper => "damper",
            Self::Tendon => "tendon",
            Self::TorsionSpring => "torsion_spring",
            Self::Wall => "wall",
            Self::Disc => "disc",
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSymbol {
    pub symbol: Symbol,
    pub at: Point,
    /// Direction of the symbol; zero if it has none. The length has a meaning only for discs and connecting symbols.
    /// Springs, dampers and tendons end at `at + direction`.
    pub direction: Point,
}

impl PlacedSymbol {
    /// Both ends of a spring, a damper or a segment of a tendon; `None` for other symbols.
    pub fn link(&self) -> Option<[Point; 2]> {
        self.end().map(|end| [self.at, end])
    }

    fn end(&self) -> Option<Point> {
        use Symbol::{Damper, Spring, Tendon};
        matches!(self.symbol, Spring | Damper | Tendon).then(|| self.tip())
    }

    fn tip(&self) -> Point {
        (self.at.0 + self.direction.0, self.at.1 + self.direction.1)
    }

    pub(super) fn view(
        symbols: &[Self],
        points: impl Iterator<Item = Point> + Clone,
        limits: &AxisLimits,
    ) -> View {
        use Symbol::{
            Carriage, Clamp, Guided, HeldAngle, Hinge, Moment, Motor, Roller, Slider, TorsionSpring,
        };
        let bare = View::of(points.clone(), limits);
        let links = symbols.iter().filter_map(Self::link);
        let ends = links.filter(|[at, end]| bare.shows(*at) || bare.shows(*end)).flatten();
        let is_about = |placed: &&Self| {
            let is_held = matches!(placed.symbol, Hinge | Clamp | Roller | Guided | HeldAngle);
            is_held || matches!(placed.symbol, Motor | Carriage | Slider | Moment | TorsionSpring)
        };
        let about = symbols.iter().filter(is_about).map(|placed| placed.at);
        let about = about.filter(|at| bare.shows(*at));
        let obstacles = symbols.iter().flat_map(|placed| placed.shown_points(&bare));
        View::of(points.chain(ends).chain(obstacles), limits).with_room(about, ROOM, limits)
    }

    pub(super) fn draw(&self, canvas: &mut Canvas, frame: &Frame, plot: &Area) {
        if let Some(end) = self.end() {
            let link = Link::between(frame.place(plot, self.at), frame.place(plot, end));
            let lines = match self.symbol {
                Symbol::Spring => link.spring(),
                Symbol::Damper => link.damper(),
                _ => vec![link.ends()],
            };
            for piece in lines.into_iter().flat_map(|line| curve::pieces(line, plot)) {
                canvas.line(piece, LINK, INK);
            }
            return;
        }
        let Some(at) = frame.curve(plot, &[self.at]).first().and_then(|run| run.first().copied())
        else {
            return;
        };
        let (x, y) = self.direction;
        let length = hypot(x, y);
        let ahead = if length > 0.0 { (x / length, -y / length) } else { (1.0, 0.0) };
        SymbolFrame { canvas, plot, at, ahead }.draw(self.symbol);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::axis::PlotAxis;

    const PLOT: Area = Area { left: 100.0, top: 100.0, right: 300.0, bottom: 300.0 };

    fn drawn(symbol: Symbol, at: Point, direction: Point) -> Canvas {
        let axis = PlotAxis::between(0.0, 1.0);
        let mut canvas = Canvas::default();
        let frame = Frame { x: axis, y: axis, ..Frame::default() };
        PlacedSymbol { symbol, at, direction }.draw(&mut canvas, &frame, &PLOT);
        canvas
    }

    #[test]
    fn symbols_are_drawn_only_inside_the_plot() {
        use Symbol::{
            Carriage, Clamp, Force, Guided, HeldAngle, Hinge, Joint, LineForce, Moment, Motor,
            RigidJoint, Roller, Slider, TorsionSpring,
        };
        let bodies = [Hinge, Clamp, Roller, Guided, HeldAngle, Motor, Carriage, Joint];
        let others = [RigidJoint, Slider, TorsionSpring];
        for symbol in bodies.into_iter().chain(others).chain([Force, LineForce, Moment]) {
            assert!(!drawn(symbol, (0.5, 0.5), (1.0, 0.0)).shapes().is_empty(), "{symbol:?}");
            assert!(drawn(symbol, (1.5, 0.5), (1.0, 0.0)).shapes().is_empty(), "{symbol:?}");
        }
    }

    #[test]
    fn force_arrow_ends_at_its_point_if_it_fits_the_plot() {
        let shaft = |at| match drawn(Symbol::Force, at, (2.0, 0.0)).shapes()[0].clone() {
            super::super::canvas::Shape::Line { points, .. } => points,
            other => panic!("{other:?}"),
        };
        assert_eq!(shaft((0.5, 0.5)), [(162.0, 200.0), (196.0, 200.0)]);
        assert_eq!(shaft((0.0, 0.5)), [(104.0, 200.0), (138.0, 200.0)]);
    }

    #[test]
    fn spring_symbols_extend_from_end_to_end() {
        for symbol in [Symbol::Spring, Symbol::Damper, Symbol::Tendon] {
            let canvas = drawn(symbol, (0.1, 0.5), (0.8, 0.0));
            let points = canvas.shapes().iter().flat_map(|shape| match shape {
                super::super::canvas::Shape::Line { points, .. } => points.clone(),
                other => panic!("{other:?}"),
            });
            let (low, high) = points
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (x, _)| {
                    (low.min(x), high.max(x))
                });
            assert!((low - 120.0).abs() < 1e-9 && (high - 280.0).abs() < 1e-9, "{symbol:?}");
            assert!(drawn(symbol, (1.5, 0.5), (0.5, 0.0)).shapes().is_empty(), "{symbol:?}");
        }
    }

    #[test]
    fn moment_symbol_shows_the_sign() {
        let of = |x: f64| format!("{:?}", drawn(Symbol::Moment, (0.5, 0.5), (x, 0.0)).shapes());
        assert_ne!(of(3.0), of(-3.0));
    }
}
