//! Drawing of symbols at a point: lines and discs, in pixels.

use std::f64::consts::PI;

use super::Symbol;
use crate::elementary::{cos, sin};
use crate::output::canvas::{Area, Canvas, Point};
use crate::output::colour::{INK, WHITE};
use crate::output::curve;
use crate::output::marker::Marker;

const LINE: f64 = 1.5;
const THIN: f64 = 1.0;
/// Half width of a support [pixels].
const SUPPORT: f64 = 11.0;
const TRIANGLE: f64 = 12.0;
const HATCH: f64 = 5.0;
const JOINT: f64 = 4.0;
const SLIDER: f64 = 6.5;
/// Length of an arrow [pixels].
const ARROW: f64 = 34.0;
const SHORT: f64 = 18.0;
const HEAD: f64 = 8.0;
const APART: f64 = 4.0;
/// Radius of a roller [pixels].
const ROLLER: f64 = 2.0;
const MOTOR: f64 = 11.0;
const CARRIAGE: f64 = 6.5;
const SMALL_HEAD: f64 = 5.5;
const TURN: f64 = 15.0;

pub(super) struct SymbolFrame<'a> {
    pub(super) canvas: &'a mut Canvas,
    pub(super) plot: &'a Area,
    pub(super) at: Point,
    pub(super) ahead: Point,
}

impl SymbolFrame<'_> {
    pub(super) fn draw(mut self, symbol: Symbol) {
        match symbol {
            Symbol::Hinge => self.hinge(),
            Symbol::Clamp => self.clamp(),
            Symbol::Roller => self.roller(),
            Symbol::Guided => self.guided(),
            Symbol::HeldAngle => self.square(JOINT + 2.0),
            Symbol::Motor => self.motor(),
            Symbol::Carriage => self.carriage(),
            Symbol::Joint => self.ring(),
            Symbol::RigidJoint => Marker::Square.draw(self.canvas, self.at, JOINT, INK),
            Symbol::Slider => Marker::Diamond.draw(self.canvas, self.at, SLIDER, INK),
            Symbol::Force => self.arrow(ARROW, LINE),
            Symbol::LineForce => self.arrow(SHORT, THIN),
            Symbol::Moment => self.turn(),
            Symbol::TorsionSpring => self.spiral(),
            Symbol::Spring | Symbol::Damper | Symbol::Tendon | Symbol::Wall | Symbol::Disc => {}
        }
    }

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

    fn triangle(&mut self) {
        let foot = [self.at(-TRIANGLE, 0.6 * SUPPORT), self.at(-TRIANGLE, -0.6 * SUPPORT)];
        self.line(&[self.at, foot[0], foot[1], self.at], LINE);
    }

    fn ground_behind(&mut self, far: f64) {
        let ends = [self.at(-far, SUPPORT), self.at(-far, -SUPPORT)];
        self.ground(ends[0], ends[1], (-self.ahead.0, -self.ahead.1));
    }

    fn rollers_behind(&mut self, far: f64) {
        for side in [-1.0, 1.0] {
            let centre = self.at(-far - ROLLER, side * 0.4 * SUPPORT);
            self.canvas.disc(centre, ROLLER, INK);
            self.canvas.disc(centre, ROLLER - THIN, WHITE);
        }
        self.ground_behind(far + 2.0 * ROLLER);
    }

    fn hinge(&mut self) {
        // The symbol of a hinge is always drawn upright.
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

    fn square(&mut self, half: f64) {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)];
        let corners = corners.map(|(x, y)| (self.at.0 + half * x, self.at.1 + half * y));
        self.line(&corners, LINE);
    }

    fn motor(&mut self) {
        let around = |angle: f64| (self.at.0 + MOTOR * cos(angle), self.at.1 - MOTOR * sin(angle));
        let circle: Vec<Point> =
            (0..=48).map(|index| around(PI * f64::from(index) / 24.0)).collect();
        let heads = [0.9, 0.9 + PI].map(|angle| (around(angle), (-sin(angle), -cos(angle))));
        self.line(&circle, THIN);
        heads.into_iter().for_each(|(tip, ahead)| self.head(tip, ahead, SMALL_HEAD, LINE));
    }

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

    fn spiral(&mut self) {
        let point = |index: u32| {
            let (angle, radius) =
                (5.0 * PI * f64::from(index) / 48.0, 3.0 + f64::from(index) / 4.8);
            (self.at.0 + radius * cos(angle), self.at.1 - radius * sin(angle))
        };
        let spiral: Vec<Point> = (0..=48).map(point).collect();
        self.line(&spiral, THIN);
    }

    fn turn(&mut self) {
        let side = if self.ahead.0 < 0.0 { -1.0 } else { 1.0 };
        let angle = |index: f64| -2.0 + 4.4 * index / 24.0;
        let around =
            |angle: f64| (self.at.0 + side * TURN * cos(angle), self.at.1 - TURN * sin(angle));
        let arc: Vec<Point> = (0..=24).map(|index| around(angle(f64::from(index)))).collect();
        let (end, tip) = (angle(24.0), around(angle(24.0)));
        self.line(&arc, LINE);
        self.head(tip, (-side * sin(end), -cos(end)), HEAD, LINE);
    }
}
