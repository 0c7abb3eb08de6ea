//! The beam that a slider slides on, its ends, and what a slider does there.

use serde::{Deserialize, Serialize};

use crate::geometry::{Curve, corresponding};

/// How far a slider may end beside the end of its master and still be there, relative to the master's parameters.
pub const LANDED: f64 = 4e-15;

/// An end of the master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrackEnd {
    /// Where its parameter starts.
    Start,
    /// Where its parameter ends.
    End,
}

impl TrackEnd {
    /// A word for messages and scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::End => "end",
        }
    }

    /// The sign of `dξ/dt` with which it is reached.
    pub(in crate::model) fn outward(self) -> f64 {
        match self {
            Self::Start => -1.0,
            Self::End => 1.0,
        }
    }
}

/// What a slider does at present.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SliderState {
    /// It slides.
    Sliding,
    /// It rests against the stop at an end.
    Held(TrackEnd),
    /// It has left its master.
    Released,
}

impl SliderState {
    /// A word for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sliding => "sliding",
            Self::Held(_) => "held",
            Self::Released => "released",
        }
    }
}

/// The end of a master at which a slider may arrive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrackLimit {
    /// The slider.
    pub slider: usize,
    /// The end of its master.
    pub end: TrackEnd,
}

impl TrackLimit {
    /// The ends of the master of a slider, in the order of their numbers.
    pub(in crate::model) fn both(slider: usize) -> [Self; 2] {
        [TrackEnd::Start, TrackEnd::End].map(|end| Self { slider, end })
    }

    /// Its number among those of all sliders.
    pub fn number(self) -> usize {
        2 * self.slider + self.end as usize
    }

    /// The limit of that number.
    pub fn of(number: usize) -> Self {
        Self::both(number / 2)[number % 2]
    }
}

/// The beam that is slid on, as drawn, with the parameters of its mesh.
#[derive(Debug, Clone)]
pub struct Track {
    axis: Curve,
    /// The first and the last parameter of the mesh.
    domain: (f64, f64),
}

impl Track {
    /// A beam by its axis as drawn, with the first and the last parameter of its mesh.
    pub fn new(axis: Curve, domain: (f64, f64)) -> Self {
        Self { axis, domain }
    }

    /// The first and the last parameter of the mesh.
    pub fn domain(&self) -> (f64, f64) {
        self.domain
    }

    /// Its length as drawn [length].
    pub fn length(&self) -> f64 {
        self.axis.length()
    }

    /// The parameter of an end.
    pub fn end(&self, end: TrackEnd) -> f64 {
        match end {
            TrackEnd::Start => self.domain.0,
            TrackEnd::End => self.domain.1,
        }
    }

    /// How far a parameter is from an end, as a part of all parameters [-].
    pub fn distance(&self, parameter: f64, end: TrackEnd) -> f64 {
        let (first, last) = self.domain;
        (self.end(end) - parameter).abs() / (last - first)
    }

    /// How far a parameter lies beyond an end, as a part of all parameters [-]; negative before it.
    pub fn beyond(&self, parameter: f64, end: TrackEnd) -> f64 {
        let (first, last) = self.domain;
        let distance = match end {
            TrackEnd::Start => first - parameter,
            TrackEnd::End => parameter - last,
        };
        distance / (last - first)
    }

    /// Whether a parameter is one of the mesh, or beside an end by rounding.
    pub fn has(&self, parameter: f64) -> bool {
        let (first, last) = self.domain;
        let slack = LANDED * (last - first);
        (first - slack..=last + slack).contains(&parameter)
    }

    /// The part of the length as drawn that lies before a parameter [-].
    pub fn part_before(&self, parameter: f64) -> f64 {
        let along = self.axis.length_to(self.drawn(parameter));
        along.map_or(f64::NAN, |along| along / self.axis.length())
    }

    /// The length as drawn that belongs to a unit of the parameter there [length].
    pub fn stretch(&self, parameter: f64) -> f64 {
        let (start, end) = self.axis.domain();
        let (first, last) = self.domain;
        let drawn = self.axis.derivative(self.drawn(parameter), 1);
        drawn.map_or(f64::NAN, |drawn| drawn.norm()) * (end - start) / (last - first)
    }

    /// The parameter of the axis as drawn.
    fn drawn(&self, parameter: f64) -> f64 {
        corresponding(parameter, self.domain, self.axis.domain())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_numbered_in_their_order() {
        let limits: Vec<TrackLimit> = (0..3).flat_map(TrackLimit::both).collect();
        for (number, limit) in limits.into_iter().enumerate() {
            assert_eq!((limit.number(), TrackLimit::of(number)), (number, limit));
        }
    }
}
