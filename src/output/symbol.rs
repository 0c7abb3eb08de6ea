//! Symbols of mechanics: supports, joints, sliders and loads, of the same size in every picture.

use super::{
    canvas::{Area, Canvas, Point},
    colour::{INK, WHITE},
    curve,
    frame::Frame,
    link::{LINK, Link},
    marker::Marker,
    plane::{Limits, View},
};
use std::f64::consts::PI;

use crate::elementary::{cos, hypot, sin};

/// Widths of lines.
const LINE: f64 = 1.5;
const THIN: f64 = 1.0;
/// Half the breadth of a support, the height of its triangle, and the length of its hatching.
const SUPPORT: f64 = 11.0;
const TRIANGLE: f64 = 12.0;
const HATCH: f64 = 5.0;
/// Radii of a joint and of a slider.
const JOINT: f64 = 4.0;
const SLIDER: f64 = 6.5;
/// The length of an arrow, of one of many and of a head, and its distance from the place where it acts.
const ARROW: f64 = 34.0;
const SHORT: f64 = 18.0;
const HEAD: f64 = 8.0;
const APART: f64 = 4.0;
/// Paper around a symbol, so that nothing of it is cut.
const ROOM: f64 = 24.0;
/// The radius of a roller and of a motor, half the breadth of a carriage, and the length of the heads of their arrows.
const ROLLER: f64 = 2.5;
const MOTOR: f64 = 11.0;
const CARRIAGE: f64 = 6.5;
const SMALL_HEAD: f64 = 5.5;
/// The radius of the arrow of a moment.
const TURN: f64 = 15.0;

/// A thing of a mechanism that has a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// A support that holds a position.
    Hinge,
    /// A support that holds position and angle; its direction is that of the beam that leaves it.
    Clamp,
    /// A support that holds one component of the position, along its direction, away from the ground.
    Roller,
    /// A support that holds one component of the position and the angle, likewise.
    Guided,
    /// A support that holds the angle alone.
    HeldAngle,
    /// What turns a section as a function of time.
    Motor,
    /// What moves a place along a direction as a function of time.
    Carriage,
    /// A joint between beams that turns.
    Joint,
    /// A joint between beams that does not.
    RigidJoint,
    /// A place that slides along a beam.
    Slider,
    /// A force, along its direction.
    Force,
    /// A part of a force that is spread along a beam.
    LineForce,
    /// A moment: counter-clockwise when its direction is to the right, clockwise when to the left.
    Moment,
    /// A spring, from its place as far as its direction goes.
    Spring,
    /// A damper, likewise.
    Damper,
    /// A part of a tendon, likewise.
    Tendon,
    /// A spring against the turning of a section.
    TorsionSpring,
}

impl Symbol {
    /// Its name in the data of pages.
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
        }
    }
}

/// A symbol at a place, in the reader's units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSymbol {
    /// What it is.
    pub symbol: Symbol,
    /// Where it is.
    pub at: Point,
    /// Where it points; of any length, zero for what has no direction. Springs, dampers and tendons end there.
    pub direction: Point,
}

/// The paper around a symbol: its place and its direction in pixels.
struct Spot<'a> {
    canvas: &'a mut Canvas,
    plot: &'a Area,
    at: Point,
    ahead: Point,
}

impl PlacedSymbol {
    /// The places between which it is drawn, of a spring, a damper or a part of a tendon.
    pub fn link(&self) -> Option<[Point; 2]> {
        self.end().map(|end| [self.at, end])
    }

    /// Where it ends, if it has another end than its place.
    fn end(&self) -> Option<Point> {
        use Symbol::{Damper, Spring, Tendon};
        matches!(self.symbol, Spring | Damper | Tendon)
            .then_some((self.at.0 + self.direction.0, self.at.1 + self.direction.1))
    }

    /// The part of the plane that points need, and the symbols that are among them.
    pub(super) fn view(
        symbols: &[Self],
        points: impl Iterator<Item = Point> + Clone,
        limits: &Limits,
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
        View::of(points.chain(ends), limits).with_room(about, ROOM, limits)
    }

