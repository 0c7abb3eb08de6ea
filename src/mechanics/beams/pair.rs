//! Plane vectors at one point, or at several points in vector lanes.

use std::ops::{Add, AddAssign, Mul, Sub};

use pulp::Simd;

use super::Rotation;
use super::simd::{LaneChunk, Lanes, Number, Vector};
use crate::geometry::Vec2;

pub trait Planar<T> {
    fn of(x: T, y: T) -> Self;

    fn components(self) -> (T, T);
}

impl Planar<f64> for Vec2 {
    #[inline(always)]
    fn of(x: f64, y: f64) -> Self {
        Self::new(x, y)
    }

    #[inline(always)]
    fn components(self) -> (f64, f64) {
        (self.x, self.y)
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Pair<T> {
    pub(super) x: T,
    pub(super) y: T,
}

impl<T> Planar<T> for Pair<T> {
    #[inline(always)]
    fn of(x: T, y: T) -> Self {
        Self { x, y }
    }

    #[inline(always)]
    fn components(self) -> (T, T) {
        (self.x, self.y)
    }
}

impl<T: Number> Pair<T> {
    #[inline(always)]
    pub(super) fn first_axis(like: T) -> Self {
        Self { x: like.same(1.0), y: like.same(0.0) }
    }

    #[inline(always)]
    pub(super) fn second_axis(like: T) -> Self {
        Self { x: like.same(0.0), y: like.same(1.0) }
    }

    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> T {
        self.x * other.x + self.y * other.y
    }

    #[inline(always)]
    pub(super) fn cross(self, other: Self) -> T {
        self.x * other.y - self.y * other.x
    }

    #[inline(always)]
    pub(super) fn perpendicular(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    #[inline(always)]
    pub(super) fn by_component(self, other: Self) -> Self {
        Self { x: self.x * other.x, y: self.y * other.y }
    }

    #[inline(always)]
    pub(super) fn over_component(self, other: Self) -> Self {
        Self { x: self.x / other.x, y: self.y / other.y }
    }

    #[inline(always)]
    pub(super) fn larger_magnitude(self) -> T {
        self.x.abs().larger(self.y.abs())
    }
}

impl<T: Number> Add for Pair<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<T: Number> AddAssign for Pair<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Number> Sub for Pair<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<T: Number> Mul<T> for Pair<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}

impl Pair<Lanes> {
    #[inline(always)]
    pub(super) fn get<V: Simd>(&self, part: LaneChunk<V>) -> Pair<Vector<V>> {
        Pair { x: self.x.get(part), y: self.y.get(part) }
    }

    #[inline(always)]
    pub(super) fn put<V: Simd>(&mut self, part: LaneChunk<V>, pair: Pair<Vector<V>>) {
        self.x.put(part, pair.x);
        self.y.put(part, pair.y);
    }

    #[inline(always)]
    pub(super) fn lane(&self, lane: usize) -> Vec2 {
        Vec2::new(self.x.lane(lane), self.y.lane(lane))
    }

    pub(super) fn set_lane(&mut self, lane: usize, vector: Vec2) {
        self.x.set_lane(lane, vector.x);
        self.y.set_lane(lane, vector.y);
    }
}

impl Rotation<Lanes> {
    #[inline(always)]
    pub(super) fn get<V: Simd>(&self, part: LaneChunk<V>) -> Rotation<Vector<V>> {
        Rotation { cos: self.cos.get(part), sin: self.sin.get(part) }
    }

    #[inline(always)]
    pub(super) fn put<V: Simd>(&mut self, part: LaneChunk<V>, rotation: Rotation<Vector<V>>) {
        self.cos.put(part, rotation.cos);
        self.sin.put(part, rotation.sin);
    }

    #[inline(always)]
    pub(super) fn lane(&self, lane: usize) -> Rotation {
        Rotation { cos: self.cos.lane(lane), sin: self.sin.lane(lane) }
    }

    pub(super) fn set_lane(&mut self, lane: usize, rotation: Rotation) {
        self.cos.set_lane(lane, rotation.cos);
        self.sin.set_lane(lane, rotation.sin);
    }
}

impl Default for Rotation<Lanes> {
    fn default() -> Self {
        Self { cos: Lanes::default(), sin: Lanes::default() }
    }
}