    /// Draws it on a plot; not at all where the plot does not show its place.
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
        let mut spot = Spot { canvas, plot, at, ahead };
        match self.symbol {
            Symbol::Hinge => spot.hinge(),
            Symbol::Clamp => spot.clamp(),
            Symbol::Roller => spot.roller(),
            Symbol::Guided => spot.guided(),
            Symbol::HeldAngle => spot.square(JOINT + 2.0),
            Symbol::Motor => spot.motor(),
            Symbol::Carriage => spot.carriage(),
            Symbol::Joint => spot.ring(),
            Symbol::RigidJoint => Marker::Square.draw(spot.canvas, at, JOINT, INK),
            Symbol::Slider => Marker::Diamond.draw(spot.canvas, at, SLIDER, INK),
            Symbol::Force => spot.arrow(ARROW, LINE),
            Symbol::LineForce => spot.arrow(SHORT, THIN),
            Symbol::Moment => spot.turn(),
            Symbol::TorsionSpring => spot.spiral(),
            Symbol::Spring | Symbol::Damper | Symbol::Tendon => {}
        }
    }
}

impl Spot<'_> {
    /// The place so far ahead and so far to the left.
    fn at(&self, ahead: f64, left: f64) -> Point {
        let (x, y) = self.ahead;
        (self.at.0 + ahead * x + left * y, self.at.1 + ahead * y - left * x)
    }

    fn line(&mut self, points: &[Point], width: f64) {
        for piece in curve::pieces(points.iter().copied(), self.plot) {
            self.canvas.line(piece, width, INK);
        }
    }

    fn ring(&mut self) {
        self.canvas.disc(self.at, JOINT, INK);
        self.canvas.disc(self.at, JOINT - LINE, WHITE);
    }

    /// A line with slanted strokes behind it, from `from` to `to`.
    fn ground(&mut self, from: Point, to: Point, behind: Point) {
        self.line(&[from, to], LINE);
        for index in 0..=4 {
            let part = 0.1 + 0.2 * f64::from(index);
            let foot = (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1));
            let slant = ((to.0 - from.0) * 0.15, (to.1 - from.1) * 0.15);
            let end = (foot.0 + HATCH * behind.0 - slant.0, foot.1 + HATCH * behind.1 - slant.1);
            self.line(&[foot, end], THIN);
        }
    }

    /// A triangle whose tip is the place and which stands behind it.
    fn triangle(&mut self) {
        let foot = [self.at(-TRIANGLE, 0.6 * SUPPORT), self.at(-TRIANGLE, -0.6 * SUPPORT)];
        self.line(&[self.at, foot[0], foot[1], self.at], LINE);
    }

    /// The ground so far behind the place.
    fn ground_behind(&mut self, far: f64) {
        let ends = [self.at(-far, SUPPORT), self.at(-far, -SUPPORT)];
        self.ground(ends[0], ends[1], (-self.ahead.0, -self.ahead.1));
    }

    /// Two rollers on the ground, so far behind the place.
    fn rollers_behind(&mut self, far: f64) {
        for side in [-1.0, 1.0] {
            let centre = self.at(-far - ROLLER, side * 0.4 * SUPPORT);
            self.canvas.disc(centre, ROLLER, INK);
            self.canvas.disc(centre, ROLLER - THIN, WHITE);
        }
        self.ground_behind(far + 2.0 * ROLLER);
    }

    fn hinge(&mut self) {
        // It stands upright.
        self.ahead = (0.0, -1.0);
        self.triangle();
        self.ground_behind(TRIANGLE);
        self.ring();
    }

    fn roller(&mut self) {
        self.triangle();
        self.rollers_behind(TRIANGLE);
        self.ring();
    }

    fn guided(&mut self) {
        self.line(&[self.at(-JOINT, SUPPORT), self.at(-JOINT, -SUPPORT)], LINE);
        self.rollers_behind(JOINT);
        Marker::Square.draw(self.canvas, self.at, JOINT, INK);
    }

    /// A square that is not filled.
    fn square(&mut self, half: f64) {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)];
        let corners = corners.map(|(x, y)| (self.at.0 + half * x, self.at.1 + half * y));
        self.line(&corners, LINE);
    }

    /// A circle with two heads that run around it.
    fn motor(&mut self) {
        let around = |angle: f64| (self.at.0 + MOTOR * cos(angle), self.at.1 - MOTOR * sin(angle));
        let circle: Vec<Point> =
            (0..=48).map(|index| around(PI * f64::from(index) / 24.0)).collect();
        let heads = [0.9, 0.9 + PI].map(|angle| (around(angle), (-sin(angle), -cos(angle))));
        self.line(&circle, THIN);
        heads.into_iter().for_each(|(tip, ahead)| self.head(tip, ahead, SMALL_HEAD, LINE));
    }

    /// A square with an arrow on either side.
    fn carriage(&mut self) {
        self.square(CARRIAGE);
        for side in [-1.0, 1.0] {
            let ahead = (side * self.ahead.0, side * self.ahead.1);
            let (near, tip) =
                (self.at(side * CARRIAGE, 0.0), self.at(side * (CARRIAGE + 11.0), 0.0));
            self.line(&[near, tip], LINE);
            self.head(tip, ahead, SMALL_HEAD, LINE);
        }
    }

    fn clamp(&mut self) {
        let (from, to) = (self.at(0.0, -SUPPORT), self.at(0.0, SUPPORT));
        self.ground(from, to, (-self.ahead.0, -self.ahead.1));
    }

    fn head(&mut self, tip: Point, ahead: Point, size: f64, width: f64) {
        let wing = |side: f64| {
            let (x, y) = (ahead.0 - 0.5 * side * ahead.1, ahead.1 + 0.5 * side * ahead.0);
            (tip.0 - size * x, tip.1 - size * y)
        };
        self.line(&[wing(1.0), tip, wing(-1.0)], width);
    }

    /// An arrow that ends at the place; where there is no paper for that, one that begins there.
    fn arrow(&mut self, length: f64, width: f64) {
        let (tail, tip) = (self.at(-APART - length, 0.0), self.at(-APART, 0.0));
        let is_on_paper = (self.plot.left..=self.plot.right).contains(&tail.0)
            && (self.plot.top..=self.plot.bottom).contains(&tail.1);
        let (tail, tip) = match is_on_paper {
            true => (tail, tip),
            false => (self.at(APART, 0.0), self.at(APART + length, 0.0)),
        };
        self.line(&[tail, tip], width);
        self.head(tip, self.ahead, HEAD, width);
    }

    /// Two turns and a half about the place.
    fn spiral(&mut self) {
        let point = |index: u32| {
            let (angle, radius) =
                (5.0 * PI * f64::from(index) / 48.0, 3.0 + f64::from(index) / 4.8);
            (self.at.0 + radius * cos(angle), self.at.1 - radius * sin(angle))
        };
        let spiral: Vec<Point> = (0..=48).map(point).collect();
        self.line(&spiral, THIN);
    }

    /// Most of a circle, with a head.
    fn turn(&mut self) {
        let side = if self.ahead.0 < 0.0 { -1.0 } else { 1.0 };
        // From below the place to its upper side; clockwise it is the mirror image.
        let angle = |index: f64| -2.0 + 4.4 * index / 24.0;
        let around =
            |angle: f64| (self.at.0 + side * TURN * cos(angle), self.at.1 - TURN * sin(angle));
        let arc: Vec<Point> = (0..=24).map(|index| around(angle(f64::from(index)))).collect();
        let (end, tip) = (angle(24.0), around(angle(24.0)));
        self.line(&arc, LINE);
        self.head(tip, (-side * sin(end), -cos(end)), HEAD, LINE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::axis::Axis;

    const PLOT: Area = Area { left: 100.0, top: 100.0, right: 300.0, bottom: 300.0 };

    fn drawn(symbol: Symbol, at: Point, direction: Point) -> Canvas {
        let axis = Axis::between(0.0, 1.0);
        let mut canvas = Canvas::default();
        let frame = Frame { x: axis, y: axis, ..Frame::default() };
        PlacedSymbol { symbol, at, direction }.draw(&mut canvas, &frame, &PLOT);
        canvas
    }

    #[test]
    fn symbols_are_drawn_where_their_place_is_seen() {
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
    fn an_arrow_points_at_its_place_where_there_is_paper_for_it() {
        let shaft = |at| match drawn(Symbol::Force, at, (2.0, 0.0)).shapes()[0].clone() {
            super::super::canvas::Shape::Line { points, .. } => points,
            other => panic!("{other:?}"),
        };
        assert_eq!(shaft((0.5, 0.5)), [(162.0, 200.0), (196.0, 200.0)]);
        assert_eq!(shaft((0.0, 0.5)), [(104.0, 200.0), (138.0, 200.0)]);
    }

    #[test]
    fn springs_go_from_end_to_end() {
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
    fn moments_turn_either_way() {
        let of = |x: f64| format!("{:?}", drawn(Symbol::Moment, (0.5, 0.5), (x, 0.0)).shapes());
        assert_ne!(of(3.0), of(-3.0));
    }
}
